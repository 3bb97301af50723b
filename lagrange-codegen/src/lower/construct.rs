//! Associated functions of nalgebra's types: `Vector3::new`, `Rotation3::from_axis_angle`, ….

use std::rc::Rc;

use super::advice::argument_count;
use super::interpreter::Interpreter;
use super::shape::Shape;
use super::value::{Matrix, Turn, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::NodeId;
use crate::syntax::body::{Expr, Owner, Path, Word};
use crate::syntax::types::Type;

impl<'a> Interpreter<'a> {
    /// `Type::name(arguments)`.
    pub fn construct(&mut self, ty: &'a Type, word: &Word, arguments: Vec<Value>, origin: Origin) -> Value {
        if arguments.iter().any(Value::is_unknown) {
            return Value::Unknown;
        }
        let name = &*word.name;
        let before = self.reports;
        let built = match self.shape(ty) {
            Shape::Scalar => return self.scalar_function(word, arguments, origin),
            Shape::Vector(length) => self.new_vector(length, name, &arguments, origin).map(Value::Vector),
            Shape::Point(length) => match (name, arguments.as_slice()) {
                ("origin", []) => Some(Value::Point(vec![self.graph().zero(); length].into())),
                _ => self.new_vector(length, name, &arguments, origin).map(Value::Point),
            },
            Shape::Translation(length) => match (name, arguments.as_slice()) {
                ("identity", []) => Some(Value::Translation(vec![self.graph().zero(); length].into())),
                _ => self.new_vector(length, name, &arguments, origin).map(Value::Translation),
            },
            Shape::Matrix(rows, columns) => self.new_matrix(rows, columns, name, &arguments, origin),
            Shape::Rotation(2) => self.new_plane_rotation(name, &arguments, origin),
            Shape::Quaternion if matches!(name, "from_quaternion" | "new_normalize" | "new_unchecked") => {
                self.new_unit_quaternion(name, &arguments, origin)
            }
            Shape::Rotation(_) | Shape::Quaternion => self.new_space_rotation(name, &arguments, origin),
            Shape::AnyQuaternion => self.new_quaternion(name, &arguments, origin),
            Shape::Isometry(dimension) => self.new_isometry(dimension, name, &arguments, origin),
            Shape::Any
            | Shape::Unit
            | Shape::Boolean
            | Shape::Integer(_)
            | Shape::Array(..)
            | Shape::Slice(_)
            | Shape::Tuple(_)
            | Shape::Twist(_)
            | Shape::Record(_) => None,
        };
        match built {
            Some(value) => value,
            None if self.reports > before => Value::Unknown,
            None if arguments.is_empty() => {
                self.refuse(word.origin, catalogue::unknown_function(name, near_constructor(name)))
            }
            None if CONSTRUCTORS.contains(&name) => {
                let given: Vec<String> = arguments.iter().map(Value::describe).collect();
                self.refuse(origin, catalogue::bad_constructor_arguments(name, given.join(", ")))
            }
            None => self.first_method(arguments, word, name, origin),
        }
    }

    /// The scalars of some arguments; `None` if one is none, which is reported.
    fn scalars(&mut self, arguments: &[Value], origin: Origin) -> Option<Vec<NodeId>> {
        let nodes: Vec<Option<NodeId>> =
            arguments.iter().map(|argument| self.scalar(argument.clone(), origin)).collect();
        nodes.into_iter().collect()
    }

    fn new_vector(
        &mut self,
        length: usize,
        name: &str,
        arguments: &[Value],
        origin: Origin,
    ) -> Option<Rc<[NodeId]>> {
        match (name, arguments) {
            ("new", _) if arguments.len() == length => Some(self.scalars(arguments, origin)?.into()),
            ("zeros", []) => Some(self.zeros(length)),
            ("repeat" | "from_element", [value]) => {
                let node = self.scalar(value.clone(), origin)?;
                Some(vec![node; length].into())
            }
            ("x" | "x_axis", []) => self.basis(length, 0),
            ("y" | "y_axis", []) => self.basis(length, 1),
            ("z" | "z_axis", []) => self.basis(length, 2),
            ("ith", [Value::Integer(index, ..), value]) => {
                let index = usize::try_from(*index).ok().filter(|index| *index < length)?;
                let node = self.scalar(value.clone(), origin)?;
                let mut nodes = self.zeros(length).to_vec();
                nodes[index] = node;
                Some(nodes.into())
            }
            ("from" | "from_row_slice" | "from_column_slice" | "new_unchecked", [value]) => {
                self.vector(value.clone(), length, origin)
            }
            ("new_normalize", [value]) => {
                let nodes = self.vector(value.clone(), length, origin)?;
                Some(self.normalized(&nodes))
            }
            _ => None,
        }
    }

    fn zeros(&mut self, length: usize) -> Rc<[NodeId]> {
        vec![self.graph().zero(); length].into()
    }

    fn basis(&mut self, length: usize, axis: usize) -> Option<Rc<[NodeId]>> {
        let mut nodes = self.zeros(length).to_vec();
        *nodes.get_mut(axis)? = self.graph().one();
        Some(nodes.into())
    }

    fn new_matrix(
        &mut self,
        rows: usize,
        columns: usize,
        name: &str,
        arguments: &[Value],
        origin: Origin,
    ) -> Option<Value> {
        let size = rows * columns;
        let entries = match (name, arguments) {
            ("new", _) if arguments.len() == size => self.scalars(arguments, origin)?,
            ("zeros", []) => vec![self.graph().zero(); size],
            ("repeat" | "from_element", [value]) => vec![self.scalar(value.clone(), origin)?; size],
            ("identity", []) => {
                let one = self.graph().one();
                self.diagonal(rows, columns, &vec![one; rows.min(columns)])
            }
            ("from_diagonal_element", [value]) => {
                let node = self.scalar(value.clone(), origin)?;
                self.diagonal(rows, columns, &vec![node; rows.min(columns)])
            }
            ("from_diagonal", [value]) => {
                let nodes = self.vector(value.clone(), rows.min(columns), origin)?;
                self.diagonal(rows, columns, &nodes)
            }
            ("from_row_slice", [Value::Array(elements)]) if elements.len() == size => {
                self.scalars(elements, origin)?
            }
            ("from_column_slice", [Value::Array(elements)]) if elements.len() == size => {
                let nodes = self.scalars(elements, origin)?;
                (0..size).map(|i| nodes[i % columns * rows + i / columns]).collect()
            }
            ("from_columns" | "from", [Value::Array(vectors)]) if vectors.len() == columns => {
                let vectors = self.vectors(vectors, rows, origin)?;
                (0..size).map(|i| vectors[i % columns][i / columns]).collect()
            }
            ("from_rows", [Value::Array(vectors)]) if vectors.len() == rows => {
                let mut entries = Vec::with_capacity(size);
                for row in vectors.iter() {
                    match row {
                        Value::Matrix(row) if row.rows == 1 && row.columns == columns => {
                            entries.extend(&row.entries);
                        }
                        other => entries.extend(self.vector(other.clone(), columns, origin)?.iter()),
                    }
                }
                entries
            }
            ("from", [Value::Rotation(turn)]) if turn.dimension() == rows && rows == columns => {
                return Some(self.rotation_matrix(turn));
            }
            _ => return None,
        };
        Some(Value::matrix(rows, columns, entries))
    }

    fn vectors(&mut self, list: &[Value], length: usize, origin: Origin) -> Option<Vec<Rc<[NodeId]>>> {
        list.iter().map(|value| self.vector(value.clone(), length, origin)).collect()
    }

    fn diagonal(&mut self, rows: usize, columns: usize, nodes: &[NodeId]) -> Vec<NodeId> {
        let mut entries = vec![self.graph().zero(); rows * columns];
        for (index, node) in nodes.iter().enumerate() {
            entries[index * columns + index] = *node;
        }
        entries
    }

    fn new_plane_rotation(&mut self, name: &str, arguments: &[Value], origin: Origin) -> Option<Value> {
        let angle = match (name, arguments) {
            ("new" | "from_angle", [angle]) => self.scalar(angle.clone(), origin)?,
            ("identity", []) => self.graph().zero(),
            ("from" | "from_rotation_matrix", [Value::Rotation(Turn::Plane(angle))]) => *angle,
            ("from_cos_sin_unchecked", [cosine, sine]) => {
                let (cosine, sine) =
                    (self.scalar(cosine.clone(), origin)?, self.scalar(sine.clone(), origin)?);
                self.graph().atan2(sine, cosine)
            }
            ("from_matrix_unchecked", [Value::Matrix(matrix)]) if matrix.rows == 2 => {
                let (sine, cosine) = (matrix.at(1, 0), matrix.at(0, 0));
                self.graph().atan2(sine, cosine)
            }
            _ => return None,
        };
        Some(Value::Rotation(Turn::Plane(angle)))
    }

    fn new_space_rotation(&mut self, name: &str, arguments: &[Value], origin: Origin) -> Option<Value> {
        match (name, arguments) {
            ("identity", []) => Some(Value::Rotation(self.no_turn(3))),
            ("new" | "from_scaled_axis", [axis]) => {
                let nodes = self.vector(axis.clone(), 3, origin)?;
                Some(self.scaled_axis(&nodes, origin))
            }
            ("from_axis_angle", [axis, angle]) => {
                let axis = self.vector(axis.clone(), 3, origin)?;
                let angle = self.scalar(angle.clone(), origin)?;
                let rotation = self.rotation_about([axis[0], axis[1], axis[2]], angle);
                Some(Value::Rotation(Turn::Space(Rc::new(rotation))))
            }
            ("from_euler_angles", [_, _, _]) => {
                let angles = self.scalars(arguments, origin)?;
                Some(self.euler_angles(angles[0], angles[1], angles[2]))
            }
            ("from" | "from_rotation_matrix", [value @ Value::Rotation(Turn::Space(_))]) => {
                Some(value.clone())
            }
            ("from_matrix_unchecked", [value]) => {
                match self.coerce(value.clone(), &Shape::Matrix(3, 3), origin) {
                    Value::Matrix(matrix) => Some(self.rotation_of_entries(&matrix)),
                    _ => Some(Value::Unknown),
                }
            }
            ("from_basis_unchecked", [Value::Array(columns)]) if columns.len() == 3 => {
                let columns = self.vectors(columns, 3, origin)?;
                let entries = (0..9).map(|i| columns[i % 3][i / 3]).collect();
                Some(self.rotation_of_entries(&Matrix { rows: 3, columns: 3, entries }))
            }
            _ => None,
        }
    }

    fn new_isometry(
        &mut self,
        dimension: usize,
        name: &str,
        arguments: &[Value],
        origin: Origin,
    ) -> Option<Value> {
        match (name, arguments) {
            ("identity", []) => Some(Value::Isometry(self.zeros(dimension), self.no_turn(dimension))),
            ("translation", _) if arguments.len() == dimension => {
                let nodes = self.scalars(arguments, origin)?;
                Some(Value::Isometry(nodes.into(), self.no_turn(dimension)))
            }
            ("rotation", [turn]) => {
                let turn = self.turn_argument(dimension, turn, origin)?;
                Some(Value::Isometry(self.zeros(dimension), turn))
            }
            ("new", [shift, turn]) => {
                let shift = self.vector(shift.clone(), dimension, origin)?;
                Some(Value::Isometry(shift, self.turn_argument(dimension, turn, origin)?))
            }
            ("from_parts", [shift, turn]) => {
                let shift = match self.coerce(shift.clone(), &Shape::Translation(dimension), origin) {
                    Value::Translation(shift) => shift,
                    _ => return Some(Value::Unknown),
                };
                match self.coerce(turn.clone(), &Shape::Rotation(dimension), origin) {
                    Value::Rotation(turn) => Some(Value::Isometry(shift, turn)),
                    _ => Some(Value::Unknown),
                }
            }
            _ => None,
        }
    }

    /// An angle in the plane, an axis times an angle in space.
    fn turn_argument(&mut self, dimension: usize, value: &Value, origin: Origin) -> Option<Turn> {
        if dimension == 2 {
            return Some(Turn::Plane(self.scalar(value.clone(), origin)?));
        }
        let nodes = self.vector(value.clone(), 3, origin)?;
        match self.scaled_axis(&nodes, origin) {
            Value::Rotation(turn) => Some(turn),
            _ => None,
        }
    }

    /// `matrix![…]`.
    pub fn matrix_literal(&mut self, rows: &'a [Vec<Expr>], origin: Origin) -> Value {
        let columns = rows.first().map_or(0, Vec::len);
        if columns == 0 || rows.iter().any(|row| row.len() != columns) {
            return self.refuse(origin, catalogue::ragged_matrix());
        }
        let mut entries = Vec::with_capacity(rows.len() * columns);
        for row in rows {
            entries.extend(row.iter().filter_map(|entry| self.scalar_of(entry)));
        }
        match entries.len() == rows.len() * columns {
            true => Value::matrix(rows.len(), columns, entries),
            false => Value::Unknown,
        }
    }

    /// `Vector3::from_fn(|i, j| …)`; arrays come through [`Interpreter::array_by_function`].
    pub fn by_function(&mut self, path: &'a Path, arguments: &'a [Expr], origin: Origin) -> Value {
        let (rows, columns) = match &path.owner {
            Owner::Type(ty) => match self.shape(ty) {
                Shape::Vector(rows) => (rows, 1),
                Shape::Matrix(rows, columns) => (rows, columns),
                _ => return self.refuse(path.origin, catalogue::free_function(&path.text)),
            },
            Owner::None | Owner::SelfType | Owner::Other(_) | Owner::Local(_) => {
                return self.refuse(path.origin, catalogue::from_fn_length());
            }
        };
        let [function] = arguments else {
            return self.refuse(origin, argument_count("from_fn", 1, arguments.len()));
        };
        let Some(function) = self.callable(function) else { return Value::Unknown };
        let mut entries = Vec::with_capacity(rows * columns);
        for row in 0..rows {
            for column in 0..columns {
                let index = [row, column].map(Value::index);
                // Nalgebra goes column by column, so the closure must not depend on the order.
                let value = self.apply_later(function, index.to_vec(), origin);
                entries.extend(self.scalar(value, origin));
            }
        }
        match entries.len() == rows * columns {
            true => Value::matrix(rows, columns, entries),
            false => Value::Unknown,
        }
    }

    /// `array::from_fn(|i| …)` where the length is known from the context.
    pub fn array_by_function(&mut self, length: usize, function: &'a Expr, origin: Origin) -> Value {
        let Some(function) = self.callable(function) else { return Value::Unknown };
        let elements = (0..length).map(|index| self.apply(function, vec![Value::index(index)], origin));
        Value::array(elements.collect())
    }
}

/// All associated functions, of whatever type.
pub(super) const CONSTRUCTORS: [&str; 40] = [
    "new",
    "zeros",
    "repeat",
    "from_element",
    "x",
    "y",
    "z",
    "x_axis",
    "y_axis",
    "z_axis",
    "ith",
    "from",
    "from_row_slice",
    "from_column_slice",
    "new_unchecked",
    "new_normalize",
    "origin",
    "identity",
    "from_diagonal",
    "from_diagonal_element",
    "from_columns",
    "from_rows",
    "from_fn",
    "from_angle",
    "from_rotation_matrix",
    "from_cos_sin_unchecked",
    "from_matrix_unchecked",
    "from_scaled_axis",
    "from_axis_angle",
    "from_euler_angles",
    "from_basis_unchecked",
    "from_parts",
    "from_quaternion",
    "from_imag",
    "from_real",
    "translation",
    "rotation",
    "zero",
    "one",
    "pi",
];

fn near_constructor(name: &str) -> Option<String> {
    crate::syntax::suggest::nearest(name, CONSTRUCTORS).map(String::from)
}
