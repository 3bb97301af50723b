//! The oracle of derivatives: the equations of motion from their definitions in any number, with one more
//! dual level along each variable, and the derivatives of accelerations and multipliers that follow.
//!
//! r = Q − ∂D/∂v + Aᵀλ − (d/dt ∂L/∂v − ∂L/∂q) at given accelerations a and multipliers λ. A a − γ is dw/dt
//! with its stabilisation. d/dt is the derivative along (q̇, a, 1), so M, b and γ are not formed.

use crate::constrained::Held;
use crate::constraint::Kind;
use crate::expression::{Instant, Scope};
use crate::number::{Dual, Number, Tracked};
use crate::oracle::{applied_force, solve};
use crate::system::System;

/// An instant with accelerations and multipliers, which need not solve the equations.
#[derive(Clone, Debug)]
pub struct Motion<T> {
    pub at: Instant<T>,
    pub accelerations: Vec<T>,
    pub multipliers: Vec<T>,
}

/// The residuals of the equations of motion, and the constraints that they were differentiated from.
#[derive(Clone, Debug)]
pub struct Equations<T> {
    /// r.
    pub forces: Vec<T>,
    /// A a − γ.
    pub conditions: Vec<T>,
    /// f of the holonomic constraints, zero for the others.
    pub positions: Vec<T>,
    /// w.
    pub rates: Vec<T>,
}

impl<T: Number> Equations<T> {
    /// Evaluates the definitions.
    pub fn of(system: &System, motion: &Motion<T>) -> Equations<T> {
        let Motion { at, accelerations, multipliers } = motion;
        let moving = at.along(|i| at.v[i], |i| accelerations[i], 1.0);
        let force = |i: usize| {
            // The derivative by v[i] is outside, the one along the motion inside.
            let inertia = system.energies(&moving.by_velocity(i)).lagrangian().slope.slope;
            let by_coordinate = system.energies(&at.by_coordinate(i)).lagrangian().slope;
            let reactions = gradients(system, at, i).into_iter().zip(multipliers);
            let start = applied_force(system, at, i) - (inertia - by_coordinate);
            reactions.fold(start, |sum, (gradient, &multiplier)| sum + multiplier * gradient)
        };
        let (positions, rates) = (positions(system, at), rates(system, at));
        let changes = self::rates(system, &moving).into_iter().map(|rate| rate.slope);
        let mut conditions: Vec<T> = changes.collect();
        if let Some(rate) = &system.baumgarte {
            let rate = Scope::new(system, at, 0).scalar(rate);
            for (c, kind) in system.kinds().into_iter().enumerate() {
                let damping = if kind == Kind::Holonomic { rate + rate } else { rate };
                conditions[c] = conditions[c] + damping * rates[c] + rate * rate * positions[c];
            }
        }
        Equations { forces: (0..system.count()).map(force).collect(), conditions, positions, rates }
    }
}

fn positions<T: Number>(system: &System, at: &Instant<T>) -> Vec<T> {
    let values = system.constraints(at, None).into_iter().zip(system.kinds());
    values.map(|(value, kind)| if kind == Kind::Holonomic { value } else { T::constant(0.0) }).collect()
}

/// w: df/dt or g.
fn rates<T: Number>(system: &System, at: &Instant<T>) -> Vec<T> {
    let values = system.constraints(&at.in_motion(), None).into_iter().zip(system.kinds());
    values.map(|(value, kind)| if kind == Kind::Holonomic { value.slope } else { value.value }).collect()
}

/// Column `i` of A: ∂f/∂q or ∂g/∂v.
fn gradients<T: Number>(system: &System, at: &Instant<T>, i: usize) -> Vec<T> {
    let by_coordinate = system.constraints(&at.by_coordinate(i), None);
    let by_velocity = system.constraints(&at.by_velocity(i), None);
    let both = by_coordinate.into_iter().zip(by_velocity).zip(system.kinds());
    both.map(|((q, v), kind)| if kind == Kind::Holonomic { q.slope } else { v.slope }).collect()
}

/// A variable of derivatives.
#[derive(Clone, Copy, Debug)]
pub enum Variable {
    Coordinate(usize),
    Velocity(usize),
    Time,
    Input(usize),
    Parameter(usize),
}

impl Motion<Tracked> {
    /// The motion with one variable changing.
    fn by(&self, variable: Variable) -> Motion<Dual<Tracked>> {
        let still = |values: &[Tracked]| values.iter().map(|&value| Dual::still(value)).collect();
        let nothing = Tracked::constant(0.0);
        let mut at = self.at.along(|_| nothing, |_| nothing, 0.0);
        let changing = match variable {
            Variable::Coordinate(i) => &mut at.q[i],
            Variable::Velocity(i) => &mut at.v[i],
            Variable::Time => &mut at.t,
            Variable::Input(i) => &mut at.u[i],
            Variable::Parameter(i) => &mut at.parameters[i],
        };
        changing.slope = Tracked::constant(1.0);
        Motion { at, accelerations: still(&self.accelerations), multipliers: still(&self.multipliers) }
    }
}

/// Rows are equations, columns are variables.
pub type Matrix = Vec<Vec<Tracked>>;

/// The derivatives of the equations by some variables.
#[derive(Clone, Debug)]
pub struct Slopes {
    pub forces: Matrix,
    pub conditions: Matrix,
    pub positions: Matrix,
    pub rates: Matrix,
}

impl Slopes {
    fn of(system: &System, motion: &Motion<Tracked>, variables: impl Iterator<Item = Variable>) -> Slopes {
        let columns: Vec<Equations<Dual<Tracked>>> =
            variables.map(|variable| Equations::of(system, &motion.by(variable))).collect();
        let matrix = |count: usize, part: fn(&Equations<Dual<Tracked>>) -> &[Dual<Tracked>]| -> Matrix {
            (0..count).map(|i| columns.iter().map(|column| part(column)[i].slope).collect()).collect()
        };
        let held = motion.multipliers.len();
        Slopes {
            forces: matrix(system.count(), |equations| &equations.forces),
            conditions: matrix(held, |equations| &equations.conditions),
            positions: matrix(held, |equations| &equations.positions),
            rates: matrix(held, |equations| &equations.rates),
        }
    }
}

/// The equations and their derivatives.
#[derive(Clone, Debug)]
pub struct Variation {
    pub values: Equations<Tracked>,
    pub by_q: Slopes,
    pub by_v: Slopes,
    pub by_t: Slopes,
    pub by_u: Slopes,
    /// By parameters that are asked for.
    pub by_p: Slopes,
}

impl Variation {
    /// Differentiates the definitions.
    pub fn of(system: &System, motion: &Motion<Tracked>, parameters: &[usize]) -> Variation {
        let by = |variables: Vec<Variable>| Slopes::of(system, motion, variables.into_iter());
        let mut variation = Variation {
            values: Equations::of(system, motion),
            by_q: by((0..system.count()).map(Variable::Coordinate).collect()),
            by_v: by((0..system.count()).map(Variable::Velocity).collect()),
            by_t: by(vec![Variable::Time]),
            by_u: by((0..system.input_count()).map(Variable::Input).collect()),
            by_p: by(parameters.iter().copied().map(Variable::Parameter).collect()),
        };
        variation.share(|slopes| &mut slopes.forces);
        variation.share(|slopes| &mut slopes.conditions);
        variation
    }

    /// Raises the rounding errors of derivatives by the state and the time that have no terms here to the
    /// largest of their equation.
    ///
    /// An evaluation may write vectors in any axes. In axes that turn with x − t, a quantity that depends on
    /// neither x nor t is a sum of terms with both. The slopes of these terms may be as large as others of
    /// the equation, and cancel to rounding errors.
    fn share(&mut self, part: impl Fn(&mut Slopes) -> &mut Matrix) {
        let mut parts = [&mut self.by_q, &mut self.by_v, &mut self.by_t].map(part);
        for i in 0..parts[0].len() {
            let row = parts.iter().flat_map(|matrix| &matrix[i]);
            let size = row.map(|x| x.roundings).fold(0.0, f64::max);
            for x in parts.iter_mut().flat_map(|matrix| &mut matrix[i]).filter(|x| x.roundings == 0.0) {
                x.roundings = size;
            }
        }
    }

    /// The derivatives by everything, in the order of the fields.
    pub fn parts(&self) -> [&Slopes; 5] {
        [&self.by_q, &self.by_v, &self.by_t, &self.by_u, &self.by_p]
    }
}

/// Derivatives of accelerations and multipliers where the equations hold, by implicit differentiation:
/// M δa − Aᵀδλ = ∂r/∂x δx and A δa = −∂(A a − γ)/∂x δx.
pub fn response(mass: &[Vec<Tracked>], held: &Held, by: &Slopes) -> (Matrix, Matrix) {
    let width = by.forces.first().map_or(0, Vec::len);
    let columns: Vec<Vec<Tracked>> = (0..width)
        .map(|j| {
            let force: Vec<Tracked> = by.forces.iter().map(|row| row[j]).collect();
            let (matrix, mut right) = held.equations(mass, &force);
            for (entry, row) in right[force.len()..].iter_mut().zip(&by.conditions) {
                *entry = -row[j];
            }
            let (mut solution, condition) = solve(&matrix, &right);
            // The error that refinement leaves in a component that is zero, where others are not: of second
            // order.
            let size = solution.iter().map(|x| x.value.abs() + f64::EPSILON * x.roundings);
            let left = f64::EPSILON * condition * size.fold(0.0, f64::max);
            solution.iter_mut().for_each(|x| x.roundings += left);
            solution
        })
        .collect();
    let rows = |range: std::ops::Range<usize>| -> Matrix {
        range.map(|i| columns.iter().map(|column| column[i]).collect()).collect()
    };
    let (count, all) = (mass.len(), mass.len() + by.conditions.len());
    (rows(0..count), rows(count..all))
}
