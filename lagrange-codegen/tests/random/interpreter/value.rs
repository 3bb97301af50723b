//! Values of emitted code, and why a run of it can end.

use std::collections::BTreeMap;

use crate::oracle::gauss;

/// A value of emitted code.
#[derive(Clone, Debug)]
pub enum Value {
    Number(f64),
    Integer(usize),
    Truth(bool),
    Unit,
    /// An array, a tuple, a vector, or a matrix as an array of rows.
    List(Vec<Value>),
    /// `&self`.
    Model,
    /// A `State`.
    State(Box<[Value; 3]>),
    /// A symmetric matrix that the runtime has factored.
    Factored(Vec<Vec<f64>>),
    /// Any other struct, by field.
    Record(BTreeMap<String, Value>),
    Result(Result<Box<Value>, String>),
}

/// Why a run of emitted code ended early.
#[derive(Clone, Debug)]
pub enum Stop {
    /// `return`.
    Return(Value),
    /// `?` on an error of the runtime.
    Failure(String),
    /// Something the interpreter does not know, or that rustc would refuse.
    Unknown(String),
}

/// A step of a run.
pub type Run<T> = Result<T, Stop>;

/// The end of a run at something unknown.
pub fn unknown<T>(what: impl Into<String>) -> Run<T> {
    Err(Stop::Unknown(what.into()))
}

impl Value {
    /// An array of numbers.
    pub fn numbers(values: &[f64]) -> Value {
        Value::List(values.iter().map(|&value| Value::Number(value)).collect())
    }

    /// A matrix.
    pub fn rows(rows: &[Vec<f64>]) -> Value {
        Value::List(rows.iter().map(|row| Value::numbers(row)).collect())
    }

    /// A struct by its fields.
    pub fn record(fields: impl IntoIterator<Item = (&'static str, Value)>) -> Value {
        Value::Record(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }

    /// The number this is.
    pub fn number(&self) -> Run<f64> {
        match self {
            Value::Number(value) => Ok(*value),
            other => unknown(format!("a number expected, not {other:?}")),
        }
    }

    /// Appends to a list.
    pub fn push(&mut self, value: Value) -> Run<()> {
        match self {
            Value::List(elements) => {
                elements.push(value);
                Ok(())
            }
            other => unknown(format!("a list expected, not {other:?}")),
        }
    }

    /// The elements of a list.
    pub fn list(&self) -> Run<&[Value]> {
        match self {
            Value::List(elements) => Ok(elements),
            other => unknown(format!("a list expected, not {other:?}")),
        }
    }

    /// A field of a record.
    pub fn field(&self, name: &str) -> Run<&Value> {
        match self {
            Value::Record(fields) => {
                fields.get(name).ok_or_else(|| Stop::Unknown(format!("no field `{name}` in {self:?}")))
            }
            other => unknown(format!("no field `{name}` in {other:?}")),
        }
    }

    /// A field that is assigned to.
    pub fn field_mut(&mut self, name: &str) -> Run<&mut Value> {
        match self {
            Value::Record(fields) => {
                fields.get_mut(name).ok_or_else(|| Stop::Unknown(format!("the field `{name}` to assign to")))
            }
            other => unknown(format!("no field `{name}` in {other:?}")),
        }
    }

    /// The numbers of a list.
    pub fn to_numbers(&self) -> Run<Vec<f64>> {
        self.list()?.iter().map(Value::number).collect()
    }

    /// The rows of a matrix.
    pub fn to_rows(&self) -> Run<Vec<Vec<f64>>> {
        self.list()?.iter().map(Value::to_numbers).collect()
    }

    /// The integers of a list.
    pub fn to_indices(&self) -> Run<Vec<usize>> {
        let index = |value: &Value| match value {
            Value::Integer(index) => Ok(*index),
            other => unknown(format!("the index {other:?}")),
        };
        self.list()?.iter().map(index).collect()
    }

    /// The result of a check of a pivot or a block.
    pub fn verdict(regular: bool) -> Value {
        let cause = || "the mass matrix is singular".to_owned();
        Value::Result(if regular { Ok(Box::new(Value::Unit)) } else { Err(cause()) })
    }

    /// The element at some indices, one for each level.
    pub fn at(&mut self, indices: &[usize]) -> Run<&mut Value> {
        let mut place = self;
        for &index in indices {
            let elements = match place {
                Value::List(elements) => elements,
                other => return unknown(format!("no elements in {other:?}")),
            };
            let count = elements.len();
            place = match elements.get_mut(index) {
                Some(element) => element,
                None => return unknown(format!("element {index} of {count}")),
            };
        }
        Ok(place)
    }
}

/// Whether a pivot is positive, and above the rounding error of its scale.
pub fn carries(value: f64, scale: f64) -> bool {
    value - 8.0 * f64::EPSILON * scale > 0.0
}

/// A symmetric matrix from its lower triangle, the only part that the runtime reads.
pub fn symmetric(lower: &[Vec<f64>]) -> Run<Vec<Vec<f64>>> {
    let count = lower.len();
    if lower.iter().any(|row| row.len() != count) {
        return unknown(format!("a matrix of {count} rows that is no square"));
    }
    Ok((0..count).map(|i| (0..count).map(|j| lower[i.max(j)][i.min(j)]).collect()).collect())
}

/// `lagrange::solve::solve`: NaN where the matrix is singular.
pub fn solved(matrix: &[Vec<f64>], right: &[f64]) -> Run<Value> {
    if right.len() != matrix.len() {
        return unknown(format!("{} equations with {} right-hand sides", matrix.len(), right.len()));
    }
    let solution = gauss(matrix, &[right.to_vec()]).and_then(|mut solution| solution.pop());
    Ok(Value::numbers(&solution.unwrap_or_else(|| vec![f64::NAN; right.len()])))
}

/// `Real::name(arguments)`.
pub fn real(name: &str, arguments: &[f64]) -> Run<Value> {
    let value = match (name, arguments) {
        ("sin_cos", [x]) => return Ok(Value::numbers(&[x.sin(), x.cos()])),
        ("sin", [x]) => x.sin(),
        ("cos", [x]) => x.cos(),
        ("tan", [x]) => x.tan(),
        ("asin", [x]) => x.asin(),
        ("acos", [x]) => x.acos(),
        ("atan", [x]) => x.atan(),
        ("sinh", [x]) => x.sinh(),
        ("cosh", [x]) => x.cosh(),
        ("tanh", [x]) => x.tanh(),
        ("sech", [x]) => x.cosh().recip(),
        ("logistic", [x]) => (1.0 + (-x).exp()).recip(),
        ("asinh", [x]) => x.asinh(),
        ("acosh", [x]) => x.acosh(),
        ("atanh", [x]) => x.atanh(),
        ("exp", [x]) => x.exp(),
        ("exp_m1", [x]) => x.exp_m1(),
        ("ln", [x]) => x.ln(),
        ("ln_1p", [x]) => x.ln_1p(),
        ("sqrt", [x]) => x.sqrt(),
        ("cbrt", [x]) => x.cbrt(),
        ("abs", [x]) => x.abs(),
        ("signum", [x]) => x.signum(),
        ("recip", [x]) => x.recip(),
        ("atan2", [y, x]) => y.atan2(*x),
        ("powf", [x, y]) => x.powf(*y),
        ("powf_ln", [x, y]) if x.powf(*y) == 0.0 => 0.0,
        ("powf_ln", [x, y]) => x.powf(*y) * x.ln(),
        ("mul_add", [a, b, c]) => a.mul_add(*b, *c),
        ("hypot", [x, y]) => x.hypot(*y),
        _ => return unknown(format!("Real::{name} of {} arguments", arguments.len())),
    };
    Ok(Value::Number(value))
}
