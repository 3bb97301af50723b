//! Holonomic constraints as functions of the places that they are written through.
//!
//! The force of a constraint f on a particle is λ ∂f/∂r where f is a function of its position r. So each
//! constraint function runs once more, with variables in place of what the functions of particles and bodies
//! return. One on velocities that names the velocity ṙ of a place likewise acts there with λ ∂g/∂ṙ.

use std::rc::Rc;

use super::interpreter::Interpreter;
use super::lengths::Lengths;
use super::value::Value;
use crate::collections::Lookup;
use crate::expr::{NodeId, Variable};
use crate::model::{ConstraintKind, Place, Twist};
use crate::syntax::item::RoleKind;

impl Interpreter<'_> {
    /// Finds the places, and the constraints as functions of them.
    pub fn places(&mut self) {
        if self.reports > 0 || self.model.constraints.is_empty() && self.model.contacts.is_empty() {
            return;
        }
        let item = self.item;
        let mut stand_ins = Lookup::default();
        let true_rates = self.rates.clone();
        for (index, function) in item.functions.iter().enumerate() {
            let kind = function.role.as_ref().map(|role| &role.kind);
            if !matches!(kind, Some(RoleKind::Point { .. } | RoleKind::Body { .. })) {
                continue;
            }
            let Some(arguments) = self.role_arguments(index) else { continue };
            let (_, key) = self.shaped(index, arguments, &Lengths::new(), function.origin);
            let Some(value) = self.result(index) else { continue };
            let stand_in = self.stand_in(&value);
            let moving = item.velocities.iter().position(|velocity| velocity.function == index);
            let mut rates: Vec<NodeId> = Vec::new();
            if let Some(place) = moving
                && let Some(rate) = true_rates[place].clone()
            {
                self.rates[place] = Some(self.rate_stand_in(&rate, &mut rates));
            }
            let mut rates = rates.into_iter();
            for (number, (place, variables)) in
                self.placed(&function.name, &value).into_iter().zip(self.placed("", &stand_in)).enumerate()
            {
                let count = place.position.len();
                self.model.places.push(Place {
                    name: function.name.to_string(),
                    index: matches!(value, Value::Array(_)).then_some(number),
                    position: place.position,
                    variables: variables.position,
                    rates: rates.by_ref().take(count).collect(),
                    turns: matches!(kind, Some(RoleKind::Body { .. })),
                    origin: function.origin,
                });
            }
            stand_ins.insert(key, stand_in);
        }
        // The first evaluation has reported what is wrong.
        let memo = std::mem::replace(&mut self.memo, stand_ins);
        let hints = self.model.hints.clone();
        for (index, function) in item.functions.iter().enumerate() {
            let kind = function.role.as_ref().map(|role| &role.kind);
            let is_eliminated = matches!(kind, Some(RoleKind::Holonomic { eliminate: Some(_) }));
            let is_gap = matches!(kind, Some(RoleKind::Unilateral { .. }));
            if !item.is_kept_constraint(function) && !is_eliminated && !is_gap {
                continue;
            }
            let Some(value) = self.result(index) else { continue };
            // A function whose value is not known has none here. rustc says why.
            let gaps = self.model.contacts.iter_mut().map(|contact| &mut contact.constraint);
            let solved = self.model.eliminations.iter_mut().map(|elimination| &mut elimination.constraint);
            let own = (self.model.constraints.iter_mut().chain(gaps).chain(solved))
                .filter(|constraint| *constraint.name == *function.name);
            for (constraint, node) in own.zip(nodes(&value)) {
                let rates = self.model.places.iter().flat_map(|place| &place.rates);
                let through_rates = || {
                    self.model.graph.cone([node]).iter().any(|node| rates.clone().any(|rate| rate == node))
                };
                if constraint.kind == ConstraintKind::Holonomic || through_rates() {
                    constraint.through = Some(node);
                }
            }
        }
        self.rates = true_rates;
        self.memo = memo;
        self.model.hints = hints;
    }

    /// A value of the same form made of variables.
    fn stand_in(&mut self, value: &Value) -> Value {
        match value {
            Value::Scalar(..) => Value::scalar(self.position()),
            Value::Vector(nodes) => Value::Vector(nodes.iter().map(|_| self.position()).collect()),
            Value::Point(nodes) => Value::Point(nodes.iter().map(|_| self.position()).collect()),
            Value::Isometry(shift, turn) => {
                Value::Isometry(shift.iter().map(|_| self.position()).collect(), turn.clone())
            }
            Value::Array(elements) => {
                Value::Array(Rc::new(elements.iter().map(|element| self.stand_in(element)).collect()))
            }
            // A pose: the orientation stays a function of the coordinates.
            Value::Tuple(parts) => match parts.as_slice() {
                [shift, turn] => Value::Tuple(Rc::new(vec![self.stand_in(shift), turn.clone()])),
                _ => value.clone(),
            },
            other => other.clone(),
        }
    }

    /// The velocity of a place with variables in place of that of its position, which are noted.
    fn rate_stand_in(&mut self, rate: &Value, noted: &mut Vec<NodeId>) -> Value {
        let mut fresh = |this: &mut Self, count: usize| -> Vec<NodeId> {
            let variables: Vec<NodeId> = (0..count).map(|_| this.position()).collect();
            noted.extend(&variables);
            variables
        };
        match rate {
            Value::Scalar(..) => Value::scalar(fresh(self, 1)[0]),
            Value::Vector(nodes) => Value::Vector(fresh(self, nodes.len()).into()),
            Value::Twist(twist) => {
                let velocity = fresh(self, twist.dimension());
                Value::Twist(Rc::new(Twist { velocity, ..Twist::clone(twist) }))
            }
            Value::Array(elements) => {
                Value::array(elements.iter().map(|element| self.rate_stand_in(element, noted)).collect())
            }
            other => other.clone(),
        }
    }

    fn position(&mut self) -> NodeId {
        let variable = Variable::Position(self.positions);
        self.positions += 1;
        self.graph().variable(variable)
    }
}

/// All scalars of the value of a constraint function.
pub(super) fn nodes(value: &Value) -> Vec<NodeId> {
    match value {
        Value::Array(elements) => elements.iter().flat_map(|element| element.nodes().to_vec()).collect(),
        single => single.nodes().to_vec(),
    }
}
