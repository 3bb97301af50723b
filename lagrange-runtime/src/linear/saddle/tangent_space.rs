//! The velocities that constraints leave open, as a basis of vectors.

use super::range::Range;
use super::scaled::Scaled;
use super::symmetric;
use crate::number::elements::Each;
use crate::number::real::Real;

/// Vectors that span the null space of A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TangentSpace<R, const N: usize> {
    /// The vectors, one a row; the rows from `count` on are zero.
    pub vectors: [[R; N]; N],
    /// How many there are.
    pub count: usize,
    /// Squares of the sizes of the coordinates, in which the vectors are orthonormal: Σ mᵢ zᵢ zᵢ = 1.
    pub metric: [R; N],
}

impl<R: Real, const N: usize> TangentSpace<R, N> {
    /// The null space of `a`, orthonormal in the metric of the diagonal of `mass`; where that is zero, a size
    /// that the constraints suggest takes its place. Without rows it is all of space, as unit vectors.
    pub fn new<const C: usize>(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        let scaled = Scaled::new(&symmetric(mass), a);
        let metric = scaled.units.each(|unit| (unit * unit).recip());
        let mut vectors = [[R::zero(); N]; N];
        if C == 0 {
            for (i, vector) in vectors.iter_mut().enumerate() {
                vector[i] = R::one();
            }
            return Self { vectors, count: N, metric };
        }
        let range = Range::factor(&scaled);
        let null = range.split().null;
        let count = N - range.rank.min(N);
        for (to, from) in vectors.iter_mut().zip(null.iter().skip(N - count)) {
            *to = *from;
        }
        Self { vectors, count, metric }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_are_orthonormal_and_annihilated() {
        let mass = [[2.0, 0.3, 0.0], [0.3, 50.0, 0.0], [0.0, 0.0, 0.5]];
        // The second row depends on the first one, or does not.
        for (second, count) in [([2.0, -4.0, 1.0], 2), ([2.0, -4.0, 3.0], 1)] {
            let a = [[1.0, -2.0, 0.5], second];
            let space = TangentSpace::new(&mass, &a);
            assert_eq!(space.count, count);
            let (vectors, rest) = space.vectors.split_at(count);
            assert!(rest.iter().flatten().all(|&x| x == 0.0));
            for (k, z) in vectors.iter().enumerate() {
                for row in &a {
                    assert!(row.iter().zip(z).map(|(a, z)| a * z).sum::<f64>().abs() < 1e-14);
                }
                for (l, y) in vectors.iter().enumerate() {
                    let product: f64 = (0..3).map(|i| space.metric[i] * z[i] * y[i]).sum();
                    assert!((product - f64::from(u8::from(k == l))).abs() < 1e-15);
                }
            }
        }
    }

    #[test]
    fn without_constraints_every_coordinate_is_free() {
        let space = TangentSpace::new::<0>(&[[4.0, 0.0], [0.0, 9.0]], &[]);
        assert_eq!((space.count, space.vectors), (2, [[1.0, 0.0], [0.0, 1.0]]));
    }
}
