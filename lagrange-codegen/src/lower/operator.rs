//! Operators: numbers, vectors, matrices, rotations and poses.

use std::rc::Rc;

use super::advice::meets_integer;
use super::compare::is_comparison;
use super::interpreter::Interpreter;
use super::statement::like;
use super::value::{Matrix, Turn, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::{Dependence, NodeId};
use crate::syntax::body::{BinaryOperator, Expr, UnaryOperator};
use crate::syntax::constant;

impl<'a> Interpreter<'a> {
    /// `-x`, `!x`.
    pub fn unary(&mut self, operator: UnaryOperator, operand: Value, origin: Origin) -> Value {
        match (operator, operand) {
            (_, Value::Unknown) => Value::Unknown,
            (UnaryOperator::Not, Value::Boolean(value)) => Value::Boolean(!value),
            (UnaryOperator::Not, Value::Choice(weight)) => Value::Choice(self.opposite(weight)),
            (UnaryOperator::Negate, Value::Integer(value, types)) => match value.checked_neg() {
                Some(value) => self.integer(value, types, origin),
                None => self.refuse(origin, catalogue::integer_overflow()),
            },
            (UnaryOperator::Negate, Value::Scalar(node, rounded)) => {
                Value::Scalar(self.graph().neg(node), rounded.negated())
            }
            (operator, Value::Parameter(id)) => self.unary_of_parameter(operator, id, origin),
            (UnaryOperator::Negate, Value::Vector(nodes)) => {
                Value::Vector(nodes.iter().map(|&node| self.graph().neg(node)).collect())
            }
            (UnaryOperator::Negate, Value::Quaternion(parts)) => {
                Value::Quaternion(parts.map(|part| self.graph().neg(part)))
            }
            (UnaryOperator::Negate, Value::Matrix(matrix)) => {
                self.scale_matrix(&matrix, |graph, node| graph.neg(node))
            }
            (_, Value::Record(record)) => {
                let message = self.record_as_value(record);
                self.refuse(origin, message)
            }
            (operator, operand) => {
                self.refuse(origin, catalogue::bad_operand(operator.sign(), operand.describe()))
            }
        }
    }

    /// `left operator right`; conditions are not evaluated further than needed.
    pub fn binary(
        &mut self,
        operator: BinaryOperator,
        left: &'a Expr,
        right: &'a Expr,
        origin: Origin,
    ) -> Value {
        let first = self.expression(left);
        match (operator, &first) {
            (BinaryOperator::And, Value::Boolean(false)) | (BinaryOperator::Or, Value::Boolean(true)) => {
                first
            }
            _ => {
                let second = self.asked(operator, &first, right, origin);
                match (&first, &second) {
                    (Value::Integer(value, ..), other) if meets_integer(operator, other) => {
                        self.integer_as_number(*value, left)
                    }
                    (other, Value::Integer(value, ..)) if meets_integer(operator, other) => {
                        self.integer_as_number(*value, right)
                    }
                    operands => {
                        let whole = self.of_integers(operator, operands.into(), Some([left, right]), origin);
                        whole.unwrap_or_else(|| self.arithmetic(operator, first, second, origin))
                    }
                }
            }
        }
    }

    /// An operator on two values.
    pub fn arithmetic(
        &mut self,
        operator: BinaryOperator,
        left: Value,
        right: Value,
        origin: Origin,
    ) -> Value {
        if left.is_unknown() || right.is_unknown() {
            return Value::Unknown;
        }
        if let (Value::Integer(a, first), Value::Integer(b, second)) = (&left, &right)
            && !is_comparison(operator)
        {
            return match constant::arithmetic(operator, *a, *b) {
                Some(value) => self.integer(value, *first & *second, origin),
                None if *b == 0 => self.refuse(origin, catalogue::integer_division_by_zero()),
                None => self.refuse(origin, catalogue::integer_overflow()),
            };
        }
        if let Some(value) = self.of_integers(operator, [&left, &right], None, origin) {
            return value;
        }
        if let (BinaryOperator::Remainder, Value::Scalar(node, rounded)) = (operator, &left)
            && let Some(value) = self.jump("%", (*node, *rounded), std::slice::from_ref(&right), origin)
        {
            return value;
        }
        if let (Value::Scalar(_, first), Value::Scalar(_, second)) = (&left, &right)
            && !is_comparison(operator)
        {
            let rounded = first.arithmetic(operator, *second);
            return match self.exact(operator, left, right, origin) {
                Value::Scalar(node, _) if self.model.graph.dependence(node) == Dependence::NONE => {
                    Value::Scalar(node, rounded)
                }
                other => other,
            };
        }
        self.exact(operator, left, right, origin)
    }

    /// An operator on two values. Constants among them are exact.
    fn exact(&mut self, operator: BinaryOperator, left: Value, right: Value, origin: Origin) -> Value {
        match operator {
            BinaryOperator::Add | BinaryOperator::Subtract => self.additive(operator, left, right, origin),
            BinaryOperator::Multiply => self.multiply(left, right, origin),
            BinaryOperator::Divide => self.divide(left, right, origin),
            BinaryOperator::Remainder => self.refuse(origin, catalogue::remainder()),
            BinaryOperator::And | BinaryOperator::Or => match (left, right) {
                (Value::Boolean(a), Value::Boolean(b)) => {
                    Value::Boolean(if operator == BinaryOperator::And { a && b } else { a || b })
                }
                (left, right) => self.both(operator, left, right, origin),
            },
            BinaryOperator::Equal
            | BinaryOperator::NotEqual
            | BinaryOperator::Less
            | BinaryOperator::LessEqual
            | BinaryOperator::Greater
            | BinaryOperator::GreaterEqual => self.compare(operator, left, right, origin),
        }
    }

    /// Operands that do not go together.
    pub fn mismatch(
        &mut self,
        operator: BinaryOperator,
        left: &Value,
        right: &Value,
        origin: Origin,
    ) -> Value {
        let (a, b) = (left.describe(), right.describe());
        let message = match (operator, left, right) {
            (_, Value::Record(record), _) | (_, _, Value::Record(record)) => self.record_as_value(*record),
            (_, Value::Integer(value, ..), other) | (_, other, Value::Integer(value, ..))
                if matches!(
                    other,
                    Value::Scalar(..) | Value::Parameter(_) | Value::Vector(_) | Value::Matrix(_)
                ) =>
            {
                catalogue::integer_for_scalar(value)
            }
            // A field without a shape is a scalar.
            (BinaryOperator::Add | BinaryOperator::Subtract, scalar @ Value::Scalar(..), other)
            | (BinaryOperator::Add | BinaryOperator::Subtract, other, scalar @ Value::Scalar(..))
                if !matches!(other, Value::Scalar(..)) && self.taken_for_scalar(scalar).is_some() =>
            {
                let path = self.taken_for_scalar(scalar).unwrap_or_default();
                catalogue::taken_for_scalar(path, other.describe())
            }
            (BinaryOperator::Add | BinaryOperator::Subtract, Value::Rotation(_), _)
            | (BinaryOperator::Multiply, Value::Rotation(_), Value::Scalar(..)) => {
                catalogue::rotation_among_matrices(a)
            }
            (BinaryOperator::Add | BinaryOperator::Subtract, _, Value::Rotation(_))
            | (BinaryOperator::Multiply, Value::Scalar(..), Value::Rotation(_)) => {
                catalogue::rotation_among_matrices(b)
            }
            (BinaryOperator::Add, ..) => catalogue::cannot_add(b, a),
            (BinaryOperator::Subtract, ..) => catalogue::cannot_subtract(b, a),
            (BinaryOperator::Multiply, ..) => catalogue::cannot_multiply(a, b),
            (BinaryOperator::Divide, ..) => catalogue::cannot_divide(a, b),
            _ => catalogue::cannot_compare(a, b),
        };
        self.refuse(origin, message)
    }

    fn additive(&mut self, operator: BinaryOperator, left: Value, right: Value, origin: Origin) -> Value {
        let combine = |graph: &mut crate::expr::Graph, a: NodeId, b: NodeId| match operator {
            BinaryOperator::Subtract => graph.sub(a, b),
            _ => graph.add(a, b),
        };
        // A parameter takes the shape of its partner.
        let (left, right) = match (left, right) {
            (Value::Parameter(a), Value::Parameter(b)) => {
                let (a, b) = (self.scalar_parameter(a, origin), self.scalar_parameter(b, origin));
                match (a, b) {
                    (Some(a), Some(b)) => (Value::scalar(a), Value::scalar(b)),
                    _ => return Value::Unknown,
                }
            }
            (left @ Value::Parameter(_), right) if !matches!(right, Value::Integer(..)) => {
                (self.coerce(left, &like(&right), origin), right)
            }
            (left, right @ Value::Parameter(_)) if !matches!(left, Value::Integer(..)) => {
                let shape = match &left {
                    // A point moves by a vector; the difference of points needs an annotation.
                    Value::Point(nodes) => super::shape::Shape::Vector(nodes.len()),
                    other => like(other),
                };
                let right = self.coerce(right, &shape, origin);
                (left, right)
            }
            known => known,
        };
        match (&left, &right) {
            (Value::Unknown, _) | (_, Value::Unknown) => Value::Unknown,
            (Value::Scalar(a, ..), Value::Scalar(b, ..)) => Value::scalar(combine(self.graph(), *a, *b)),
            (Value::Vector(a), Value::Vector(b)) if a.len() == b.len() => Value::Vector(match operator {
                BinaryOperator::Subtract => self.zip_nodes(a, b, combine),
                _ => self.add_nodes(a, b),
            }),
            (Value::Point(a), Value::Vector(b)) if a.len() == b.len() => Value::Point(match operator {
                BinaryOperator::Subtract => self.zip_nodes(a, b, combine),
                _ => self.add_nodes(a, b),
            }),
            (Value::Point(a), Value::Point(b))
                if a.len() == b.len() && operator == BinaryOperator::Subtract =>
            {
                Value::Vector(self.zip_nodes(a, b, combine))
            }
            (Value::Quaternion(a), Value::Quaternion(b)) => {
                Value::Quaternion([0, 1, 2, 3].map(|part| combine(self.graph(), a[part], b[part])))
            }
            (Value::Matrix(a), Value::Matrix(b)) if a.rows == b.rows && a.columns == b.columns => {
                let entries = self.zip_nodes(&a.entries, &b.entries, combine).to_vec();
                Value::Matrix(Rc::new(Matrix { rows: a.rows, columns: a.columns, entries }))
            }
            _ => self.mismatch(operator, &left, &right, origin),
        }
    }

    fn zip_nodes(
        &mut self,
        a: &[NodeId],
        b: &[NodeId],
        mut combine: impl FnMut(&mut crate::expr::Graph, NodeId, NodeId) -> NodeId,
    ) -> Rc<[NodeId]> {
        a.iter().zip(b).map(|(&a, &b)| combine(&mut self.model.graph, a, b)).collect()
    }

    /// A matrix with a function applied to every entry.
    pub fn scale_matrix(
        &mut self,
        matrix: &Matrix,
        mut each: impl FnMut(&mut crate::expr::Graph, NodeId) -> NodeId,
    ) -> Value {
        let entries = matrix.entries.iter().map(|&node| each(&mut self.model.graph, node)).collect();
        Value::matrix(matrix.rows, matrix.columns, entries)
    }

    fn multiply(&mut self, left: Value, right: Value, origin: Origin) -> Value {
        let (left, right) = match (left, right) {
            // A parameter beside a value of known shape is a scalar, but a vector behind a rotation. Matrices
            // and poses leave its shape open.
            (Value::Rotation(turn), Value::Parameter(id)) => {
                let shape = super::shape::Shape::Vector(turn.dimension());
                let right = self.coerce(Value::Parameter(id), &shape, origin);
                (Value::Rotation(turn), right)
            }
            (Value::Matrix(_) | Value::Isometry(..) | Value::Translation(_), Value::Parameter(id)) => {
                let text = self.parameters.text(id).to_string();
                return self.refuse(origin, catalogue::unknown_shape(text));
            }
            (Value::Parameter(id), right) => {
                let Some(node) = self.scalar_parameter(id, origin) else { return Value::Unknown };
                (Value::scalar(node), self.parameter_scalar(right, origin))
            }
            (left, right) => (left, self.parameter_scalar(right, origin)),
        };
        match (&left, &right) {
            (Value::Unknown, _) | (_, Value::Unknown) => Value::Unknown,
            (Value::Scalar(a, ..), Value::Scalar(b, ..)) => Value::scalar(self.graph().mul(*a, *b)),
            (Value::Scalar(factor, ..), Value::Vector(nodes))
            | (Value::Vector(nodes), Value::Scalar(factor, ..)) => {
                Value::Vector(nodes.iter().map(|&node| self.graph().mul(*factor, node)).collect())
            }
            (Value::Scalar(factor, ..), Value::Point(nodes))
            | (Value::Point(nodes), Value::Scalar(factor, ..)) => {
                Value::Point(nodes.iter().map(|&node| self.graph().mul(*factor, node)).collect())
            }
            (Value::Scalar(factor, ..), Value::Matrix(matrix))
            | (Value::Matrix(matrix), Value::Scalar(factor, ..)) => {
                self.scale_matrix(matrix, |graph, node| graph.mul(*factor, node))
            }
            (Value::Scalar(factor, ..), Value::Quaternion(parts))
            | (Value::Quaternion(parts), Value::Scalar(factor, ..)) => {
                Value::Quaternion(parts.map(|part| self.graph().mul(*factor, part)))
            }
            (Value::Quaternion(a), Value::Quaternion(b)) => self.quaternion_product(a, b),
            (Value::Matrix(matrix), Value::Vector(nodes)) if matrix.columns == nodes.len() => {
                let rows: Vec<NodeId> = (0..matrix.rows)
                    .map(|row| {
                        let row = &matrix.entries[row * matrix.columns..][..matrix.columns];
                        self.dot(row, nodes)
                    })
                    .collect();
                Value::Vector(rows.into())
            }
            (Value::Matrix(a), Value::Matrix(b)) if a.columns == b.rows => {
                let entries = self.matrix_product(a, b);
                Value::matrix(a.rows, b.columns, entries)
            }
            (Value::Vector(column), Value::Matrix(row)) if row.rows == 1 => {
                let mut entries = Vec::with_capacity(column.len() * row.columns);
                for &a in column.iter() {
                    entries.extend(row.entries.iter().map(|&b| self.model.graph.mul(a, b)));
                }
                Value::matrix(column.len(), row.columns, entries)
            }
            (Value::Rotation(turn), _) => self.turn_value(turn, &right, origin),
            (Value::Isometry(shift, turn), _) => self.move_value(shift, turn, &right, origin),
            (Value::Translation(shift), _) => self.shift_value(shift, &right, origin),
            (Value::Matrix(matrix), Value::Rotation(turn)) => {
                let turned = self.rotation_matrix(turn);
                match turned {
                    Value::Matrix(other) if matrix.columns == other.rows => {
                        let entries = self.matrix_product(matrix, &other);
                        Value::matrix(matrix.rows, other.columns, entries)
                    }
                    _ => self.mismatch(BinaryOperator::Multiply, &left, &right, origin),
                }
            }
            _ => self.mismatch(BinaryOperator::Multiply, &left, &right, origin),
        }
    }

    /// The entries of a product, row by row.
    pub fn matrix_product(&mut self, a: &Matrix, b: &Matrix) -> Vec<NodeId> {
        let mut entries = Vec::with_capacity(a.rows * b.columns);
        for row in 0..a.rows {
            for column in 0..b.columns {
                let left: Vec<NodeId> = (0..a.columns).map(|k| a.at(row, k)).collect();
                let right: Vec<NodeId> = (0..a.columns).map(|k| b.at(k, column)).collect();
                entries.push(self.dot(&left, &right));
            }
        }
        entries
    }

    /// A parameter among operands of known shape is a scalar.
    fn parameter_scalar(&mut self, value: Value, origin: Origin) -> Value {
        match value {
            Value::Parameter(id) => self.scalar_parameter(id, origin).map_or(Value::Unknown, Value::scalar),
            known => known,
        }
    }

    fn divide(&mut self, left: Value, right: Value, origin: Origin) -> Value {
        let (left, right) = (self.parameter_scalar(left, origin), self.parameter_scalar(right, origin));
        if let Value::Scalar(divisor, ..) = right
            && self.graph().is_zero(divisor)
        {
            return self.refuse(origin, catalogue::division_by_zero());
        }
        match (&left, &right) {
            (Value::Unknown, _) | (_, Value::Unknown) => Value::Unknown,
            (Value::Scalar(a, ..), Value::Scalar(b, ..)) => Value::scalar(self.graph().div(*a, *b)),
            (Value::Vector(nodes), Value::Scalar(b, ..)) => {
                Value::Vector(nodes.iter().map(|&node| self.graph().div(node, *b)).collect())
            }
            (Value::Point(nodes), Value::Scalar(b, ..)) => {
                Value::Point(nodes.iter().map(|&node| self.graph().div(node, *b)).collect())
            }
            (Value::Matrix(matrix), Value::Scalar(b, ..)) => {
                self.scale_matrix(matrix, |graph, node| graph.div(node, *b))
            }
            (Value::Quaternion(parts), Value::Scalar(b, ..)) => {
                Value::Quaternion(parts.map(|part| self.graph().div(part, *b)))
            }
            (Value::Rotation(turn), Value::Rotation(other)) if turn.dimension() == other.dimension() => {
                let inverse = self.inverse_turn(other);
                self.turn_value(turn, &Value::Rotation(inverse), origin)
            }
            _ => self.mismatch(BinaryOperator::Divide, &left, &right, origin),
        }
    }

    /// The composition of two rotations.
    pub fn compose(&mut self, left: &Turn, right: &Turn) -> Option<Turn> {
        match (left, right) {
            (Turn::Plane(a), Turn::Plane(b)) => Some(Turn::Plane(self.graph().add(*a, *b))),
            (Turn::Space(a), Turn::Space(b)) => Some(Turn::Space(Rc::new(self.rotation_product(a, b)))),
            (Turn::Plane(_), Turn::Space(_)) | (Turn::Space(_), Turn::Plane(_)) => None,
        }
    }
}
