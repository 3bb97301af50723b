//! Floquet multipliers of periodic motions, on hosts with a standard library.
//!
//! The state-transition matrix over one period, the monodromy matrix, maps a deviation from a periodic motion
//! to that deviation a period later. Its eigenvalues, the multipliers, say whether deviations grow
//! (Yakubovich and Starzhinskii, *Linear Differential Equations with Periodic Coefficients*, chapter II;
//! Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, § I.16).

use std::vec::Vec;

use nalgebra::{ColPivQR, Complex, DMatrix};

use super::modes::{balance, values};
use super::variational::passes;
use super::{Sensitive, Transition, Variational, VariationalMotion};
use crate::number::real::{Ordered, Real};
use crate::system::attitude::beside;
use crate::system::error::{Cause, MotionError};
use crate::system::state::State;

/// How deviations from a motion develop over a period.
#[derive(Clone, Debug, PartialEq)]
pub struct Monodromy<R, const N: usize, const P: usize = 0> {
    /// The state after the period with its derivatives by the start. Where the motion is periodic it is the
    /// start, up to whole turns of angles.
    pub transition: Transition<R, N, P>,
    /// The eigenvalues of the state-transition matrix, largest modulus first, and of a pair the one with the
    /// positive imaginary part, then its conjugate; under constraints those on the tangent space.
    ///
    /// A periodic motion of a system that does not depend on time has a multiplier 1, and a second one where
    /// energy is conserved; every other integral adds a pair. Equal multipliers are uncertain by the
    /// root of a rounding and more.
    pub multipliers: Vec<Complex<f64>>,
}

impl<S, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>
    Variational<'_, S, N, K, C, P, D>
where
    S: Sensitive<N, K, C, P, D>,
    S::Scalar: Ordered + Into<f64>,
{
    /// The multipliers of the periodic motion from a state, at the finest tolerance, with inputs at zero.
    ///
    /// # Errors
    /// As [`VariationalMotion::monodromy`].
    pub fn monodromy(
        &self,
        start: State<S::Scalar, N>,
        period: S::Scalar,
    ) -> Result<Monodromy<S::Scalar, N, P>, MotionError<S::Scalar>> {
        self.motion(start)?.with_tolerance(S::Scalar::epsilon()).monodromy(period)
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>
    VariationalMotion<'_, S, N, K, C, P, D>
where
    S: Sensitive<N, K, C, P, D>,
    S::Scalar: Ordered + Into<f64>,
{
    /// The multipliers of the periodic motion from the start. The caller must know that it is periodic, since
    /// the eigenvalues of another motion's matrix mean little.
    ///
    /// # Errors
    ///
    /// Why and when the motion or a derivative cannot go on; [`Cause::NoEigenvalues`] for eigenvalues that
    /// the iteration does not find.
    pub fn monodromy(
        mut self,
        period: S::Scalar,
    ) -> Result<Monodromy<S::Scalar, N, P>, MotionError<S::Scalar>> {
        let start = self.transition();
        let end = self.advance_to(start.state.t + period)?;
        let transition = end.beside::<D>(S::ORIENTATIONS, &start.state);
        let failed = MotionError { cause: Cause::NoEigenvalues, t: transition.state.t };
        let multipliers = multipliers(&start, &transition, C > 0).ok_or(failed)?;
        Ok(Monodromy { transition, multipliers })
    }
}

impl<R: Real, const N: usize, const P: usize> Transition<R, N, P> {
    /// The same with those numbers for orientations that lie nearest to those of another state, `D`
    /// directions at once.
    fn beside<const D: usize>(mut self, orientations: &[usize], near: &State<R, N>) -> Self {
        let own = self;
        for first in passes::<N, P, D>() {
            self.take(first, &beside(orientations, &own.varied::<D>(first), near, |x| x.value));
        }
        self
    }
}

fn multipliers<R, const N: usize, const P: usize>(
    start: &Transition<R, N, P>,
    end: &Transition<R, N, P>,
    is_constrained: bool,
) -> Option<Vec<Complex<f64>>>
where
    R: Ordered + Into<f64>,
{
    let whole = |of: &Transition<R, N, P>| DMatrix::from_fn(2 * N, 2 * N, |i, j| of.entry(i, j).into());
    let mut matrix = whole(end);
    if is_constrained {
        // At the start the matrix is the projection onto the tangent space, whose trace is its rank.
        let mut projection = whole(start);
        // Units of time and of coordinates in which neither has entries of very different sizes.
        let scales = balance(&mut (projection.abs() + matrix.abs()));
        for matrix in [&mut projection, &mut matrix] {
            let size = |i: usize, j: usize| scales[j] / scales[i];
            *matrix = DMatrix::from_fn(2 * N, 2 * N, |i, j| matrix[(i, j)] * size(i, j));
        }
        let rank = (projection.trace().round() as usize).min(2 * N);
        let basis = ColPivQR::new(projection).q().columns(0, rank).into_owned();
        matrix = basis.transpose() * matrix * basis;
    }
    // In units of the largest entry no square overflows.
    let scale = matrix.amax();
    if scale == 0.0 {
        return Some(std::vec![Complex::new(0.0, 0.0); matrix.nrows()]);
    }
    let found = values(&(matrix / scale), R::epsilon().into())?;
    Some(in_order(found.into_iter().map(|value| value * scale).collect()))
}

/// The eigenvalues of a real matrix by their moduli. Pairs go as one, since rounding would order the members
/// of several pairs of one modulus, which is what a conservative system has, at random.
fn in_order(found: Vec<Complex<f64>>) -> Vec<Complex<f64>> {
    let size = |x: Complex<f64>| x.re.hypot(x.im);
    let (mut below, mut first): (Vec<_>, Vec<_>) = found.into_iter().partition(|x| x.im < 0.0);
    first.sort_by(|a, b| size(*b).total_cmp(&size(*a)).then(b.re.total_cmp(&a.re)));
    let mut sorted = Vec::new();
    for value in first {
        sorted.push(value);
        let away = |x: &Complex<f64>| size(*x - value.conj());
        let partner = (0..below.len()).min_by(|&i, &j| away(&below[i]).total_cmp(&away(&below[j])));
        if value.im > 0.0 {
            sorted.extend(partner.map(|index| below.swap_remove(index)));
        }
    }
    sorted.extend(below);
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two pairs on the unit circle, with moduli that are equal or differ by roundings.
    #[test]
    fn conjugates_stay_together() {
        let of = |re: f64, im: f64| Complex::new(re, im);
        for (first, second) in [(1.0, 1.0), (1.0 + f64::EPSILON, 1.0), (1.0, 1.0 + f64::EPSILON)] {
            let pairs = [of(0.6 * first, 0.8), of(0.8, 0.6 * second)];
            let one = of(1.0, 0.0);
            let found = [pairs[0], pairs[1], one, pairs[1].conj(), pairs[0].conj(), of(2.0, 0.0)];
            let sorted = in_order(found.to_vec());
            assert_eq!(sorted[0], of(2.0, 0.0));
            for pair in pairs {
                let place = sorted.iter().position(|value| *value == pair).expect("it is one of them");
                assert_eq!(sorted[place + 1], pair.conj(), "{sorted:?}");
            }
            assert_eq!(sorted.len(), found.len());
        }
    }
}
