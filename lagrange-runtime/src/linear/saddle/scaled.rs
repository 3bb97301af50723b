//! Units in which no coordinate and no constraint is larger than another.
//!
//! A coordinate is measured in units of 1/√M\[i]\[i], in which a velocity of 1 has the same kinetic energy in all of
//! them, and a row of A in units of the sum of its magnitudes. Decisions and rounding errors are then independent of
//! the user's units.

use crate::real::Real;

use super::Defect;
use super::vectors::magnitude;

/// A in these units.
#[derive(Clone, Copy)]
pub(super) struct Scaled<R, const N: usize, const C: usize> {
    /// Units of the coordinates.
    pub(super) units: [R; N],
    /// Sizes of the rows, in units of the coordinates.
    pub(super) sizes: [R; C],
    /// 1 / sizes: of the magnitudes in a row the sum is 1. A row of zeros becomes NaN.
    pub(super) factors: [R; C],
    pub(super) rows: [[R; N]; C],
}

impl<R: Real, const N: usize, const C: usize> Scaled<R, N, C> {
    #[inline(always)]
    pub(super) fn new(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        let units = units(mass, a);
        let mut rows = *a;
        let mut sizes = [R::zero(); C];
        let mut factors = [R::zero(); C];
        for c in 0..C {
            for i in 0..N {
                rows[c][i] *= units[i];
            }
            sizes[c] = magnitude(&rows[c]);
            factors[c] = sizes[c].recip();
            for x in &mut rows[c] {
                *x *= factors[c];
            }
        }
        Self { units, sizes, factors, rows }
    }

    /// The defect of a motion without inertia: its largest component, in these units.
    pub(super) fn defect(&self, motion: &[R; N]) -> Defect {
        let (mut coordinate, mut size) = (0, R::zero().largest());
        for i in 0..N {
            let candidate = (motion[i] / self.units[i]).abs();
            if !candidate.is_finite() {
                return Defect::NotFinite;
            }
            if candidate.largest() > size {
                (coordinate, size) = (i, candidate.largest());
            }
        }
        Defect::Singular { coordinate }
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
