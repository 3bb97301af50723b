//! The homogeneous parts of the kinetic energy in the velocities, and the inertia forces that belong to each.
//!
//! L = T₂ + T₁ + T₀ − V with T₂ = ½ vᵀM v, T₁ = g·v. A Lagrangian given as a whole contributes its parts of
//! degrees two and one, its part without velocities is −V. The inertia force −(d/dt ∂T/∂v − ∂T/∂q) is that of
//! T₂, which is relative (−M a) and quadratic in the velocities, that of T₁, which is gyroscopic (−G v) and
//! guiding (−∂g/∂t), and ∂T₀/∂q (Lurie, *Analytical Mechanics*, chapter 4; Päsler, *Prinzipe der Mechanik*,
//! section 8).

use super::Covariant;
use crate::calculus::{pullback, pushforward, substitute};
use crate::expr::{NodeId, Variable};
use crate::kinematics::time_direction;
use crate::mechanics::Equations;
use crate::model::Model;
use crate::number::Number;

/// The parts of T and of the inertia forces, with the accelerations as variables.
#[derive(Clone, Debug)]
pub struct Inertia {
    /// T₂, T₁, T₀.
    pub parts: [NodeId; 3],
    /// −M a.
    pub relative: Vec<NodeId>,
    /// −(C v + ½ ∂M/∂t v): the contribution of T₂ without accelerations.
    pub coriolis: Vec<NodeId>,
    /// −G v.
    pub gyroscopic: Vec<NodeId>,
    /// ∂T₀/∂q − ∂g/∂t.
    pub transport: Vec<NodeId>,
}

impl Inertia {
    /// Takes the kinetic energy apart.
    pub fn of(model: &mut Model, equations: &Equations, covariant: &Covariant) -> Inertia {
        let graph = &mut model.graph;
        let count = equations.momenta.len();
        let mut all = |variable: fn(u32) -> Variable| -> Vec<NodeId> {
            (0..count as u32).map(|i| graph.variable(variable(i))).collect()
        };
        let (q, v, a) = (all(Variable::Coordinate), all(Variable::Velocity), all(Variable::Acceleration));
        let (zero, one, minus_one) = (graph.zero(), graph.one(), graph.constant(Number::MINUS_ONE));
        let at_rest: Vec<_> = v.iter().map(|&v| (v, zero)).collect();
        let constant = substitute(graph, &[equations.kinetic_energy], &at_rest)[0];
        let homogeneous = covariant.guiding.iter().all(|&g| graph.is_zero(g));
        let mut product = |left: &[NodeId], scale: Number| {
            let terms: Vec<_> = left.iter().zip(&v).map(|(&p, &v)| (graph.mul(p, v), scale)).collect();
            graph.sum(Number::ZERO, &terms)
        };
        let linear = product(&covariant.guiding, Number::ONE);
        let quadratic = product(&covariant.relative, Number::HALF);
        let shown = if homogeneous && graph.is_zero(constant) { equations.kinetic_energy } else { quadratic };

        let relative = (0..count)
            .map(|i| {
                let terms: Vec<_> = (0..count)
                    .map(|j| (graph.mul(equations.mass.rows()[i.max(j)][i.min(j)], a[j]), Number::MINUS_ONE))
                    .collect();
                graph.sum(Number::ZERO, &terms)
            })
            .collect();
        let direction = time_direction(graph, count);
        let changes = pushforward(graph, &covariant.relative, &direction);
        let slopes = pullback(graph, &[(quadratic, one)], &q);
        let coriolis = slopes.iter().zip(changes).map(|(&slope, change)| graph.sub(slope, change)).collect();
        let gyroscopic = (0..count)
            .map(|i| {
                let row = &covariant.gyroscopic[i];
                let terms: Vec<_> =
                    row.iter().zip(&v).map(|(&g, &v)| (graph.mul(g, v), Number::MINUS_ONE)).collect();
                graph.sum(Number::ZERO, &terms)
            })
            .collect();
        let time = graph.variable(Variable::Time);
        let explicit = pushforward(graph, &covariant.guiding, &[(time, minus_one)]);
        let slopes = pullback(graph, &[(constant, one)], &q);
        let transport =
            slopes.iter().zip(explicit).map(|(&slope, change)| graph.add(slope, change)).collect();
        Inertia { parts: [shown, linear, constant], relative, coriolis, gyroscopic, transport }
    }
}
