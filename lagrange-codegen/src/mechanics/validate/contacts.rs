//! Coefficients of contacts that are constants and cannot be right.

use crate::diagnostics::{Diagnostics, Origin, physics};
use crate::expr::NodeId;
use crate::model::{Law, Model};
use crate::number::Number;

/// Restitutions beyond 0 and 1, and negative friction.
pub fn contacts(model: &Model, diagnostics: &mut Diagnostics) {
    let constant = |node: NodeId| model.graph.as_constant(node);
    let is_negative = |node: NodeId| constant(node).is_some_and(Number::is_negative);
    // The elements of an array share their function.
    let mut reported: Vec<Origin> = Vec::new();
    for contact in &model.contacts {
        let constraint = &contact.constraint;
        let message = match contact.law {
            Law::Unilateral { restitution, .. } => {
                let is_large = constant(restitution).is_some_and(|value| value.value() > 1.0);
                (is_negative(restitution) || is_large).then(|| physics::restitution(&constraint.name))
            }
            Law::Friction { kinetic, fixed, .. } => (is_negative(kinetic) || is_negative(fixed))
                .then(|| physics::negative_friction(&constraint.name)),
        };
        if let Some(message) = message
            && !reported.contains(&constraint.origin)
        {
            reported.push(constraint.origin);
            diagnostics.at(constraint.origin, message);
        }
    }
}
