//! The values of expressions of the language while they are interpreted.
//!
//! Compound values share their parts, so that handing an array of a hundred vectors around costs nothing.

use std::rc::Rc;

use super::quaternion::Parts;
use super::rounded::Rounded;
use crate::expr::NodeId;
use crate::model::{Rotation, Twist};
use crate::syntax::Record;
use crate::syntax::body::{Closure, Path};
use crate::syntax::integers::Integers;

/// A value.
#[derive(Clone, Debug)]
pub enum Value {
    /// The result of something already reported; silences what would follow from it.
    Unknown,
    /// `()`.
    Unit,
    /// A constant truth value.
    Boolean(bool),
    /// A truth value that depends on the state: one where it holds, else zero.
    Choice(NodeId),
    /// A constant integer, and the types that it may have.
    Integer(i128, Integers),
    /// A number of the scalar type, and what Rust computes for it where it is a constant.
    Scalar(NodeId, Rounded),
    /// A field of the user's struct (or a constant outside the macro's sight) whose shape
    /// nothing has told yet.
    Parameter(ParameterId),
    /// A column vector.
    Vector(Rc<[NodeId]>),
    /// A point: a vector to which translations apply.
    Point(Rc<[NodeId]>),
    /// A matrix of more than one column.
    Matrix(Rc<Matrix>),
    /// A translation.
    Translation(Rc<[NodeId]>),
    /// A rotation.
    Rotation(Turn),
    /// A rotation followed by a translation.
    Isometry(Rc<[NodeId]>, Turn),
    /// The velocity of a pose: of its origin in space axes, and angular in body axes.
    PoseVelocity(Rc<[NodeId]>, Rc<[NodeId]>),
    /// A quaternion of any length.
    Quaternion(Parts),
    /// The velocity of a body.
    Twist(Rc<Twist>),
    /// A closure in a variable.
    Closure(ClosureId),
    /// A tuple.
    Tuple(Rc<Vec<Value>>),
    /// An array.
    Array(Rc<Vec<Value>>),
    /// An iterator, unrolled.
    Iterator(Rc<Vec<Value>>),
    /// `start..end`.
    Range(Option<i128>, Option<i128>, Integers),
    /// The generalized coordinates, velocities, or inputs.
    Record(Record),
}

/// A handle to a path that starts at `self`, or to a foreign constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ParameterId(pub usize);

/// A function that can be passed where a closure is expected.
#[derive(Clone, Copy)]
pub enum Callable<'a> {
    /// `|x| …`.
    Closure(&'a Closure),
    /// `f64::sin`, `Self::rate`.
    Path(&'a Path),
}

/// A handle to a closure with what it has in sight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClosureId(pub usize);

/// A matrix.
#[derive(Clone, Debug)]
pub struct Matrix {
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub columns: usize,
    /// The entries, row by row.
    pub entries: Vec<NodeId>,
}

impl Matrix {
    /// The entry at a row and a column.
    pub fn at(&self, row: usize, column: usize) -> NodeId {
        self.entries[row * self.columns + column]
    }
}

/// A rotation.
#[derive(Clone, Debug)]
pub enum Turn {
    /// In the plane, by its angle.
    Plane(NodeId),
    /// In space.
    Space(Rc<Rotation>),
}

impl Turn {
    /// The dimension of the vectors it turns.
    pub fn dimension(&self) -> usize {
        match self {
            Turn::Plane(_) => 2,
            Turn::Space(_) => 3,
        }
    }
}

impl Value {
    /// A number of which no more is known than its node.
    pub fn scalar(node: NodeId) -> Value {
        Value::Scalar(node, Rounded::UNKNOWN)
    }

    /// A length or an index.
    pub fn index(value: usize) -> Value {
        Value::Integer(value as i128, Integers::USIZE)
    }

    /// A matrix, or a vector if there is one column.
    pub fn matrix(rows: usize, columns: usize, entries: Vec<NodeId>) -> Value {
        debug_assert_eq!(rows * columns, entries.len(), "value: matrix entries");
        if columns == 1 {
            return Value::Vector(entries.into());
        }
        Value::Matrix(Rc::new(Matrix { rows, columns, entries }))
    }

    /// An array.
    pub fn array(elements: Vec<Value>) -> Value {
        Value::Array(Rc::new(elements))
    }

    /// An iterator.
    pub fn iterator(elements: Vec<Value>) -> Value {
        Value::Iterator(Rc::new(elements))
    }

    /// A tuple.
    pub fn tuple(elements: Vec<Value>) -> Value {
        Value::Tuple(Rc::new(elements))
    }

    /// Whether this stands for a reported mistake.
    pub fn is_unknown(&self) -> bool {
        matches!(self, Value::Unknown)
    }

    /// The kind and shape in words, with an article: `a Vector2`.
    pub fn describe(&self) -> String {
        match self {
            Value::Unknown => "an unknown value".into(),
            Value::Unit => "`()`".into(),
            Value::Boolean(_) => "a `bool`".into(),
            Value::Choice(_) => "a condition known at run time".into(),
            Value::Integer(..) => "an integer".into(),
            Value::Scalar(..) => "a scalar".into(),
            Value::Parameter(_) => "a parameter".into(),
            Value::Vector(components) => vector_name(components.len()),
            Value::Point(components) => format!("a Point{}", components.len()),
            Value::Matrix(matrix) => matrix_name(matrix.rows, matrix.columns),
            Value::Translation(components) => format!("a Translation{}", components.len()),
            // A rotation by a quaternion has the same words as one by a matrix.
            Value::Rotation(Turn::Plane(_)) => "a rotation in the plane".into(),
            Value::Rotation(Turn::Space(_)) => "a rotation in space".into(),
            Value::Isometry(_, turn) => format!("an Isometry{}", turn.dimension()),
            Value::PoseVelocity(..) => "a PoseVelocity".into(),
            Value::Quaternion(_) => "a Quaternion".into(),
            Value::Closure(_) => "a closure".into(),
            Value::Twist(twist) => format!("a Twist{}", twist.dimension()),
            Value::Tuple(elements) => format!("a tuple of {}", elements.len()),
            Value::Array(elements) => format!("an array of {}", elements.len()),
            Value::Iterator(_) => "an iterator".into(),
            Value::Range(..) => "a range".into(),
            Value::Record(record) => format!("`{}`", record.name()),
        }
    }

    /// The number of scalars in nested arrays and tuples. Counting ends at the limit.
    pub fn parts(&self, limit: usize) -> usize {
        match self {
            Value::Tuple(elements) | Value::Array(elements) | Value::Iterator(elements) => {
                let mut count = 0;
                for element in elements.iter() {
                    count += element.parts(limit.saturating_sub(count));
                    if count >= limit {
                        break;
                    }
                }
                count
            }
            _ => 1,
        }
    }

    /// The nodes of a value of linear algebra, of a pose those of its translation; none for the rest.
    pub fn nodes(&self) -> &[NodeId] {
        match self {
            Value::Scalar(node, ..) | Value::Rotation(Turn::Plane(node)) => std::slice::from_ref(node),
            Value::Vector(nodes) | Value::Point(nodes) | Value::Translation(nodes) => nodes,
            Value::Isometry(nodes, _) => nodes,
            Value::Matrix(matrix) => &matrix.entries,
            Value::Quaternion(parts) => parts,
            Value::Rotation(Turn::Space(rotation)) => rotation.matrix.as_flattened(),
            Value::Unknown
            | Value::Unit
            | Value::Boolean(_)
            | Value::Choice(_)
            | Value::Integer(..)
            | Value::Parameter(_)
            | Value::PoseVelocity(..)
            | Value::Twist(_)
            | Value::Closure(_)
            | Value::Tuple(_)
            | Value::Array(_)
            | Value::Iterator(_)
            | Value::Range(..)
            | Value::Record(_) => &[],
        }
    }

    /// Appends a text of words that is equal for equal values: the key of memoised calls.
    pub fn fingerprint(&self, words: &mut Vec<u64>) {
        let nodes = |words: &mut Vec<u64>, tag: u64, nodes: &[NodeId]| {
            words.push(tag);
            words.push(nodes.len() as u64);
            words.extend(nodes.iter().map(|node| node.index() as u64));
        };
        let list = |words: &mut Vec<u64>, tag: u64, list: &[Value]| {
            words.push(tag);
            words.push(list.len() as u64);
            list.iter().for_each(|value| value.fingerprint(words));
        };
        let bound = |words: &mut Vec<u64>, bound: Option<i128>| {
            words.extend([u64::from(bound.is_some()), bound.unwrap_or(0) as u64]);
        };
        match self {
            Value::Unknown => words.push(0),
            Value::Unit => words.push(1),
            Value::Boolean(value) => words.extend([2, u64::from(*value)]),
            Value::Choice(node) => words.extend([30, node.index() as u64]),
            Value::Integer(value, types) => {
                words.extend([3, *value as u64, (*value >> 64) as u64, u64::from(types.bits())]);
            }
            Value::Scalar(_, rounded) => {
                nodes(words, 4, self.nodes());
                words.extend(rounded.bits());
            }
            Value::Parameter(id) => words.extend([5, id.0 as u64]),
            Value::Vector(_) => nodes(words, 6, self.nodes()),
            Value::Point(_) => nodes(words, 7, self.nodes()),
            Value::Matrix(matrix) => {
                words.push(matrix.rows as u64);
                nodes(words, 8, self.nodes());
            }
            Value::Translation(_) => nodes(words, 9, self.nodes()),
            // Rotations with equal entries count as one, in whatever form.
            Value::Rotation(_) => nodes(words, 10, self.nodes()),
            Value::Isometry(_, turn) => {
                nodes(words, 11, self.nodes());
                Value::Rotation(turn.clone()).fingerprint(words);
            }
            Value::PoseVelocity(linear, angular) => {
                nodes(words, 20, linear);
                nodes(words, 20, angular);
            }
            Value::Quaternion(parts) => nodes(words, 18, parts),
            Value::Closure(id) => words.extend([19, id.0 as u64]),
            Value::Twist(twist) => nodes(words, 17, &twist.nodes()),
            Value::Tuple(elements) => list(words, 12, elements),
            Value::Array(elements) => list(words, 13, elements),
            Value::Iterator(elements) => list(words, 14, elements),
            Value::Range(start, end, types) => {
                words.push(15);
                bound(words, *start);
                bound(words, *end);
                words.push(u64::from(types.bits()));
            }
            Value::Record(record) => words.extend([16, *record as u64]),
        }
    }
}

/// A vector's name with an article.
pub fn vector_name(length: usize) -> String {
    if length <= 6 { format!("a Vector{length}") } else { format!("an SVector of {length}") }
}

/// A matrix's name with an article.
pub fn matrix_name(rows: usize, columns: usize) -> String {
    match (rows, columns) {
        _ if rows == columns && rows <= 6 => format!("a Matrix{rows}"),
        (1, _) if columns <= 6 => format!("a RowVector{columns}"),
        _ if rows <= 6 && columns <= 6 => format!("a Matrix{rows}x{columns}"),
        _ => format!("a {rows}×{columns} matrix"),
    }
}
