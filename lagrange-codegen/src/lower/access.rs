//! Fields and elements.

use super::advice::{counted, valid_entries, valid_indices};
use super::interpreter::Interpreter;
use super::value::{Turn, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::syntax::Record;
use crate::syntax::body::{Expr, ExprKind, Name, Word};

impl<'a> Interpreter<'a> {
    /// `base.name`.
    pub fn field(&mut self, base: Value, word: &Word, origin: Origin) -> Value {
        let name = &*word.name;
        match &base {
            Value::Unknown => Value::Unknown,
            Value::Parameter(id) => Value::Parameter(self.parameter_field(*id, name, origin)),
            Value::Record(record) => self.record_field(*record, word),
            Value::Vector(nodes) | Value::Translation(nodes) | Value::Point(nodes) => {
                match (&base, name, component(name)) {
                    (_, _, Some(index)) if index < nodes.len() => Value::scalar(nodes[index]),
                    (Value::Translation(_), "vector", _) | (Value::Point(_), "coords", _) => {
                        Value::Vector(nodes.clone())
                    }
                    _ => self.unknown_field(&base, word),
                }
            }
            Value::Matrix(matrix) => {
                let digits: Vec<usize> = name
                    .strip_prefix('m')
                    .unwrap_or_default()
                    .chars()
                    .filter_map(|digit| digit.to_digit(10))
                    .map(|digit| digit as usize)
                    .collect();
                match digits.as_slice() {
                    &[row, column]
                        if (1..=matrix.rows).contains(&row) && (1..=matrix.columns).contains(&column) =>
                    {
                        Value::scalar(matrix.at(row - 1, column - 1))
                    }
                    _ => match component(name) {
                        Some(index) if matrix.rows == 1 && index < matrix.columns => {
                            Value::scalar(matrix.at(0, index))
                        }
                        _ => self.unknown_field(&base, word),
                    },
                }
            }
            Value::Isometry(shift, turn) => match name {
                "translation" => Value::Translation(shift.clone()),
                "rotation" => Value::Rotation(turn.clone()),
                _ => self.unknown_field(&base, word),
            },
            Value::Rotation(Turn::Space(_)) if matches!(name, "w" | "i" | "j" | "k" | "coords") => {
                self.refuse(word.origin, catalogue::component_of_rotation(name))
            }
            Value::PoseVelocity(linear, angular) => match name {
                "linear" => Value::Vector(linear.clone()),
                "angular" => Value::Vector(angular.clone()),
                _ => self.unknown_field(&base, word),
            },
            Value::Quaternion(parts) => self.quaternion_field(parts, word),
            Value::Twist(twist) => self.twist_field(twist, word),
            Value::Tuple(elements) => {
                match name.parse::<usize>().ok().and_then(|index| elements.get(index)) {
                    Some(element) => element.clone(),
                    None => self.unknown_field(&base, word),
                }
            }
            Value::Unit
            | Value::Boolean(_)
            | Value::Choice(_)
            | Value::Integer(..)
            | Value::Scalar(..)
            | Value::Rotation(_)
            | Value::Closure(_)
            | Value::Array(_)
            | Value::Iterator(_)
            | Value::Range(..) => self.unknown_field(&base, word),
        }
    }

    fn unknown_field(&mut self, base: &Value, word: &Word) -> Value {
        if let (Value::Rotation(_), Some([b'1'..=b'3', b'1'..=b'3'])) =
            (base, word.name.strip_prefix('m').map(str::as_bytes))
        {
            let message = catalogue::rotation_as_matrix(base.describe(), &word.name);
            return self.refuse(word.origin, message);
        }
        self.refuse(word.origin, catalogue::unknown_field(base.describe(), &word.name))
    }

    fn record_field(&mut self, record: Record, word: &Word) -> Value {
        let (groups, position) = match record {
            Record::Coordinates => (&self.item.coordinates, 0),
            Record::Velocities => (&self.item.coordinates, 1),
            Record::Inputs => (&self.item.inputs, 2),
        };
        match groups.iter().position(|group| group.name() == word.name) {
            Some(index) => self.fields[position][index].clone(),
            None => {
                if let Some(coordinate) = self.differentiated(&word.name).filter(|_| record != Record::Inputs)
                {
                    let message = catalogue::velocity_of_coordinate(&word.name, coordinate);
                    return self.refuse(word.origin, message);
                }
                let names: Vec<Name> = groups.iter().map(|group| group.name()).collect();
                let near = self.near(&word.name, &names);
                let declared = names.join("`, `");
                let kind = match record {
                    Record::Coordinates | Record::Velocities => "coordinate",
                    Record::Inputs => "input",
                };
                self.refuse(word.origin, catalogue::unknown_quantity(kind, &word.name, declared, near))
            }
        }
    }

    /// All components of a record in order.
    pub fn record_values(&self, record: Record) -> Vec<Value> {
        let position = match record {
            Record::Coordinates => 0,
            Record::Velocities => 1,
            Record::Inputs => 2,
        };
        let mut values = Vec::new();
        for field in &self.fields[position] {
            match field {
                Value::Array(elements) => values.extend(elements.iter().cloned()),
                scalar => values.push(scalar.clone()),
            }
        }
        values
    }

    /// `base[index]`.
    pub fn index(&mut self, base: &'a Expr, index: &'a Expr) -> Value {
        let value = self.expression(base);
        if value.is_unknown() {
            return Value::Unknown;
        }
        match &index.kind {
            ExprKind::Tuple(pair) if pair.len() == 2 => {
                let (Some(row), Some(column)) = (self.length(&pair[0]), self.length(&pair[1])) else {
                    return Value::Unknown;
                };
                self.entry(value, row, column, index.origin)
            }
            ExprKind::Range(range) => {
                if let (Value::Parameter(_), true, true) = (&value, self.in_attribute, Self::is_whole(index))
                {
                    return value;
                }
                let range = self.range(range);
                self.slice(value, range, index.origin)
            }
            _ => {
                let Some(position) = self.integer_of(index) else { return Value::Unknown };
                self.element(value, position, index.origin)
            }
        }
    }

    fn entry(&mut self, value: Value, row: usize, column: usize, origin: Origin) -> Value {
        match &value {
            Value::Parameter(id) => Value::Parameter(self.parameter_entry(*id, row, column, origin)),
            Value::Matrix(matrix) if row < matrix.rows && column < matrix.columns => {
                Value::scalar(matrix.at(row, column))
            }
            Value::Vector(nodes) if row < nodes.len() && column == 0 => Value::scalar(nodes[row]),
            Value::Rotation(turn) if row < turn.dimension() && column < turn.dimension() => {
                let matrix = self.rotation_matrix(turn);
                self.entry(matrix, row, column, origin)
            }
            Value::Matrix(matrix) => {
                let valid = valid_entries(matrix.rows, matrix.columns);
                self.refuse(origin, catalogue::index_out_of_range(format!("({row}, {column})"), valid))
            }
            Value::Vector(nodes) => {
                let valid = valid_entries(nodes.len(), 1);
                self.refuse(origin, catalogue::index_out_of_range(format!("({row}, {column})"), valid))
            }
            other => self.refuse(origin, catalogue::cannot_index(other.describe())),
        }
    }

    fn element(&mut self, value: Value, position: i128, origin: Origin) -> Value {
        let index = usize::try_from(position).unwrap_or(usize::MAX);
        let (element, length) = match &value {
            Value::Parameter(_) if position < 0 => {
                return self.refuse(origin, catalogue::negative_index(position));
            }
            Value::Parameter(id) => {
                return Value::Parameter(self.parameter_index(*id, index, origin));
            }
            Value::Array(elements) => (elements.get(index).cloned(), elements.len()),
            Value::Vector(nodes) | Value::Point(nodes) => {
                (nodes.get(index).copied().map(Value::scalar), nodes.len())
            }
            // One index runs through a matrix column by column.
            Value::Matrix(matrix) => {
                let length = matrix.entries.len();
                let inside = index < length;
                (inside.then(|| Value::scalar(matrix.at(index % matrix.rows, index / matrix.rows))), length)
            }
            Value::Record(record) => return self.refuse(origin, self.record_as_value(*record)),
            other => return self.refuse(origin, catalogue::cannot_index(other.describe())),
        };
        match element {
            Some(element) => element,
            None => self.refuse(origin, catalogue::index_out_of_range(position, valid_indices(length))),
        }
    }

    fn slice(&mut self, value: Value, range: Value, origin: Origin) -> Value {
        match (value, range) {
            (Value::Array(elements), Value::Range(start, end, _)) => {
                let length = elements.len();
                let bound = |bound: Option<i128>, default: usize| match bound {
                    Some(bound) => usize::try_from(bound).ok(),
                    None => Some(default),
                };
                match (bound(start, 0), bound(end, length)) {
                    (Some(start), Some(end)) if start <= end && end <= length => {
                        Value::array(elements[start..end].to_vec())
                    }
                    _ => self.refuse(origin, catalogue::slice_out_of_range(counted(length, "element"))),
                }
            }
            (_, Value::Unknown) => Value::Unknown,
            (value @ Value::Parameter(_), _) => {
                self.elements(value, origin);
                Value::Unknown
            }
            (other, _) => self.refuse(origin, catalogue::cannot_index(other.describe())),
        }
    }
}

/// The index of a component by its name in nalgebra.
fn component(name: &str) -> Option<usize> {
    match name {
        "x" => Some(0),
        "y" => Some(1),
        "z" => Some(2),
        "w" => Some(3),
        "a" => Some(4),
        "b" => Some(5),
        _ => None,
    }
}
