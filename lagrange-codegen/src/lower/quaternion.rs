//! Quaternions of any length, and the rotations that they stand for.

use std::rc::Rc;

use super::interpreter::Interpreter;
use super::shape::Shape;
use super::value::{Turn, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::NodeId;
use crate::model::{Rotation, RotationForm};
use crate::number::Number;
use crate::syntax::body::Word;

/// The methods of quaternions.
pub const METHODS: [&str; 10] = [
    "norm",
    "norm_squared",
    "magnitude",
    "magnitude_squared",
    "normalize",
    "conjugate",
    "dot",
    "scalar",
    "vector",
    "imag",
];

/// w, i, j, k.
pub type Parts = [NodeId; 4];

impl Interpreter<'_> {
    /// `Quaternion::name(arguments)`.
    pub fn new_quaternion(&mut self, name: &str, arguments: &[Value], origin: Origin) -> Option<Value> {
        let zero = self.graph().zero();
        let parts = match (name, arguments) {
            ("new", [w, i, j, k]) => {
                let mut parts = [zero; 4];
                for (part, value) in parts.iter_mut().zip([w, i, j, k]) {
                    *part = self.scalar(value.clone(), origin)?;
                }
                parts
            }
            ("from_parts", [real, imaginary]) => {
                let real = self.scalar(real.clone(), origin)?;
                let imaginary = self.vector(imaginary.clone(), 3, origin)?;
                [real, imaginary[0], imaginary[1], imaginary[2]]
            }
            ("from_imag", [imaginary]) => {
                let imaginary = self.vector(imaginary.clone(), 3, origin)?;
                [zero, imaginary[0], imaginary[1], imaginary[2]]
            }
            ("from_real", [real]) => [self.scalar(real.clone(), origin)?, zero, zero, zero],
            ("identity", []) => [self.graph().one(), zero, zero, zero],
            _ => return None,
        };
        Some(Value::Quaternion(parts))
    }

    /// `UnitQuaternion::name(quaternion)`.
    pub fn new_unit_quaternion(&mut self, name: &str, arguments: &[Value], origin: Origin) -> Option<Value> {
        let [value] = arguments else { return None };
        match self.coerce(value.clone(), &Shape::AnyQuaternion, origin) {
            // Functions differ in what they do with a quaternion that is not of unit length.
            Value::Quaternion(parts)
                if name == "new_unchecked"
                    && parts.iter().any(|&part| !self.model.graph.dependence(part).is_fixed()) =>
            {
                Some(self.refuse(origin, catalogue::unchecked_quaternion()))
            }
            Value::Quaternion(parts) => Some(self.rotation_of_quaternion(&parts)),
            _ => Some(Value::Unknown),
        }
    }

    /// The rotation of a quaternion q of any length: v ↦ q v q* / |q|².
    pub fn rotation_of_quaternion(&mut self, parts: &Parts) -> Value {
        let [w, i, j, k] = *parts;
        let square = self.norm_squared(parts);
        let graph = self.graph();
        let two = graph.integer(2);
        let scale = graph.div(two, square);
        let mut twice = |a: NodeId, b: NodeId, sign: Number, c: NodeId, d: NodeId| {
            let (first, second) = (graph.mul(a, b), graph.mul(c, d));
            let sum = graph.sum(Number::ZERO, &[(first, Number::ONE), (second, sign)]);
            graph.mul(scale, sum)
        };
        let (plus, minus) = (Number::ONE, Number::MINUS_ONE);
        let off = [
            [None, Some(twice(i, j, minus, w, k)), Some(twice(i, k, plus, w, j))],
            [Some(twice(i, j, plus, w, k)), None, Some(twice(j, k, minus, w, i))],
            [Some(twice(i, k, minus, w, j)), Some(twice(j, k, plus, w, i)), None],
        ];
        let diagonal = [twice(j, j, plus, k, k), twice(i, i, plus, k, k), twice(i, i, plus, j, j)];
        let matrix = [0, 1, 2].map(|row| {
            [0, 1, 2].map(|column| match off[row][column] {
                Some(entry) => entry,
                None => self.model.graph.sum(Number::ONE, &[(diagonal[row], Number::MINUS_ONE)]),
            })
        });
        let form = RotationForm::Quaternion(*parts);
        Value::Rotation(Turn::Space(Rc::new(Rotation { matrix, form })))
    }

    /// Hamilton's product.
    pub fn quaternion_product(&mut self, a: &Parts, b: &Parts) -> Value {
        let terms = [
            [(0, 0, 1), (1, 1, -1), (2, 2, -1), (3, 3, -1)],
            [(0, 1, 1), (1, 0, 1), (2, 3, 1), (3, 2, -1)],
            [(0, 2, 1), (2, 0, 1), (3, 1, 1), (1, 3, -1)],
            [(0, 3, 1), (3, 0, 1), (1, 2, 1), (2, 1, -1)],
        ];
        Value::Quaternion(terms.map(|terms| {
            let graph = &mut self.model.graph;
            let terms = terms.map(|(left, right, sign)| {
                let sign = if sign > 0 { Number::ONE } else { Number::MINUS_ONE };
                (graph.mul(a[left], b[right]), sign)
            });
            graph.sum(Number::ZERO, &terms)
        }))
    }

    /// `quaternion.name`.
    pub fn quaternion_field(&mut self, parts: &Parts, word: &Word) -> Value {
        match &*word.name {
            "w" => Value::scalar(parts[0]),
            "i" => Value::scalar(parts[1]),
            "j" => Value::scalar(parts[2]),
            "k" => Value::scalar(parts[3]),
            "coords" => Value::Vector([parts[1], parts[2], parts[3], parts[0]].into()),
            name => {
                let value = Value::Quaternion(*parts).describe();
                self.refuse(word.origin, catalogue::unknown_field(value, name))
            }
        }
    }

    /// Methods of quaternions.
    pub fn quaternion_method(
        &mut self,
        parts: &Parts,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        let [w, i, j, k] = *parts;
        match (&*word.name, arguments.as_slice()) {
            ("norm_squared" | "magnitude_squared", []) => Value::scalar(self.norm_squared(parts)),
            ("norm" | "magnitude", []) => {
                let square = self.norm_squared(parts);
                Value::scalar(self.graph().sqrt(square))
            }
            ("normalize", []) => {
                let unit = self.normalized(parts);
                Value::Quaternion([unit[0], unit[1], unit[2], unit[3]])
            }
            ("conjugate", []) => {
                let graph = self.graph();
                Value::Quaternion([w, graph.neg(i), graph.neg(j), graph.neg(k)])
            }
            ("dot", [other]) => match self.coerce(other.clone(), &Shape::AnyQuaternion, origin) {
                Value::Quaternion(other) => Value::scalar(self.dot(parts, &other)),
                _ => Value::Unknown,
            },
            ("scalar", []) => Value::scalar(w),
            ("vector" | "imag", []) => Value::Vector([i, j, k].into()),
            _ => self.unknown_method(&Value::Quaternion(*parts), word),
        }
    }
}
