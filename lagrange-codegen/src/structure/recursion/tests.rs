//! Recursions against dense matrices, in exact rationals.

use std::collections::BTreeMap;

use super::*;
use crate::expr::Variable;

/// Pseudo-random small whole numbers.
struct Noise(u64);

impl Noise {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }

    /// A whole number from −2 to 2, seldom 0.
    fn whole(&mut self) -> Number {
        Number::integer([-2, -1, 1, 2, 1, -1, 0][self.below(7) as usize])
    }
}

/// A random form whose matrix is positive definite. It has squares of all velocities and of some definitions,
/// and products of two unknowns beside squares of both that outweigh them.
fn form(graph: &mut Graph, noise: &mut Noise, velocities: usize, defined: usize) -> Quadratic {
    let mut definitions = Vec::new();
    for index in 0..defined {
        let count = velocities + index;
        let mut terms: BTreeMap<Unknown, NodeId> = BTreeMap::new();
        for _ in 0..2 + noise.below(2) {
            let number = noise.whole();
            if !number.is_zero() {
                terms.insert(noise.below(count as u64) as usize, graph.constant(number));
            }
        }
        definitions.push(terms.into_iter().collect());
    }
    let unknowns = velocities + defined;
    let mut numbers: BTreeMap<(Unknown, Unknown), Number> = BTreeMap::new();
    let mut add = |a: Unknown, b: Unknown, number: Number| {
        let entry = numbers.entry((a.max(b), a.min(b))).or_insert(Number::ZERO);
        *entry = *entry + number;
    };
    for x in 0..unknowns {
        add(x, x, Number::integer(i128::from(noise.below(2)) + i128::from(x < velocities)));
    }
    for _ in 0..noise.below(4) {
        let (a, b) = (noise.below(unknowns as u64) as usize, noise.below(unknowns as u64) as usize);
        if a != b {
            add(a, a, Number::ONE);
            add(b, b, Number::ONE);
            add(a, b, noise.whole().powi(1).unwrap_or(Number::ONE) * Number::HALF);
        }
    }
    numbers.retain(|_, number| !number.is_zero());
    let entries = numbers.into_iter().map(|(index, number)| (index, graph.constant(number))).collect();
    Quadratic { velocities, definitions, entries }
}

/// M of a form of constants, all definitions substituted.
fn formed(graph: &Graph, form: &Quadratic) -> Vec<Vec<Number>> {
    let number = |node: NodeId| graph.as_constant(node).expect("all is constant");
    let count = form.velocities;
    let mut rows: Vec<Vec<Number>> = (0..count)
        .map(|i| (0..count).map(|j| if i == j { Number::ONE } else { Number::ZERO }).collect())
        .collect();
    for definition in &form.definitions {
        let mut row = vec![Number::ZERO; count];
        for &(x, c) in definition {
            for (sum, &entry) in row.iter_mut().zip(&rows[x]) {
                *sum = *sum + number(c) * entry;
            }
        }
        rows.push(row);
    }
    let mut mass = vec![vec![Number::ZERO; count]; count];
    for (&(a, b), &entry) in &form.entries {
        for i in 0..count {
            for j in 0..count {
                let mut share = number(entry) * rows[a][i] * rows[b][j];
                if a != b {
                    share = share + number(entry) * rows[b][i] * rows[a][j];
                }
                mass[i][j] = mass[i][j] + share;
            }
        }
    }
    mass
}

#[test]
fn a_recursion_solves_what_a_dense_matrix_does_in_exact_rationals() {
    let (mut noise, mut exact) = (Noise(1), 0);
    for case in 0..600 {
        let mut graph = Graph::new();
        let (velocities, defined) = (1 + noise.below(5) as usize, noise.below(7) as usize);
        let form = form(&mut graph, &mut noise, velocities, defined);
        let mass = formed(&graph, &form);
        let right: Vec<Number> = (0..velocities).map(|_| noise.whole()).collect();
        let nodes: Vec<NodeId> = right.iter().map(|&number| graph.constant(number)).collect();
        let (recursion, pivots) =
            Recursion::of(&mut graph, form, usize::MAX).expect("every velocity has inertia");
        assert_eq!(pivots.len(), velocities);
        let solution: Vec<Number> = recursion
            .solve(&mut graph, &nodes)
            .into_iter()
            .map(|node| graph.as_constant(node).expect("a constant"))
            .collect();
        if !solution.iter().all(|number| matches!(number, Number::Ratio(..))) {
            continue;
        }
        exact += 1;
        for (row, &wanted) in mass.iter().zip(&right) {
            let sum = row.iter().zip(&solution).fold(Number::ZERO, |sum, (&m, &x)| sum + m * x);
            assert_eq!(sum, wanted, "case {case}: {mass:?} · {solution:?}");
        }
        for pivot in pivots {
            assert!(!graph.as_constant(pivot.pivot).expect("a constant").is_negative());
        }
    }
    assert!(exact > 500, "{exact}");
}

#[test]
fn places_are_shared_and_never_overwritten() {
    let mut noise = Noise(7);
    for _ in 0..200 {
        let mut graph = Graph::new();
        let form = form(&mut graph, &mut noise, 4, 8);
        let (recursion, _) = Recursion::of(&mut graph, form, usize::MAX).expect("every velocity has inertia");
        let (indices, count) = recursion.indices();
        let mut owner: Vec<Option<usize>> = vec![None; count];
        for step in &recursion.steps {
            for unknown in step.terms().iter().map(|&(x, _)| x).filter(|&x| x >= 4) {
                let owner = &mut owner[indices[unknown]];
                assert!(owner.is_none_or(|owner| owner == unknown));
                *owner = Some(unknown);
            }
            if step.unknown() >= 4 {
                assert_eq!(owner[indices[step.unknown()]].take(), Some(step.unknown()));
            }
        }
    }
}

/// The kinetic energy of a planar chain of unit masses and lengths.
fn chain(graph: &mut Graph, links: usize) -> NodeId {
    let mut squares = Vec::new();
    let mut end = [graph.zero(); 2];
    for i in 0..links as u32 {
        let (q, v) = (graph.variable(Variable::Coordinate(i)), graph.variable(Variable::Velocity(i)));
        let waves = [crate::expr::Unary::Cos, crate::expr::Unary::Sin];
        for (end, wave) in end.iter_mut().zip(waves) {
            let wave = graph.unary(wave, q);
            let share = graph.mul(wave, v);
            *end = graph.add(*end, share);
            squares.push((graph.powi(*end, 2), Number::HALF));
        }
    }
    graph.sum(Number::ZERO, &squares)
}

#[test]
fn a_chain_costs_in_proportion_to_its_links() {
    let count = |links: usize| {
        let mut graph = Graph::new();
        let energy = chain(&mut graph, links);
        let block: Vec<usize> = (0..links).collect();
        let form = Quadratic::of(&mut graph, energy, &block).expect("it is quadratic");
        assert_eq!(form.definitions.len(), 2 * (links - 1));
        let (recursion, _) = Recursion::of(&mut graph, form, usize::MAX).expect("every velocity has inertia");
        // A link depends on both components of the joint before it, and on nothing else.
        assert!(recursion.steps.iter().all(|step| step.terms().len() <= 2));
        // Beside the velocities, two numbers are in use at a time, and the two that follow them.
        assert!(recursion.indices().1 <= links + 4);
        let right: Vec<NodeId> = (0..links as u32).map(|i| graph.variable(Variable::Input(i))).collect();
        let solution = recursion.solve(&mut graph, &right);
        crate::simplify::cost::cost(&graph, &solution)
    };
    let (ten, twenty, forty) = (count(10), count(20), count(40));
    assert_eq!(forty - twenty, 2 * (twenty - ten));
}

#[test]
fn energies_without_a_recursion_have_none() {
    let mut graph = Graph::new();
    let [v, w] = [0, 1].map(|i| graph.variable(Variable::Velocity(i)));
    let cube = graph.powi(v, 3);
    assert!(Quadratic::of(&mut graph, cube, &[0]).is_none());
    let root = graph.sqrt(v);
    assert!(Quadratic::of(&mut graph, root, &[0]).is_none());
    let product = graph.mul(v, w);
    let form = Quadratic::of(&mut graph, product, &[0, 1]).expect("it is quadratic");
    assert!(Recursion::of(&mut graph, form, usize::MAX).is_none(), "no velocity has inertia of its own");
    let energy = chain(&mut graph, 4);
    let form = Quadratic::of(&mut graph, energy, &[0, 1, 2, 3]).expect("it is quadratic");
    assert!(Recursion::of(&mut graph, form, 8).is_none(), "more products than are worth it");
}
