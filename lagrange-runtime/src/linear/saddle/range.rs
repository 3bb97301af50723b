//! The Householder QR of Aᵀ with column pivoting, which reveals the rank: the one place where that is
//! decided.
//!
//! Rows are eliminated longest first. The reflector of step k maps what is left of its row on one coordinate,
//! the one with the largest component, and is zero in those of earlier steps: with the sign that avoids
//! cancellation this keeps the error of every coordinate relative to that coordinate (Cox and Higham,
//! "Stability of Householder QR factorization for weighted least squares problems", 1998), and it needs no
//! exchange of coordinates. Nothing depends on which coordinate that is, so lanes that disagree do no harm.

use crate::number::elements::{Each, array};
use crate::number::real::Real;

use super::Split;
use super::scaled::Scaled;
use super::vectors::{add_scaled, best, dot, multiply, pick, put, scale, unit, where_positive};
use crate::linear::independence::{CLEAR, Independence, dependent};

/// The independent rows of A and the reflectors that make them triangular.
pub(in crate::linear) struct Range<R, const N: usize, const C: usize> {
    units: [R; N],
    /// Sizes of the rows of A in these units. This and all fields below are in the order of `order`.
    sizes: [R; C],
    /// The rows of A in their order here; independent ones first.
    order: [usize; C],
    /// u of 1 − β u uᵀ.
    reflectors: [[R; N]; C],
    beta: [R; C],
    /// A in terms of the orthonormal vectors, triangular in the independent rows; without the diagonal.
    lower: [[R; C]; C],
    /// 1 / diagonal.
    inverse: [R; C],
    /// The coordinate on which each step maps its row; the rest of the coordinates follow.
    leads: [usize; N],
    pub(in crate::linear) rank: usize,
    /// The smallest distance of an independent row from the span of those before it.
    least: R,
    /// The index of that row.
    closest: usize,
    /// The first row of zeros.
    pub(in crate::linear) vanishing: Option<usize>,
}

impl<R: Real, const N: usize, const C: usize> Range<R, N, C> {
    /// Nothing eliminated yet.
    fn new(scaled: &Scaled<R, N, C>) -> Self {
        let zero = R::zero();
        Self {
            units: scaled.units,
            sizes: scaled.sizes,
            order: array(|c| c),
            reflectors: [[zero; N]; C],
            beta: [zero; C],
            lower: [[zero; C]; C],
            inverse: [zero; C],
            leads: array(|i| i),
            rank: C.min(N),
            least: R::one(),
            closest: 0,
            vanishing: None,
        }
    }

    /// The rows and the coordinates in the order given, without a decision for all lanes in common. `None`
    /// unless all rows are clearly independent in every lane.
    pub(in crate::linear) fn in_order(scaled: &Scaled<R, N, C>) -> Option<Self> {
        if C > N {
            return None;
        }
        let mut this = Self::new(scaled);
        let mut rows = scaled.rows;
        let whole: [R; C] = array(|c| dot(&rows[c], &rows[c]));
        let mut squares = whole;
        for k in 0..C {
            let square = squares[k];
            let distance = (square / whole[k]).sqrt();
            if !(distance - R::from_f64(CLEAR)).is_positive() {
                return None;
            }
            this.least = this.least.min(distance);
            this.reflect(&mut rows, &mut squares, square, (k, k));
        }
        Some(this)
    }

    pub(in crate::linear) fn factor(scaled: &Scaled<R, N, C>) -> Self {
        let zero = R::zero();
        let mut rows = scaled.rows;
        let mut vanishing = None;
        for c in (0..C).rev() {
            if scaled.sizes[c].largest() == zero.largest() {
                (rows[c], vanishing) = ([zero; N], Some(c));
            }
        }
        let mut this = Self { vanishing, ..Self::new(scaled) };
        let mut squares: [R; C] = array(|c| dot(&rows[c], &rows[c]));
        let least = dependent::<R>() * dependent();
        for k in 0..C.min(N) {
            let longest = best(&squares, least);
            for c in k + 1..C {
                if c == longest {
                    rows.swap(k, c);
                    squares.swap(k, c);
                    this.lower.swap(k, c);
                    this.sizes.swap(k, c);
                    this.order.swap(k, c);
                }
            }
            let excess = squares[k] - least;
            let square =
                if excess.is_positive() { Some(squares[k]) } else { where_positive(squares[k], excess) };
            let Some(square) = square else {
                this.rank = k;
                break;
            };
            // A row alone depends on no other.
            if k > 0 && (this.least - square.sqrt()).largest() > zero.largest() {
                (this.least, this.closest) = (this.least.min(square.sqrt()), k);
            }
            let (mut lead, mut largest) = (0, zero.largest());
            for (i, &x) in rows[k].iter().enumerate() {
                if x.abs().largest() > largest {
                    (lead, largest) = (i, x.abs().largest());
                }
            }
            this.reflect(&mut rows, &mut squares, square, (k, lead));
        }
        this
    }

    /// How independent the rows are.
    pub(in crate::linear) fn independence(&self) -> Independence<R> {
        let weakest = self.order.get(if self.rank < C { self.rank } else { self.closest });
        Independence { rows: C, rank: self.rank, least: self.least, weakest: weakest.copied().unwrap_or(0) }
    }

    /// Step k: the reflector of row k, which maps it on the coordinate `lead`, applied to the rows after it.
    #[inline(always)]
    fn reflect(
        &mut self,
        rows: &mut [[R; N]; C],
        squares: &mut [R; C],
        square: R,
        (k, lead): (usize, usize),
    ) {
        let mut u = rows[k];
        let largest = pick(&u, lead);
        let norm = square.sqrt();
        let diagonal = -(largest.signum() * norm);
        put(&mut u, lead, largest - diagonal);
        let index = self.leads.iter().position(|&i| i == lead).unwrap_or(k);
        self.leads.swap(k, index);
        let beta = (square + norm * largest.abs()).recip();
        for c in k + 1..C {
            // Nothing is left of it, or it is a row that does not act.
            if squares[c] == R::zero() {
                continue;
            }
            let along = dot(&u, &rows[c]) * beta;
            add_scaled(&mut rows[c], &u, -along);
            self.lower[c][k] = pick(&rows[c], lead);
            put(&mut rows[c], lead, R::zero());
            squares[c] = dot(&rows[c], &rows[c]);
        }
        squares[k] = R::zero();
        self.reflectors[k] = u;
        self.beta[k] = beta;
        self.inverse[k] = diagonal.recip();
    }

    /// The null space and the right inverse: A Y₀ = 1 on the independent rows, with velocities in the range
    /// of Aᵀ.
    pub(in crate::linear) fn split(&self) -> Split<R, N, C> {
        let rank = self.rank.min(C).min(N);
        let mut basis = self.leads.each(unit);
        for j in (0..rank).rev() {
            for vector in basis.iter_mut().skip(j) {
                let along = dot(&self.reflectors[j], vector) * self.beta[j];
                add_scaled(vector, &self.reflectors[j], -along);
            }
        }
        for vector in &mut basis {
            multiply(vector, &self.units);
        }
        for k in (0..rank).rev() {
            for c in k + 1..rank {
                let known = basis[c];
                add_scaled(&mut basis[k], &known, -self.lower[c][k]);
            }
            scale(&mut basis[k], self.inverse[k]);
        }
        let mut inverse = [[R::zero(); C]; N];
        for ((vector, size), &row_of) in basis.iter().zip(&self.sizes).zip(&self.order).take(rank) {
            let factor = size.recip();
            for (row, &x) in inverse.iter_mut().zip(vector) {
                put(row, row_of, x * factor);
            }
        }
        Split { null: basis, inverse }
    }

    /// For each independent row, its coefficient in every row of A, in the user's order and units.
    pub(in crate::linear) fn combinations(&self) -> [[R; C]; C] {
        let rank = self.rank.min(C);
        let mut combinations = [[R::zero(); C]; C];
        for c in 0..C {
            let mut coefficients = [R::zero(); C];
            if c < rank {
                coefficients[c] = R::one();
            } else {
                for k in (0..rank).rev() {
                    let known = coefficients.iter().zip(&self.lower).take(rank).skip(k + 1);
                    let sum = known.fold(self.lower[c][k], |sum, (&x, row)| sum - x * pick(row, k));
                    coefficients[k] = sum * self.inverse[k];
                }
            }
            for k in 0..rank {
                let unit = if c == k { R::one() } else { self.sizes[c] / self.sizes[k] };
                put(&mut combinations[k], self.order[c], coefficients[k] * unit);
            }
        }
        combinations
    }
}
