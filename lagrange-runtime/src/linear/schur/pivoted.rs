//! Schur complements with a small pivot: the generalised inverse, by pivots in the order of their size.

use crate::real::Real;

use super::super::saddle::vectors::{
    add_product, add_scaled, pick, poison, put, unit, weightiest, where_positive,
};
use super::super::saddle::{redundant, symmetric};
use super::{ROUNDINGS, SMALL, Schur};

impl<R: Real, const C: usize> Schur<R, C> {
    /// As [`Self::factor_with`], by pivots in the order of their size.
    #[cold]
    #[inline(never)]
    pub(super) fn carefully<const K: usize>(lower: &[[R; C]; C], rows: &mut [[R; K]; C]) -> Self {
        let this = Self::pivoted(lower);
        if C <= SMALL {
            *rows = this.factor.map(|row| add_product(&[R::zero(); K], rows, &row));
        }
        this
    }

    /// The generalised inverse, by Gauss–Jordan steps on [S, 1], the largest pivot relative to its diagonal first.
    fn pivoted(lower: &[[R; C]; C]) -> Self {
        let zero = R::zero();
        let tolerance = R::from_f64(ROUNDINGS * C as f64) * R::epsilon();
        let mut this = Self {
            factor: core::array::from_fn(unit),
            inverse: [R::one(); C],
            inverted: true,
            dropped: [true; C],
            rank: 0,
            is_doubtful: true,
            vanishing: (0..C).find(|&i| lower[i][i].abs().largest() == zero.largest()),
        };
        let mut s = symmetric(lower);
        // What is left of each row, relative to all of it; nothing of a row that is kept or zero.
        let mut kept = [C; C];
        for place in &mut kept {
            let left: [R; C] = core::array::from_fn(|i| {
                let open = this.dropped[i] && lower[i][i].largest() > zero.largest();
                if open { s[i][i] / lower[i][i] } else { zero }
            });
            let k = weightiest(&left, &core::array::from_fn(|i| lower[i][i]), tolerance);
            let (excess, pivot) = (pick(&left, k) - tolerance, s.get(k).map_or(zero, |row| pick(row, k)));
            let pivot = if excess.is_positive() { Some(pivot) } else { where_positive(pivot, excess) };
            let Some(pivot) = pivot else { break };
            this.step(&mut s, k, pivot);
            *place = k;
        }
        if this.rank < C {
            this.shorten(&s, &kept);
            // A row that is not a number is not a pivot, but it does not depend on others either. Nor does one whose
            // square is negative, which no positive masses can make.
            poison(this.factor.as_flattened_mut(), s.as_flattened());
            poison(this.factor.as_flattened_mut(), &core::array::from_fn::<_, C, _>(|i| lower[i][i].sqrt()));
        }
        this
    }

    /// Solves row k for component k and inserts it in the others.
    fn step(&mut self, s: &mut [[R; C]; C], k: usize, pivot: R) {
        let (Some(&above), Some(&known)) = (s.get(k), self.factor.get(k)) else { return };
        let inverse = pivot.recip();
        let (above, known) = (above.map(|x| x * inverse), known.map(|x| x * inverse));
        for (i, (row, solution)) in s.iter_mut().zip(&mut self.factor).enumerate() {
            let l = pick(row, k);
            add_scaled(row, &above, -l);
            add_scaled(solution, &known, -l);
            if i == k {
                (*row, *solution) = (above, known);
            }
        }
        put(&mut self.dropped, k, false);
        self.rank += 1;
    }

    /// The shortest multipliers instead of those that leave the dropped rows at zero.
    fn shorten(&mut self, s: &[[R; C]; C], kept: &[usize; C]) {
        // Row d of S is Σ x[k] · row k over the kept rows, and the x are what became of its column.
        let mut combinations = [[R::zero(); C]; C];
        for (to, &k) in combinations.iter_mut().zip(kept) {
            let Some(row) = s.get(k) else { continue };
            *to = unit(k);
            for (to, (&x, &dropped)) in to.iter_mut().zip(row.iter().zip(&self.dropped)) {
                if dropped {
                    *to = x;
                }
            }
        }
        let basis = redundant::basis(&combinations, self.rank);
        for (row, &dropped) in self.factor.iter_mut().zip(&self.dropped) {
            // A row is also a column of the symmetric inverse, and zero in the dropped rows.
            *row = if dropped { [R::zero(); C] } else { redundant::project(&basis, row, self.rank) };
        }
    }
}
