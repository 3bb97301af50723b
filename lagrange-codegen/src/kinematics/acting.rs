//! How a holonomic constraint acts on a particle or a body.
//!
//! Where f is a function of the position r of a place, its force there is λ ∂f/∂r. A coordinate that is a
//! component of one position counts as that component, so that a constraint may be written in the coordinates
//! as well. Where it is written in other coordinates of a particle that carry nothing else, and there are
//! as many of them as r has components, f is a function of r by way of them, and ∂f/∂r follows from
//! (∂r/∂q)ᵀ ∂f/∂r = ∂f/∂q. Otherwise its form does not tell how it acts.

use crate::calculus::{pullback, substitute};
use crate::expr::{Exponent, Graph, Node, NodeId, Variable};
use crate::model::{Constraint, ConstraintKind, Model, Place, component_of_one, orientation};
use crate::number::Number;

/// The action of a constraint on a place.
#[derive(Clone, Debug)]
pub(crate) struct Acting {
    /// The force of a unit multiplier, as a function of coordinates.
    pub force: Vec<NodeId>,
    /// Whether that is the whole action. It is not if the constraint also contains coordinates or
    /// orientations that move the place.
    pub is_whole: bool,
}

impl Acting {
    /// Whether there may be a force.
    pub fn is_any(&self, graph: &Graph) -> bool {
        !self.is_whole || self.force.iter().any(|&component| !graph.is_zero(component))
    }

    /// The size of the force.
    pub fn size(&self, graph: &mut Graph) -> NodeId {
        let squares: Vec<_> = self.force.iter().map(|&entry| (graph.powi(entry, 2), Number::ONE)).collect();
        let square = graph.sum(Number::ZERO, &squares);
        graph.product(&[(square, Exponent(1))])
    }
}

/// Variables for the positions of places.
pub(crate) struct Standing<'a> {
    pub places: &'a [Place],
    /// Coordinates that are a component of one position, with the variables of these components.
    pub components: Vec<(NodeId, NodeId)>,
    /// The variables of all components.
    pub variables: Vec<NodeId>,
    /// The variables with the components that they stand for.
    pub values: Vec<(NodeId, NodeId)>,
}

impl<'a> Standing<'a> {
    pub fn of(places: &'a [Place], coordinates: &[NodeId]) -> Standing<'a> {
        let component = |&q: &NodeId| component_of_one(places, q).map(|variable| (q, variable));
        let components = coordinates.iter().filter_map(component).collect();
        let variables: Vec<NodeId> =
            places.iter().flat_map(|place| place.variables.iter().copied()).collect();
        let positions = places.iter().flat_map(|place| place.position.iter().copied());
        let values = variables.iter().copied().zip(positions).collect();
        Standing { places, components, variables, values }
    }

    /// A constraint as a function of the positions of places.
    fn through(&self, graph: &mut Graph, constraint: &Constraint) -> Option<NodeId> {
        Some(substitute(graph, &[constraint.through?], &self.components)[0])
    }

    /// The forces of a unit multiplier of such a function, by component.
    fn slopes(&self, graph: &mut Graph, through: NodeId) -> Vec<NodeId> {
        let one = graph.one();
        let slopes = pullback(graph, &[(through, one)], &self.variables);
        substitute(graph, &slopes, &self.values)
    }

    /// The forces of a unit multiplier of a holonomic constraint, by component.
    pub fn forces(&self, graph: &mut Graph, constraint: &Constraint) -> Vec<NodeId> {
        match self.through(graph, constraint) {
            Some(through) => self.slopes(graph, through),
            None => vec![graph.zero(); self.variables.len()],
        }
    }

    /// Components by place.
    pub fn by_place<T>(&self, components: impl IntoIterator<Item = T>) -> Vec<Vec<T>> {
        let mut rest = components.into_iter();
        self.places.iter().map(|place| rest.by_ref().take(place.variables.len()).collect()).collect()
    }
}

/// The action of each constraint on each place. For a constraint on velocities it only tells whether there is
/// one. A holonomic constraint that is not known as a function of places has no entries.
pub(crate) fn acting(model: &mut Model, constraints: &[Constraint]) -> Vec<Vec<Acting>> {
    let count = model.coordinates.len() as u32;
    let coordinates: Vec<NodeId> =
        (0..count).map(|i| model.graph.variable(Variable::Coordinate(i))).collect();
    let velocities: Vec<NodeId> = (0..count).map(|i| model.graph.variable(Variable::Velocity(i))).collect();
    let Model { graph, places, orientations, kinetic, lagrangian, .. } = model;
    let standing = Standing::of(places, &coordinates);
    let movers: Vec<Named> = places
        .iter()
        .map(|place| Named::by(graph, place.position.iter().copied(), &coordinates, orientations))
        .collect();
    // Inertia given as an energy may belong to any coordinate.
    let has_energies = !kinetic.is_empty() || !lagrangian.is_empty();
    let mut all = Vec::with_capacity(constraints.len());
    for constraint in constraints {
        if constraint.kind != ConstraintKind::Holonomic {
            let named = graph.cone([constraint.value].into_iter().chain(constraint.through));
            all.push(on_velocities(places, &movers, &coordinates, &velocities, &named));
            continue;
        }
        let Some(through) = standing.through(graph, constraint) else {
            all.push(Vec::new());
            continue;
        };
        let slopes = standing.slopes(graph, through);
        let named = Named::by(graph, [through], &coordinates, orientations);
        let mut own = Vec::with_capacity(places.len());
        for (i, (place, force)) in places.iter().zip(standing.by_place(slopes)).enumerate() {
            let moving = &movers[i];
            let is_whole = !named.meets(moving);
            let mut others = movers.iter().enumerate().filter(|&(j, _)| j != i);
            let is_alone = others.all(|(_, other)| !other.meets(moving));
            let is_free = !is_whole && !place.turns && !has_energies && is_alone;
            let is_square = moving.coordinates.len() == place.position.len();
            let by_coordinates = match is_free && is_square && moving.orientations.is_empty() {
                true => inverse_slopes(graph, constraint.value, &place.position, &moving.coordinates),
                false => None,
            };
            let is_whole = is_whole || by_coordinates.is_some();
            own.push(Acting { force: by_coordinates.unwrap_or(force), is_whole });
        }
        all.push(own);
    }
    all
}

/// What functions name of what moves a system.
struct Named {
    coordinates: Vec<NodeId>,
    /// The indices of orientations, which are named by any entry of their matrices.
    orientations: Vec<usize>,
}

impl Named {
    fn by(
        graph: &Graph,
        functions: impl IntoIterator<Item = NodeId>,
        coordinates: &[NodeId],
        orientations: &[usize],
    ) -> Named {
        let mut named = Named { coordinates: Vec::new(), orientations: Vec::new() };
        for node in graph.cone(functions) {
            match graph.node(node) {
                Node::Variable(Variable::Entry(entry)) => named.orientations.push(*entry as usize / 9),
                Node::Variable(Variable::Coordinate(i)) => {
                    match orientation::holding(orientations, *i as usize) {
                        Some(index) => named.orientations.push(index),
                        None if coordinates.contains(&node) => named.coordinates.push(node),
                        None => {}
                    }
                }
                _ => {}
            }
        }
        named
    }

    /// Whether both name the same coordinate or orientation.
    fn meets(&self, other: &Named) -> bool {
        self.coordinates.iter().any(|q| other.coordinates.contains(q))
            || self.orientations.iter().any(|index| other.orientations.contains(index))
    }
}

/// The action of a constraint on velocities that contains these nodes. Its force is not needed, only whether
/// there may be one.
fn on_velocities(
    places: &[Place],
    movers: &[Named],
    coordinates: &[NodeId],
    velocities: &[NodeId],
    named: &[NodeId],
) -> Vec<Acting> {
    let moves = |q: NodeId| {
        let i = coordinates.iter().position(|&other| other == q);
        i.is_some_and(|i| named.contains(&velocities[i]))
    };
    let acts = |(place, movers): (&Place, &Named)| {
        // Every constraint on velocities counts where orientations move the place.
        let by_coordinates = !movers.orientations.is_empty() || movers.coordinates.iter().any(|&q| moves(q));
        by_coordinates || place.rates.iter().any(|rate| named.contains(rate))
    };
    places.iter().zip(movers).map(|one| Acting { force: Vec::new(), is_whole: !acts(one) }).collect()
}

/// ∂f/∂r of functions f and r of as many coordinates as r has components, by Cramer's rule; `None` if the
/// coordinates do not move r in all directions.
fn inverse_slopes(
    graph: &mut Graph,
    value: NodeId,
    position: &[NodeId],
    coordinates: &[NodeId],
) -> Option<Vec<NodeId>> {
    let one = graph.one();
    let right = pullback(graph, &[(value, one)], coordinates);
    let columns: Vec<Vec<NodeId>> =
        position.iter().map(|&component| pullback(graph, &[(component, one)], coordinates)).collect();
    let whole = determinant(graph, &columns);
    if graph.is_zero(whole) {
        return None;
    }
    let force = (0..columns.len()).map(|i| {
        let mut replaced = columns.clone();
        replaced[i].clone_from(&right);
        let part = determinant(graph, &replaced);
        graph.product(&[(part, Exponent(2)), (whole, Exponent(-2))])
    });
    Some(force.collect())
}

/// The determinant of a small matrix, by its first column.
fn determinant(graph: &mut Graph, columns: &[Vec<NodeId>]) -> NodeId {
    let Some((first, rest)) = columns.split_first() else { return graph.one() };
    let mut terms = Vec::with_capacity(first.len());
    for (row, &entry) in first.iter().enumerate() {
        if graph.is_zero(entry) {
            continue;
        }
        let without = |column: &Vec<NodeId>| {
            column.iter().enumerate().filter(|&(other, _)| other != row).map(|(_, &entry)| entry).collect()
        };
        let minor: Vec<Vec<NodeId>> = rest.iter().map(without).collect();
        let minor = determinant(graph, &minor);
        let sign = if row % 2 == 0 { Number::ONE } else { Number::MINUS_ONE };
        terms.push((graph.mul(entry, minor), sign));
    }
    graph.sum(Number::ZERO, &terms)
}
