//! Random matrices and the backward error, for the tests of the factorisations.

use crate::number::elements::array;

/// A reproducible source of numbers in \[−1, 1): a 64-bit linear congruential generator.
pub(crate) struct Noise(pub u64);

impl Noise {
    pub(crate) fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub(crate) fn vector<const N: usize>(&mut self) -> [f64; N] {
        array(|_| self.number())
    }

    pub(crate) fn matrix<const N: usize>(&mut self) -> [[f64; N]; N] {
        array(|_| self.vector())
    }
}

/// Normwise backward error of x as a solution of M x = b.
pub(crate) fn residual<const N: usize>(m: &[[f64; N]; N], x: &[f64; N], b: &[f64; N]) -> f64 {
    let largest = |v: &[f64]| v.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    let size = m.iter().map(|row| row.iter().map(|a| a.abs()).sum()).fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for i in 0..N {
        let left: f64 = (0..N).map(|j| m[i][j] * x[j]).sum();
        worst = worst.max((left - b[i]).abs());
    }
    worst / (size * largest(x) + largest(b))
}
