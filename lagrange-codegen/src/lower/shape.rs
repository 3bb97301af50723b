//! Shapes: what a type annotation tells about a value, and the conversion of values to shapes.

use std::rc::Rc;

use super::interpreter::Interpreter;
use super::value::{Matrix, ParameterId, Turn, Value, matrix_name, vector_name};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::NodeId;
use crate::syntax::Record;
use crate::syntax::body::Expr;
use crate::syntax::integers::Integers;
use crate::syntax::types::{Meaning, Type, TypeKind};

/// A resolved type.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Nothing is known.
    Any,
    /// `()`.
    Unit,
    /// `bool`.
    Boolean,
    /// An integer of one of several types.
    Integer(Integers),
    /// The scalar.
    Scalar,
    /// A vector of some length.
    Vector(usize),
    /// A point.
    Point(usize),
    /// A matrix.
    Matrix(usize, usize),
    /// A translation.
    Translation(usize),
    /// A rotation.
    Rotation(usize),
    /// A rotation in space, stored as a quaternion.
    Quaternion,
    /// A quaternion of any length.
    AnyQuaternion,
    /// An isometry.
    Isometry(usize),
    /// The velocity of a body.
    Twist(usize),
    /// An array.
    Array(Box<Shape>, usize),
    /// A slice: an array of any length.
    Slice(Box<Shape>),
    /// A tuple.
    Tuple(Vec<Shape>),
    /// A generated struct.
    Record(Record),
}

impl Shape {
    /// The shape in words, with an article.
    pub fn describe(&self) -> String {
        match self {
            Shape::Any => "any value".into(),
            Shape::Unit => "`()`".into(),
            Shape::Boolean => "a `bool`".into(),
            Shape::Integer(_) => "an integer".into(),
            Shape::Scalar => "a scalar".into(),
            Shape::Vector(length) => vector_name(*length),
            Shape::Point(length) => format!("a Point{length}"),
            Shape::Matrix(rows, columns) => matrix_name(*rows, *columns),
            Shape::Translation(length) => format!("a Translation{length}"),
            Shape::Rotation(dimension) => format!("a Rotation{dimension}"),
            Shape::Quaternion => "a UnitQuaternion".into(),
            Shape::AnyQuaternion => "a Quaternion".into(),
            Shape::Isometry(dimension) => format!("an Isometry{dimension}"),
            Shape::Twist(dimension) => format!("a Twist{dimension}"),
            Shape::Array(_, length) => format!("an array of {length}"),
            Shape::Slice(_) => "a slice".into(),
            Shape::Tuple(elements) => format!("a tuple of {}", elements.len()),
            Shape::Record(record) => format!("`{}`", record.name()),
        }
    }
}

/// The most entries of a matrix. Larger ones could not be unrolled.
const LARGEST_MATRIX: usize = 10_000;

impl<'a> Interpreter<'a> {
    /// Resolves a type. Unknown types tell nothing, nor do lengths that are not known, which is reported.
    pub fn shape(&mut self, ty: &'a Type) -> Shape {
        if let Some(Meaning { path, statement }) = &ty.meaning {
            self.meant(path.to_string(), statement.to_string(), ty.origin);
        }
        match &ty.kind {
            TypeKind::OtherFloat => {
                let scalar = self.item.scalar.to_string();
                self.report(ty.origin, catalogue::other_precision(scalar));
                Shape::Any
            }
            TypeKind::Scalar => Shape::Scalar,
            TypeKind::Integer(types) => Shape::Integer(*types),
            TypeKind::Boolean => Shape::Boolean,
            TypeKind::Unit => Shape::Unit,
            TypeKind::Vector(length) => match self.length(length) {
                Some(length) => Shape::Vector(length),
                None => Shape::Any,
            },
            TypeKind::Point(length) => Shape::Point(*length),
            TypeKind::Matrix(rows, columns) => match (self.length(rows), self.length(columns)) {
                (Some(rows), Some(1)) => Shape::Vector(rows),
                (Some(rows), Some(columns)) if rows.saturating_mul(columns) <= LARGEST_MATRIX => {
                    Shape::Matrix(rows, columns)
                }
                _ => Shape::Any,
            },
            TypeKind::Translation(length) => Shape::Translation(*length),
            TypeKind::Rotation(dimension) => Shape::Rotation(*dimension),
            TypeKind::Quaternion => Shape::Quaternion,
            TypeKind::AnyQuaternion => Shape::AnyQuaternion,
            TypeKind::Isometry(dimension) => Shape::Isometry(*dimension),
            TypeKind::Twist(dimension) => Shape::Twist(*dimension),
            TypeKind::Array(element, length) => {
                let element = self.shape(element);
                match self.length(length) {
                    Some(length) => Shape::Array(Box::new(element), length),
                    None => Shape::Any,
                }
            }
            TypeKind::Slice(element) => Shape::Slice(Box::new(self.shape(element))),
            TypeKind::Tuple(elements) => Shape::Tuple(elements.iter().map(|ty| self.shape(ty)).collect()),
            TypeKind::Record(record) => Shape::Record(*record),
            TypeKind::Infer | TypeKind::Other(_) => Shape::Any,
        }
    }

    /// Brings a value into a shape. Parameters unfold into components, and `into()` takes effect.
    pub fn coerce(&mut self, value: Value, shape: &Shape, origin: Origin) -> Value {
        if let Value::Parameter(id) = value {
            return self.unfold(id, shape, origin);
        }
        match (value, shape) {
            (value @ Value::Unknown, _) | (value, Shape::Any) => value,
            (value @ Value::Unit, Shape::Unit) => value,
            (value @ (Value::Boolean(_) | Value::Choice(_)), Shape::Boolean) => value,
            (Value::Integer(value, types), Shape::Integer(expected)) => {
                self.integer(value, types & *expected, origin)
            }
            (value @ Value::Scalar(..), Shape::Scalar) => value,
            // Rust does not convert integers by itself.
            (Value::Integer(number, ..), Shape::Scalar) => {
                self.report(origin, catalogue::integer_for_scalar(number));
                Value::Unknown
            }
            (Value::Scalar(node, ..), Shape::Vector(1)) => Value::Vector([node].into()),
            (Value::Vector(nodes), Shape::Scalar) if nodes.len() == 1 => Value::scalar(nodes[0]),
            (
                Value::Vector(nodes) | Value::Point(nodes) | Value::Translation(nodes),
                Shape::Vector(length),
            ) if nodes.len() == *length => Value::Vector(nodes),
            (
                Value::Vector(nodes) | Value::Point(nodes) | Value::Translation(nodes),
                Shape::Point(length),
            ) if nodes.len() == *length => Value::Point(nodes),
            (
                Value::Vector(nodes) | Value::Point(nodes) | Value::Translation(nodes),
                Shape::Translation(length),
            ) if nodes.len() == *length => Value::Translation(nodes),
            (Value::Array(elements), Shape::Vector(length) | Shape::Point(length))
                if elements.len() == *length =>
            {
                let nodes: Option<Vec<NodeId>> =
                    elements.iter().map(|element| self.scalar(element.clone(), origin)).collect();
                match (nodes, shape) {
                    (Some(nodes), Shape::Point(_)) => Value::Point(nodes.into()),
                    (Some(nodes), _) => Value::Vector(nodes.into()),
                    (None, _) => Value::Unknown,
                }
            }
            (Value::Vector(nodes), Shape::Array(element, length))
                if nodes.len() == *length && **element == Shape::Scalar =>
            {
                Value::array(nodes.iter().map(|&node| Value::scalar(node)).collect())
            }
            (Value::Matrix(matrix), Shape::Matrix(rows, columns))
                if matrix.rows == *rows && matrix.columns == *columns =>
            {
                Value::Matrix(matrix)
            }
            (Value::Rotation(turn), Shape::Rotation(dimension)) if turn.dimension() == *dimension => {
                Value::Rotation(turn)
            }
            (Value::Rotation(turn @ Turn::Space(_)), Shape::Quaternion) => Value::Rotation(turn),
            (value @ Value::Quaternion(_), Shape::AnyQuaternion) => value,
            (Value::Rotation(turn), Shape::Matrix(rows, columns))
                if turn.dimension() == *rows && rows == columns =>
            {
                self.rotation_matrix(&turn)
            }
            (Value::Isometry(nodes, turn), Shape::Isometry(dimension)) if turn.dimension() == *dimension => {
                Value::Isometry(nodes, turn)
            }
            (Value::Translation(nodes), Shape::Isometry(dimension)) if nodes.len() == *dimension => {
                let turn = self.no_turn(*dimension);
                Value::Isometry(nodes, turn)
            }
            (Value::Array(elements), Shape::Array(element, length)) if elements.len() == *length => {
                self.coerce_all(elements, std::iter::repeat(&**element), origin, Value::array)
            }
            (Value::Array(elements), Shape::Slice(element)) => {
                self.coerce_all(elements, std::iter::repeat(&**element), origin, Value::array)
            }
            (Value::Tuple(elements), Shape::Tuple(shapes)) if elements.len() == shapes.len() => {
                self.coerce_all(elements, shapes.iter(), origin, Value::tuple)
            }
            (Value::Twist(twist), Shape::Twist(dimension)) if twist.dimension() == *dimension => {
                Value::Twist(twist)
            }
            (Value::Record(record), Shape::Record(expected)) if record == *expected => Value::Record(record),
            (Value::Record(record), shape) if !matches!(shape, Shape::Record(_)) => {
                let message = self.record_as_value(record);
                self.refuse(origin, message)
            }
            (value, shape) => {
                self.report(origin, catalogue::wrong_shape(shape.describe(), value.describe()));
                Value::Unknown
            }
        }
    }

    /// Brings the value of an expression into a shape.
    pub fn coerce_of(&mut self, value: Value, shape: &Shape, expr: &'a Expr) -> Value {
        match (value, shape) {
            (Value::Integer(number, ..), Shape::Scalar) => self.integer_as_number(number, expr),
            (value, shape) => self.coerce(value, shape, expr.origin),
        }
    }

    fn coerce_all<'s>(
        &mut self,
        elements: Rc<Vec<Value>>,
        shapes: impl Iterator<Item = &'s Shape>,
        origin: Origin,
        make: impl Fn(Vec<Value>) -> Value,
    ) -> Value {
        let coerced =
            elements.iter().zip(shapes).map(|(element, shape)| self.coerce(element.clone(), shape, origin));
        make(coerced.collect())
    }

    /// A parameter of known shape as components, each a parameter of its own.
    fn unfold(&mut self, id: ParameterId, shape: &Shape, origin: Origin) -> Value {
        match shape {
            Shape::Integer(_) => self.known_integer(id),
            Shape::Any | Shape::Boolean | Shape::Slice(_) => Value::Parameter(id),
            Shape::Scalar => self.scalar_parameter(id, origin).map_or(Value::Unknown, Value::scalar),
            Shape::Vector(length) => Value::Vector(self.components(id, *length, origin)),
            Shape::Point(length) => Value::Point(self.components(id, *length, origin)),
            Shape::Translation(length) => {
                let inner = self.parameter_field(id, "vector", origin);
                Value::Translation(self.components(inner, *length, origin))
            }
            Shape::Matrix(rows, columns) => {
                let mut entries = Vec::with_capacity(rows * columns);
                for row in 0..*rows {
                    for column in 0..*columns {
                        let entry = self.parameter_entry(id, row, column, origin);
                        entries.extend(self.scalar_parameter(entry, origin));
                    }
                }
                if entries.len() < rows * columns {
                    return Value::Unknown;
                }
                Value::Matrix(Rc::new(Matrix { rows: *rows, columns: *columns, entries }))
            }
            Shape::Rotation(2) => {
                let angle = self.parameter_function(id, "angle", origin);
                match self.scalar_parameter(angle, origin) {
                    Some(angle) => Value::Rotation(Turn::Plane(angle)),
                    None => Value::Unknown,
                }
            }
            Shape::Rotation(_) => match self.unfold(id, &Shape::Matrix(3, 3), origin) {
                Value::Matrix(matrix) => self.rotation_of_entries(&matrix),
                _ => Value::Unknown,
            },
            Shape::Quaternion => {
                let matrix = self.parameter_function(id, "rotation_matrix", origin);
                self.unfold(matrix, &Shape::Rotation(3), origin)
            }
            Shape::AnyQuaternion => {
                let parts = ["w", "i", "j", "k"].map(|part| {
                    let part = self.parameter_field(id, part, origin);
                    self.scalar_parameter(part, origin)
                });
                match parts {
                    [Some(w), Some(i), Some(j), Some(k)] => Value::Quaternion([w, i, j, k]),
                    _ => Value::Unknown,
                }
            }
            Shape::Array(_, length) if !self.pay_for(*length, origin) => Value::Unknown,
            Shape::Array(element, length) => {
                let elements = (0..*length).map(|index| {
                    let inner = self.parameter_index(id, index, origin);
                    self.unfold(inner, element, origin)
                });
                Value::array(elements.collect())
            }
            Shape::Tuple(shapes) => {
                let elements = shapes.iter().enumerate().map(|(index, shape)| {
                    let inner = self.parameter_field(id, &index.to_string(), origin);
                    self.unfold(inner, shape, origin)
                });
                Value::tuple(elements.collect())
            }
            Shape::Isometry(dimension) => {
                let shift = self.parameter_field(id, "translation", origin);
                let shift = self.unfold(shift, &Shape::Translation(*dimension), origin);
                // In space it may be a quaternion or a matrix.
                let turn = match dimension {
                    2 => self.unfold(id, &Shape::Rotation(2), origin),
                    _ => self.unfold(id, &Shape::Quaternion, origin),
                };
                match (shift, turn) {
                    (Value::Translation(shift), Value::Rotation(turn)) => Value::Isometry(shift, turn),
                    _ => Value::Unknown,
                }
            }
            Shape::Unit | Shape::Record(_) | Shape::Twist(_) => {
                let value = Value::Parameter(id);
                self.report(origin, catalogue::wrong_shape(shape.describe(), value.describe()));
                Value::Unknown
            }
        }
    }

    fn components(&mut self, id: ParameterId, length: usize, origin: Origin) -> Rc<[NodeId]> {
        (0..length)
            .filter_map(|index| {
                let component = self.parameter_index(id, index, origin);
                self.scalar_parameter(component, origin)
            })
            .collect()
    }

    /// The components of a vector of a length, whatever kind of value it is.
    pub fn vector(&mut self, value: Value, length: usize, origin: Origin) -> Option<Rc<[NodeId]>> {
        match self.coerce(value, &Shape::Vector(length), origin) {
            Value::Vector(nodes) if nodes.len() == length => Some(nodes),
            _ => None,
        }
    }

    /// The node of a scalar.
    pub fn scalar(&mut self, value: Value, origin: Origin) -> Option<NodeId> {
        match self.coerce(value, &Shape::Scalar, origin) {
            Value::Scalar(node, ..) => Some(node),
            _ => None,
        }
    }
}
