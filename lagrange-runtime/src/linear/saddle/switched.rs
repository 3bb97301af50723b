//! The saddle-point system with rows that can be switched off, and with friction that reactions drive.
//!
//! ```text
//! M v − Bᵀ κ = r        B = A + D        D: what a reaction adds to the force of its row, as friction −μ n t
//! A v        = y        of the active rows; κ = 0 of the others
//! ```
//!
//! With the inverse of the symmetric system, v = P (r + Dᵀκ) + Y y and κ = −Yᵀ(r + Dᵀκ) + T y, so that
//! (1 + Yᵀ Dᵀ) κ = −Yᵀ r + T y. Where that matrix is singular friction jams: no reaction, or any, keeps the
//! contact closed (Painlevé).
//!
//! Rows of [`loads`](super::loads) are no constraints, but have multipliers that follow from the others.

use super::loads::{Load, Loads};
use super::vectors::{add_scaled, pick, put};
use super::{Defect, Saddle, SaddlePoint};
use crate::linear::{Independence, Lu};
use crate::number::elements::{Each, array};
use crate::number::real::Real;

/// The inverse of a saddle-point system, rows of which are active or not.
#[derive(Clone, Copy, Debug)]
pub struct Switched<R, const N: usize, const C: usize> {
    saddle: Saddle<R, N, C>,
    /// P Dᵀ: the change of v by friction for each reaction.
    driven: [[R; N]; C],
    jam: Jam<R, C>,
}

/// 1 + Yᵀ Dᵀ.
#[derive(Clone, Copy, Debug)]
enum Jam<R, const C: usize> {
    /// No reaction drives friction.
    None,
    /// The reaction of one row does: the matrix is one except for its column. Its own entry is inverted.
    Single {
        row: usize,
        inverse: R,
        column: [R; C],
    },
    Regular(Lu<R, C>),
    /// The matrix with which reactions follow from given loads, and the loads, which depend on reactions.
    Loaded(Lu<R, C>, Loads<R, C>),
    Singular,
}

impl<R: Real, const N: usize, const C: usize> Switched<R, N, C> {
    /// Factors the system of a mass matrix that is positive definite on the null space of the active rows.
    ///
    /// Rows of `a` that are not active are not read.
    #[must_use]
    pub fn factor(mass: &[[R; N]; N], a: &[[R; N]; C], coupling: &[[R; N]; C], active: &[R; C]) -> Self {
        Self::with::<true>(mass, a, coupling, active, None)
    }

    /// The same of a symmetric matrix of any signature.
    #[must_use]
    pub fn factor_indefinite(
        mass: &[[R; N]; N],
        a: &[[R; N]; C],
        coupling: &[[R; N]; C],
        active: &[R; C],
    ) -> Self {
        Self::with::<false>(mass, a, coupling, active, None)
    }

    /// The same with rows that are loads, which are not active; `shares` has the factors of the sums.
    #[must_use]
    pub fn factor_loaded<const DEFINITE: bool>(
        mass: &[[R; N]; N],
        a: &[[R; N]; C],
        coupling: &[[R; N]; C],
        active: &[R; C],
        shares: &[[R; C]; C],
        loads: &'static [Load],
    ) -> Self {
        Self::with::<DEFINITE>(mass, a, coupling, active, Some((shares, loads)))
    }

    #[inline(always)]
    fn with<const DEFINITE: bool>(
        mass: &[[R; N]; N],
        a: &[[R; N]; C],
        coupling: &[[R; N]; C],
        active: &[R; C],
        loaded: Option<(&[[R; C]; C], &'static [Load])>,
    ) -> Self {
        let active = active.each(|x| x.is_positive());
        let saddle = Saddle::with_active::<DEFINITE>(mass, a, &active);
        let mut this = Self { saddle, driven: [[R::zero(); N]; C], jam: Jam::None };
        let mut matrix = [[R::zero(); C]; C];
        let (mut coupled, mut last) = (0, 0);
        let is_load =
            |row: usize| loaded.is_some_and(|(_, loads)| loads.iter().any(|load| load.row() == row));
        for (j, (row, &is_active)) in coupling.iter().zip(&active).enumerate() {
            if let Some(entries) = matrix.get_mut(j) {
                put(entries, j, R::one());
            }
            if !is_active && !is_load(j) || row.iter().all(|&x| x == R::zero()) {
                continue;
            }
            (coupled, last) = (coupled + 1, j);
            let (driven, reaction) = this.saddle.solve(row, &[R::zero(); C]);
            put(&mut this.driven, j, driven);
            for (entries, x) in matrix.iter_mut().zip(reaction) {
                let entry = pick(entries, j) - x;
                put(entries, j, entry);
            }
        }
        if let Some((shares, _)) = loaded {
            for (row, shares) in matrix.iter_mut().zip(shares) {
                for (entry, &share) in row.iter_mut().zip(shares) {
                    *entry -= share;
                }
            }
        }
        if loaded.is_none() && coupled == 1 {
            this.jam = Jam::single(&matrix, last);
        } else if loaded.is_some() || coupled > 0 {
            this.jam = Lu::factor(matrix).map_or(Jam::Singular, |lu| match loaded {
                None => Jam::Regular(lu),
                Some((shares, table)) => {
                    Loads::new(table, shares, &lu).map_or(Jam::Singular, |loads| Jam::Loaded(lu, loads))
                }
            });
        }
        this
    }

    /// [`solve_motion`](SaddlePoint::solve_motion) for an order of a series, from 1 on. `known` are the
    /// multipliers of the orders before, and κ is `rate` times those of this one. For rows that are sums of
    /// others `y` is the lack.
    #[must_use]
    pub fn solve_order(
        &self,
        order: usize,
        rate: R,
        known: &[R],
        r: &[R; N],
        y: &[R; C],
    ) -> ([R; N], [R; C]) {
        let Jam::Loaded(lu, loads) = &self.jam else { return self.solve_motion(r, y) };
        let (v, mut free) = self.saddle.solve(r, y);
        for row in loads.sums() {
            put(&mut free, row, -(rate * pick(y, row)));
        }
        let known = known.as_chunks::<C>().0;
        let known = known.get(..order - 1).unwrap_or(known);
        self.driven(v, loads.solve_order(&lu.solve(free), || self.load_sizes(loads, r, y), rate, known))
    }

    /// Adds the change of v by friction.
    #[inline]
    fn driven(&self, mut v: [R; N], kappa: [R; C]) -> ([R; N], [R; C]) {
        for (driven, &x) in self.driven.iter().zip(&kappa) {
            add_scaled(&mut v, driven, x);
        }
        (v, kappa)
    }

    /// Σ |terms| of the multipliers that make loads, and of the loads.
    fn load_sizes(&self, loads: &Loads<R, C>, r: &[R; N], y: &[R; C]) -> [R; C] {
        let mut sizes = [R::zero(); C];
        for row in loads.terms() {
            let unit = array(|own| if own == row { R::one() } else { R::zero() });
            // A row of −Yᵀ and T.
            let (by_force, by_rate) = self.saddle.solve(&[R::zero(); N], &unit);
            let size = by_force.iter().zip(r).chain(by_rate.iter().zip(y));
            put(&mut sizes, row, size.fold(R::zero(), |sum, (&one, &other)| sum + (one * other).abs()));
        }
        loads.bound(&mut sizes);
        sizes
    }

    /// Adds to bounds of multipliers those of the rows that follow from them.
    pub(crate) fn bound_loads(&self, bounds: &mut [R; C]) {
        if let Jam::Loaded(_, loads) = &self.jam {
            loads.bound(bounds);
        }
    }
}

impl<R: Real, const C: usize> Jam<R, C> {
    /// Factors a matrix that is one except for a column. With that row first it is triangular, and solving by
    /// substitution needs no pivots.
    #[inline]
    fn single(matrix: &[[R; C]; C], row: usize) -> Self {
        let column: [R; C] = array(|i| pick(&matrix[i], row));
        let own = pick(&column, row);
        // The entry is one plus the effect of friction on the reaction.
        let size = R::one() + (own - R::one()).abs();
        let ulps = R::from_f64(2.0 * C as f64) * R::epsilon();
        if (own.abs() - ulps * size).is_positive() {
            Jam::Single { row, inverse: own.recip(), column }
        } else {
            Jam::Singular
        }
    }
}

impl<R: Real, const N: usize, const C: usize> SaddlePoint<R, N, C> for Switched<R, N, C> {
    type Gradients = [[R; N]; C];

    #[inline]
    fn solve(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]) {
        self.saddle.solve(r, y)
    }

    #[inline]
    fn solve_motion(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]) {
        let (v, kappa) = self.saddle.solve(r, y);
        match &self.jam {
            Jam::None => (v, kappa),
            Jam::Single { row, inverse, column } => {
                let (mut v, mut kappa) = (v, kappa);
                let own = pick(&kappa, *row) * *inverse;
                add_scaled(&mut kappa, column, -own);
                put(&mut kappa, *row, own);
                if let Some(driven) = self.driven.get(*row) {
                    add_scaled(&mut v, driven, own);
                }
                (v, kappa)
            }
            Jam::Regular(lu) => self.driven(v, lu.solve(kappa)),
            Jam::Loaded(lu, loads) => {
                self.driven(v, loads.solve(&lu.solve(kappa), || self.load_sizes(loads, r, y)))
            }
            Jam::Singular => ([R::from_f64(f64::NAN); N], [R::from_f64(f64::NAN); C]),
        }
    }

    #[inline]
    fn independence(&self) -> Independence<R> {
        self.saddle.independence()
    }

    fn defect(&self) -> Option<Defect> {
        match self.jam {
            Jam::Singular => Some(Defect::NotFinite),
            _ => self.saddle.defect(),
        }
    }

    #[inline]
    fn vanishing(&self) -> Option<usize> {
        self.saddle.vanishing()
    }

    #[inline]
    fn units(&self) -> [R; N] {
        self.saddle.units()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MASS: [[f64; 3]; 3] = [[2.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.0, 0.25, 3.0]];
    const ROWS: [[f64; 3]; 2] = [[1.0, 0.5, 0.0], [0.0, 1.0, -1.0]];

    #[test]
    fn inactive_rows_have_no_say() {
        let (r, y) = ([1.0, -2.0, 0.5], [0.25, 7.0]);
        let one = Saddle::factor(&MASS, &[ROWS[0]]).solve(&r, &[y[0]]);
        let two = Switched::factor(&MASS, &ROWS, &[[0.0; 3]; 2], &[1.0, 0.0]);
        let (v, kappa) = two.solve_motion(&r, &y);
        assert!(v.iter().zip(&one.0).all(|(a, b)| (a - b).abs() < 1e-14), "{v:?} {one:?}");
        assert!((kappa[0] - one.1[0]).abs() < 1e-14);
        assert_eq!(kappa[1], 0.0);
        assert_eq!((two.independence().rows, two.independence().rank), (1, 1));
        let none = Switched::factor(&MASS, &ROWS, &[[0.0; 3]; 2], &[0.0, 0.0]);
        assert_eq!(none.solve_motion(&r, &y).1, [0.0; 2]);
        assert_eq!(none.vanishing(), None);
    }

    #[test]
    fn friction_follows_its_reaction() {
        // A block of 2 kg on a floor, pushed by 1 N and its weight, slipping with μ = 0.3.
        let mass = [[2.0, 0.0], [0.0, 2.0]];
        let (normal, friction) = ([0.0, 1.0], [-0.3, 0.0]);
        let switched = Switched::factor(&mass, &[normal, [1.0, 0.0]], &[friction, [0.0; 2]], &[1.0, 0.0]);
        let (a, lambda) = switched.solve_motion(&[1.0, -20.0], &[0.0; 2]);
        assert!((lambda[0] - 20.0).abs() < 1e-13 && (a[0] - (1.0 - 6.0) / 2.0).abs() < 1e-14, "{a:?}");
        assert!(a[1].abs() < 1e-14);
    }

    /// M v − (A + D)ᵀ κ = r and A v = y, where the reaction of one row drives friction in any direction.
    #[test]
    fn one_reaction_that_drives_friction_balances_with_the_other() {
        let mass = [[2.0, 0.5, 0.0], [0.5, 1.0, 0.25], [0.0, 0.25, 3.0]];
        let (r, y) = ([1.0, -2.0, 0.5], [0.25, 0.75]);
        for driving in [0, 1] {
            let mut coupling = [[0.0; 3]; 2];
            coupling[driving] = [0.3, -0.2, 0.4];
            let (v, kappa) = Switched::factor(&mass, &ROWS, &coupling, &[1.0; 2]).solve_motion(&r, &y);
            for i in 0..3 {
                let borne = (0..2).map(|c| (ROWS[c][i] + coupling[c][i]) * kappa[c]).sum::<f64>();
                let inertia = (0..3).map(|j| mass[i][j] * v[j]).sum::<f64>();
                assert!((inertia - borne - r[i]).abs() < 1e-14, "{v:?} {kappa:?}");
            }
            for c in 0..2 {
                assert!(((0..3).map(|j| ROWS[c][j] * v[j]).sum::<f64>() - y[c]).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn friction_that_takes_all_of_its_reaction_jams() {
        let unit = [[1.0, 0.0], [0.0, 1.0]];
        for (taken, jams) in [(1.0, true), (1.0 - 1e-12, false)] {
            let switched = Switched::factor(&unit, &[[0.0, 1.0]], &[[0.0, -taken]], &[1.0]);
            assert_eq!(switched.defect() == Some(Defect::NotFinite), jams);
            let [kappa]: [f64; 1] = switched.solve_motion(&[0.0, -1.0], &[0.0]).1;
            assert_eq!(kappa.is_nan(), jams);
        }
    }

    #[test]
    fn dependent_active_rows_are_no_defect() {
        let rows = [ROWS[0], ROWS[0], ROWS[1]];
        let switched = Switched::factor(&MASS, &rows, &[[0.0; 3]; 3], &[1.0, 1.0, 0.0]);
        assert_eq!((switched.independence().rows, switched.independence().rank), (2, 1));
        assert_eq!((switched.vanishing(), switched.defect()), (None, None));
        let (v, kappa) = switched.solve_motion(&[1.0, 2.0, 3.0], &[0.0; 3]);
        assert!((v[0] + 0.5 * v[1]).abs() < 1e-14 && (kappa[0] - kappa[1]).abs() < 1e-13, "{v:?} {kappa:?}");
    }
}
