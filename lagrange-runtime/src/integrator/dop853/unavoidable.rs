//! Errors that no length of a step makes small beside the motion: rounding errors of the accelerations, and
//! jumps.
//!
//! At rest on a spring that bears a weight, and across constraints, accelerations are nothing but rounding
//! errors. A few ulps more or less in the state show how large those are, and a smooth motion cannot be known
//! better than that either. They must show at both ends of a step: a jump beside one of them is no rounding
//! error.
//!
//! An error that does not fall as the step gets shorter is one of a jump. Once the step is as short as the
//! relative tolerance times the first attempt, the jump changes the motion of that attempt by no more than
//! the relative tolerance.

use num_traits::Zero;

use super::super::Field;
use super::super::slopes::Slope;
use super::super::tableau::dop853::{A, E5};
use super::tolerance::Tried;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::limits::Limits;
use crate::system::method::Steps;
use crate::system::state::State;

/// Changes of a state in ulps: of its numbers with an even index, and of those with an odd one.
const PROBES: [[f64; 2]; 3] = [[1.0, 1.0], [-2.0, -2.0], [3.0, -3.0]];

/// The evaluations that show the rounding errors of a step.
const EVALUATIONS: u64 = 2 * PROBES.len() as u64 + 1;

/// The attempts at one step so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attempts<L, const N: usize> {
    /// Length of the first one that was refused for its error, and its errors of the velocities, divided by
    /// that length.
    refused: Option<(L, [L; N])>,
    /// Length below which a step changes hardly a number \[s].
    range: L,
    /// The relative tolerance.
    relative: L,
}

impl<L: Ordered, const N: usize> Attempts<L, N> {
    pub fn new(range: L, relative: L) -> Self {
        Self { refused: None, range, relative }
    }

    /// Whether an attempt has been refused for its error.
    #[inline]
    pub fn any_refused(&self) -> bool {
        self.refused.is_some()
    }

    /// Notes an attempt that is refused for its error.
    #[cold]
    pub fn note<R: Ordered<Lane = L>>(&mut self, tried: &Tried<'_, R, N>) {
        if self.refused.is_none() {
            self.refused = Some((tried.length(), errors(tried)));
        }
    }

    /// The jumps of the accelerations in a step, where its errors show any.
    fn jumps<R: Ordered<Lane = L>>(&self, tried: &Tried<'_, R, N>) -> [L; N] {
        let Some((length, first)) = self.refused else { return [L::zero(); N] };
        let h = tried.length();
        if h > larger(self.range, self.relative * length) {
            return [L::zero(); N];
        }
        // The error of a velocity is h times this, and falls as h⁸ where accelerations are smooth, as h at
        // jumps. Between them lies h².
        let part = h / length;
        let errors = errors(tried);
        array(|n| if errors[n] >= part * first[n] { errors[n] } else { L::zero() })
    }

    /// The error of a step in tolerances without the unavoidable part. If the constraints alone do not
    /// explain it, it costs evaluations, which are counted.
    #[cold]
    pub fn avoidable_error<R, F>(
        &self,
        f: &F,
        limits: &Limits<R>,
        tried: &Tried<'_, R, N>,
        counts: &mut Steps,
    ) -> R
    where
        R: Ordered<Lane = L>,
        F: Field<R, N>,
    {
        let error = tried.projected_error(f, limits, &[[L::zero(); N]; 2]);
        if error <= R::one() {
            return error;
        }
        counts.evaluations += EVALUATIONS;
        tried.projected_error(f, limits, &self.unavoidable(f, tried))
    }

    /// The unavoidable errors of the coordinates and of the velocities in a step.
    fn unavoidable<R, F>(&self, f: &F, tried: &Tried<'_, R, N>) -> [[L; N]; 2]
    where
        R: Ordered<Lane = L>,
        F: Field<R, N>,
    {
        let (jumps, roundings) = (self.jumps(tried), roundings(f, tried));
        let [q, v] = bounds().each(L::from_f64);
        let h = tried.length();
        let most: [L; N] = array(|n| larger(jumps[n], roundings[n]));
        [most.each(|a| q * h * h * a), most.each(|a| v * h * a)]
    }
}

/// Estimated errors of the velocities, divided by the length of the step.
fn errors<R: Ordered, const N: usize>(tried: &Tried<'_, R, N>) -> [R::Lane; N] {
    tried.estimates[0].v.each(|x| x.part(0).largest().abs())
}

/// The largest estimated errors of the coordinates (in units of h²) and of the velocities (in units of h)
/// that accelerations of size 1 in the stages can cause.
fn bounds() -> [f64; 2] {
    let [mut q, mut v] = [0.0; 2];
    for (weight, row) in E5.iter().zip(&A) {
        v += weight.abs();
        q += weight.abs() * row.iter().map(|a| a.abs()).sum::<f64>();
    }
    [q, v]
}

/// The size of the rounding errors of each acceleration, as a few ulps of the state show them at both ends of
/// a step.
fn roundings<R: Ordered, F: Field<R, N>, const N: usize>(f: &F, tried: &Tried<'_, R, N>) -> [R::Lane; N] {
    let (from, to, h) = (tried.from, tried.to, tried.h);
    let at_start = changes(f, from.t, from, tried.slope, h);
    let a = f.accelerations(from.t + h, &to.q, &to.v);
    let at_end = changes(f, from.t + h, to, &Slope { q: to.v, v: a }, h);
    array(|n| smaller(at_start[n], at_end[n]))
}

/// The largest changes of the accelerations by a few ulps of a state. An ulp is one of the number and of its
/// change over `h` \[s] with the given `slope`.
fn changes<R: Ordered, F: Field<R, N>, const N: usize>(
    f: &F,
    t: R,
    state: &State<R, N>,
    slope: &Slope<R, N>,
    h: R,
) -> [R::Lane; N] {
    let mut most = [R::Lane::zero(); N];
    for probe in PROBES {
        let beside = |x: &[R; N], rate: &[R; N], n: usize| {
            let ulp = R::epsilon() * (x[n].abs() + (h * rate[n]).abs());
            x[n] + R::from_f64(probe[n % 2]) * ulp
        };
        let q = array(|n| beside(&state.q, &slope.q, n));
        let v = array(|n| beside(&state.v, &slope.v, n));
        let a = f.accelerations(t, &q, &v);
        for n in 0..N {
            let change = (a[n] - slope.v[n]).part(0).largest().abs();
            if change.is_finite() {
                most[n] = larger(most[n], change);
            }
        }
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::error::Cause;

    /// Accelerations as a function of time and the coordinate.
    struct Law<A>(A);

    impl<A: Fn(f64, f64) -> f64> Field<f64, 1> for Law<A> {
        fn accelerations(&self, t: f64, q: &[f64; 1], _: &[f64; 1]) -> [f64; 1] {
            [(self.0)(t, q[0])]
        }

        fn cause(&self, _: f64, _: &[f64; 1], _: &[f64; 1]) -> Cause {
            Cause::NotFinite
        }
    }

    /// What errors of velocities, over the step, are unavoidable in a step of `h`, where those of a first
    /// attempt of one second were 2.
    fn unavoidable(law: impl Fn(f64, f64) -> f64, h: f64, error: f64) -> [f64; 2] {
        let [from, to] = [0.0, h].map(|t| State::new([1.0], [0.0]).at_time(t));
        let slope = Slope { q: from.v, v: [law(0.0, 1.0)] };
        let estimate = Slope { q: [0.0], v: [error] };
        let tried = Tried { from: &from, to: &to, slope: &slope, h, estimates: [&estimate, &estimate] };
        let attempts = Attempts { refused: Some((1.0, [2.0])), range: 0.0, relative: 1e-6 };
        attempts.unavoidable(&Law(law), &tried).map(|[x]| x)
    }

    #[test]
    fn bounds_hold_for_accelerations_of_any_sign() {
        let [q, v] = bounds();
        assert!((v - E5.iter().map(|weight| weight.abs()).sum::<f64>()).abs() < 1e-15);
        // The worst signs of accelerations at the stages, which no larger ones reach.
        let stage = |j: usize| E5.iter().zip(&A).map(|(weight, row)| weight * row[j]).sum::<f64>();
        let worst: f64 = (0..E5.len()).map(|j| stage(j).abs()).sum();
        let most: f64 = (0..E5.len())
            .map(|j| E5.iter().zip(&A).map(|(weight, row)| (weight * row[j]).abs()).sum::<f64>())
            .sum();
        assert!(worst < q && (q - most).abs() < 1e-13, "{worst} {q} {most}");
    }

    #[test]
    fn errors_that_a_short_step_keeps_are_those_of_a_jump() {
        let ([q, v], h) = (bounds(), 1e-7);
        // It has to fall faster than the length.
        assert_eq!(unavoidable(|_, _| 0.0, h, 1e-7), [0.0; 2]);
        assert_eq!(unavoidable(|_, _| 0.0, h, 3e-7), [q * h * h * 3e-7, v * h * 3e-7]);
        // Not yet as short as the tolerance asks for.
        assert_eq!(unavoidable(|_, _| 0.0, 1e-5, 1.0), [0.0; 2]);
    }

    #[test]
    fn roundings_show_at_both_ends_of_a_step() {
        let h = 0.5;
        // The force is a steep function of the coordinate at the start, and 1e4 times less so at the end,
        // where it is another one, too.
        let law = |t: f64, q: f64| 1e3 * t + if t == 0.0 { 1e8 } else { 1e4 } * (q - 1.0);
        let [_, found] = unavoidable(law, h, 0.0);
        // Three ulps at the end, of the coordinate and of its change.
        let expected = bounds()[1] * h * 1e4 * 3.0 * f64::EPSILON;
        assert!((found / expected - 1.0).abs() < 1e-2, "{found:e} {expected:e}");
    }
}
