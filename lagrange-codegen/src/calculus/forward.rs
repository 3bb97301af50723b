//! Forward accumulation.

use super::local;
use crate::expr::{Exponent, Graph, Node, NodeId};
use crate::number::Number;

/// Derivatives of the roots along a direction: `seeds` gives the rate of every node that
/// changes by itself (variables, usually); all other rates follow.
pub fn pushforward(graph: &mut Graph, roots: &[NodeId], seeds: &[(NodeId, NodeId)]) -> Vec<NodeId> {
    let mut rates: Vec<Option<NodeId>> = vec![None; graph.len()];
    let seeds: Vec<_> = seeds.iter().copied().filter(|&(_, rate)| !graph.is_zero(rate)).collect();
    let mut seeded = vec![false; graph.len()];
    for &(node, rate) in &seeds {
        rates[node.index()] = Some(rate);
        seeded[node.index()] = true;
    }
    for id in graph.cone(roots.iter().copied()) {
        if !seeded[id.index()] {
            rates[id.index()] = rate(graph, id, &rates);
        }
    }
    let zero = graph.zero();
    roots.iter().map(|root| rates[root.index()].unwrap_or(zero)).collect()
}

/// How many operations a sweep for each of some variables takes: one for each operand of a node and each of
/// the variables that it depends on.
pub fn forward_operations(graph: &Graph, roots: &[NodeId], variables: &[NodeId]) -> usize {
    let words = variables.len().div_ceil(64);
    let mut sets: Vec<Vec<u64>> = vec![Vec::new(); graph.len()];
    for (index, variable) in variables.iter().enumerate() {
        let set = &mut sets[variable.index()];
        set.resize(words, 0);
        set[index / 64] |= 1 << (index % 64);
    }
    let mut operations = 0;
    for id in graph.cone(roots.iter().copied()) {
        let mut union = sets[id.index()].clone();
        graph.operands(id, |operand| {
            let set = &sets[operand.index()];
            operations += set.iter().map(|word| word.count_ones() as usize).sum::<usize>();
            if !set.is_empty() {
                union.resize(words, 0);
            }
            union.iter_mut().zip(set).for_each(|(all, set)| *all |= set);
        });
        sets[id.index()] = union;
    }
    operations
}

/// The rate of one node from those of its operands; `None` stands for 0.
fn rate(graph: &mut Graph, id: NodeId, rates: &[Option<NodeId>]) -> Option<NodeId> {
    let mut moves = false;
    graph.operands(id, |operand| moves |= rates[operand.index()].is_some());
    if !moves {
        return None;
    }
    let rate = match graph.node(id).clone() {
        Node::Constant(_) | Node::Variable(_) => return None,
        Node::Sum { terms, .. } => {
            let moving: Vec<_> =
                terms.iter().filter_map(|&(term, c)| rates[term.index()].map(|rate| (rate, c))).collect();
            graph.sum(Number::ZERO, &moving)
        }
        Node::Product(factors) => {
            let mut terms = Vec::new();
            for (index, &(factor, exponent)) in factors.iter().enumerate() {
                let Some(rate) = rates[factor.index()] else { continue };
                let mut others = factors.clone();
                others[index].1 = Exponent(exponent.0 - 2);
                others.push((rate, Exponent(2)));
                terms.push((graph.product(&others), Number::halves(exponent.0)));
            }
            graph.sum(Number::ZERO, &terms)
        }
        Node::Unary(function, argument) => {
            let slope = local::unary(graph, function, argument, id);
            let rate = rates[argument.index()]?;
            graph.mul(slope, rate)
        }
        Node::Binary(function, first, second) => {
            let (by_first, by_second) = local::binary(graph, function, first, second);
            let mut terms = Vec::new();
            for (slope, operand) in [(by_first, first), (by_second, second)] {
                if let Some(rate) = rates[operand.index()] {
                    terms.push((graph.mul(slope, rate), Number::ONE));
                }
            }
            graph.sum(Number::ZERO, &terms)
        }
    };
    (!graph.is_zero(rate)).then_some(rate)
}
