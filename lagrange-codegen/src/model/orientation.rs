//! Orientations by three numbers: modified Rodrigues parameters ρ = 4 tan(θ/4) n of a turn by θ about n.
//!
//! They have no singular position within a full turn; the runtime changes to the other triple of the same
//! orientation at half a turn. The map is conformal: |ω| = |ρ′|/(1 + |ρ|²/16), so that no direction is
//! weighed more than another. Schaub and Junkins, *Analytical Mechanics of Space Systems*, 4th ed., section
//! 3.5 (there σ = ρ/4); ρ is near the rotation vector, and ρ′ near the angular velocity.
//!
//! A description is read as one of rotation matrices R, whose entries are variables of their own, and of
//! angular velocities ω in body axes in the places of the velocities: R′ = R \[ω]ₓ. In these the motion is
//! solved for (`mechanics`, by Euler–Poincaré equations), because there they are simplest; in ρ and ρ′ a
//! system tells everything else.

use crate::expr::{Graph, NodeId, Variable};
use crate::number::Number;

const TWO: Number = Number::Ratio(2, 1);
const QUARTER: Number = Number::Ratio(1, 4);
const SIXTEENTH: Number = Number::Ratio(1, 16);

/// The unit quaternion (w, u) of the parameters, and 1/(1 + |ρ|²/16).
struct Quaternion {
    scalar: NodeId,
    vector: [NodeId; 3],
    reciprocal: NodeId,
}

fn quaternion(graph: &mut Graph, rho: &[NodeId; 3]) -> Quaternion {
    let squares = rho.map(|component| (graph.mul(component, component), SIXTEENTH));
    let sum = graph.sum(Number::ONE, &squares);
    let reciprocal = graph.powi(sum, -1);
    let scalar = graph.sum(Number::MINUS_ONE, &[(reciprocal, TWO)]);
    let half = graph.scale(reciprocal, Number::HALF);
    let vector = rho.map(|component| graph.mul(component, half));
    Quaternion { scalar, vector, reciprocal }
}

/// The matrix from body axes to space axes: 1 + 2 w \[u]ₓ + 2 \[u]ₓ².
fn matrix(graph: &mut Graph, rho: &[NodeId; 3]) -> [[NodeId; 3]; 3] {
    let Quaternion { scalar, vector, .. } = quaternion(graph, rho);
    [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| {
            if i == j {
                let others = [(i + 1) % 3, (i + 2) % 3];
                let terms = others.map(|k| (graph.mul(vector[k], vector[k]), -TWO));
                return graph.sum(Number::ONE, &terms);
            }
            let k = 3 - i - j;
            // The entry (i, j) of [u]ₓ is −u_k for even (i, j, k).
            let sign = if (i + 1) % 3 == j { -TWO } else { TWO };
            let (outer, turned) = (graph.mul(vector[i], vector[j]), graph.mul(scalar, vector[k]));
            graph.sum(Number::ZERO, &[(outer, TWO), (turned, sign)])
        })
    })
}

/// The angular velocity in body axes, D (w ρ′ − u × ρ′ + ¼ u (ρ·ρ′)) with D = 1/(1 + |ρ|²/16).
pub fn body_rate(graph: &mut Graph, rho: &[NodeId; 3], rates: &[NodeId; 3]) -> [NodeId; 3] {
    let Quaternion { scalar, vector, reciprocal } = quaternion(graph, rho);
    let scaled = rates.map(|rate| graph.mul(reciprocal, rate));
    let products: Vec<_> = (0..3).map(|i| (graph.mul(rho[i], scaled[i]), QUARTER)).collect();
    let along = graph.sum(Number::ZERO, &products);
    [(0, 1, 2), (1, 2, 0), (2, 0, 1)].map(|(i, j, k)| {
        let terms = [
            (graph.mul(scalar, scaled[i]), Number::ONE),
            (graph.mul(vector[j], scaled[k]), Number::MINUS_ONE),
            (graph.mul(vector[k], scaled[j]), Number::ONE),
            (graph.mul(vector[i], along), Number::ONE),
        ];
        graph.sum(Number::ZERO, &terms)
    })
}

/// Whether a coordinate is one of the three numbers of an orientation, whose first ones are given.
pub fn holds(orientations: &[usize], coordinate: usize) -> bool {
    holding(orientations, coordinate).is_some()
}

/// The index of the orientation that a coordinate is one of the three numbers of.
pub fn holding(orientations: &[usize], coordinate: usize) -> Option<usize> {
    orientations.iter().position(|&first| (first..first + 3).contains(&coordinate))
}

/// The variables of the matrix of an orientation, given by its index.
pub fn entries(graph: &mut Graph, place: usize) -> [[NodeId; 3]; 3] {
    let entry = |row: u32, column: u32| Variable::Entry(9 * place as u32 + 3 * row + column);
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| graph.variable(entry(row, column))))
}

/// The variables of the angular velocity of the orientation whose numbers begin at a coordinate.
pub fn spin(graph: &mut Graph, first: usize) -> [NodeId; 3] {
    [0, 1, 2].map(|i| graph.variable(Variable::Velocity(first as u32 + i)))
}

/// Matrices and angular velocities as functions of a state's numbers.
pub fn of_parameters(graph: &mut Graph, orientations: &[usize]) -> Vec<(NodeId, NodeId)> {
    let mut known = Vec::with_capacity(12 * orientations.len());
    for (place, &first) in orientations.iter().enumerate() {
        let rho = [0, 1, 2].map(|i| graph.variable(Variable::Coordinate(first as u32 + i)));
        // The same variables mean ω before the replacement and ρ′ after it.
        let rates = spin(graph, first);
        let (entries, values) = (entries(graph, place), matrix(graph, &rho));
        known.extend(entries.into_iter().flatten().zip(values.into_iter().flatten()));
        known.extend(rates.into_iter().zip(body_rate(graph, &rho, &rates)));
    }
    known
}
