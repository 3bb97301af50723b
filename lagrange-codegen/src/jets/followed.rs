//! Functions of the state that are followed along the motion, as outputs of its recurrences.

use super::Scope;
use super::auxiliary::Rewriter;
use crate::expr::{Dependence, Graph, NodeId};
use crate::mechanics::Equations;

/// How a function is known along the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// It does not change.
    Constant,
    /// It is the function of this index that the series follows.
    Series(usize),
    /// It has no series.
    Unknown,
}

/// The functions that are followed along the motion, each once, and how each function is known.
pub(super) fn of(graph: &mut Graph, equations: &Equations, scope: Scope) -> (Vec<NodeId>, Vec<Along>) {
    let moving = Dependence::COORDINATES.union(Dependence::VELOCITIES).union(Dependence::TIME);
    let mut followed: Vec<NodeId> = Vec::new();
    let along = equations.followed.iter().map(|&function| {
        if !graph.dependence(function).meets(moving) {
            return Along::Constant;
        }
        if let Some(index) = followed.iter().position(|&known| known == function) {
            return Along::Series(index);
        }
        if Rewriter::new(graph, scope).polynomials(&[function]).is_err() {
            return Along::Unknown;
        }
        followed.push(function);
        Along::Series(followed.len() - 1)
    });
    let along = along.collect();
    (followed, along)
}
