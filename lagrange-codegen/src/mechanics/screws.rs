//! Rigid bodies that hang on each other, as the screws of the coordinates.
//!
//! A coordinate whose velocity gives the same twist to all bodies that it moves carries them, and whatever depends on other
//! coordinates is carried along. Where that holds of all coordinates, and what any two of them move is nested or apart, the
//! derivatives of inverse dynamics follow from sums over bodies (runtime, `system/screws.rs`). That is so for
//! every tree of hinges, slides, angles and poses; nothing here knows of them. Which bodies a coordinate moves, and how, is
//! read from velocities at points without any structure.

use super::equations::{Loads, negated};
use super::forces;
use super::frames::Frames;
use super::motion::{Axes, Motion};
use crate::calculus::pushforward;
use crate::expr::{Dependence, Graph, NodeId, Variable};
use crate::kinematics::{cross, slopes_to, times, turning_direction};
use crate::model::{Attitude, Model, Rotation};
use crate::number::Number;

type Vector = [NodeId; 3];

/// Coordinates that move the same bodies.
#[derive(Clone, Debug)]
pub struct Group {
    /// The group that moves these bodies and more, which stands before this one.
    pub parent: Option<usize>,
    /// The coordinates.
    pub coordinates: Vec<usize>,
    /// Where the rates of their screws stand, unless what moves them is all that changes them.
    pub given: Option<usize>,
}

/// Inertia forces and weights of bodies.
#[derive(Clone, Debug)]
pub struct Screws {
    /// What hangs on a group follows it.
    pub groups: Vec<Group>,
    /// The screw of each coordinate about the place of a body: angular part, linear part.
    pub screws: Vec<[NodeId; 6]>,
    /// Their first and second rates along the motion, where they are given.
    pub rates: Vec<[[NodeId; 6]; 2]>,
    /// Their derivatives by the coordinates of the group, where rates are given.
    pub changes: Vec<[NodeId; 6]>,
    /// Mass, first moment, and moments of inertia xx, xy, xz, yy, yz, zz of what a group alone moves.
    pub inertias: Vec<[NodeId; 10]>,
    /// The acceleration of free fall.
    pub gravity: Vector,
    /// What r is made of beside these forces.
    pub rest: Vec<NodeId>,
}

/// A body or a particle.
struct Part {
    mass: NodeId,
    place: Vector,
    rotation: Rotation,
    inertia: Option<[Vector; 3]>,
    /// ω and ṗ in the axes of the rotation.
    rate: Vector,
    velocity: Vector,
}

/// Points of the space of coordinates and parameters, at which motions are compared.
const POINTS: u32 = 2;
/// What differs by more at such a point, where numbers are of size one, differs by more than roundings.
const APART: f64 = 1e-9;

impl Screws {
    /// `None` where the bodies do not hang on each other like this.
    pub fn of(model: &mut Model) -> Option<Screws> {
        let others = [&model.kinetic, &model.lagrangian];
        if others.iter().any(|terms| !terms.is_empty()) || !model.constraints.is_empty() {
            return None;
        }
        let parts = parts(model)?;
        let count = model.coordinates.len();
        let moved = Moved::of(&model.graph, &parts, count)?;
        let groups = groups(&moved.sets)?;
        let mut deriving = Deriving { parts, sets: moved.sets, direction: Vec::new() };
        let graph = &mut model.graph;
        deriving.direction = turning_direction(graph, count, &[]);
        for i in 0..count as u32 {
            let velocity = graph.variable(Variable::Velocity(i));
            deriving.direction.push((velocity, graph.variable(Variable::Acceleration(i))));
        }
        let mut screws = deriving.screws(graph, groups);
        let (gravity, falling) = deriving.gravity(model);
        screws.gravity = gravity;
        screws.rest = rest(model, &falling);
        Some(screws)
    }

    /// The nodes that a state is turned into, in the order of the fields.
    pub fn nodes(&self) -> Vec<NodeId> {
        let rates = self.rates.as_flattened().as_flattened();
        let flat = self.screws.as_flattened().iter().chain(rates).chain(self.changes.as_flattened());
        flat.chain(self.inertias.as_flattened()).chain(&self.gravity).copied().collect()
    }
}

/// Everything that has mass, with its motion; `None` where a motion is no rigid one, or is given by time.
fn parts(model: &mut Model) -> Option<Vec<Part>> {
    let count = model.coordinates.len();
    let Model { graph, levers, points, bodies, .. } = model;
    let direction = turning_direction(graph, count, &[]);
    let mut frames = Frames::new(levers, &direction);
    let mut parts = Vec::with_capacity(bodies.len() + points.len());
    let mut all = Vec::with_capacity(bodies.len() + points.len());
    for point in points {
        let rotation = levers.carrying(&point.position)?.rotation.clone();
        all.push((point.mass, point.position.as_slice(), rotation, None));
    }
    for body in bodies {
        let Attitude::Spatial { rotation, inertia } = &body.attitude else { return None };
        all.push((body.mass, body.position.as_slice(), rotation.clone(), Some(*inertia)));
    }
    for (mass, position, rotation, inertia) in all {
        let place: Vector = position.try_into().ok()?;
        let rate = frames.spin(graph, &rotation).rate;
        let velocity = frames.motion(graph, &rotation, &place).velocity;
        let is_fixed = |&node: &NodeId| graph.dependence(node).is_fixed();
        if !is_fixed(&mass) || !inertia.iter().flatten().flatten().all(is_fixed) {
            return None;
        }
        let moving = rotation.matrix.as_flattened().iter().chain(&place).chain(&rate).chain(&velocity);
        let given = Dependence::TIME.union(Dependence::INPUTS);
        if moving.into_iter().any(|&node| graph.dependence(node).meets(given)) {
            return None;
        }
        parts.push(Part { mass, place, rotation, inertia, rate, velocity });
    }
    (!parts.is_empty()).then_some(parts)
}

/// A number of size one, the same in every expansion.
fn number(point: u32, variable: Variable) -> f64 {
    let (kind, index) = match variable {
        Variable::Coordinate(i) => (1, i),
        Variable::Parameter(i) => (2, i),
        _ => (3, 0),
    };
    let mixed = (u64::from(point) << 48 | kind << 32 | u64::from(index)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ mixed >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    0.5 + ((mixed ^ mixed >> 32) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Which parts each coordinate moves.
struct Moved {
    sets: Vec<Vec<bool>>,
}

impl Moved {
    /// `None` where a coordinate moves parts in different ways, or none.
    fn of(graph: &Graph, parts: &[Part], count: usize) -> Option<Moved> {
        let mut roots: Vec<NodeId> = Vec::new();
        for part in parts {
            roots.extend(part.rotation.matrix.as_flattened());
            roots.extend(part.place.iter().chain(&part.rate).chain(&part.velocity));
        }
        let mut sets = vec![vec![false; parts.len()]; count];
        for point in 0..POINTS {
            for (j, set) in sets.iter_mut().enumerate() {
                let values = graph.evaluate(&roots, |variable| match variable {
                    Variable::Velocity(i) => f64::from(u8::from(i as usize == j)),
                    other => number(point, other),
                });
                let mut common: Option<[f64; 6]> = None;
                for (values, moves) in values.as_chunks::<18>().0.iter().zip(set) {
                    let screw = screw(values);
                    if !screw.iter().all(|part| part.is_finite()) {
                        return None;
                    }
                    if screw.iter().all(|part| part.abs() < APART) {
                        continue;
                    }
                    *moves = true;
                    let common = common.get_or_insert(screw);
                    if common.iter().zip(&screw).any(|(a, b)| (a - b).abs() > APART * (1.0 + a.abs())) {
                        return None;
                    }
                }
            }
        }
        sets.iter().all(|set| set.contains(&true)).then_some(Moved { sets })
    }
}

/// The twist about the origin from R, p, and ω and ṗ in the axes of R.
fn screw(values: &[f64; 18]) -> [f64; 6] {
    let turned = |v: &[f64]| [0, 1, 2].map(|i| (0..3).map(|k| values[3 * i + k] * v[k]).sum::<f64>());
    let (p, w, u) = (&values[9..12], turned(&values[12..15]), turned(&values[15..18]));
    let linear = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| w[i] * p[j] - w[j] * p[i]);
    [w[0], w[1], w[2], u[0] - linear[0], u[1] - linear[1], u[2] - linear[2]]
}

/// Coordinates with the same parts, each group before what it holds and that before what it does not hold; `None` where two
/// groups overlap.
fn groups(sets: &[Vec<bool>]) -> Option<Vec<Group>> {
    let mut found: Vec<(&Vec<bool>, Vec<usize>)> = Vec::new();
    for (coordinate, set) in sets.iter().enumerate() {
        match found.iter_mut().find(|(other, _)| *other == set) {
            Some((_, coordinates)) => coordinates.push(coordinate),
            None => found.push((set, vec![coordinate])),
        }
    }
    let size = |set: &[bool]| set.iter().filter(|&&moves| moves).count();
    let meet = |a: &[bool], b: &[bool]| a.iter().zip(b).filter(|&(a, b)| *a && *b).count();
    for (place, (a, _)) in found.iter().enumerate() {
        for (b, _) in &found[..place] {
            let common = meet(a, b);
            if common != 0 && common != size(a) && common != size(b) {
                return None;
            }
        }
    }
    // Of nested sets the larger one comes first, and all that it holds before any other.
    let holder = |place: usize| {
        let (set, _) = found[place];
        let larger = (0..found.len()).filter(|&other| {
            let other = found[other].0;
            size(other) > size(set) && meet(other, set) > 0
        });
        larger.min_by_key(|&other| size(found[other].0))
    };
    let holders: Vec<Option<usize>> = (0..found.len()).map(holder).collect();
    let mut ordered = Vec::with_capacity(found.len());
    let mut places = vec![0; found.len()];
    let mut waiting: Vec<usize> = (0..found.len()).rev().filter(|&place| holders[place].is_none()).collect();
    while let Some(place) = waiting.pop() {
        places[place] = ordered.len();
        let parent = holders[place].map(|holder| places[holder]);
        ordered.push(Group { parent, coordinates: found[place].1.clone(), given: None });
        waiting.extend((0..found.len()).rev().filter(|&other| holders[other] == Some(place)));
    }
    Some(ordered)
}

/// What screws are made from.
struct Deriving {
    parts: Vec<Part>,
    sets: Vec<Vec<bool>>,
    /// Of total time derivatives.
    direction: Vec<(NodeId, NodeId)>,
}

/// A part in space axes.
struct Placed {
    /// From the point that moments are about.
    from: Vector,
    velocity: Vector,
}

impl Deriving {
    fn screws(&self, graph: &mut Graph, mut groups: Vec<Group>) -> Screws {
        let own: Vec<Vec<usize>> = (0..groups.len()).map(|group| self.own(&groups, group)).collect();
        let zero = graph.zero();
        let mut screws = vec![[zero; 6]; self.sets.len()];
        let (mut rates, mut changes, mut inertias) = (Vec::new(), Vec::new(), Vec::new());
        let origin = self.parts[self.follows(&groups[0], &own[0])].place;
        for (group, own) in groups.iter_mut().zip(&own) {
            let part = &self.parts[self.follows(group, own)];
            let placed = Placed {
                from: difference(graph, &part.place, &origin),
                velocity: times(graph, &part.rotation.matrix, &part.velocity),
            };
            let slopes: Vec<[Vector; 2]> = group.coordinates.iter().map(|&j| part.slopes(graph, j)).collect();
            for (&j, [angular, linear]) in group.coordinates.iter().zip(&slopes) {
                let carried = cross(graph, angular, &placed.from);
                screws[j] = joined(*angular, difference(graph, linear, &carried));
            }
            let of_group = changes_of(graph, group, &slopes, &placed);
            if group.coordinates.len() > 1 || !vanish(graph, &of_group) {
                group.given = Some(rates.len());
                rates.extend(slopes.iter().map(|slopes| self.rates(graph, slopes, &placed)));
                changes.extend(of_group);
            }
            let parts = own.iter().map(|&part| &self.parts[part]);
            inertias.push(inertia(graph, parts, &origin));
        }
        let gravity = [zero; 3];
        Screws { groups, screws, rates, changes, inertias, gravity, rest: Vec::new() }
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

    /// Ṡ and S̈ about a point at rest.
    fn rates(&self, graph: &mut Graph, [w, u]: &[Vector; 2], placed: &Placed) -> [[NodeId; 6]; 2] {
        let [dw, du] = [w, u].map(|vector| self.rate(graph, vector));
        let [ddw, ddu] = [&dw, &du].map(|vector| self.rate(graph, vector));
        let acceleration = self.rate(graph, &placed.velocity);
        let two = Number::integer(2);
        let first = [
            (cross(graph, &dw, &placed.from), Number::ONE),
            (cross(graph, w, &placed.velocity), Number::ONE),
        ];
        let second = [
            (cross(graph, &ddw, &placed.from), Number::ONE),
            (cross(graph, &dw, &placed.velocity), two),
            (cross(graph, w, &acceleration), Number::ONE),
        ];
        [joined(dw, less(graph, &du, &first)), joined(ddw, less(graph, &ddu, &second))]
    }

    fn rate(&self, graph: &mut Graph, vector: &Vector) -> Vector {
        let rates = pushforward(graph, vector, &self.direction);
        [rates[0], rates[1], rates[2]]
    }

    /// The acceleration of free fall that all potentials together, or those that name the place of a part, are the weight of, and
    /// these potentials.
    fn gravity(&self, model: &mut Model) -> (Vector, Vec<usize>) {
        let all: Vec<usize> = (0..model.potential.len()).collect();
        let graph = &mut model.graph;
        let (zero, one) = (graph.zero(), graph.one());
        let q: Vec<NodeId> =
            (0..self.sets.len() as u32).map(|i| graph.variable(Variable::Coordinate(i))).collect();
        let places: Vec<NodeId> = self.parts.iter().flat_map(|part| part.place).collect();
        let mut named = Vec::new();
        let mut fall = None;
        for &term in &all {
            let seeds = [(model.potential[term].value, one)];
            let (forces, _) = slopes_to(graph, &seeds, &places, &q, &[]);
            for (part, force) in self.parts.iter().zip(forces.as_chunks::<3>().0) {
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
                && self.is_weight(graph, &q, &fall, terms.iter().map(|&term| model.potential[term].value))
            {
                return (fall, terms);
            }
        }
        ([zero; 3], Vec::new())
    }

    /// Whether some potentials do the work of the weight.
    fn is_weight(
        &self,
        graph: &mut Graph,
        q: &[NodeId],
        fall: &Vector,
        potentials: impl Iterator<Item = NodeId>,
    ) -> bool {
        let one = graph.one();
        let seeds: Vec<(NodeId, NodeId)> = potentials.map(|value| (value, one)).collect();
        let (_, slopes) = slopes_to(graph, &seeds, &[], q, &[]);
        let mut roots: Vec<NodeId> = fall.iter().chain(&slopes).copied().collect();
        for part in &self.parts {
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
                        let along: f64 = (0..3).map(|k| matrix[3 * i + k] * velocity[k]).sum();
                        power += mass * fall * along;
                        size += (mass * fall * along).abs();
                    }
                }
                // False for what is not a number.
                power.abs() <= APART * (1.0 + size)
            })
        })
    }
}

impl Part {
    /// ∂ω/∂v and ∂ṗ/∂v by one velocity, in space axes.
    fn slopes(&self, graph: &mut Graph, coordinate: usize) -> [Vector; 2] {
        let velocity = graph.variable(Variable::Velocity(coordinate as u32));
        let one = graph.one();
        [&self.rate, &self.velocity].map(|vector| {
            let slopes = pushforward(graph, vector, &[(velocity, one)]);
            times(graph, &self.rotation.matrix, &[slopes[0], slopes[1], slopes[2]])
        })
    }
}

/// ∂S/∂q of a group, rows S, about a point at rest.
fn changes_of(graph: &mut Graph, group: &Group, slopes: &[[Vector; 2]], placed: &Placed) -> Vec<[NodeId; 6]> {
    let one = graph.one();
    let mut changes = Vec::with_capacity(slopes.len() * slopes.len());
    for [w, u] in slopes {
        for (&j, [_, moves]) in group.coordinates.iter().zip(slopes) {
            let coordinate = graph.variable(Variable::Coordinate(j as u32));
            let [dw, du] = [w, u].map(|vector| {
                let slopes = pushforward(graph, vector, &[(coordinate, one)]);
                [slopes[0], slopes[1], slopes[2]]
            });
            let across =
                [(cross(graph, &dw, &placed.from), Number::ONE), (cross(graph, w, moves), Number::ONE)];
            changes.push(joined(dw, less(graph, &du, &across)));
        }
    }
    changes
}

/// Whether nodes are zero at points without structure.
fn vanish(graph: &Graph, nodes: &[[NodeId; 6]]) -> bool {
    (0..POINTS).all(|point| {
        let values = graph.evaluate(nodes.as_flattened(), |variable| number(point, variable));
        values.iter().all(|value| value.abs() < APART)
    })
}

/// Mass, first moment and moments of inertia of some parts together.
fn inertia<'a>(graph: &mut Graph, parts: impl Iterator<Item = &'a Part>, origin: &Vector) -> [NodeId; 10] {
    let mut sums: [Vec<(NodeId, Number)>; 10] = Default::default();
    for part in parts {
        let from = difference(graph, &part.place, origin);
        let moment = from.map(|component| graph.mul(part.mass, component));
        let turned = part.inertia.map(|inertia| {
            let matrix = &part.rotation.matrix;
            // R I Rᵀ, since I is symmetric.
            let half = [0, 1, 2].map(|row| times(graph, &inertia, &matrix[row]));
            [0, 1, 2].map(|row| times(graph, &half, &matrix[row]))
        });
        sums[0].push((part.mass, Number::ONE));
        for (sum, moment) in sums[1..4].iter_mut().zip(moment) {
            sum.push((moment, Number::ONE));
        }
        for (sum, (i, j)) in sums[4..].iter_mut().zip([(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]) {
            sum.extend(turned.map(|turned| (turned[i][j], Number::ONE)));
            if i == j {
                for k in [0, 1, 2].into_iter().filter(|&k| k != i) {
                    sum.push((graph.mul(moment[k], from[k]), Number::ONE));
                }
            } else {
                sum.push((graph.mul(moment[i], from[j]), Number::MINUS_ONE));
            }
        }
    }
    sums.map(|sum| graph.sum(Number::ZERO, &sum))
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

fn difference(graph: &mut Graph, a: &Vector, b: &Vector) -> Vector {
    less(graph, a, &[(*b, Number::ONE)])
}

/// A vector less multiples of others.
fn less(graph: &mut Graph, vector: &Vector, others: &[(Vector, Number)]) -> Vector {
    [0, 1, 2].map(|i| {
        let mut terms = vec![(vector[i], Number::ONE)];
        terms.extend(others.iter().map(|(other, factor)| (other[i], -*factor)));
        graph.sum(Number::ZERO, &terms)
    })
}
