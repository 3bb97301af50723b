//! Every operator but the pivot, in both directions, against differences.

use super::*;
use crate::expr::{Exponent, Graph, NodeId, Unary, Variable};
use crate::number::Number;

/// Arguments inside the domain of the function.
fn arguments(function: Unary) -> [f64; 3] {
    match function {
        Unary::Acosh => [1.2, 2.0, 5.0],
        Unary::Ln | Unary::Ln1p | Unary::Cbrt => [0.1, 1.0, 7.0],
        _ => [-0.7, 0.2, 0.8],
    }
}

/// Fourth-order central difference.
fn difference(f: impl Fn(f64) -> f64, x: f64) -> f64 {
    let h = 1e-3;
    (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)
}

fn check(graph: &mut Graph, root: NodeId, x: NodeId, arguments: [f64; 3]) {
    let one = graph.one();
    let forward = pushforward(graph, &[root], &[(x, one)])[0];
    let reverse = pullback(graph, &[(root, one)], &[x])[0];
    for argument in arguments {
        let at = |value: f64| move |_: Variable| value;
        let expected = difference(|x| graph.evaluate(&[root], at(x))[0], argument);
        for derivative in [forward, reverse] {
            let found = graph.evaluate(&[derivative], at(argument))[0];
            assert!(
                (found - expected).abs() <= 1e-8 * expected.abs().max(1.0),
                "{found} for {expected} at {argument}"
            );
        }
    }
}

#[test]
fn every_function_of_one_argument() {
    for function in Unary::ALL {
        let mut graph = Graph::new();
        let x = graph.variable(Variable::Coordinate(0));
        let root = graph.unary(function, x);
        check(&mut graph, root, x, arguments(function));
    }
}

#[test]
fn functions_of_two_arguments_and_powers() {
    let mut graph = Graph::new();
    let x = graph.variable(Variable::Coordinate(0));
    let sine = graph.unary(Unary::Sin, x);
    let shifted = graph.sum(Number::integer(2), &[(sine, Number::ONE)]);
    let square = graph.powi(x, 2);
    let root = graph.atan2(shifted, square);
    check(&mut graph, root, x, [-0.7, 0.2, 0.8]);
    let root = graph.powf(shifted, x);
    check(&mut graph, root, x, [-0.7, 0.2, 0.8]);
    let root = graph.powf_ln(shifted, x);
    check(&mut graph, root, x, [-0.7, 0.2, 0.8]);
    let root = graph.product(&[(shifted, Exponent(-3)), (x, Exponent(4))]);
    check(&mut graph, root, x, [-0.7, 0.2, 0.8]);
}

#[test]
fn a_wrong_derivative_is_noticed() {
    let mut graph = Graph::new();
    let x = graph.variable(Variable::Coordinate(0));
    let root = graph.unary(Unary::Sin, x);
    let expected = difference(|x| graph.evaluate(&[root], |_| x)[0], 0.3);
    assert!((graph.evaluate(&[root], |_| 0.3)[0] - expected).abs() > 0.1);
}

#[test]
fn adjoints_of_partial_sums_are_partial_sums() {
    let size = |count: u32| {
        let mut graph = Graph::new();
        let variables: Vec<NodeId> = (0..count).map(|i| graph.variable(Variable::Coordinate(i))).collect();
        let mut sum = graph.zero();
        let mut squares = Vec::new();
        for &x in &variables {
            let sine = graph.unary(Unary::Sin, x);
            sum = graph.add(sum, sine);
            squares.push((graph.powi(sum, 2), Number::ONE));
        }
        let total = graph.sum(Number::ZERO, &squares);
        let one = graph.one();
        let gradient = pullback(&mut graph, &[(total, one)], &variables);
        graph.cone(gradient).len()
    };
    assert_eq!(size(40) - size(30), size(30) - size(20));
}

#[test]
fn derivatives_exist_where_a_function_has_saturated() {
    let mut graph = Graph::new();
    let x = graph.variable(Variable::Coordinate(0));
    let (tanh, cosine, one) = (graph.unary(Unary::Tanh, x), graph.unary(Unary::Cosh, x), graph.one());
    let well = graph.powi(cosine, -2);
    for mut derivative in [tanh, well] {
        for _ in 0..4 {
            let forward = pushforward(&mut graph, &[derivative], &[(x, one)])[0];
            derivative = pullback(&mut graph, &[(derivative, one)], &[x])[0];
            for at in [1e4, -1e4] {
                assert_eq!(graph.evaluate(&[forward, derivative], |_| at), [0.0, 0.0]);
            }
        }
    }
}

#[test]
fn a_power_of_zero_has_derivatives_by_its_exponent() {
    let mut graph = Graph::new();
    let (x, y) = (graph.variable(Variable::Coordinate(0)), graph.variable(Variable::Coordinate(1)));
    let one = graph.one();
    let power = graph.powf(x, y);
    let by_exponent = pullback(&mut graph, &[(power, one)], &[y])[0];
    let seconds = pullback(&mut graph, &[(by_exponent, one)], &[x, y]);
    let at = |exponent: f64| {
        move |variable: Variable| if variable == Variable::Coordinate(0) { 0.0 } else { exponent }
    };
    assert_eq!(graph.evaluate(&[by_exponent, seconds[0], seconds[1]], at(1.5)), [0.0; 3]);
    assert_eq!(graph.evaluate(&[by_exponent], at(0.0)), [f64::NEG_INFINITY]);
}
