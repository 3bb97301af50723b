//! The short way from the end of a piece to the state from which the next one starts.

use super::scene::above;
use crate::number::elements::array;
use crate::number::real::{Ordered, Real};
use crate::system::state::State;

/// Accelerations that change over a short time: the parabola through those at its start, in its middle and at
/// its end.
#[derive(Clone, Copy)]
pub(super) struct Ramp<R, const N: usize> {
    pub(super) start: [R; N],
    pub(super) middle: [R; N],
    pub(super) end: [R; N],
    /// The time \[s].
    pub(super) lasts: R,
}

impl<R: Real, const N: usize> Ramp<R, N> {
    /// The changes of coordinates with velocities `v` and those of these velocities.
    pub(super) fn gain(&self, v: &[R; N]) -> [[R; N]; 2] {
        let Self { start, middle, end, lasts } = *self;
        let number = R::from_f64;
        [
            array(|i| lasts * (v[i] + lasts * (start[i] + middle[i] + middle[i]) / number(6.0))),
            array(|i| lasts * (start[i] + number(4.0) * middle[i] + end[i]) / number(6.0)),
        ]
    }
}

/// The way on which a slip in two directions begins or comes to rest: accelerations that change quadratically
/// with time.
#[derive(Clone, Copy)]
pub(super) struct Way<R, const N: usize> {
    /// The accelerations at its end.
    pub(super) accelerations: [R; N],
    /// Their rate, and half of its rate.
    rates: [R; N],
    bends: [R; N],
    /// The time that it takes \[s], if its start is known.
    lasts: R,
    /// What coordinates and velocities lack at its start, since its end has been projected onto constraints.
    lacks: [[R; N]; 2],
}

impl<R: Real, const N: usize> Way<R, N> {
    /// A way with constant accelerations.
    pub(super) fn with(accelerations: [R; N]) -> Self {
        let none = [R::zero(); N];
        Self { accelerations, rates: none, bends: none, lasts: R::zero(), lacks: [none; 2] }
    }

    /// A way with these accelerations.
    pub(super) fn along(ramp: &Ramp<R, N>) -> Self {
        let Ramp { start, middle, end, lasts } = ramp;
        let way = Self::with(*end);
        if !lasts.is_positive() {
            return way;
        }
        let (three, four) = (R::from_f64(3.0), R::from_f64(4.0));
        Self {
            rates: array(|i| (start[i] - four * middle[i] + three * end[i]) / *lasts),
            bends: array(|i| {
                (start[i] - middle[i] - middle[i] + end[i]) * (R::from_f64(2.0) / (*lasts * *lasts))
            }),
            ..way
        }
    }

    /// Makes it lead from one state to another.
    pub(super) fn join(&mut self, start: &State<R, N>, end: &State<R, N>) {
        (self.lasts, self.lacks) = (R::zero(), [[R::zero(); N]; 2]);
        let reached = self.at(start.t, end);
        self.lasts = end.t - start.t;
        self.lacks = [array(|i| start.q[i] - reached.q[i]), array(|i| start.v[i] - reached.v[i])];
    }

    /// The state at a time, if the way ends at a state.
    pub(super) fn at(&self, t: R, end: &State<R, N>) -> State<R, N> {
        let (mut state, dt) = (*end, t - end.t);
        shift(&mut state, &self.accelerations, dt);
        let number = R::from_f64;
        // At the end nothing lacks, and at the start all, with the velocity that belongs to it.
        let passed = if self.lasts == R::zero() { R::zero() } else { -dt / self.lasts };
        let part = if above(passed, number(1.0)) { number(1.0) } else { passed };
        let place = part * part * (number(3.0) - number(2.0) * part);
        for i in 0..N {
            let (rate, bend) = (self.rates[i] * (dt * dt), self.bends[i] * (dt * dt * dt));
            state.q[i] += dt * (rate / number(6.0) + bend / number(12.0)) + place * self.lacks[0][i];
            state.v[i] += number(0.5) * rate + bend / number(3.0) + part * self.lacks[1][i];
        }
        State { t, ..state }
    }
}

/// Moves the coordinates and velocities of a state by a short time \[s], with constant accelerations.
pub(super) fn shift<R: Real, const N: usize>(state: &mut State<R, N>, accelerations: &[R; N], dt: R) {
    // Where a slip in two directions has come to rest, its regime has no accelerations.
    if dt == R::zero() || !accelerations.iter().all(|a| a.is_finite()) {
        return;
    }
    let half = R::from_f64(0.5);
    for ((q, v), &a) in state.q.iter_mut().zip(&mut state.v).zip(accelerations) {
        *q += dt * (*v + half * dt * a);
        *v += dt * a;
    }
}

/// Whether more time lies between two times than rounding hides.
pub(super) fn is_beyond_rounding<R: Ordered>(from: R, to: R) -> bool {
    (to - from).abs() > R::from_f64(16.0) * R::epsilon() * from.abs()
}

#[cfg(test)]
mod tests {
    use super::{Ramp, Way};
    use crate::system::state::State;

    /// Accelerations in half a second: 1 + 4 t².
    const RAMP: Ramp<f64, 1> = Ramp { start: [1.0], middle: [1.25], end: [2.0], lasts: 0.5 };

    #[test]
    fn a_way_back_is_the_way_on() {
        let start = State::new([0.2], [-1.0]).at_time(2.0);
        let [q, v] = RAMP.gain(&start.v);
        // The integrals of 1 + 4 t².
        assert!((v[0] - (0.5 + 4.0 / 24.0)).abs() < 1e-15, "{v:?}");
        assert!((q[0] - (-0.5 + 0.125 + 4.0 / (12.0 * 16.0))).abs() < 1e-15, "{q:?}");
        let end = State::new([start.q[0] + q[0]], [start.v[0] + v[0]]).at_time(2.5);
        let way = Way::along(&RAMP);
        let back = way.at(2.0, &end);
        assert!((back.q[0] - 0.2).abs() < 1e-15 && (back.v[0] + 1.0).abs() < 1e-15, "{back:?}");
        let between = way.at(2.25, &end);
        assert!((between.v[0] - (-1.0 + 0.25 + 4.0 / (3.0 * 64.0))).abs() < 1e-15, "{between:?}");
    }

    #[test]
    fn a_joined_way_leads_from_its_start_to_its_end() {
        let start = State::new([0.3], [-1.5]).at_time(2.0);
        let end = State::new([0.7], [2.0]).at_time(2.5);
        let mut way = Way::along(&RAMP);
        way.join(&start, &end);
        assert_eq!(way.at(2.5, &end), end);
        let first = way.at(2.0, &end);
        assert!((first.q[0] - 0.3).abs() < 1e-15 && (first.v[0] + 1.5).abs() < 1e-15, "{first:?}");
        // Before its start it goes on as at its start.
        let step = 2.0_f64.powi(-20);
        let before = way.at(2.0 - step, &end);
        assert!((before.q[0] - first.q[0]).abs() < 4.0 * step, "{before:?}");
    }

    #[test]
    fn what_has_no_accelerations_stays() {
        let end = State::new([0.7], [2.0]).at_time(2.5);
        assert_eq!(Way::with([f64::NAN]).at(2.0, &end).q, end.q);
    }
}
