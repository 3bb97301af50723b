//! The energy as a check of fixed steps, where the macro has proved that it is conserved.
//!
//! A step of fixed length has no promised accuracy, but an order: if it is short enough, its halves together
//! lose a quarter at most of its own loss. Beside a configuration in which constraints depend on each other a
//! step may lose anything, and its halves as well.

use crate::integrator::landing::NOISE;
use crate::integrator::landing::energy::{blurred, energy};
use crate::number::real::Real;
use crate::system::System;
use crate::system::error::Cause;
use crate::system::footing::Footing;
use crate::system::method::FixedStep;
use crate::system::state::State;

/// How often a step is halved at most.
const HALVINGS: i32 = 6;

/// The largest loss of the halves of a step, as a part of its own: any method is of the second order at
/// least.
const QUARTER: f64 = 0.25;

/// The end of a step that has changed the energy by more than `is_kept` allows, in as many parts as obey the
/// order. Where constraints are far apart the loss is that of the caller's length, and the step stands.
///
/// # Errors
/// [`Cause::StepTooLong`] where no number of parts obeys it, and why parts cannot be taken.
#[cold]
#[inline(never)]
pub(super) fn mended<S, M, const N: usize, const K: usize>(
    memory: &mut M::Memory,
    system: &S,
    constants: &S::Constants,
    [from, end]: [&State<S::Scalar, N>; 2],
    h: S::Scalar,
    u: &[S::Scalar; K],
) -> Result<State<S::Scalar, N>, Cause>
where
    S: System<N, K>,
    M: FixedStep<S, N, K>,
{
    let there = system.land_at(constants, &mut end.clone(), None)?;
    if there.independence.are_far_apart() {
        return Ok(*end);
    }
    let lost = |state: &State<S::Scalar, N>| {
        (energy(system, constants, state) - energy(system, constants, from)).abs()
    };
    let noise = roundings(system, constants, end, &there);
    let is_noise = |lost: S::Scalar| (lost - noise).largest() <= num_traits::Zero::zero();
    let mut before = lost(end);
    if is_noise(before) {
        return Ok(*end);
    }
    for halvings in 1..=HALVINGS {
        let parts = 1_u32 << halvings;
        let part = h * S::Scalar::from_f64(0.5).powi(halvings);
        let mut state = *from;
        for _ in 0..parts {
            let mut next = M::step(memory, system, constants, &state, part, u)?;
            if !next.is_finite() {
                return Err(Cause::StepTooLong);
            }
            system.project_at(constants, &mut next, Some(&state))?;
            state = next;
        }
        let after = lost(&state);
        let excess = after - S::Scalar::from_f64(QUARTER) * before;
        if is_noise(after) || excess.largest() <= num_traits::Zero::zero() {
            return Ok(state.at_time(end.t));
        }
        before = after;
    }
    Err(Cause::StepTooLong)
}

/// The effect of rounding errors of the coordinates on the energy, and the energy's own.
fn roundings<S, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    footing: &Footing<S::Scalar, N>,
) -> S::Scalar
where
    S: System<N, K>,
{
    let none = [num_traits::Zero::zero(); N];
    let own = S::Scalar::epsilon() * energy(system, constants, state).abs();
    S::Scalar::from_f64(NOISE) * (own + blurred(system, constants, state, [footing.ulps_q, none]))
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use super::*;
    use crate::constraints::samples::Twofold;
    use crate::integrator::Rk4;
    use crate::integrator::landing::energy::is_kept;

    /// A method that loses a tenth of the velocity in each step, whatever its length.
    #[derive(Clone, Copy, Debug)]
    struct Leaky;

    impl<S: System<N, K>, const N: usize, const K: usize> FixedStep<S, N, K> for Leaky {
        type Memory = ();

        fn begin(_: &S) {}

        fn step(
            (): &mut (),
            system: &S,
            constants: &S::Constants,
            from: &State<S::Scalar, N>,
            h: S::Scalar,
            u: &[S::Scalar; K],
        ) -> Result<State<S::Scalar, N>, Cause> {
            let mut next = <Rk4 as FixedStep<S, N, K>>::step(&mut (), system, constants, from, h, u)?;
            next.v = next.v.map(|v| S::Scalar::from_f64(0.9) * v);
            Ok(next)
        }
    }

    fn rod() -> (Twofold, State<f64, 2>) {
        (Twofold { factored: Cell::new(0) }, State::new([0.8, -0.6], [0.6, 0.8]))
    }

    #[test]
    fn a_step_that_loses_energy_whatever_its_length_is_an_error() {
        let (rod, start) = rod();
        let error = rod.stepper::<Leaky>(start).step(1e-3, &[]).unwrap_err();
        assert_eq!(error.cause, Cause::StepTooLong);
    }

    #[test]
    fn a_long_step_that_obeys_its_order_is_taken_in_parts() {
        let (rod, start) = rod();
        let (mut motion, energy) = (rod.stepper::<Rk4>(start), rod.energy_at(&(), 0.0, &start.q, &start.v));
        let next = *motion.step(0.3, &[]).unwrap();
        assert!(next.t == 0.3 && motion.state().t == 0.3);
        let plain = <Rk4 as FixedStep<Twofold, 2, 0>>::step(&mut (), &rod, &(), &start, 0.3, &[]).unwrap();
        let lost = |end: &State<f64, 2>| (rod.energy_at(&(), 0.0, &end.q, &end.v) - energy).abs();
        assert!(!is_kept(&rod, &(), &start, &plain), "{}", lost(&plain));
        assert!(lost(&next) < QUARTER * lost(&plain), "{} of {}", lost(&next), lost(&plain));
    }

    #[test]
    fn a_short_step_is_taken_as_it_is() {
        let (rod, start) = rod();
        let mut motion = rod.stepper::<Rk4>(start);
        let next = *motion.step(1e-3, &[]).unwrap();
        assert!(is_kept(&rod, &(), &start, &next));
    }
}
