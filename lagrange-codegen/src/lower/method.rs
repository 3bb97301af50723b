//! Method calls: which kind of receiver knows which method.

use super::advice::argument_count;
use super::interpreter::Interpreter;
use super::iterate;
use super::methods::{self, is_of_rotations, is_of_vectors};
use super::rounded::Rounded;
use super::scalar;
use super::value::{ParameterId, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::syntax::Record;
use crate::syntax::body::{MethodCall, Word};
use crate::syntax::integers::Integers;
use crate::syntax::suggest::{in_rust, nearest};

/// Methods without an effect on values of the interpreter. Conversions take effect where the target is known.
const TRANSPARENT: [&str; 11] = [
    "clone",
    "into",
    "to_owned",
    "borrow",
    "as_ref",
    "into_inner",
    "as_slice",
    "to_homogeneous_coords",
    "into_owned",
    "clone_owned",
    "as_array",
];

impl<'a> Interpreter<'a> {
    /// `receiver.method(arguments)`.
    pub fn method(&mut self, call: &'a MethodCall, origin: Origin) -> Value {
        let word = &call.method;
        if Self::is_self(&call.receiver) {
            let arguments = self.arguments(&word.name, &call.arguments);
            if arguments.iter().any(Value::is_unknown) {
                return Value::Unknown;
            }
            return self.call_helper(word, arguments, true, origin);
        }
        let receiver = self.expression(&call.receiver);
        if receiver.is_unknown() {
            return Value::Unknown;
        }
        if let Some(value) = self.closure_method(&receiver, call, origin) {
            return value;
        }
        let arguments = self.expressions(&call.arguments);
        if arguments.iter().any(Value::is_unknown) {
            return Value::Unknown;
        }
        if let ("sum" | "product", Some(generic), Value::Iterator(_)) =
            (&*word.name, &call.generic, &receiver)
        {
            let shape = self.shape(generic);
            let total = self.plain_method(receiver, word, arguments, origin);
            return self.coerce(total, &shape, origin);
        }
        self.plain_method(receiver, word, arguments, origin)
    }

    /// A method whose arguments are known.
    pub fn plain_method(
        &mut self,
        receiver: Value,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        let name = &*word.name;
        if TRANSPARENT.contains(&name) && arguments.is_empty() {
            return receiver;
        }
        match receiver {
            Value::Unknown => Value::Unknown,
            Value::Scalar(node, rounded) => self.scalar_method((node, rounded), word, arguments, origin),
            Value::Integer(value, types) => self.integer_method(value, types, word, arguments, origin),
            Value::Parameter(id) => self.parameter_value_method(id, word, arguments, origin),
            Value::Vector(ref nodes) | Value::Point(ref nodes) | Value::Translation(ref nodes) => {
                let nodes = nodes.clone();
                self.vector_method(receiver, nodes, word, arguments, origin)
            }
            Value::Matrix(matrix) => self.matrix_method(matrix, word, arguments, origin),
            Value::Rotation(turn) => self.rotation_method(turn, word, arguments, origin),
            Value::Isometry(shift, turn) => self.isometry_method(shift, turn, word, arguments, origin),
            Value::Quaternion(parts) => self.quaternion_method(&parts, word, arguments, origin),
            Value::Twist(twist) => self.twist_method(twist, word, arguments, origin),
            Value::Array(_) | Value::Iterator(_) | Value::Range(..) => {
                self.iterator_method(receiver, word, arguments, origin)
            }
            Value::Record(record) => self.record_method(record, word, arguments),
            Value::Unit
            | Value::Boolean(_)
            | Value::Choice(_)
            | Value::PoseVelocity(..)
            | Value::Closure(_)
            | Value::Tuple(_) => self.unknown_method(&receiver, word),
        }
    }

    /// No such method: a near miss, or what can be called.
    pub fn unknown_method(&mut self, receiver: &Value, word: &Word) -> Value {
        let of_vectors = || is_of_vectors(&word.name) || is_of_rotations(&word.name);
        if let Some(path) = self.taken_for_scalar(receiver).filter(|_| of_vectors()) {
            return self.refuse(word.origin, catalogue::method_of_scalar(path, &word.name));
        }
        if let Value::Array(_) = receiver
            && of_vectors()
        {
            return self.refuse(word.origin, catalogue::array_as_vector(receiver.describe(), &word.name));
        }
        if let (Value::Rotation(_), Some(call)) = (receiver, methods::of_matrices_alone(&word.name)) {
            return self.refuse(word.origin, catalogue::rotation_as_matrix(receiver.describe(), call));
        }
        let known = methods::of(receiver);
        let near = in_rust(&word.name, known).map(|methods| methods.join("` or `"));
        let near = near.or_else(|| nearest(&word.name, known.iter().copied()).map(String::from));
        self.refuse(word.origin, catalogue::unknown_method(receiver.describe(), &word.name, near))
    }

    /// The arguments, if there are `N` of them. Another number is reported.
    pub fn exactly<const N: usize>(
        &mut self,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Option<[Value; N]> {
        let count = arguments.len();
        match <[Value; N]>::try_from(arguments) {
            Ok(arguments) => Some(arguments),
            Err(_) => {
                self.report(origin, argument_count(&word.name, N, count));
                None
            }
        }
    }

    fn parameter_value_method(
        &mut self,
        id: ParameterId,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        if let Some(value) = self.method_as_written(id, word, &arguments, origin) {
            return value;
        }
        let name = &*word.name;
        match (name, arguments.as_slice()) {
            // The length may follow from a partner later on.
            ("iter" | "into_iter" | "copied" | "cloned", []) => return Value::Parameter(id),
            ("zip", [Value::Array(partner) | Value::Iterator(partner)]) => {
                let pairs = partner.iter().enumerate().map(|(index, element)| {
                    let own = Value::Parameter(self.parameter_index(id, index, origin));
                    Value::tuple(vec![own, element.clone()])
                });
                return Value::iterator(pairs.collect());
            }
            ("sum" | "product", []) => {
                self.elements(Value::Parameter(id), origin);
                return Value::Unknown;
            }
            _ if iterate::METHODS.contains(&name) && !is_of_vectors(name)
                || matches!(name, "len" | "map") =>
            {
                self.elements(Value::Parameter(id), origin);
                return Value::Unknown;
            }
            _ => {}
        }
        // The parameter has the shape of the other operand.
        if let (true, [Value::Vector(nodes)]) = (is_of_vectors(name), arguments.as_slice()) {
            let length = nodes.len();
            return match self.vector(Value::Parameter(id), length, origin) {
                Some(nodes) => {
                    let receiver = Value::Vector(nodes);
                    self.plain_method(receiver, word, arguments, origin)
                }
                None => Value::Unknown,
            };
        }
        if scalar::METHODS.contains(&name) || scalar::REFUSED.contains(&name) {
            return match self.scalar_parameter(id, origin) {
                Some(node) => self.scalar_method((node, Rounded::UNKNOWN), word, arguments, origin),
                None => Value::Unknown,
            };
        }
        let text = self.parameters.text(id).to_string();
        if is_of_vectors(name) || is_of_rotations(name) {
            return self.refuse(word.origin, catalogue::unknown_shape(text));
        }
        let near = nearest(name, scalar::METHODS).map(String::from);
        self.refuse(word.origin, catalogue::foreign_method(text, name, near))
    }

    fn record_method(&mut self, record: Record, word: &Word, arguments: Vec<Value>) -> Value {
        match (&*word.name, arguments.as_slice()) {
            ("to_array" | "as_vector" | "to_vector", [])
                if record != Record::Inputs && self.item.has_orientations() =>
            {
                self.refuse(word.origin, catalogue::no_array_of_orientations(record.name()))
            }
            ("to_array", []) => Value::array(self.record_values(record)),
            ("as_vector" | "to_vector", []) => {
                let values = self.record_values(record);
                Value::Vector(values.iter().flat_map(|value| value.nodes().to_vec()).collect())
            }
            (name, _) if scalar::METHODS.contains(&name) => {
                let message = self.record_as_value(record);
                self.refuse(word.origin, message)
            }
            _ => self.unknown_method(&Value::Record(record), word),
        }
    }

    fn integer_method(
        &mut self,
        value: i128,
        types: Integers,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        let name = &*word.name;
        let result = match (name, arguments.as_slice()) {
            ("abs", []) => value.checked_abs(),
            ("pow", [Value::Integer(power, ..)]) => {
                u32::try_from(*power).ok().and_then(|power| value.checked_pow(power))
            }
            ("min", [Value::Integer(other, ..)]) => Some(value.min(*other)),
            ("max", [Value::Integer(other, ..)]) => Some(value.max(*other)),
            ("clamp", [Value::Integer(least, ..), Value::Integer(largest, ..)]) if least <= largest => {
                Some(value.clamp(*least, *largest))
            }
            ("rem_euclid", [Value::Integer(other, ..)]) => value.checked_rem_euclid(*other),
            ("div_euclid", [Value::Integer(other, ..)]) => value.checked_div_euclid(*other),
            ("div_ceil", [Value::Integer(other, ..)]) if *other > 0 => {
                Some(value.div_euclid(*other) + i128::from(value.rem_euclid(*other) > 0))
            }
            ("abs_diff", [Value::Integer(other, ..)]) => {
                value.checked_sub(*other).and_then(i128::checked_abs)
            }
            ("saturating_sub", [Value::Integer(other, ..)]) => Some(value.saturating_sub(*other).max(0)),
            ("is_multiple_of", [Value::Integer(other, ..)]) => {
                return Value::Boolean(value.checked_rem(*other).unwrap_or(value) == 0);
            }
            _ if scalar::METHODS.contains(&name) => {
                return self.refuse(origin, catalogue::integer_for_scalar(value));
            }
            _ => return self.unknown_method(&Value::Integer(value, types), word),
        };
        match result {
            Some(result) => self.integer(result, types, origin),
            None => self.refuse(origin, catalogue::integer_overflow()),
        }
    }
}
