//! Where a motion stands still: slips in two directions that come to rest, and rest that lasts.

use super::known::Known;
use super::launch::LAUNCHED;
use super::run::Run;
use super::scene::{Scene, above, entry, most, put};
use super::sided::laws_on;
use super::turning::{has_pairs, pairs};
use super::way::{Ramp, Way, shift};
use super::{Regime, Row, Switching};
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The rounding errors of forces that an acceleration may be, where these balance each other.
const BALANCED: f64 = 8.0;

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// Whether a piece that rests at its ends also rests in between, and has not moved away and come back.
    pub(super) fn stays(&mut self) -> bool {
        let memory = &mut *self.memory;
        let (start, end) = (memory.start, memory.end);
        if memory.is_way || M::end(&memory.inner).t != end.t || M::start(&memory.inner).t != start.t {
            // A way between regimes is no rest. Another piece that is not the last step of the method has
            // been examined before.
            return !memory.is_way;
        }
        let middle = S::Scalar::from_f64(0.5) * (start.t + end.t);
        let (in_regime, constants) = (&memory.in_regime, &memory.constants);
        let (inner, control, limits) = (&mut memory.inner, self.control, self.limits);
        M::sample(inner, in_regime, constants, control, limits, middle, &mut 0)
            .is_ok_and(|state| is_at_rest(&start, &state))
    }

    /// Whether forces balance each other at a state at rest: accelerations are rounding errors of theirs. A
    /// velocity that grows from them has no digits, and no size to which an error could be relative.
    pub(super) fn is_balanced(&self, state: &State<S::Scalar, N>) -> bool {
        let memory = &*self.memory;
        if S::Scalar::PARTS > 1 || memory.is_way || state.v.iter().any(|&v| v != num_traits::Zero::zero()) {
            return false;
        }
        let known = Known::settled(memory.regime.active);
        let inputs = &self.control.0;
        let scene = Scene::new(self.system, state, inputs, memory.regime.kinks, &memory.scales, &known);
        let ulps = S::Scalar::from_f64(BALANCED) * S::Scalar::epsilon();
        scene.balance(&memory.regime, &state.v).is_some_and(|(balance, sizes)| {
            let mut both = balance.accelerations.iter().zip(&sizes.accelerations);
            both.all(|(a, &size)| !above(a.abs(), ulps * size))
        })
    }

    /// Whether a slip in two directions has become less than the tolerance of its former size.
    pub(super) fn rests(&self, row: usize, other: usize, state: &State<S::Scalar, N>) -> bool {
        let rows = self.system.laws_at(state.t, &state.q, &state.v, &self.control.0).rows;
        let scales = &self.memory.scales;
        let size = most(entry(&scales.speeds, row), entry(&scales.speeds, other));
        let slip = entry(&rows.rates, row).hypot(entry(&rows.rates, other));
        !above(slip, scales.lost() * size)
    }

    /// The rows of all slips in two directions that have become so small.
    fn resting(&self, state: &State<S::Scalar, N>) -> [bool; C] {
        let mut resting = [false; C];
        for rows in pairs(&S::ROWS).filter(|&[row, other]| self.rests(row, other, state)) {
            rows.into_iter().for_each(|row| put(&mut resting, row, true));
        }
        resting
    }

    /// Ends a slip in two directions that is about to come to rest: its direction turns ever faster there,
    /// and steps, which end before, become shorter and shorter. From within the tolerance the rest is a
    /// straight line.
    pub(super) fn come_to_rest(&mut self) -> Result<(), Cause> {
        if const { !has_pairs(&S::ROWS) } {
            return Ok(());
        }
        for (row, kind) in S::ROWS.iter().enumerate() {
            let Row::Friction { pair: Some(other), .. } = *kind else { continue };
            let slips = self.memory.regime.slip[row] != num_traits::Zero::zero();
            if !slips || other < row || !self.rests(row, other, &self.memory.end) {
                continue;
            }
            let (memory, inputs) = (&*self.memory, &self.control.0);
            let State { t, q, v } = memory.end;
            let known = Known::settled(memory.regime.active);
            let scene =
                Scene::new(self.system, &memory.end, inputs, memory.regime.kinks, &memory.scales, &known);
            let slow = self.resting(&memory.end);
            let Some((ramp, is_straight)) = scene.to_rest(&memory.regime, [row, other], &slow) else {
                continue;
            };
            let left = ramp.lasts;
            let [gain_q, gain_v] = ramp.gain(&v);
            let mut state =
                State { t: t + left, q: array(|i| q[i] + gain_q[i]), v: array(|i| v[i] + gain_v[i]) };
            let present = memory.regime;
            // Feet that come to rest together do so up to the tolerance. What has held is at rest.
            let slow = self.resting(&state);
            let rested = array(|row| present.active[row] || slow[row]);
            let known = Known { fired: Some(row), rested, ..Known::new(present.active) };
            let notes = self.memory.notes();
            let regime = match self.settle(&mut state, present, known, left.part(0) - left) {
                Err(cause) if is_straight => return Err(cause),
                Ok(regime) if is_straight || regime.slip[row] == num_traits::Zero::zero() => regime,
                // A load that friction cannot hold turns the slip before it stops.
                _ => {
                    self.memory.take_back(notes);
                    continue;
                }
            };
            // If another slip begins at once, that is the way.
            if state.t == t + left.part(0) {
                self.memory.way = Way::along(&ramp);
            }
            self.memory.next = Some((regime, state));
            return Ok(());
        }
        Ok(())
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// Holds the slips in two directions of a regime of which nothing is left `after` the velocities have
    /// been brought into it: other rows that hold leave no slip there, or it was rounding errors. Such a slip
    /// has no direction.
    pub(super) fn hold_lost(
        &self,
        before: &[S::Scalar; N],
        after: &[S::Scalar; N],
        regime: &mut Regime<S::Scalar, C, W>,
    ) {
        if const { !has_pairs(&S::ROWS) } {
            return;
        }
        let zero: S::Scalar = num_traits::Zero::zero();
        for rows in pairs(&S::ROWS) {
            let slip = |v: &[S::Scalar; N]| {
                let [x, y] = rows.each(|row| self.rate_at(row, v));
                x.hypot(y)
            };
            let slips = entry(&regime.slip, rows[0]) != zero;
            if slips && !above(slip(after), S::Scalar::epsilon().sqrt() * slip(before)) {
                put(&mut regime.slip, rows[0], zero);
                rows.into_iter().for_each(|row| put(&mut regime.active, row, true));
            }
        }
    }

    /// The way on which a slow slip in two directions comes to rest, with all that are as `slow`, and whether
    /// it leads straight to rest or has no direction. `None` where the load turns the slip before, or changes
    /// so that it does not stop.
    fn to_rest(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        rows: [usize; 2],
        slow: &[bool; C],
    ) -> Option<(Ramp<S::Scalar, N>, bool)> {
        let number = S::Scalar::from_f64;
        let zero: S::Scalar = num_traits::Zero::zero();
        let State { t, q, v } = self.state;
        let [x, y] = rows.each(|row| entry(&self.laws.rows.rates, row));
        if x == zero && y == zero {
            // The slip is at rest, and has no direction any more.
            let none = [zero; N];
            return Some((Ramp { start: none, middle: none, end: none, lasts: zero }, true));
        }
        let in_regime = self.system.in_regime(regime);
        let start = S::equations_in(&in_regime, t, &q, &v, self.inputs)?.balance().accelerations;
        // The part of the slip that is lost per second \[1/s].
        let falls = |a: &[S::Scalar; N]| {
            let [along, across] = rows.each(|row| self.rate(row, a));
            -(x * along + y * across) / (x * x + y * y)
        };
        let fall = falls(&start);
        if !fall.is_positive() {
            return None;
        }
        let straight = fall.recip();
        // The load may turn the slip by the tolerance.
        let [along, across] = rows.each(|row| self.rate(row, &start));
        let turned = (x * across - y * along).abs() * straight / x.hypot(y);
        let hidden = self.hidden_slip(along.hypot(across));
        let has_direction = self.has_direction(rows) && above(x.hypot(y), hidden);
        if above(turned, self.lost * self.scale_of(rows)) && has_direction {
            return None;
        }
        let is_straight = !has_direction || !above(number(LAUNCHED) * turned, x.hypot(y));
        // Half of each slip is left, in the same direction. What turns one meanwhile is stiff and turns it
        // back.
        let after = number(0.5) * straight;
        let mut half = State { t: t + after, q, v };
        shift(&mut half, &start, after);
        let mut held = *regime;
        for (row, _) in slow.iter().enumerate().filter(|(_, slow)| **slow) {
            put(&mut held.active, row, true);
            put(&mut held.slip, row, zero);
        }
        let held = self.system.in_regime(&held);
        let stuck = S::equations_in(&held, half.t, &half.q, &half.v, self.inputs)?;
        // The slip of what turns changes by its place alone.
        let slips = laws_on(self.system, &half, self.inputs, &self.kinks).rows.rates;
        let lack = array(|row| {
            if slow.get(row) != Some(&true) {
                return zero;
            }
            number(0.5) * entry(&self.laws.rows.rates, row) - entry(&slips, row)
        });
        let (change, _) = stuck.saddle.solve(&[zero; N], &lack);
        half.v = array(|i| half.v[i] + change[i]);
        let equations = S::equations_in(&in_regime, half.t, &half.q, &half.v, self.inputs)?;
        let there = equations.balance().accelerations;
        // If it falls by f per second now and by h in the middle, and evenly between, 1 − f t + f (f − h) t²
        // of the slip is left after a time t.
        let root = fall * (number(4.0) * falls(&there) - number(3.0) * fall);
        if root.is_positive() {
            let lasts = number(2.0) / (fall + root.sqrt());
            let end = array(|i| start[i] + (there[i] - start[i]) * (lasts / after));
            let middle = array(|i| number(0.5) * (start[i] + end[i]));
            return Some((Ramp { start, middle, end, lasts }, is_straight));
        }
        // A slip without a direction is as good as at rest.
        (!has_direction).then_some((Ramp { start, middle: start, end: start, lasts: straight }, true))
    }
}

/// Whether nothing moves from one state to another at another time: velocities are zero, and coordinates
/// change by no more than the rounding errors of the forces that hold the system make them.
pub(super) fn is_at_rest<R: Real, const N: usize>(start: &State<R, N>, end: &State<R, N>) -> bool {
    let are_still = [start, end].iter().all(|state| state.v.iter().all(|&v| v == R::zero()));
    let ulps = R::from_f64(4.0) * R::epsilon();
    let mut places = start.q.iter().zip(&end.q);
    let stays = |a: R, b: R| (0..R::PARTS).all(|i| !above((b - a).part(i).abs(), ulps * a.part(i).abs()));
    start.t != end.t && are_still && places.all(|(&a, &b)| stays(a, b))
}
