//! Units in which no coordinate and no constraint is larger than another.
//!
//! A coordinate is measured in units of 1/√M\[i]\[i], in which a velocity of 1 has the same kinetic energy in
//! all of them, and a row of A in units of the sum of its magnitudes. Decisions and rounding errors are then
//! independent of the user's units.

use crate::number::elements::array;
use crate::number::real::Real;

use super::Defect;
use super::vectors::{magnitude, multiply, put, scale};

/// A in these units.
#[derive(Clone, Copy)]
pub(in crate::linear) struct Scaled<R, const N: usize, const C: usize> {
    /// Units of the coordinates.
    pub(super) units: [R; N],
    /// Sizes of the rows, in units of the coordinates.
    pub(super) sizes: [R; C],
    /// 1 / sizes, by which the magnitudes in a row add up to 1. A row of zeros becomes NaN.
    pub(super) factors: [R; C],
    pub(super) rows: [[R; N]; C],
}

impl<R: Real, const N: usize, const C: usize> Scaled<R, N, C> {
    #[inline(always)]
    pub(super) fn new(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        Self::with(units(mass, a), a)
    }

    /// The rows of `a` where the coordinates have these units.
    #[inline(always)]
    pub(in crate::linear) fn with(units: [R; N], a: &[[R; N]; C]) -> Self {
        let mut rows = *a;
        let mut sizes = [R::zero(); C];
        let mut factors = [R::zero(); C];
        for c in 0..C {
            multiply(&mut rows[c], &units);
            sizes[c] = magnitude(&rows[c]);
            factors[c] = sizes[c].recip();
            scale(&mut rows[c], factors[c]);
        }
        Self { units, sizes, factors, rows }
    }

    /// The defect of a motion without inertia: its largest component, in these units.
    pub(super) fn defect(&self, motion: &[R; N]) -> Defect {
        let (mut coordinate, mut size) = (0, R::zero().largest());
        for (i, (&x, &unit)) in motion.iter().zip(&self.units).enumerate() {
            let candidate = (x / unit).abs();
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
pub(super) fn units<R: Real, const N: usize, const C: usize>(mass: &[[R; N]; N], a: &[[R; N]; C]) -> [R; N] {
    let mut units = [R::zero(); N];
    let mut all = true;
    for i in 0..N {
        let inertia = mass[i][i].abs();
        all &= inertia.is_positive();
        units[i] = inertia.sqrt().recip();
    }
    if all { units } else { completed(mass, a) }
}

/// How much larger a column of A may be for a coordinate without inertia than for others. Such coordinates
/// should be expressed by others.
const LIGHT: f64 = 8.0;

/// Units of coordinates without inertia of their own.
///
/// Such a coordinate gets its unit from what ties it to coordinates whose units are known. Its coupling in M
/// becomes 1, or else its column of A becomes [`LIGHT`] times as large as the rows are in the others. If
/// nothing ties any of them, the first gets the unit of its own entries, and the others follow.
#[cold]
#[inline(never)]
fn completed<R: Real, const N: usize, const C: usize>(mass: &[[R; N]; N], a: &[[R; N]; C]) -> [R; N] {
    let zero = R::zero();
    let usable = |x: &R| x.is_positive() && x.recip().is_positive() && x.is_finite();
    let mut units = [zero; N];
    for i in 0..N {
        units[i] = Some(mass[i][i].abs().sqrt().recip()).filter(usable).unwrap_or(zero);
    }
    for _ in 0..N {
        let known = units;
        let entry = |i: usize, j: usize| mass[i.max(j)][i.min(j)].abs();
        let size = |c: usize| (0..N).map(|i| a[c][i].abs() * known[i]).sum::<R>();
        let column = |i: usize, sizes: [R; C]| {
            (0..C).map(|c| if usable(&sizes[c]) { a[c][i].abs() / sizes[c] } else { zero }).sum::<R>()
        };
        let sizes = array(size);
        for i in 0..N {
            if !usable(&known[i]) {
                let coupling = (0..N).map(|j| entry(i, j) * known[j]).sum::<R>().recip();
                let tie = R::from_f64(LIGHT) / column(i, sizes);
                units[i] = [coupling, tie].into_iter().find(usable).unwrap_or(zero);
            }
        }
        if let (true, Some(i)) = (units == known, known.iter().position(|unit| !usable(unit))) {
            let coupling = (0..N).map(|j| entry(i, j)).sum::<R>().sqrt().recip();
            let tie = column(i, [R::one(); C]).recip();
            let first = [coupling, tie].into_iter().find(usable);
            put(&mut units, i, first.unwrap_or(R::one()));
        }
    }
    units
}
