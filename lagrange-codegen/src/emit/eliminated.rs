//! Methods that complete a state by the coordinates that constraints have eliminated.
//!
//! The user's functions take all declared coordinates; a state holds those that are left.

use super::Emission;
use super::body::{self, Source};
use super::{docs, methods};
use crate::expr::{NodeId, Variable};
use crate::simplify::simplify;
use crate::syntax::Record;

/// The methods of a system from which coordinates were eliminated.
pub(crate) const METHODS: [&str; 2] = ["coordinates", "velocities"];

/// `coordinates` and `velocities`; nothing where no coordinate was eliminated.
pub(super) fn completions(emission: &mut Emission<'_>) -> String {
    if emission.model.eliminated.is_empty() {
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
    let nodes = declared(emission, record);
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let model = &*emission.model;
    let mut doc = format!("All declared {what}, those included that constraints have eliminated.");
    for eliminated in &model.eliminated {
        let symbol = format!("{}{mark}", eliminated.quantity.written());
        doc.push_str(&docs::equation(model, &symbol, nodes[eliminated.declared_index]));
    }
    let (scalar, count) = (&emission.scalar, nodes.len());
    let result = format!("{}<{scalar}>", emission.item.record_ident(record));
    let signature = format!("{name}({}) -> {result}", methods::arguments(emission, &nodes));
    let body = body::plain(model, scalar, &nodes, Source::State, |values| {
        format!("<{result} as ::core::convert::From<[{scalar}; {count}]>>::from([{}])", values.join(", "))
    });
    methods::method(&doc, &signature, &body)
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
        .map(|place| match eliminated.next_if(|eliminated| eliminated.declared_index == place) {
            Some(eliminated) if record == Record::Velocities => eliminated.velocity,
            Some(eliminated) => eliminated.position,
            None => model.graph.variable(next()),
        })
        .collect()
}
