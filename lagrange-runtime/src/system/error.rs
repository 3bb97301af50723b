//! Errors that stop a motion: a cause and the time. Small, `Copy`, without strings.
//!
//! An error never loses the motion: the state stays at the last good point.

mod display;
mod parts;

use core::fmt;

use crate::system::name::{Name, Names};
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
    /// The gradient of a constraint or of a gap vanishes or has no value, as that of a distance has none at
    /// its centre: it restricts nothing and has no reaction.
    VanishingGradient {
        /// Index of the constraint.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// The gradient of a constraint turns with time, so that small deviations from a state have no linear
    /// equations with constant coefficients.
    TurningConstraint {
        /// Index of the constraint.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// A function of the description returns another value than the macro has read: a name in it has an
    /// unusual meaning. Only builds with `debug_assertions` look for this.
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
    /// A momentum, or the rate of a constraint, has two values where a switching function is zero, so that no
    /// force of finite size leads across: a corner in a position or a constraint, or a mass that jumps.
    MomentumJumps {
        /// Index of the kink, in the order of the description.
        kink: usize,
        /// The function that it stands in.
        name: Name,
    },
    /// A gap has two values where a switching function is zero, and the contact is closed there or would be
    /// penetrated; or a constraint has two values there.
    GapJumps {
        /// Index of the contact or constraint, in the order of `Names::constraints`.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// A motion with derivatives meets a switch without speed, or begins at a contact that touches and bears
    /// nothing. So it has none: a start beside this one passes by.
    Grazes {
        /// Index of the constraint or kink.
        switch: usize,
        /// Its name: that of the contact, the friction or the function with the kink.
        name: Name,
    },
    /// A motion with derivatives meets two switches at once, so that it has none: which is first depends on
    /// the start.
    SwitchesCoincide {
        /// The name of one of them.
        name: Name,
        /// That of the other one; empty where the motion begins in an impact.
        other: Name,
    },
    /// A motion with derivatives comes to infinitely many impacts in finite time, through which none are
    /// computed.
    ImpactsAccumulate {
        /// Index of the contact.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// Impacts and friction cannot be followed backward in time.
    Irreversible,
    /// A fixed step is too long for the constraints. Bringing its end back onto them would change the state
    /// by more than the step itself, or the energy, which is conserved, changes by more than stages of the
    /// step differ. Or contacts and frictions switch more often in it than it has parts.
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
    /// The tolerance is finer than the rounding errors of a state of the motion, so that no step goes on from
    /// it.
    ToleranceTooFine {
        /// The finest relative tolerance that leads on from there.
        reachable: Magnitude,
    },
    /// Numbers are so far apart at this time that a step or sampling interval leads back to it.
    TimeTooCoarse {
        /// The distance of the next time that is a number \[s].
        spacing: Magnitude,
    },
    /// One call took more steps than its limit.
    TooManySteps,
    /// The target time is infinite or not a number.
    InvalidTime,
    /// A step, a sampling interval or a step limit is zero, infinite or not a number, or a limit is negative.
    InvalidStep,
    /// A tolerance is negative, infinite or not a number.
    InvalidTolerance,
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
            | Self::GapJumps { constraint, name }
            | Self::TurningConstraint { constraint, name }
            | Self::SeveralReactions { constraint, name }
            | Self::EndlessSwitching { constraint, name }
            | Self::Undetermined { constraint, name } => *name = names.constraint(*constraint),
            Self::Misread { .. }
            | Self::HeldAtKink { .. }
            | Self::EnergyJumps { .. }
            | Self::MomentumJumps { .. }
            | Self::Grazes { .. }
            | Self::SwitchesCoincide { .. }
            | Self::ImpactsAccumulate { .. }
            | Self::Irreversible
            | Self::StepTooLong
            | Self::NotFinite
            | Self::NotConverged
            | Self::NoEigenvalues
            | Self::NoVelocities
            | Self::StepTooSmall
            | Self::ToleranceTooFine { .. }
            | Self::TimeTooCoarse { .. }
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
