//! The weight among the potentials of a model.

use super::moved::{POINTS, Part, ROUNDINGS, number};
use crate::expr::{Graph, NodeId, Variable};
use crate::kinematics::slopes_to;
use crate::model::Model;

type Vector = [NodeId; 3];

/// The acceleration of free fall of which all potentials together, or those that name the place of a part,
/// are the weight, and these potentials; zero and none of them where neither are.
pub fn gravity(model: &mut Model, parts: &[Part]) -> (Vector, Vec<usize>) {
    let all: Vec<usize> = (0..model.potential.len()).collect();
    let graph = &mut model.graph;
    let (zero, one) = (graph.zero(), graph.one());
    let q: Vec<NodeId> =
        (0..model.coordinates.len() as u32).map(|i| graph.variable(Variable::Coordinate(i))).collect();
    let places: Vec<NodeId> = parts.iter().flat_map(|part| part.place).collect();
    let mut named = Vec::new();
    let mut fall = None;
    for &term in &all {
        let seeds = [(model.potential[term].value, one)];
        let (forces, _) = slopes_to(graph, &seeds, &places, &q, &[]);
        for (part, force) in parts.iter().zip(forces.as_chunks::<3>().0) {
            if force.iter().all(|&component| graph.is_zero(component)) {
                continue;
            }
            named.push(term);
            fall.get_or_insert_with(|| {
                force.map(|component| {
                    let weight = graph.div(component, part.mass);
                    graph.neg(weight)
                })
            });
        }
    }
    named.dedup();
    let Some(fall) = fall else { return ([zero; 3], Vec::new()) };
    let is_fixed = fall.iter().all(|&component| graph.dependence(component).is_fixed());
    for terms in [all, named] {
        if is_fixed
            && is_weight(graph, parts, &q, &fall, terms.iter().map(|&term| model.potential[term].value))
        {
            return (fall, terms);
        }
    }
    ([zero; 3], Vec::new())
}

/// Whether some potentials do the work of the weight.
fn is_weight(
    graph: &mut Graph,
    parts: &[Part],
    q: &[NodeId],
    fall: &Vector,
    potentials: impl Iterator<Item = NodeId>,
) -> bool {
    let one = graph.one();
    let seeds: Vec<(NodeId, NodeId)> = potentials.map(|value| (value, one)).collect();
    let (_, slopes) = slopes_to(graph, &seeds, &[], q, &[]);
    let mut roots: Vec<NodeId> = fall.iter().chain(&slopes).copied().collect();
    for part in parts {
        roots.push(part.mass);
        roots.extend(part.rotation.matrix.as_flattened().iter().chain(&part.velocity));
    }
    (0..POINTS).all(|point| {
        (0..q.len()).all(|j| {
            let values = graph.evaluate(&roots, |variable| match variable {
                Variable::Velocity(i) => f64::from(u8::from(i as usize == j)),
                other => number(point, other),
            });
            let (fall, rest) = values.split_at(3);
            let (slopes, parts) = rest.split_at(q.len());
            let (mut power, mut size) = (slopes[j], slopes[j].abs());
            for part in parts.as_chunks::<13>().0 {
                let (mass, matrix, velocity) = (part[0], &part[1..10], &part[10..]);
                for (i, fall) in fall.iter().enumerate() {
                    // A level motion is a difference here, which may be all rounding errors.
                    let along = [0, 1, 2].map(|k| mass * fall * matrix[3 * i + k] * velocity[k]);
                    power += along.iter().sum::<f64>();
                    size += along.iter().map(|part| part.abs()).sum::<f64>();
                }
            }
            // False for what is not a number.
            power.abs() <= ROUNDINGS * size
        })
    })
}
