//! Parameters: paths such as `self.m[0]` that stay symbolic until something tells their shape.

use super::interpreter::Interpreter;
use super::value::{ParameterId, Value};
use crate::collections::Lookup;
use crate::diagnostics::{Origin, catalogue};
use crate::expr::{NodeId, Variable};
use crate::model::{Length, Parameter};

/// All paths met so far.
#[derive(Debug, Default)]
pub struct Parameters {
    paths: Vec<PathEntry>,
    known: Lookup<String, ParameterId>,
    /// While the operand of a conversion is evaluated: operators on parameters are kept as they are written.
    pub as_written: bool,
}

#[derive(Debug)]
struct PathEntry {
    text: String,
    label: String,
    origin: Origin,
    node: Option<NodeId>,
    /// Whether it is known to be an integer.
    is_integer: bool,
    /// The mistake that made it an integer, if it is taken for a number.
    mistake: Option<(Origin, String)>,
}

impl Parameters {
    /// The path of a text.
    pub fn intern(&mut self, text: String, label: String, origin: Origin) -> ParameterId {
        if let Some(&id) = self.known.get(&text) {
            return id;
        }
        let id = ParameterId(self.paths.len());
        self.known.insert(text.clone(), id);
        self.paths.push(PathEntry { text, label, origin, node: None, is_integer: false, mistake: None });
        id
    }

    /// Notes that a path is an integer, with the mistake that made it one if it is taken for a number.
    pub fn note_integer(&mut self, id: ParameterId, mistake: Option<(Origin, String)>) {
        let entry = &mut self.paths[id.0];
        (entry.is_integer, entry.mistake) = (true, mistake.or(entry.mistake.take()));
    }

    /// Whether a path is known to be an integer.
    pub fn is_integer(&self, id: ParameterId) -> bool {
        self.paths[id.0].is_integer
    }

    /// The mistake that made a path an integer.
    pub fn mistake(&self, id: ParameterId) -> Option<(Origin, String)> {
        self.paths[id.0].mistake.clone()
    }

    /// The path of a text, if it has been met.
    pub fn known(&self, text: &str) -> Option<ParameterId> {
        self.known.get(&text.to_owned()).copied()
    }

    /// The scalar that formulas use.
    pub fn node(&self, id: ParameterId) -> Option<NodeId> {
        self.paths[id.0].node
    }

    /// The texts of all scalars that formulas use.
    pub fn used(&self) -> impl Iterator<Item = &str> {
        self.paths.iter().filter(|entry| entry.node.is_some()).map(|entry| &*entry.text)
    }

    /// The Rust text of a path.
    pub fn text(&self, id: ParameterId) -> &str {
        &self.paths[id.0].text
    }

    /// The name of a path for a local variable.
    pub fn label(&self, id: ParameterId) -> &str {
        &self.paths[id.0].label
    }
}

impl Interpreter<'_> {
    /// The parameter of `self` itself.
    pub fn self_parameter(&mut self, origin: Origin) -> ParameterId {
        self.parameters.intern("self".into(), String::new(), origin)
    }

    /// `path.name`.
    pub fn parameter_field(&mut self, id: ParameterId, name: &str, origin: Origin) -> ParameterId {
        let written = if syn_keyword(name) { format!("r#{name}") } else { name.to_string() };
        self.extend_parameter(id, &format!(".{written}"), name, origin)
    }

    /// `path[index]`.
    pub fn parameter_index(&mut self, id: ParameterId, index: usize, origin: Origin) -> ParameterId {
        self.extend_parameter(id, &format!("[{index}]"), &index.to_string(), origin)
    }

    /// `path[(row, column)]`.
    pub fn parameter_entry(
        &mut self,
        id: ParameterId,
        row: usize,
        column: usize,
        origin: Origin,
    ) -> ParameterId {
        self.extend_parameter(id, &format!("[({row}, {column})]"), &format!("{row}_{column}"), origin)
    }

    /// A parameter made from another by a function of the runtime's algebra.
    pub fn parameter_function(&mut self, id: ParameterId, name: &str, origin: Origin) -> ParameterId {
        let path = self.parameters.text(id);
        let text = format!("{}::__private::algebra::{name}(&{path})", self.crate_text());
        let label = format!("{}_{name}", self.parameters.label(id));
        self.parameters.intern(text, label, origin)
    }

    /// `*path`.
    pub fn pointee(&mut self, id: ParameterId, origin: Origin) -> ParameterId {
        let (text, label) =
            (format!("(*{})", self.parameters.text(id)), self.parameters.label(id).to_owned());
        self.parameters.intern(text, label, origin)
    }

    fn extend_parameter(
        &mut self,
        id: ParameterId,
        suffix: &str,
        label: &str,
        origin: Origin,
    ) -> ParameterId {
        self.refuses_integer(id, origin);
        let text = format!("{}{suffix}", self.parameters.text(id));
        let label = match self.parameters.label(id) {
            "" if label.starts_with(|c: char| c.is_ascii_digit()) => format!("parameter_{label}"),
            "" => label.to_string(),
            before => format!("{before}_{label}"),
        };
        self.parameters.intern(text, label, origin)
    }

    /// Takes a parameter for an array of the length that its context gives. The emitted code checks the
    /// length.
    pub fn parameter_elements(&mut self, id: ParameterId, length: usize, origin: Origin) -> Vec<Value> {
        let path = self.parameters.text(id).to_owned();
        self.model.lengths.push(Length { path, length, origin });
        (0..length).map(|index| Value::Parameter(self.parameter_index(id, index, origin))).collect()
    }

    /// The node of a parameter that is a scalar.
    pub fn scalar_parameter(&mut self, id: ParameterId, origin: Origin) -> Option<NodeId> {
        if self.refuses_integer(id, origin) {
            return None;
        }
        let entry = &mut self.parameters.paths[id.0];
        if let Some(node) = entry.node {
            return Some(node);
        }
        if entry.text == "self" {
            self.report(origin, catalogue::self_as_value());
            return None;
        }
        let index = self.model.parameters.len() as u32;
        self.model.parameters.push(Parameter {
            path: entry.text.clone(),
            label: entry.label.clone(),
            origin: entry.origin,
        });
        let node = self.model.graph.variable(Variable::Parameter(index));
        entry.node = Some(node);
        Some(node)
    }
}

/// Whether a field's name must be written as a raw identifier.
fn syn_keyword(name: &str) -> bool {
    !name.starts_with(|c: char| c.is_ascii_digit()) && syn::parse_str::<syn::Ident>(name).is_err()
}
