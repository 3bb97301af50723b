//! Laws of friction that depend on the direction of the slip.
//!
//! A one-way clutch has another limit in each direction, and a coefficient that falls with the speed is a
//! function of |slip|. The kink of such a function lies where the friction sticks. There the direction is not
//! given by the state: it is the one in which the slip would begin. So in the laws of a friction these
//! functions become functions of the switch that gives the direction of its slip.

use super::kinks::{self, MOVING};
use crate::calculus::substitute;
use crate::expr::{Graph, NodeId, Unary};
use crate::model::{Contact, Law};

/// Coefficients or limits of friction of some rows; zero for rows without friction.
#[derive(Debug)]
pub struct Coefficients {
    /// The coefficients of slipping friction.
    pub kinetic: Vec<NodeId>,
    /// The coefficients of sticking friction.
    pub fixed: Vec<NodeId>,
}

impl Coefficients {
    /// The same with zeros for rows before and behind.
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
            // A component of a slip in two directions does not tell its direction.
            if let Law::Friction { kinetic, fixed, pair: None, .. } = &mut contact.law {
                let replacements = own(graph, [*kinetic, *fixed], slip, direction);
                [*kinetic, *fixed] = replaced(graph, [*kinetic, *fixed], &replacements);
            }
            contact
        })
        .collect()
}

/// The functions of some laws with a kink where a slip is zero, and their forms in a direction of that slip.
fn own(graph: &mut Graph, laws: [NodeId; 2], slip: NodeId, direction: NodeId) -> Vec<(NodeId, NodeId)> {
    let mut replacements = Vec::new();
    for argument in kinks::arguments(graph, laws) {
        let share = graph.div(argument, slip);
        // A multiple of the slip has further kinks if its factor may vanish, too.
        if graph.dependence(share).meets(MOVING) {
            continue;
        }
        let sign = graph.unary(Unary::Signum, share);
        let side = graph.mul(sign, direction);
        replacements.extend(kinks::on_side(graph, argument, side));
    }
    replacements
}

/// Whether a law depends on the direction of a slip.
pub(super) fn have_directions(contacts: &[Contact], sliding: &[Contact]) -> bool {
    contacts.iter().zip(sliding).any(|(contact, sliding)| kinks::laws(contact) != kinks::laws(sliding))
}

/// The switching functions at a state, where the slip itself has a direction.
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
