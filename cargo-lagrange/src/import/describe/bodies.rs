//! Masses that move, and their weight.

use super::text::{Lines, code, number, shift};
use super::{Field, Writer};
use crate::import::geometry::{norm, scaled, unit};
use crate::import::plan::Body;

impl Writer<'_> {
    /// Writes all bodies.
    pub fn bodies(&mut self) {
        for body in &self.plan.bodies {
            self.body(body);
        }
    }

    fn body(&mut self, body: &Body) {
        let plan = self.plan;
        let name = plan.frames[body.link].name.as_str();
        let link = code(&plan.robot.links[body.link].name);
        let inertial = &body.inertial;
        let mass = self.mass(body);
        let along = ["x", "y", "z"];
        let parameters = self.parameters;
        let centre = std::array::from_fn(|i| {
            let field = || format!("{name}_centre_{}", along[i]);
            let doc = || format!("The centre of mass of {link} along {} of its frame, in m.", along[i]);
            self.value(parameters.centres, inertial.centre[i], field, doc)
        });
        let mut entry = |i: usize, j: usize| {
            let field = || format!("{name}_inertia_{}{}", along[i], along[j]);
            let doc = || match i == j {
                true => {
                    format!("The moment of inertia of {link} about {} through its centre [kg·m²].", along[i])
                }
                false => format!(
                    "The product of inertia of {link}, entry {}{} of the tensor [kg·m²].",
                    along[i], along[j]
                ),
            };
            self.value(parameters.inertias, inertial.tensor[i][j], field, doc)
        };
        let [xx, yy, zz] = [0, 1, 2].map(|i| entry(i, i));
        let [xy, xz, yz] = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| entry(i, j));
        let zero = number(0.0);
        let mut fixed: Vec<String> =
            body.fixed.iter().map(|&link| code(&plan.robot.links[link].name)).collect();
        if fixed.len() > 4 {
            fixed = vec![format!("{} links that are", fixed.len())];
        }
        let with =
            if fixed.is_empty() { String::new() } else { format!(" with {} fixed to it", fixed.join(", ")) };
        self.out.doc(4, &format!("The mass of {link}{with}."));
        let matrix = [[&xx, &xy, &xz], [&xy, &yy, &yz], [&xz, &yz, &zz]];
        if matrix.as_flattened().iter().all(|entry| **entry == zero) {
            self.out.line(4, &format!("#[body(mass = {mass}, inertia = [0.0, 0.0, 0.0])]"));
        } else if [&xy, &xz, &yz].into_iter().all(|product| *product == zero) {
            self.out.list(4, &format!("#[body(mass = {mass}, inertia = ["), &[xx, yy, zz], "])]");
        } else {
            self.tensor(&mass, &matrix);
        }
        self.out.line(4, &format!("pub fn {name}_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {{"));
        let factors: Vec<String> = self.parent(body.link).into_iter().chain(shift(centre)).collect();
        self.out.chain(8, "", '*', &factors, "");
        self.out.line(4, "}");
        self.out.empty();
    }

    fn tensor(&mut self, mass: &str, matrix: &[[&String; 3]; 3]) {
        let rows = matrix.map(|row| row.map(String::as_str).join(", "));
        let whole = format!("#[body(mass = {mass}, inertia = Matrix3::new({}))]", rows.join(", "));
        if whole.len() + 4 <= super::text::WIDTH {
            return self.out.line(4, &whole);
        }
        self.out.line(4, &format!("#[body(mass = {mass}, inertia = Matrix3::new("));
        for row in rows {
            self.out.line(8, &format!("{row},"));
        }
        self.out.line(4, "))]");
    }

    /// The mass of a body in an expression; the field is made once, at the body.
    fn mass(&mut self, body: &Body) -> String {
        let plan = self.plan;
        let name = &plan.frames[body.link].name;
        let field = || format!("{name}_mass");
        let doc = || format!("The mass of {}, in kg.", code(&plan.robot.links[body.link].name));
        self.value(self.parameters.masses, body.inertial.mass, field, doc)
    }

    /// Writes the potential of the weight.
    pub fn gravity(&mut self) {
        let plan = self.plan;
        let size = norm(plan.robot.gravity);
        let heavy: Vec<&Body> = plan.bodies.iter().filter(|body| body.inertial.mass != 0.0).collect();
        if !plan.is_heavy {
            return;
        }
        let doc = "Gravitational acceleration [m/s²].".to_owned();
        self.fields.insert(0, Field { name: "gravity".to_owned(), doc, value: size });
        let up = unit(plan.robot.gravity).map_or([0.0; 3], |down| scaled(-1.0, down));
        let along = up.iter().position(|entry| *entry == 1.0);
        let terms: Vec<String> = heavy
            .iter()
            .map(|body| {
                let name = &plan.frames[body.link].name;
                let mass = match self.parameters.masses {
                    true => format!("self.{name}_mass"),
                    false => number(body.inertial.mass),
                };
                let place = format!("self.{name}_body(q).translation");
                match along {
                    Some(axis) => format!("{mass} * {place}.{}", ["x", "y", "z"][axis]),
                    None => format!("{mass} * self.height(&{place})"),
                }
            })
            .collect();
        if along.is_none() {
            self.height(up);
        }
        self.out.doc(4, "The potential of the weight.");
        self.out.line(4, "#[potential]");
        self.out.line(4, "pub fn weight(&self, q: &Coordinates) -> f64 {");
        weighted(&mut self.out, "self.gravity", &terms);
        self.out.line(4, "}");
        self.out.empty();
    }

    fn height(&mut self, up: [f64; 3]) {
        let terms: Vec<(f64, String)> =
            up.iter().zip(["x", "y", "z"]).map(|(&up, along)| (up, format!("place.{along}"))).collect();
        self.out.doc(4, "How high a place is, against the direction of gravity, in m.");
        self.out.line(4, "fn height(&self, place: &Translation3<f64>) -> f64 {");
        self.out.line(8, &super::text::sum(&terms));
        self.out.line(4, "}");
        self.out.empty();
    }
}

/// A factor before a sum.
pub fn weighted(out: &mut Lines, factor: &str, terms: &[String]) {
    match terms {
        [one] => out.line(8, &format!("{factor} * {one}")),
        _ => {
            let whole = format!("{factor} * ({})", terms.join(" + "));
            if whole.len() + 8 <= super::text::WIDTH {
                return out.line(8, &whole);
            }
            out.line(8, factor);
            let last = terms.len() - 1;
            for (index, term) in terms.iter().enumerate() {
                let end = if index == last { ")" } else { "" };
                match index {
                    0 => out.line(12, &format!("* ({term}{end}")),
                    _ => out.line(16, &format!("+ {term}{end}")),
                }
            }
        }
    }
}
