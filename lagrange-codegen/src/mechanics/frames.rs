//! Motions in the axes of the rotations that carry them, at a = 0.
//!
//! A body of a chain of rotations turns with ω(LR) = Rᵀ ω(L) + ω(R), in its own axes, and a place p = base +
//! R arm moves with ṗ = v(base) + ω × arm. Written like this, velocities and accelerations cost in proportion
//! to the links, and each is linear in those of the link before. In space axes, where R is a product of
//! matrices, every link differentiates nine entries twice (Featherstone, *Rigid Body Dynamics Algorithms*,
//! chapter 5; Luh, Walker and Paul, 1980).

use crate::calculus::pushforward;
use crate::collections::Lookup;
use crate::expr::{Exponent, Graph, NodeId};
use crate::kinematics::{body_rate, cross, times, transposed_times};
use crate::model::{Levers, Rotation, RotationForm};
use crate::number::Number;

type Vector = [NodeId; 3];
type Entries = [Vector; 3];

/// The motion of a rotation in its own axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spin {
    /// ω.
    pub rate: Vector,
    /// ω̇.
    pub change: Vector,
    /// ω̇ × a + ω × (ω × a) as a matrix: the acceleration of an arm a that the rotation carries.
    swing: Entries,
}

/// The motion of a place in the axes of a rotation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Move {
    /// The components of ṗ.
    pub velocity: Vector,
    /// The components of p̈.
    pub acceleration: Vector,
}

/// The known motions.
pub(super) struct Frames<'a> {
    levers: &'a Levers,
    direction: &'a [(NodeId, NodeId)],
    spins: Lookup<Entries, Spin>,
    moves: Lookup<(Entries, Vector), Move>,
}

impl<'a> Frames<'a> {
    /// The frames of places carried by levers, with the direction of total time derivatives.
    pub fn new(levers: &'a Levers, direction: &'a [(NodeId, NodeId)]) -> Self {
        Frames { levers, direction, spins: Lookup::default(), moves: Lookup::default() }
    }

    /// The motion of a rotation.
    pub fn spin(&mut self, graph: &mut Graph, rotation: &Rotation) -> Spin {
        if let Some(&known) = self.spins.get(&rotation.matrix) {
            return known;
        }
        let rate = body_rate(graph, rotation, self.direction);
        let change = match &rotation.form {
            RotationForm::Product(left, right) => {
                let (of_left, of_right) = (self.spin(graph, left), self.spin(graph, right));
                let turned = transposed_times(graph, &right.matrix, &of_left.rate);
                let change = transposed_times(graph, &right.matrix, &of_left.change);
                let across = cross(graph, &turned, &of_right.rate);
                [0, 1, 2].map(|i| total(graph, &[change[i], across[i], of_right.change[i]]))
            }
            _ => self.rates(graph, &rate),
        };
        let spin = Spin { rate, change, swing: swing(graph, &rate, &change) };
        self.spins.insert(rotation.matrix, spin);
        spin
    }

    /// The motion of a place in the axes of a rotation.
    pub fn motion(&mut self, graph: &mut Graph, rotation: &Rotation, place: &Vector) -> Move {
        let key = (rotation.matrix, *place);
        if let Some(&known) = self.moves.get(&key) {
            return known;
        }
        let lever = self.levers.of(place);
        let motion = match (lever, &rotation.form) {
            (Some(lever), _) if lever.rotation.matrix == rotation.matrix => {
                let base = self.motion(graph, rotation, &lever.base);
                self.carried(graph, rotation, base, &lever.arm)
            }
            (_, RotationForm::Product(left, right)) => {
                let of_left = self.motion(graph, left, place);
                of_left.map(|vector| transposed_times(graph, &right.matrix, &vector))
            }
            // Another rotation carries the place: its motion is turned to space axes, and from these.
            (Some(lever), _) => {
                let own = self.motion(graph, &lever.rotation, place);
                let in_space = own.map(|vector| times(graph, &lever.rotation.matrix, &vector));
                in_space.map(|vector| transposed_times(graph, &rotation.matrix, &vector))
            }
            (None, _) => {
                let velocity = self.rates(graph, place);
                let acceleration = self.rates(graph, &velocity);
                let in_space = Move { velocity, acceleration };
                in_space.map(|vector| transposed_times(graph, &rotation.matrix, &vector))
            }
        };
        self.moves.insert(key, motion);
        motion
    }

    /// The motion of the end of an arm, from that of its base.
    fn carried(&mut self, graph: &mut Graph, rotation: &Rotation, base: Move, arm: &Vector) -> Move {
        let Spin { rate, swing, .. } = self.spin(graph, rotation);
        let extends = self.rates(graph, arm);
        let quickens = self.rates(graph, &extends);
        let turned = cross_terms(graph, &rate, arm);
        let coriolis = cross_terms(graph, &rate, &extends);
        let swung = swing.map(|row| [0, 1, 2].map(|i| (graph.mul(row[i], arm[i]), Number::ONE)));
        let mut sums = |start: Vector, parts: &[&dyn Fn(usize) -> Vec<(NodeId, Number)>]| {
            [0, 1, 2].map(|i| {
                let mut terms = vec![(start[i], Number::ONE)];
                parts.iter().for_each(|part| terms.extend(part(i)));
                graph.sum(Number::ZERO, &terms)
            })
        };
        let twice = |i: usize| coriolis[i].iter().map(|&(node, c)| (node, c + c)).collect();
        Move {
            velocity: sums(base.velocity, &[&|i| turned[i].to_vec(), &|i| vec![(extends[i], Number::ONE)]]),
            acceleration: sums(
                base.acceleration,
                &[&|i| swung[i].to_vec(), &twice, &|i| vec![(quickens[i], Number::ONE)]],
            ),
        }
    }

    fn rates(&self, graph: &mut Graph, vector: &Vector) -> Vector {
        let rates = pushforward(graph, vector, self.direction);
        [rates[0], rates[1], rates[2]]
    }
}

impl Move {
    fn map(self, mut each: impl FnMut(Vector) -> Vector) -> Move {
        Move { velocity: each(self.velocity), acceleration: each(self.acceleration) }
    }
}

/// [ω̇]ₓ + [ω]ₓ².
fn swing(graph: &mut Graph, rate: &Vector, change: &Vector) -> Entries {
    let square = rate.map(|component| graph.powi(component, 2));
    [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| {
            let third = (6 - i - j) % 3;
            if i == j {
                let others = [(i + 1) % 3, (i + 2) % 3].map(|k| (square[k], Number::MINUS_ONE));
                return graph.sum(Number::ZERO, &others);
            }
            let sign = if (j + 3 - i) % 3 == 1 { Number::MINUS_ONE } else { Number::ONE };
            let product = graph.product(&[(rate[i], Exponent::whole(1)), (rate[j], Exponent::whole(1))]);
            graph.sum(Number::ZERO, &[(product, Number::ONE), (change[third], sign)])
        })
    })
}

/// The summands of a × b.
fn cross_terms(graph: &mut Graph, a: &Vector, b: &Vector) -> [[(NodeId, Number); 2]; 3] {
    [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| [(graph.mul(a[i], b[j]), Number::ONE), (graph.mul(a[j], b[i]), Number::MINUS_ONE)])
}

fn total(graph: &mut Graph, terms: &[NodeId]) -> NodeId {
    let terms: Vec<_> = terms.iter().map(|&term| (term, Number::ONE)).collect();
    graph.sum(Number::ZERO, &terms)
}
