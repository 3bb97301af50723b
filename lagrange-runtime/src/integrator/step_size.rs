//! Step size control of Dormand–Prince 8(5,3): tolerance, error norm, next step, first step.
//!
//! Norm: root mean square of error / (absolute + relative·|y|) over q and v. The error is
//! |h| e₅² / √(e₅² + 0.01 e₃²), of order h⁸; next step h · 0.9 · error^(−1/8), within factors 1/3 and 6.
//! First step: an explicit Euler probe estimates the second derivative. Hairer, Nørsett, Wanner, "Solving
//! ODEs I", 2nd ed., II.4 and II.10. The estimate presumes smooth accelerations; at a jump it only shortens
//! steps.

use core::cmp::Ordering;

use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::limits::Limits;
use crate::system::state::State;

impl<R: Ordered> Limits<R> {
    /// Weights of the error norm. Neither part may vanish: a relative error below rounding cannot be met, and
    /// an absolute one of zero would divide by it where a component passes through zero.
    #[inline]
    pub(crate) fn scale(&self) -> Scale<R> {
        let ulp = R::epsilon();
        let absolute = self.absolute.unwrap_or(self.relative);
        // The norm squares its inverse, which in single precision is no number.
        let tiny = smallest::<R>();
        let least = if (tiny * tiny).recip().is_finite() { tiny } else { ulp * ulp };
        Scale { relative: larger(self.relative, ulp), absolute: larger(absolute, least) }
    }
}

/// Whether a length is not above the resolution of time; true for NaN.
#[inline]
pub(crate) fn is_below<R: Ordered>(length: R, resolution: R) -> bool {
    length.partial_cmp(&resolution) != Some(Ordering::Greater)
}

/// A length far below any other in the arithmetic of `R`, but representable: ε⁴.
#[inline]
pub(crate) fn smallest<R: Ordered>() -> R {
    R::epsilon().powi(4)
}

/// Weights of the error norm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale<R> {
    relative: R,
    absolute: R,
}

impl<R: Ordered> Scale<R> {
    /// The weights of the values, or of one of their derivatives on the way from one state to another. Linear
    /// equations have no scale: an absolute error of a derivative is one beside the whole of its column.
    #[inline]
    pub(crate) fn of_part<const N: usize>(&self, part: usize, states: [&State<R, N>; 2]) -> Scale<R::Lane> {
        let (relative, absolute) = (self.relative.largest(), self.absolute.largest());
        if part == 0 {
            return Scale { relative, absolute };
        }
        let column = states.into_iter().flat_map(|state| state.iter());
        let whole =
            column.fold(num_traits::Zero::zero(), |most, x| larger(most, x.part(part).largest().abs()));
        Scale { relative, absolute: larger(absolute * whole, smallest::<R::Lane>()) }
    }

    /// 1 / tolerated error of a component that goes from `a` to `b`.
    #[inline]
    pub(crate) fn weight(&self, a: R, b: R) -> R {
        (self.absolute + self.relative * larger(a.abs(), b.abs())).recip()
    }
}

/// Error over tolerance of a step of length `h`, from the sums of squared weighted estimates over `n`
/// numbers.
#[inline]
pub(crate) fn error<R: Ordered>(h: R, fifth: R, third: R, n: usize) -> R {
    let both = fifth + R::from_f64(0.01) * third;
    if both == R::zero() {
        return R::zero();
    }
    h.abs() * fifth / (both * R::from_f64(n as f64)).sqrt()
}

/// Factor on the step after an error.
#[inline]
pub(crate) fn factor<R: Ordered>(error: R) -> R {
    // The eighth root as three square roots: no library call, the same bits everywhere.
    let root = error.sqrt().sqrt().sqrt();
    let wanted = R::from_f64(0.9) / larger(root, R::from_f64(0.15));
    larger(wanted, R::from_f64(1.0 / 3.0))
}

/// Length of the first step from weighted norms: of the state, of its slope, and of the change of the slope
/// over a probe of length [`probe`].
#[inline]
pub(crate) fn first<R: Ordered>(probe: R, slope: R, change: R) -> R {
    let curvature = larger(change / probe, slope);
    let length = if curvature <= R::from_f64(1e-15) {
        larger(R::from_f64(1e-6), probe * R::from_f64(1e-3))
    } else {
        (R::from_f64(0.01) / curvature).sqrt().sqrt().sqrt()
    };
    smaller(R::from_f64(100.0) * probe, length)
}

/// Length of the Euler probe from the weighted norms of the state and of its slope.
#[inline]
pub(crate) fn probe<R: Ordered>(state: R, slope: R) -> R {
    let tiny = R::from_f64(1e-5);
    if state <= tiny || slope <= tiny { R::from_f64(1e-6) } else { R::from_f64(0.01) * state / slope }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_at_tolerance_shortens_the_step_a_little() {
        assert!((factor(1.0_f64) - 0.9).abs() < 1e-15);
        assert!((factor(256.0_f64) - 0.45).abs() < 1e-15);
    }

    #[test]
    fn factors_are_bounded_on_both_sides() {
        assert!((factor(0.0_f64) - 6.0).abs() < 1e-14);
        assert!((factor(1e30_f64) - 1.0 / 3.0).abs() < 1e-15);
    }
}
