//! Cartesian forces of constraints on the particles and bodies through whose positions they are written.
//!
//! A holonomic constraint exerts λ ∂f/∂r on a particle, where f is a function of the position r. A constraint
//! g on velocities that uses the velocity ṙ of a particle exerts λ ∂g/∂ṙ, and a coordinate that is a
//! component of one position counts as that component.

use super::motion::Motion;
use crate::calculus::{pullback, pushforward, substitute};
use crate::expr::{Graph, NodeId};
use crate::kinematics::acting::Standing;
use crate::model::{Constraint, ConstraintKind, Place};

/// The force of a unit multiplier by constraint, place and component.
pub(super) fn forces(
    graph: &mut Graph,
    constraints: &[Constraint],
    places: &[Place],
    jacobian: &[Vec<NodeId>],
    motion: &Motion,
) -> Vec<Vec<Vec<NodeId>>> {
    let standing = Standing::of(places, &motion.q);
    let Standing { components, variables, values, .. } = &standing;
    let moving: Vec<(NodeId, NodeId)> = places
        .iter()
        .flat_map(|place| place.rates.iter().copied().zip(place.position.iter().copied()))
        .collect();
    let positions: Vec<NodeId> = moving.iter().map(|&(_, position)| position).collect();
    let velocities = pushforward(graph, &positions, &motion.direction);
    let rates: Vec<(NodeId, NodeId)> = moving.iter().map(|&(rate, _)| rate).zip(velocities).collect();
    let one = graph.one();
    let mut forces = Vec::with_capacity(constraints.len());
    for (constraint, gradient) in constraints.iter().zip(jacobian) {
        let flat: Vec<NodeId> = match constraint.through {
            Some(through) if constraint.kind != ConstraintKind::Holonomic => {
                // A coordinate that is a component of one position counts as that component.
                let named: Vec<NodeId> =
                    places.iter().flat_map(|place| place.rates.iter().copied()).collect();
                let by = [named.as_slice(), &motion.v].concat();
                let slopes = pullback(graph, &[(through, one)], &by);
                let slopes = substitute(graph, &slopes, &[values.as_slice(), &rates].concat());
                let (named, own) = slopes.split_at(named.len());
                let mut named = named.iter().copied();
                let mut flat = Vec::with_capacity(variables.len());
                for place in places {
                    let mut at_place: Vec<NodeId> = named.by_ref().take(place.rates.len()).collect();
                    at_place.resize(place.variables.len(), graph.zero());
                    for (force, variable) in at_place.iter_mut().zip(&place.variables) {
                        let coordinate = components.iter().find(|(_, of)| of == variable);
                        if let Some(i) =
                            coordinate.and_then(|&(q, _)| motion.q.iter().position(|&other| other == q))
                        {
                            *force = graph.add(*force, own[i]);
                        }
                    }
                    flat.extend(at_place);
                }
                flat
            }
            Some(_) => standing.forces(graph, constraint),
            // Any other constraint acts on components that are coordinates, by its gradient.
            None => {
                let slope = |&variable: &NodeId| {
                    let coordinate = components.iter().find(|&&(_, of)| of == variable)?.0;
                    let place = motion.q.iter().position(|&q| q == coordinate)?;
                    Some(gradient[place])
                };
                let zero = graph.zero();
                variables.iter().map(|variable| slope(variable).unwrap_or(zero)).collect()
            }
        };
        forces.push(standing.by_place(flat));
    }
    forces
}
