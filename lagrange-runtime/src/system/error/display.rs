//! The messages of causes.

use core::fmt;

use super::Cause;
use crate::system::name::{Name, Part};

impl fmt::Display for Cause {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SingularMassMatrix { pivot, name } => write!(
                out,
                "the mass matrix is singular or negative at coordinate {pivot}: give that coordinate a mass or an inertia above \
                 zero, or keep away from configurations where it loses it",
                pivot = Part(*pivot, *name)
            ),
            Self::PositionViolated { constraint, name, by } => write!(
                out,
                "the coordinates violate constraint {constraint} by {by}: start from `system.consistent(state)?`, which \
                 projects a state onto the constraints; during a motion, take shorter steps",
                constraint = Part(*constraint, *name)
            ),
            Self::VelocityViolated { constraint, name, by } => write!(
                out,
                "the velocities violate constraint {constraint} by {by}: start from `system.consistent(state)?`, which \
                 projects a state onto the constraints; during a motion, take shorter steps",
                constraint = Part(*constraint, *name)
            ),
            Self::NoConsistentState { constraint, name, by } => write!(
                out,
                "no consistent state was found: where the search ended, constraint {constraint} is violated by {by}; start \
                 nearer to a state that satisfies all constraints, or check that the parameters allow one",
                constraint = Part(*constraint, *name)
            ),
            Self::Contradictory { constraint, name } => write!(
                out,
                "constraint {constraint} contradicts the others: no state satisfies all of them; check the parameters",
                constraint = Part(*constraint, *name)
            ),
            Self::VanishingGradient { constraint, name } => write!(
                out,
                "the gradient of constraint {constraint} is zero here, or has no value: if the function is a square, write its base instead; otherwise \
                 stay away from this configuration",
                constraint = Part(*constraint, *name)
            ),
            Self::TurningConstraint { constraint, name } => write!(
                out,
                "constraint {constraint} turns with time, so small deviations have no linear equations with \
                 constant coefficients: use coordinates that move along, or ask `variational().monodromy` \
                 over a period",
                constraint = Part(*constraint, *name)
            ),
            // The message comes with the name, so that a program that cannot need it does not contain it.
            Self::Misread { function, .. } => {
                ["`", function.name(), "` ", function.0[1]].iter().try_for_each(|part| out.write_str(part))
            }
            Self::Undetermined { constraint, name } => write!(
                out,
                "constraint {constraint} depends on the others in this configuration, and neither velocities nor accelerations \
                 say how the motion goes on: start beside it, or with a velocity along one of the motions that meet there",
                constraint = Part(*constraint, *name)
            ),
            Self::Penetrates { constraint, name, by } => write!(
                out,
                "contact {constraint} is penetrated by {by} at the start: begin with a gap of zero or more",
                constraint = Part(*constraint, *name)
            ),
            Self::InvalidContact { constraint, name } => write!(
                out,
                "a coefficient of contact or friction {constraint} is invalid: restitution must lie between 0 and 1, friction must be \
                 finite and not negative, and the static value must not be below the kinetic one",
                constraint = Part(*constraint, *name)
            ),
            Self::NoReaction { constraint, name } => write!(
                out,
                "no reactions satisfy the laws of contact and friction at {constraint} together with the others (Painlevé's \
                 paradox): rigid bodies jam here; lower the friction, or give the contact some compliance",
                constraint = Part(*constraint, *name)
            ),
            Self::SeveralReactions { constraint, name } => write!(
                out,
                "the laws of contact and friction allow several motions, with and without a reaction at {constraint} (Painlevé's \
                 paradox): lower the friction, or give the contact some compliance",
                constraint = Part(*constraint, *name)
            ),
            Self::EndlessSwitching { constraint, name } => write!(
                out,
                "{constraint} and others switch on and off without progress: the tolerance may be too tight for this scalar, or \
                 the contacts contradict each other",
                constraint = Part(*constraint, *name)
            ),
            Self::EnergyJumps { kink, name } => write!(
                out,
                "the energy jumps where what is switched (`if`, `signum`, …) in {function} is zero: make both sides of the energy \
                 equal there, or give the force by `#[force]`",
                function = Part(*kink, *name)
            ),
            Self::MomentumJumps { kink, name } => write!(
                out,
                "momenta jump where what is switched (`abs`, `if`, …) in {function} is zero: make positions, masses and constraints \
                 smooth there, or let a `#[unilateral]` contact strike",
                function = Part(*kink, *name)
            ),
            Self::GapJumps { constraint, name } => write!(
                out,
                "{constraint} jumps to where no motion leads: a gap or constraint has to be continuous, so describe a step by a gap of its own",
                constraint = Part(*constraint, *name)
            ),
            Self::HeldAtKink { kink, name } => write!(
                out,
                "the motion is pushed from both sides to where what is switched (`abs`, `signum`, `max`, …) in {function} is zero, \
                 and would stay there: write dry friction by `#[friction]`, which can stick, give each side of a corner, as of the \
                 gap `q.y - q.x.abs()`, a gap of its own, and round any other kink off (`x.hypot(a)` for `x.abs()`)",
                function = Part(*kink, *name)
            ),
            Self::Grazes { switch, name } => write!(
                out,
                "the motion has no derivatives where it grazes {switch}: it meets the switch without speed, and motions beside it \
                 pass by; choose another start or other parameters",
                switch = Part(*switch, *name)
            ),
            Self::SwitchesCoincide { name, other } if *other == Name::NONE => write!(
                out,
                "the motion has no derivatives where it begins in an impact at `{name}`: start before or after it"
            ),
            Self::SwitchesCoincide { name, other } => write!(
                out,
                "the motion has no derivatives where `{name}` and `{other}` switch at once: which is first depends on the start; \
                 choose another start or other parameters"
            ),
            Self::ImpactsAccumulate { constraint, name } => write!(
                out,
                "derivatives end where the impacts of {constraint} come infinitely fast and close it: begin another motion with \
                 derivatives after that, or let the contact be plastic",
                constraint = Part(*constraint, *name)
            ),
            Self::Irreversible => out.write_str(
                "impacts and dry friction cannot be followed backward in time: choose a time after the present one",
            ),
            Self::StepTooLong => out.write_str(
                "the step is too long: bringing its end back onto the constraints would change more than the step did; or \
                 the energy, which is conserved, changes by more than the step can have made of it; or more switches fall \
                 into it than it has parts, or a slip in two directions begins or ends, whose friction turns faster than \
                 these follow; take shorter steps, or `simulate`",
            ),
            Self::NotFinite => out.write_str(
                "a value is infinite or not a number: check the parameters and the start, or stop before \
                 the motion reaches a singularity",
            ),
            Self::NotConverged => out.write_str(
                "the equations of an implicit step did not converge: take shorter steps where the motion is this fast",
            ),
            Self::NoEigenvalues => out.write_str(
                "no eigenvalues were found: bring the parameters to units in which masses and forces of all parts are of \
                 similar sizes",
            ),
            Self::NoVelocities => out.write_str(
                "no velocities with these momenta were found: start with momenta nearer to those of a state at rest, or check \
                 that the Lagrangian lets momenta take these values",
            ),
            Self::StepTooSmall => out.write_str(
                "the step fell below the resolution of time: the motion is singular here or too stiff, \
                 the tolerance is too tight for this scalar, the time is too far from zero, or the unit \
                 of time is far too long for this motion",
            ),
            Self::ToleranceTooFine { reachable } => write!(
                out,
                "the tolerance is below what roundings leave of the state: {reachable} can be reached from here; loosen the \
                 tolerance"
            ),
            Self::TimeTooCoarse { spacing } => write!(
                out,
                "the step is lost in the time: times that are numbers are {spacing} apart here; count time from nearer to the \
                 motion, or go by longer steps"
            ),
            Self::TooManySteps => out.write_str(
                "too many steps in one call: advance in shorter intervals, loosen the tolerance, give an absolute one \
                 where something is nearly at rest, or raise the limit with `with_max_steps`",
            ),
            Self::InvalidTime => out.write_str("the target time is not finite: pass a finite time"),
            Self::InvalidStep => out.write_str(
                "a step, sampling interval or step limit is not finite, zero or a negative limit: pass a finite length above zero",
            ),
            Self::InvalidTolerance => {
                out.write_str("a tolerance is negative or not finite: pass something like 1e-10")
            }
        }
    }
}
