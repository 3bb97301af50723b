//! Velocities along a motion: the direction of total time derivatives, and angular velocities of composed
//! rotations.
//!
//! In body axes: ω = φ̇ e for a fixed axis e, φ̇ u + sin φ u̇ − (1 − cos φ) u × u̇ for a moving one, the
//! imaginary part of 2 q* q̇ / |q|² for a quaternion, ω(AB) = Bᵀ ω(A) + ω(B), ω(A⁻¹) = −A ω(A), and for a
//! rotation known by its entries alone the vector of the skew matrix Rᵀ Ṙ. In space axes: the same with + for
//! u × u̇, 2 q̇ q* / |q|², ω(AB) = ω(A) + A ω(B), ω(A⁻¹) of the one is −ω(A) of the other, and Ṙ Rᵀ.
//! Goldstein, *Classical Mechanics*, 3rd ed., section 4.9.

pub(crate) mod acting;

use crate::calculus::{pullback_to, pushforward};
use crate::expr::{Graph, NodeId, Unary, Variable};
use crate::model::{Rotation, RotationForm, orientation};
use crate::number::Number;

/// The direction (v, 0, 1) of (q, v, t): total time derivatives at a = 0.
pub(crate) fn time_direction(graph: &mut Graph, coordinates: usize) -> Vec<(NodeId, NodeId)> {
    turning_direction(graph, coordinates, &[])
}

/// The same if the matrices of these orientations are variables: R′ = R \[ω]ₓ, with ω in place of the rates.
pub(crate) fn turning_direction(
    graph: &mut Graph,
    coordinates: usize,
    turning: &[usize],
) -> Vec<(NodeId, NodeId)> {
    let mut direction = Vec::with_capacity(coordinates + 9 * turning.len() + 1);
    for i in 0..coordinates as u32 {
        direction.push((graph.variable(Variable::Coordinate(i)), graph.variable(Variable::Velocity(i))));
    }
    for (number, &first) in turning.iter().enumerate() {
        let spin = orientation::spin(graph, first);
        for row in orientation::entries(graph, number) {
            direction.extend(row.into_iter().zip(cross(graph, &row, &spin)));
        }
    }
    let one = graph.one();
    direction.push((graph.variable(Variable::Time), one));
    direction
}

/// The slopes of Σ seed · output by the coordinates. For an orientation whose matrix is a variable they are
/// slopes by turns about body axes, δR = R \[δφ]ₓ.
pub(crate) fn slopes(
    graph: &mut Graph,
    seeds: &[(NodeId, NodeId)],
    coordinates: &[NodeId],
    turning: &[usize],
) -> Vec<NodeId> {
    slopes_to(graph, seeds, &[], coordinates, turning).1
}

/// The slopes by the nodes of `held` and then by the coordinates. What passes through the former does not
/// count for the latter.
pub(crate) fn slopes_to(
    graph: &mut Graph,
    seeds: &[(NodeId, NodeId)],
    held: &[NodeId],
    coordinates: &[NodeId],
    turning: &[usize],
) -> (Vec<NodeId>, Vec<NodeId>) {
    let mut by = coordinates.to_vec();
    let matrices: Vec<_> = (0..turning.len()).map(|number| orientation::entries(graph, number)).collect();
    by.extend(matrices.as_flattened().as_flattened());
    let (at_held, mut slopes) = pullback_to(graph, seeds, held, &by);
    let by_entries = slopes.split_off(coordinates.len());
    for ((&first, matrix), by_entries) in turning.iter().zip(&matrices).zip(by_entries.as_chunks::<9>().0) {
        // δφ · Σ g × r over the rows r with their slopes g.
        let mut torque: [Vec<(NodeId, Number)>; 3] = Default::default();
        for (row, slope) in matrix.iter().zip(by_entries.as_chunks::<3>().0) {
            for (sum, share) in torque.iter_mut().zip(cross(graph, slope, row)) {
                sum.push((share, Number::ONE));
            }
        }
        for (slope, sum) in slopes[first..].iter_mut().zip(torque) {
            *slope = graph.sum(Number::ZERO, &sum);
        }
    }
    (at_held, slopes)
}

/// The angular velocity in body axes, for total time derivatives along `direction`.
pub(crate) fn body_rate(
    graph: &mut Graph,
    rotation: &Rotation,
    direction: &[(NodeId, NodeId)],
) -> [NodeId; 3] {
    match &rotation.form {
        RotationForm::Axis { axis, angle } => axis_rate(graph, axis, *angle, Frame::Body, direction),
        RotationForm::Quaternion(parts) => quaternion_rate(graph, parts, Frame::Body, direction),
        RotationForm::Turning(rate) => *rate,
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
        RotationForm::Entries => {
            // (Rᵀ Ṙ) at (row, column) is the dot product of two columns.
            let columns = transposed(&rotation.matrix);
            let rates = transposed(&entry_rates(graph, rotation, direction));
            vector_of_skew(|row, column| dot(graph, &columns[row], &rates[column]))
        }
    }
}

/// The same in space axes.
pub(crate) fn space_rate(
    graph: &mut Graph,
    rotation: &Rotation,
    direction: &[(NodeId, NodeId)],
) -> [NodeId; 3] {
    match &rotation.form {
        RotationForm::Axis { axis, angle } => axis_rate(graph, axis, *angle, Frame::Space, direction),
        RotationForm::Quaternion(parts) => quaternion_rate(graph, parts, Frame::Space, direction),
        RotationForm::Turning(rate) => times(graph, &rotation.matrix, rate),
        RotationForm::Product(left, right) => {
            let of_left = space_rate(graph, left, direction);
            let of_right = space_rate(graph, right, direction);
            let turned = times(graph, &left.matrix, &of_right);
            [0, 1, 2].map(|i| graph.add(of_left[i], turned[i]))
        }
        RotationForm::Inverse(inner) => {
            body_rate(graph, inner, direction).map(|component| graph.neg(component))
        }
        RotationForm::Entries => {
            // (Ṙ Rᵀ) at (row, column) is the dot product of two rows.
            let rates = entry_rates(graph, rotation, direction);
            vector_of_skew(|row, column| dot(graph, &rates[row], &rotation.matrix[column]))
        }
    }
}

/// The axes of the components of an angular velocity.
#[derive(Clone, Copy, PartialEq)]
enum Frame {
    Body,
    Space,
}

impl Frame {
    /// The sign of a × b in these axes; in space axes it is positive.
    fn sign(self) -> Number {
        if self == Frame::Space { Number::ONE } else { Number::MINUS_ONE }
    }
}

/// φ̇ u + sin φ u̇ ± (1 − cos φ) u × u̇.
fn axis_rate(
    graph: &mut Graph,
    axis: &[NodeId; 3],
    angle: NodeId,
    frame: Frame,
    direction: &[(NodeId, NodeId)],
) -> [NodeId; 3] {
    let rate = pushforward(graph, &[angle], direction)[0];
    let along = axis.map(|component| graph.mul(rate, component));
    let moves = pushforward(graph, axis, direction);
    if moves.iter().all(|&component| graph.is_zero(component)) {
        return along;
    }
    let moves = [moves[0], moves[1], moves[2]];
    let (sine, cosine) = (graph.unary(Unary::Sin, angle), graph.unary(Unary::Cos, angle));
    let versine = graph.sum(Number::ONE, &[(cosine, Number::MINUS_ONE)]);
    let across = cross(graph, axis, &moves);
    [0, 1, 2].map(|i| {
        let (turned, across) = (graph.mul(sine, moves[i]), graph.mul(versine, across[i]));
        graph.sum(Number::ZERO, &[(along[i], Number::ONE), (turned, Number::ONE), (across, frame.sign())])
    })
}

/// 2 (w u̇ − ẇ u ± u × u̇) / |q|² of a quaternion q = w + u.
fn quaternion_rate(
    graph: &mut Graph,
    parts: &[NodeId; 4],
    frame: Frame,
    direction: &[(NodeId, NodeId)],
) -> [NodeId; 3] {
    let rates = pushforward(graph, parts, direction);
    let (u, u_rate) = ([parts[1], parts[2], parts[3]], [rates[1], rates[2], rates[3]]);
    let squares: Vec<_> = parts.iter().map(|&part| (graph.powi(part, 2), Number::ONE)).collect();
    let square = graph.sum(Number::ZERO, &squares);
    let two = graph.integer(2);
    let scale = graph.div(two, square);
    let across = cross(graph, &u, &u_rate);
    [0, 1, 2].map(|i| {
        let (with, against) = (graph.mul(parts[0], u_rate[i]), graph.mul(rates[0], u[i]));
        let sum = graph.sum(
            Number::ZERO,
            &[(with, Number::ONE), (against, Number::MINUS_ONE), (across[i], frame.sign())],
        );
        graph.mul(scale, sum)
    })
}

/// The rates of the entries of a rotation.
fn entry_rates(graph: &mut Graph, rotation: &Rotation, direction: &[(NodeId, NodeId)]) -> [[NodeId; 3]; 3] {
    let rates = pushforward(graph, rotation.matrix.as_flattened(), direction);
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| rates[3 * row + column]))
}

/// The vector ω of a skew matrix [ω]ₓ given by its entries.
fn vector_of_skew(mut entry: impl FnMut(usize, usize) -> NodeId) -> [NodeId; 3] {
    [entry(2, 1), entry(0, 2), entry(1, 0)]
}

fn dot(graph: &mut Graph, a: &[NodeId; 3], b: &[NodeId; 3]) -> NodeId {
    let terms: Vec<_> = a.iter().zip(b).map(|(&a, &b)| (graph.mul(a, b), Number::ONE)).collect();
    graph.sum(Number::ZERO, &terms)
}

/// `matrix · vector`.
pub(crate) fn times(graph: &mut Graph, matrix: &[[NodeId; 3]; 3], vector: &[NodeId; 3]) -> [NodeId; 3] {
    [0, 1, 2].map(|row| dot(graph, &matrix[row], vector))
}

/// `matrixᵀ · vector`.
pub(crate) fn transposed_times(
    graph: &mut Graph,
    matrix: &[[NodeId; 3]; 3],
    vector: &[NodeId; 3],
) -> [NodeId; 3] {
    times(graph, &transposed(matrix), vector)
}

/// The transposed matrix.
pub(crate) fn transposed(matrix: &[[NodeId; 3]; 3]) -> [[NodeId; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[column][row]))
}

/// `a × b`.
pub(crate) fn cross(graph: &mut Graph, a: &[NodeId; 3], b: &[NodeId; 3]) -> [NodeId; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        let (first, second) = (graph.mul(a[i], b[j]), graph.mul(a[j], b[i]));
        graph.sub(first, second)
    })
}
