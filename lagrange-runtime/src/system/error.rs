//! What can stop a motion: a cause and the time. Small, `Copy`, without strings.
//!
//! An error never loses the motion: the state stays at the last good point.

mod parts;

use core::fmt;

use crate::system::name::{Name, Names, Part};
pub(crate) use parts::magnitude;
pub use parts::{Function, Magnitude};

/// Why a motion could not go on.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Cause {
    /// The mass matrix is not positive: the coordinate with this index has no inertia of its own here, or a
    /// negative one.
    SingularMassMatrix {
        /// Index of the coordinate at which the factorisation stopped.
        pivot: usize,
        /// Its name.
        name: Name,
    },
    /// The coordinates violate a constraint: a start that is not consistent, or a step that cannot be brought
    /// back.
    PositionViolated {
        /// Index of the constraint, as in `CONSTRAINTS` of the system.
        constraint: usize,
        /// Its name.
        name: Name,
        /// |f|, in the unit of the constraint.
        by: Magnitude,
    },
    /// The velocities violate a constraint: df/dt of a holonomic one, g of a nonholonomic one.
    VelocityViolated {
        /// Index of the constraint.
        constraint: usize,
        /// Its name.
        name: Name,
        /// |df/dt| or |g|.
        by: Magnitude,
    },
    /// The search for a state on the constraints ended before it found one.
    NoConsistentState {
        /// Index of a constraint that is violated where the search ended.
        constraint: usize,
        /// Its name.
        name: Name,
        /// By how much, in its unit.
        by: Magnitude,
    },
    /// Constraints contradict each other: no state satisfies this one together with those before it.
    Contradictory {
        /// Index of the constraint.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// The gradient of a constraint vanishes, so that it restricts nothing and has no reaction.
    VanishingGradient {
        /// Index of the constraint.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// A function of the description returns something else than the macro read: a name in it means something
    /// else than usual. Only builds with `debug_assertions` look for this.
    Misread {
        /// The function, or the argument of its role.
        function: Function,
        /// By how much.
        by: Magnitude,
    },
    /// Constraints depend on each other in this configuration, and neither the velocity nor the accelerations
    /// say how the motion goes on.
    Undetermined {
        /// Index of the constraint that is closest to depending on the others.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// A contact is penetrated where a motion begins.
    Penetrates {
        /// Index of the contact, as in `CONSTRAINTS` of the system.
        constraint: usize,
        /// Its name.
        name: Name,
        /// How far, in the unit of its gap.
        by: Magnitude,
    },
    /// A coefficient of restitution is not between zero and one, or one of friction is negative or NaN, or
    /// the static one is smaller than the kinetic one.
    InvalidContact {
        /// Index of the contact or friction.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// No reactions keep the bodies apart under the laws of contact and friction: Painlevé's paradox.
    NoReaction {
        /// Index of a contact or friction whose law would be violated.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// The laws of contact and friction allow several motions: Painlevé's paradox.
    SeveralReactions {
        /// Index of a contact that may push or open.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// Contacts and frictions switch on and off without any progress.
    EndlessSwitching {
        /// Index of one of them.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// The motion is pushed from both sides to a kink or jump of the description, for example by `signum` of
    /// a velocity at rest.
    HeldAtKink {
        /// Index of the kink, in the order of the description.
        kink: usize,
        /// The function that it stands in.
        name: Name,
    },
    /// The energy has two values where a switching function is zero: an `if` on coordinates joins parts of a
    /// potential or kinetic energy that do not meet there.
    EnergyJumps {
        /// Index of the kink, in the order of the description.
        kink: usize,
        /// The function that it stands in.
        name: Name,
    },
    /// Impacts and friction cannot be followed backward in time.
    Irreversible,
    /// A fixed step is too long for the constraints: bringing its end back onto them would change the state
    /// by more than the step itself did.
    StepTooLong,
    /// A coordinate, velocity, acceleration or parameter is infinite or not a number.
    NotFinite,
    /// The equations of an implicit step were not solved: it is too long for the motion.
    NotConverged,
    /// `modes` found no eigenvalues, or they differ by more than the range of numbers.
    NoEigenvalues,
    /// No velocities with the given momenta were found.
    NoVelocities,
    /// The tolerance asks for steps below the resolution of time.
    StepTooSmall,
    /// One call took more steps than its limit.
    TooManySteps,
    /// The target time is infinite or not a number.
    InvalidTime,
    /// A step, a sampling interval or a step limit is zero, infinite or not a number.
    InvalidStep,
    /// A tolerance is negative, infinite or not a number.
    InvalidTolerance,
}

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
                "the gradient of constraint {constraint} is zero here: if the function is a square, write its base instead; otherwise \
                 stay away from this configuration",
                constraint = Part(*constraint, *name)
            ),
            // The text comes with the name, so that it is in no program that cannot need it.
            Self::Misread { function, .. } => out.write_str(function.0[1]),
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
                "a coefficient of contact {constraint} is invalid: restitution must lie between 0 and 1, friction must not be negative, \
                 and the static value must not be below the kinetic one",
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
            Self::HeldAtKink { kink, name } => write!(
                out,
                "the motion is pushed from both sides to where what is switched (`abs`, `signum`, `max`, …) in {function} is zero: \
                 for dry friction use `#[friction]`, which can stick",
                function = Part(*kink, *name)
            ),
            Self::Irreversible => out.write_str(
                "impacts and dry friction cannot be followed backward in time: choose a time after the present one",
            ),
            Self::StepTooLong => out.write_str(
                "the step is too long for the constraints: bringing its end back onto them would change more than the step \
                 did; take shorter steps",
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
                 or the tolerance is too tight for this scalar",
            ),
            Self::TooManySteps => out.write_str(
                "too many steps in one call: advance in shorter intervals, loosen the tolerance or raise \
                 the limit with `with_max_steps`",
            ),
            Self::InvalidTime => out.write_str("the target time is not finite: pass a finite time"),
            Self::InvalidStep => out.write_str(
                "a step or sampling interval is zero or not finite: pass a finite step other than zero",
            ),
            Self::InvalidTolerance => {
                out.write_str("a tolerance is negative or not finite: pass something like 1e-10")
            }
        }
    }
}

impl core::error::Error for Cause {}

impl Cause {
    /// The same with the names of a system.
    #[cold]
    pub(crate) fn named(mut self, names: &Names) -> Self {
        match &mut self {
            Self::SingularMassMatrix { pivot, name } => *name = names.coordinate(*pivot),
            Self::PositionViolated { constraint, name, .. }
            | Self::VelocityViolated { constraint, name, .. }
            | Self::NoConsistentState { constraint, name, .. }
            | Self::Contradictory { constraint, name }
            | Self::VanishingGradient { constraint, name }
            | Self::Penetrates { constraint, name, .. }
            | Self::InvalidContact { constraint, name }
            | Self::NoReaction { constraint, name }
            | Self::SeveralReactions { constraint, name }
            | Self::EndlessSwitching { constraint, name }
            | Self::Undetermined { constraint, name } => *name = names.constraint(*constraint),
            Self::Misread { .. }
            | Self::HeldAtKink { .. }
            | Self::EnergyJumps { .. }
            | Self::Irreversible
            | Self::StepTooLong
            | Self::NotFinite
            | Self::NotConverged
            | Self::NoEigenvalues
            | Self::NoVelocities
            | Self::StepTooSmall
            | Self::TooManySteps
            | Self::InvalidTime
            | Self::InvalidStep
            | Self::InvalidTolerance => {}
        }
        self
    }
}

/// A motion that could not go on, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionError<R> {
    /// Why.
    pub cause: Cause,
    /// Time of the last good point \[s].
    pub t: R,
}

impl<R> MotionError<R> {
    /// The same with the names of a system. For generated code.
    #[doc(hidden)]
    #[must_use]
    pub fn named(self, names: &Names) -> Self {
        Self { cause: self.cause.named(names), t: self.t }
    }
}

impl<R: fmt::Debug> fmt::Display for MotionError<R> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "at t = {:?}: {}", self.t, self.cause)
    }
}

impl<R: fmt::Debug> core::error::Error for MotionError<R> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.cause)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::string::ToString;

    #[test]
    fn messages_name_the_time_the_coordinate_and_the_remedy() {
        let text = MotionError { cause: Cause::SingularMassMatrix { pivot: 3, name: Name::NONE }, t: 1.5 }
            .to_string();
        for part in ["t = 1.5", "coordinate 3", "give that coordinate a mass"] {
            assert!(text.contains(part), "{part} is missing in {text}");
        }
    }

    #[test]
    fn messages_have_the_names_of_the_system() {
        let names = Names { coordinates: &["phi", "theta"], constraints: &["rod", "hinge[1]"] };
        let cause = Cause::SingularMassMatrix { pivot: 1, name: Name::NONE }.named(&names);
        assert!(cause.to_string().contains("at coordinate `theta`: give"), "{cause}");
        let cause = Cause::Contradictory { constraint: 1, name: Name::NONE }.named(&names);
        assert!(cause.to_string().starts_with("constraint `hinge[1]` contradicts"), "{cause}");
        let beyond = Cause::Undetermined { constraint: 2, name: Name::NONE }.named(&names);
        assert!(beyond.to_string().starts_with("constraint 2 depends"), "{beyond}");
    }

    #[test]
    fn magnitudes_have_two_digits() {
        for (value, text) in
            [(0.0, "0.0e0"), (1.0, "1.0e0"), (0.0211, "2.1e-2"), (996.0, "1.0e3"), (6.5e-30, "6.5e-30")]
        {
            assert_eq!(Magnitude(value).to_string(), text);
        }
        assert_eq!(Magnitude(f32::INFINITY).to_string(), "more than any number");
    }

    #[test]
    fn an_error_is_small() {
        assert!(size_of::<Cause>() <= 3 * size_of::<usize>());
    }
}
