//! Velocities: `self.hub_velocity(q, v)` is the rate of what `hub` returns along the motion.

use std::rc::Rc;

use super::advice::argument_count;
use super::interpreter::Interpreter;
use super::shape::Shape;
use super::value::{Turn, Value};
use crate::calculus::{pushforward, substitute};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::{NodeId, Unary, Variable};
use crate::kinematics::{body_rate, space_rate, transposed_times, turning_direction};
use crate::model::{Rates, Spin, Twist, Velocity};
use crate::syntax::body::Word;
use crate::syntax::item::Argument;

/// The fields of a body's velocity.
const FIELDS: [&str; 5] =
    ["position", "velocity", "velocity_in_body", "angular_velocity", "angular_velocity_in_body"];

impl<'a> Interpreter<'a> {
    /// The value of a call such as `self.hub_velocity(q, v)`; `None` if no velocity has that name.
    pub fn velocity_call(
        &mut self,
        word: &Word,
        arguments: &[Value],
        with_self: bool,
        origin: Origin,
    ) -> Option<Value> {
        let item = self.item;
        let place = item.velocities.iter().position(|velocity| velocity.name == word.name)?;
        let function = &item.functions[item.velocities[place].function];
        if function.receiver != with_self {
            let message = match with_self {
                true => catalogue::not_a_method(&word.name),
                false => catalogue::needs_self(&word.name),
            };
            return Some(self.refuse(word.origin, message));
        }
        let Some(value) = self.velocity(place) else { return Some(Value::Unknown) };
        let expected = function.velocity_arguments().unwrap_or_default();
        if expected.len() != arguments.len() {
            let message = argument_count(&word.name, expected.len(), arguments.len());
            return Some(self.refuse(origin, message));
        }
        let mut at = self.graph().variable(Variable::Time);
        for (argument, expected) in arguments.iter().zip(expected) {
            let shape = match expected {
                Argument::Record(record) => Shape::Record(record),
                Argument::Time => Shape::Scalar,
            };
            match self.coerce(argument.clone(), &shape, origin) {
                Value::Unknown => return Some(Value::Unknown),
                Value::Scalar(time, _) => at = time,
                _ => {}
            }
        }
        Some(self.at_time(value, at))
    }

    /// The velocities that are emitted as functions of their own.
    pub fn velocities(&mut self) {
        let item = self.item;
        for (place, velocity) in item.velocities.iter().enumerate() {
            let Some(value) = self.velocity(place) else { continue };
            if let Some(rates) = rates_of(&value) {
                self.model.velocities.push(Velocity {
                    function: velocity.function,
                    name: velocity.name.to_string(),
                    rates,
                });
            }
        }
    }

    /// The rate of what a function returns, derived once; `None` after a reported mistake.
    fn velocity(&mut self, place: usize) -> Option<Value> {
        if let Some(known) = &self.rates[place] {
            return (!known.is_unknown()).then(|| known.clone());
        }
        let velocity = &self.item.velocities[place];
        let function = &self.item.functions[velocity.function];
        let value = match function.velocity_arguments() {
            Some(_) => {
                let value = match self.role_arguments(velocity.function) {
                    Some(arguments) => self.call(velocity.function, arguments, velocity.origin),
                    None => Value::Unknown,
                };
                match self.rate(&value) {
                    Some(rate) => rate,
                    None => {
                        let message = catalogue::no_velocity(&function.name, value.describe());
                        self.refuse(velocity.origin, message)
                    }
                }
            }
            None => self.refuse(velocity.origin, catalogue::velocity_of_more(&function.name)),
        };
        self.hint(&value, &velocity.name);
        self.rates[place] = Some(value.clone());
        (!value.is_unknown()).then_some(value)
    }

    /// The rate of a value along the motion; `None` if it has none.
    fn rate(&mut self, value: &Value) -> Option<Value> {
        let rate = match value {
            Value::Unknown => Value::Unknown,
            Value::Scalar(node, _) => Value::scalar(self.pushed(&[*node])[0]),
            Value::Vector(nodes) | Value::Point(nodes) | Value::Translation(nodes) => {
                Value::Vector(self.pushed(nodes).into())
            }
            Value::Matrix(matrix) => Value::matrix(matrix.rows, matrix.columns, self.pushed(&matrix.entries)),
            Value::Rotation(turn) => {
                let zero = self.graph().zero();
                self.twist(&vec![zero; turn.dimension()], turn)
            }
            Value::Isometry(shift, turn) => self.twist(shift, turn),
            Value::Array(elements) => Value::array(self.all_rates(elements)?),
            Value::Tuple(elements) => match elements.as_slice() {
                // The forms in which a body may be given.
                [Value::Vector(shift) | Value::Point(shift), Value::Scalar(angle, _)] if shift.len() == 2 => {
                    self.twist(shift, &Turn::Plane(*angle))
                }
                [Value::Vector(shift) | Value::Point(shift), Value::Rotation(turn)]
                    if shift.len() == turn.dimension() =>
                {
                    self.twist(shift, turn)
                }
                elements => Value::tuple(self.all_rates(elements)?),
            },
            Value::Unit
            | Value::Boolean(_)
            | Value::Choice(_)
            | Value::Integer(..)
            | Value::Parameter(_)
            | Value::Quaternion(_)
            | Value::Twist(_)
            | Value::PoseVelocity(..)
            | Value::Closure(_)
            | Value::Iterator(_)
            | Value::Range(..)
            | Value::Record(_) => return None,
        };
        Some(rate)
    }

    fn all_rates(&mut self, elements: &[Value]) -> Option<Vec<Value>> {
        elements.iter().map(|element| self.rate(element)).collect()
    }

    fn pushed(&mut self, nodes: &[NodeId]) -> Vec<NodeId> {
        let count = self.model.coordinates.len();
        let graph = &mut self.model.graph;
        let direction = turning_direction(graph, count, &self.model.turning);
        pushforward(graph, nodes, &direction)
    }

    fn twist(&mut self, position: &[NodeId], turn: &Turn) -> Value {
        let velocity = self.pushed(position);
        let count = self.model.coordinates.len();
        let (spin, velocity_in_body) = match turn {
            Turn::Plane(angle) => {
                let rate = self.pushed(&[*angle])[0];
                let graph = self.graph();
                let (sine, cosine) = (graph.unary(Unary::Sin, *angle), graph.unary(Unary::Cos, *angle));
                let along = self.dot(&[cosine, sine], &velocity);
                let minus_sine = self.graph().neg(sine);
                let across = self.dot(&[minus_sine, cosine], &velocity);
                (Spin::Plane(rate), vec![along, across])
            }
            Turn::Space(rotation) => {
                let graph = &mut self.model.graph;
                let direction = turning_direction(graph, count, &self.model.turning);
                let in_body = body_rate(graph, rotation, &direction);
                let in_space = space_rate(graph, rotation, &direction);
                let turned =
                    transposed_times(graph, &rotation.matrix, &[velocity[0], velocity[1], velocity[2]]);
                (Spin::Space { in_space, in_body }, turned.to_vec())
            }
        };
        Value::Twist(Rc::new(Twist { position: position.to_vec(), velocity, velocity_in_body, spin }))
    }

    /// A value at another time.
    fn at_time(&mut self, value: Value, at: NodeId) -> Value {
        let time = self.graph().variable(Variable::Time);
        if time == at {
            return value;
        }
        self.replaced(&value, time, at)
    }

    /// A rate with a node replaced.
    fn replaced(&mut self, value: &Value, from: NodeId, to: NodeId) -> Value {
        let each = |this: &mut Self, nodes: &[NodeId]| substitute(this.graph(), nodes, &[(from, to)]);
        let all = |this: &mut Self, elements: &[Value]| -> Vec<Value> {
            elements.iter().map(|element| this.replaced(element, from, to)).collect()
        };
        match value {
            Value::Scalar(node, _) => Value::scalar(each(self, &[*node])[0]),
            Value::Vector(nodes) => Value::Vector(each(self, nodes).into()),
            Value::Matrix(matrix) => Value::matrix(matrix.rows, matrix.columns, each(self, &matrix.entries)),
            Value::Twist(twist) => {
                let mut twist = Twist::clone(twist);
                twist.each(&mut |node| *node = each(self, &[*node])[0]);
                Value::Twist(Rc::new(twist))
            }
            Value::Array(elements) => Value::array(all(self, elements)),
            Value::Tuple(elements) => Value::tuple(all(self, elements)),
            other => other.clone(),
        }
    }

    /// `twist.name`.
    pub fn twist_field(&mut self, twist: &Twist, word: &Word) -> Value {
        let vector = |nodes: &[NodeId]| Value::Vector(nodes.into());
        match (&*word.name, &twist.spin) {
            ("position", _) => vector(&twist.position),
            ("velocity", _) => vector(&twist.velocity),
            ("velocity_in_body", _) => vector(&twist.velocity_in_body),
            ("angular_velocity", Spin::Plane(rate)) => Value::scalar(*rate),
            ("angular_velocity", Spin::Space { in_space, .. }) => vector(in_space),
            ("angular_velocity_in_body", Spin::Space { in_body, .. }) => vector(in_body),
            _ => {
                let value = Value::Twist(Rc::new(twist.clone())).describe();
                self.refuse(word.origin, catalogue::unknown_field(value, &word.name))
            }
        }
    }

    /// Methods of velocities of bodies.
    pub fn twist_method(
        &mut self,
        twist: Rc<Twist>,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        if &*word.name != "at" {
            if FIELDS.contains(&&*word.name) {
                return self.refuse(word.origin, catalogue::field_called(&word.name));
            }
            return self.unknown_method(&Value::Twist(twist), word);
        }
        let Some([place]) = self.exactly(word, arguments, origin) else { return Value::Unknown };
        let Some(place) = self.vector(place, twist.dimension(), origin) else { return Value::Unknown };
        let graph = self.graph();
        let arm: Vec<NodeId> = place.iter().zip(&twist.position).map(|(&p, &r)| graph.sub(p, r)).collect();
        let turned: Rc<[NodeId]> = match &twist.spin {
            Spin::Plane(rate) => {
                let turned = graph.mul(*rate, arm[1]);
                [graph.neg(turned), graph.mul(*rate, arm[0])].into()
            }
            Spin::Space { in_space, .. } => self.cross(in_space, &arm),
        };
        Value::Vector(self.add_nodes(&twist.velocity, &turned))
    }
}

/// A rate in the form of the model.
fn rates_of(value: &Value) -> Option<Rates> {
    let all = |elements: &[Value]| elements.iter().map(rates_of).collect::<Option<Vec<_>>>();
    match value {
        Value::Scalar(node, _) => Some(Rates::Scalar(*node)),
        Value::Vector(nodes) => Some(Rates::Matrix(nodes.len(), 1, nodes.to_vec())),
        Value::Matrix(matrix) => Some(Rates::Matrix(matrix.rows, matrix.columns, matrix.entries.clone())),
        Value::Twist(twist) => Some(Rates::Twist(Twist::clone(twist))),
        Value::Array(elements) => Some(Rates::Array(all(elements)?)),
        Value::Tuple(elements) => Some(Rates::Tuple(all(elements)?)),
        _ => None,
    }
}
