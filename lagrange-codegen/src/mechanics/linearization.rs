//! Derivatives of the residual r = f + Aᵀλ − M a and of the constraints A a − γ at given accelerations and
//! multipliers.
//!
//! No inverse of M is differentiated: the derivatives of the accelerations are the solution of a linear
//! system with M and A and these on the right. Of bodies that hang on each other they follow from the
//! screws of the coordinates ([`Screws`]), where that takes fewer operations than a forward sweep for each
//! coordinate and velocity.

use super::{Conditions, Equations, Screws};
use crate::calculus::{forward_operations, pushforward};
use crate::expr::{NodeId, Variable};
use crate::model::Model;
use crate::number::Number;
use crate::simplify::cost::cost;

/// Values with their derivatives, row by row.
#[derive(Clone, Debug)]
pub struct Derivatives {
    /// The values.
    pub values: Vec<NodeId>,
    /// ∂/∂q.
    pub by_q: Vec<Vec<NodeId>>,
    /// ∂/∂v.
    pub by_v: Vec<Vec<NodeId>>,
    /// ∂/∂t.
    pub by_t: Vec<NodeId>,
}

/// Derivatives by parameters, a column each.
#[derive(Clone, Debug)]
pub struct Sensitivities {
    /// Derivatives of r.
    pub forces: Vec<Vec<NodeId>>,
    /// Derivatives of A a − γ.
    pub conditions: Vec<Vec<NodeId>>,
    /// Derivatives of f of the holonomic constraints.
    pub positions: Vec<Vec<NodeId>>,
    /// Derivatives of w, the constraints at the level of velocities.
    pub rates: Vec<Vec<NodeId>>,
}

/// The residuals and their derivatives.
#[derive(Clone, Debug)]
pub struct Linearization {
    /// Inertia forces and weights, if their derivatives follow from screws.
    pub screws: Option<Screws>,
    /// r, or the part of it that is not in `screws`.
    pub forces: Derivatives,
    /// ∂r/∂u.
    pub by_u: Vec<Vec<NodeId>>,
    /// A a − γ of the constraints.
    pub conditions: Derivatives,
    /// ∂w/∂q, with w the constraints at the level of velocities.
    pub rates_by_q: Vec<Vec<NodeId>>,
    /// Derivatives by the parameters in `sensitivities`.
    pub by_p: Sensitivities,
}

impl Linearization {
    /// Differentiates the equations, one sweep for each variable.
    pub fn of(model: &mut Model, equations: &Equations) -> Linearization {
        let (count, inputs) = (model.coordinates.len(), model.inputs.len());
        let whole = residual(model, equations);
        let screws = cheaper_screws(model, &whole);
        let residual = screws.as_ref().map_or(&whole, |screws| &screws.rest).clone();
        let conditions = conditions(model, equations);
        let by_u = by(model, &residual, &variables(Variable::Input, inputs));
        let Conditions { positions, rates, .. } = &equations.conditions;
        let rates_by_q = by(model, rates, &variables(Variable::Coordinate, count));
        let parameters: Vec<Variable> =
            model.sensitivities.iter().map(|&parameter| Variable::Parameter(parameter)).collect();
        let by_p = Sensitivities {
            forces: by(model, &whole, &parameters),
            conditions: by(model, &conditions, &parameters),
            positions: by(model, positions, &parameters),
            rates: by(model, rates, &parameters),
        };
        Linearization {
            screws,
            forces: derivatives(model, residual),
            by_u,
            conditions: derivatives(model, conditions),
            rates_by_q,
            by_p,
        }
    }
}

/// Screws, if there are any and they take fewer operations than sweeps.
fn cheaper_screws(model: &mut Model, residual: &[NodeId]) -> Option<Screws> {
    let count = model.coordinates.len();
    let mut trial = model.clone();
    let screws = Screws::of(&mut trial)?;
    let variables = [variables(Variable::Coordinate, count), variables(Variable::Velocity, count)].concat();
    let variables: Vec<NodeId> =
        variables.into_iter().map(|variable| trial.graph.variable(variable)).collect();
    let sweeps = forward_operations(&trial.graph, residual, &variables);
    let of_screws = cost(&trial.graph, &screws.nodes()) as usize + screws.operations();
    if of_screws >= sweeps {
        return None;
    }
    *model = trial;
    Some(screws)
}

fn derivatives(model: &mut Model, values: Vec<NodeId>) -> Derivatives {
    let count = model.coordinates.len();
    let (time, one) = (model.graph.variable(Variable::Time), model.graph.one());
    Derivatives {
        by_q: by(model, &values, &variables(Variable::Coordinate, count)),
        by_v: by(model, &values, &variables(Variable::Velocity, count)),
        by_t: pushforward(&mut model.graph, &values, &[(time, one)]),
        values,
    }
}

/// The first `count` variables of a kind.
fn variables(kind: fn(u32) -> Variable, count: usize) -> Vec<Variable> {
    (0..count as u32).map(kind).collect()
}

/// Derivatives by some variables, a column each.
fn by(model: &mut Model, values: &[NodeId], variables: &[Variable]) -> Vec<Vec<NodeId>> {
    let one = model.graph.one();
    let mut rows = vec![Vec::with_capacity(variables.len()); values.len()];
    for &variable in variables {
        let variable = model.graph.variable(variable);
        let slopes = pushforward(&mut model.graph, values, &[(variable, one)]);
        rows.iter_mut().zip(slopes).for_each(|(row, slope)| row.push(slope));
    }
    rows
}

/// r = f + Aᵀλ − M a.
fn residual(model: &mut Model, equations: &Equations) -> Vec<NodeId> {
    let graph = &mut model.graph;
    let mass = equations.mass.rows();
    let count = mass.len();
    let accelerations: Vec<NodeId> =
        (0..count as u32).map(|i| graph.variable(Variable::Acceleration(i))).collect();
    (0..count)
        .map(|i| {
            let mut terms = vec![(equations.force[i], Number::ONE)];
            terms.extend(equations.conditions.reactions.get(i).map(|&reaction| (reaction, Number::ONE)));
            for (j, &acceleration) in accelerations.iter().enumerate() {
                let inertia = graph.mul(mass[i.max(j)][i.min(j)], acceleration);
                terms.push((inertia, Number::MINUS_ONE));
            }
            graph.sum(Number::ZERO, &terms)
        })
        .collect()
}

/// A a − γ.
fn conditions(model: &mut Model, equations: &Equations) -> Vec<NodeId> {
    let graph = &mut model.graph;
    let conditions = &equations.conditions;
    let rows = conditions.jacobian.iter().zip(&conditions.gamma);
    rows.map(|(row, &gamma)| {
        let mut terms = vec![(gamma, Number::MINUS_ONE)];
        for (j, &entry) in (0..).zip(row) {
            let acceleration = graph.variable(Variable::Acceleration(j));
            terms.push((graph.mul(entry, acceleration), Number::ONE));
        }
        graph.sum(Number::ZERO, &terms)
    })
    .collect()
}
