//! Which bodies each coordinate moves: read from velocities at points without any structure.

use crate::calculus::pushforward;
use crate::expr::{Dependence, Graph, NodeId, Variable};
use crate::kinematics::{times, turning_direction};
use crate::mechanics::frames::Frames;
use crate::model::{Attitude, Levers, Model, Rotation};

type Vector = [NodeId; 3];

/// A body or a particle.
pub struct Part {
    pub mass: NodeId,
    pub place: Vector,
    pub rotation: Rotation,
    pub inertia: Option<[Vector; 3]>,
    /// Where the arms of fixed lengths begin by which the rotation carries the place, such as a point on the
    /// axis of a hinge, and their sum from there to the place, in the axes of the rotation.
    pub base: Vector,
    pub arm: Vector,
    /// ω, and the velocities of the place and of the base, in the axes of the rotation.
    pub rate: Vector,
    pub velocity: Vector,
    pub base_velocity: Vector,
}

/// The derivatives of a part's motion by one velocity.
pub struct Slope {
    /// Of ω, in the axes of the rotation and in space axes.
    pub turning: Vector,
    pub angular: Vector,
    /// Of the base's velocity, in space axes.
    pub linear: Vector,
}

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

/// Points of the space of coordinates and parameters, at which motions are compared.
pub const POINTS: u32 = 2;
/// Numbers that differ by more, relative to the size of their terms, differ by more than rounding errors.
pub const ROUNDINGS: f64 = 1024.0 * f64::EPSILON;

/// Everything that has mass, with its motion. `None` without any, or where a body is planar, a particle is
/// carried by no rotation, an inertia varies, or a motion depends on time or inputs.
pub fn parts(model: &mut Model) -> Option<Vec<Part>> {
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
        let (base, arm) = arm(graph, levers, &rotation, place);
        let [velocity, base_velocity] =
            [place, base].map(|place| frames.motion(graph, &rotation, &place).velocity);
        let is_fixed = |&node: &NodeId| graph.dependence(node).is_fixed();
        if !is_fixed(&mass) || !inertia.iter().flatten().flatten().all(is_fixed) {
            return None;
        }
        let moving = rotation.matrix.as_flattened().iter().chain(&place).chain(&rate).chain(&velocity);
        let given = Dependence::TIME.union(Dependence::INPUTS);
        if moving.into_iter().any(|&node| graph.dependence(node).meets(given)) {
            return None;
        }
        parts.push(Part { mass, place, rotation, inertia, base, arm, rate, velocity, base_velocity });
    }
    (!parts.is_empty()).then_some(parts)
}

/// Where the arms of fixed lengths by which a rotation carries a place begin, and their sum.
fn arm(graph: &mut Graph, levers: &Levers, rotation: &Rotation, place: Vector) -> (Vector, Vector) {
    let (mut base, mut arm) = (place, [graph.zero(); 3]);
    while let Some(lever) = levers.of(&base) {
        let is_fixed = lever.arm.iter().all(|&component| graph.dependence(component).is_fixed());
        if lever.rotation.matrix != rotation.matrix || !is_fixed {
            break;
        }
        base = lever.base;
        arm = [0, 1, 2].map(|i| graph.add(arm[i], lever.arm[i]));
    }
    (base, arm)
}

/// A number between 0.5 and 1.5, the same in every expansion.
pub fn number(point: u32, variable: Variable) -> f64 {
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
pub struct Moved {
    pub sets: Vec<Vec<bool>>,
}

impl Moved {
    /// `None` where a coordinate moves parts in different ways, or none.
    pub fn of(graph: &Graph, parts: &[Part], count: usize) -> Option<Moved> {
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
                let mut common: Option<([f64; 6], [f64; 2])> = None;
                for (values, moves) in values.as_chunks::<18>().0.iter().zip(set) {
                    // What does not move is exactly at rest.
                    if values[12..].iter().all(|&component| component == 0.0) {
                        continue;
                    }
                    *moves = true;
                    let (screw, sizes) = screw(values);
                    let (first, of_first) = common.get_or_insert((screw, sizes));
                    let is_same = (0..6).all(|i| {
                        let size = sizes[i / 3] + of_first[i / 3];
                        (first[i] - screw[i]).abs() <= ROUNDINGS * size
                    });
                    // What is not a number counts as different.
                    if !is_same {
                        return None;
                    }
                }
            }
        }
        sets.iter().all(|set| set.contains(&true)).then_some(Moved { sets })
    }
}

/// The twist about the origin from R, p, and ω and ṗ in the axes of R, with the sizes of what its two parts
/// are made of.
fn screw(values: &[f64; 18]) -> ([f64; 6], [f64; 2]) {
    let turned = |v: &[f64]| [0, 1, 2].map(|i| (0..3).map(|k| values[3 * i + k] * v[k]).sum::<f64>());
    let size = |v: &[f64]| v.iter().map(|component| component.abs()).sum::<f64>();
    let (p, w, u) = (&values[9..12], turned(&values[12..15]), turned(&values[15..18]));
    let linear = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| w[i] * p[j] - w[j] * p[i]);
    let screw = [w[0], w[1], w[2], u[0] - linear[0], u[1] - linear[1], u[2] - linear[2]];
    (screw, [size(&w), size(&u) + size(&w) * size(p)])
}

/// Coordinates with the same parts, each group before what it holds and that before what it does not hold;
/// `None` where two groups share parts and neither holds all of the other.
pub fn groups(sets: &[Vec<bool>]) -> Option<Vec<Group>> {
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

/// Whether nodes are zero at points without structure.
pub fn vanish(graph: &Graph, nodes: &[[NodeId; 6]]) -> bool {
    (0..POINTS).all(|point| {
        let variable = |variable| number(point, variable);
        let values = graph.evaluate_on_sides(nodes.as_flattened(), variable, |_| true);
        values.iter().all(|rounded| rounded.value.abs() <= 8.0 * rounded.error)
    })
}

impl Part {
    /// What one velocity does to the part.
    pub fn slope(&self, graph: &mut Graph, coordinate: usize) -> Slope {
        let velocity = graph.variable(Variable::Velocity(coordinate as u32));
        let one = graph.one();
        let [turning, moving] = [&self.rate, &self.base_velocity].map(|vector| {
            let slopes = pushforward(graph, vector, &[(velocity, one)]);
            [slopes[0], slopes[1], slopes[2]]
        });
        Slope { turning, angular: self.in_space(graph, &turning), linear: self.in_space(graph, &moving) }
    }

    /// A vector in the axes of the rotation, in space axes.
    pub fn in_space(&self, graph: &mut Graph, vector: &Vector) -> Vector {
        times(graph, &self.rotation.matrix, vector)
    }
}
