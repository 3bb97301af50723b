//! What the roundings of a constraint are relative to where its own summands are no measure.
//!
//! Of a constraint such as z = 0 rounding leaves some part of what the other coordinates are in the kinetic metric, not of
//! z. So the largest coordinate in units of 1/√M\[i]\[i], times the gradient in these units, is a size as well,
//! the same in all units of the user.

use crate::linear::SaddlePoint;
use crate::real::Real;

/// The largest coordinate, or velocity, of a state in the units of the kinetic metric.
#[derive(Clone, Copy)]
pub(crate) struct Extent<R>(R);

impl<R: Real> Extent<R> {
    /// Of the numbers `x`.
    pub(crate) fn of<const N: usize, const C: usize>(saddle: &impl SaddlePoint<R, N, C>, x: &[R; N]) -> Self {
        Self::in_units(&saddle.units(), x)
    }

    /// Of numbers in given units.
    pub(crate) fn in_units<const N: usize>(units: &[R; N], x: &[R; N]) -> Self {
        let mut largest = R::zero();
        for i in 0..N {
            if units[i].is_positive() {
                largest = largest.max(x[i].abs() / units[i]);
            }
        }
        Self(largest)
    }

    /// One unit.
    pub(crate) fn unit() -> Self {
        Self(R::one())
    }

    /// The number.
    pub(crate) fn size(self) -> R {
        self.0
    }

    /// The larger of two.
    pub(crate) fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    /// How large constraints with these gradients are in such a state.
    pub(crate) fn sizes<const N: usize, const C: usize>(
        self,
        saddle: &impl SaddlePoint<R, N, C>,
        gradients: &[[R; N]; C],
    ) -> [R; C] {
        let units = saddle.units();
        let mut sizes = [R::zero(); C];
        for c in 0..C {
            for i in 0..N {
                sizes[c] = R::mul_add(gradients[c][i].abs(), units[i], sizes[c]);
            }
            sizes[c] *= self.0;
        }
        sizes
    }
}
