//! [`Stepper`]: a motion in steps that the caller chooses, as a control loop does.
//!
//! There is no error control: the accuracy follows from the order of the method and the step of the caller. A
//! method that would go wrong on a system does not compile. Time is summed with compensation, so a million
//! steps of 1 ms end within one ulp of 1000 s.

mod energy;

use crate::constraints::{Constrained, Reactions};
use crate::integrator::landing::energy::is_kept;
use crate::number::real::Real;
use crate::system::attitude;
use crate::system::error::{Cause, MotionError};
use crate::system::method::FixedStep;
use crate::system::state::State;
use crate::system::{System, check_masses, diagnose};

/// A motion of `system` in fixed steps by method `M`.
#[derive(Clone, Copy, Debug)]
pub struct Stepper<'a, S: System<N, K>, M: FixedStep<S, N, K>, const N: usize, const K: usize = 0> {
    system: &'a S,
    constants: S::Constants,
    memory: M::Memory,
    state: State<S::Scalar, N>,
    /// The residue of rounding of the time. NaN until the start has been checked, and for masses that are not
    /// positive.
    residue: S::Scalar,
}

impl<'a, S, M, const N: usize, const K: usize> Stepper<'a, S, M, N, K>
where
    S: System<N, K>,
    M: FixedStep<S, N, K>,
{
    /// A motion from `start`.
    #[inline]
    pub fn new(system: &'a S, start: State<S::Scalar, N>) -> Self {
        const {
            assert!(
                !S::SWITCHED || M::SWITCHES,
                "this system has contacts or dry friction, which this method does not see: use `stepper::<Jet<…>>(…)` or `simulate(…)`"
            );
        }
        let constants = system.constants();
        // The start of a constrained motion is checked by the first step; there is no room to remember that
        // in the stepper of a system without constraints. Where masses are not positive no step has a
        // time.
        let is_good = || check_masses(system, &constants, &start).is_ok();
        let residue =
            S::Scalar::from_f64(if S::CONSTRAINED || S::READ || !is_good() { f64::NAN } else { 0.0 });
        Self { system, constants, memory: M::begin(system), state: start, residue }
    }

    /// Goes on by `h` \[s] (backward if negative) with the inputs `u` held, and returns the state there.
    ///
    /// # Errors
    /// [`Cause::InvalidStep`] for an `h` that is not finite; where the result is not, the cause at the state
    /// before the step: [`Cause::SingularMassMatrix`] or [`Cause::NotFinite`]; [`Cause::NotConverged`] of
    /// an implicit method. With constraints, [`Cause::PositionViolated`] or `VelocityViolated` for a start
    /// off them, [`Cause::StepTooLong`], and what is wrong with the constraints themselves; with contacts or
    /// dry friction, why the motion cannot go through them. The state is then still that before the step.
    #[inline]
    pub fn step(
        &mut self,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<&State<S::Scalar, N>, MotionError<S::Scalar>> {
        if !h.is_finite() {
            return Err(MotionError { cause: Cause::InvalidStep, t: self.state.t });
        }
        if (S::CONSTRAINED || S::READ) && !self.residue.is_finite() {
            crate::system::reading::checked(self.system, &self.state, u)?;
            self.check_start()?;
        }
        let from = &self.state;
        let step = M::step(&mut self.memory, self.system, &self.constants, from, h, u);
        let mut next = step.map_err(|cause| MotionError { cause, t: from.t })?;
        let increment = h + self.residue;
        next.t = from.t + increment;
        if !next.is_finite() {
            let cause = diagnose(self.system, &self.constants, from.t, &from.q, &from.v);
            return Err(MotionError { cause, t: from.t });
        }
        self.system
            .project_at(&self.constants, &mut next, Some(from))
            .map_err(|cause| MotionError { cause, t: from.t })?;
        if S::COUPLED && S::CONSERVES_ENERGY && !is_kept(self.system, &self.constants, from, &next) {
            let (system, constants, ends) = (self.system, &self.constants, [from, &next]);
            next = energy::mended::<S, M, N, K>(&mut self.memory, system, constants, ends, h, u)
                .map_err(|cause| MotionError { cause, t: from.t })?;
        }
        if S::JUMPS && !M::SWITCHES {
            self.system.passed_at(from, &next, u).map_err(|cause| MotionError { cause, t: from.t })?;
        }
        self.residue = increment - (next.t - from.t);
        if let Some(settled) = attitude::settle(S::ORIENTATIONS, &next) {
            (next, self.memory) = (settled, M::begin(self.system));
        }
        self.state = next;
        Ok(&self.state)
    }

    /// Refuses a start that violates constraints or has masses that are not positive, and removes rounding
    /// errors across the constraints.
    #[cold]
    fn check_start(&mut self) -> Result<(), MotionError<S::Scalar>> {
        let mut start = self.state;
        check_masses(self.system, &self.constants, &start)?;
        self.system
            .begin_at(&self.constants, &mut start)
            .map_err(|cause| MotionError { cause, t: start.t })?;
        (self.state, self.residue) = (start, num_traits::Zero::zero());
        Ok(())
    }

    /// The state after the last good step.
    #[inline]
    pub fn state(&self) -> &State<S::Scalar, N> {
        &self.state
    }

    /// T + V at the state.
    #[inline]
    pub fn energy(&self) -> S::Scalar {
        self.system.energy_at(&self.constants, self.state.t, &self.state.q, &self.state.v)
    }
}

impl<S, M, const N: usize, const K: usize> Stepper<'_, S, M, N, K>
where
    S: Constrained<N, K>,
    M: FixedStep<S, N, K>,
{
    /// The multipliers of all constraints at the state under the inputs `u`, by name.
    #[inline]
    pub fn reactions(&self, u: &[S::Scalar; K]) -> Reactions<S::Reactions> {
        let State { t, q, v } = &self.state;
        self.system.reactions_at(&self.constants, *t, q, v, u)
    }
}
