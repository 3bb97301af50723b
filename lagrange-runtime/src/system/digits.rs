//! How many digits two results share.

use super::state::State;
use crate::number::elements::array;
use crate::number::real::{DoubleDouble, Real};

/// Decimal digits in common, for each coordinate and velocity; see [`State::digits_in_common`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Digits<const N: usize> {
    /// The digits of the coordinates.
    pub q: [f64; N],
    /// The digits of the velocities.
    pub v: [f64; N],
}

impl<const N: usize> Digits<N> {
    /// The fewest of all coordinates and velocities.
    #[must_use]
    pub fn least(&self) -> f64 {
        self.q.iter().chain(&self.v).copied().fold(f64::INFINITY, f64::min)
    }
}

impl<R: Real + Into<DoubleDouble>, const N: usize> State<R, N> {
    /// How many decimal digits of each coordinate and velocity agree with a reference: −log₁₀ of the relative
    /// difference, from zero to the digits of the scalar, about 15.7 for `f64`. A number beside zero has
    /// few, however small its error is.
    ///
    /// With the same motion of the same system in [`DoubleDouble`], at a tolerance far below, these are the
    /// digits that are true.
    #[must_use]
    pub fn digits_in_common(&self, reference: &State<DoubleDouble, N>) -> Digits<N> {
        let of = |value: &[R; N], exact: &[DoubleDouble; N]| array(|i| shared(value[i], exact[i]));
        Digits { q: of(&self.q, &reference.q), v: of(&self.v, &reference.v) }
    }
}

/// The digits of one number.
fn shared<R: Real + Into<DoubleDouble>>(value: R, exact: DoubleDouble) -> f64 {
    let log10 = |x: f64| Real::ln(x) / core::f64::consts::LN_10;
    let most = -log10(R::epsilon().into().high());
    let (size, error) = (exact.high().abs(), (value.into() - exact).high().abs());
    if error == 0.0 {
        most
    } else if error < size {
        // A quotient of small numbers could underflow.
        (log10(size) - log10(error)).clamp(0.0, most)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_in_common_are_counted() {
        let reference: State<DoubleDouble, 2> =
            State { t: 0.0.into(), q: [1.0.into(), (-200.0).into()], v: [0.0.into(); 2] };
        let digits = State { t: 0.0, q: [1.001, -200.0], v: [0.0, 1e-30] }.digits_in_common(&reference);
        assert!((digits.q[0] - 3.0).abs() < 1e-10 && (15.6..15.7).contains(&digits.q[1]), "{digits:?}");
        assert!(digits.v[0] > 15.6 && digits.v[1] == 0.0 && digits.least() == 0.0, "{digits:?}");
    }
}
