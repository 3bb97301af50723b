//! Step size control of Dormand–Prince 8(5,3): the error of a step, the next step, the smallest time and the
//! smallest tolerance.
//!
//! Next step h · 0.9 · error^(−1/8), within factors 1/3 and 6. Hairer, Nørsett, Wanner, "Solving ODEs I",
//! 2nd ed., II.4 and II.10. The estimate presumes smooth accelerations; at a jump it only shortens steps.

use core::cmp::Ordering;

use crate::number::elements::Each;
use crate::number::real::{Ordered, larger};

/// Whether a length is not above the resolution of time; true for NaN.
#[inline]
pub(crate) fn is_below<R: Ordered>(length: R, resolution: R) -> bool {
    length.partial_cmp(&resolution) != Some(Ordering::Greater)
}

/// A time far below any other in the arithmetic of `R`, but representable: ε⁴.
#[inline]
pub(crate) fn smallest<R: Ordered>() -> R {
    R::epsilon().powi(4)
}

/// The smallest tolerance: 1e-290 in `f64`, 1e-37 in `f32`, ε² in narrower arithmetic. Its reciprocal is
/// finite. It takes the place of an absolute tolerance of zero, since errors are divided by tolerances.
#[inline]
pub(crate) fn least<R: Ordered>() -> R {
    let is_usable = |x: R| x.is_positive() && x.recip().is_finite();
    let [least, narrow] = [1e-290, 1e-37].each(R::from_f64);
    if is_usable(least) {
        least
    } else if is_usable(narrow) {
        narrow
    } else {
        R::epsilon() * R::epsilon()
    }
}

/// The error of a step in tolerances. `fifth` and `third` are its estimates of orders 5 and 3: sums over `n`
/// numbers of the squares of errors in tolerances.
#[inline]
pub(crate) fn error<R: Ordered>(fifth: R, third: R, n: usize) -> R {
    let both = fifth + R::from_f64(0.01) * third;
    if both == R::zero() {
        return R::zero();
    }
    fifth / (both * R::from_f64(n as f64)).sqrt()
}

/// Factor on the step after an error.
#[inline]
pub(crate) fn factor<R: Ordered>(error: R) -> R {
    // The eighth root as three square roots: no library call, the same bits everywhere.
    let root = error.sqrt().sqrt().sqrt();
    let wanted = R::from_f64(0.9) / larger(root, R::from_f64(0.15));
    larger(wanted, R::from_f64(1.0 / 3.0))
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

    #[test]
    fn lengths_that_time_does_not_resolve_are_below() {
        assert!(is_below(1.0, 1.0) && is_below(0.5, 1.0) && is_below(f64::NAN, 1.0) && !is_below(2.0, 1.0));
    }
}
