//! Attributes with their defaults by class, and orientations in all their forms.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use roxmltree::Node;

use crate::import::Options;
use crate::import::geometry::{
    Angle, Matrix, Pose, Rotation, cross, direction, dot, norm, scaled, sub, transposed,
};
use crate::import::links;
use crate::import::schema::mjcf::ACTUATORS;
use crate::import::xml::{Reader, children};

/// An element of the file.
pub type Element<'a> = Node<'a, 'a>;

/// The classes of defaults, and how angles are written.
pub struct Attributes<'a> {
    /// The elements of a class and the class around it.
    classes: BTreeMap<String, (Vec<Element<'a>>, Option<String>)>,
    /// Whether angles are in degrees.
    pub degrees: bool,
    /// The axes of Euler angles; capital letters are fixed axes.
    euler: String,
}

/// The class of what has none.
const MAIN: &str = "main";

impl<'a> Attributes<'a> {
    /// Reads `<compiler>` and `<default>`.
    pub fn read(reader: &mut Reader<'a>, root: Element<'a>) -> Self {
        let mut attributes = Attributes { classes: BTreeMap::new(), degrees: true, euler: "xyz".to_owned() };
        for compiler in children(root, "compiler") {
            match compiler.attribute("angle") {
                None => {}
                Some("degree") => attributes.degrees = true,
                Some("radian") => attributes.degrees = false,
                Some(_) => reader.problem_of(compiler, "angle", "write angle=\"degree\" or angle=\"radian\""),
            }
            if let Some(order) = compiler.attribute("eulerseq") {
                match order.len() == 3 && order.chars().all(|axis| "xyzXYZ".contains(axis)) {
                    true => attributes.euler = order.to_owned(),
                    false => {
                        reader.problem_of(compiler, "eulerseq", "write three of the axes x, y, z, X, Y, Z")
                    }
                }
            }
        }
        for default in children(root, "default") {
            attributes.class(reader, default, None);
        }
        attributes
    }

    fn class(&mut self, reader: &mut Reader<'a>, node: Element<'a>, around: Option<String>) {
        let name = match (node.attribute("class"), &around) {
            (Some(name), _) => name.to_owned(),
            (None, None) => MAIN.to_owned(),
            (None, Some(_)) => {
                return reader.problem(node, "a class inside another one needs a name; write class=\"…\"");
            }
        };
        // Whatever its name is, the outermost class serves elements without one. It may stand in the file in
        // several parts.
        if around.is_none() && name != MAIN {
            self.classes.entry(MAIN.to_owned()).or_default().0.push(node);
        }
        let (parts, outer) = self.classes.entry(name.clone()).or_default();
        parts.push(node);
        *outer = around;
        for inner in children(node, "default") {
            self.class(reader, inner, Some(name.clone()));
        }
    }

    /// The element that has an attribute: the element itself, or that of the defaults of its class.
    pub fn find(&self, reader: &mut Reader<'a>, node: Element<'a>, attribute: &str) -> Option<Element<'a>> {
        self.layers(reader, node, attribute).into_iter().next()
    }

    /// All elements that have an attribute, each before those that it overrides.
    fn layers(&self, reader: &mut Reader<'a>, node: Element<'a>, attribute: &str) -> Vec<Element<'a>> {
        let mut found: Vec<Element<'a>> =
            Some(node).filter(|node| node.has_attribute(attribute)).into_iter().collect();
        let around = || node.ancestors().skip(1).find_map(|body| body.attribute("childclass"));
        let own = node.attribute("class");
        let mut class = Some(own.or_else(around).unwrap_or(MAIN).to_owned());
        if let Some(name) = class.as_ref().filter(|name| *name != MAIN && !self.classes.contains_key(*name)) {
            let near = links::near(name, self.classes.keys().map(String::as_str));
            let text = format!("there is no <default class=\"{name}\">{near}");
            // Once is enough.
            if !reader.sink.problems.iter().any(|problem| problem.text == text) {
                reader.problem(node, text);
            }
            return found;
        }
        while let Some((parts, around)) = class.and_then(|name| self.classes.get(&name)) {
            // A later element of the defaults overrides an earlier one.
            let all = parts.iter().rev().flat_map(|part| part.children().rev());
            let same = all.filter(|defaults| shares_defaults(*defaults, node));
            found.extend(same.filter(|defaults| defaults.has_attribute(attribute)));
            class = around.clone();
        }
        found
    }

    /// Numbers of which each that is lacking is that of the defaults.
    pub fn list(&self, reader: &mut Reader<'a>, node: Element<'a>, attribute: &str) -> Vec<f64> {
        let mut list = Vec::new();
        for layer in self.layers(reader, node, attribute) {
            let numbers = reader.numbers(layer, attribute).unwrap_or_default();
            list.extend(numbers.into_iter().skip(list.len()));
        }
        list
    }

    /// A text with its default.
    pub fn text(&self, reader: &mut Reader<'a>, node: Element<'a>, attribute: &str) -> Option<&'a str> {
        self.find(reader, node, attribute).and_then(|found| found.attribute(attribute))
    }

    /// Numbers with their default.
    pub fn numbers(&self, reader: &mut Reader<'a>, node: Element<'a>, attribute: &str) -> Option<Vec<f64>> {
        let found = self.find(reader, node, attribute)?;
        reader.numbers(found, attribute)
    }

    /// Some numbers with their default.
    pub fn vector<const N: usize>(
        &self,
        reader: &mut Reader<'a>,
        node: Element<'a>,
        attribute: &str,
    ) -> Option<[f64; N]> {
        let found = self.find(reader, node, attribute)?;
        reader.vector(found, attribute)
    }

    /// One number with its default.
    pub fn number(&self, reader: &mut Reader<'a>, node: Element<'a>, attribute: &str) -> Option<f64> {
        self.vector::<1>(reader, node, attribute).map(|[number]| number)
    }

    /// An angle [rad], of the number that the file writes.
    pub fn radians(&self, angle: f64) -> f64 {
        if self.degrees { angle * (PI / 180.0) } else { angle }
    }

    fn angle(&self, reader: &mut Reader<'a>, node: Element<'a>, written: f64, options: &Options) -> Angle {
        links::angle(reader, node, self.radians(written), options)
    }

    /// The pose of a body, a geom or an inertia.
    pub fn pose(&self, reader: &mut Reader<'a>, node: Element<'a>, options: &Options) -> Pose {
        let shift = self.vector(reader, node, "pos").unwrap_or([0.0; 3]);
        Pose { shift, turn: self.turn(reader, node, options).unwrap_or(Rotation::IDENTITY) }
    }

    fn turn(&self, reader: &mut Reader<'a>, node: Element<'a>, options: &Options) -> Option<Rotation> {
        let tolerance = options.tolerance;
        let written: Vec<&str> = ["quat", "axisangle", "euler", "xyaxes", "zaxis"]
            .into_iter()
            .filter(|form| node.has_attribute(*form))
            .collect();
        if let [first, second, ..] = written[..] {
            reader.problem_of(
                node,
                second,
                format!("it has an orientation by `{first}` already; remove one of them"),
            );
        }
        let not_zero = |reader: &mut Reader<'a>, attribute: &str| {
            reader.problem_of(
                node,
                attribute,
                format!("a direction in `{attribute}` is zero; write one that is not"),
            );
        };
        if let Some([w, x, y, z]) = self.vector(reader, node, "quat") {
            let size = w * w + x * x + y * y + z * z;
            if size == 0.0 {
                reader.problem_of(node, "quat", "the quaternion is zero; write quat=\"1 0 0 0\" for no turn");
                return None;
            }
            let s = 2.0 / size;
            let matrix = [
                [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
                [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
                [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
            ];
            return Some(Rotation::of_matrix(matrix, tolerance));
        }
        if let Some([x, y, z, angle]) = self.vector(reader, node, "axisangle") {
            let Some(axis) = direction([x, y, z], tolerance) else {
                not_zero(reader, "axisangle");
                return None;
            };
            return Some(about(axis, self.angle(reader, node, angle, options)));
        }
        if let Some(angles) = self.vector::<3>(reader, node, "euler") {
            let [a, b, c] = angles;
            let as_in_urdf = match &*self.euler {
                "XYZ" => Some([a, b, c]),
                "zyx" => Some([c, b, a]),
                _ => None,
            };
            if let Some(angles) = as_in_urdf {
                return Some(Rotation::of_angles(
                    angles.map(|angle| self.angle(reader, node, angle, options)),
                ));
            }
            let mut whole = Rotation::IDENTITY;
            for (letter, written) in self.euler.chars().zip(angles) {
                let mut axis = [0.0; 3];
                axis["xyz".find(letter.to_ascii_lowercase()).unwrap_or(0)] = 1.0;
                let turn = about(axis, self.angle(reader, node, written, options));
                whole = if letter.is_ascii_lowercase() { whole.after(&turn) } else { turn.after(&whole) };
            }
            return Some(whole);
        }
        if let Some([a, b, c, d, e, f]) = self.vector(reader, node, "xyaxes") {
            let x = direction([a, b, c], tolerance);
            let y = x.and_then(|x| direction(sub([d, e, f], scaled(dot(x, [d, e, f]), x)), tolerance));
            let (Some(x), Some(y)) = (x, y) else {
                not_zero(reader, "xyaxes");
                return None;
            };
            return Some(Rotation::of_matrix(transposed(&[x, y, cross(x, y)]), tolerance));
        }
        if let Some(z) = self.vector(reader, node, "zaxis") {
            let Some(z) = direction(z, tolerance) else {
                not_zero(reader, "zaxis");
                return None;
            };
            return Some(Rotation::of_matrix(lifted(z), tolerance));
        }
        None
    }
}

/// About an axis; right angles about coordinate axes stay exact.
fn about(axis: [f64; 3], angle: Angle) -> Rotation {
    let negative = axis.iter().any(|entry| *entry == -1.0);
    match (negative, angle) {
        (true, Angle::Quarters(2)) => Rotation::about(axis.map(f64::abs), angle),
        (true, Angle::Quarters(quarters)) => Rotation::about(axis.map(f64::abs), Angle::Quarters(-quarters)),
        (true, Angle::Radians(radians)) => Rotation::about(axis.map(f64::abs), Angle::Radians(-radians)),
        (false, _) => Rotation::about(axis, angle),
    }
}

/// Whether an element of defaults is for another element: those of all actuators are the same, and those of
/// all equalities.
fn shares_defaults(defaults: Element<'_>, node: Element<'_>) -> bool {
    let (own, tag) = (defaults.tag_name().name(), node.tag_name().name());
    match node.parent().map(|list| list.tag_name().name()) {
        Some("actuator") => ACTUATORS.contains(&own),
        Some("equality") => own == "equality",
        _ => own == tag,
    }
}

/// The least rotation that takes the z axis to a unit vector.
pub fn lifted(z: [f64; 3]) -> Matrix {
    let [x, y, c] = z;
    if norm([x, y, 0.0]) == 0.0 {
        // Half a turn about x, if any.
        return [[1.0, 0.0, 0.0], [0.0, c, 0.0], [0.0, 0.0, c]];
    }
    let k = 1.0 / (1.0 + c);
    // Beside the opposite of z the quotient is formed without cancellation.
    let k = if c < 0.0 { (1.0 - c) / (x * x + y * y) } else { k };
    [[1.0 - k * x * x, -k * x * y, x], [-k * x * y, 1.0 - k * y * y, y], [-x, -y, c]]
}
