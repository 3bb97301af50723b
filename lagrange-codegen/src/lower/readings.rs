//! The values that the interpreter found for each function with a role or a velocity and for each argument of
//! a role. The runtime compares them with what the functions return.

use super::interpreter::Interpreter;
use super::value::{Turn, Value};
use crate::expr::{NodeId, Unary};
use crate::model::Reading;
use crate::syntax::item::RoleKind;

impl Interpreter<'_> {
    /// Collects the values of functions with a role or a velocity, which are memoised, and of arguments of
    /// roles.
    pub fn readings(&mut self) {
        if self.reports > 0 || self.item.allows("misread") {
            return;
        }
        let item = self.item;
        for (function, declared) in item.functions.iter().enumerate() {
            let Some(role) = &declared.role else {
                // A function without a role counts if its velocity is used.
                if item.velocities.iter().any(|velocity| velocity.function == function)
                    && let Some(value) = self.result(function)
                {
                    self.reading(function, None, &value);
                }
                continue;
            };
            if let Some(value) = self.result(function) {
                self.reading(function, None, &value);
            }
            let arguments = match &role.kind {
                RoleKind::Point { mass } => vec![("mass", mass)],
                RoleKind::Body { mass, inertia } => vec![("mass", mass), ("inertia", inertia)],
                _ => Vec::new(),
            };
            for (name, expr) in arguments {
                let value = self.attribute(expr);
                self.reading(function, Some(name), &value);
            }
        }
    }

    fn reading(&mut self, function: usize, argument: Option<&'static str>, value: &Value) {
        let mut nodes = Vec::new();
        // A bare field cannot be misread.
        if self.flatten(value, &mut nodes).is_some() && !nodes.is_empty() {
            self.model.readings.push(Reading { function, argument, nodes, sizes: Vec::new() });
        }
    }

    /// All numbers of a value in the order of the runtime's `Numbers`; `None` if one of them may be no
    /// number.
    fn flatten(&mut self, value: &Value, nodes: &mut Vec<NodeId>) -> Option<()> {
        match value {
            Value::Scalar(node, _) => nodes.push(*node),
            Value::Vector(list) | Value::Point(list) | Value::Translation(list) => nodes.extend(list.iter()),
            Value::Matrix(matrix) => {
                for column in 0..matrix.columns {
                    nodes.extend((0..matrix.rows).map(|row| matrix.at(row, column)));
                }
            }
            Value::Rotation(Turn::Plane(angle)) => {
                nodes.extend(
                    [Unary::Cos, Unary::Sin].map(|function| self.model.graph.unary(function, *angle)),
                );
            }
            Value::Rotation(Turn::Space(rotation)) => nodes.extend(rotation.matrix.as_flattened()),
            Value::Isometry(shift, turn) => {
                nodes.extend(shift.iter());
                self.flatten(&Value::Rotation(turn.clone()), nodes)?;
            }
            Value::PoseVelocity(linear, angular) => nodes.extend(linear.iter().chain(angular.iter())),
            Value::Tuple(elements) if elements.len() != 2 => return None,
            Value::Tuple(elements) | Value::Array(elements) => {
                for element in elements.iter() {
                    self.flatten(element, nodes)?;
                }
            }
            Value::Unknown
            | Value::Unit
            | Value::Boolean(_)
            | Value::Choice(_)
            | Value::Integer(..)
            | Value::Parameter(_)
            | Value::Quaternion(_)
            | Value::Twist(_)
            | Value::Closure(_)
            | Value::Iterator(_)
            | Value::Range(..)
            | Value::Record(_) => return None,
        }
        Some(())
    }
}
