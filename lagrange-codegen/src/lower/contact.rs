//! Contacts: gaps that stay open or closed, and slip velocities with what limits their friction.

use super::advice::counted;
use super::interpreter::Interpreter;
use super::places::nodes;
use super::shape::Shape;
use super::value::Value;
use crate::diagnostics::catalogue;
use crate::expr::NodeId;
use crate::kinematics::acting::acting;
use crate::model::{Constraint, ConstraintKind, Contact, Law};
use crate::number::Number;
use crate::syntax::body::{Expr, ExprKind, Name, Owner, Word};
use crate::syntax::hygiene::written;
use crate::syntax::item::{Friction, Function, RoleKind};

/// A reaction that limits friction.
#[derive(Clone, Copy, Debug)]
struct Normal {
    /// Its row among all constraints and then all contacts.
    row: usize,
    /// The Cartesian size of the force of a unit multiplier, where its form tells that.
    size: Option<NodeId>,
}

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
            Some(expr) => match self.coefficients(expr, count, "restitution") {
                Some(values) => values,
                None => return,
            },
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

    /// Lowers a friction: a scalar slips in one direction, a vector in two, an array is several frictions.
    pub fn friction(&mut self, index: usize, friction: &'a Friction) {
        let function: &'a Function = &self.item.functions[index];
        let shape = self.declared(function);
        let (count, directions) = match &shape {
            Shape::Scalar => (None, 1),
            Shape::Vector(2) => (Some(2), 2),
            Shape::Array(element, length @ 1..) if **element == Shape::Scalar => (Some(*length), 1),
            _ if function.output.is_none() => return,
            _ => return self.wrong_return(function, &shape),
        };
        let frictions = if directions == 2 { None } else { count };
        let size = frictions.unwrap_or(1);
        let Some(kinetic) = self.coefficients(&friction.kinetic, frictions, "coefficient") else { return };
        let fixed = match &friction.fixed {
            None => kinetic.clone(),
            Some(expr) => match self.coefficients(expr, frictions, "static_coefficient") {
                Some(values) => values,
                None => return,
            },
        };
        let normals = match &friction.normal {
            None => vec![None; size],
            Some((word, element)) => match self.normals(function, word, element.as_ref(), frictions) {
                Some(rows) => rows.into_iter().map(Some).collect(),
                None => return,
            },
        };
        // The Cartesian size of a reaction is that of its multiplier times that of the gradient.
        let mut sized = |values: Vec<NodeId>| -> Vec<NodeId> {
            let graph = &mut self.model.graph;
            let size = |normal: &Option<Normal>| normal.and_then(|normal| normal.size);
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
            let normal = normals[own].map(|normal| normal.row);
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
                    let number = Number::Ratio(value, 1);
                    Some(self.graph().constant(number))
                }
                value => self.scalar(value, expr.origin),
            })
            .collect()
    }

    /// The rows that a normal names, one for each friction.
    fn normals(
        &mut self,
        function: &'a Function,
        word: &'a Word,
        element: Option<&'a Expr>,
        count: Option<usize>,
    ) -> Option<Vec<Normal>> {
        if let Some(normal) = self.reaction_on(word, element) {
            return normal.map(|normal| vec![normal; count.unwrap_or(1)]);
        }
        let named = |constraint: &Constraint| *constraint.name == *word.name;
        let contacts =
            self.model.contacts.iter().filter(|contact| matches!(contact.law, Law::Unilateral { .. }));
        let held = self.model.constraints.len();
        let rows: Vec<(usize, Option<usize>)> = (self.model.constraints.iter().enumerate())
            .filter(|(_, constraint)| constraint.kind == ConstraintKind::Holonomic)
            .chain(contacts.enumerate().map(|(row, contact)| (held + row, &contact.constraint)))
            .filter(|(_, constraint)| named(constraint))
            .map(|(row, constraint)| (row, constraint.index))
            .collect();
        if rows.is_empty() {
            let names: Vec<Name> = self
                .item
                .functions
                .iter()
                .filter(|other| self.has_reaction(other))
                .map(|f| f.name.clone())
                .collect();
            let near = self.near(&word.name, &names);
            self.report(word.origin, catalogue::friction_on_unknown(&word.name, near));
            return None;
        }
        let wanted = count.unwrap_or(1);
        let rows = match element {
            Some(element) => {
                let index = self.length(element)?;
                match rows.iter().find(|(_, own)| *own == Some(index)) {
                    Some(&(row, _)) => vec![row; wanted],
                    None => {
                        let valid = super::advice::valid_indices(rows.len());
                        self.report(element.origin, catalogue::index_out_of_range(index, valid));
                        return None;
                    }
                }
            }
            None if rows.len() == 1 => vec![rows[0].0; wanted],
            None => rows.into_iter().map(|(row, _)| row).collect(),
        };
        if rows.len() != wanted {
            let (have, want) = (counted(wanted, "friction"), counted(rows.len(), "reaction"));
            self.report(word.origin, catalogue::friction_count(&function.name, have, want));
            return None;
        }
        let contacts = self.model.contacts.iter().map(|contact| &contact.constraint);
        let all: Vec<Constraint> = self.model.constraints.iter().chain(contacts).cloned().collect();
        Some(rows.into_iter().map(|row| Normal { row, size: self.size_of(&all[row]) }).collect())
    }

    /// The reaction on a particle or a body; `None` where the name is that of something else, and
    /// `Some(None)` where no reaction, or more than one, acts there, which is reported.
    fn reaction_on(&mut self, word: &'a Word, element: Option<&'a Expr>) -> Option<Option<Normal>> {
        let is_place = |function: &&Function| {
            let kind = function.role.as_ref().map(|role| &role.kind);
            function.name == word.name && matches!(kind, Some(RoleKind::Point { .. } | RoleKind::Body { .. }))
        };
        self.item.functions.iter().find(is_place)?;
        let index = match element {
            Some(element) => match self.length(element) {
                Some(index) => Some(index),
                None => return Some(None),
            },
            None => None,
        };
        let places = &self.model.places;
        let Some(place) = places.iter().position(|place| *place.name == *word.name && place.index == index)
        else {
            self.report(
                word.origin,
                catalogue::friction_on_place(&word.name, counted(0, "holonomic constraint")),
            );
            return Some(None);
        };
        let mut found = Vec::new();
        for (row, constraint) in self.model.constraints.clone().iter().enumerate() {
            let Some(acting) = acting(&mut self.model, constraint).into_iter().nth(place) else { continue };
            if acting.is_any(&self.model.graph) {
                found.push((row, constraint.written(), acting));
            }
        }
        if let [(row, name, acting)] = found.as_slice() {
            if !acting.is_whole {
                self.report(word.origin, catalogue::friction_by_form(name, &word.name));
                return Some(None);
            }
            let size = acting.size(&mut self.model.graph);
            return Some(Some(Normal { row: *row, size: Some(size) }));
        }
        let count = counted(found.len(), "holonomic constraint");
        self.report(word.origin, catalogue::friction_on_place(&word.name, count));
        Some(None)
    }

    /// The Cartesian size of a unit reaction: that of its force on the first place where it is known. A
    /// reaction between two places has the same size on both.
    fn size_of(&mut self, constraint: &Constraint) -> Option<NodeId> {
        let on_places = acting(&mut self.model, constraint);
        let graph = &mut self.model.graph;
        on_places.iter().find(|on| on.is_whole && on.is_any(graph)).map(|on| on.size(graph))
    }

    fn has_reaction(&self, function: &Function) -> bool {
        let kind = function.role.as_ref().map(|role| &role.kind);
        matches!(kind, Some(RoleKind::Unilateral { .. } | RoleKind::Holonomic { eliminate: None }))
    }
}
