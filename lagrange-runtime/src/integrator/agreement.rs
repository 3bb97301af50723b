//! Whether accelerations of a polynomial through a step are those of the equations of motion.

use super::beside::beside;
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::state::State;

/// Allowed difference of the accelerations, in tolerances. At the end of a step the truncated series, or the
/// polynomial of a Runge–Kutta method, differs from the motion by a few of them.
const MARGIN: f64 = 16.0;

/// Uncertainty of accelerations, in ulps of the largest one.
const NOISE: f64 = 256.0;

/// The distance of states beside one at which [`roundings`] looks, in ulps. Forces are rounded, too, and may
/// not notice a single one.
const APART: f64 = 8.0;

/// Safety factor on what these show.
const SAFETY: f64 = 8.0;

/// The part by which the numbers of a state change where the sizes of forces are looked at.
const FAR: f64 = 1.0 / 16.0;

/// Adds to the `strongest` accelerations those whose rounding errors are the ones that the equations have at
/// a state. Forces that balance leave nothing but rounding errors, so accelerations at rest do not tell how
/// large these are. The difference of both accelerations that are `found` at the state itself does, one by
/// the equations and one by a series, and so do the accelerations at states that are some ulps beside it.
///
/// A jump of forces within these ulps is no rounding error: the forces that a large change of the state
/// brings to light bound what counts.
#[cold]
pub(crate) fn roundings<R: Real, const N: usize>(
    state: &State<R, N>,
    found: [&[R; N]; 2],
    accelerations: impl Fn(&State<R, N>) -> [R; N],
    strongest: &mut [R; N],
) {
    let apart = |a: &[R; N]| -> [R; N] { array(|i| (a[i] - found[0][i]).part(0).abs()) };
    let most = |all: [R; N], own: [R; N]| -> [R; N] {
        array(|i| if own[i].is_finite() { all[i].max(own[i]) } else { all[i] })
    };
    // The largest changes where all numbers of the state change by a part of themselves.
    let changes = |part: R| {
        let sizes = |x: &[R; N]| -> [R; N] { array(|i| part * x[i].abs()) };
        let by = State { t: part * state.t.abs(), q: sizes(&state.q), v: sizes(&state.v) };
        let found = beside(state, &by).map(|beside| apart(&accelerations(&beside)));
        found.fold([R::zero(); N], most)
    };
    let [near, far] = [R::from_f64(APART) * R::epsilon(), R::from_f64(FAR)].map(changes);
    let own = most([R::zero(); N], apart(found[1]));
    let per_ulp = R::from_f64(SAFETY / NOISE) / R::epsilon();
    for (i, strongest) in strongest.iter_mut().enumerate() {
        *strongest = strongest.max(per_ulp * own[i]).max(far[i].min(per_ulp * near[i]));
    }
}

/// A step, and what its polynomial may be off.
pub(crate) struct Agreement<'a, R, const N: usize> {
    pub start: &'a State<R, N>,
    /// The length of the step \[s], with its sign.
    pub span: R,
    /// Tolerances of velocities, relative and absolute.
    pub tolerances: [R; 2],
}

impl<R: Real, const N: usize> Agreement<'_, R, N> {
    /// The lanes in which accelerations at a state of the step differ from those of the polynomial: one
    /// there, and zero in the others. `strongest` are the largest accelerations so far, whose rounding errors
    /// count as agreement; they then include those found here.
    pub fn faults(
        &self,
        State { v, .. }: &State<R, N>,
        [found, expected]: [&[R; N]; 2],
        strongest: &mut [R; N],
    ) -> R {
        let span = self.span;
        let noise = R::from_f64(NOISE) * R::epsilon();
        let [relative, absolute] = self.tolerances;
        let relative = R::from_f64(MARGIN) * relative.max(noise);
        let (zero, one, tiny) = (R::zero(), R::one(), R::epsilon().powi(4));
        for (strongest, found) in strongest.iter_mut().zip(found).filter(|(_, found)| found.is_finite()) {
            *strongest = strongest.max(found.part(0).abs());
        }
        (0..R::PARTS).fold(zero, |faults, part| {
            let pair = |i: usize| [found[i].part(part), expected[i].part(part)];
            let size = |i: usize| {
                let speed = self.start.v[i].part(part).abs().max(v[i].part(part).abs());
                pair(i).iter().fold(speed, |size, &x| size.max((x * span).abs()))
            };
            // A derivative is a sum over its whole column, whose rounding errors it has however small it is
            // itself: those of velocities, and those of coordinates divided by the step.
            let whole = |most: R, i: usize| most.max(size(i)).max((self.start.q[i].part(part) / span).abs());
            let column = (0..N).filter(|_| part > 0).fold(tiny, whole);
            (0..N).fold(faults, |faults, i| {
                let mut bound = relative * size(i) + noise * column + tiny;
                if part == 0 {
                    bound += absolute + noise * (strongest[i] * span).abs();
                }
                let [found, expected] = pair(i);
                // What is no number, or is infinite, is no agreement either.
                let apart = ((found - expected) * span).abs();
                faults.max(zero.where_positive((bound - apart).part(0), one))
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ULP: f64 = f64::EPSILON;

    /// Whether accelerations that differ by this count as a fault, in a step of half a second at 1e-6.
    fn is_fault(v: f64, strongest: f64, absolute: f64, apart: f64) -> bool {
        let start = State::new([0.0], [v]);
        let agreement = Agreement { start: &start, span: 0.5, tolerances: [1e-6, absolute] };
        let mut strongest = [strongest];
        let fault = agreement.faults(&start, [&[0.0], &[apart]], &mut strongest);
        assert!(fault == 0.0 || fault == 1.0);
        fault == 1.0
    }

    #[test]
    fn accelerations_may_change_the_velocity_by_some_tolerances() {
        // Sixteen of them, of a velocity of 2.
        let bound = 16.0 * 1e-6 * 2.0 / 0.5;
        assert!(!is_fault(2.0, 0.0, 0.0, 0.99 * bound) && is_fault(2.0, 0.0, 0.0, 1.01 * bound));
        assert!(is_fault(2.0, 0.0, 0.0, f64::NAN) && is_fault(2.0, 0.0, 0.0, f64::INFINITY));
        // An absolute tolerance adds to that.
        assert!(!is_fault(2.0, 0.0, bound, 2.9 * bound) && is_fault(2.0, 0.0, bound, 3.1 * bound));
    }

    #[test]
    fn roundings_of_the_strongest_accelerations_are_no_fault() {
        // A fault is at least as large as a part of the change that it makes itself.
        let bound = 256.0 * ULP * 1e12;
        assert!(!is_fault(0.0, 1e12, 0.0, 0.99 * bound) && is_fault(0.0, 1e12, 0.0, 1.01 * bound));
    }

    #[test]
    fn derivatives_are_held_against_their_column() {
        use crate::number::real::Dual;

        type Number = Dual<f64, 1>;
        let number =
            |value, slope| Number::constant(value) + Number::variable(0.0, 0) * Number::constant(slope);
        // A velocity whose derivative is nothing beside those of the other velocity, and of the coordinates.
        for (speed, place, size) in [(1e3, 0.0, 1e3), (0.0, 1e3, 2e3)] {
            let start = State::new([number(1.0, place); 2], [number(1.0, 0.0), number(1.0, speed)]);
            let tolerances = [Number::from_f64(1e-10), Number::from_f64(1.0)];
            let agreement = Agreement { start: &start, span: Number::from_f64(0.5), tolerances };
            let fault = |apart: f64| {
                let pair = [&[number(0.0, 0.0); 2], &[number(0.0, apart), number(0.0, 0.0)]];
                agreement.faults(&start, pair, &mut [Number::from_f64(0.0); 2]).part(0).largest() > 0.0
            };
            // An absolute tolerance belongs to the values alone.
            let bound = 256.0 * ULP * size / 0.5;
            assert!(!fault(0.9 * bound) && fault(1.1 * bound), "{speed} {place}");
        }
    }

    #[test]
    fn roundings_that_equations_show_count_as_strong_accelerations() {
        let state = State::new([1.0], [0.0]);
        // The equations and the series differ by this at the state itself.
        let mut strongest = [0.0];
        roundings(&state, [&[0.0], &[1e-9]], |_| [0.0], &mut strongest);
        let expected = 1e-9 * 8.0 / 256.0 / ULP;
        assert!((strongest[0] / expected - 1.0).abs() < 1e-12, "{strongest:?}");
        // A steep force changes by more within some ulps of the state, and is strong further away.
        let mut strongest = [0.0];
        let steep = |x: f64| 1e6 * x * (1.0 + 1e3 * x * x);
        roundings(&state, [&[0.0], &[0.0]], |state| [steep(state.q[0] - 1.0)], &mut strongest);
        let expected = 1e6 * 8.0 * 8.0 / 256.0;
        assert!((strongest[0] / expected - 1.0).abs() < 1e-6, "{strongest:?}");
        // A jump is no stronger than what lies on its other side.
        let mut strongest = [0.0];
        roundings(&state, [&[0.0], &[0.0]], |state| [f64::from(u8::from(state.q[0] > 1.0))], &mut strongest);
        assert_eq!(strongest, [1.0]);
    }
}
