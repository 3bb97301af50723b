//! Derivatives of the residual r = f − M a at given accelerations.
//!
//! No inverse of M is differentiated: the derivatives of the accelerations are M⁻¹ times these.

use super::Equations;
use crate::calculus::pushforward;
use crate::expr::{NodeId, Variable};
use crate::model::Model;
use crate::number::Number;

/// The residual and its derivatives, row by row.
#[derive(Clone, Debug)]
pub struct Linearization {
    /// r.
    pub residual: Vec<NodeId>,
    /// ∂r/∂q.
    pub by_q: Vec<Vec<NodeId>>,
    /// ∂r/∂v.
    pub by_v: Vec<Vec<NodeId>>,
    /// ∂r/∂u.
    pub by_u: Vec<Vec<NodeId>>,
}

impl Linearization {
    /// Differentiates the equations, one sweep for each variable.
    pub fn of(model: &mut Model, equations: &Equations) -> Linearization {
        let (count, inputs) = (model.coordinates.len(), model.inputs.len());
        let residual = residual(model, equations);
        let mut by = |variable: fn(u32) -> Variable, count: usize| {
            let one = model.graph.one();
            let mut rows = vec![Vec::with_capacity(count); residual.len()];
            for column in 0..count as u32 {
                let variable = model.graph.variable(variable(column));
                let slopes = pushforward(&mut model.graph, &residual, &[(variable, one)]);
                rows.iter_mut().zip(slopes).for_each(|(row, slope)| row.push(slope));
            }
            rows
        };
        let by_q = by(Variable::Coordinate, count);
        let by_v = by(Variable::Velocity, count);
        let by_u = by(Variable::Input, inputs);
        Linearization { residual, by_q, by_v, by_u }
    }
}

/// r = f − M a.
fn residual(model: &mut Model, equations: &Equations) -> Vec<NodeId> {
    let graph = &mut model.graph;
    let mass = &equations.mass;
    let count = mass.len();
    let accelerations: Vec<NodeId> =
        (0..count as u32).map(|i| graph.variable(Variable::Acceleration(i))).collect();
    (0..count)
        .map(|i| {
            let mut terms = vec![(equations.force[i], Number::ONE)];
            for (j, &acceleration) in accelerations.iter().enumerate() {
                let inertia = graph.mul(mass[i.max(j)][i.min(j)], acceleration);
                terms.push((inertia, Number::MINUS_ONE));
            }
            graph.sum(Number::ZERO, &terms)
        })
        .collect()
}
