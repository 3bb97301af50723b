//! What stands on one side of an `if` need not be a number on the other.
//!
//! Both sides of an `if` are computed everywhere and multiplied by their weights w, one or zero. The root of
//! a negative number would remain not a number, whatever it is multiplied by. So functions that are not
//! defined everywhere, not differentiable, or overflow have another argument where their side is not taken:
//! √x becomes √(w x + 1 − w), with w of that side. The argument is exactly x where w is one. Derivatives and
//! series of it are numbers everywhere, too.
//!
//! That applies to what a description computes on that side. What it computes before the `if` has to be a
//! number everywhere, as its value may be needed everywhere.

use crate::calculus::rebuild;
use crate::collections::Lookup;
use crate::expr::{Binary, Exponent, Graph, Node, NodeId, Unary};
use crate::number::Number;

/// Which side of which `if` first made a node.
#[derive(Debug, Default)]
pub struct Sides {
    /// The sides that are being evaluated, outer ones first.
    open: Vec<u32>,
    /// The first node that was made there, and the innermost side at that time; zero for none.
    since: Vec<(usize, u32)>,
    /// The number of sides so far.
    count: u32,
}

impl Sides {
    /// A side that is not one of those so far.
    pub fn another(&mut self) -> u32 {
        self.count += 1;
        self.count
    }

    /// Begins a side, or goes on with it, where the graph has so many nodes.
    pub fn enter(&mut self, side: u32, nodes: usize) {
        self.open.push(side);
        self.since.push((nodes, side));
    }

    /// The sides that are being evaluated, outer ones first.
    pub fn open(&self) -> &[u32] {
        &self.open
    }

    /// Ends all sides but the outermost `depth`.
    pub fn leave(&mut self, depth: usize, nodes: usize) {
        self.open.truncate(depth);
        self.since.push((nodes, self.open.last().copied().unwrap_or(0)));
    }

    /// The present place in the history of sides.
    pub fn mark(&self) -> usize {
        self.since.len()
    }

    /// Counts what was made on sides since a mark as made outside of them.
    pub fn forget(&mut self, mark: usize) {
        let side = self.open.last().copied().unwrap_or(0);
        self.since[mark..].iter_mut().for_each(|(_, made_on)| *made_on = side);
    }

    /// The innermost side on which a node was first made; zero for none.
    fn of(&self, node: NodeId) -> u32 {
        let after = self.since.partition_point(|&(first, _)| first <= node.index());
        after.checked_sub(1).map_or(0, |last| self.since[last].1)
    }

    /// Values from a side that has ended, as numbers everywhere. The weight of that side is `weight` and that
    /// of the others `rest`. `open` are the sides in which both stand.
    pub fn guarded(
        &self,
        graph: &mut Graph,
        values: &[NodeId],
        [weight, rest]: [NodeId; 2],
        open: &[u32],
    ) -> Vec<NodeId> {
        let is_own = |node: NodeId| {
            let side = self.of(node);
            side != 0 && !open.contains(&side)
        };
        if values.iter().all(|&value| !is_own(value)) {
            return values.to_vec();
        }
        let mut guard = Guard { weight, rest, images: Lookup::default() };
        for node in graph.cone(values.iter().copied()) {
            if is_own(node) && !graph.dependence(node).is_fixed() {
                let image = guard.image(graph, node);
                if image != node {
                    guard.images.insert(node, image);
                }
            }
        }
        values.iter().map(|&value| guard.of(value)).collect()
    }
}

struct Guard {
    weight: NodeId,
    rest: NodeId,
    images: Lookup<NodeId, NodeId>,
}

impl Guard {
    fn of(&self, node: NodeId) -> NodeId {
        self.images.get(&node).copied().unwrap_or(node)
    }

    /// A node whose operands have their images.
    fn image(&self, graph: &mut Graph, node: NodeId) -> NodeId {
        match graph.node(node).clone() {
            Node::Product(factors) => {
                let factors: Vec<(NodeId, Exponent)> = factors
                    .into_iter()
                    .map(|(factor, power)| {
                        let image = self.of(factor);
                        let is_whole = power.as_integer().is_some_and(|power| power > 0);
                        (if is_whole { image } else { self.elsewhere(graph, image, Number::ONE) }, power)
                    })
                    .collect();
                graph.product(&factors)
            }
            Node::Unary(function, argument) => {
                let image = self.of(argument);
                let guarded = match function {
                    Unary::Asin
                    | Unary::Acos
                    | Unary::Atanh
                    | Unary::Ln1p
                    | Unary::Tan
                    | Unary::Sinh
                    | Unary::Cosh
                    | Unary::Exp
                    | Unary::ExpM1 => self.elsewhere(graph, image, Number::ZERO),
                    Unary::Ln | Unary::Cbrt => self.elsewhere(graph, image, Number::ONE),
                    Unary::Acosh => self.elsewhere(graph, image, Number::integer(2)),
                    // A switch that hangs on a guarded value rests where its side is not taken.
                    Unary::Abs | Unary::Signum | Unary::PositivePart | Unary::Step | Unary::Below
                        if image != argument =>
                    {
                        self.elsewhere(graph, image, Number::ONE)
                    }
                    Unary::Sin
                    | Unary::Cos
                    | Unary::Atan
                    | Unary::Tanh
                    | Unary::Sech
                    | Unary::Logistic
                    | Unary::Asinh
                    | Unary::Abs
                    | Unary::Signum
                    | Unary::PositivePart
                    | Unary::Step
                    | Unary::Below => image,
                };
                if guarded == argument { node } else { graph.unary(function, guarded) }
            }
            Node::Binary(function, first, second) => {
                let [first, second] = [first, second].map(|operand| self.of(operand));
                match function {
                    Binary::Atan2 => {
                        let first = self.elsewhere(graph, first, Number::ZERO);
                        let second = self.elsewhere(graph, second, Number::ONE);
                        graph.binary(function, first, second)
                    }
                    Binary::Powf | Binary::PowfLn | Binary::Pivot => {
                        let first = self.elsewhere(graph, first, Number::ONE);
                        graph.binary(function, first, second)
                    }
                }
            }
            Node::Constant(_) | Node::Variable(_) | Node::Sum { .. } => {
                rebuild(graph, node, |operand| self.of(operand))
            }
        }
    }

    /// A number where the side is taken, and a constant elsewhere.
    fn elsewhere(&self, graph: &mut Graph, node: NodeId, constant: Number) -> NodeId {
        if graph.dependence(node).is_fixed() {
            return node;
        }
        let here = graph.mul(self.weight, node);
        graph.sum(Number::ZERO, &[(here, Number::ONE), (self.rest, constant)])
    }
}
