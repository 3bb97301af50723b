//! Orientations by three numbers: modified Rodrigues parameters ρ = 4 tan(θ/4) n of a turn by θ about n.
//!
//! They have no singular position within a full turn; the runtime changes to the other triple of the same
//! orientation at half a turn. The map is conformal: |ω| = |ρ′|/(1 + |ρ|²/16), so that no direction is
//! weighed more than another. Schaub and Junkins, *Analytical Mechanics of Space Systems*, 4th ed., section 3.5
//! (there σ = ρ/4); ρ is near the rotation vector, and ρ′ near the angular velocity.

use super::{Rotation, RotationForm};
use crate::expr::{Graph, NodeId};
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

/// The rotation from body axes to space axes: 1 + 2 w \[u]ₓ + 2 \[u]ₓ².
pub fn rotation(graph: &mut Graph, rho: [NodeId; 3]) -> Rotation {
    let Quaternion { scalar, vector, .. } = quaternion(graph, &rho);
    let matrix = [0, 1, 2].map(|i| {
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
    });
    Rotation { matrix, form: RotationForm::Parameters(rho) }
}

/// The angular velocity in body axes.
pub fn body_rate(graph: &mut Graph, rho: &[NodeId; 3], rates: &[NodeId; 3]) -> [NodeId; 3] {
    angular_rate(graph, rho, rates, Number::MINUS_ONE)
}

/// The angular velocity D (w ρ′ ± u × ρ′ + ¼ u (ρ·ρ′)) with D = 1/(1 + |ρ|²/16): in space axes with the sign
/// plus, in body axes with minus.
pub fn angular_rate(graph: &mut Graph, rho: &[NodeId; 3], rates: &[NodeId; 3], sign: Number) -> [NodeId; 3] {
    let Quaternion { scalar, vector, reciprocal } = quaternion(graph, rho);
    let scaled = rates.map(|rate| graph.mul(reciprocal, rate));
    let products: Vec<_> = (0..3).map(|i| (graph.mul(rho[i], scaled[i]), QUARTER)).collect();
    let along = graph.sum(Number::ZERO, &products);
    [(0, 1, 2), (1, 2, 0), (2, 0, 1)].map(|(i, j, k)| {
        let terms = [
            (graph.mul(scalar, scaled[i]), Number::ONE),
            (graph.mul(vector[j], scaled[k]), sign),
            (graph.mul(vector[k], scaled[j]), -sign),
            (graph.mul(vector[i], along), Number::ONE),
        ];
        graph.sum(Number::ZERO, &terms)
    })
}
