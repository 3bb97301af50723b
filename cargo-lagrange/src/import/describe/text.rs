//! Lines, lists, numbers and sums as Rust.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_4, FRAC_PI_6, PI};
use std::fmt::Display;

use crate::import::geometry::{Angle, Rotation, Vector};
use crate::import::report::one_line;

/// The width of a line.
pub const WIDTH: usize = 100;

/// Text that grows by lines.
#[derive(Default)]
pub struct Lines {
    text: String,
}

impl Lines {
    /// Adds a line.
    pub fn line(&mut self, indent: usize, line: &str) {
        self.text.push_str(&" ".repeat(indent));
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Adds a line of documentation.
    pub fn doc(&mut self, indent: usize, text: &str) {
        self.line(indent, &format!("/// {}", one_line(text)));
    }

    /// Adds a comment of one line.
    pub fn comment(&mut self, indent: usize, text: &str) {
        self.line(indent, &format!("// {}", one_line(text)));
    }

    /// Adds an empty line.
    pub fn empty(&mut self) {
        self.text.push('\n');
    }

    /// Adds operands joined by an operator, on lines of their own where they do not fit on one.
    pub fn chain(&mut self, indent: usize, start: &str, operator: char, operands: &[String], end: &str) {
        let whole = format!("{start}{}{end}", operands.join(&format!(" {operator} ")));
        if indent + whole.chars().count() <= WIDTH && !whole.contains('\n') {
            return self.line(indent, &whole);
        }
        let last = operands.len().saturating_sub(1);
        for (index, operand) in operands.iter().enumerate() {
            let tail = if index == last { end } else { "" };
            let (indent, front) = match index {
                0 => (indent, start.to_owned()),
                _ => (indent + 4, format!("{operator} ")),
            };
            for (row, line) in format!("{front}{operand}{tail}").lines().enumerate() {
                self.line(if row == 0 || line.starts_with(')') { indent } else { indent + 4 }, line);
            }
        }
    }

    /// Adds a list, an element a line where it does not fit on one.
    pub fn list(&mut self, indent: usize, start: &str, elements: &[impl Display], end: &str) {
        let elements: Vec<String> = elements.iter().map(ToString::to_string).collect();
        let whole = format!("{start}{}{end}", elements.join(", "));
        if indent + whole.chars().count() <= WIDTH {
            return self.line(indent, &whole);
        }
        self.line(indent, start.trim_end());
        for element in &elements {
            self.line(indent + 4, &format!("{element},"));
        }
        self.line(indent, end.trim_start());
    }

    /// The text so far.
    pub fn finish(&self) -> String {
        self.text.clone()
    }
}

/// A name of the file in documentation. A backtick would end the span that quotes it.
pub fn code(name: &str) -> String {
    format!("`{}`", name.replace('`', "'"))
}

/// A number that reads back as the same double.
pub fn number(value: f64) -> String {
    // Zero has no sign here.
    format!("{:?}", value + 0.0)
}

/// An angle, by its name if it has one.
pub fn angle(angle: Angle) -> String {
    let named = [
        (PI, "PI"),
        (FRAC_PI_2, "FRAC_PI_2"),
        (FRAC_PI_3, "FRAC_PI_3"),
        (FRAC_PI_4, "FRAC_PI_4"),
        (FRAC_PI_6, "FRAC_PI_6"),
    ];
    let radians = match angle {
        Angle::Quarters(quarters) => f64::from(quarters) * FRAC_PI_2,
        Angle::Radians(radians) => radians,
    };
    let name = named.into_iter().find(|(value, _)| *value == radians.abs()).map(|(_, name)| name);
    match name {
        Some(name) if radians < 0.0 => format!("-{name}"),
        Some(name) => name.to_owned(),
        None => number(radians),
    }
}

/// The factors of a shift: none for zero.
pub fn shift(vector: [String; 3]) -> Option<String> {
    let zero = number(0.0);
    (vector.iter().any(|entry| *entry != zero)).then(|| format!("Translation3::new({})", vector.join(", ")))
}

/// The factors of a rotation, on several lines where it is a matrix: none for the identity.
pub fn turn(rotation: &Rotation) -> Option<String> {
    if rotation.is_identity() {
        return None;
    }
    Some(match rotation.angles {
        Some(angles) => format!("Rotation3::from_euler_angles({})", angles.map(angle).join(", ")),
        None => {
            let rows = rotation.matrix.map(|row| row.map(number).join(", ") + ",\n").concat();
            format!("Rotation3::from_matrix_unchecked(Matrix3::new(\n{rows}))")
        }
    })
}

/// A unit axis as nalgebra writes it, and whether the angle about it changes its sign.
pub fn axis(axis: Vector) -> (String, bool) {
    match axis.iter().position(|entry| entry.abs() == 1.0) {
        Some(main) => (format!("&Vector3::{}_axis()", ["x", "y", "z"][main]), axis[main] < 0.0),
        None => (format!("&Unit::new_unchecked(Vector3::new({}))", axis.map(number).join(", ")), false),
    }
}

/// In parentheses where it is more than a name.
pub fn grouped(text: String) -> String {
    if text.contains(' ') || text.starts_with('-') { format!("({text})") } else { text }
}

/// A sum of multiples; an empty text stands for the factor alone.
pub fn sum(terms: &[(f64, String)]) -> String {
    let mut text = String::new();
    for (factor, term) in terms.iter().filter(|(factor, _)| *factor != 0.0) {
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        text.push_str(sign);
        match (factor.abs(), term.is_empty()) {
            (size, true) => text.push_str(&number(size)),
            (1.0, false) => text.push_str(term),
            (size, false) => text.push_str(&format!("{} * {term}", number(size))),
        }
    }
    if text.is_empty() { number(0.0) } else { text }
}
