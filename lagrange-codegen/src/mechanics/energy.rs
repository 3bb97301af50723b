//! Energies, the Jacobi integral, and the power of applied forces.
//!
//! A Lagrangian given as a whole has no T and V of its own. Its potential is −L at v = 0 and
//! its energy the Jacobi integral v·∂L/∂v − L; the kinetic energy is the difference, which for
//! L = T − V with a T quadratic in v is T, and for the relativistic particle (γ − 1) m c².

use super::constraints::Conditions;
use super::motion::Motion;
use crate::calculus::{pullback, pushforward, substitute, velocity_degrees};
use crate::expr::{Graph, NodeId, Variable};
use crate::kinematics::{time_direction, times};
use crate::model::Model;
use crate::number::Number;

/// The scalars of a model.
pub(super) struct Energies {
    pub kinetic: NodeId,
    pub potential: NodeId,
    /// The sum of the Lagrangians given as a whole.
    pub whole: NodeId,
    pub total: NodeId,
    pub jacobi: Option<NodeId>,
}

pub(super) fn energies(model: &mut Model, motion: &Motion, momenta: &[NodeId]) -> Energies {
    let half = Number::HALF;
    let mut kinetic = Vec::new();
    for body in &motion.translations {
        let squares: Vec<_> =
            body.velocity.iter().map(|&component| (model.graph.powi(component, 2), Number::ONE)).collect();
        let square = model.graph.sum(Number::ZERO, &squares);
        kinetic.push((model.graph.mul(body.mass, square), half));
    }
    for body in &motion.rotations {
        let momentum = times(&mut model.graph, &body.inertia, &body.rate);
        for (rate, momentum) in body.rate.into_iter().zip(momentum) {
            kinetic.push((model.graph.mul(rate, momentum), half));
        }
    }
    kinetic.extend(model.kinetic.iter().map(|term| (term.value, Number::ONE)));
    let mut potential: Vec<_> = model.potential.iter().map(|term| (term.value, Number::ONE)).collect();

    let graph = &mut model.graph;
    let separate = graph.sum(Number::ZERO, &kinetic);
    let mut jacobi_terms: Vec<(NodeId, Number)> =
        momenta.iter().zip(&motion.v).map(|(&p, &v)| (graph.mul(p, v), Number::ONE)).collect();
    jacobi_terms.push((separate, Number::MINUS_ONE));
    jacobi_terms.extend(potential.iter().copied());

    if !model.lagrangian.is_empty() {
        let zero = graph.zero();
        let at_rest: Vec<_> = motion.v.iter().map(|&v| (v, zero)).collect();
        let one = graph.one();
        let values: Vec<NodeId> = model.lagrangian.iter().map(|term| term.value).collect();
        let seeds: Vec<_> = values.iter().map(|&value| (value, one)).collect();
        let own_momenta = pullback(graph, &seeds, &motion.v);
        for (&p, &v) in own_momenta.iter().zip(&motion.v) {
            kinetic.push((graph.mul(p, v), Number::ONE));
        }
        for (&value, rest) in values.iter().zip(substitute(graph, &values, &at_rest)) {
            kinetic.push((value, Number::MINUS_ONE));
            kinetic.push((rest, Number::ONE));
            potential.push((rest, Number::MINUS_ONE));
            jacobi_terms.push((value, Number::MINUS_ONE));
        }
    }
    let homogeneous = velocity_degrees(graph, separate).is_homogeneous(2) || graph.is_zero(separate);
    let kinetic = graph.sum(Number::ZERO, &kinetic);
    let potential = graph.sum(Number::ZERO, &potential);
    let total = graph.add(kinetic, potential);
    let jacobi = (!homogeneous).then(|| graph.sum(Number::ZERO, &jacobi_terms));
    let whole: Vec<_> = model.lagrangian.iter().map(|term| (term.value, Number::ONE)).collect();
    let whole = graph.sum(Number::ZERO, &whole);
    Energies { kinetic, potential, whole, total, jacobi: jacobi.filter(|&integral| integral != total) }
}

/// v·(Q − ∂D/∂v), if any force is applied.
pub(super) fn power(model: &mut Model, motion: &Motion, applied: &[NodeId]) -> Option<NodeId> {
    if model.forces.is_empty() && model.dissipation.is_empty() {
        return None;
    }
    let terms: Vec<_> =
        applied.iter().zip(&motion.v).map(|(&q, &v)| (model.graph.mul(q, v), Number::ONE)).collect();
    Some(model.graph.sum(Number::ZERO, &terms))
}

/// Summands of dh/dt along a motion, h = v·p − L: the power of the applied forces and of the reactions, less
/// ∂L/∂t. The large terms that cancel in v·∂h/∂q + a·∂h/∂v are never formed.
pub(super) fn balance(
    graph: &mut Graph,
    momenta: &[NodeId],
    integral: NodeId,
    power: Option<NodeId>,
    conditions: &Conditions,
) -> Vec<(NodeId, Number)> {
    let mut lagrangian: Vec<_> = momenta
        .iter()
        .enumerate()
        .map(|(i, &p)| {
            let v = graph.variable(Variable::Velocity(i as u32));
            (graph.mul(p, v), Number::ONE)
        })
        .collect();
    lagrangian.push((integral, Number::MINUS_ONE));
    let lagrangian = graph.sum(Number::ZERO, &lagrangian);
    let (time, one) = (graph.variable(Variable::Time), graph.one());
    let explicit = pushforward(graph, &[lagrangian], &[(time, one)])[0];
    let mut terms = vec![(explicit, Number::MINUS_ONE)];
    terms.extend(power.map(|power| (power, Number::ONE)));
    terms.push((conditions.power(graph), Number::ONE));
    terms
}

/// d(T + V)/dt along a motion, from [`balance`]. The difference between T + V and the Jacobi integral is
/// differentiated as it stands.
pub(super) fn rate(
    graph: &mut Graph,
    momenta: &[NodeId],
    total: NodeId,
    jacobi: Option<NodeId>,
    power: Option<NodeId>,
    conditions: &Conditions,
) -> NodeId {
    let integral = jacobi.unwrap_or(total);
    let mut terms = balance(graph, momenta, integral, power, conditions);
    if jacobi.is_some() {
        let mut direction = time_direction(graph, momenta.len());
        for i in 0..momenta.len() as u32 {
            direction
                .push((graph.variable(Variable::Velocity(i)), graph.variable(Variable::Acceleration(i))));
        }
        let rest = graph.sub(total, integral);
        terms.push((pushforward(graph, &[rest], &direction)[0], Number::ONE));
    }
    graph.sum(Number::ZERO, &terms)
}
