//! Methods of vectors, matrices, rotations and poses.

use std::rc::Rc;

use super::advice::valid_indices;
use super::interpreter::Interpreter;
use super::methods;
use super::shape::Shape;
use super::value::{Matrix, Turn, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::NodeId;
use crate::expr::Unary;
use crate::number::Number;
use crate::syntax::body::Word;

impl Interpreter<'_> {
    /// The length of a vector squared.
    pub fn norm_squared(&mut self, nodes: &[NodeId]) -> NodeId {
        let graph = self.graph();
        let squares: Vec<(NodeId, Number)> =
            nodes.iter().map(|&node| (graph.powi(node, 2), Number::ONE)).collect();
        graph.sum(Number::ZERO, &squares)
    }

    fn norm(&mut self, nodes: &[NodeId]) -> NodeId {
        let squared = self.norm_squared(nodes);
        self.graph().sqrt(squared)
    }

    /// The unit vector along a vector.
    pub fn normalized(&mut self, nodes: &[NodeId]) -> Rc<[NodeId]> {
        let norm = self.norm(nodes);
        nodes.iter().map(|&node| self.graph().div(node, norm)).collect()
    }

    /// `v × w`.
    pub fn cross(&mut self, v: &[NodeId], w: &[NodeId]) -> Rc<[NodeId]> {
        let graph = self.graph();
        (0..3)
            .map(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                let (plus, minus) = (graph.mul(v[j], w[k]), graph.mul(v[k], w[j]));
                graph.sub(plus, minus)
            })
            .collect()
    }

    /// Methods of vectors, points and translations.
    pub fn vector_method(
        &mut self,
        receiver: Value,
        nodes: Rc<[NodeId]>,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        let length = nodes.len();
        match &*word.name {
            "dot" | "cross" | "perp" | "component_mul" | "component_div" | "tr_mul" => {
                let Some([other]) = self.exactly(word, arguments, origin) else { return Value::Unknown };
                if let Some(other_length) = vector_length(&other)
                    && other_length != length
                {
                    let message =
                        catalogue::lengths_differ(&word.name, receiver.describe(), other.describe());
                    return self.refuse(origin, message);
                }
                let Some(other) = self.vector(other, length, origin) else { return Value::Unknown };
                self.vector_pair(receiver, &nodes, &other, word)
            }
            "distance" | "metric_distance" => {
                let Some([other]) = self.exactly(word, arguments, origin) else { return Value::Unknown };
                let Some(other) = self.vector(other, length, origin) else { return Value::Unknown };
                let difference: Vec<NodeId> =
                    nodes.iter().zip(other.iter()).map(|(&a, &b)| self.graph().sub(a, b)).collect();
                Value::scalar(self.norm(&difference))
            }
            "scale" | "add_scalar" => {
                let Some([factor]) = self.exactly(word, arguments, origin) else { return Value::Unknown };
                let Some(factor) = self.scalar(factor, origin) else { return Value::Unknown };
                let scales = &*word.name == "scale";
                let each = |&node: &NodeId| match scales {
                    true => self.model.graph.mul(node, factor),
                    false => self.model.graph.add(node, factor),
                };
                Value::Vector(nodes.iter().map(each).collect())
            }
            "push" => {
                let Some([last]) = self.exactly(word, arguments, origin) else { return Value::Unknown };
                let Some(last) = self.scalar(last, origin) else { return Value::Unknown };
                Value::Vector(nodes.iter().copied().chain([last]).collect())
            }
            "norm" | "norm_squared" | "magnitude" | "magnitude_squared" | "normalize" | "transpose"
            | "sum" | "len" | "iter" | "into_iter" | "to_scalar" | "xy" | "cross_matrix" | "inverse"
            | "as_vector" => {
                if self.exactly::<0>(word, arguments, origin).is_none() {
                    return Value::Unknown;
                }
                self.vector_property(receiver, &nodes, word)
            }
            _ => self.unknown_method(&receiver, word),
        }
    }

    fn vector_pair(&mut self, receiver: Value, nodes: &[NodeId], other: &[NodeId], word: &Word) -> Value {
        match (&*word.name, nodes.len()) {
            ("dot", _) => Value::scalar(self.dot(nodes, other)),
            ("tr_mul", _) => Value::Vector([self.dot(nodes, other)].into()),
            ("cross", 3) => Value::Vector(self.cross(nodes, other)),
            ("perp", 2) => {
                let graph = self.graph();
                let (plus, minus) = (graph.mul(nodes[0], other[1]), graph.mul(nodes[1], other[0]));
                Value::scalar(graph.sub(plus, minus))
            }
            ("component_mul", _) => {
                let pairs = nodes.iter().zip(other);
                Value::Vector(pairs.map(|(&a, &b)| self.model.graph.mul(a, b)).collect())
            }
            ("component_div", _) => {
                let pairs = nodes.iter().zip(other);
                Value::Vector(pairs.map(|(&a, &b)| self.model.graph.div(a, b)).collect())
            }
            _ => {
                let message = catalogue::wrong_dimension(&word.name, receiver.describe());
                self.refuse(word.origin, message)
            }
        }
    }

    fn vector_property(&mut self, receiver: Value, nodes: &[NodeId], word: &Word) -> Value {
        match (&*word.name, nodes) {
            ("norm" | "magnitude", _) => Value::scalar(self.norm(nodes)),
            ("norm_squared" | "magnitude_squared", _) => Value::scalar(self.norm_squared(nodes)),
            ("normalize", _) => Value::Vector(self.normalized(nodes)),
            ("transpose", _) => Value::matrix(1, nodes.len(), nodes.to_vec()),
            ("sum", _) => {
                let terms: Vec<(NodeId, Number)> = nodes.iter().map(|&node| (node, Number::ONE)).collect();
                Value::scalar(self.graph().sum(Number::ZERO, &terms))
            }
            ("len", _) => Value::index(nodes.len()),
            ("iter" | "into_iter", _) => {
                Value::iterator(nodes.iter().map(|&node| Value::scalar(node)).collect())
            }
            ("to_scalar", [node]) => Value::scalar(*node),
            ("xy", [x, y, ..]) => Value::Vector([*x, *y].into()),
            ("cross_matrix", [x, y, z]) => {
                let graph = self.graph();
                let zero = graph.zero();
                let [minus_x, minus_y, minus_z] = [*x, *y, *z].map(|node| graph.neg(node));
                let entries = vec![zero, minus_z, *y, *z, zero, minus_x, minus_y, *x, zero];
                Value::matrix(3, 3, entries)
            }
            ("inverse", _) if matches!(receiver, Value::Translation(_)) => {
                Value::Translation(nodes.iter().map(|&node| self.graph().neg(node)).collect())
            }
            ("as_vector", _) => Value::Vector(nodes.into()),
            _ => {
                let message = catalogue::wrong_dimension(&word.name, receiver.describe());
                self.refuse(word.origin, message)
            }
        }
    }

    /// Methods of matrices.
    pub fn matrix_method(
        &mut self,
        matrix: Rc<Matrix>,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        let (rows, columns) = (matrix.rows, matrix.columns);
        match (&*word.name, arguments.as_slice()) {
            ("transpose", []) => {
                let entries = (0..rows * columns).map(|i| matrix.at(i % rows, i / rows)).collect();
                Value::matrix(columns, rows, entries)
            }
            ("trace", []) if rows == columns => {
                let terms: Vec<_> = (0..rows).map(|i| (matrix.at(i, i), Number::ONE)).collect();
                Value::scalar(self.graph().sum(Number::ZERO, &terms))
            }
            ("diagonal", []) => Value::Vector((0..rows.min(columns)).map(|i| matrix.at(i, i)).collect()),
            ("determinant", []) if rows == columns && rows <= 3 => Value::scalar(self.determinant(&matrix)),
            ("iter" | "into_iter", []) => match self.elements(Value::Matrix(matrix), origin) {
                Some(elements) => Value::Iterator(elements),
                None => Value::Unknown,
            },
            ("row", [Value::Integer(index, ..)]) => {
                match usize::try_from(*index).ok().filter(|i| *i < rows) {
                    Some(row) => {
                        Value::matrix(1, columns, matrix.entries[row * columns..][..columns].to_vec())
                    }
                    None => self.refuse(origin, catalogue::index_out_of_range(index, valid_indices(rows))),
                }
            }
            ("column", [Value::Integer(index, ..)]) => {
                match usize::try_from(*index).ok().filter(|i| *i < columns) {
                    Some(column) => Value::Vector((0..rows).map(|row| matrix.at(row, column)).collect()),
                    None => self.refuse(origin, catalogue::index_out_of_range(index, valid_indices(columns))),
                }
            }
            ("tr_mul", [other]) => {
                let transposed = self.matrix_method(matrix, &renamed(word, "transpose"), Vec::new(), origin);
                let other = other.clone();
                let multiply = crate::syntax::body::BinaryOperator::Multiply;
                self.arithmetic(multiply, transposed, other, origin)
            }
            ("norm", []) => Value::scalar(self.norm(&matrix.entries)),
            ("norm_squared", []) => Value::scalar(self.norm_squared(&matrix.entries)),
            ("sum", []) => {
                let terms: Vec<_> = matrix.entries.iter().map(|&node| (node, Number::ONE)).collect();
                Value::scalar(self.graph().sum(Number::ZERO, &terms))
            }
            ("component_mul" | "dot", [Value::Matrix(other)])
                if other.rows == rows && other.columns == columns =>
            {
                if &*word.name == "dot" {
                    return Value::scalar(self.dot(&matrix.entries, &other.entries));
                }
                let pairs = matrix.entries.iter().zip(&other.entries);
                let entries = pairs.map(|(&a, &b)| self.model.graph.mul(a, b)).collect();
                Value::matrix(rows, columns, entries)
            }
            ("scale", [factor]) => match self.scalar(factor.clone(), origin) {
                Some(factor) => self.scale_matrix(&matrix, |graph, node| graph.mul(node, factor)),
                None => Value::Unknown,
            },
            (name, _) if methods::is_of_vectors(name) => {
                let message = catalogue::wrong_dimension(name, Value::Matrix(matrix).describe());
                self.refuse(word.origin, message)
            }
            _ => self.unknown_method(&Value::Matrix(matrix), word),
        }
    }

    fn determinant(&mut self, matrix: &Matrix) -> NodeId {
        let row = |row: usize| -> Vec<NodeId> { (0..matrix.columns).map(|c| matrix.at(row, c)).collect() };
        if matrix.rows == 2 {
            let graph = self.graph();
            let plus = graph.mul(matrix.at(0, 0), matrix.at(1, 1));
            let minus = graph.mul(matrix.at(0, 1), matrix.at(1, 0));
            return graph.sub(plus, minus);
        }
        let cross = self.cross(&row(1), &row(2));
        self.dot(&row(0), &cross)
    }

    /// Methods of rotations.
    pub fn rotation_method(
        &mut self,
        turn: Turn,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        if let Turn::Plane(angle) = turn
            && &*word.name == "angle"
            && arguments.is_empty()
        {
            // Between −π and π, as nalgebra gives it, whatever the rotation was made from.
            let graph = self.graph();
            let (sine, cosine) = (graph.unary(Unary::Sin, angle), graph.unary(Unary::Cos, angle));
            return Value::scalar(graph.atan2(sine, cosine));
        }
        match (&*word.name, arguments.as_slice()) {
            ("inverse" | "transpose" | "conjugate", []) => Value::Rotation(self.inverse_turn(&turn)),
            ("matrix", []) => self.rotation_matrix(&turn),
            ("to_rotation_matrix", []) => Value::Rotation(turn),
            ("transform_vector", [value]) => self.turned(&turn, value, false, origin),
            ("transform_point", [value]) => self.turned(&turn, value, true, origin),
            ("inverse_transform_vector", [value]) => {
                let back = self.inverse_turn(&turn);
                self.turned(&back, value, false, origin)
            }
            ("inverse_transform_point", [value]) => {
                let back = self.inverse_turn(&turn);
                self.turned(&back, value, true, origin)
            }
            _ => self.unknown_method(&Value::Rotation(turn), word),
        }
    }

    fn turned(&mut self, turn: &Turn, value: &Value, point: bool, origin: Origin) -> Value {
        let shape = match point {
            true => Shape::Point(turn.dimension()),
            false => Shape::Vector(turn.dimension()),
        };
        let value = self.coerce(value.clone(), &shape, origin);
        match value.is_unknown() {
            true => Value::Unknown,
            false => self.turn_value(turn, &value, origin),
        }
    }

    /// Methods of poses.
    pub fn isometry_method(
        &mut self,
        shift: Rc<[NodeId]>,
        turn: Turn,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        match (&*word.name, arguments.as_slice()) {
            ("inverse", []) => self.inverse_isometry(&shift, &turn),
            ("transform_vector", [value]) => self.turned(&turn, value, false, origin),
            ("transform_point", [value]) => {
                match self.coerce(value.clone(), &Shape::Point(shift.len()), origin) {
                    Value::Unknown => Value::Unknown,
                    point => self.move_value(&shift, &turn, &point, origin),
                }
            }
            ("inverse_transform_vector", [value]) => {
                let back = self.inverse_turn(&turn);
                self.turned(&back, value, false, origin)
            }
            ("inverse_transform_point", [value]) => {
                let point = self.coerce(value.clone(), &Shape::Point(shift.len()), origin);
                match (self.inverse_isometry(&shift, &turn), point.is_unknown()) {
                    (Value::Isometry(shift, turn), false) => self.move_value(&shift, &turn, &point, origin),
                    _ => Value::Unknown,
                }
            }
            _ => self.unknown_method(&Value::Isometry(shift, turn), word),
        }
    }
}

fn renamed(word: &Word, name: &str) -> Word {
    Word { name: name.into(), origin: word.origin }
}

fn vector_length(value: &Value) -> Option<usize> {
    match value {
        Value::Vector(nodes) | Value::Point(nodes) | Value::Translation(nodes) => Some(nodes.len()),
        _ => None,
    }
}
