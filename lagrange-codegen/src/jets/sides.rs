//! Roots and powers on the sides of switches.
//!
//! A base that is guarded where a branch is not taken, w s + 1 − w, has two forms: s, and the number 1.

use crate::calculus::substitute;
use crate::expr::{Binary, Dependence, Exponent, Graph, Node, NodeId, Unary, Variable};

/// The most switches of a base whose sides are all looked at.
const MOST: usize = 6;

/// A switch: its side, one or minus one, and its argument.
pub type Switch = (NodeId, NodeId);

/// Whether the base of a root is zero wherever the system is at rest, on a side that is taken there.
pub(super) fn rest_at_a_root(graph: &mut Graph, roots: &[NodeId], switches: &[Switch]) -> bool {
    if switches.is_empty() {
        return false;
    }
    let velocities: Vec<(NodeId, NodeId)> = {
        let zero = graph.zero();
        let is_velocity = |&id: &NodeId| matches!(graph.node(id), Node::Variable(Variable::Velocity(_)));
        graph.cone(roots.iter().copied()).into_iter().filter(is_velocity).map(|id| (id, zero)).collect()
    };
    let mut bases = Vec::new();
    for id in graph.cone(roots.iter().copied()) {
        match graph.node(id) {
            Node::Product(factors) => {
                let is_root = |(_, exponent): &&(NodeId, Exponent)| exponent.as_integer().is_none();
                bases.extend(factors.iter().filter(is_root).map(|&(base, _)| base));
            }
            &Node::Unary(Unary::Cbrt, base) | &Node::Binary(Binary::Powf | Binary::PowfLn, base, _) => {
                bases.push(base);
            }
            _ => {}
        }
    }
    bases.retain(|&base| graph.dependence(base).meets(Dependence::VELOCITIES));
    bases.dedup();
    bases.into_iter().any(|base| {
        let at_rest = |graph: &mut Graph, argument: NodeId| {
            let argument = substitute(graph, &[argument], &velocities)[0];
            match graph.as_constant(argument) {
                Some(number) if number.is_zero() => [true; 2],
                Some(number) => [!number.is_negative(), number.is_negative()],
                // A bound of a speed, as a parameter is, is not zero.
                None => [!graph.dependence(argument).is_fixed(); 2],
            }
        };
        let forms = forms(graph, base, switches, &at_rest).unwrap_or_default();
        forms.into_iter().any(|form| {
            let there = substitute(graph, &[form], &velocities)[0];
            graph.dependence(form).meets(Dependence::VELOCITIES) && graph.is_zero(there)
        })
    })
}

/// A node on all sides of the switches that it contains, of those sides, above and below zero, that may be
/// taken. `None` where these are too many.
pub(super) fn forms(
    graph: &mut Graph,
    node: NodeId,
    switches: &[Switch],
    may_be_taken: &dyn Fn(&mut Graph, NodeId) -> [bool; 2],
) -> Option<Vec<NodeId>> {
    let cone = graph.cone([node]);
    let own: Vec<Switch> = switches.iter().copied().filter(|(side, _)| cone.contains(side)).collect();
    if own.len() > MOST {
        return None;
    }
    let one = graph.one();
    let minus_one = graph.neg(one);
    let mut forms = vec![node];
    for (side, argument) in own {
        let taken = may_be_taken(graph, argument);
        let mut next = Vec::new();
        for (value, _) in [one, minus_one].into_iter().zip(taken).filter(|&(_, taken)| taken) {
            next.extend(substitute(graph, &forms, &[(side, value)]));
        }
        forms = next;
    }
    Some(forms)
}
