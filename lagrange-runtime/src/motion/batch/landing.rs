//! The end of a step of a constrained batch: on the constraints, lane by lane, at a state that can be checked
//! and from which the motion goes on well.

use core::iter::once;

use super::Batch;
use crate::integrator::hidden::InEquations;
use crate::integrator::landing::NOISE;
use crate::integrator::landing::energy::{blurred, energy};
use crate::integrator::lengths::{PARTS, enough};
use crate::integrator::vanishing::near_roots;
use crate::linear::determined;
use crate::number::compensated::add;
use crate::number::elements::{Each, array};
use crate::number::real::{Real, any};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::metric::Metric;
use crate::system::smooth::Smooth;
use crate::system::state::State;

/// A step that is still wrong after all [`PARTS`] is shortened to this part, again and again.
const HALF: f64 = 0.5;

/// A state and its residue of rounding.
type Reached<R, const N: usize> = (State<R, N>, State<R, N>);

/// The end of a step.
struct Landing<R, const N: usize> {
    state: State<R, N>,
    residue: State<R, N>,
    /// How independent constraints are there.
    least: R,
    /// The energy that was lost beyond the tolerance; positive in lanes that have to take another length.
    lost: R,
}

impl<S: Smooth<N, K>, const N: usize, const K: usize> Batch<'_, S, N, K> {
    /// Goes on by `length` \[s], without direction, or by other lengths in lanes where that one ends badly.
    /// `missing` is positive in lanes that have not arrived; the others have steps of no length.
    pub(super) fn land(
        &mut self,
        mut length: S::Scalar,
        orders: usize,
        direction: S::Scalar,
        [missing, resolution]: [S::Scalar; 2],
    ) -> Result<S::Scalar, Cause> {
        let constants = self.system.constants();
        if !self.least.is_positive() {
            let here = self.system.land_at(&constants, &mut self.state.clone(), None)?;
            self.least = here.independence.least.max(S::Scalar::epsilon());
        }
        let natural = length;
        // Ends that are good enough come first, and then any at which the state is determined.
        let wanted = [enough(self.least, S::Scalar::splat(self.tolerance)), self.least.min(determined())];
        let mut tries =
            wanted.into_iter().flat_map(|least| once(1.0).chain(PARTS).map(move |part| (part, least)));
        let (_, mut wanted) = tries.next().unwrap_or((1.0, wanted[1]));
        loop {
            let landing = self.landing(&constants, direction * length, length / self.unit, orders);
            let (excess, cause) = match landing {
                Ok(landing) => {
                    let excess = landing.lost.max(wanted - landing.least);
                    if excess.largest() <= num_traits::Zero::zero() {
                        (self.state, self.residue, self.least) =
                            (landing.state, landing.residue, landing.least);
                        return Ok(length);
                    }
                    (excess, Cause::StepTooSmall)
                }
                // The error does not tell which lane it is.
                Err(cause) => (num_traits::One::one(), cause),
            };
            let other = match tries.next() {
                Some((part, least)) => {
                    wanted = least;
                    S::Scalar::from_f64(part) * natural
                }
                None => S::Scalar::from_f64(HALF) * length,
            };
            length = other.where_positive(excess, length);
            if any(missing.min(resolution - length)) {
                return Err(cause);
            }
        }
    }

    /// The state after `h` \[s], which are `theta` units, on the constraints.
    fn landing(
        &self,
        constants: &S::Constants,
        h: S::Scalar,
        theta: S::Scalar,
        orders: usize,
    ) -> Result<Landing<S::Scalar, N>, Cause> {
        let (mut state, mut residue) = self.reached(h, theta, orders)?;
        let free = state;
        let footing = self.system.land_at(constants, &mut state, None)?;
        for i in 0..N {
            // A residue belongs to the number that was rounded.
            if state.q[i] != free.q[i] {
                residue.q[i] = num_traits::Zero::zero();
            }
            if state.v[i] != free.v[i] {
                residue.v[i] = num_traits::Zero::zero();
            }
        }
        let least = footing.independence.least;
        let lost = lost(self.system, constants, [&self.state, &state], &footing.metric, self.tolerance);
        if !(least.is_finite() && lost.is_finite()) {
            return Err(Cause::NotFinite);
        }
        Ok(Landing { state, residue, least, lost })
    }

    /// The state after `h` \[s], which are `theta` units, by the series, and its residue of rounding.
    pub(super) fn reached(
        &self,
        h: S::Scalar,
        theta: S::Scalar,
        orders: usize,
    ) -> Result<Reached<S::Scalar, N>, Cause> {
        let (gain_q, gain_v) = self.series.gain(theta, orders);
        let (mut state, mut residue) = (self.state, self.residue);
        (state.t, residue.t) = add(state.t, residue.t, h);
        for i in 0..N {
            (state.q[i], residue.q[i]) = add(state.q[i], residue.q[i], gain_q[i]);
            (state.v[i], residue.v[i]) = add(state.v[i], residue.v[i], gain_v[i]);
        }
        if state.is_finite() { Ok((state, residue)) } else { Err(Cause::NotFinite) }
    }

    /// Whether a root comes near zero in some lane on a step.
    #[inline]
    pub(super) fn comes_near_roots(&self, length: S::Scalar, direction: S::Scalar, orders: usize) -> bool {
        let (gain_q, gain_v) = self.series.gain(length / self.unit, orders);
        let State { t, q, v } = &self.state;
        let moved = |from: &[S::Scalar; N], gain: [S::Scalar; N]| array(|i| from[i] + gain[i]);
        let end = State { t: *t + direction * length, q: moved(q, gain_q), v: moved(v, gain_v) };
        let hiding = InEquations { system: self.system, control: &Held(self.inputs), roots: true };
        any(near_roots(&hiding, [&self.state, &end], direction * length))
    }
}

/// The change of the energy from one state to another, where the energy is conserved, beyond the effect of
/// errors of all numbers within the tolerance.
pub(super) fn lost<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    [from, end]: [&State<S::Scalar, N>; 2],
    metric: &Metric<S::Scalar, N>,
    tolerance: <S::Scalar as Real>::Lane,
) -> S::Scalar {
    if !S::CONSERVES_ENERGY {
        return -S::Scalar::epsilon();
    }
    let here = energy(system, constants, end);
    let change = (here - energy(system, constants, from)).abs();
    let relative = S::Scalar::splat(tolerance).max(S::Scalar::from_f64(NOISE) * S::Scalar::epsilon());
    let speed = metric.extent(&end.v);
    let by_speed = change - relative * speed * speed;
    if by_speed.largest() <= num_traits::Zero::zero() {
        return by_speed;
    }
    let size = metric.extent(&end.q).max(speed * (end.t - from.t).abs());
    let [q, v] = [size, speed].each(|size| metric.at_extent(relative * size));
    let own = S::Scalar::from_f64(NOISE) * S::Scalar::epsilon() * here.abs();
    // The lanes that need the second bound.
    (change - own - blurred(system, constants, end, [q, v])).where_positive(by_speed, by_speed)
}
