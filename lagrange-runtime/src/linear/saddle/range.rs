//! Scaling and the Householder QR of Aᵀ with column pivoting: independent rows, their right inverse, the null space.
//!
//! A coordinate is measured in units of 1/√M\[i]\[i], in which a step of 1 costs the same kinetic energy in all of
//! them, and a row of A in units of the sum of its magnitudes. In these units the rows are eliminated, longest first.
//!
//! The reflector of step k maps what is left of its row on one coordinate, the one with the largest component, and is
//! zero in those of earlier steps: with the sign that avoids cancellation this keeps the error of every coordinate
//! relative to that coordinate (Cox and Higham, "Stability of Householder QR factorization for weighted least squares
//! problems", 1998), and it needs no exchange of coordinates.

use crate::real::Real;

use super::vectors::{add_scaled, dot, magnitude, where_positive};

/// A row whose distance from the span of the rows before is less than 2¹² ε of its size depends on them.
///
/// A distance is known to some Nε, amplified by how close to each other the rows before are, and a gradient is often
/// itself a difference of larger numbers. What is above the tolerance has three digits in `f64` and `f32` alike.
const ROUNDINGS: f64 = 4096.0;

/// The independent rows of A and the reflectors that make them triangular.
pub(super) struct Range<R, const N: usize, const C: usize> {
    /// Units of the coordinates.
    pub(super) scale: [R; N],
    /// Sizes of the rows of A in these units; this and all below in the order of `order`.
    size: [R; C],
    /// The row of A in each place; independent ones first.
    pub(super) order: [usize; C],
    /// u of 1 − β u uᵀ.
    reflectors: [[R; N]; C],
    beta: [R; C],
    /// A in terms of the orthonormal vectors, triangular in the independent rows; without the diagonal.
    lower: [[R; C]; C],
    /// 1 / diagonal.
    inverse: [R; C],
    /// The coordinate on which each step maps its row; the rest of the coordinates follow.
    lead: [usize; N],
    pub(super) rank: usize,
    pub(super) vanishing: Option<usize>,
}

impl<R: Real, const N: usize, const C: usize> Range<R, N, C> {
    #[inline(always)]
    pub(super) fn factor(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        let scale = units(mass, a);
        let mut rows = *a;
        let mut this = Self {
            scale,
            size: [R::zero(); C],
            order: core::array::from_fn(|c| c),
            reflectors: [[R::zero(); N]; C],
            beta: [R::zero(); C],
            lower: [[R::zero(); C]; C],
            inverse: [R::zero(); C],
            lead: core::array::from_fn(|i| i),
            rank: C.min(N),
            vanishing: None,
        };
        for c in 0..C {
            for i in 0..N {
                rows[c][i] *= scale[i];
            }
            this.size[c] = magnitude(&rows[c]);
            let mut factor = this.size[c].recip();
            if this.size[c].largest() == R::zero().largest() {
                this.vanishing = this.vanishing.or(Some(c));
                factor = R::zero();
            }
            for i in 0..N {
                rows[c][i] *= factor;
            }
        }
        let mut squares: [R; C] = core::array::from_fn(|c| dot(&rows[c], &rows[c]));
        let least = R::from_f64(ROUNDINGS) * R::epsilon();
        let least = least * least;
        for k in 0..C.min(N) {
            let mut best = k;
            for c in k + 1..C {
                if squares[c].largest() > squares[best].largest() {
                    best = c;
                }
            }
            for c in k + 1..C {
                if c == best {
                    (rows[k], rows[c]) = (rows[c], rows[k]);
                    (this.lower[k], this.lower[c]) = (this.lower[c], this.lower[k]);
                    (squares[k], squares[c]) = (squares[c], squares[k]);
                    (this.size[k], this.size[c]) = (this.size[c], this.size[k]);
                    (this.order[k], this.order[c]) = (this.order[c], this.order[k]);
                }
            }
            let mut square = squares[k];
            if !(square - least).is_positive() {
                match where_positive(square, square - least) {
                    Some(lanes) => square = lanes,
                    None => {
                        this.rank = k;
                        break;
                    }
                }
            }
            this.reflect(&mut rows, &mut squares, square, k);
        }
        this
    }

    /// Step k: the reflector of row k, applied to the rows after it.
    #[inline(always)]
    fn reflect(&mut self, rows: &mut [[R; N]; C], squares: &mut [R; C], square: R, k: usize) {
        let mut u = rows[k];
        let (mut lead, mut largest) = (0, R::zero());
        for i in 0..N {
            if u[i].abs().largest() > largest.abs().largest() {
                (lead, largest) = (i, u[i]);
            }
        }
        let norm = square.sqrt();
        let diagonal = -(largest.signum() * norm);
        for i in 0..N {
            if i == lead {
                u[i] -= diagonal;
            }
        }
        let place = self.lead.iter().position(|&i| i == lead).unwrap_or(k);
        self.lead.swap(k, place);
        let beta = (square + norm * largest.abs()).recip();
        for c in k + 1..C {
            let along = dot(&u, &rows[c]) * beta;
            add_scaled(&mut rows[c], &u, -along);
            for i in 0..N {
                if i == lead {
                    self.lower[c][k] = rows[c][i];
                    rows[c][i] = R::zero();
                }
            }
            squares[c] = dot(&rows[c], &rows[c]);
        }
        self.reflectors[k] = u;
        self.beta[k] = beta;
        self.inverse[k] = diagonal.recip();
    }

    /// Orthonormal vectors, in the user's units: the first `rank` span the rows of A, the others its null space.
    #[inline(always)]
    pub(super) fn basis(&self, rank: usize) -> [[R; N]; N] {
        let mut basis = [[R::zero(); N]; N];
        for k in 0..N {
            for i in 0..N {
                if i == self.lead[k] {
                    basis[k][i] = R::one();
                }
            }
        }
        for j in (0..rank).rev() {
            for vector in basis.iter_mut().skip(j) {
                let along = dot(&self.reflectors[j], vector) * self.beta[j];
                add_scaled(vector, &self.reflectors[j], -along);
            }
        }
        for vector in &mut basis {
            for i in 0..N {
                vector[i] *= self.scale[i];
            }
        }
        basis
    }

    /// Y₀ᵀ with A Y₀ = 1 on the independent rows: velocities in the range of Aᵀ.
    #[inline(always)]
    pub(super) fn right_inverse(&self, basis: &[[R; N]; N], rank: usize) -> [[R; N]; C] {
        let mut inverse = [[R::zero(); N]; C];
        for k in (0..rank).rev() {
            let mut vector = basis[k];
            for c in k + 1..rank {
                add_scaled(&mut vector, &inverse[c], -self.lower[c][k]);
            }
            inverse[k] = vector.map(|x| x * self.inverse[k]);
        }
        for k in 0..rank {
            let factor = self.size[k].recip();
            inverse[k] = inverse[k].map(|x| x * factor);
        }
        inverse
    }

    /// For each of the first `rank` rows, its coefficient in every row of A, in the user's order and units.
    pub(super) fn combinations(&self, rank: usize) -> [[R; C]; C] {
        let rank = rank.min(C);
        let mut combinations = [[R::zero(); C]; C];
        for c in 0..C {
            let mut coefficients = [R::zero(); C];
            if c < rank {
                coefficients[c] = R::one();
            } else {
                for k in (0..rank).rev() {
                    let mut sum = self.lower[c][k];
                    for j in k + 1..rank {
                        sum -= coefficients[j] * self.lower[j][k];
                    }
                    coefficients[k] = sum * self.inverse[k];
                }
            }
            for k in 0..rank {
                let unit = if c == k { R::one() } else { self.size[c] / self.size[k] };
                if let Some(to) = combinations[k].get_mut(self.order[c]) {
                    *to = coefficients[k] * unit;
                }
            }
        }
        combinations
    }
}

/// 1/√M\[i]\[i] where that exists in all lanes.
#[inline(always)]
fn units<R: Real, const N: usize, const C: usize>(mass: &[[R; N]; N], a: &[[R; N]; C]) -> [R; N] {
    let mut inertia = [R::zero(); N];
    let mut all = true;
    for i in 0..N {
        inertia[i] = mass[i][i].abs();
        all &= inertia[i].is_positive();
    }
    if all { inertia.map(|m| m.sqrt().recip()) } else { completed(mass, a, &inertia) }
}

/// Units of coordinates without inertia of their own.
///
/// By what ties them to coordinates whose units are known: a coupling in M of size 1, or else columns of A as large as
/// the rows are in the others. If nothing does, the first gets the unit of its largest row, and the others follow.
#[cold]
#[inline(never)]
fn completed<R: Real, const N: usize, const C: usize>(
    mass: &[[R; N]; N],
    a: &[[R; N]; C],
    inertia: &[R; N],
) -> [R; N] {
    let zero = R::zero();
    let usable = |x: R| x.is_positive() && x.recip().is_positive() && x.recip().is_finite();
    let mut units = [zero; N];
    let mut known = [false; N];
    for i in 0..N {
        let unit = inertia[i].sqrt().recip();
        if usable(unit) {
            (units[i], known[i]) = (unit, true);
        }
    }
    for _ in 0..N {
        let before = (units, known);
        let size = |c: usize| a[c].iter().zip(&before.0).map(|(&a, &unit)| a.abs() * unit).sum::<R>();
        let mut progress = false;
        for i in 0..N {
            if known[i] {
                continue;
            }
            let coupling = (0..N).map(|j| mass[i][j].abs() * before.0[j]).sum::<R>();
            let tie = (0..C).filter(|&c| usable(size(c))).map(|c| a[c][i].abs() / size(c)).sum::<R>();
            for unit in [coupling.recip(), tie.recip()] {
                if usable(unit) && !known[i] {
                    (units[i], known[i], progress) = (unit, true, true);
                }
            }
        }
        if let (false, Some(i)) = (progress, known.iter().position(|known| !known)) {
            if let (Some(unit), Some(known), Some(row)) = (units.get_mut(i), known.get_mut(i), mass.get(i)) {
                let coupling = magnitude(row).sqrt().recip();
                let tie = a.iter().filter_map(|row| row.get(i)).map(|a| a.abs()).sum::<R>().recip();
                let first = [coupling, tie].into_iter().find(|&unit| usable(unit));
                (*unit, *known) = (first.unwrap_or(R::one()), true);
            }
        }
    }
    units
}
