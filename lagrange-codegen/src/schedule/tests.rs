//! Programs against the graph they were made from.

use super::*;
use crate::expr::{Graph, NodeId, Unary, Variable};
use crate::number::Number;

fn sample(variable: Variable) -> f64 {
    match variable {
        Variable::Coordinate(i) => 0.3 + 0.7 * f64::from(i),
        Variable::Velocity(i) => -0.4 + 0.9 * f64::from(i),
        Variable::Parameter(i) => 1.5 + f64::from(i),
        Variable::Time
        | Variable::Input(_)
        | Variable::Acceleration(_)
        | Variable::Auxiliary(_)
        | Variable::Entry(_)
        | Variable::Multiplier(_)
        | Variable::Position(_) => 0.6,
    }
}

fn check(graph: &Graph, roots: &[NodeId]) -> Operations {
    let program = plan(graph, roots);
    for (expected, found) in graph.evaluate(roots, sample).into_iter().zip(program.evaluate(sample)) {
        assert!((expected - found).abs() <= 1e-14 * expected.abs().max(1.0), "{expected} became {found}");
    }
    program.operations(false)
}

#[test]
fn kepler_takes_one_root_and_one_division() {
    let mut g = Graph::new();
    let (x, y) = (g.variable(Variable::Coordinate(0)), g.variable(Variable::Coordinate(1)));
    let (x2, y2) = (g.powi(x, 2), g.powi(y, 2));
    let square = g.add(x2, y2);
    let root = g.sqrt(square);
    let cube = g.powi(root, -3);
    let (a, b) = (g.mul(x, cube), g.mul(y, cube));
    let roots = [g.neg(a), g.neg(b)];
    let operations = check(&g, &roots);
    assert_eq!((operations.square_roots, operations.divisions), (1, 1));
    assert_eq!(operations.multiplications, 5);
}

#[test]
fn fixed_factors_gather_into_one_multiplication() {
    let mut g = Graph::new();
    let x = g.variable(Variable::Coordinate(0));
    let (m, l) = (g.variable(Variable::Parameter(0)), g.variable(Variable::Parameter(1)));
    let sine = g.unary(Unary::Sin, x);
    let product = g.mul(m, l);
    let product = g.mul(product, sine);
    let root = g.scale(product, Number::integer(-3));
    let operations = check(&g, &[root]);
    assert_eq!((operations.multiplications, operations.additions, operations.functions), (1, 1, 1));
}

#[test]
fn products_share_pairs_and_sums_share_multipliers() {
    let mut g = Graph::new();
    let x: Vec<_> = (0..4).map(|i| g.variable(Variable::Coordinate(i))).collect();
    let xy = g.mul(x[0], x[1]);
    let roots: Vec<_> = (2..4).map(|i| g.mul(xy, x[i])).collect();
    assert_eq!(check(&g, &roots).multiplications, 3);
    let two = Number::integer(2);
    let sum = g.sum(Number::ZERO, &[(x[0], two), (x[1], -two), (x[2], Number::ONE)]);
    let operations = check(&g, &[sum]);
    assert_eq!((operations.multiplications, operations.additions), (1, 2));
}

#[test]
fn reciprocals_serve_different_powers() {
    let mut g = Graph::new();
    let (x, y) = (g.variable(Variable::Coordinate(0)), g.variable(Variable::Coordinate(1)));
    let roots = [g.div(y, x), g.product(&[(y, crate::expr::Exponent(2)), (x, crate::expr::Exponent(-6))])];
    assert_eq!(check(&g, &roots).divisions, 1);
}
