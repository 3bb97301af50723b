//! The energy as a check of a step. If the macro has proved that it is conserved, any change of it in a step
//! is an error. It also shows a jump to another motion that obeys the equations as well.

use super::{Check, relative};
use crate::constraints::Footing;
use crate::number::elements::Each;
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::state::State;

/// Rounding errors of the energy itself, in ulps: it is a sum of a few terms.
const ULPS: f64 = 4.0;

impl<S: System<N, K>, const N: usize, const K: usize> Check<'_, S, N, K>
where
    S::Scalar: Ordered,
{
    /// Whether a step to this end keeps the energy, if it is conserved. Its change may be what errors within
    /// the tolerance make of it, one in each coordinate and velocity.
    #[inline]
    pub(crate) fn keeps_energy(&self, end: &State<S::Scalar, N>, footing: &Footing<S::Scalar, N>) -> bool {
        if !S::CONSERVES_ENERGY {
            return true;
        }
        let here = self.energy(end);
        let change = (here - self.energy(self.from)).abs();
        // In the kinetic metric squares of velocities are energies, so this is less than the sum over all.
        let speed = footing.metric.extent(&end.v);
        change <= relative(self.limits) * speed * speed || change <= self.tolerated_energy(end, footing, here)
    }

    /// The change of the energy by errors within the tolerance, with its rounding errors.
    #[cold]
    #[inline(never)]
    fn tolerated_energy(
        &self,
        end: &State<S::Scalar, N>,
        footing: &Footing<S::Scalar, N>,
        here: S::Scalar,
    ) -> S::Scalar {
        let sizes = self.sizes(end, (end.t - self.from.t).abs(), footing);
        let [q, v] =
            sizes.of.each(|size| footing.metric.at_extent(relative(self.limits) * size + sizes.absolute));
        S::Scalar::from_f64(ULPS) * S::Scalar::epsilon() * here.abs()
            + blurred(self.system, self.constants, end, [q, v])
    }

    fn energy(&self, state: &State<S::Scalar, N>) -> S::Scalar {
        energy(self.system, self.constants, state)
    }
}

/// Whether a step has changed the energy so little that half of the digits of the kinetic energy are right.
#[inline]
pub(crate) fn is_kept<S, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    from: &State<S::Scalar, N>,
    end: &State<S::Scalar, N>,
) -> bool
where
    S: System<N, K>,
{
    let energy = |state: &State<S::Scalar, N>| energy(system, constants, state);
    let here = energy(end);
    let kinetic = (here - energy(&State { v: [num_traits::Zero::zero(); N], ..*end })).abs();
    let excess = (here - energy(from)).abs() - S::Scalar::epsilon().sqrt() * kinetic;
    excess.largest() <= num_traits::Zero::zero()
}

/// The energy without derivatives.
pub(crate) fn energy<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
) -> S::Scalar {
    system.energy_at(constants, state.t, &state.q, &state.v).part(0)
}

/// The uncertainty of the energy at a state: the sum of its changes by errors of each coordinate and
/// velocity.
#[cold]
#[inline(never)]
pub(crate) fn blurred<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    [q, v]: [[S::Scalar; N]; 2],
) -> S::Scalar {
    let here = energy(system, constants, state);
    let mut sum: S::Scalar = num_traits::Zero::zero();
    for i in 0..N {
        for (by_q, by_v) in [(q[i], num_traits::Zero::zero()), (num_traits::Zero::zero(), v[i])] {
            let mut beside = *state;
            beside.q[i] += by_q;
            beside.v[i] += by_v;
            sum += (energy(system, constants, &beside) - here).abs();
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use super::*;
    use crate::constraints::samples::Twofold;
    use crate::system::limits::Limits;

    #[test]
    fn a_change_of_the_energy_is_held_against_the_tolerance() {
        let rod = Twofold { factored: Cell::new(0) };
        let from = State::new([0.8, -0.6], [0.6, 0.8]);
        for (tolerance, change, is_kept) in [
            (1e-10, 0.0, true),
            (1e-10, 4e-11, true),
            (1e-10, 1e-8, false),
            (1e-6, 1e-8, true),
            (1e-6, 1e-4, false),
            (1e-14, 1e-14, true),
            (1e-14, 1e-11, false),
        ] {
            let limits = Limits { relative: tolerance, ..Limits::new() };
            let check = Check { system: &rod, constants: &(), inputs: &[], limits: &limits, from: &from };
            let mut end = State { v: from.v.map(|v| v * (1.0 + change)), ..from }.at_time(1e-3);
            let footing = rod.land_at(&(), &mut end.clone(), None).unwrap();
            assert_eq!(check.keeps_energy(&end, &footing), is_kept, "{change} at {tolerance}");
            end.v = end.v.map(|v| -v);
            assert_eq!(check.keeps_energy(&end, &footing), is_kept, "{change} backward");
        }
    }

    #[test]
    fn an_error_of_a_place_is_one_of_its_potential() {
        let rod = Twofold { factored: Cell::new(0) };
        // At rest velocities have no size.
        let from = State::new([1.0, 0.0], [0.0, 0.0]);
        for (fallen, is_kept) in [(1e-11, true), (1e-8, false)] {
            let limits = Limits::new();
            let check = Check { system: &rod, constants: &(), inputs: &[], limits: &limits, from: &from };
            let end = State::new([1.0, -fallen], [0.0, 0.0]);
            let footing = rod.land_at(&(), &mut end.clone(), None).unwrap();
            assert_eq!(check.keeps_energy(&end, &footing), is_kept, "{fallen}");
        }
    }

    /// A point that nothing acts on.
    struct Free;

    impl System<2> for Free {
        type Scalar = f64;
        type Method = crate::integrator::Dop853;
        type Constants = ();

        const CONSERVES_ENERGY: bool = true;

        fn constants(&self) {}

        fn accelerations_at(&self, (): &(), _: f64, _: &[f64; 2], _: &[f64; 2], _: &[f64; 0]) -> [f64; 2] {
            [0.0; 2]
        }

        fn energy_at(&self, (): &(), _: f64, _: &[f64; 2], v: &[f64; 2]) -> f64 {
            0.5 * (v[0] * v[0] + v[1] * v[1])
        }
    }

    #[test]
    fn the_energy_is_known_to_the_tolerance_at_any_speed() {
        let rod = Twofold { factored: Cell::new(0) };
        let footing = rod.land_at(&(), &mut State::new([0.8, -0.6], [0.6, 0.8]), None).unwrap();
        for speed in [1e-9, 1e-3, 1.0, 1e3, 1e9] {
            let from = State::new([0.8, -0.6], [0.6 * speed, 0.8 * speed]);
            let limits = Limits::new();
            let check = Check { system: &Free, constants: &(), inputs: &[], limits: &limits, from: &from };
            for (change, is_kept) in [(1e-11, true), (1e-8, false)] {
                let end = State { v: from.v.map(|v| v * (1.0 + change)), ..from }.at_time(1e-3 / speed);
                assert_eq!(check.keeps_energy(&end, &footing), is_kept, "{change} at {speed}");
            }
        }
    }
}
