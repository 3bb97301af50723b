//! What many contacts do at once, by sweeps over them.
//!
//! Each contact in turn takes the force or impulse that it needs with those of all others as they are, no
//! less than zero and within its friction (the projected Gauss–Seidel method; M. Jean, "The non-smooth
//! contact dynamics method", Comput. Methods Appl. Mech. Engrg. 177, 1999). Sweeps converge slowly, but soon
//! tell which contacts press and which of their frictions slip; forces and impulses follow from that exactly,
//! as those of any other combination.

use super::impact::Demand;
use super::scene::{Scene, Status, above, entry, most, product, put, rounding};
use super::trials::{Options, Part};
use super::{Regime, Row, Switching};
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::state::State;

/// The most sweeps.
const SWEEPS: usize = 1000;

/// The part of its limit from which on a friction slips: sweeps have found it to a few digits only.
const AT_LIMIT: f64 = 1.0 - 1e-6;

/// What a row does in a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Deed {
    /// Nothing.
    Idles,
    /// A closed contact: it takes what it needs, but does not pull.
    Presses,
    /// Friction, the first row of it: it takes what it needs within its limit.
    Holds,
    /// Friction that slips forward or backward: it takes its limit.
    Drags { forward: bool },
}

/// What sweeps go over.
struct Task<R, const C: usize> {
    deeds: [Deed; C],
    /// The changes of rates that rows demand.
    wanted: [R; C],
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The activities of rows in an impact after sweeps. `None` where friction acts in constraints that
    /// always hold, which take impulses of either sign, or where contacts give impulses in any case.
    #[cold]
    pub(super) fn swept_by_impulses(
        &self,
        options: &[Options; C],
        demand: &Demand<S::Scalar, C>,
    ) -> Option<[Part; C]> {
        if demand.given.iter().any(|&given| given.is_positive()) {
            return None;
        }
        let closed = |row: usize| self.is_closed.get(row) == Some(&true);
        let deeds = array(|row| match S::ROWS[row] {
            Row::Unilateral if closed(row) => Deed::Presses,
            Row::Friction { pair: Some(other), .. } if other < row => Deed::Idles,
            Row::Friction { normal: Some(normal), .. } if closed(normal) => Deed::Holds,
            _ => Deed::Idles,
        });
        let wanted = array(|row| self.wanted(row, &demand.restitution));
        let equations =
            S::equations_in(&self.open(), self.state.t, &self.state.q, &self.state.v, self.inputs)?;
        self.swept(options, &equations.saddle, &Task { deeds, wanted }, |row, impulse| {
            entry(&self.against(-impulse).kinetic, row)
        })
    }

    /// The activities of rows under forces after sweeps. `None` where friction acts in constraints that
    /// always hold.
    #[cold]
    pub(super) fn swept_by_forces(&self, options: &[Options; C]) -> Option<[Part; C]> {
        let State { t, q, v } = &self.state;
        let equations = S::equations_in(&self.open(), *t, q, v, self.inputs)?;
        let free = equations.balance().accelerations;
        let deeds = array(|row| {
            let can = |part: Part| options[row].has(part);
            match S::ROWS[row] {
                Row::Unilateral if can(Part::On) => Deed::Presses,
                Row::Friction { pair: Some(other), .. } if other < row => Deed::Idles,
                Row::Friction { .. } if can(Part::On) => Deed::Holds,
                Row::Friction { .. } if can(Part::Forward) != can(Part::Backward) => {
                    Deed::Drags { forward: can(Part::Forward) }
                }
                _ => Deed::Idles,
            }
        });
        let wanted = array(|row| -self.rate(row, &free));
        self.swept(options, &equations.saddle, &Task { deeds, wanted }, |row, force| {
            let against = self.against(-force);
            entry(
                if self.status.get(row) == Some(&Status::Slips) { &against.kinetic } else { &against.fixed },
                row,
            )
        })
    }

    /// The regime in which all contacts are open, on this side of the kinks.
    fn open(&self) -> S::InRegime {
        self.system.in_regime(&Regime { kinks: self.kinks, ..Regime::open(&S::ROWS) })
    }

    /// Sweeps over rows. The coefficient of a friction depends on the direction of its force.
    fn swept(
        &self,
        options: &[Options; C],
        saddle: &impl SaddlePoint<S::Scalar, N, C>,
        Task { deeds, wanted }: &Task<S::Scalar, C>,
        coefficient: impl Fn(usize, S::Scalar) -> S::Scalar,
    ) -> Option<[Part; C]> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let is_contact = |row: usize| S::ROWS.get(row) == Some(&Row::Unilateral);
        let is_foreign =
            |kind: &Row| matches!(kind, Row::Friction { normal: Some(row), .. } if !is_contact(*row));
        if S::ROWS.iter().any(is_foreign) {
            return None;
        }
        // What a unit of a row does to the motion, and to its own rate.
        let columns: [[S::Scalar; N]; C] = array(|row| saddle.solve(&self.gradients[row], &[zero; C]).0);
        let own: [S::Scalar; C] = array(|row| product(&self.gradients[row], &columns[row]).part(0));
        let (mut forces, mut changes, mut size) = ([zero; C], [zero; N], zero);
        let along = |row: usize, changes: &[S::Scalar; N]| {
            self.gradients.get(row).map_or(zero, |gradient| product(gradient, changes))
        };
        // What a row needs, with the others as they are.
        let needs = |row: usize, forces: &[S::Scalar; C], changes: &[S::Scalar; N]| {
            let (lack, own) = (entry(wanted, row) - along(row, changes), entry(&own, row));
            entry(forces, row) + if own.is_positive() { lack / own } else { zero }
        };
        let limit = |row: usize, force: S::Scalar, forces: &[S::Scalar; C]| match S::ROWS.get(row) {
            Some(Row::Friction { normal: Some(normal), .. }) => {
                coefficient(row, force) * entry(forces, *normal)
            }
            _ => coefficient(row, force),
        };
        let across = |row: usize| match S::ROWS.get(row) {
            Some(Row::Friction { pair, .. }) => *pair,
            _ => None,
        };
        for _ in 0..SWEEPS {
            let mut moved = zero;
            size = zero;
            let mut take =
                |row: usize, force: S::Scalar, forces: &mut [S::Scalar; C], changes: &mut [S::Scalar; N]| {
                    let more = force - entry(forces, row);
                    put(forces, row, force);
                    if let Some(column) = columns.get(row) {
                        *changes = array(|i| changes[i] + more * column[i]);
                    }
                    (moved, size) = (moved + more.abs(), size + force.abs());
                };
            for (row, deed) in deeds.iter().enumerate() {
                match *deed {
                    Deed::Idles => {}
                    Deed::Presses => {
                        let force = most(needs(row, &forces, &changes), zero);
                        take(row, force, &mut forces, &mut changes);
                    }
                    Deed::Drags { forward } => {
                        let one: S::Scalar = num_traits::One::one();
                        let (way, other) = (if forward { -one } else { one }, across(row));
                        let limit = limit(row, way, &forces);
                        let rows = [Some(row), other];
                        let rates = rows.map(|row| row.map_or(zero, |row| entry(&self.laws.rows.rates, row)));
                        let ways = match other {
                            Some(_) => rates.each(|rate| -(rate / rates[0].hypot(rates[1]))),
                            None => [way, zero],
                        };
                        for (row, way) in rows.into_iter().zip(ways) {
                            if let Some(row) = row {
                                take(row, way * limit, &mut forces, &mut changes);
                            }
                        }
                    }
                    Deed::Holds => {
                        let rows = [Some(row), across(row)];
                        let free = rows.map(|row| row.map_or(zero, |row| needs(row, &forces, &changes)));
                        let limit = limit(row, free[0], &forces);
                        let length = free[0].hypot(free[1]);
                        let share =
                            if above(length, limit) { limit / length } else { num_traits::One::one() };
                        for (row, free) in rows.into_iter().zip(free) {
                            if let Some(row) = row {
                                take(row, share * free, &mut forces, &mut changes);
                            }
                        }
                    }
                }
            }
            if !above(moved, S::Scalar::epsilon() * size) {
                break;
            }
        }
        // Contacts that nothing reaches are left with rounding errors of the others.
        let presses = |row: usize| above(entry(&forces, row), rounding::<S::Scalar>() * size);
        // Friction points against the slip. If it has no size, the slip itself tells its direction.
        let forward = |row: usize| {
            let (slip, force) = (along(row, &changes) - entry(wanted, row), entry(&forces, row));
            (if force == zero { slip } else { -force }).is_positive()
        };
        Some(array(|row| {
            let part = match (deeds[row], S::ROWS[row]) {
                (Deed::Presses, _) if presses(row) => Part::On,
                (Deed::Presses, _) => Part::Off,
                (Deed::Holds, Row::Friction { normal, pair }) if normal.is_none_or(presses) => {
                    let force = entry(&forces, row);
                    let limit = limit(row, force, &forces);
                    let length = force.hypot(pair.map_or(zero, |other| entry(&forces, other)));
                    if above(S::Scalar::from_f64(AT_LIMIT) * limit, length) {
                        Part::On
                    } else if pair.is_some() || forward(row) {
                        Part::Forward
                    } else {
                        Part::Backward
                    }
                }
                _ => options[row].first(),
            };
            if options[row].has(part) { part } else { options[row].first() }
        }))
    }
}
