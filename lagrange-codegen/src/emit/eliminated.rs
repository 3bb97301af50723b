//! Methods that give the declared quantities of a state, if its numbers are others: with coordinates that
//! constraints eliminate, and with orientations.
//!
//! The user's functions take all declared coordinates. A state holds numbers for the remaining ones.

use super::Emission;
use super::body::{self, Source};
use super::{docs, methods};
use crate::expr::{NodeId, Variable};
use crate::model::orientation;
use crate::simplify::simplify;
use crate::syntax::Record;
use crate::syntax::item::Kind;

/// The methods.
pub(crate) const METHODS: [&str; 2] = ["coordinates", "velocities"];

/// `coordinates` and `velocities`; nothing if a state holds just these.
pub(super) fn completions(emission: &mut Emission<'_>) -> String {
    if emission.is_state_complete() {
        return String::new();
    }
    let coordinates = completion(emission, Record::Coordinates);
    coordinates + &completion(emission, Record::Velocities)
}

fn completion(emission: &mut Emission<'_>, record: Record) -> String {
    let [coordinates, velocities] = METHODS;
    let (name, what, mark) = match record {
        Record::Velocities => (velocities, "velocities", "′"),
        Record::Coordinates | Record::Inputs => (coordinates, "coordinates", ""),
    };
    let mut nodes = declared(emission, record);
    let by_name = record == Record::Velocities && emission.item.has_orientations();
    if by_name {
        angular(emission, &mut nodes);
    }
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let model = &*emission.model;
    let mut doc = format!("All declared {what} by name");
    if !model.eliminated.is_empty() {
        doc.push_str(", those included that constraints have eliminated");
    }
    if by_name {
        doc.push_str("; angular velocities in body axes [rad/s]");
    }
    doc.push('.');
    for eliminated in &model.eliminated {
        let symbol = format!("{}{mark}", eliminated.quantity.written());
        doc.push_str(&docs::equation(model, &symbol, nodes[eliminated.declared_index]));
    }
    let scalar = &emission.scalar;
    let result = format!("{}<{scalar}>", emission.item.record_ident(record));
    let signature = format!("{name}({}) -> {result}", methods::arguments(emission, &nodes));
    let body = body::plain(model, scalar, &nodes, Source::State, |values| {
        let numbers = format!("[{}]", values.join(", "));
        let numbers = if by_name { format!("lagrange::attitude::ByName({numbers})") } else { numbers };
        format!("<{result} as ::core::convert::From<_>>::from({numbers})")
    });
    methods::method(&doc, &signature, &body)
}

/// Replaces the rates of orientations by angular velocities.
fn angular(emission: &mut Emission<'_>, velocities: &mut [NodeId]) {
    let coordinates = declared(emission, Record::Coordinates);
    let mut first = 0;
    for group in &emission.item.coordinates {
        for _ in 0..group.length.unwrap_or(1) {
            let next = first + group.kind.width();
            let turned = next - 3.min(group.kind.width())..next;
            if let (true, Some(rho), Some(rates)) = (
                group.kind != Kind::Scalar,
                coordinates.get(turned.clone()).and_then(<[_]>::first_chunk),
                velocities.get(turned.clone()).and_then(<[_]>::first_chunk),
            ) {
                let rate = orientation::body_rate(&mut emission.model.graph, rho, rates);
                velocities[turned].copy_from_slice(&rate);
            }
            first = next;
        }
    }
}

/// The values of all declared coordinates, or their velocities, in order.
fn declared(emission: &mut Emission<'_>, record: Record) -> Vec<NodeId> {
    let model = &mut *emission.model;
    let mut left = 0;
    let mut next = || {
        left += 1;
        match record {
            Record::Velocities => Variable::Velocity(left - 1),
            Record::Coordinates | Record::Inputs => Variable::Coordinate(left - 1),
        }
    };
    let mut eliminated = model.eliminated.iter().peekable();
    (0..model.coordinates.len() + model.eliminated.len())
        .map(|index| match eliminated.next_if(|eliminated| eliminated.declared_index == index) {
            Some(eliminated) if record == Record::Velocities => eliminated.velocity,
            Some(eliminated) => eliminated.position,
            None => model.graph.variable(next()),
        })
        .collect()
}
