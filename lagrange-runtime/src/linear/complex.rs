//! P M = L U of a complex matrix, by elimination with partial pivoting, for the Newton matrices of implicit
//! methods.
//!
//! A pivot is the entry of largest |re| + |im| in its column. No pivot is too small here: a matrix that is
//! nearly singular makes corrections that do not converge, which the iteration notices by itself.

use core::ops::{Add, Mul, Sub};

use crate::number::elements::{Each, array};
use crate::number::real::Ordered;

/// re + i im.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Complex<R> {
    pub re: R,
    pub im: R,
}

impl<R: Ordered> Complex<R> {
    /// The nearest number to a literal.
    #[inline]
    pub(crate) fn from_f64(literal: [f64; 2]) -> Self {
        Self { re: R::from_f64(literal[0]), im: R::from_f64(literal[1]) }
    }

    /// A real factor.
    #[inline]
    pub(crate) fn scaled(self, factor: R) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }

    /// |re| + |im|.
    #[inline]
    fn size(self) -> R {
        self.re.abs() + self.im.abs()
    }

    /// 1 / self, scaled so that no square overflows.
    #[inline]
    fn recip(self) -> Self {
        let size = self.size();
        let Self { re, im } = self.scaled(size.recip());
        let factor = ((re * re + im * im) * size).recip();
        Self { re: re * factor, im: -im * factor }
    }
}

impl<R: Ordered> Add for Complex<R> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<R: Ordered> Sub for Complex<R> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<R: Ordered> Mul for Complex<R> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

/// The factors of a regular matrix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ComplexLu<R, const N: usize> {
    /// L without its unit diagonal below, U above.
    factor: [[Complex<R>; N]; N],
    /// 1 / diagonal of U.
    inverse: [Complex<R>; N],
    /// Row of M that stands in each row of the factors.
    order: [usize; N],
}

impl<R: Ordered, const N: usize> ComplexLu<R, N> {
    /// Factors `matrix`; of a singular one the solutions are not finite.
    #[inline]
    pub(crate) fn factor(matrix: [[Complex<R>; N]; N]) -> Self {
        let mut factor = matrix;
        let mut inverse = [Complex { re: R::zero(), im: R::zero() }; N];
        let mut order = array(|i| i);
        for k in 0..N {
            let mut best = k;
            for i in k + 1..N {
                if factor[i][k].size() > factor[best][k].size() {
                    best = i;
                }
            }
            factor.swap(k, best);
            order.swap(k, best);
            inverse[k] = factor[k][k].recip();
            let above = factor[k];
            for row in factor.iter_mut().skip(k + 1) {
                let l = row[k] * inverse[k];
                row[k] = l;
                for j in k + 1..N {
                    row[j] = row[j] - l * above[j];
                }
            }
        }
        Self { factor, inverse, order }
    }

    /// x with M x = `b`.
    #[inline]
    pub(crate) fn solve(&self, b: &[Complex<R>; N]) -> [Complex<R>; N] {
        let mut x = self.order.each(|row| b[row]);
        for i in 0..N {
            for k in 0..i {
                x[i] = x[i] - self.factor[i][k] * x[k];
            }
        }
        for i in (0..N).rev() {
            for k in i + 1..N {
                x[i] = x[i] - self.factor[i][k] * x[k];
            }
            x[i] = x[i] * self.inverse[i];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::samples::Noise;

    fn largest<const N: usize>(matrix: &[[Complex<f64>; N]; N]) -> f64 {
        matrix.iter().flatten().map(|x| x.size()).fold(0.0, f64::max)
    }

    fn check<const N: usize>() {
        let mut noise = Noise(N as u64 + 7);
        for _ in 0..50 {
            let (re, im): ([[f64; N]; N], [[f64; N]; N]) = (noise.matrix(), noise.matrix());
            let mut m: [[Complex<f64>; N]; N] =
                core::array::from_fn(|i| core::array::from_fn(|j| Complex { re: re[i][j], im: im[i][j] }));
            // Without pivoting this has no factors.
            m[0][0] = if N > 1 { Complex { re: 0.0, im: 0.0 } } else { m[0][0] };
            let (re, im): ([f64; N], [f64; N]) = (noise.vector(), noise.vector());
            let b: [Complex<f64>; N] = core::array::from_fn(|i| Complex { re: re[i], im: im[i] });
            let x = ComplexLu::factor(m).solve(&b);
            let size = x.iter().map(|x| x.size()).fold(1.0, f64::max) * largest(&m);
            for i in 0..N {
                let sum = (0..N).fold(b[i], |sum, j| sum - m[i][j] * x[j]);
                assert!(sum.size() < 1e-13 * size, "size {N}: {sum:?}");
            }
        }
    }

    #[test]
    fn random_systems_are_solved_to_a_small_residual() {
        check::<1>();
        check::<2>();
        check::<3>();
        check::<7>();
    }

    #[test]
    fn extreme_scales_neither_overflow_nor_vanish() {
        for scale in [1e-200, 1e200] {
            let m = [[Complex::<f64> { re: 3.0 * scale, im: 4.0 * scale }]];
            let [x] = ComplexLu::factor(m).solve(&[Complex { re: 5.0 * scale, im: 0.0 }]);
            assert!((x.re - 0.6).abs() < 1e-15 && (x.im + 0.8).abs() < 1e-15, "{x:?}");
        }
    }

    #[test]
    fn a_singular_matrix_gives_no_number() {
        let one = Complex::<f64> { re: 1.0, im: 1.0 };
        let x = ComplexLu::factor([[one, one], [one, one]]).solve(&[one, one]);
        assert!(x.iter().any(|x| !x.size().is_finite()));
    }
}
