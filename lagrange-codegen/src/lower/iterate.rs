//! Arrays, ranges and iterators, unrolled.

use super::interpreter::Interpreter;
use super::value::{Callable, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::NodeId;
use crate::number::Number;
use crate::syntax::body::{BinaryOperator, Expr, ExprKind, MethodCall, Word};

/// The methods of arrays and iterators. The first is one of arrays alone.
pub const METHODS: [&str; 21] = [
    "windows",
    "iter",
    "into_iter",
    "copied",
    "cloned",
    "map",
    "filter",
    "flat_map",
    "flatten",
    "fold",
    "enumerate",
    "zip",
    "rev",
    "skip",
    "take",
    "step_by",
    "chain",
    "sum",
    "product",
    "len",
    "count",
];

impl<'a> Interpreter<'a> {
    /// A method that takes a closure; `None` if the call is none.
    pub fn closure_method(
        &mut self,
        receiver: &Value,
        call: &'a MethodCall,
        origin: Origin,
    ) -> Option<Value> {
        let has_closure = call.arguments.iter().any(|argument| matches!(argument.kind, ExprKind::Closure(_)));
        if let (Value::Parameter(id), true) = (receiver, has_closure) {
            let name = &*call.method.name;
            if METHODS.contains(&name) {
                self.elements(receiver.clone(), origin);
                return Some(Value::Unknown);
            }
            let text = self.parameters.text(*id).to_string();
            return Some(self.refuse(call.method.origin, catalogue::foreign_method(text, name, None)));
        }
        let is_sequence = matches!(receiver, Value::Array(_) | Value::Iterator(_) | Value::Range(..));
        let is_matrix = matches!(receiver, Value::Vector(_) | Value::Matrix(_));
        let value = match (&*call.method.name, call.arguments.as_slice()) {
            ("map", [function]) if is_sequence || is_matrix => {
                self.callable(function).map(|function| self.mapped(receiver, function, origin))
            }
            ("zip_map", [other, function]) if is_matrix => {
                let other = self.expression(other);
                self.callable(function).map(|function| self.zip_mapped(receiver, other, function, origin))
            }
            ("filter", [function]) if is_sequence => self.filtered(receiver, function, origin),
            ("flat_map", [function]) if is_sequence => self.flat_mapped(receiver, function, origin),
            ("fold", [start, function]) if is_sequence => self.folded(receiver, start, function, origin),
            _ => return None,
        };
        Some(value.unwrap_or(Value::Unknown))
    }

    fn filtered(&mut self, receiver: &Value, function: &'a Expr, origin: Origin) -> Option<Value> {
        let function = self.callable(function)?;
        let elements = self.elements(receiver.clone(), origin)?;
        let mut kept = Vec::new();
        for element in elements.iter() {
            match self.apply_later(function, vec![element.clone()], origin) {
                Value::Boolean(true) => kept.push(element.clone()),
                Value::Boolean(false) => {}
                Value::Unknown => return None,
                other => {
                    self.report(origin, catalogue::wrong_shape("a `bool`", other.describe()));
                    return None;
                }
            }
        }
        Some(Value::iterator(kept))
    }

    fn flat_mapped(&mut self, receiver: &Value, function: &'a Expr, origin: Origin) -> Option<Value> {
        let function = self.callable(function)?;
        let elements = self.elements(receiver.clone(), origin)?;
        let mut flat = Vec::new();
        for element in elements.iter() {
            let inner = self.apply_later(function, vec![element.clone()], origin);
            flat.extend(self.elements(inner, origin)?.iter().cloned());
        }
        Some(Value::iterator(flat))
    }

    fn folded(
        &mut self,
        receiver: &Value,
        start: &'a Expr,
        function: &'a Expr,
        origin: Origin,
    ) -> Option<Value> {
        let mut total = self.expression(start);
        let function = self.callable(function)?;
        for element in self.elements(receiver.clone(), origin)?.iter() {
            total = self.apply(function, vec![total, element.clone()], origin);
        }
        Some(total)
    }

    fn mapped(&mut self, receiver: &Value, function: Callable<'a>, origin: Origin) -> Value {
        if let Value::Vector(nodes) = receiver {
            let mapped: Option<Vec<NodeId>> = nodes
                .iter()
                .map(|&node| {
                    let value = self.apply(function, vec![Value::scalar(node)], origin);
                    self.scalar(value, origin)
                })
                .collect();
            return mapped.map_or(Value::Unknown, |nodes| Value::Vector(nodes.into()));
        }
        if let Value::Matrix(matrix) = receiver {
            let mapped: Option<Vec<NodeId>> = matrix
                .entries
                .iter()
                .map(|&node| {
                    // Nalgebra goes column by column, so the closure must not depend on the order.
                    let value = self.apply_later(function, vec![Value::scalar(node)], origin);
                    self.scalar(value, origin)
                })
                .collect();
            return mapped.map_or(Value::Unknown, |e| Value::matrix(matrix.rows, matrix.columns, e));
        }
        let Some(elements) = self.elements(receiver.clone(), origin) else { return Value::Unknown };
        let mut each = |element: &Value| match receiver {
            Value::Array(_) => self.apply(function, vec![element.clone()], origin),
            _ => self.apply_later(function, vec![element.clone()], origin),
        };
        let mapped = elements.iter().map(&mut each).collect();
        match receiver {
            Value::Array(_) => Value::array(mapped),
            _ => Value::iterator(mapped),
        }
    }

    fn zip_mapped(&mut self, left: &Value, right: Value, function: Callable<'a>, origin: Origin) -> Value {
        let Value::Vector(nodes) = left else {
            return self.refuse(origin, catalogue::wrong_dimension("zip_map", left.describe()));
        };
        let Some(other) = self.vector(right, nodes.len(), origin) else { return Value::Unknown };
        let mapped: Option<Vec<NodeId>> = nodes
            .iter()
            .zip(other.iter())
            .map(|(&a, &b)| {
                let value = self.apply(function, vec![Value::scalar(a), Value::scalar(b)], origin);
                self.scalar(value, origin)
            })
            .collect();
        mapped.map_or(Value::Unknown, |nodes| Value::Vector(nodes.into()))
    }

    /// A method without closures on an array, a range or an iterator.
    pub fn iterator_method(
        &mut self,
        receiver: Value,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        let name = &*word.name;
        if let ("zip", [other]) = (name, arguments.as_slice()) {
            return self.zipped(receiver, other.clone(), origin);
        }
        if let ("take", Value::Range(Some(start), None, types), [Value::Integer(count, ..)]) =
            (name, &receiver, arguments.as_slice())
        {
            return Value::Range(Some(*start), Some(start.saturating_add(*count)), *types);
        }
        let is_array = matches!(receiver, Value::Array(_));
        if !METHODS.contains(&name) {
            return self.unknown_method(&receiver, word);
        }
        let Some(elements) = self.elements(receiver.clone(), origin) else { return Value::Unknown };
        let count = |value: i128| usize::try_from(value).unwrap_or(usize::MAX).min(elements.len());
        match (name, arguments.as_slice()) {
            ("iter" | "into_iter" | "copied" | "cloned", []) => Value::Iterator(elements),
            ("len" | "count", []) => Value::index(elements.len()),
            ("rev", []) => Value::iterator(elements.iter().rev().cloned().collect()),
            ("enumerate", []) => {
                let pairs = elements
                    .iter()
                    .enumerate()
                    .map(|(index, element)| Value::tuple(vec![Value::index(index), element.clone()]));
                Value::iterator(pairs.collect())
            }
            ("skip", [Value::Integer(skipped, ..)]) => Value::iterator(elements[count(*skipped)..].to_vec()),
            ("take", [Value::Integer(taken, ..)]) => Value::iterator(elements[..count(*taken)].to_vec()),
            ("step_by", [Value::Integer(step, ..)]) if *step > 0 => {
                Value::iterator(elements.iter().step_by(count(*step).max(1)).cloned().collect())
            }
            ("chain", [other]) => match self.elements(other.clone(), origin) {
                Some(other) => Value::iterator(elements.iter().chain(other.iter()).cloned().collect()),
                None => Value::Unknown,
            },
            ("windows", [Value::Integer(size, ..)]) if *size > 0 && is_array => {
                let windows = elements.windows(usize::try_from(*size).unwrap_or(usize::MAX));
                Value::iterator(windows.map(|window| Value::array(window.to_vec())).collect())
            }
            ("flatten", []) => {
                let mut flat = Vec::new();
                for element in elements.iter() {
                    match self.elements(element.clone(), origin) {
                        Some(inner) => flat.extend(inner.iter().cloned()),
                        None => return Value::Unknown,
                    }
                }
                Value::iterator(flat)
            }
            ("sum", []) => self.total(&elements, origin),
            ("product", []) => {
                let mut product = None;
                for element in elements.iter() {
                    product = Some(match product {
                        None => element.clone(),
                        Some(before) => {
                            self.arithmetic(BinaryOperator::Multiply, before, element.clone(), origin)
                        }
                    });
                }
                product.unwrap_or_else(|| Value::scalar(self.graph().one()))
            }
            _ => self.refuse(origin, catalogue::bad_arguments(name)),
        }
    }

    fn zipped(&mut self, left: Value, right: Value, origin: Origin) -> Value {
        let (left, right) = match (left, right) {
            // An open range is as long as its partner.
            (Value::Range(Some(start), None, types), right) => match self.elements(right, origin) {
                Some(right) => (
                    Value::Range(Some(start), Some(start.saturating_add(right.len() as i128)), types),
                    Value::Array(right),
                ),
                None => return Value::Unknown,
            },
            (left, Value::Range(Some(start), None, types)) => match self.elements(left, origin) {
                Some(left) => {
                    let length = left.len() as i128;
                    (Value::Array(left), Value::Range(Some(start), Some(start.saturating_add(length)), types))
                }
                None => return Value::Unknown,
            },
            // A parameter has as many elements as its partner.
            (left, Value::Parameter(id)) => match self.elements(left, origin) {
                Some(left) => {
                    let elements = self.parameter_elements(id, left.len(), origin);
                    (Value::Array(left), Value::array(elements))
                }
                None => return Value::Unknown,
            },
            pair => pair,
        };
        match (self.elements(left, origin), self.elements(right, origin)) {
            (Some(left), Some(right)) => {
                let pairs =
                    left.iter().zip(right.iter()).map(|(a, b)| Value::tuple(vec![a.clone(), b.clone()]));
                Value::iterator(pairs.collect())
            }
            _ => Value::Unknown,
        }
    }

    /// The sum of all elements, flat: one node for numbers, one for each component of vectors. Integers and
    /// matrices are added one after the other.
    fn total(&mut self, elements: &[Value], origin: Origin) -> Value {
        let Some(first) = elements.iter().find(|element| !matches!(element, Value::Parameter(_))) else {
            return self.flat_sum(elements, origin);
        };
        match first {
            Value::Vector(nodes) => {
                let length = nodes.len();
                let mut columns: Vec<Vec<(NodeId, Number)>> = vec![Vec::new(); length];
                for element in elements {
                    if let Some(other) = vector_length(element)
                        && other != length
                    {
                        let message = catalogue::cannot_add(element.describe(), first.describe());
                        return self.refuse(origin, message);
                    }
                    let Some(nodes) = self.vector(element.clone(), length, origin) else {
                        return Value::Unknown;
                    };
                    for (column, node) in columns.iter_mut().zip(nodes.iter()) {
                        column.push((*node, Number::ONE));
                    }
                }
                let sums = columns.iter().map(|column| self.graph().sum(Number::ZERO, column)).collect();
                Value::Vector(sums)
            }
            Value::Integer(..) | Value::Matrix(_) => {
                let mut total = None;
                for element in elements {
                    total = Some(match total {
                        None => element.clone(),
                        Some(before) => self.arithmetic(BinaryOperator::Add, before, element.clone(), origin),
                    });
                }
                total.unwrap_or(Value::Unknown)
            }
            _ => self.flat_sum(elements, origin),
        }
    }

    fn flat_sum(&mut self, elements: &[Value], origin: Origin) -> Value {
        let mut terms = Vec::with_capacity(elements.len());
        for element in elements {
            match self.scalar(element.clone(), origin) {
                Some(node) => terms.push((node, Number::ONE)),
                None => return Value::Unknown,
            }
        }
        Value::scalar(self.graph().sum(Number::ZERO, &terms))
    }
}

fn vector_length(value: &Value) -> Option<usize> {
    match value {
        Value::Vector(nodes) => Some(nodes.len()),
        _ => None,
    }
}
