//! Rigid bodies that hang on each other, as the screws of the coordinates.
//!
//! A coordinate whose velocity gives the same twist to all bodies that it moves carries them, and whatever
//! depends on other coordinates is carried along. Where that holds of all coordinates, and what any two of
//! them move is nested or apart, the derivatives of inverse dynamics follow from sums over bodies (runtime,
//! `system/screws.rs`). That is so for every tree of hinges, slides, angles and poses; nothing here knows
//! of them. Which bodies a coordinate moves, and how, is read from velocities at points without any
//! structure.

mod moved;
mod operations;
mod weight;

use super::equations::{Loads, negated};
use super::forces;
use super::motion::{Axes, Motion};
use crate::calculus::pushforward;
use crate::expr::{Graph, NodeId, Variable};
use crate::kinematics::{cross, times, turning_direction};
use crate::model::Model;
use crate::number::Number;
pub use moved::Group;
use moved::{Moved, Part, Slope, groups, parts, vanish};

type Vector = [NodeId; 3];

/// Inertia forces and weights of bodies.
#[derive(Clone, Debug)]
pub struct Screws {
    /// What hangs on a group follows it.
    pub groups: Vec<Group>,
    /// For each group the point that its screws and inertia are about, from that of the first group. About a
    /// common point, small bodies far from it would drown in m d².
    pub points: Vec<Vector>,
    /// The screw of each coordinate about the point of its group: angular part, linear part.
    pub screws: Vec<[NodeId; 6]>,
    /// Their first and second rates along a motion without accelerations, where they are given.
    pub rates: Vec<[[NodeId; 6]; 2]>,
    /// The derivatives of the screws by the coordinates of the group, for groups whose rates are given.
    pub changes: Vec<[NodeId; 6]>,
    /// Mass, first moment, and moments of inertia xx, xy, xz, yy, yz, zz of what a group alone moves.
    pub inertias: Vec<[NodeId; 10]>,
    /// The acceleration of free fall.
    pub gravity: Vector,
    /// What r is made of beside these forces.
    pub rest: Vec<NodeId>,
}

impl Screws {
    /// `None` where the bodies do not hang on each other like this, where there are constraints, or where
    /// inertia is given as an energy.
    pub fn of(model: &mut Model) -> Option<Screws> {
        let others = [&model.kinetic, &model.lagrangian];
        if others.iter().any(|terms| !terms.is_empty()) || !model.constraints.is_empty() {
            return None;
        }
        let parts = parts(model)?;
        let count = model.coordinates.len();
        let moved = Moved::of(&model.graph, &parts, count)?;
        let groups = groups(&moved.sets)?;
        let graph = &mut model.graph;
        // Velocities stay: the runtime adds what accelerations change.
        let direction = turning_direction(graph, count, &[]);
        let deriving = Deriving { parts, sets: moved.sets, direction };
        let mut screws = deriving.screws(graph, groups);
        let (gravity, falling) = weight::gravity(model, &deriving.parts);
        screws.gravity = gravity;
        screws.rest = rest(model, &falling);
        Some(screws)
    }

    /// The nodes that a state is turned into, in the order of the fields.
    pub fn nodes(&self) -> Vec<NodeId> {
        let rates = self.rates.as_flattened().as_flattened();
        let flat = self.points.as_flattened().iter().chain(self.screws.as_flattened());
        let flat = flat.chain(rates).chain(self.changes.as_flattened());
        flat.chain(self.inertias.as_flattened()).chain(&self.gravity).copied().collect()
    }
}

/// What screws are made from.
struct Deriving {
    parts: Vec<Part>,
    sets: Vec<Vec<bool>>,
    /// Of total time derivatives at velocities that stay.
    direction: Vec<(NodeId, NodeId)>,
}

impl Deriving {
    fn screws(&self, graph: &mut Graph, mut groups: Vec<Group>) -> Screws {
        let own: Vec<Vec<usize>> = (0..groups.len()).map(|group| self.own(&groups, group)).collect();
        let zero = graph.zero();
        let mut screws = vec![[zero; 6]; self.sets.len()];
        let (mut points, mut inertias) = (Vec::new(), Vec::new());
        let (mut rates, mut changes) = (Vec::new(), Vec::new());
        let origin = self.parts[self.follows(&groups[0], &own[0])].base;
        for (group, own) in groups.iter_mut().zip(&own) {
            let part = &self.parts[self.follows(group, own)];
            points.push(plus(graph, &part.base, &[(origin, -1)]));
            let slopes: Vec<Slope> = group.coordinates.iter().map(|&j| part.slope(graph, j)).collect();
            for (&j, slope) in group.coordinates.iter().zip(&slopes) {
                screws[j] = joined(slope.angular, slope.linear);
            }
            let of_group = changes_of(graph, group, part, &slopes);
            if group.coordinates.len() > 1 || !vanish(graph, &of_group) {
                group.given = Some(rates.len());
                rates.extend(slopes.iter().map(|slope| self.rates(graph, part, slope)));
                changes.extend(of_group);
            }
            let parts = own.iter().map(|&part| &self.parts[part]);
            inertias.push(inertia(graph, parts, &part.base));
        }
        let gravity = [zero; 3];
        Screws { groups, points, screws, rates, changes, inertias, gravity, rest: Vec::new() }
    }

    fn holds(&self, group: &Group, part: usize) -> bool {
        group.coordinates.iter().all(|&coordinate| self.sets[coordinate][part])
    }

    /// The parts that a group moves and no other group on it.
    fn own(&self, groups: &[Group], group: usize) -> Vec<usize> {
        let children = || groups.iter().filter(|child| child.parent == Some(group));
        let is_own = |&part: &usize| {
            self.holds(&groups[group], part) && !children().any(|child| self.holds(child, part))
        };
        (0..self.parts.len()).filter(is_own).collect()
    }

    /// A part by which the screws of a group are read: the nearest.
    fn follows(&self, group: &Group, own: &[usize]) -> usize {
        let any = || (0..self.parts.len()).find(|&part| self.holds(group, part));
        own.first().copied().or_else(any).unwrap_or_default()
    }

    /// Ṡ and S̈ about a point at rest, which the base of the part passes. The rates of angular parts are
    /// taken in the axes of the part and turned: there, what they are made of is simpler.
    fn rates(&self, graph: &mut Graph, part: &Part, slope: &Slope) -> [[NodeId; 6]; 2] {
        let Slope { turning, angular, linear } = slope;
        let dw = self.rate(graph, turning);
        let ddw = self.rate(graph, &dw);
        let spins = self.rate(graph, &part.rate);
        let carried = cross(graph, &part.rate, turning);
        let first = plus(graph, &dw, &[(carried, 1)]);
        let swung = plus(graph, &carried, &[(dw, 2)]);
        let swung = cross(graph, &part.rate, &swung);
        let across = cross(graph, &spins, turning);
        let second = plus(graph, &ddw, &[(swung, 1), (across, 1)]);
        let [dw, ddw] = [first, second].map(|vector| part.in_space(graph, &vector));

        let velocity = part.in_space(graph, &part.base_velocity);
        let acceleration = self.rate(graph, &velocity);
        let du = self.rate(graph, linear);
        let ddu = self.rate(graph, &du);
        let passed = cross(graph, angular, &velocity);
        let twice = cross(graph, &dw, &velocity);
        let quickened = cross(graph, angular, &acceleration);
        let first = plus(graph, &du, &[(passed, -1)]);
        let second = plus(graph, &ddu, &[(twice, -2), (quickened, -1)]);
        [joined(dw, first), joined(ddw, second)]
    }

    fn rate(&self, graph: &mut Graph, vector: &Vector) -> Vector {
        let rates = pushforward(graph, vector, &self.direction);
        [rates[0], rates[1], rates[2]]
    }
}

/// ∂S/∂q of a group, rows S, about a point at rest.
fn changes_of(graph: &mut Graph, group: &Group, part: &Part, slopes: &[Slope]) -> Vec<[NodeId; 6]> {
    let one = graph.one();
    let mut changes = Vec::with_capacity(slopes.len() * slopes.len());
    for Slope { turning, angular, linear } in slopes {
        for (&j, by) in group.coordinates.iter().zip(slopes) {
            let coordinate = graph.variable(Variable::Coordinate(j as u32));
            let [dw, du] = [turning, linear].map(|vector| {
                let slopes = pushforward(graph, vector, &[(coordinate, one)]);
                [slopes[0], slopes[1], slopes[2]]
            });
            let carried = cross(graph, &by.turning, turning);
            let dw = plus(graph, &dw, &[(carried, 1)]);
            let passed = cross(graph, angular, &by.linear);
            changes.push(joined(part.in_space(graph, &dw), plus(graph, &du, &[(passed, -1)])));
        }
    }
    changes
}

/// Mass, first moment and moments of inertia of some parts together, about a point.
fn inertia<'a>(graph: &mut Graph, parts: impl Iterator<Item = &'a Part>, point: &Vector) -> [NodeId; 10] {
    let mut sums: [Vec<(NodeId, Number)>; 10] = Default::default();
    for part in parts {
        let Part { mass, arm, base, .. } = part;
        let from = plus(graph, base, &[(*point, -1)]);
        let lean = arm.map(|component| graph.mul(*mass, component));
        let moment = part.in_space(graph, &lean);
        // About the base and in the axes of the part first, in which a rigid part does not change.
        let zero = [[graph.zero(); 3]; 3];
        let own = about(graph, part.inertia.unwrap_or(zero), &[(lean, *arm)]);
        // R J Rᵀ, since J is symmetric.
        let half = [0, 1, 2].map(|row| times(graph, &own, &part.rotation.matrix[row]));
        let turned = [0, 1, 2].map(|row| times(graph, &half, &part.rotation.matrix[row]));
        let carried = from.map(|component| graph.mul(*mass, component));
        let both = plus(graph, &carried, &[(moment, 1)]);
        let shifted = about(graph, turned, &[(moment, from), (from, both)]);
        sums[0].push((*mass, Number::ONE));
        for (sum, moment) in sums[1..4].iter_mut().zip(both) {
            sum.push((moment, Number::ONE));
        }
        for (sum, (i, j)) in sums[4..].iter_mut().zip([(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]) {
            sum.push((shifted[i][j], Number::ONE));
        }
    }
    sums.map(|sum| graph.sum(Number::ZERO, &sum))
}

/// A moment of inertia J with (a·b) 1 − a bᵀ for some vectors, of which the upper triangle counts.
fn about(graph: &mut Graph, mut inertia: [Vector; 3], pairs: &[(Vector, Vector)]) -> [Vector; 3] {
    for (a, b) in pairs {
        for i in 0..3 {
            for j in 0..3 {
                let mut terms = vec![(inertia[i][j], Number::ONE)];
                if i == j {
                    for k in [0, 1, 2].into_iter().filter(|&k| k != i) {
                        terms.push((graph.mul(a[k], b[k]), Number::ONE));
                    }
                } else {
                    terms.push((graph.mul(a[i.min(j)], b[i.max(j)]), Number::MINUS_ONE));
                }
                inertia[i][j] = graph.sum(Number::ZERO, &terms);
            }
        }
    }
    inertia
}

/// Forces beside inertia forces and the weight.
fn rest(model: &mut Model, falling: &[usize]) -> Vec<NodeId> {
    let motion = Motion::of(model, Axes::Own);
    let one = model.graph.one();
    let potentials = model.potential.iter().enumerate().filter(|(term, _)| !falling.contains(term));
    let conservative =
        Loads { through_q: potentials.map(|(_, term)| (term.value, one)).collect(), ..Loads::default() };
    let applied = forces::loads(model, &motion).negated(model);
    let total = conservative.joined(applied).sweep(model, &motion);
    negated(model, &total)
}

fn joined([a, b, c]: Vector, [d, e, f]: Vector) -> [NodeId; 6] {
    [a, b, c, d, e, f]
}

/// A vector with multiples of others.
fn plus(graph: &mut Graph, vector: &Vector, others: &[(Vector, i128)]) -> Vector {
    [0, 1, 2].map(|i| {
        let mut terms = vec![(vector[i], Number::ONE)];
        terms.extend(others.iter().map(|(other, factor)| (other[i], Number::integer(*factor))));
        graph.sum(Number::ZERO, &terms)
    })
}
