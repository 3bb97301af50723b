//! Constraints on velocities that are total time derivatives of functions of coordinates and time.

use crate::calculus::{pullback, substitute};
use crate::expr::{Dependence, NodeId, Variable};
use crate::model::Model;
use crate::simplify::simplify;

/// Whether g = Σ Gᵢ(q, t) vᵢ + b(q, t) is dφ/dt of some φ(q, t): ∂Gᵢ/∂qⱼ = ∂Gⱼ/∂qᵢ and ∂Gᵢ/∂t = ∂b/∂qᵢ.
pub(super) fn is_exact(model: &mut Model, value: NodeId, gradient: &[NodeId]) -> bool {
    let graph = &mut model.graph;
    let count = gradient.len();
    let (zero, one) = (graph.zero(), graph.one());
    let at_rest: Vec<_> = (0..count as u32).map(|i| (graph.variable(Variable::Velocity(i)), zero)).collect();
    let rest = substitute(graph, &[value], &at_rest)[0];
    // With b as the component of G along time, all conditions have one form.
    let mut variables: Vec<NodeId> =
        (0..count as u32).map(|i| graph.variable(Variable::Coordinate(i))).collect();
    variables.push(graph.variable(Variable::Time));
    let place = Dependence::COORDINATES.union(Dependence::TIME);
    let mut slopes: Vec<Vec<NodeId>> = Vec::with_capacity(count + 1);
    for &component in gradient.iter().chain([&rest]) {
        slopes.push(match graph.dependence(component).meets(place) {
            true => pullback(graph, &[(component, one)], &variables),
            false => vec![zero; count + 1],
        });
    }
    let mut curl = Vec::new();
    for (i, row) in slopes.iter().enumerate() {
        for (j, column) in slopes[..i].iter().enumerate() {
            let difference = graph.sub(row[j], column[i]);
            if !graph.is_zero(difference) {
                curl.push(difference);
            }
        }
    }
    // A single state shows of most constraints that they are not exact.
    let sample = |variable: Variable| match variable {
        Variable::Coordinate(i) | Variable::Velocity(i) | Variable::Parameter(i) => {
            0.41 + 0.27 * f64::from(i)
        }
        _ => 0.83,
    };
    if graph.evaluate(&curl, sample).into_iter().any(|difference| difference.abs() > 1e-6) {
        return false;
    }
    let curl = simplify(graph, &mut model.hints, &curl);
    curl.into_iter().all(|difference| model.graph.is_zero(difference))
}
