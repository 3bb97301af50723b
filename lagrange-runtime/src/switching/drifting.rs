//! The directions in which slips in two directions begin.
//!
//! A slip s begins in the direction of its acceleration, and friction is against it: s = c + W f with
//! f = −l s/|s|, where c are the accelerations without these frictions, W those that their forces make, and l
//! their limits, which the forces may change. With √(|s|² + ε²) for |s| that is a smooth equation, whose
//! friction is monotone. It is solved by Newton's method for a large ε, where it is nearly linear, and then
//! for smaller and smaller ones, each from the solution before (continuation: Allgower and Georg, *Numerical
//! Continuation Methods*). So loads that only just exceed what friction holds have a solution as well, where
//! accelerations are differences of large forces.

use super::launch::Begins;
use super::scene::{Scene, above, entry, most, product, put, rounding};
use super::{Regime, Row, Switching};
use crate::constraints::Balance;
use crate::linear::{Lu, SaddlePoint};
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::state::State;

/// The factor by which ε becomes smaller.
const FACTOR: f64 = 0.25;

/// The most values of ε: down to the rounding errors of a scalar with 31 digits.
const VALUES: usize = 64;

/// The most steps of Newton's method for each of them.
const STEPS: usize = 24;

/// The most halvings of such a step.
const HALVINGS: usize = 12;

/// The slip, as a multiple of ε, from which on friction counts as that of a slip.
const FAR: f64 = 64.0;

/// The motion with slips that begin, before they have any speed.
pub(super) struct Drift<R, const N: usize, const C: usize> {
    /// The accelerations of slips, or where nothing accelerates one, its direction.
    pub(super) slips: [R; C],
    pub(super) balance: Balance<R, N, C>,
}

/// What frictions do to slips and to their own limits.
struct Response<R, const N: usize, const C: usize> {
    /// The motion without these frictions.
    free: Balance<R, N, C>,
    /// The accelerations and multipliers that a force of each friction makes.
    effects: [([R; N], [R; C]); C],
    /// The accelerations of slips without these frictions.
    rates: [R; C],
    /// Those that forces make: a row for each slip.
    by_forces: [[R; C]; C],
    /// The limits of frictions without them.
    limits: [R; C],
    /// Their changes by these forces: a row for each limit.
    limits_by_forces: [[R; C]; C],
    /// The other direction of each slip that begins.
    others: [Option<usize>; C],
}

/// A state of the search.
struct Trial<R, const C: usize> {
    slips: [R; C],
    /// Frictions against these slips, and their limits.
    forces: [R; C],
    limits: [R; C],
    /// What slips lack of the accelerations that follow from them.
    lacks: [R; C],
    /// The derivatives of these lacks.
    matrix: [[R; C]; C],
}

impl<R: Real, const N: usize, const C: usize> Response<R, N, C> {
    fn other(&self, row: usize) -> Option<usize> {
        self.others.get(row).copied().flatten()
    }

    /// The forces of frictions against these slips, and what follows.
    fn tried(&self, slips: [R; C], least: R) -> Option<Trial<R, C>> {
        let (zero, one) = (R::zero(), R::one());
        // One for rows that are not sought.
        let lengths: [R; C] = array(|row| match self.other(row) {
            Some(other) => entry(&slips, row).hypot(entry(&slips, other)).hypot(least),
            None => one,
        });
        let directions: [R; C] = array(|row| match self.other(row) {
            Some(_) => entry(&slips, row) / entry(&lengths, row),
            None => zero,
        });
        // The forces f = −d l(f): a linear equation.
        let mut transposed = [[zero; C]; C];
        for (column, own) in transposed.iter_mut().enumerate() {
            for (row, (number, limit)) in own.iter_mut().zip(&self.limits_by_forces).enumerate() {
                let unit = if row == column { one } else { zero };
                *number = unit + entry(&directions, row) * entry(limit, column);
            }
        }
        let matrix = array(|row| array(|column| transposed.get(column).map_or(zero, |own| entry(own, row))));
        let forces = Lu::factor(matrix)
            .ok()?
            .solve(array(|row| -(entry(&directions, row) * entry(&self.limits, row))));
        let limits: [R; C] = array(|row| {
            let change = self.limits_by_forces.get(row).map_or(zero, |own| product(own, &forces));
            entry(&self.limits, row) + change
        });
        let by_forces = Lu::factor(transposed).ok()?;
        let (mut lacks, mut matrix) = ([zero; C], [[zero; C]; C]);
        for (row, (own, effect)) in matrix.iter_mut().zip(&self.by_forces).enumerate() {
            put(own, row, one);
            if self.other(row).is_none() {
                continue;
            }
            put(&mut lacks, row, entry(&self.rates, row) + product(effect, &forces) - entry(&slips, row));
            // The effect of forces that would be l s/|s|, if limits did not change.
            let effect = by_forces.solve(*effect);
            for (column, number) in own.iter_mut().enumerate() {
                let Some(other) = self.other(column) else { continue };
                let direction = entry(&directions, column);
                for k in [column, other] {
                    let unit = if k == column { one } else { zero };
                    let turned = (unit - entry(&directions, k) * direction) / entry(&lengths, column);
                    *number += entry(&effect, k) * entry(&limits, k) * turned;
                }
            }
        }
        let is_finite = lacks.iter().chain(matrix.iter().flatten()).all(|number| number.is_finite());
        is_finite.then_some(Trial { slips, forces, limits, lacks, matrix })
    }

    /// The solution for one ε, from slips nearby, and whether it lacks no more than `noise`.
    fn settled(&self, slips: [R; C], least: R, noise: R) -> Option<(Trial<R, C>, bool)> {
        let size = |numbers: &[R; C]| product(numbers, numbers).sqrt().part(0);
        let mut trial = self.tried(slips, least)?;
        // Derivatives follow one step behind.
        let mut more = if R::PARTS > 1 { 2 } else { 1 };
        for _ in 0..STEPS {
            let is_done = !above(size(&trial.lacks), noise);
            if is_done {
                if more == 0 {
                    break;
                }
                more -= 1;
            }
            let step = Lu::factor(trial.matrix).ok()?.solve(trial.lacks);
            let mut share = R::one();
            let mut next = None;
            for _ in 0..HALVINGS {
                next = self.tried(array(|row| trial.slips[row] + share * step[row]), least);
                next = next.filter(|next| is_done || above(size(&trial.lacks), size(&next.lacks)));
                if next.is_some() {
                    break;
                }
                share *= R::from_f64(0.5);
            }
            // Without a better one rounding errors are all that is left.
            let Some(next) = next else { break };
            trial = next;
        }
        let is_done = !above(size(&trial.lacks), noise);
        Some((trial, is_done))
    }

    /// The motion with these forces.
    fn balance(&self, forces: &[R; C]) -> Balance<R, N, C> {
        let Balance { mut accelerations, mut multipliers, independence } = self.free;
        for ((changes, reactions), &force) in self.effects.iter().zip(forces) {
            for (acceleration, &change) in accelerations.iter_mut().zip(changes) {
                *acceleration += force * change;
            }
            for (multiplier, &reaction) in multipliers.iter_mut().zip(reactions) {
                *multiplier += force * reaction;
            }
        }
        Balance { accelerations, multipliers, independence }
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The motion with the slips that begin in a regime. `None` where one of them does not begin, or no
    /// solution is found.
    #[cold]
    pub(super) fn drift(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        begins: &Begins<C>,
    ) -> Option<Drift<S::Scalar, N, C>> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let response = self.response(regime, begins)?;
        let mut slips = response.rates;
        let mut least = product(&slips, &slips).sqrt().part(0);
        let noise = rounding::<S::Scalar>() * least;
        let length =
            |numbers: &[S::Scalar; C], [x, y]: [usize; 2]| entry(numbers, x).hypot(entry(numbers, y)).part(0);
        let all = |slips: &[S::Scalar; C], size: S::Scalar| {
            begins.slips(&S::ROWS).all(|rows| above(length(slips, rows), size))
        };
        let mut last = None;
        for _ in 0..VALUES {
            let (trial, is_done) = response.settled(slips, least, noise)?;
            slips = trial.slips;
            // Where friction holds nearly all, slips are much smaller without the ε than with it.
            if all(&slips, S::Scalar::from_f64(FAR) * least)
                && let Some((Trial { slips, forces, .. }, true)) = response.settled(slips, zero, noise)
                && all(&slips, noise)
            {
                return Some(Drift { slips, balance: response.balance(&forces) });
            }
            last = is_done.then_some(trial);
            if above(noise, least) {
                break;
            }
            least *= S::Scalar::from_f64(FACTOR);
        }
        // A friction at its limit begins to slip, though nothing accelerates it yet. Its slip is then about
        // ε^⅔, and its force lacks ε^⅔ of the limit.
        let Trial { forces, limits, mut slips, .. } = last?;
        let left = (rounding::<S::Scalar>().ln() * S::Scalar::from_f64(2.0 / 3.0)).exp();
        let share = most(S::Scalar::epsilon().sqrt(), left);
        for rows in begins.slips(&S::ROWS) {
            let (force, limit) = (length(&forces, rows), entry(&limits, rows[0]).part(0));
            if above(limit - force, share * limit) {
                return None;
            }
            if !above(length(&slips, rows), noise) {
                rows.into_iter().for_each(|row| put(&mut slips, row, -entry(&forces, row)));
            }
        }
        // In the directions that are found, friction is all that its limit allows.
        let Trial { forces, .. } = response.tried(forces.each(|force| -force), zero)?;
        Some(Drift { slips, balance: response.balance(&forces) })
    }

    /// What the frictions of slips that begin do. `None` where the equations have no solution without them.
    fn response(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        begins: &Begins<C>,
    ) -> Option<Response<S::Scalar, N, C>> {
        let (zero, one) = (num_traits::Zero::zero(), num_traits::One::one());
        let State { t, q, v } = &self.state;
        let mut loose = begins.held(regime);
        for [x, y] in begins.slips(&S::ROWS) {
            put(&mut loose.active, x, false);
            put(&mut loose.active, y, false);
        }
        let equations = S::equations_in(&self.system.in_regime(&loose), *t, q, v, self.inputs)?;
        let free = equations.balance();
        let mut response = Response {
            free,
            effects: [([zero; N], [zero; C]); C],
            rates: array(|row| self.rate(row, &free.accelerations)),
            by_forces: [[zero; C]; C],
            limits: [zero; C],
            limits_by_forces: [[zero; C]; C],
            others: [None; C],
        };
        let kinetic = &self.against(one).kinetic;
        let limit = |row: usize| match S::ROWS.get(row) {
            Some(&Row::Friction { normal, pair }) => {
                (entry(kinetic, pair.map_or(row, |other| row.min(other))), normal)
            }
            _ => (zero, None),
        };
        for [x, y] in begins.slips(&S::ROWS) {
            for (row, other) in [(x, y), (y, x)] {
                put(&mut response.others, row, Some(other));
                let (coefficient, normal) = limit(row);
                let load = normal
                    .map_or(one, |normal| entry(&regime.side, normal) * entry(&free.multipliers, normal));
                put(&mut response.limits, row, coefficient * load);
                let (changes, multipliers) =
                    equations.saddle.solve_motion(self.gradients.get(row)?, &[zero; C]);
                for (own, effect) in response.by_forces.iter_mut().enumerate() {
                    put(effect, row, self.along(own, &changes));
                }
                put(&mut response.effects, row, (changes, multipliers));
                for (own, effect) in response.limits_by_forces.iter_mut().enumerate() {
                    if let (true, (coefficient, Some(normal))) = (begins.has(own), limit(own)) {
                        let side = entry(&regime.side, normal);
                        put(effect, row, coefficient * side * entry(&multipliers, normal));
                    }
                }
            }
        }
        // Only slips that begin are sought.
        for row in (0..C).filter(|&row| !begins.has(row)) {
            put(&mut response.rates, row, zero);
            put(&mut response.by_forces, row, [zero; C]);
        }
        let is_finite = free.accelerations.iter().chain(&free.multipliers).all(|number| number.is_finite());
        is_finite.then_some(response)
    }
}
