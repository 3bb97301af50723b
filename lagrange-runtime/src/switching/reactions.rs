//! Reactions that guards are made of: at a state, and along the polynomial of a step.
//!
//! The series of a motion contains those of its reactions, from the same solution of each order. A reaction
//! that is zero is known no better than the load: one of three feet bears nothing, for example, if the load
//! is on the line between the others. So the bound of its rounding errors is made of the forces that the
//! reaction is the difference of, order by order.

use super::course::Course;
use super::guards::Guards;
use super::scene::{against, entry, most, product, put, rounding};
use super::{Regime, Row, Switching};
use crate::constraints::{Balance, Equations};
use crate::linear::{SaddlePoint, Switched};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::system::state::State;

/// How well the reactions along a step are known.
pub(super) struct Borne<R, const N: usize, const C: usize> {
    /// The effect of rounding errors of the forces on velocities until the end of the step. An acceleration
    /// may be a small difference of forces, as where a slip begins, so that its own size tells nothing.
    pub(super) roundings: [R; N],
    /// The rounding errors of the polynomials of reactions; zero where no guard is made of reactions.
    errors: [R; C],
    /// The truncation errors at the end of the step.
    left: [R; C],
    /// The order with which these grow at rest, where a part of the step may be all that is known. On a step
    /// that moves they count as a whole.
    order: i32,
    /// Whether these converge on the whole of the step as the motion does, to half of the digits of its
    /// tolerance.
    pub(super) is_known: bool,
}

impl<R: Real, const N: usize, const C: usize> Borne<R, N, C> {
    /// The error of the polynomial of a reaction after a part of the step, rounding and truncation.
    pub(super) fn error(&self, row: usize, part: R) -> R {
        entry(&self.errors, row) + entry(&self.left, row) * part.powi(self.order)
    }
}

/// Rows of gradients in units in which coordinates have unit mass.
struct Levers<R, const N: usize, const C: usize> {
    rows: [[R; N]; C],
    units: [R; N],
}

/// The coordinates that each row affects, by itself or through other rows.
type Reach<const N: usize, const C: usize> = [[bool; N]; C];

impl<R: Real, const N: usize, const C: usize> Levers<R, N, C> {
    fn new(gradients: &[[R; N]; C], units: [R; N]) -> Self {
        Self { rows: gradients.each(|row| array(|i| row[i] * units[i])), units }
    }

    /// The coordinates that each row affects. A row that `drives` friction may affect any of them through it.
    fn reach(&self, drives: impl Fn(usize) -> bool) -> Reach<N, C> {
        let affects: [[bool; N]; C] = array(|row| {
            let drives = drives(row);
            self.rows[row].each(|entry| drives || entry != R::zero())
        });
        // Coordinates that rows join have the same label, the least index of them.
        let mut labels: [usize; N] = array(|i| i);
        for affects in &affects {
            let own = labels.iter().zip(affects).filter(|(_, affects)| **affects).map(|(&label, _)| label);
            let mut joined = [false; N];
            let least = own.fold(N, |least, label| {
                put(&mut joined, label, true);
                least.min(label)
            });
            for label in labels.iter_mut().filter(|label| joined.get(**label) == Some(&true)) {
                *label = least;
            }
        }
        affects.each(|affects| {
            let own = labels.iter().zip(&affects).find(|(_, affects)| **affects).map(|(&label, _)| label);
            labels.each(|label| own == Some(label))
        })
    }

    /// The sizes of forces with those of reactions.
    fn with(&self, reactions: &[R; C], forces: &[R; N]) -> [R; N] {
        array(|i| {
            let borne = self.rows.iter().zip(reactions);
            borne.fold(forces[i], |sum, (row, &force)| sum + (row[i] * force).abs())
        })
    }

    /// The forces that reactions of these sizes are differences of, beside other `forces` in these units.
    /// Rounding errors of coordinates turn forces in the metric of the masses: each direction gets a part of
    /// the others.
    fn sizes(&self, reach: &Reach<N, C>, reactions: &[R; C], forces: &[R; N]) -> [R; C] {
        let forces = self.with(reactions, forces);
        array(|row| {
            let lever = product(&self.rows[row], &self.rows[row]).sqrt();
            let met = forces.iter().zip(&reach[row]).filter(|(_, met)| **met);
            let force = met.fold(R::zero(), |sum, (&force, _)| sum + force);
            let size = if lever.is_positive() { force / lever } else { R::zero() };
            most(size, reactions[row].abs())
        })
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The sizes of frictions that slip and whose force is given. They are among the forces and may balance
    /// the others.
    fn given(&self) -> [S::Scalar; N] {
        let Self { system, regime, inputs, start: State { t, q, v }, .. } = *self;
        let mut given = [num_traits::Zero::zero(); N];
        let slips = |row: usize| match S::ROWS.get(row) {
            Some(Row::Friction { normal: None, pair }) => {
                entry(&regime.slip, pair.map_or(row, |other| row.min(other))) != num_traits::Zero::zero()
            }
            _ => false,
        };
        let mut held: Regime<S::Scalar, C, W> = *regime;
        for (row, active) in held.active.iter_mut().enumerate() {
            *active |= slips(row);
        }
        // Rows have gradients where they are active.
        if held.active != regime.active
            && let in_regime = system.in_regime(&held)
            && let Some(known) = S::rows_in(&in_regime, *t, q, v, inputs)
        {
            let laws = system.laws_at(*t, q, v, inputs);
            let coefficients = S::coefficients_in(&in_regime, *t, q, v, inputs, &laws);
            for (row, gradient) in known.gradients.iter().enumerate().filter(|(row, _)| slips(*row)) {
                let limit = entry(&against(&coefficients, entry(&regime.slip, row)).kinetic, row);
                for (given, &entry) in given.iter_mut().zip(gradient) {
                    *given += (entry * limit).abs();
                }
            }
        }
        given
    }

    /// Whether a reaction drives friction that slips.
    fn drives(&self, row: usize) -> bool {
        let slips = |own: usize| entry(&self.regime.slip, own) != num_traits::Zero::zero();
        S::ROWS.iter().enumerate().any(|(own, kind)| {
            matches!(kind, Row::Friction { normal: Some(normal), .. } if *normal == row && slips(own))
        })
    }

    fn equations(
        &self,
        state: &State<S::Scalar, N>,
    ) -> Option<Equations<Switched<S::Scalar, N, C>, S::Scalar, N, C>> {
        let State { t, q, v } = state;
        S::equations_in(self.in_regime, *t, q, v, self.inputs)
    }

    /// The sizes of forces at coordinates in these units, without reactions.
    fn sizes_of(&self, forces: &[S::Scalar; N], units: &[S::Scalar; N]) -> [S::Scalar; N] {
        let given = self.given();
        array(|i| (entry(forces, i).abs() + entry(&given, i)) * entry(units, i))
    }

    /// The multipliers at a state, and the forces at their rows that they are differences of. Multipliers are
    /// NaN where the equations have no solution.
    pub(super) fn multipliers(&self, state: &State<S::Scalar, N>) -> [[S::Scalar; C]; 2] {
        let zero: S::Scalar = num_traits::Zero::zero();
        let Some(equations) = self.equations(state) else {
            return [[S::Scalar::from_f64(f64::NAN); C], [zero; C]];
        };
        let Balance { multipliers, .. } = equations.balance();
        let levers = Levers::new(&equations.gradients, equations.saddle.units());
        let forces = self.sizes_of(&equations.forces, &levers.units);
        let mut sizes = levers.sizes(&levers.reach(|row| self.drives(row)), &multipliers, &forces);
        equations.saddle.bound_loads(&mut sizes);
        [multipliers, sizes]
    }

    /// How well the reactions along a step are known.
    pub(super) fn borne(&self, course: &Course<'_, S::Scalar, N>) -> Borne<S::Scalar, N, C> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let order = if course.rests() { course.order().saturating_sub(2) as i32 } else { 0 };
        let (errors, left) = ([zero; C], [zero; C]);
        let mut borne = Borne { roundings: [zero; N], errors, left, order, is_known: true };
        let State { t, q, v } = self.start;
        let Some(known) = S::rows_in(self.in_regime, *t, q, v, self.inputs) else { return borne };
        let terms = &course.terms;
        let levers = Levers::new(&known.gradients, known.units);
        let mut forces = self.sizes_of(&known.forces, &levers.units);
        let rows = || {
            let rows = terms.reactions.chunks_exact(C.max(1)).take(terms.v.len());
            rows.filter_map(|row| <&[S::Scalar; C]>::try_from(row).ok())
        };
        let first = rows().next().copied();
        let rounding: S::Scalar = rounding();
        let time = course.time();
        let all = levers.with(&first.unwrap_or([zero; C]), &forces);
        borne.roundings = array(|i| {
            let gained = terms.v.first().map_or(zero, |row| (terms.length * row[i]).abs());
            rounding * (gained + time * all[i] * levers.units[i])
        });
        if !self.has_reactions() {
            return borne;
        }
        if first.is_none() {
            return Borne { is_known: false, ..borne };
        }
        let (mut sums, mut last) = ([zero; C], [[zero; C]; 2]);
        let paces =
            levers.units.each(|unit| if unit.is_positive() { (terms.unit * unit).recip() } else { zero });
        let mut place: S::Scalar = zero;
        for ((row, speeds), power) in rows().zip(terms.v).zip(course.powers()) {
            let size = power.abs();
            place += num_traits::One::one();
            // Forces that accelerate count as well.
            for (force, (&speed, &pace)) in forces.iter_mut().zip(speeds.iter().zip(&paces)) {
                *force += size * (place * speed * pace).abs();
            }
            let magnitudes = row.each(|reaction| size * reaction.abs());
            last = [last[1], magnitudes];
            for (sum, magnitude) in sums.iter_mut().zip(magnitudes) {
                *sum += magnitude;
            }
        }
        let mut sizes = levers.sizes(&levers.reach(|row| self.drives(row)), &sums, &forces);
        // The factors bound the sizes of loads.
        if S::ROWS.contains(&Row::Load)
            && let Some(equations) = self.equations(self.start)
        {
            equations.saddle.bound_loads(&mut sizes);
        }
        borne.left = array(|row| last[0][row] + last[1][row]);
        let share = course.left.sqrt();
        borne.is_known = (0..C).all(|row| borne.left[row] <= share * sizes[row]);
        borne.errors = array(|row| rounding * sizes[row]);
        borne
    }
}
