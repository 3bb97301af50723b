//! Positions that an orientation carries along: r = c + R x with x in its axes.
//!
//! Their velocities are simplest in the same axes, Rᵀṙ = Rᵀċ + ω × x + ẋ, where R is gone from all that c has
//! no part in. The graph does not know that RᵀR = 1, so this is found in the positions.

use crate::calculus::{pullback, pushforward, substitute, velocity_degrees};
use crate::expr::{Graph, Node, NodeId, Variable};
use crate::kinematics::{cross, transposed_times};
use crate::model::orientation;

/// A position in the axes of an orientation.
#[derive(Clone, Debug)]
pub(super) struct InAxes {
    /// The matrix R.
    pub matrix: [[NodeId; 3]; 3],
    /// ω.
    pub spin: [NodeId; 3],
    /// c: coordinates, or zero.
    pub carrier: [NodeId; 3],
    /// x.
    pub arm: [NodeId; 3],
}

impl InAxes {
    /// Velocity, and acceleration at a = 0, in the axes: Rᵀċ + y with y = ω × x + ẋ, and Rᵀc̈ + ω × y + ẏ.
    pub fn motion(
        &self,
        graph: &mut Graph,
        direction: &[(NodeId, NodeId)],
        arm_rate: &[NodeId],
    ) -> (Vec<NodeId>, Vec<NodeId>) {
        let along = cross(graph, &self.spin, &self.arm);
        let relative = [0, 1, 2].map(|i| graph.add(along[i], arm_rate[i]));
        let change = pushforward(graph, &relative, direction);
        let turned = cross(graph, &self.spin, &relative);
        let carried = pushforward(graph, &self.carrier, direction);
        let carried = transposed_times(graph, &self.matrix, &[carried[0], carried[1], carried[2]]);
        // A coordinate has no acceleration of its own.
        let velocity = (0..3).map(|i| graph.add(carried[i], relative[i])).collect();
        let acceleration = (0..3).map(|i| graph.add(turned[i], change[i])).collect();
        (velocity, acceleration)
    }
}

/// A position as c + R x for the first of the orientations that carries it.
pub(super) fn in_axes(graph: &mut Graph, position: &[NodeId], turning: &[usize]) -> Option<InAxes> {
    let &[x, y, z] = position else { return None };
    let position = [x, y, z];
    let cone = graph.cone(position);
    let is_in = |node: &NodeId| cone.binary_search(node).is_ok();
    for (place, &first) in turning.iter().enumerate() {
        let matrix = orientation::entries(graph, place);
        if matrix.as_flattened().iter().any(is_in) {
            return of_orientation(graph, position, matrix, first);
        }
    }
    None
}

fn of_orientation(
    graph: &mut Graph,
    position: [NodeId; 3],
    matrix: [[NodeId; 3]; 3],
    first: usize,
) -> Option<InAxes> {
    let (zero, one) = (graph.zero(), graph.one());
    let entries = matrix.as_flattened();
    let known = |values: [NodeId; 9]| entries.iter().copied().zip(values).collect::<Vec<_>>();
    let &[x, y, z] = substitute(graph, &position, &known([zero; 9])).as_slice() else { return None };
    let carrier = [x, y, z];
    let is_plain = |&node: &NodeId| {
        graph.is_zero(node) || matches!(graph.node(node), Node::Variable(Variable::Coordinate(_)))
    };
    if !carrier.iter().all(is_plain) {
        return None;
    }
    // c stands in r once, and nowhere else in it.
    for (&component, &own) in position.iter().zip(&carrier) {
        let slopes = pullback(graph, &[(component, one)], &carrier);
        let expected = |&node: &NodeId| if node == own && node != zero { one } else { zero };
        if carrier.iter().map(expected).ne(slopes) {
            return None;
        }
    }
    let without: Vec<_> = carrier.iter().filter(|&&node| node != zero).map(|&node| (node, zero)).collect();
    // r − c is the same linear function of each row. Positions know no velocities, which stand for a row here.
    let row = [0, 1, 2].map(|i| graph.variable(Variable::Velocity((first + i) as u32)));
    let functions = [0, 1, 2].map(|i| {
        let known: Vec<_> = matrix[i].into_iter().zip(row).chain(without.iter().copied()).collect();
        substitute(graph, &[position[i]], &known)[0]
    });
    let is_linear = velocity_degrees(graph, functions[0]).is_homogeneous(1);
    if !is_linear || functions.iter().any(|&function| function != functions[0]) {
        return None;
    }
    let unit = std::array::from_fn(|i| if i % 4 == 0 { one } else { zero });
    let &[x, y, z] = substitute(graph, &position, &[known(unit), without].concat()).as_slice() else {
        return None;
    };
    Some(InAxes { matrix, spin: orientation::spin(graph, first), carrier, arm: [x, y, z] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Unary;
    use crate::kinematics::times;

    /// p + R (a, b, c) with components that may depend on the position.
    fn carried(graph: &mut Graph, arms: [NodeId; 3]) -> Option<InAxes> {
        let p = [0, 1, 2].map(|i| graph.variable(Variable::Coordinate(i)));
        let matrix = orientation::entries(graph, 0);
        let turned = times(graph, &matrix, &arms);
        let position = [0, 1, 2].map(|i| graph.add(p[i], turned[i]));
        in_axes(graph, &position, &[3])
    }

    #[test]
    fn positions_are_taken_apart() {
        let mut graph = Graph::default();
        let angle = graph.variable(Variable::Coordinate(6));
        let sine = graph.unary(Unary::Sin, angle);
        let arm = [angle, sine, graph.one()];
        let found = carried(&mut graph, arm).expect("p + R x");
        assert_eq!(found.arm, arm);
        assert_eq!(found.carrier, [0, 1, 2].map(|i| graph.variable(Variable::Coordinate(i))));
    }

    #[test]
    fn what_depends_on_its_carrier_is_left_alone() {
        let mut graph = Graph::default();
        let (x, one) = (graph.variable(Variable::Coordinate(0)), graph.one());
        assert!(carried(&mut graph, [x, one, one]).is_none());
        let entry = graph.variable(Variable::Entry(4));
        assert!(carried(&mut graph, [one, entry, one]).is_none());
    }

    #[test]
    fn rows_with_other_functions_are_no_rotation() {
        let mut graph = Graph::default();
        let matrix = orientation::entries(&mut graph, 0);
        let (zero, one) = (graph.zero(), graph.one());
        assert!(in_axes(&mut graph, &[matrix[0][0], matrix[1][1], matrix[2][0]], &[0]).is_none());
        assert!(in_axes(&mut graph, &[matrix[1][0], matrix[0][0], matrix[2][0]], &[0]).is_none());
        let found = in_axes(&mut graph, &[matrix[0][0], matrix[1][0], matrix[2][0]], &[0]).expect("R x");
        assert_eq!(found.arm, [one, zero, zero]);
    }
}
