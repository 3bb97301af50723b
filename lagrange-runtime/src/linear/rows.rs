//! M = Lᵀ D L of a symmetric positive definite matrix, for right-hand sides with many columns.
//!
//! Velocities are eliminated from the last to the first. What hangs on a link is declared after it, so a
//! tree fills no entry: the zeros of M, which are passed over, are zeros of L (Featherstone, *Rigid Body
//! Dynamics Algorithms*, section 6.3). Columns are solved for many at a time, side by side on vectors,
//! because what one waits for the others do not.

use crate::number::real::Real;

/// Columns that are solved for side by side: eight vectors of four, each with one result under way, fill
/// the time that a result takes.
pub(crate) const COLUMNS: usize = 32;
/// Those of a last few.
pub(crate) const FEW: usize = 16;

/// The factors of a symmetric positive definite matrix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows<R, const N: usize> {
    /// L without its unit diagonal, below the diagonal; what stands elsewhere is of no use.
    factor: [[R; N]; N],
    /// 1 / D.
    inverse: [R; N],
    /// Where a row of L is not zero, and where a column is not.
    rows: Places<N>,
    columns: Places<N>,
}

/// Lists of places.
#[derive(Clone, Copy, Debug)]
struct Places<const N: usize> {
    places: [[u16; N]; N],
    counts: [usize; N],
}

impl<const N: usize> Places<N> {
    fn new() -> Self {
        Places { places: [[0; N]; N], counts: [0; N] }
    }

    fn push(&mut self, list: usize, place: usize) {
        self.places[list][self.counts[list]] = place as u16;
        self.counts[list] += 1;
    }

    fn of(&self, list: usize) -> impl Iterator<Item = usize> {
        self.places[list][..self.counts[list]].iter().map(|&place| usize::from(place))
    }
}

impl<R: Real, const N: usize> Rows<R, N> {
    /// Factors a matrix, of which only the lower triangle is read; `None` where a pivot is not positive
    /// beyond rounding, by the bound of `Ldlt`.
    pub fn factor(matrix: &[[R; N]; N]) -> Option<Self> {
        let mut factor = *matrix;
        let mut inverse = [R::zero(); N];
        let (mut rows, mut columns) = (Places::new(), Places::new());
        let mut threshold = R::zero();
        let ulps = R::epsilon() + R::epsilon();
        for k in (0..N).rev() {
            threshold += ulps;
            let row = factor[k];
            let pivot = row[k];
            if !((pivot - threshold * matrix[k][k]).is_positive() && pivot.is_positive()) {
                return None;
            }
            inverse[k] = pivot.recip();
            for i in (0..k).filter(|&i| row[i] != R::zero()) {
                rows.push(k, i);
                columns.push(i, k);
                let l = row[i] * inverse[k];
                factor[k][i] = l;
                for j in rows.of(k) {
                    factor[i][j] = R::mul_add(-l, row[j], factor[i][j]);
                }
            }
        }
        Some(Self { factor, inverse, rows, columns })
    }

    /// Solves for some columns in place.
    pub fn solve<const W: usize>(&self, right: &mut [[R; W]; N]) {
        for k in (0..N).rev() {
            let mut load = right[k];
            for i in self.columns.of(k) {
                subtract(&mut load, self.factor[i][k], &right[i]);
            }
            right[k] = load;
        }
        for k in 0..N {
            let mut value = right[k].map(|load| load * self.inverse[k]);
            for i in self.rows.of(k) {
                subtract(&mut value, self.factor[k][i], &right[i]);
            }
            right[k] = value;
        }
    }
}

/// row ← row − l · other.
#[inline(always)]
fn subtract<R: Real, const W: usize>(row: &mut [R; W], l: R, other: &[R; W]) {
    for (entry, &other) in row.iter_mut().zip(other) {
        *entry = R::mul_add(-l, other, *entry);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::Lu;
    use crate::linear::samples::Noise;

    /// Of a tree: two branches that share the first three velocities.
    fn tree(noise: &mut Noise) -> [[f64; 7]; 7] {
        let mut roots: [[f64; 7]; 7] = noise.matrix();
        for (i, row) in roots.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                if j > i || (i >= 5 && (3..5).contains(&j)) {
                    *entry = 0.0;
                }
            }
            row[i] += 2.0;
        }
        core::array::from_fn(|i| core::array::from_fn(|j| (0..7).map(|k| roots[k][i] * roots[k][j]).sum()))
    }

    #[test]
    fn all_columns_are_those_of_elimination_with_pivots() {
        let mut noise = Noise(3);
        for _ in 0..20 {
            let m = tree(&mut noise);
            let mut right: [[f64; COLUMNS]; 7] = core::array::from_fn(|_| noise.vector());
            let given = right;
            let factors = Rows::factor(&m).unwrap();
            assert_eq!(factors.factor[6][3..5], [0.0, 0.0], "a tree fills nothing");
            factors.solve(&mut right);
            let other = Lu::factor(m).unwrap();
            for j in 0..COLUMNS {
                let x = other.solve(core::array::from_fn(|i| given[i][j]));
                let size = x.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                for i in 0..7 {
                    assert!((x[i] - right[i][j]).abs() <= 1e-12 * size, "{} {}", x[i], right[i][j]);
                }
            }
        }
    }

    #[test]
    fn what_is_not_definite_is_refused() {
        assert!(Rows::factor(&[[0.0, 0.0], [0.0, 1.0]]).is_none());
        assert!(Rows::factor(&[[1.0, 1.0], [1.0, 1.0]]).is_none());
        assert!(Rows::factor(&[[-1.0, 0.0], [0.0, 1.0]]).is_none());
        assert!(Rows::factor(&[[1.0, 0.0], [0.0, f64::NAN]]).is_none());
    }

    #[test]
    fn a_pivot_that_is_nothing_but_rounding_is_refused() {
        // What is left of the first entry is ε: half of the bound for two pivots.
        assert!(Rows::factor(&[[1.0, 1.0], [1.0, 1.0 + f64::EPSILON]]).is_none());
        assert!(Rows::factor(&[[1.0, 1.0], [1.0, 1.0 + 32.0 * f64::EPSILON]]).is_some());
    }
}
