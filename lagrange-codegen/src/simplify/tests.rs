//! Every rule against evaluation of what it started from, and its effect on the cost.

use super::*;
use crate::expr::{Unary, Variable};
use crate::number::Number;

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-13 * (1.0 + a.abs() + b.abs())
}

fn check(graph: &mut Graph, roots: &[NodeId]) -> (u32, u32) {
    let after = simplify(graph, &mut Hints::default(), roots);
    for sample in 0..5 {
        let value = |variable: Variable| match variable {
            Variable::Coordinate(i) => 0.3 + 0.7 * f64::from(i) - 0.11 * f64::from(sample),
            Variable::Velocity(i) => -0.4 + 0.9 * f64::from(i) + 0.21 * f64::from(sample),
            Variable::Parameter(i) => 1.5 + f64::from(i),
            Variable::Time
            | Variable::Input(_)
            | Variable::Acceleration(_)
            | Variable::Auxiliary(_)
            | Variable::Entry(_)
            | Variable::Multiplier(_)
            | Variable::Position(_) => 0.6,
        };
        let (before, now) = (graph.evaluate(roots, value), graph.evaluate(&after, value));
        for (a, b) in before.into_iter().zip(now) {
            assert!(close(a, b), "{a} became {b}");
        }
    }
    (cost(graph, roots), cost(graph, &after))
}

#[test]
fn cancelling_products_are_multiplied_out() {
    let mut g = Graph::new();
    let x: Vec<_> = (0..2).map(|i| g.variable(Variable::Coordinate(i))).collect();
    let v: Vec<_> = (0..2).map(|i| g.variable(Variable::Velocity(i))).collect();
    let (s0, c0) = (g.unary(Unary::Sin, x[0]), g.unary(Unary::Cos, x[0]));
    let (s1, c1) = (g.unary(Unary::Sin, x[1]), g.unary(Unary::Cos, x[1]));
    let (a, b) = (g.mul(v[0], v[0]), g.mul(v[1], v[1]));
    let along = |g: &mut Graph, f0, f1| {
        let (first, second) = (g.mul(a, f0), g.mul(b, f1));
        g.add(first, second)
    };
    let (sines, cosines) = (along(&mut g, s0, s1), along(&mut g, c0, c1));
    let (first, second) = (g.mul(c0, sines), g.mul(s0, cosines));
    let root = g.sub(first, second);
    let (before, after) = check(&mut g, &[root]);
    // Left: two products, their difference, and v₁² times it. Powers in a product count each time.
    assert_eq!((before - 48, after - 48), (13, 5));
}

#[test]
fn squares_are_not_multiplied_out() {
    let mut g = Graph::new();
    let (x, y) = (g.variable(Variable::Coordinate(0)), g.variable(Variable::Coordinate(1)));
    let difference = g.sub(x, y);
    let square = g.powi(difference, 2);
    let root = g.scale(square, Number::integer(20));
    assert_eq!(simplify(&mut g, &mut Hints::default(), &[root]), [root]);
}

#[test]
fn partial_sums_lose_their_common_factor() {
    let mut g = Graph::new();
    let (x, y) = (g.variable(Variable::Coordinate(0)), g.variable(Variable::Coordinate(1)));
    let z = g.variable(Variable::Coordinate(2));
    let (xy, xz) = (g.mul(x, y), g.mul(x, z));
    let root = g.sum(Number::ONE, &[(xy, Number::integer(2)), (xz, Number::integer(3)), (y, Number::ONE)]);
    let (before, after) = check(&mut g, &[root]);
    assert!(after < before, "{before} → {after}");
}

#[test]
fn sums_of_angles_reuse_sines_and_cosines() {
    let mut g = Graph::new();
    let angles: Vec<_> = (0..3).map(|i| g.variable(Variable::Coordinate(i))).collect();
    let mut roots: Vec<_> = angles.iter().map(|&angle| g.unary(Unary::Sin, angle)).collect();
    let first = g.sub(angles[0], angles[1]);
    let second = g.add(first, angles[2]);
    roots.extend([g.unary(Unary::Cos, first), g.unary(Unary::Sin, second), g.unary(Unary::Cos, second)]);
    let after = simplify(&mut g, &mut Hints::default(), &roots);
    let calls = g.cone(after.iter().copied()).into_iter();
    let calls = calls.filter(|&id| matches!(g.node(id), crate::expr::Node::Unary(..))).count();
    assert_eq!(calls, 6);
    check(&mut g, &roots);
}

#[test]
fn factors_of_long_products_are_taken_out_without_division() {
    let mut g = Graph::new();
    let mut product = g.one();
    for i in 0..12 {
        let variable = g.variable(Variable::Coordinate(i));
        product = g.mul(product, variable);
    }
    let [x, y, z] = [0, 1, 2].map(|i| g.variable(Variable::Velocity(i)));
    let (a, b) = (g.mul(product, x), g.mul(product, y));
    let root = g.sum(Number::ONE, &[(a, Number::ONE), (b, Number::integer(3)), (z, Number::ONE)]);
    let after = factor::factor(&mut g, &[root]);
    // Everything but the constant vanishes, where a quotient of zeros would be NaN.
    assert_eq!(g.evaluate(&after, |_| 0.0), [1.0]);
    assert_ne!(after, [root]);
}
