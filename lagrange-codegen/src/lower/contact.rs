//! Contacts: gaps that do not become negative, and slip velocities with what limits their friction.

use super::advice::counted;
use super::interpreter::Interpreter;
use super::normal::{Actions, Limit};
use super::places::nodes;
use super::shape::Shape;
use super::value::Value;
use crate::diagnostics::{catalogue, physics};
use crate::expr::{Dependence, NodeId};
use crate::model::{Constraint, ConstraintKind, Contact, Law};
use crate::number::Number;
use crate::syntax::body::{Expr, ExprKind, Owner};
use crate::syntax::hygiene::written;
use crate::syntax::item::{Friction, Function, RoleKind};

impl<'a> Interpreter<'a> {
    /// Lowers a gap or an array of them.
    pub fn gap(&mut self, index: usize, restitution: Option<&'a Expr>, poisson: bool) {
        let function: &'a Function = &self.item.functions[index];
        let shape = self.declared(function);
        let count = match &shape {
            Shape::Scalar => None,
            Shape::Array(element, length @ 1..) if **element == Shape::Scalar => Some(*length),
            _ if function.output.is_none() => return,
            _ => return self.wrong_return(function, &shape),
        };
        let size = count.unwrap_or(1);
        let restitution = match restitution {
            None => {
                let zero = self.graph().zero();
                vec![zero; size]
            }
            Some(expr) => {
                let Some(values) = self.coefficients(expr, count, "restitution") else { return };
                let is_outside = |value: Number| value.is_negative() || value.value() > 1.0;
                self.refuse_constants(expr, &values, is_outside, || physics::restitution(&function.name));
                values
            }
        };
        let Some(values) = self.values_of(index) else { return };
        for (number, (value, restitution)) in values.into_iter().zip(restitution).enumerate() {
            let constraint = Constraint {
                name: function.name.to_string(),
                index: count.map(|_| number),
                value,
                through: None,
                kind: ConstraintKind::Holonomic,
                origin: function.origin,
            };
            self.model.contacts.push(Contact { constraint, law: Law::Unilateral { restitution, poisson } });
        }
    }

    /// Lowers all frictions, after the constraints and gaps that limit them.
    pub fn frictions(&mut self) {
        let item = self.item;
        let are_read = !self.diagnostics.has_errors();
        let mut actions = None;
        for (index, function) in item.functions.iter().enumerate() {
            if let Some(RoleKind::Friction(friction)) = function.role.as_ref().map(|role| &role.kind) {
                self.friction(index, friction, are_read, &mut actions);
            }
        }
    }

    /// Lowers a friction: a scalar slips in one direction, a vector in two, an array is several frictions.
    fn friction(
        &mut self,
        index: usize,
        friction: &'a Friction,
        are_read: bool,
        actions: &mut Option<Actions>,
    ) {
        let function: &'a Function = &self.item.functions[index];
        let shape = self.declared(function);
        let (count, directions) = match &shape {
            Shape::Scalar => (None, 1),
            Shape::Vector(2) => (Some(2), 2),
            Shape::Array(element, length @ 1..) if **element == Shape::Scalar => (Some(*length), 1),
            Shape::Array(element, length @ 1..) if **element == Shape::Vector(2) => {
                let count = counted(*length, "function");
                return self.refuse_return(function, catalogue::friction_vectors(&function.name, count));
            }
            _ if function.output.is_none() => return,
            _ => return self.wrong_return(function, &shape),
        };
        let frictions = if directions == 2 { None } else { count };
        let size = frictions.unwrap_or(1);
        let [own, held] = match friction.normal {
            Some(_) => ["coefficient", "static_coefficient"],
            None => ["limit", "static_limit"],
        };
        let Some(kinetic) = self.coefficients(&friction.kinetic, frictions, own) else { return };
        let negative = || physics::negative_friction(&function.name);
        self.refuse_constants(&friction.kinetic, &kinetic, Number::is_negative, negative);
        let fixed = match &friction.fixed {
            None => kinetic.clone(),
            Some(expr) => {
                let Some(fixed) = self.coefficients(expr, frictions, held) else { return };
                self.refuse_constants(expr, &fixed, Number::is_negative, negative);
                let graph = &mut self.model.graph;
                let excess: Vec<NodeId> =
                    fixed.iter().zip(&kinetic).map(|(&fixed, &kinetic)| graph.sub(fixed, kinetic)).collect();
                let less = || physics::static_below_kinetic(&function.name);
                self.refuse_constants(expr, &excess, Number::is_negative, less);
                fixed
            }
        };
        if friction.normal.is_some() {
            let exprs = [&friction.kinetic, friction.fixed.as_ref().unwrap_or(&friction.kinetic)];
            for (expr, values) in exprs.into_iter().zip([&kinetic, &fixed]) {
                let graph = &self.model.graph;
                if values.iter().any(|&value| graph.dependence(value).meets(Dependence::INPUTS)) {
                    self.diagnostics.at(expr.origin, physics::input_in_coefficient(&function.name));
                }
            }
        }
        let normals = match &friction.normal {
            None => vec![None; size],
            Some(normal) => {
                let actions = actions.get_or_insert_with(|| Actions::of(&mut self.model, are_read));
                match self.limits(function, normal, frictions, actions) {
                    Some(limits) => limits.into_iter().map(Some).collect(),
                    None => return,
                }
            }
        };
        // A reaction's Cartesian size is that of its multiplier times that of its gradient.
        let mut sized = |values: Vec<NodeId>| -> Vec<NodeId> {
            let graph = &mut self.model.graph;
            let size = |normal: &Option<Limit>| normal.and_then(|normal| normal.size);
            values
                .into_iter()
                .zip(&normals)
                .map(|(value, normal)| size(normal).map_or(value, |size| graph.mul(value, size)))
                .collect()
        };
        let (kinetic, fixed) = (sized(kinetic), sized(fixed));
        let Some(values) = self.values_of(index) else { return };
        let first = self.model.constraints.len() + self.model.contacts.len();
        for (number, value) in values.into_iter().enumerate() {
            let (own, pair) = match directions {
                2 => (0, Some(first + 1 - number)),
                _ => (number, None),
            };
            let constraint = Constraint {
                name: function.name.to_string(),
                index: count.map(|_| number),
                value,
                through: None,
                kind: ConstraintKind::Nonholonomic { chetaev: false },
                origin: function.origin,
            };
            let normal = normals[own].map(|limit| limit.normal);
            let law = Law::Friction { kinetic: kinetic[own], fixed: fixed[own], normal, pair };
            self.model.contacts.push(Contact { constraint, law });
        }
    }

    /// The scalars of a role function; `None` where they are not known, which is reported.
    fn values_of(&mut self, index: usize) -> Option<Vec<NodeId>> {
        let value = self.result(index)?;
        let values = nodes(&value);
        (!self.looks_into_self(&values)).then_some(values)
    }

    /// Reports an expression of an attribute whose value is a constant that cannot be right.
    fn refuse_constants(
        &mut self,
        expr: &Expr,
        values: &[NodeId],
        is_wrong: impl Fn(Number) -> bool,
        message: impl FnOnce() -> String,
    ) {
        if values.iter().any(|&value| self.model.graph.as_constant(value).is_some_and(&is_wrong)) {
            self.diagnostics.at(expr.origin, message());
        }
    }

    /// One number for each of `count` rows: an expression of `self`, or the name of a function of the state.
    fn coefficients(&mut self, expr: &'a Expr, count: Option<usize>, what: &str) -> Option<Vec<NodeId>> {
        let named = match &expr.kind {
            ExprKind::Path(path) if matches!(path.owner, Owner::None) => {
                self.item.functions.iter().position(|function| *function.name == *written(&path.last))
            }
            _ => None,
        };
        let value = match named {
            Some(index) => self.result(index)?,
            None => self.attribute(expr),
        };
        let values = self.distributed(expr, value, count, what)?;
        values
            .into_iter()
            .map(|value| match value {
                Value::Integer(value, _) => {
                    let number = Number::integer(value);
                    Some(self.graph().constant(number))
                }
                value => self.scalar(value, expr.origin),
            })
            .collect()
    }
}
