//! The shares of rows in a load, where the motion does not determine them.
//!
//! A table on four legs, or a ladder between rough surfaces, has more reactions than equations. Contacts push
//! and friction has its limits, so only some of the reactions that give the motion are possible. Among these,
//! the ones of least Σ λ² are taken, as for constraints that depend on each other.

use super::choice::{Choice, is_limit};
use super::nearest::{Bound, Nearest, nearest};
use super::scene::{Scene, Status, Sticking, above, against, entry, extent, most, product, rounding};
use super::sided::laws_on;
use super::turning::{TURNS, Turning, has_pairs};
use super::{Coefficients, Regime, Row, Switching};
use crate::linear::{SaddlePoint, Switched};
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::state::State;

/// A plane that bounds the shares: its product with multipliers is at least `bound`.
#[derive(Clone, Copy)]
pub(super) struct Cut<R, const C: usize> {
    pub(super) normal: [R; C],
    pub(super) bound: R,
}

/// The rows over which a load is spread.
pub(super) struct Spread<R, const N: usize, const C: usize> {
    rows: [[R; N]; C],
    active: [R; C],
    saddle: Switched<R, N, C>,
}

impl<R: Real, const N: usize, const C: usize> Spread<R, N, C> {
    /// The shortest multipliers that give the same forces.
    pub(super) fn shortest(&self, multipliers: &[R; C]) -> [R; C] {
        let mut against = [R::zero(); N];
        for ((row, &multiplier), &active) in self.rows.iter().zip(multipliers).zip(&self.active) {
            for (force, &entry) in against.iter_mut().zip(row) {
                *force -= active * multiplier * entry;
            }
        }
        self.saddle.solve(&against, &[R::zero(); C]).1
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The regime in which every row holds that may bear: contacts that touch and friction at rest, whether
    /// they bear in this choice or not. Friction that slips goes on to slip.
    pub(super) fn bearing(&self, choice: &Choice<S::Scalar, N, C, W>) -> Regime<S::Scalar, C, W> {
        let zero = num_traits::Zero::zero();
        let stays = |row: usize| {
            let Some(gradient) = self.gradients.get(row) else { return false };
            let size = extent(gradient, &choice.sizes.accelerations) + entry(&self.gamma, row).abs();
            !above(self.rate(row, &choice.accelerations).abs(), rounding::<S::Scalar>() * size)
        };
        let touches = |row: usize| matches!(self.status[row], Status::Touches | Status::Meets) && stays(row);
        let mut regime = choice.regime;
        for (row, kind) in S::ROWS.iter().enumerate() {
            let Row::Friction { normal, pair } = *kind else {
                regime.active[row] = regime.active[row] || *kind == Row::Unilateral && touches(row);
                continue;
            };
            let is_rough = self.coefficients.iter().any(|side| entry(&side.fixed, row) != zero);
            let is_pressed =
                normal.is_none_or(|normal| S::ROWS[normal] != Row::Unilateral || touches(normal));
            match self.status[row] {
                Status::Rests if stays(row) && pair.is_none_or(stays) => {
                    (regime.active[row], regime.slip[row]) = (is_rough && is_pressed, zero);
                }
                Status::Slips if is_pressed && pair.is_none_or(|other| row < other) => {
                    let is_backward = pair.is_none() && (-self.laws.rows.rates[row]).is_positive();
                    let one: S::Scalar = num_traits::One::one();
                    regime.slip[row] = if is_backward { -one } else { one };
                }
                _ => {}
            }
        }
        regime
    }

    /// Whether the motion determines each reaction: none of the rows that may bear depends on the others.
    pub(super) fn determines(&self, bearing: &Regime<S::Scalar, C, W>, v: &[S::Scalar; N]) -> bool {
        let State { t, q, .. } = &self.state;
        let in_regime = self.system.in_regime(bearing);
        S::equations_in(&in_regime, *t, q, v, self.inputs).is_some_and(|equations| {
            let independence = equations.balance().independence;
            independence.rank == independence.rows
        })
    }

    /// The forces of frictions that slip in a regime at these velocities, per unit of the reactions that
    /// drive them, or as they are if their size is given; zero for others.
    pub(super) fn drags(&self, regime: &Regime<S::Scalar, C, W>, v: &[S::Scalar; N]) -> [S::Scalar; C] {
        let State { t, q, .. } = &self.state;
        let laws = laws_on(self.system, &State { v: *v, ..self.state }, self.inputs, &self.kinks);
        let coefficients = S::coefficients_in(&self.system.in_regime(regime), *t, q, v, self.inputs, &laws);
        let rates = &laws.rows.rates;
        array(|row| {
            let Row::Friction { pair, .. } = S::ROWS[row] else { return num_traits::Zero::zero() };
            let slip = regime.slip[pair.map_or(row, |other| row.min(other))];
            if regime.active[row] || slip == num_traits::Zero::zero() {
                return num_traits::Zero::zero();
            }
            let direction = match pair {
                None => slip,
                Some(other) => rates[row] / rates[row].hypot(rates[other]),
            };
            -(against(&coefficients, slip).kinetic[row] * direction)
        })
    }

    /// The shortest of all possible reactions that give the same motion as the `known` ones, or of all
    /// impulses in an impact. `drags` are the frictions that slip, per unit of the reactions that drive them.
    /// `None` where none are possible or the search does not end, and where there are loads: they are sizes
    /// of forces, so the possible reactions are no convex set.
    #[cold]
    pub(super) fn shortest(
        &self,
        bearing: &Regime<S::Scalar, C, W>,
        drags: &[S::Scalar; C],
        known: &[S::Scalar; C],
        sticking: Sticking,
    ) -> Option<[S::Scalar; C]> {
        self.shortest_within(rounding(), bearing, drags, known, sticking)
    }

    /// The same, which may exceed limits, and change the motion, by a part `allowed`.
    #[cold]
    pub(super) fn shortest_within(
        &self,
        allowed: S::Scalar,
        bearing: &Regime<S::Scalar, C, W>,
        drags: &[S::Scalar; C],
        known: &[S::Scalar; C],
        sticking: Sticking,
    ) -> Option<[S::Scalar; C]> {
        if S::ROWS.contains(&Row::Load) {
            return None;
        }
        let zero: S::Scalar = num_traits::Zero::zero();
        let spread = self.spread(bearing, drags);
        let project = |multipliers: &[S::Scalar; C]| spread.shortest(multipliers);
        let base = project(known);
        let size = product(known, known).sqrt();
        let mut toward = base;
        // Without slips in two directions the limits are planes, and one turn finds the nearest.
        let turns = if const { has_pairs(&S::ROWS) } { 2 * TURNS } else { 1 };
        // Directions between faces that nearly hold each other change by a small part of their way in a turn.
        let mut turning = Turning::new([1.0, f64::INFINITY]);
        for turn in 0..turns {
            let mut sides = [[Bound::none(); C]; 2];
            for row in 0..C {
                let cuts = self.cuts(row, bearing, &toward, sticking);
                for (side, Cut { normal, bound }) in
                    sides.iter_mut().zip(cuts).filter_map(|(side, cut)| Some((side, cut?)))
                {
                    let held = project(&normal);
                    let rest: [S::Scalar; C] = array(|i| normal[i] - held[i]);
                    let (length, lack) = (product(&normal, &normal).sqrt(), bound - product(&normal, &base));
                    let share = S::Scalar::epsilon().sqrt();
                    if above(product(&rest, &rest).sqrt(), share * length) {
                        side[row] = Bound { row: rest, last: zero, least: lack };
                    } else if above(lack, share * (length * size + bound.abs())) {
                        // The motion determines this reaction, so that no other one takes its place.
                        return None;
                    }
                }
            }
            let Nearest { pushes, point } = nearest([&sides[0], &sides[1]], allowed)?;
            // Bounds that hardly differ enlarge their rounding errors, and with them what changes the motion.
            let held = project(&point);
            let found: [S::Scalar; C] = array(|i| base[i] + (point[i] - held[i]));
            let is_possible = (0..C).all(|row| {
                let cuts = self.cuts(row, bearing, &found, sticking);
                cuts.into_iter().flatten().all(|Cut { normal, bound }| {
                    let slack = product(&normal, &normal).sqrt() * size + bound.abs();
                    !above(bound - product(&normal, &found), allowed * slack)
                })
            });
            if is_possible {
                // A point that is so far away that its rounding errors change the motion meets nothing.
                let again = project(&found);
                let lost: [S::Scalar; C] = array(|row| again[row] - base[row]);
                let far = size + product(&found, &found).sqrt();
                if above(product(&lost, &lost).sqrt(), allowed * far) {
                    return None;
                }
                return Some(array(|row| match S::ROWS[row] {
                    Row::Unilateral => most(found[row], zero),
                    _ => found[row],
                }));
            }
            // The cone of a friction may be cut so flatly that the directions below go to and fro. Later
            // turns cut it in the direction of the reactions that the last turn has found. That is Newton's
            // method, which comes from outside.
            if turn >= TURNS {
                toward = found;
                continue;
            }
            // A friction at its limit has the direction that it would have without the limit.
            let cuts: [_; C] = array(|row| self.cut(row, bearing, &toward, sticking));
            let mut next = found;
            for (row, (cut, &push)) in cuts.iter().zip(&pushes[0]).enumerate() {
                if let (Row::Friction { pair: Some(other), .. }, Some(cut)) = (S::ROWS[row], cut) {
                    for own in [row, other] {
                        if let (Some(next), Some(&part)) = (next.get_mut(own), cut.normal.get(own)) {
                            *next -= push * part;
                        }
                    }
                }
            }
            let change = array(|i| next[i] - toward[i]);
            let share = turning.share(&toward, &change);
            toward = array(|i| share.mul_add(change[i], toward[i]));
        }
        None
    }

    /// How the rows that bear spread a load.
    pub(super) fn spread(
        &self,
        bearing: &Regime<S::Scalar, C, W>,
        drags: &[S::Scalar; C],
    ) -> Spread<S::Scalar, N, C> {
        let zero = num_traits::Zero::zero();
        let rows = self.driving(bearing, drags);
        let mut mass = [[zero; N]; N];
        for (i, (row, &unit)) in mass.iter_mut().zip(&self.units).enumerate() {
            row[i] = if unit.is_positive() { (unit * unit).recip() } else { num_traits::One::one() };
        }
        let active = array(|row| bearing.activity(row));
        let saddle = Switched::factor(&mass, &rows, &[[zero; N]; C], &active);
        Spread { rows, active, saddle }
    }

    /// Gradients of rows with those of the frictions that they drive.
    fn driving(&self, bearing: &Regime<S::Scalar, C, W>, drags: &[S::Scalar; C]) -> [[S::Scalar; N]; C] {
        let mut rows = self.gradients;
        for (row, kind) in S::ROWS.iter().enumerate() {
            if let Row::Friction { normal: Some(normal), .. } = *kind
                && !bearing.active[row]
            {
                let drag = drags[row] * bearing.side[normal];
                for (entry, &slip) in rows[normal].iter_mut().zip(&self.gradients[row]) {
                    *entry += drag * slip;
                }
            }
        }
        rows
    }

    /// The limits of a row, those of a friction in one direction in both of its directions.
    fn cuts(
        &self,
        row: usize,
        bearing: &Regime<S::Scalar, C, W>,
        multipliers: &[S::Scalar; C],
        sticking: Sticking,
    ) -> [Option<Cut<S::Scalar, C>>; 2] {
        let one: S::Scalar = num_traits::One::one();
        if !matches!(S::ROWS[row], Row::Friction { pair: None, .. }) {
            return [self.cut(row, bearing, multipliers, sticking), None];
        }
        [one, -one].map(|way| {
            let along = array(|other| if other == row { way } else { num_traits::Zero::zero() });
            self.cut(row, bearing, &along, sticking)
        })
    }

    /// The limit of a row. A friction has the direction that it has among these multipliers. `None` for a row
    /// without a limit, for a friction without a force, and for the second row of a pair.
    pub(super) fn cut(
        &self,
        row: usize,
        bearing: &Regime<S::Scalar, C, W>,
        multipliers: &[S::Scalar; C],
        sticking: Sticking,
    ) -> Option<Cut<S::Scalar, C>> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let mut normal = [zero; C];
        match S::ROWS[row] {
            _ if !bearing.active[row] => None,
            Row::Bilateral | Row::Load if !is_limit(&S::ROWS, row) => None,
            Row::Bilateral | Row::Load | Row::Unilateral => {
                normal[row] = bearing.side[row];
                Some(Cut { normal, bound: zero })
            }
            // A pair has one cut.
            Row::Friction { pair: Some(other), .. } if other < row => None,
            Row::Friction { normal: load, pair } => {
                let size = multipliers[row].hypot(pair.map_or(zero, |other| multipliers[other]));
                if !size.is_positive() {
                    return None;
                }
                for own in [Some(row), pair].into_iter().flatten() {
                    if let (Some(part), Some(&multiplier)) = (normal.get_mut(own), multipliers.get(own)) {
                        *part = -multiplier / size;
                    }
                }
                let Coefficients { kinetic, fixed } = self.against(normal[row]);
                let coefficient = match sticking {
                    Sticking::ByForces => fixed[row],
                    Sticking::ByImpulses => kinetic[row],
                };
                let Some(load) = load else { return Some(Cut { normal, bound: -coefficient }) };
                normal[load] = bearing.side[load] * coefficient;
                Some(Cut { normal, bound: zero })
            }
        }
    }
}
