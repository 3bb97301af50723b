//! Momenta, mass matrix and bias.

use super::forces;
use super::motion::{Motion, Translation};
use crate::calculus::{pullback, pushforward};
use crate::expr::{Graph, NodeId};
use crate::kinematics::{cross, slopes_to, times, transposed_times};
use crate::model::Model;
use crate::number::Number;

/// Seeds of a reverse sweep: loads on positions, loads on rates, and generalized forces.
#[derive(Clone, Debug, Default)]
pub(super) struct Loads {
    /// `(r, F)`: contributes Fᵀ ∂r/∂q.
    pub through_q: Vec<(NodeId, NodeId)>,
    /// `(w, F)`: contributes Fᵀ ∂w/∂v.
    pub through_v: Vec<(NodeId, NodeId)>,
    /// `(coordinate, Q)`.
    pub direct: Vec<(usize, NodeId)>,
}

impl Loads {
    /// Both sets of seeds.
    pub fn joined(mut self, other: Loads) -> Loads {
        self.through_q.extend(other.through_q);
        self.through_v.extend(other.through_v);
        self.direct.extend(other.direct);
        self
    }

    /// A load on a moving point, seeded by ∂r/∂q or by ∂ṙ/∂v, which are equal.
    fn on(&mut self, body: &Translation, load: &[NodeId]) {
        let load = load.iter().copied();
        match &body.position {
            Some(position) => self.through_q.extend(position.iter().copied().zip(load)),
            None => self.through_v.extend(body.velocity.iter().copied().zip(load)),
        }
    }

    /// The seeds with the opposite sign.
    pub fn negated(mut self, model: &mut Model) -> Loads {
        for (_, load) in self.through_q.iter_mut().chain(&mut self.through_v) {
            *load = model.graph.neg(*load);
        }
        for (_, load) in &mut self.direct {
            *load = model.graph.neg(*load);
        }
        self
    }

    /// One generalized force for each coordinate.
    pub fn sweep(self, model: &mut Model, motion: &Motion) -> Vec<NodeId> {
        let graph = &mut model.graph;
        let (through_q, on_carried) = through_places(graph, &self.through_q, motion);
        let through_v = pullback(graph, &[self.through_v, on_carried].concat(), &motion.v);
        let mut terms: Vec<Vec<(NodeId, Number)>> = (0..motion.q.len())
            .map(|i| vec![(through_q[i], Number::ONE), (through_v[i], Number::ONE)])
            .collect();
        for (coordinate, load) in self.direct {
            terms[coordinate].push((load, Number::ONE));
        }
        terms.iter().map(|terms| graph.sum(Number::ZERO, terms)).collect()
    }
}

/// Turns loads on positions into generalized forces, (∂r/∂q)ᵀ F = (∂ṙ/∂v)ᵀ F. For places that rotations
/// carry, the load acts on their velocities in the axes of these rotations.
fn through_places(
    graph: &mut Graph,
    seeds: &[(NodeId, NodeId)],
    motion: &Motion,
) -> (Vec<NodeId>, Vec<(NodeId, NodeId)>) {
    let places = motion.carried.iter().flat_map(|carried| carried.place);
    let places: Vec<NodeId> = places.collect();
    let (forces, through_q) = slopes_to(graph, seeds, &places, &motion.q, &motion.turning);
    let mut loads = Vec::new();
    for (carried, force) in motion.carried.iter().zip(forces.chunks_exact(3)) {
        let turned = transposed_times(graph, &carried.matrix, &[force[0], force[1], force[2]]);
        let moving = carried.velocity.into_iter().zip(turned);
        loads.extend(moving.filter(|&(_, load)| !graph.is_zero(load)).collect::<Vec<_>>());
    }
    (through_q, loads)
}

/// p = ∂L/∂v.
pub(super) fn momenta(model: &mut Model, motion: &Motion) -> Vec<NodeId> {
    let mut loads = Loads::default();
    for body in &motion.translations {
        let momentum: Vec<_> =
            body.velocity.iter().map(|&velocity| model.graph.mul(body.mass, velocity)).collect();
        loads.on(body, &momentum);
    }
    for body in &motion.rotations {
        let momentum = times(&mut model.graph, &body.inertia, &body.rate);
        loads.through_v.extend(body.rate.iter().copied().zip(momentum));
    }
    let one = model.graph.one();
    for term in model.kinetic.iter().chain(&model.lagrangian) {
        loads.through_v.push((term.value, one));
    }
    loads.sweep(model, motion)
}

/// Inertial part of the bias.
pub(super) fn inertial(model: &mut Model, motion: &Motion, momenta: &[NodeId]) -> Loads {
    let mut loads = Loads::default();
    let graph = &mut model.graph;
    for body in &motion.translations {
        let force: Vec<_> =
            body.acceleration.iter().map(|&acceleration| graph.mul(body.mass, acceleration)).collect();
        loads.on(body, &force);
    }
    for body in &motion.rotations {
        let momentum = times(graph, &body.inertia, &body.rate);
        let change = times(graph, &body.inertia, &body.acceleration);
        let gyroscopic = cross(graph, &body.rate, &momentum);
        for k in 0..3 {
            let torque = graph.add(change[k], gyroscopic[k]);
            loads.through_v.push((body.rate[k], torque));
        }
    }
    // Energies that are given as functions contribute d/dt ∂L/∂v at a = 0, less ∂L/∂q.
    let functions: Vec<NodeId> =
        model.kinetic.iter().chain(&model.lagrangian).map(|term| term.value).collect();
    if functions.is_empty() {
        return loads;
    }
    let (one, minus_one) = (graph.one(), graph.constant(Number::MINUS_ONE));
    let of_functions = if motion.translations.is_empty() && motion.rotations.is_empty() {
        momenta.to_vec()
    } else {
        let seeds: Vec<_> = functions.iter().map(|&value| (value, one)).collect();
        pullback(graph, &seeds, &motion.v)
    };
    let changes = pushforward(graph, &of_functions, &motion.direction);
    loads.direct.extend(changes.into_iter().enumerate());
    for (coordinate, torque) in carried(graph, motion, &of_functions) {
        loads.direct.push((coordinate, graph.neg(torque)));
    }
    loads.through_q.extend(functions.into_iter().map(|value| (value, minus_one)));
    loads
}

/// ∂L/∂q + Q − ∂D/∂v, the right-hand side of d/dt p = f.
///
/// Unlike the bias this is not d'Alembert's form: nothing is differentiated by time.
pub(super) fn momentum_rates(model: &mut Model, motion: &Motion, momenta: &[NodeId]) -> Vec<NodeId> {
    let mut loads = forces::loads(model, motion);
    let graph = &mut model.graph;
    loads.direct.extend(carried(graph, motion, momenta));
    for body in &motion.translations {
        for &velocity in &body.velocity {
            loads.through_q.push((velocity, graph.mul(body.mass, velocity)));
        }
    }
    for body in &motion.rotations {
        let momentum = times(graph, &body.inertia, &body.rate);
        loads.through_q.extend(body.rate.iter().copied().zip(momentum));
    }
    let (one, minus_one) = (graph.one(), graph.constant(Number::MINUS_ONE));
    for term in model.kinetic.iter().chain(&model.lagrangian) {
        loads.through_q.push((term.value, one));
    }
    for term in &model.potential {
        loads.through_q.push((term.value, minus_one));
    }
    loads.sweep(model, motion)
}

/// p × ω: the rate of an orientation's angular momentum that comes from the turning of its axes.
fn carried(graph: &mut Graph, motion: &Motion, momenta: &[NodeId]) -> Vec<(usize, NodeId)> {
    let mut carried = Vec::with_capacity(3 * motion.turning.len());
    for &first in &motion.turning {
        let three = |all: &[NodeId]| [all[first], all[first + 1], all[first + 2]];
        let torque = cross(graph, &three(momenta), &three(&motion.v));
        carried.extend((first..).zip(torque));
    }
    carried
}

/// Conservative part of the bias: ∂V/∂q.
pub(super) fn conservative(model: &mut Model) -> Loads {
    let one = model.graph.one();
    Loads { through_q: model.potential.iter().map(|term| (term.value, one)).collect(), ..Loads::default() }
}

/// The opposite of every entry.
pub(super) fn negated(model: &mut Model, entries: &[NodeId]) -> Vec<NodeId> {
    entries.iter().map(|&entry| model.graph.neg(entry)).collect()
}
