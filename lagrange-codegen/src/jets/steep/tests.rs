//! What hides from a series, by the forms of functions.

use super::*;
use crate::expr::Variable;

#[test]
fn walls_and_smoothed_kinks_hide() {
    let mut graph = Graph::default();
    let x = graph.variable(Variable::Coordinate(0));
    let y = graph.variable(Variable::Coordinate(1));
    let width = graph.variable(Variable::Parameter(0));
    let [xx, yy, ww] = [x, y, width].map(|node| graph.powi(node, 2));
    let square = graph.add(xx, yy);
    let distance = graph.sqrt(square);
    let smoothed = graph.sum(Number::ZERO, &[(xx, Number::ONE), (ww, Number::ONE)]);
    let side = graph.sum(Number::ZERO, &[(ww, Number::ONE), (xx, Number::MINUS_ONE)]);
    let [sine, exp] = [Unary::Sin, Unary::Exp].map(|function| graph.unary(function, x));
    let squared = graph.powi(sine, 2);
    let cosine = graph.sum(Number::ONE, &[(squared, Number::MINUS_ONE)]);
    let shifted = graph.sum(Number::ONE, &[(x, Number::MINUS_ONE)]);
    for (node, is_steep, has_roots) in [
        (graph.powi(distance, -3), false, false),
        (distance, false, true),
        (sine, false, false),
        (graph.powi(width, -12), false, false),
        (graph.powi(x, -2), false, true),
        (graph.powi(square, -1), false, false),
        (graph.powi(x, 7), false, false),
        (graph.powi(x, 8), true, false),
        (graph.powi(sine, 40), true, false),
        (graph.powi(distance, -12), true, false),
        (graph.powi(distance, 7), false, true),
        (graph.powi(distance, 9), true, false),
        (graph.sqrt(smoothed), true, false),
        (graph.sqrt(side), false, true),
        (graph.powi(side, -1), true, true),
        (graph.powi(shifted, -1), true, true),
        (graph.powi(smoothed, -1), true, false),
        (graph.sqrt(cosine), false, true),
        (graph.unary(Unary::Acos, sine), false, true),
        (exp, true, false),
    ] {
        let found = hidden(&mut graph, &[node], &[], &[]);
        let found = found.map(|hidden| (hidden.is_steep, !hidden.roots.is_empty()));
        assert_eq!(
            found.unwrap_or_default(),
            (is_steep, has_roots),
            "{}",
            graph.print(node, &|v| format!("{v:?}"))
        );
    }
}

#[test]
fn products_are_as_flat_as_their_factors_together() {
    let mut graph = Graph::default();
    let [x, y] = [0, 1].map(|i| graph.variable(Variable::Coordinate(i)));
    let width = graph.variable(Variable::Parameter(0));
    let scaled = graph.mul(width, y);
    let apart = graph.sum(Number::ZERO, &[(x, Number::ONE), (scaled, Number::MINUS_ONE)]);
    let versine = |graph: &mut Graph, angle: NodeId| {
        let cosine = graph.unary(Unary::Cos, angle);
        graph.sum(Number::ONE, &[(cosine, Number::MINUS_ONE)])
    };
    let [of_x, of_y] = [x, y].map(|angle| versine(&mut graph, angle));
    let [sine, cosine] = [Unary::Sin, Unary::Cos].map(|function| graph.unary(function, x));
    let [xx, yy] = [x, y].map(|node| graph.powi(node, 2));
    let square = graph.add(xx, yy);
    for (factors, is_steep) in [
        (vec![(of_x, 3), (sine, 1)], false),
        (vec![(of_x, 4)], true),
        (vec![(of_x, 3), (of_y, 3)], true),
        (vec![(apart, 7)], false),
        (vec![(apart, 7), (x, 3)], true),
        (vec![(square, 3), (x, 1), (y, 1)], false),
        (vec![(square, 4)], true),
        (vec![(square, 3), (apart, 3)], true),
        (vec![(sine, 2), (cosine, 2), (xx, 1), (yy, 1)], false),
        (vec![(width, 9), (of_x, 2)], false),
    ] {
        let product = factors.iter().fold(graph.one(), |product, &(base, power)| {
            let power = graph.powi(base, power);
            graph.mul(product, power)
        });
        let found = hidden(&mut graph, &[product], &[], &[]);
        let found = found.is_some_and(|hidden| hidden.is_steep && !hidden.bases.is_empty());
        assert_eq!(found, is_steep, "{}", graph.print(product, &|v| format!("{v:?}")));
    }
}

#[test]
fn divisors_hide_where_they_are_smallest() {
    let mut graph = Graph::default();
    let [x, y] = [0, 1].map(|i| graph.variable(Variable::Velocity(i)));
    let [xx, yy] = [x, y].map(|node| graph.powi(node, 2));
    let square = graph.add(xx, yy);
    assert_eq!(hidden(&mut graph, &[square], &[], &[]), None);
    let found = hidden(&mut graph, &[square], &[square], &[]).unwrap();
    assert!(found.is_steep);
    assert_eq!(found.bases, [(square, 1)]);
}

#[test]
fn squares_in_functions_show_by_their_roots() {
    let mut graph = Graph::default();
    let x = graph.variable(Variable::Coordinate(0));
    let width = graph.variable(Variable::Parameter(0));
    let part = graph.div(x, width);
    let square = graph.powi(part, 2);
    let gaussian = graph.sum(Number::ZERO, &[(square, Number::integer(-4))]);
    let expected = graph.sum(Number::ZERO, &[(part, Number::integer(2))]);
    assert_eq!(argument_of(&mut graph, gaussian), expected);
    let cube = graph.powi(part, 3);
    let negative = graph.neg(cube);
    assert_eq!(argument_of(&mut graph, negative), cube);
}

#[test]
fn angles_in_roots_are_known() {
    let mut graph = Graph::default();
    let [x, y] = [0, 1].map(|i| graph.variable(Variable::Coordinate(i)));
    let speed = graph.variable(Variable::Parameter(0));
    let turned = graph.mul(x, speed);
    let [sine, other] = [turned, y].map(|angle| graph.unary(Unary::Sin, angle));
    let [square, plain] = [graph.powi(sine, 2), graph.powi(y, 2)];
    let inside = graph.add(square, plain);
    let root = graph.sqrt(inside);
    let force = graph.add(root, other);
    assert_eq!(hidden(&mut graph, &[force], &[], &[]).unwrap().angles, [turned]);
    assert_eq!(hidden(&mut graph, &[other], &[], &[]), None);
}
