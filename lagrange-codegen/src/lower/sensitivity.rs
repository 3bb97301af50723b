//! The parameters by which derivatives are taken.

use super::interpreter::Interpreter;
use super::parameter::Parameters;
use super::value::{ParameterId, Value};
use crate::diagnostics::catalogue;
use crate::expr::{Node, Variable};

impl Interpreter<'_> {
    /// Reads the list of the attribute, after all formulas.
    pub fn sensitivities(&mut self) {
        let item = self.item;
        for parameter in &item.sensitivities {
            let known = self.model.parameters.len();
            let value = match self.attribute(parameter) {
                Value::Parameter(id) => Value::Parameter(self.parameters.in_use(id, &self.crate_text())),
                other => other,
            };
            if let Value::Parameter(id) = value
                && self.parameters.has_parts(id)
            {
                let path = self.parameters.text(id).to_owned();
                self.report(parameter.origin, catalogue::several_parameters(path));
                continue;
            }
            let Some(node) = self.scalar(value, parameter.origin) else { continue };
            let Node::Variable(Variable::Parameter(index)) = *self.graph().node(node) else {
                self.report(parameter.origin, catalogue::not_a_parameter());
                continue;
            };
            if index as usize >= known {
                let path = self.model.parameters[index as usize].path.clone();
                self.report(parameter.origin, catalogue::idle_sensitivity(path));
            } else if self.model.sensitivities.contains(&index) {
                let path = self.model.parameters[index as usize].path.clone();
                self.report(parameter.origin, catalogue::repeated_sensitivity(path));
            }
            self.model.sensitivities.push(index);
        }
    }
}

impl Parameters {
    /// The parameter by which formulas know a path: a component has several names.
    fn in_use(&self, id: ParameterId, crate_path: &str) -> ParameterId {
        const COMPONENTS: [&str; 3] = [".x", ".y", ".z"];
        let text = self.text(id);
        let by_name = COMPONENTS.iter().enumerate().find_map(|(k, name)| Some((text.strip_suffix(name)?, k)));
        let by_index = || {
            let (base, index) = text.strip_suffix(']')?.rsplit_once('[')?;
            Some((base, index.parse().ok()?))
        };
        let Some((base, k)) = by_name.or_else(by_index) else { return id };
        let moments = format!("{crate_path}::__private::PrincipalMoments::principal_moments(&{base})[{k}]");
        let names = [
            Some(format!("{base}[{k}]")),
            COMPONENTS.get(k).map(|name| format!("{base}{name}")),
            Some(moments),
        ];
        let is_used = |&id: &ParameterId| self.node(id).is_some();
        std::iter::once(id)
            .chain(names.into_iter().flatten().filter_map(|name| self.known(&name)))
            .find(is_used)
            .unwrap_or(id)
    }

    /// Whether formulas use components of a path, and not its whole.
    fn has_parts(&self, id: ParameterId) -> bool {
        let text = self.text(id);
        let of = [format!("{text}["), format!("{text}."), format!("(&{text})[")];
        self.node(id).is_none()
            && self
                .used()
                .any(|other| other.starts_with(&of[0]) || other.starts_with(&of[1]) || other.contains(&of[2]))
    }
}
