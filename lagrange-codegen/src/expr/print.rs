//! A compact text of an expression, for tests, facts and messages.

use super::graph::{Exponent, Graph, Node, NodeId, Variable};
use crate::number::Number;

impl Graph {
    /// The expression of a node, with a name for every variable. Meant for small expressions:
    /// shared parts are written out each time.
    pub fn print(&self, id: NodeId, name: &dyn Fn(Variable) -> String) -> String {
        match self.node(id) {
            Node::Constant(value) => value.to_string(),
            Node::Variable(variable) => name(*variable),
            Node::Sum { offset, terms } => {
                let mut text = String::new();
                for &(term, coefficient) in terms {
                    let negative = coefficient.is_negative();
                    match (text.is_empty(), negative) {
                        (true, true) => text.push('−'),
                        (true, false) => {}
                        (false, true) => text.push_str(" − "),
                        (false, false) => text.push_str(" + "),
                    }
                    if !coefficient.abs().is_one() {
                        text.push_str(&coefficient.abs().to_string());
                        text.push('·');
                    }
                    text.push_str(&self.print_factor(term, name));
                }
                if !offset.is_zero() {
                    text.push_str(if offset.is_negative() { " − " } else { " + " });
                    text.push_str(&offset.abs().to_string());
                }
                text
            }
            Node::Product(factors) => {
                let power = |&(factor, exponent): &(NodeId, Exponent)| {
                    let base = self.print_factor(factor, name);
                    match exponent.0 {
                        2 => base,
                        1 => format!("√{base}"),
                        _ => match exponent.as_integer() {
                            Some(power) => format!("{base}^{power}"),
                            None => format!("{base}^({}/2)", exponent.0),
                        },
                    }
                };
                factors.iter().map(power).collect::<Vec<_>>().join("·")
            }
            Node::Unary(function, argument) => {
                format!("{}({})", function.name(), self.print(*argument, name))
            }
            Node::Binary(function, first, second) => {
                format!("{}({}, {})", function.name(), self.print(*first, name), self.print(*second, name))
            }
        }
    }

    /// The number of nodes of the expression written out without sharing, saturating.
    pub fn tree_size(&self, root: NodeId) -> u64 {
        let mut sizes = vec![0_u64; self.len()];
        for id in self.cone([root]) {
            let mut size = 1_u64;
            self.operands(id, |operand| size = size.saturating_add(sizes[operand.index()]));
            sizes[id.index()] = size;
        }
        sizes[root.index()]
    }

    fn print_factor(&self, id: NodeId, name: &dyn Fn(Variable) -> String) -> String {
        let text = self.print(id, name);
        let composite = match self.node(id) {
            Node::Sum { .. } => true,
            Node::Constant(value) => *value < Number::ZERO,
            _ => false,
        };
        if composite { format!("({text})") } else { text }
    }
}
