//! Whether a step of a series obeys the equations of motion.
//!
//! A series knows the motion from where it starts. What rounding or underflow hides there (a wall far away, a
//! switch that is thrown later) is not in its coefficients, and their decay says nothing of it. So the
//! accelerations are compared at some places of the step with those of the polynomial.

use super::super::agreement::{Agreement, roundings};
use super::super::hidden::{InEquations, PLACES, Passage, SAMPLES, sample};
use crate::number::elements::{Each, array};
use crate::number::real::{Real, any};
use crate::system::control::{Control, Held};
use crate::system::smooth::{Series, Smooth};
use crate::system::state::State;

/// The largest ratio of a step to the one before it.
const GROWTH: f64 = 2.0;

/// The largest first step, as a part of the time to go.
const FIRST: f64 = 1.0 / 16.0;

/// Limits the growth of a step of this `length`, so that it does not jump over what is far away. `last` is
/// the length of the step before it, or zero, and `left` the time to go.
pub(crate) fn restrained<R: Real>(length: R, last: R, left: R) -> R {
    length.min(if last.is_positive() { R::from_f64(GROWTH) * last } else { R::from_f64(FIRST) * left })
}

/// The lanes in which the equations disagree, at [`PLACES`] places of the first `theta` units, the last of
/// which is the end, and between them where a velocity passes zero, since laws of friction have their
/// narrowest features there, and where functions of a coordinate or of time may
/// [hide](super::super::hidden): one there, and zero in the others. All places are examined, so that no
/// strong force is missed; `look` gives the lanes that disagree at one, and is told whether it is the end.
pub(super) fn faults_along<S, C, P, const N: usize, const K: usize>(
    passage: &Passage<'_, InEquations<'_, S, C, K>, S::Scalar, P>,
    start: &State<S::Scalar, N>,
    mut look: impl FnMut(S::Scalar, &State<S::Scalar, N>, bool) -> S::Scalar,
) -> S::Scalar
where
    S: Smooth<N, K>,
    C: Control<S::Scalar, N, K>,
    P: Fn(S::Scalar) -> State<S::Scalar, N>,
{
    let (theta, state_at) = (passage.theta, passage.state_at);
    let apart = theta * S::Scalar::from_f64(1.0 / PLACES as f64);
    let zero: S::Scalar = num_traits::Zero::zero();
    let mut states = [*start; SAMPLES];
    let (mut place, mut before, mut faults) = (zero, start.v, zero);
    for (index, state) in states.iter_mut().enumerate().take(PLACES + 1).skip(1) {
        let last: S::Scalar = place;
        place += apart;
        *state = state_at(place);
        faults = faults.max(look(place, state, index == PLACES));
        let v = |part: S::Scalar| state_at(last + part * apart).v;
        for part in stops(&before, &state.v, v).into_iter().flatten() {
            let theta = last + part * apart;
            faults = faults.max(look(theta, &state_at(theta), false));
        }
        before = state.v;
    }
    if any(faults) || !(S::STEEP || S::ROOTED) {
        return faults;
    }
    if let Some(between) = states.last_mut() {
        *between = state_at(apart * S::Scalar::from_f64(sample(PLACES + 1)));
    }
    passage.look(&states, |theta| look(theta, &state_at(theta), false))
}

/// Where velocities pass zero between two places: the part of the way, and all of it in lanes that do not
/// stop.
fn stops<R: Real, const N: usize>(
    before: &[R; N],
    after: &[R; N],
    v: impl Fn(R) -> [R; N],
) -> [Option<R>; N] {
    let one = R::one();
    let passes = |from: R, to: R| (from / (from - to)).part(0);
    let inside = |part: R| part.min(one - part);
    array(|i| {
        let (from, to) = (before[i], after[i]);
        let part = passes(from, to);
        if !any(inside(part)) {
            return None;
        }
        let part = part.where_positive(inside(part), one);
        // One more secant, since the place may be narrow.
        let middle = v(part)[i];
        let nearer = part * passes(from, middle);
        let beyond = part + (one - part) * passes(middle, to);
        let other = beyond.where_positive(inside(beyond), part);
        Some(nearer.where_positive(inside(nearer), other))
    })
}

/// A series, and the equations that it is compared with.
pub(crate) struct Probe<'a, S: Smooth<N, K>, const N: usize, const K: usize, const P: usize> {
    pub system: &'a S,
    pub constants: &'a S::Constants,
    pub inputs: &'a [S::Scalar; K],
    pub start: &'a State<S::Scalar, N>,
    pub series: &'a Series<S::Scalar, N, P>,
    pub orders: usize,
    /// Unit of time \[s] with the direction of the motion.
    pub unit: S::Scalar,
    /// Tolerances of velocities, relative and absolute.
    pub tolerances: [S::Scalar; 2],
}

impl<S: Smooth<N, K>, const N: usize, const K: usize, const P: usize> Probe<'_, S, N, K, P> {
    /// The lanes in which the first `theta` units do not agree with the equations of motion: one there, and
    /// zero in the others. `known` are the largest accelerations so far, whose rounding errors count as
    /// agreement. Where the series agrees, they include those found here.
    pub fn faults(&self, theta: S::Scalar, known: &mut [S::Scalar; N]) -> S::Scalar {
        let mut strongest = *known;
        let faults = self.compared(theta, &mut strongest);
        *known = array(|i| known[i].where_positive(faults, strongest[i]));
        faults
    }

    /// The strongest acceleration at the start, as that of every coordinate: its rounding errors count where
    /// roots are looked at. There a force on one part of a system may be nothing but such errors.
    pub fn level(&self, strongest: &mut [S::Scalar; N]) {
        let State { t, q, v } = self.start;
        let found = self.system.accelerations_at(self.constants, *t, q, v, self.inputs);
        let most = found.iter().chain(strongest.iter()).filter(|a| a.is_finite());
        let zero: S::Scalar = num_traits::Zero::zero();
        let most = most.fold(zero, |most, a| most.max(a.part(0).abs()));
        *strongest = [most; N];
    }

    /// The strongest accelerations, with those whose rounding errors the equations have at the start.
    #[cold]
    pub fn measure(&self, strongest: &mut [S::Scalar; N]) {
        let accelerations = |state: &State<S::Scalar, N>| {
            let State { t, q, v } = state;
            self.system.accelerations_at(self.constants, *t, q, v, self.inputs)
        };
        let expected = self.slopes(num_traits::Zero::zero());
        roundings(self.start, [&accelerations(self.start), &expected], accelerations, strongest);
    }

    /// The accelerations of the series.
    fn slopes(&self, theta: S::Scalar) -> [S::Scalar; N] {
        self.series.slopes(theta, self.orders).each(|slope| slope / self.unit)
    }

    /// The strongest accelerations that lie ahead of a state at rest, in the lanes that have one: the forces
    /// that will set in are the only measure of the rounding errors of these that are there. What moves meets
    /// other forces before it is there.
    pub fn look_ahead(&self, theta: S::Scalar, strongest: &mut [S::Scalar; N]) {
        let mut ahead = *strongest;
        self.compared(theta, &mut ahead);
        let (gain_q, gain_v) = self.series.gain(theta, self.orders);
        let zero: S::Scalar = num_traits::Zero::zero();
        let moves = gain_q.iter().chain(&gain_v).fold(zero, |most, gain| most.max(gain.part(0).abs()));
        *strongest = array(|i| strongest[i].where_positive(moves, ahead[i]));
    }

    /// The comparison. `strongest` always includes all accelerations found.
    fn compared(&self, theta: S::Scalar, strongest: &mut [S::Scalar; N]) -> S::Scalar {
        let agreement = Agreement { start: self.start, span: theta * self.unit, tolerances: self.tolerances };
        let mut faults_at = |theta: S::Scalar, state: &State<S::Scalar, N>| {
            let State { t, q, v } = state;
            let found = self.system.accelerations_at(self.constants, *t, q, v, self.inputs);
            let expected = self.slopes(theta);
            agreement.faults(state, [&found, &expected], strongest)
        };
        let state_at = |theta: S::Scalar| {
            let (gain_q, gain_v) = self.series.gain(theta, self.orders);
            let moved = |from: &[S::Scalar; N], gain: &[S::Scalar; N]| array(|i| from[i] + gain[i]);
            let (q, v) = (moved(&self.start.q, &gain_q), moved(&self.start.v, &gain_v));
            State { t: self.start.t + theta * self.unit, q, v }
        };
        let hiding = InEquations { system: self.system, control: &Held(*self.inputs), roots: true };
        let passage = Passage { hiding: &hiding, state_at: &state_at, theta };
        faults_along(&passage, self.start, |theta, state, _| faults_at(theta, state))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stops_are_where_velocities_pass_zero() {
        let stop = |v: &dyn Fn(f64) -> f64| stops(&[v(0.0)], &[v(1.0)], |part| [v(part)])[0];
        assert_eq!(stop(&|part| 1.0 + part), None);
        assert_eq!(stop(&|part| 1.0 - 4.0 * part), Some(0.25));
        // One more secant, to either side of the first one.
        let zero = 0.5_f64.cbrt();
        for v in [|part: f64| 1.0 - 2.0 * part.powi(3), |part: f64| 2.0 * part.powi(3) - 1.0] {
            assert!((stop(&v).unwrap() - zero).abs() < 0.1);
            assert!((stop(&|part| v(1.0 - part)).unwrap() - (1.0 - zero)).abs() < 0.1);
        }
    }
}
