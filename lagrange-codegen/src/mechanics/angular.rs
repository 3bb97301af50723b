//! Angular velocities of composed rotations.
//!
//! In body axes: ω = φ̇ e for a fixed axis e, ω(AB) = Bᵀ ω(A) + ω(B), ω(A⁻¹) = −A ω(A), and for a
//! rotation by parameters as `orientation` has it, and for a
//! rotation known by its entries alone the vector of the skew matrix Rᵀ Ṙ. Goldstein, *Classical
//! Mechanics*, 3rd ed., section 4.9.

use crate::calculus::pushforward;
use crate::expr::{Graph, NodeId};
use crate::model::{Rotation, RotationForm, orientation};
use crate::number::Number;

/// The angular velocity in body axes, for total time derivatives along `direction`.
pub(super) fn body_rate(
    graph: &mut Graph,
    rotation: &Rotation,
    direction: &[(NodeId, NodeId)],
) -> [NodeId; 3] {
    match &rotation.form {
        RotationForm::Axis { axis, angle } => {
            let rate = pushforward(graph, &[*angle], direction)[0];
            axis.map(|component| graph.mul(rate, component))
        }
        RotationForm::Product(left, right) => {
            let of_left = body_rate(graph, left, direction);
            let of_right = body_rate(graph, right, direction);
            let turned = transposed_times(graph, &right.matrix, &of_left);
            [0, 1, 2].map(|i| graph.add(turned[i], of_right[i]))
        }
        RotationForm::Inverse(inner) => {
            let of_inner = body_rate(graph, inner, direction);
            let turned = times(graph, &inner.matrix, &of_inner);
            turned.map(|component| graph.neg(component))
        }
        RotationForm::Parameters(rho) => {
            let rates = pushforward(graph, rho, direction);
            orientation::body_rate(graph, rho, &[rates[0], rates[1], rates[2]])
        }
        RotationForm::Entries => {
            let entries: Vec<NodeId> = rotation.matrix.iter().flatten().copied().collect();
            let rates = pushforward(graph, &entries, direction);
            // (Rᵀ Ṙ) at (row, column) is the dot product of two columns.
            let mut skew = |row: usize, column: usize| {
                let terms: Vec<_> = (0..3)
                    .map(|k| (graph.mul(rotation.matrix[k][row], rates[3 * k + column]), Number::ONE))
                    .collect();
                graph.sum(Number::ZERO, &terms)
            };
            [skew(2, 1), skew(0, 2), skew(1, 0)]
        }
    }
}

/// `matrix · vector`.
pub(super) fn times(graph: &mut Graph, matrix: &[[NodeId; 3]; 3], vector: &[NodeId; 3]) -> [NodeId; 3] {
    [0, 1, 2].map(|row| {
        let terms: Vec<_> = (0..3).map(|k| (graph.mul(matrix[row][k], vector[k]), Number::ONE)).collect();
        graph.sum(Number::ZERO, &terms)
    })
}

/// `matrixᵀ · vector`.
pub(super) fn transposed_times(
    graph: &mut Graph,
    matrix: &[[NodeId; 3]; 3],
    vector: &[NodeId; 3],
) -> [NodeId; 3] {
    let transposed = [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[column][row]));
    times(graph, &transposed, vector)
}

/// `a × b`.
pub(super) fn cross(graph: &mut Graph, a: &[NodeId; 3], b: &[NodeId; 3]) -> [NodeId; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        let (first, second) = (graph.mul(a[i], b[j]), graph.mul(a[j], b[i]));
        graph.sub(first, second)
    })
}
