//! Laws of friction that depend on the direction of the slip.
//!
//! A one-way clutch has another limit in each direction, and a coefficient that falls with the speed is a
//! function of |slip|. Such functions have their kink where the friction sticks, and there the direction is
//! no matter of the state: it is that in which the slip would begin. So in the laws of a friction they become
//! functions of the switch that says in which direction it slips.

use super::kinks::{self, MOVING};
use crate::calculus::substitute;
use crate::expr::{Graph, NodeId, Unary};
use crate::model::{Contact, Law};

/// Coefficients of friction, or coefficients, of some rows; zero of those that are none.
#[derive(Debug)]
pub struct Coefficients {
    /// Of friction that slips.
    pub kinetic: Vec<NodeId>,
    /// Of friction that sticks.
    pub fixed: Vec<NodeId>,
}

impl Coefficients {
    /// The same with places for rows before and behind.
    pub(super) fn on_rows(mut self, zero: NodeId, before: usize, behind: usize) -> Coefficients {
        for list in [&mut self.kinetic, &mut self.fixed] {
            list.splice(0..0, std::iter::repeat_n(zero, before));
            list.extend(std::iter::repeat_n(zero, behind));
        }
        self
    }
}

/// Contacts with the laws of frictions as functions of the direction of their slips.
pub(super) fn along(graph: &mut Graph, contacts: &[Contact], directions: &[NodeId]) -> Vec<Contact> {
    contacts
        .iter()
        .zip(directions)
        .map(|(contact, &direction)| {
            let mut contact = contact.clone();
            let slip = contact.constraint.value;
            // Of a slip in two directions no component says in which it is.
            if let Law::Friction { kinetic, fixed, pair: None, .. } = &mut contact.law {
                let replacements = own(graph, [*kinetic, *fixed], slip, direction);
                [*kinetic, *fixed] = replaced(graph, [*kinetic, *fixed], &replacements);
            }
            contact
        })
        .collect()
}

/// The functions of some laws whose kink is where a slip is zero, and what they are in a direction of it.
fn own(graph: &mut Graph, laws: [NodeId; 2], slip: NodeId, direction: NodeId) -> Vec<(NodeId, NodeId)> {
    let mut replacements = Vec::new();
    for argument in kinks::arguments(graph, laws) {
        let share = graph.div(argument, slip);
        // A multiple of the slip by what may pass zero itself has other kinks.
        if graph.dependence(share).meets(MOVING) {
            continue;
        }
        let sign = graph.unary(Unary::Signum, share);
        let side = graph.mul(sign, direction);
        replacements.extend(kinks::on_side(graph, argument, side));
    }
    replacements
}

/// Whether any law has become one of directions.
pub(super) fn have_directions(contacts: &[Contact], sliding: &[Contact]) -> bool {
    contacts.iter().zip(sliding).any(|(contact, sliding)| kinks::laws(contact) != kinks::laws(sliding))
}

/// Switching functions as they are at a state, where the slip itself has a direction.
pub(super) fn at_a_state(
    graph: &mut Graph,
    kinks: &[NodeId],
    contacts: &[Contact],
    directions: &[NodeId],
) -> Vec<NodeId> {
    let sign = |contact: &Contact| graph.unary(Unary::Signum, contact.constraint.value);
    let signs: Vec<NodeId> = contacts.iter().map(sign).collect();
    let known: Vec<(NodeId, NodeId)> = directions.iter().copied().zip(signs).collect();
    substitute(graph, kinks, &known)
}

/// The coefficients of contacts in either direction of their slips: forward and backward.
pub(super) fn coefficients(
    graph: &mut Graph,
    contacts: &[Contact],
    directions: &[NodeId],
) -> [Coefficients; 2] {
    let one = graph.one();
    let minus_one = graph.neg(one);
    let zero = graph.zero();
    let laws: Vec<NodeId> =
        contacts.iter().flat_map(|contact| kinks::laws(contact).unwrap_or([zero; 2])).collect();
    [one, minus_one].map(|side| {
        let known: Vec<(NodeId, NodeId)> = directions.iter().map(|&direction| (direction, side)).collect();
        let laws = substitute(graph, &laws, &known);
        let each = |which: usize| laws.iter().skip(which).step_by(2).copied().collect();
        Coefficients { kinetic: each(0), fixed: each(1) }
    })
}

fn replaced(graph: &mut Graph, laws: [NodeId; 2], replacements: &[(NodeId, NodeId)]) -> [NodeId; 2] {
    let laws = substitute(graph, &laws, replacements);
    [laws[0], laws[1]]
}
