//! Names for intermediate results: what the user called them.

use super::interpreter::Interpreter;
use super::value::{Turn, Value};
use crate::expr::{Node, NodeId};
use crate::model::Spin;
use crate::syntax::hygiene::written;

impl Interpreter<'_> {
    /// Suggests names for the nodes of a value: `end`, `end_x`, `joints_3_x`.
    pub fn hint(&mut self, value: &Value, name: &str) {
        let name = written(name);
        match value {
            Value::Scalar(node, ..) | Value::Rotation(Turn::Plane(node)) => self.hint_node(*node, name, ""),
            Value::Vector(nodes) | Value::Point(nodes) | Value::Translation(nodes) => {
                self.hint_components(nodes, name);
            }
            Value::PoseVelocity(linear, angular) => {
                self.hint_components(linear, name);
                self.hint_components(angular, &format!("{name}_angular"));
            }
            Value::Isometry(shift, _) => self.hint_components(shift, name),
            Value::Rotation(Turn::Space(rotation)) => {
                for (row, entries) in rotation.matrix.iter().enumerate() {
                    for (column, node) in entries.iter().enumerate() {
                        self.hint_node(*node, name, &format!("_{row}{column}"));
                    }
                }
            }
            Value::Matrix(matrix) => {
                for (index, node) in matrix.entries.iter().enumerate() {
                    let (row, column) = (index / matrix.columns, index % matrix.columns);
                    self.hint_node(*node, name, &format!("_{row}{column}"));
                }
            }
            Value::Quaternion(parts) => {
                for (part, suffix) in parts.iter().zip(["_w", "_i", "_j", "_k"]) {
                    self.hint_node(*part, name, suffix);
                }
            }
            Value::Twist(twist) => {
                self.hint_components(&twist.velocity, name);
                match &twist.spin {
                    Spin::Plane(rate) => self.hint_node(*rate, name, "_rate"),
                    Spin::Space { in_space, in_body } => {
                        self.hint_components(in_space, &format!("{name}_rate"));
                        self.hint_components(in_body, &format!("{name}_body_rate"));
                    }
                }
            }
            Value::Tuple(elements) | Value::Array(elements) => {
                for (index, element) in elements.iter().enumerate() {
                    self.hint(element, &format!("{name}_{index}"));
                }
            }
            Value::Unknown
            | Value::Unit
            | Value::Boolean(_)
            | Value::Choice(_)
            | Value::Integer(..)
            | Value::Parameter(_)
            | Value::Closure(_)
            | Value::Iterator(_)
            | Value::Range(..)
            | Value::Record(_) => {}
        }
    }

    fn hint_components(&mut self, nodes: &[NodeId], name: &str) {
        const AXES: [&str; 3] = ["_x", "_y", "_z"];
        for (index, node) in nodes.iter().enumerate() {
            match AXES.get(index) {
                Some(axis) if nodes.len() <= AXES.len() => self.hint_node(*node, name, axis),
                _ => self.hint_node(*node, name, &format!("_{index}")),
            }
        }
    }

    fn hint_node(&mut self, node: NodeId, name: &str, suffix: &str) {
        let named = matches!(self.model.graph.node(node), Node::Constant(_) | Node::Variable(_))
            || self.model.hints.name(node).is_some();
        if !named {
            self.model.hints.suggest(node, format!("{name}{suffix}"));
        }
    }
}
