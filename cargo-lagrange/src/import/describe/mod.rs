//! [`Plan`] → the text of a description.

mod actions;
mod bodies;
mod frames;
mod text;

use super::motions::{Coordinate, Motion, Shape};
use super::plan::Plan;
use super::{Options, Parameters};
use text::{Lines, code, number, sum};

/// Writes a description.
pub fn describe(plan: &Plan, options: &Options, file: &str) -> String {
    let mut writer =
        Writer { plan, parameters: options.parameters, fields: Vec::new(), out: Lines::default() };
    writer.frames();
    writer.bodies();
    writer.gravity();
    writer.actions(options);
    let body = writer.out.finish().trim_end().to_owned() + "\n";
    writer.out = Lines::default();
    writer.head(options, file, &body);
    writer.out.finish() + &body + "}\n"
}

/// Writes a description; functions come first, since they decide which fields the struct has.
struct Writer<'p> {
    plan: &'p Plan,
    parameters: Parameters,
    fields: Vec<Field>,
    out: Lines,
}

/// A parameter of the struct.
struct Field {
    name: String,
    doc: String,
    value: f64,
}

impl Writer<'_> {
    /// A number in the text: a literal, or a field with this value.
    fn value(
        &mut self,
        is_field: bool,
        value: f64,
        name: impl FnOnce() -> String,
        doc: impl FnOnce() -> String,
    ) -> String {
        if !is_field || value == 0.0 {
            return number(value);
        }
        let name = name();
        self.fields.push(Field { name: name.clone(), doc: doc(), value });
        format!("self.{name}")
    }

    /// The value of a joint with one coordinate in an expression, `record` being `q` or `v`.
    fn joint_value(&self, joint: usize, record: char) -> String {
        match &self.plan.motions[joint] {
            Motion::Own(own) => self.coordinate(own[0], record),
            Motion::Follows { of, multiplier, offset } => {
                let of = self.coordinate(*of, record);
                let offset = if record == 'q' { *offset } else { 0.0 };
                match (*multiplier, offset) {
                    (1.0, 0.0) => of,
                    (-1.0, 0.0) => format!("-{of}"),
                    (multiplier, 0.0) => format!("{} * {of}", number(multiplier)),
                    _ => sum(&[(*multiplier, of), (offset, String::new())]),
                }
            }
        }
    }

    fn coordinate(&self, coordinate: usize, record: char) -> String {
        format!("{record}.{}", self.plan.coordinates[coordinate].name)
    }

    /// The text in front of the functions.
    fn head(&mut self, options: &Options, file: &str, body: &str) {
        let plan = self.plan;
        let file = file.rsplit(['/', '\\']).next().unwrap_or(file);
        self.out.comment(0, &format!("Imported from {} by `cargo lagrange import`.", code(file)));
        for text in &plan.left_out {
            self.out.comment(0, &format!("Left out: {text}."));
        }
        self.out.empty();
        let constants: Vec<&str> = ["FRAC_PI_2", "FRAC_PI_3", "FRAC_PI_4", "FRAC_PI_6", "PI"]
            .into_iter()
            .filter(|name| body.contains(&format!("{name},")) || body.contains(&format!("{name})")))
            .collect();
        match constants.as_slice() {
            [] => {}
            [one] => self.out.line(0, &format!("use core::f64::consts::{one};")),
            all => self.out.line(0, &format!("use core::f64::consts::{{{}}};", all.join(", "))),
        }
        if !constants.is_empty() {
            self.out.empty();
        }
        self.out.line(0, "use lagrangian::prelude::*;");
        self.out.empty();
        let title = code(&plan.title);
        self.out.doc(0, &format!("The robot {title}; `{}::default()` is the one of the file.", plan.name));
        self.out.line(0, "#[derive(Clone, Copy, Debug)]");
        let fields = std::mem::take(&mut self.fields);
        if self.parameters != Parameters::default() {
            self.out
                .line(0, "#[allow(dead_code)] // Not every moment of inertia has a say in the equations.");
        }
        if fields.is_empty() {
            self.out.line(0, &format!("pub struct {};", plan.name));
        } else {
            self.out.line(0, &format!("pub struct {} {{", plan.name));
            for field in &fields {
                self.out.doc(4, &field.doc);
                self.out.line(4, &format!("pub {}: f64,", field.name));
            }
            self.out.line(0, "}");
        }
        self.out.empty();
        if self.parameters != Parameters::default() {
            self.out.line(0, "#[allow(clippy::approx_constant)]");
        }
        self.out.line(0, &format!("impl Default for {} {{", plan.name));
        self.out.line(4, "fn default() -> Self {");
        let values: Vec<String> =
            fields.iter().map(|field| format!("{}: {}", field.name, number(field.value))).collect();
        match values.len() {
            0 => self.out.line(8, &plan.name),
            _ => self.out.list(8, &format!("{} {{ ", plan.name), &values, " }"),
        }
        self.out.line(4, "}");
        self.out.line(0, "}");
        self.out.empty();
        self.attribute(options);
        // Frames are there for the user; literals are those of the file.
        self.out.line(0, "#[allow(dead_code, clippy::approx_constant)]");
        self.out.line(0, &format!("impl {} {{", plan.name));
    }

    fn attribute(&mut self, options: &Options) {
        let inputs: Vec<&str> = self.plan.inputs.iter().map(|(name, ..)| name.as_str()).collect();
        let coordinates: Vec<String> = self
            .plan
            .coordinates
            .iter()
            .map(|Coordinate { name, shape }| match shape {
                Shape::Number => name.clone(),
                Shape::Rotation => format!("{name}: Rotation"),
                Shape::Pose => format!("{name}: Pose"),
            })
            .collect();
        let mut parts = vec![format!("coordinates = [{}]", coordinates.join(", "))];
        if !inputs.is_empty() {
            parts.push(format!("inputs = [{}]", inputs.join(", ")));
        }
        parts.extend(options.with.iter().cloned());
        let whole = format!("#[lagrangian({})]", parts.join(", "));
        if whole.len() <= text::WIDTH {
            return self.out.line(0, &whole);
        }
        self.out.line(0, "#[lagrangian(");
        self.out.list(4, "coordinates = [", &coordinates, "],");
        if !inputs.is_empty() {
            self.out.list(4, "inputs = [", &inputs, "],");
        }
        for with in &options.with {
            self.out.line(4, &format!("{with},"));
        }
        self.out.line(0, ")]");
    }
}
