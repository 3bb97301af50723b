//! Functions on the sides of switches.
//!
//! A base that is guarded where a branch is not taken, w s + 1 − w, has two forms: s, and the number 1.

use crate::calculus::substitute;
use crate::expr::{Dependence, Graph, NodeId};

/// The most switches of a base whose sides are all looked at.
const MOST: usize = 6;

/// A switch: its side, one or minus one, and its argument.
pub type Switch = (NodeId, NodeId);

/// Whether a node is zero wherever the system is at rest, on a side of its switches that is taken there. Such
/// is the speed in a drag force, whose root has a kink at rest. `direction` has the rate of each variable.
pub(super) fn rests_at_zero(
    graph: &mut Graph,
    node: NodeId,
    direction: &[(NodeId, NodeId)],
    switches: &[Switch],
) -> bool {
    if !graph.dependence(node).meets(Dependence::VELOCITIES) {
        return graph.is_zero(node);
    }
    let zero = graph.zero();
    let rates = direction.iter().map(|&(_, rate)| rate);
    let moving = rates.filter(|&rate| graph.dependence(rate).meets(Dependence::VELOCITIES));
    let rest: Vec<(NodeId, NodeId)> = moving.map(|velocity| (velocity, zero)).collect();
    let at_rest = |graph: &mut Graph, argument: NodeId| {
        let argument = substitute(graph, &[argument], &rest)[0];
        match graph.as_constant(argument) {
            Some(number) if number.is_zero() => [true; 2],
            Some(number) => [!number.is_negative(), number.is_negative()],
            // An argument of parameters alone is a bound of a speed. At rest the motion is below it, in a
            // branch that is assumed to have no kink, so neither side counts.
            None => [!graph.dependence(argument).is_fixed(); 2],
        }
    };
    let forms = forms(graph, node, switches, &at_rest).unwrap_or_else(|| vec![node]);
    forms.into_iter().any(|form| {
        let there = substitute(graph, &[form], &rest)[0];
        graph.dependence(form).meets(Dependence::VELOCITIES) && graph.is_zero(there)
    })
}

/// A node on each combination of sides of the switches that it contains. Of the argument of a switch
/// `may_be_taken` tells whether the sides above and below zero count. `None` if there are more than [`MOST`]
/// switches.
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
