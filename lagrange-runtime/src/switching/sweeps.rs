//! What contacts do in an impact of many, by sweeps over them.
//!
//! Each contact in turn takes the impulse that it needs with those of all others as they are, no less than
//! zero and within its friction (the projected Gauss–Seidel method; M. Jean, "The non-smooth contact dynamics
//! method", Comput. Methods Appl. Mech. Engrg. 177, 1999). Sweeps converge slowly, but soon tell which
//! contacts strike and which of their frictions slip; the impulses follow from that exactly, as those of any
//! other combination.

use super::impact::Demand;
use super::scene::{Scene, above, entry, most, product, put};
use super::trials::{Options, Part};
use super::{Regime, Row, Switching};
use crate::linear::SaddlePoint;
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::state::State;

/// The most sweeps.
const SWEEPS: usize = 1000;

/// The part of its limit from which on a friction slips: sweeps have found it to a few digits only.
const AT_LIMIT: f64 = 1.0 - 1e-6;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The activities of rows after sweeps. `None` where friction acts in constraints that always hold, which
    /// take impulses of either sign, or where contacts give impulses in any case.
    #[cold]
    pub(super) fn swept(&self, options: &[Options; C], demand: &Demand<S::Scalar, C>) -> Option<[Part; C]> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let is_contact = |row: usize| S::ROWS.get(row) == Some(&Row::Unilateral);
        let is_foreign =
            |kind: &Row| matches!(kind, Row::Friction { normal: Some(row), .. } if !is_contact(*row));
        if S::ROWS.iter().any(is_foreign) || demand.given.iter().any(|&given| given.is_positive()) {
            return None;
        }
        let State { t, q, v } = &self.state;
        let open = Regime { kinks: self.kinks, ..Regime::open(&S::ROWS) };
        let equations = S::equations_in(&self.system.in_regime(&open), *t, q, v, self.inputs)?;
        // What a unit of impulse of a row does to the velocities, and to its own rate.
        let columns: [[S::Scalar; N]; C] =
            array(|row| equations.saddle.solve(&self.gradients[row], &[zero; C]).0);
        let own: [S::Scalar; C] = array(|row| product(&self.gradients[row], &columns[row]).part(0));
        let wanted: [S::Scalar; C] = array(|row| self.wanted(row, &demand.restitution));
        let (mut impulses, mut changes) = ([zero; C], [zero; N]);
        let along = |row: usize, changes: &[S::Scalar; N]| {
            self.gradients.get(row).map_or(zero, |gradient| product(gradient, changes))
        };
        // The impulse that a row needs, with those of the others as they are.
        let needs = |row: usize, impulses: &[S::Scalar; C], changes: &[S::Scalar; N]| {
            let (lack, own) = (entry(&wanted, row) - along(row, changes), entry(&own, row));
            entry(impulses, row) + if own.is_positive() { lack / own } else { zero }
        };
        let closed = |row: usize| self.is_closed.get(row) == Some(&true);
        let limit = |row: usize, normal: usize, impulse: S::Scalar, impulses: &[S::Scalar; C]| {
            entry(&self.against(-impulse).kinetic, row) * entry(impulses, normal)
        };
        for _ in 0..SWEEPS {
            let (mut moved, mut size) = (zero, zero);
            let mut take = |row: usize,
                            impulse: S::Scalar,
                            impulses: &mut [S::Scalar; C],
                            changes: &mut [S::Scalar; N]| {
                let more = impulse - entry(impulses, row);
                put(impulses, row, impulse);
                if let Some(column) = columns.get(row) {
                    *changes = array(|i| changes[i] + more * column[i]);
                }
                (moved, size) = (moved + more.abs(), size + impulse.abs());
            };
            for (row, kind) in S::ROWS.iter().enumerate() {
                match *kind {
                    Row::Unilateral if closed(row) => {
                        let impulse = most(needs(row, &impulses, &changes), zero);
                        take(row, impulse, &mut impulses, &mut changes);
                    }
                    Row::Friction { pair: Some(other), .. } if other < row => {}
                    Row::Friction { normal: Some(normal), pair } if closed(normal) => {
                        let rows = [Some(row), pair];
                        let free = rows.map(|row| row.map_or(zero, |row| needs(row, &impulses, &changes)));
                        let limit = limit(row, normal, free[0], &impulses);
                        let length = free[0].hypot(free[1]);
                        let share =
                            if above(length, limit) { limit / length } else { num_traits::One::one() };
                        for (row, free) in rows.into_iter().zip(free) {
                            if let Some(row) = row {
                                take(row, share * free, &mut impulses, &mut changes);
                            }
                        }
                    }
                    _ => {}
                }
            }
            if !above(moved, S::Scalar::epsilon() * size) {
                break;
            }
        }
        // Friction points against the slip. If it has no size, the slip itself tells its direction.
        let forward = |row: usize| {
            let (slip, impulse) =
                (entry(&self.laws.rows.rates, row) + along(row, &changes), entry(&impulses, row));
            (if impulse == zero { slip } else { -impulse }).is_positive()
        };
        Some(array(|row| match S::ROWS[row] {
            Row::Unilateral if entry(&impulses, row).is_positive() => Part::On,
            Row::Unilateral => Part::Off,
            Row::Friction { normal: Some(normal), pair }
                if entry(&impulses, normal).is_positive() && pair.is_none_or(|other| row < other) =>
            {
                let impulse = entry(&impulses, row);
                let limit = limit(row, normal, impulse, &impulses);
                let length = impulse.hypot(pair.map_or(zero, |other| entry(&impulses, other)));
                if above(S::Scalar::from_f64(AT_LIMIT) * limit, length) {
                    Part::On
                } else if pair.is_some() || forward(row) {
                    Part::Forward
                } else {
                    Part::Backward
                }
            }
            _ => options[row].first(),
        }))
    }
}
