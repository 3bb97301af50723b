//! Constraints: their values, and the coordinates that some of them are solved for.

use super::advice::counted;
use super::interpreter::Interpreter;
use super::places::nodes;
use super::shape::Shape;
use crate::diagnostics::catalogue;
use crate::model::{Constraint, ConstraintKind, Elimination};
use crate::syntax::body::Expr;
use crate::syntax::item::{Eliminate, Function, RoleKind};

impl<'a> Interpreter<'a> {
    /// Lowers one constraint function.
    pub fn constraint(&mut self, index: usize, kind: ConstraintKind, eliminate: Option<&'a Eliminate>) {
        let function: &'a Function = &self.item.functions[index];
        let shape = self.declared(function);
        let count = match &shape {
            Shape::Scalar => None,
            Shape::Vector(length @ 1..) => Some(*length),
            Shape::Array(element, length @ 1..) if **element == Shape::Scalar => Some(*length),
            // A function without a return type has had its message.
            _ if function.output.is_none() => return,
            _ => return self.wrong_return(function, &shape),
        };
        let coordinates = match eliminate {
            None => Vec::new(),
            Some(eliminate) => match self.eliminated(function, eliminate, count) {
                Some(coordinates) => coordinates,
                None => return,
            },
        };
        let Some(value) = self.result(index) else { return };
        let values = nodes(&value);
        if self.looks_into_self(&values) {
            return;
        }
        for (number, value) in values.into_iter().enumerate() {
            let constraint = Constraint {
                name: function.name.to_string(),
                index: count.map(|_| number),
                value,
                through: None,
                kind,
                origin: function.origin,
            };
            match eliminate {
                None => self.model.constraints.push(constraint),
                Some(eliminate) => self.model.eliminations.push(Elimination {
                    constraint,
                    coordinate: coordinates[number],
                    origin: eliminate
                        .coordinate
                        .as_ref()
                        .map_or(eliminate.origin, |(coordinate, _)| coordinate.origin),
                }),
            }
        }
    }

    /// The coordinate that each of `count` constraints is solved for, where it is named.
    fn eliminated(
        &mut self,
        function: &'a Function,
        eliminate: &'a Eliminate,
        count: Option<usize>,
    ) -> Option<Vec<Option<usize>>> {
        let constraints = count.unwrap_or(1);
        let Some((word, element)) = &eliminate.coordinate else { return Some(vec![None; constraints]) };
        if self.is_oriented(word) {
            self.report(word.origin, catalogue::eliminated_orientation(&word.name));
            return None;
        }
        let coordinates = self.coordinates_of(word, element.as_ref())?;
        if coordinates.len() == constraints {
            return Some(coordinates.into_iter().map(Some).collect());
        }
        let (have, want) = (counted(constraints, "constraint"), counted(coordinates.len(), "coordinate"));
        self.report(word.origin, catalogue::eliminated_count(&function.name, have, want));
        None
    }

    /// Lowers the rate of Baumgarte's stabilisation.
    pub fn baumgarte(&mut self, rate: &'a Expr) {
        let value = self.attribute(rate);
        let Some(node) = self.scalar(value, rate.origin) else { return };
        let constrains = |function: &Function| {
            let kind = function.role.as_ref().map(|role| &role.kind);
            matches!(kind, Some(RoleKind::Holonomic { eliminate: None } | RoleKind::Nonholonomic { .. }))
        };
        if !self.item.functions.iter().any(constrains) && !self.item.allows("no_effect") {
            self.report(rate.origin, catalogue::idle_baumgarte());
        } else if self.graph().as_constant(node).is_some_and(|rate| rate.is_negative() || rate.is_zero()) {
            self.report(rate.origin, catalogue::bad_baumgarte());
        }
        self.model.baumgarte = Some(node);
    }
}
