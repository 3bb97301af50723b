//! The switches of a regime: the last parameters of its system.

use crate::diagnostics::Origin;
use crate::expr::{NodeId, Variable};
use crate::model::{Model, Parameter};

/// The switches as variables of the graph, in the order of the parameters.
pub(super) struct Switches {
    /// Whether each row is a constraint.
    pub active: Vec<NodeId>,
    /// The directions of slips.
    pub slip: Vec<NodeId>,
    /// The signs of reactions that limit friction.
    pub side: Vec<NodeId>,
    /// The sides of kinks.
    pub kinks: Vec<NodeId>,
}

impl Switches {
    /// The switches of the rows of a model, as parameters of it.
    pub fn of_rows(model: &mut Model) -> Switches {
        let labels: Vec<(String, _)> =
            model.constraints.iter().map(|row| (row.label(), row.origin)).collect();
        let mut each = |what: &str| -> Vec<NodeId> {
            let labels = labels.iter().map(|(label, origin)| (format!("{label}_{what}"), *origin));
            labels.map(|(label, origin)| parameter(model, label, origin)).collect()
        };
        Switches { active: each("active"), slip: each("slip"), side: each("side"), kinks: Vec::new() }
    }

    /// Adds the switches of kinks.
    pub fn add_kinks(&mut self, model: &mut Model, kinks: usize) {
        let origin = model.coordinates[0].origin;
        self.kinks = (0..kinks).map(|kink| parameter(model, format!("side_{kink}"), origin)).collect();
    }
}

fn parameter(model: &mut Model, label: String, origin: Origin) -> NodeId {
    let index = model.parameters.len() as u32;
    model.parameters.push(Parameter { path: String::new(), label, origin });
    model.graph.variable(Variable::Parameter(index))
}
