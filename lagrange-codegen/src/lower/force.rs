//! Forces: what they act on, and their components there.

use super::advice::valid_indices;
use super::interpreter::Interpreter;
use super::roles::Placed;
use super::shape::Shape;
use super::value::{Turn, Value};
use crate::diagnostics::catalogue;
use crate::expr::NodeId;
use crate::model::{Action, Force, Rotation};
use crate::syntax::body::{Expr, Name, Word};
use crate::syntax::item::{Argument, Function, Kind, RoleKind, Target};
use crate::syntax::{Group, Record};

impl<'a> Interpreter<'a> {
    /// Lowers one force function.
    pub fn force(&mut self, index: usize, target: &'a Target) {
        match target {
            Target::Generalized if self.item.has_orientations() => {
                let function = &self.item.functions[index];
                let message = catalogue::force_on_all_with_orientations(&function.name);
                self.report(function.origin, message);
            }
            Target::Generalized => {
                let all = (0..self.size(Record::Coordinates)).collect();
                self.generalized_force(index, all);
            }
            Target::On(word, element) => {
                if self.is_oriented(word) {
                    return self.torque_on(index, word, element.as_ref());
                }
                if let Some(coordinates) = self.coordinates_of(word, element.as_ref()) {
                    self.generalized_force(index, coordinates);
                }
            }
            Target::At(word, element) => {
                if let Some((places, is_array)) = self.places_of(word, element.as_ref()) {
                    self.force_at(index, &places, is_array);
                }
            }
        }
    }

    fn generalized_force(&mut self, index: usize, coordinates: Vec<usize>) {
        let function: &'a Function = &self.item.functions[index];
        let count = coordinates.len();
        let fits = match self.declared(function) {
            Shape::Scalar => count == 1,
            Shape::Vector(length) => length == count,
            Shape::Array(element, length) => length == count && *element == Shape::Scalar,
            _ => false,
        };
        if !fits {
            return self.wrong_force(function, generalized_form(count, &self.item.scalar.to_string()));
        }
        let Some(value) = self.result(index) else { return };
        let nodes: Vec<NodeId> = match &value {
            Value::Array(elements) => elements.iter().flat_map(|element| element.nodes().to_vec()).collect(),
            single => single.nodes().to_vec(),
        };
        let action = Action::Generalized(coordinates.into_iter().zip(nodes).collect());
        self.push_force(function, function.name.to_string(), action);
    }

    /// Whether a name is that of an orientation or a pose.
    pub fn is_oriented(&self, word: &Word) -> bool {
        let is_it = |group: &&Group| group.name() == word.name && group.kind != Kind::Scalar;
        self.item.coordinates.iter().any(|group| is_it(&group))
    }

    /// A torque in body axes on an orientation, or on each of an array of them.
    fn torque_on(&mut self, index: usize, word: &'a Word, element: Option<&'a Expr>) {
        let function: &'a Function = &self.item.functions[index];
        let Some(place) = self.item.coordinates.iter().position(|group| group.name() == word.name) else {
            return;
        };
        let group = &self.item.coordinates[place];
        if group.kind == Kind::Pose {
            return self.report(word.origin, catalogue::force_on_pose(&word.name));
        }
        let velocities = match (self.fields[1][place].clone(), element) {
            (Value::Array(all), Some(element)) => {
                let Some(index) = self.length(element) else { return };
                let Some(one) = all.get(index) else {
                    let valid = valid_indices(all.len());
                    return self.report(element.origin, catalogue::index_out_of_range(index, valid));
                };
                one.clone()
            }
            (_, Some(element)) => {
                return self.report(element.origin, catalogue::index_into_single(&word.name));
            }
            (all, None) => all,
        };
        let fits = |shape: &Shape| *shape == Shape::Vector(3);
        let is_right = match (self.declared(function), &velocities) {
            (Shape::Array(element, length), Value::Array(all)) => fits(&element) && length == all.len(),
            (shape, Value::Vector(_)) => fits(&shape),
            _ => false,
        };
        if !is_right {
            let vector = format!("a torque in body axes, `Vector3<{}>`", self.item.scalar);
            let expected = match &velocities {
                Value::Array(all) => format!("an array of {}, each {vector}", all.len()),
                _ => vector,
            };
            return self.wrong_force(function, expected);
        }
        let Some(value) = self.result(index) else { return };
        let [velocities, torques] = [&velocities, &value].map(|value| match value {
            Value::Array(all) => all.iter().flat_map(|one| one.nodes().to_vec()).collect(),
            one => one.nodes().to_vec(),
        });
        let action = Action::Along(velocities.into_iter().zip(torques).collect());
        self.push_force(function, function.name.to_string(), action);
    }

    fn push_force(&mut self, function: &'a Function, name: String, action: Action) {
        self.model.forces.push(Force { name, action, origin: function.origin });
    }

    fn wrong_force(&mut self, function: &'a Function, expected: String) {
        let shape = self.declared(function);
        if let Some(ty) = &function.output {
            let described = match shape {
                Shape::Any => "a type that the macro does not know".to_string(),
                known => known.describe(),
            };
            self.report(ty.origin, catalogue::wrong_return(&function.name, expected, described));
        }
    }

    /// The flat indices of a coordinate named by `on = …` or `eliminate = …`.
    pub fn coordinates_of(&mut self, word: &'a Word, element: Option<&'a Expr>) -> Option<Vec<usize>> {
        let groups = &self.item.coordinates;
        let mut start = 0;
        for group in groups {
            let length = group.size();
            if group.name() == word.name {
                return match (element, group.length) {
                    (None, _) => Some((start..start + length).collect()),
                    (Some(element), Some(length)) => {
                        let index = self.length(element)?;
                        if index >= length {
                            self.report(
                                element.origin,
                                catalogue::index_out_of_range(index, valid_indices(length)),
                            );
                            return None;
                        }
                        Some(vec![start + index])
                    }
                    (Some(element), None) => {
                        self.report(element.origin, catalogue::index_into_single(&word.name));
                        None
                    }
                };
            }
            start += length;
        }
        let names: Vec<Name> = groups.iter().map(|group| group.name()).collect();
        let near = self.near(&word.name, &names);
        let declared = names.join("`, `");
        self.report(word.origin, catalogue::unknown_quantity("coordinate", &word.name, declared, near));
        None
    }

    /// The places named by `at = …`, and whether they form an array.
    fn places_of(&mut self, word: &'a Word, element: Option<&'a Expr>) -> Option<(Vec<Placed>, bool)> {
        let item = self.item;
        let Some(index) = item.functions.iter().position(|function| function.name == word.name) else {
            let names: Vec<Name> = item.functions.iter().map(|function| function.name.clone()).collect();
            let near = self.near(&word.name, &names);
            self.report(word.origin, catalogue::unknown_force_target(&word.name, near));
            return None;
        };
        let function = &item.functions[index];
        let positional = function.parameters.iter().all(|parameter| {
            matches!(parameter.argument, Some(Argument::Record(Record::Coordinates) | Argument::Time))
        });
        let shape = self.declared(function);
        let (single, count) = match &shape {
            Shape::Array(element, length) => (&**element, Some(*length)),
            single => (single, None),
        };
        // A function without a role may name a place, too, unless it returns a number.
        let is_place = matches!(
            (single, function.role.as_ref().map(|role| &role.kind)),
            (Shape::Scalar, Some(RoleKind::Point { .. }))
                | (
                    Shape::Vector(1..=3) | Shape::Point(1..=3) | Shape::Isometry(_) | Shape::Tuple(_),
                    None | Some(RoleKind::Point { .. } | RoleKind::Body { .. }),
                )
        );
        let places = match positional && is_place {
            true => {
                let value = self.result(index)?;
                self.placed(&function.name, &value)
            }
            false => Vec::new(),
        };
        if places.is_empty() {
            self.report(word.origin, catalogue::not_a_place(&word.name));
            return None;
        }
        match (element, count) {
            (None, count) => Some((places, count.is_some())),
            (Some(element), Some(count)) => {
                let index = self.length(element)?;
                match places.into_iter().nth(index) {
                    Some(place) => Some((vec![place], false)),
                    None => {
                        self.report(
                            element.origin,
                            catalogue::index_out_of_range(index, valid_indices(count)),
                        );
                        None
                    }
                }
            }
            (Some(element), None) => {
                self.report(element.origin, catalogue::index_into_single(&word.name));
                None
            }
        }
    }

    fn force_at(&mut self, index: usize, places: &[Placed], is_array: bool) {
        let function: &'a Function = &self.item.functions[index];
        let Some(first) = places.first() else { return };
        let shape = self.declared(function);
        let single = match (&shape, is_array) {
            (Shape::Array(element, length), true) if *length == places.len() => Some(&**element),
            (_, true) => None,
            (single, false) => Some(single),
        };
        let dimension = first.position.len();
        let is_force = |shape: &Shape| match shape {
            Shape::Vector(length) => *length == dimension,
            Shape::Scalar => dimension == 1,
            _ => false,
        };
        let is_torque = |shape: &Shape| {
            matches!(
                (shape, &first.turn),
                (Shape::Scalar, Some(Turn::Plane(_))) | (Shape::Vector(3), Some(Turn::Space(_)))
            )
        };
        let fits = single.is_some_and(|single| match single {
            Shape::Tuple(parts) => matches!(parts.as_slice(), [f, t] if is_force(f) && is_torque(t)),
            force => is_force(force),
        });
        if !fits {
            let scalar = self.item.scalar.to_string();
            let count = is_array.then_some(places.len());
            return self
                .wrong_force(function, cartesian_form(dimension, first.turn.is_some(), count, &scalar));
        }
        let Some(value) = self.result(index) else { return };
        let values = match value {
            Value::Array(elements) if is_array => elements.to_vec(),
            single => vec![single],
        };
        for (number, (place, value)) in places.iter().zip(values).enumerate() {
            let name = match is_array {
                true => format!("{}[{number}]", function.name),
                false => function.name.to_string(),
            };
            let (force, torque) = match &value {
                Value::Tuple(parts) => (parts[0].nodes().to_vec(), Some(parts[1].nodes().to_vec())),
                force => (force.nodes().to_vec(), None),
            };
            if torque.is_none() || force.iter().any(|&node| !self.model.graph.is_zero(node)) {
                let action = Action::AtPosition { position: place.position.clone(), force };
                self.push_force(function, name.clone(), action);
            }
            let action = match (torque.as_deref(), &place.turn) {
                (Some([torque]), Some(Turn::Plane(angle))) => {
                    Action::PlanarTorque { angle: *angle, torque: *torque }
                }
                (Some([x, y, z]), Some(Turn::Space(rotation))) => {
                    Action::SpatialTorque { rotation: Rotation::clone(rotation), torque: [*x, *y, *z] }
                }
                _ => continue,
            };
            self.push_force(function, name, action);
        }
    }
}

fn generalized_form(count: usize, scalar: &str) -> String {
    match count {
        1 => format!("one generalized force, `{scalar}`"),
        _ => format!("one generalized force for each coordinate it acts on, `[{scalar}; {count}]`"),
    }
}

fn cartesian_form(dimension: usize, is_body: bool, count: Option<usize>, scalar: &str) -> String {
    let force = match (dimension, is_body) {
        (1, _) => format!("`{scalar}` or `Vector1<{scalar}>`"),
        (2, true) => format!("`Vector2<{scalar}>`, or force and torque `(Vector2<{scalar}>, {scalar})`"),
        (3, true) => {
            format!("`Vector3<{scalar}>`, or force and torque `(Vector3<{scalar}>, Vector3<{scalar}>)`")
        }
        _ => format!("`Vector{dimension}<{scalar}>`"),
    };
    match count {
        Some(count) => format!("an array of {count} forces, each {force}"),
        None => format!("a Cartesian force, {force}"),
    }
}
