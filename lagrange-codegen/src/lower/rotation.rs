//! Rotations and poses: what they do to vectors, points and each other.
//!
//! A rotation in the plane is its angle. A rotation in space keeps its nine entries and how it
//! was composed, from which mechanics takes the angular velocity.

use std::rc::Rc;

use super::interpreter::Interpreter;
use super::value::{Matrix, Turn, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::{NodeId, Unary};
use crate::kinematics::transposed;
use crate::model::{Lever, Rotation, RotationForm};
use crate::number::Number;

impl Interpreter<'_> {
    /// `Σ aᵢ bᵢ` as one flat sum.
    pub fn dot(&mut self, a: &[NodeId], b: &[NodeId]) -> NodeId {
        let graph = self.graph();
        let terms: Vec<(NodeId, Number)> =
            a.iter().zip(b).map(|(&a, &b)| (graph.mul(a, b), Number::ONE)).collect();
        graph.sum(Number::ZERO, &terms)
    }

    /// The rotation that does nothing.
    pub fn no_turn(&mut self, dimension: usize) -> Turn {
        let (zero, one) = (self.graph().zero(), self.graph().one());
        match dimension {
            2 => Turn::Plane(zero),
            _ => Turn::Space(Rc::new(self.rotation_about([zero, zero, one], zero))),
        }
    }

    /// The rotation about a unit axis u: c + u uᵀ (1 − c) + [u]ₓ s.
    pub fn rotation_about(&mut self, axis: [NodeId; 3], angle: NodeId) -> Rotation {
        let graph = self.graph();
        let (sine, cosine) = (graph.unary(Unary::Sin, angle), graph.unary(Unary::Cos, angle));
        let versine = graph.sum(Number::ONE, &[(cosine, Number::MINUS_ONE)]);
        let mut matrix = [[cosine; 3]; 3];
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                if i == j && graph.is_zero(axis[i]) {
                    continue;
                }
                if i == j && graph.as_constant(axis[i]).is_some_and(|a| a.abs().is_one()) {
                    *entry = graph.one();
                    continue;
                }
                let outer = graph.mul(axis[i], axis[j]);
                let outer = graph.mul(outer, versine);
                // The entry (i, j) of the cross product matrix is −u_k for even (i, j, k).
                let other = match (3 + j - i) % 3 {
                    0 => cosine,
                    1 => {
                        let turned = graph.mul(axis[(j + 1) % 3], sine);
                        graph.neg(turned)
                    }
                    _ => graph.mul(axis[(i + 1) % 3], sine),
                };
                *entry = graph.add(outer, other);
            }
        }
        Rotation { matrix, form: RotationForm::Axis { axis, angle } }
    }

    /// The product of two rotations; the right one applies first.
    pub fn rotation_product(&mut self, left: &Rotation, right: &Rotation) -> Rotation {
        let columns = transposed(&right.matrix);
        let mut matrix = left.matrix;
        for (row, entries) in matrix.iter_mut().enumerate() {
            for (column, entry) in entries.iter_mut().enumerate() {
                *entry = self.dot(&left.matrix[row], &columns[column]);
            }
        }
        let form = RotationForm::Product(Box::new(left.clone()), Box::new(right.clone()));
        Rotation { matrix, form }
    }

    /// A rotation known by its entries alone.
    pub fn rotation_of_entries(&mut self, matrix: &Matrix) -> Value {
        let row = |row: usize| [matrix.at(row, 0), matrix.at(row, 1), matrix.at(row, 2)];
        let matrix = [row(0), row(1), row(2)];
        Value::Rotation(Turn::Space(Rc::new(Rotation { matrix, form: RotationForm::Entries })))
    }

    /// The inverse rotation.
    pub fn inverse_turn(&mut self, turn: &Turn) -> Turn {
        match turn {
            Turn::Plane(angle) => Turn::Plane(self.graph().neg(*angle)),
            Turn::Space(rotation) => {
                let matrix = transposed(&rotation.matrix);
                let form = match &rotation.form {
                    RotationForm::Axis { axis, angle } => {
                        RotationForm::Axis { axis: *axis, angle: self.graph().neg(*angle) }
                    }
                    RotationForm::Quaternion([w, i, j, k]) => {
                        let [i, j, k] = [*i, *j, *k].map(|part| self.graph().neg(part));
                        RotationForm::Quaternion([*w, i, j, k])
                    }
                    RotationForm::Inverse(original) => original.form.clone(),
                    RotationForm::Turning(_) | RotationForm::Product(..) | RotationForm::Entries => {
                        RotationForm::Inverse(Box::new(Rotation::clone(rotation)))
                    }
                };
                Turn::Space(Rc::new(Rotation { matrix, form }))
            }
        }
    }

    /// The entries of a rotation.
    pub fn rotation_matrix(&mut self, turn: &Turn) -> Value {
        let (size, entries) = match turn {
            Turn::Plane(angle) => {
                let graph = self.graph();
                let (sine, cosine) = (graph.unary(Unary::Sin, *angle), graph.unary(Unary::Cos, *angle));
                (2, vec![cosine, graph.neg(sine), sine, cosine])
            }
            Turn::Space(rotation) => (3, rotation.matrix.as_flattened().to_vec()),
        };
        Value::matrix(size, size, entries)
    }

    /// A turned vector.
    pub fn turn_nodes(&mut self, turn: &Turn, nodes: &[NodeId]) -> Rc<[NodeId]> {
        match turn {
            Turn::Plane(angle) => {
                let graph = self.graph();
                let (sine, cosine) = (graph.unary(Unary::Sin, *angle), graph.unary(Unary::Cos, *angle));
                let products = [
                    graph.mul(cosine, nodes[0]),
                    graph.mul(sine, nodes[1]),
                    graph.mul(sine, nodes[0]),
                    graph.mul(cosine, nodes[1]),
                ];
                Rc::from([graph.sub(products[0], products[1]), graph.add(products[2], products[3])])
            }
            Turn::Space(rotation) => {
                let turned: Rc<[NodeId]> = rotation.matrix.iter().map(|row| self.dot(row, nodes)).collect();
                if let (Some(place), Some(arm)) = (three(&turned), three(nodes)) {
                    let base = [self.graph().zero(); 3];
                    self.model.levers.insert(Lever { place, base, rotation: rotation.as_ref().clone(), arm });
                }
                turned
            }
        }
    }

    /// `rotation * value`.
    pub fn turn_value(&mut self, turn: &Turn, value: &Value, origin: Origin) -> Value {
        let dimension = turn.dimension();
        match value {
            Value::Vector(nodes) if nodes.len() == dimension => Value::Vector(self.turn_nodes(turn, nodes)),
            Value::Point(nodes) if nodes.len() == dimension => Value::Point(self.turn_nodes(turn, nodes)),
            Value::Rotation(other) => match self.compose(turn, other) {
                Some(product) => Value::Rotation(product),
                None => self.cannot_turn(turn, value, origin),
            },
            Value::Isometry(shift, other) if shift.len() == dimension => {
                let shift = self.turn_nodes(turn, shift);
                self.compose(turn, other).map_or(Value::Unknown, |turn| Value::Isometry(shift, turn))
            }
            Value::Translation(shift) if shift.len() == dimension => {
                Value::Isometry(self.turn_nodes(turn, shift), turn.clone())
            }
            Value::Matrix(matrix) if matrix.rows == dimension => match self.rotation_matrix(turn) {
                Value::Matrix(entries) => {
                    let product = self.matrix_product(&entries, matrix);
                    Value::matrix(dimension, matrix.columns, product)
                }
                _ => Value::Unknown,
            },
            _ => self.cannot_turn(turn, value, origin),
        }
    }

    fn cannot_turn(&mut self, turn: &Turn, value: &Value, origin: Origin) -> Value {
        let turn = Value::Rotation(turn.clone());
        let message = match value {
            Value::Scalar(..) => catalogue::rotation_among_matrices(turn.describe()),
            _ => catalogue::cannot_multiply(turn.describe(), value.describe()),
        };
        self.refuse(origin, message)
    }

    /// `isometry * value`: points are shifted, vectors only turned.
    pub fn move_value(&mut self, shift: &Rc<[NodeId]>, turn: &Turn, value: &Value, origin: Origin) -> Value {
        match value {
            Value::Vector(_) => self.turn_value(turn, value, origin),
            Value::Point(nodes) if nodes.len() == shift.len() => {
                let turned = self.turn_nodes(turn, nodes);
                Value::Point(self.add_nodes(shift, &turned))
            }
            Value::Isometry(other, inner) if other.len() == shift.len() => {
                let turned = self.turn_nodes(turn, other);
                let shift = self.add_nodes(shift, &turned);
                self.compose(turn, inner).map_or(Value::Unknown, |turn| Value::Isometry(shift, turn))
            }
            Value::Translation(other) if other.len() == shift.len() => {
                let turned = self.turn_nodes(turn, other);
                Value::Isometry(self.add_nodes(shift, &turned), turn.clone())
            }
            Value::Rotation(other) if other.dimension() == shift.len() => {
                let shift = shift.clone();
                self.compose(turn, other).map_or(Value::Unknown, |turn| Value::Isometry(shift, turn))
            }
            _ => {
                let pose = Value::Isometry(shift.clone(), turn.clone());
                self.refuse(origin, catalogue::cannot_multiply(pose.describe(), value.describe()))
            }
        }
    }

    /// `translation * value`.
    pub fn shift_value(&mut self, shift: &Rc<[NodeId]>, value: &Value, origin: Origin) -> Value {
        match value {
            Value::Translation(other) if other.len() == shift.len() => {
                Value::Translation(self.add_nodes(shift, other))
            }
            Value::Rotation(turn) if turn.dimension() == shift.len() => {
                Value::Isometry(shift.clone(), turn.clone())
            }
            Value::Point(nodes) if nodes.len() == shift.len() => Value::Point(self.add_nodes(shift, nodes)),
            Value::Isometry(other, turn) if other.len() == shift.len() => {
                Value::Isometry(self.add_nodes(shift, other), turn.clone())
            }
            _ => {
                let shift = Value::Translation(shift.clone());
                self.refuse(origin, catalogue::cannot_multiply(shift.describe(), value.describe()))
            }
        }
    }

    /// The inverse pose.
    pub fn inverse_isometry(&mut self, shift: &[NodeId], turn: &Turn) -> Value {
        let back = self.inverse_turn(turn);
        let shift = self.turn_nodes(&back, shift);
        Value::Isometry(shift.iter().map(|&node| self.graph().neg(node)).collect(), back)
    }

    /// The sum of two vectors of equal length.
    pub fn add_nodes(&mut self, a: &[NodeId], b: &[NodeId]) -> Rc<[NodeId]> {
        let sum: Rc<[NodeId]> = a.iter().zip(b).map(|(&a, &b)| self.graph().add(a, b)).collect();
        self.carry(&sum, a, b);
        sum
    }

    /// Records what carries the sum of a position and a turned vector.
    fn carry(&mut self, sum: &[NodeId], a: &[NodeId], b: &[NodeId]) {
        let zero = [self.graph().zero(); 3];
        let (Some(place), Some(a), Some(b)) = (three(sum), three(a), three(b)) else { return };
        for (base, turned) in [(a, b), (b, a)] {
            if let Some(lever) = self.model.levers.of(&turned)
                && lever.base == zero
            {
                let lever = Lever { place, base, ..lever.clone() };
                return self.model.levers.insert(lever);
            }
        }
    }

    /// The rotation of a vector along a fixed axis, whose length is the angle.
    pub fn scaled_axis(&mut self, nodes: &[NodeId], origin: Origin) -> Value {
        let graph = self.graph();
        let nonzero: Vec<usize> = (0..nodes.len()).filter(|&i| !graph.is_zero(nodes[i])).collect();
        let (zero, one) = (graph.zero(), graph.one());
        if nodes.len() != 3 {
            return Value::Unknown;
        }
        if nonzero.is_empty() {
            return Value::Rotation(self.no_turn(3));
        }
        if let [only] = nonzero.as_slice() {
            let mut axis = [zero; 3];
            axis[*only] = one;
            let angle = nodes[*only];
            return Value::Rotation(Turn::Space(Rc::new(self.rotation_about(axis, angle))));
        }
        // Constants times one common node, or constants alone.
        let common = nonzero.iter().map(|&i| match graph.as_constant(nodes[i]) {
            Some(value) => (value, one),
            None => graph.scaled(nodes[i]),
        });
        let common: Vec<(Number, NodeId)> = common.collect();
        let node = common[0].1;
        if common.iter().any(|(_, other)| *other != node) {
            return self.refuse(origin, catalogue::axis_not_fixed());
        }
        let square = common.iter().fold(Number::ZERO, |sum, (value, _)| sum + *value * *value);
        let length = square.sqrt();
        let Some(inverse) = length.recip() else { return Value::Unknown };
        let mut axis = [zero; 3];
        for (&place, (value, _)) in nonzero.iter().zip(&common) {
            axis[place] = graph.constant(*value * inverse);
        }
        let angle = graph.scale(node, length);
        Value::Rotation(Turn::Space(Rc::new(self.rotation_about(axis, angle))))
    }

    /// Rotations about x, then y, then z, all of them space axes.
    pub fn euler_angles(&mut self, roll: NodeId, pitch: NodeId, yaw: NodeId) -> Value {
        let (zero, one) = (self.graph().zero(), self.graph().one());
        let about_x = self.rotation_about([one, zero, zero], roll);
        let about_y = self.rotation_about([zero, one, zero], pitch);
        let about_z = self.rotation_about([zero, zero, one], yaw);
        let yaw_pitch = self.rotation_product(&about_z, &about_y);
        Value::Rotation(Turn::Space(Rc::new(self.rotation_product(&yaw_pitch, &about_x))))
    }
}

fn three(nodes: &[NodeId]) -> Option<[NodeId; 3]> {
    nodes.try_into().ok()
}
