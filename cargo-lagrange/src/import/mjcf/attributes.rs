//! Attributes with their defaults by class, and orientations in all their forms.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use roxmltree::Node;

use crate::import::Options;
use crate::import::geometry::{
    Angle, Matrix, Pose, Rotation, Vector, cross, direction, dot, moderate, norm, scaled, sub, transposed,
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
    /// Whether a joint with a range has stops if it does not say so.
    pub autolimits: bool,
    /// The axes of Euler angles; capital letters are fixed axes.
    sequence: String,
}

/// The class of what has none, which is the outermost one.
const MAIN: &str = "main";

/// The attributes that orient an element, of which it has one.
pub const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];

impl<'a> Attributes<'a> {
    /// Reads `<compiler>` and `<default>`.
    pub fn read(reader: &mut Reader<'a>, root: Element<'a>) -> Self {
        let mut attributes = Attributes {
            classes: BTreeMap::new(),
            degrees: true,
            autolimits: true,
            sequence: "xyz".to_owned(),
        };
        for compiler in children(root, "compiler") {
            match compiler.attribute("angle") {
                None => {}
                Some("degree") => attributes.degrees = true,
                Some("radian") => attributes.degrees = false,
                Some(_) => reader.problem_of(compiler, "angle", "write angle=\"degree\" or angle=\"radian\""),
            }
            if let Some(automatic) = compiler.attribute("autolimits") {
                attributes.autolimits = automatic != "false";
            }
            if let Some(order) = compiler.attribute("eulerseq") {
                match order.len() == 3 && order.chars().all(|axis| "xyzXYZ".contains(axis)) {
                    true => attributes.sequence = order.to_owned(),
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
        let name = match (node.attribute("class").filter(|name| !name.is_empty()), &around) {
            (Some(name), _) => name.to_owned(),
            (None, None) => MAIN.to_owned(),
            (None, Some(_)) => {
                return reader.problem(node, "a class inside another one needs a name; write class=\"…\"");
            }
        };
        if around.is_none() && name != MAIN {
            let text =
                "the outermost class is `main`; leave out its name, or write <default> around this class";
            reader.problem_of(node, "class", text);
        }
        // The outermost class may stand in the file in several parts, all others are there once: a class that
        // stood in itself would take its defaults from itself.
        match self.classes.get_mut(&name) {
            Some((parts, None)) if around.is_none() => parts.push(node),
            Some(_) => {
                let text = "another default class has this name; rename one, and the elements that mean it";
                reader.problem_of(node, "class", text);
            }
            None => {
                self.classes.insert(name.clone(), (vec![node], around));
            }
        }
        for inner in children(node, "default") {
            self.class(reader, inner, Some(name.clone()));
        }
    }

    /// The element that has an attribute: the element itself, or that of the defaults of its class.
    pub fn find(&self, reader: &mut Reader<'a>, node: Element<'a>, attribute: &str) -> Option<Element<'a>> {
        self.layers(reader, node).into_iter().find(|layer| layer.has_attribute(attribute))
    }

    /// An element and those of its defaults, each before those that it overrides.
    fn layers(&self, reader: &mut Reader<'a>, node: Element<'a>) -> Vec<Element<'a>> {
        let mut found: Vec<Element<'a>> = vec![node];
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
            found.extend(all.filter(|defaults| shares_defaults(*defaults, node)));
            class = around.clone();
        }
        found
    }

    /// Numbers of which each that is lacking is that of the defaults.
    pub fn list(&self, reader: &mut Reader<'a>, node: Element<'a>, attribute: &str) -> Vec<f64> {
        let mut list = Vec::new();
        for layer in self.layers(reader, node) {
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
        let [angle] = links::angles(reader, node, [self.radians(written)], options);
        angle
    }

    /// The pose of a body, a geom or an inertia.
    pub fn pose(&self, reader: &mut Reader<'a>, node: Element<'a>, options: &Options) -> Pose {
        let shift = self.vector(reader, node, "pos").unwrap_or([0.0; 3]);
        Pose { shift, turn: self.turn(reader, node, options).unwrap_or(Rotation::IDENTITY) }
    }

    fn turn(&self, reader: &mut Reader<'a>, node: Element<'a>, options: &Options) -> Option<Rotation> {
        let tolerance = options.tolerance;
        // An orientation in any form overrides those of outer classes in all forms.
        let is_oriented = |layer: &Element<'a>| ORIENTATIONS.iter().any(|form| layer.has_attribute(*form));
        let node = self.layers(reader, node).into_iter().find(is_oriented)?;
        let mut forms = ORIENTATIONS.into_iter().filter(|form| node.has_attribute(*form));
        let form = forms.next()?;
        if let Some(second) = forms.next() {
            let text = format!("it has an orientation by `{form}` already; remove one of them");
            reader.problem_of(node, second, text);
        }
        let not_zero = |reader: &mut Reader<'a>, direction: Option<Vector>| {
            if direction.is_none() {
                let text = format!("a direction in `{form}` is zero; write one that is not");
                reader.problem_of(node, form, text);
            }
            direction
        };
        match form {
            "quat" => {
                let [w, x, y, z] = moderate(reader.vector(node, form)?);
                let size = w * w + x * x + y * y + z * z;
                if size == 0.0 {
                    let text = "the quaternion is zero; write quat=\"1 0 0 0\" for no turn";
                    reader.problem_of(node, form, text);
                    return None;
                }
                let s = 2.0 / size;
                let matrix = [
                    [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
                    [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
                    [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
                ];
                Some(Rotation::of_matrix(matrix, tolerance))
            }
            "axisangle" => {
                let [x, y, z, angle] = reader.vector(node, form)?;
                let axis = not_zero(reader, direction([x, y, z], tolerance))?;
                Some(Rotation::about(axis, self.angle(reader, node, angle, options)))
            }
            "euler" => {
                let angles = reader.vector(node, form)?;
                Some(self.euler(reader, node, angles, options))
            }
            "xyaxes" => {
                let [a, b, c, d, e, f] = reader.vector(node, form)?;
                let x = not_zero(reader, direction([a, b, c], tolerance))?;
                let y = direction(sub([d, e, f], scaled(dot(x, [d, e, f]), x)), tolerance);
                let y = not_zero(reader, y)?;
                Some(Rotation::of_matrix(transposed(&[x, y, cross(x, y)]), tolerance))
            }
            _ => {
                let z = reader.vector(node, form)?;
                let z = not_zero(reader, direction(z, tolerance))?;
                Some(Rotation::of_matrix(lifted(z), tolerance))
            }
        }
    }

    /// The rotation by angles about the axes that `eulerseq` names.
    fn euler(
        &self,
        reader: &mut Reader<'a>,
        node: Element<'a>,
        angles: [f64; 3],
        options: &Options,
    ) -> Rotation {
        let angles = links::angles(reader, node, angles.map(|written| self.radians(written)), options);
        let [a, b, c] = angles;
        let as_in_urdf = match &*self.sequence {
            "XYZ" => Some([a, b, c]),
            "zyx" => Some([c, b, a]),
            _ => None,
        };
        if let Some(angles) = as_in_urdf {
            return Rotation::of_angles(angles);
        }
        let mut whole = Rotation::IDENTITY;
        for (letter, angle) in self.sequence.chars().zip(angles) {
            let mut axis = [0.0; 3];
            axis["xyz".find(letter.to_ascii_lowercase()).unwrap_or(0)] = 1.0;
            let turn = Rotation::about(axis, angle);
            whole = if letter.is_ascii_lowercase() { whole.after(&turn) } else { turn.after(&whole) };
        }
        whole
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
