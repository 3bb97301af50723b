//! M = Lᵀ D L of a symmetric positive definite matrix, for right-hand sides with many columns.
//!
//! Velocities are eliminated from the last to the first. What hangs on a link is declared after it, so a
//! tree fills no entry: the zeros of M, which are passed over, are zeros of L (Featherstone, *Rigid Body
//! Dynamics Algorithms*, section 6.3). All columns are solved for side by side, in vectors of a row. So while
//! one column waits for a result another is computed, and rows stay in the order in which they are stored.

use crate::number::elements::array;
use crate::number::real::Real;

/// The number of doubles in the longest vectors.
const LANES: usize = 8;

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
    /// Room for the factors of a matrix.
    pub fn new() -> Self {
        let zero = R::zero();
        Rows { factor: [[zero; N]; N], inverse: [zero; N], rows: Places::new(), columns: Places::new() }
    }

    /// Where the matrix is put.
    pub fn matrix(&mut self) -> &mut [[R; N]; N] {
        &mut self.factor
    }

    /// Factors the matrix, of which only the lower triangle counts; false where a pivot is not positive
    /// beyond rounding, by the bound of `Ldlt`.
    #[must_use]
    pub fn factor(&mut self) -> bool {
        (self.rows.counts, self.columns.counts) = ([0; N], [0; N]);
        let diagonal: [R; N] = array(|k| self.factor[k][k]);
        let mut threshold = R::zero();
        let ulps = R::epsilon() + R::epsilon();
        for k in (0..N).rev() {
            threshold += ulps;
            let row = self.factor[k];
            let pivot = row[k];
            if !((pivot - threshold * diagonal[k]).is_positive() && pivot.is_positive()) {
                return false;
            }
            let inverse = pivot.recip();
            self.inverse[k] = inverse;
            for i in (0..k).filter(|&i| row[i] != R::zero()) {
                self.rows.push(k, i);
                self.columns.push(i, k);
                let l = row[i] * inverse;
                self.factor[k][i] = l;
                // Vectors up to the diagonal: to pass over zeros would take longer.
                subtract_first(i + 1, &mut self.factor[i], l, &row);
            }
        }
        true
    }

    /// Solves for one column in place.
    pub fn solve_one(&self, right: &mut [R; N]) {
        for k in (0..N).rev() {
            let value = right[k];
            for i in self.rows.of(k) {
                right[i] = R::mul_add(-self.factor[k][i], value, right[i]);
            }
        }
        for k in 0..N {
            let mut value = right[k] * self.inverse[k];
            for i in self.rows.of(k) {
                value = R::mul_add(-self.factor[k][i], right[i], value);
            }
            right[k] = value;
        }
    }

    /// Solves for the columns of three matrices in place.
    pub fn solve<const K: usize>(
        &self,
        first: &mut [[R; N]; N],
        second: &mut [[R; N]; N],
        third: &mut [[R; K]; N],
    ) {
        let zero = R::zero();
        let mut ones = [Aligned([zero; N]); N];
        let (mut twos, mut threes) = (ones, [Aligned([zero; K]); N]);
        for k in (0..N).rev() {
            let (mut one, mut two, mut three) = (first[k], second[k], third[k]);
            for i in self.columns.of(k) {
                let l = self.factor[i][k];
                subtract(&mut one, l, &ones[i].0);
                subtract(&mut two, l, &twos[i].0);
                subtract(&mut three, l, &threes[i].0);
            }
            (ones[k].0, twos[k].0, threes[k].0) = (one, two, three);
        }
        for k in 0..N {
            let inverse = self.inverse[k];
            let (mut one, mut two, mut three) = (ones[k].0, twos[k].0, threes[k].0);
            scale(&mut one, inverse);
            scale(&mut two, inverse);
            scale(&mut three, inverse);
            for i in self.rows.of(k) {
                let l = self.factor[k][i];
                subtract(&mut one, l, &ones[i].0);
                subtract(&mut two, l, &twos[i].0);
                subtract(&mut three, l, &threes[i].0);
            }
            (ones[k].0, twos[k].0, threes[k].0) = (one, two, three);
            (first[k], second[k], third[k]) = (one, two, three);
        }
    }
}

/// A row that begins where a line of the cache begins: a vector that lies in two lines takes two accesses.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Aligned<R, const W: usize>([R; W]);

/// row ← row − l · other, in at least the first `count` entries.
#[inline(always)]
fn subtract_first<R: Real, const W: usize>(count: usize, row: &mut [R; W], l: R, other: &[R; W]) {
    let ((blocks, rest), (others, other_rest)) = (row.as_chunks_mut::<LANES>(), other.as_chunks::<LANES>());
    for (block, other) in blocks.iter_mut().zip(others).take(count.div_ceil(LANES)) {
        subtract(block, l, other);
    }
    if count > W - rest.len() {
        for (entry, &other) in rest.iter_mut().zip(other_rest) {
            *entry = R::mul_add(-l, other, *entry);
        }
    }
}

/// row ← factor · row.
#[inline(always)]
fn scale<R: Real, const W: usize>(row: &mut [R; W], factor: R) {
    row.iter_mut().for_each(|entry| *entry *= factor);
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

    fn factors<const N: usize>(matrix: &[[f64; N]; N]) -> Option<Rows<f64, N>> {
        let mut factors = Rows::new();
        *factors.matrix() = *matrix;
        factors.factor().then_some(factors)
    }

    fn are_solved<const W: usize>(factors: &Lu<f64, 7>, right: &[[f64; W]; 7], found: &[[f64; W]; 7]) {
        for j in 0..W {
            let x = factors.solve(core::array::from_fn(|i| right[i][j]));
            let size = x.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            for i in 0..7 {
                assert!((x[i] - found[i][j]).abs() <= 1e-12 * size, "{} {}", x[i], found[i][j]);
            }
        }
    }

    #[test]
    fn all_columns_are_those_of_elimination_with_pivots() {
        let mut noise = Noise(3);
        for _ in 0..20 {
            let m = tree(&mut noise);
            let (mut first, mut second) = (noise.matrix(), noise.matrix());
            let mut third: [[f64; 5]; 7] = core::array::from_fn(|_| noise.vector());
            let given = (first, second, third);
            let factors = factors(&m).unwrap();
            let mut one = given.0.map(|row| row[0]);
            factors.solve_one(&mut one);
            assert_eq!(factors.factor[6][3..5], [0.0, 0.0], "a tree fills nothing");
            factors.solve(&mut first, &mut second, &mut third);
            let other = Lu::factor(m).unwrap();
            are_solved(&other, &given.0.map(|row| [row[0]]), &one.map(|x| [x]));
            are_solved(&other, &given.0, &first);
            are_solved(&other, &given.1, &second);
            are_solved(&other, &given.2, &third);
        }
    }

    #[test]
    fn what_is_not_definite_is_refused() {
        assert!(factors(&[[0.0, 0.0], [0.0, 1.0]]).is_none());
        assert!(factors(&[[1.0, 1.0], [1.0, 1.0]]).is_none());
        assert!(factors(&[[-1.0, 0.0], [0.0, 1.0]]).is_none());
        assert!(factors(&[[1.0, 0.0], [0.0, f64::NAN]]).is_none());
    }

    #[test]
    fn a_pivot_that_is_nothing_but_rounding_is_refused() {
        // What is left of the first entry is ε: a quarter of the bound for two pivots.
        assert!(factors(&[[1.0, 1.0], [1.0, 1.0 + f64::EPSILON]]).is_none());
        assert!(factors(&[[1.0, 1.0], [1.0, 1.0 + 32.0 * f64::EPSILON]]).is_some());
    }
}
