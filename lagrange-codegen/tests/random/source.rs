//! A random system as its user would write it: the arguments of the attribute and the impl block.

use std::fmt;

use crate::expression::RATIO;
use crate::system::{Group, Scalar, System};
use crate::writer::Writer;

/// The parameters that expressions can name, as the user writes them.
pub const PARAMETERS: [&str; 6] =
    ["self.g", "self.m[0]", "self.m[1]", "self.rod.length", "self.k[2][0]", "crate::STIFFNESS"];

pub const COMPONENTS: [&str; 3] = ["x", "y", "z"];

/// The text of a description.
#[derive(Clone, Debug)]
pub struct Source {
    pub arguments: String,
    pub item: String,
}

impl Source {
    /// Writes a system.
    pub fn of(system: &System) -> Source {
        let mut arguments = format!("coordinates = [{}]", declared(&system.coordinates));
        if !system.inputs.is_empty() {
            arguments += &format!(", inputs = [{}]", declared(&system.inputs));
        }
        if let Some(rate) = &system.baumgarte {
            arguments += &format!(", baumgarte = {}", Writer { system, visible: 0, locals: 0 }.scalar(rate));
        }
        arguments += ", allow(no_effect, unused_input, redundant, integrable)";
        let header = match system.scalar {
            Scalar::F64 | Scalar::F32 => "impl Model",
            Scalar::Generic => "impl<R: Real> Model<R>",
        };
        let mut item = format!("{header} {{\n");
        if system.scalar != Scalar::Generic {
            item += &format!("const RATIO: {} = {RATIO:?};\n", scalar_type(system));
        }
        for (index, helper) in system.helpers.iter().enumerate() {
            item += &Writer { system, visible: 0, locals: 0 }.helper(index, helper);
        }
        for (index, role) in system.roles.iter().enumerate() {
            item += &Writer { system, visible: index, locals: 0 }.role(role);
        }
        item += "}\n";
        Source { arguments, item }
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "#[lagrangian({})]\n{}", self.arguments, self.item)
    }
}

fn declared(groups: &[Group]) -> String {
    let one = |group: &Group| match group.length {
        Some(length) => format!("{}: [{length}]", group.name),
        None => group.name.to_owned(),
    };
    groups.iter().map(one).collect::<Vec<_>>().join(", ")
}

pub fn scalar_type(system: &System) -> &'static str {
    match system.scalar {
        Scalar::F64 => "f64",
        Scalar::F32 => "f32",
        Scalar::Generic => "R",
    }
}

/// `record.name` or `record.name[i]` of the `flat`-th scalar.
pub fn quantity(record: &str, groups: &[Group], flat: usize) -> String {
    let mut start = 0;
    for group in groups {
        if flat < start + group.count() {
            return match group.length {
                Some(_) => format!("{record}.{}[{}]", group.name, flat - start),
                None => format!("{record}.{}", group.name),
            };
        }
        start += group.count();
    }
    unreachable!("source: index beyond the declared quantities")
}
