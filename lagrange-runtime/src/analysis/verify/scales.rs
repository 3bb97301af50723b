//! How far a state may be changed for differences: the scales of a motion at that state.
//!
//! Molecules and moons move on very different scales, and only the state tells which: the distance of a
//! coordinate from its origin, and the time in which its velocity or acceleration would cover that distance.
//! A scale that is too large does no harm, because differences look for better steps below it.

use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::state::State;

/// A coordinate near zero is measured by this share of the others, brought to its unit by their inertia.
const SHARE: f64 = 1e-3;

/// Scales at one state.
pub(super) struct Scales<R, const N: usize> {
    /// The scale of time.
    pub time: R,
    /// The scales of the coordinates.
    pub places: [R; N],
    /// Σ |v| / scale: how many times its scale a coordinate changes in a unit of time.
    pub pace: R,
}

impl<R: Real, const N: usize> Scales<R, N> {
    /// The scales of a motion with these accelerations.
    pub fn of(mass: &[[R; N]; N], state: &State<R, N>, a: &[R; N]) -> Self {
        // Steps are shares of a scale down to its rounding errors, and energies squares of them, which must
        // be numbers.
        let is_scale = |x: &R| x.is_finite() && (*x * R::epsilon() * (*x * R::epsilon())).is_positive();
        let first = |candidates: [R; 2]| candidates.into_iter().find(is_scale).unwrap_or(R::one());
        let places = array(|i| {
            let others = (0..N).map(|j| {
                let ratio = (mass[j][j] / mass[i][i]).abs().sqrt();
                R::from_f64(SHARE) * ratio * state.q[j].abs()
            });
            let largest = others.filter(is_scale).fold(state.q[i].abs(), R::max);
            if is_scale(&largest) {
                largest
            } else {
                first([state.v[i] * state.v[i] / a[i].abs(), state.v[i].abs()])
            }
        });
        let times = (0..N).flat_map(|i| {
            let place: R = places[i];
            [place / state.v[i].abs(), (place / a[i].abs()).sqrt()]
        });
        let shortest = times.filter(is_scale).reduce(R::min);
        let time = shortest.unwrap_or_else(|| first([state.t.abs(), R::one()]));
        let pace = (0..N).fold(R::zero(), |sum, i| sum + state.v[i].abs() / places[i]);
        Scales { time, places, pace }
    }

    /// About the sum of the magnitudes that the rates of some quantities along a motion are made of,
    /// Σ |∂f/∂q v| + Σ |∂f/∂v a|.
    pub fn terms<const M: usize>(
        &self,
        state: &State<R, N>,
        a: &[R; N],
        f: impl Fn(&State<R, N>) -> [R; M],
    ) -> [R; M] {
        let step = (R::epsilon().ln() / R::from_f64(3.0)).exp();
        let mut terms = [R::zero(); M];
        for i in 0..N {
            for (rate, h, by_velocity) in
                [(state.v[i], step * self.places[i], false), (a[i], step * self.places[i] / self.time, true)]
            {
                let moved = |h: R| {
                    let mut moved = *state;
                    let place = if by_velocity { &mut moved.v } else { &mut moved.q };
                    place[i] += h;
                    f(&moved)
                };
                let share = (rate / (h + h)).abs();
                for ((term, after), before) in terms.iter_mut().zip(moved(h)).zip(moved(-h)) {
                    *term += (after - before).abs() * share;
                }
            }
        }
        terms
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_those_of_the_motion() {
        let state = State::new([4e-10, 0.0], [100.0, 0.0]);
        let mass = [[1e-26, 0.0], [0.0, 1e-26]];
        let Scales { time, places, pace } = Scales::of(&mass, &state, &[1e14, 0.0]);
        assert!((time - 2e-12).abs() < 1e-18 && (pace - 2.5e11).abs() < 1.0);
        assert!((places[0] - 4e-10).abs() < 1e-20 && (places[1] - 4e-13).abs() < 1e-20);
        // At rest at the origin nothing has a scale.
        let still = Scales::of(&mass, &State::new([0.0; 2], [0.0; 2]), &[0.0; 2]);
        assert_eq!((still.time, still.places), (1.0, [1.0; 2]));
        // Numbers so small that they have no rounding errors are no scale.
        let tiny = Scales::of(&mass, &State::new([5e-324, 3e-310], [0.0; 2]), &[1e-320; 2]);
        assert_eq!((tiny.time, tiny.places), (1.0, [1.0; 2]));
        let terms = Scales::of(&mass, &state, &[1e14, 0.0])
            .terms(&state, &[1e14, 0.0], |state| [0.5e-26 * state.v[0] * state.v[0] - 1e-12 * state.q[0]]);
        assert!((terms[0] - 2e-10).abs() < 1e-14, "{terms:?}");
    }
}
