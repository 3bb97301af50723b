//! The Cartesian forces of the constraints on each particle and body.

use super::methods::of_balance;
use super::record_ident;
use crate::emit::Emission;
use crate::emit::methods::method;
use crate::expr::{NodeId, Variable};

/// The prefix of the methods' names.
pub(in crate::emit) const PREFIX: &str = "reactions_on_";

/// Whether a name is that of a generated method.
pub(crate) fn is_generated(name: &str, mut places: impl Iterator<Item = String>) -> bool {
    name.strip_prefix(PREFIX).is_some_and(|place| places.any(|other| other == place))
}

/// A method for each function of particles or bodies that a constraint acts on.
pub(super) fn methods(emission: &mut Emission<'_>, balance: &str, parameter: &str) -> String {
    let mut text = String::new();
    let places = emission.model.places.clone();
    let mut first = 0;
    while let Some(place) = places.get(first) {
        let count = places[first..].iter().take_while(|other| other.name == place.name).count();
        let range = first..first + count;
        first = range.end;
        let dimension = place.position.len();
        let forces: Vec<Vec<NodeId>> = emission
            .equations
            .conditions
            .on_places
            .iter()
            .map(|places| places[range.clone()].iter().flatten().copied().collect())
            .collect();
        let graph = &mut emission.model.graph;
        if forces.iter().flatten().all(|&force| graph.is_zero(force)) {
            continue;
        }
        let mut nodes = Vec::new();
        for (c, row) in forces.iter().enumerate() {
            let multiplier = graph.variable(Variable::Multiplier(c as u32));
            nodes.extend(row.iter().map(|&force| graph.mul(multiplier, force)));
        }
        let (scalar, record) = (emission.scalar.to_string(), record_ident(emission.item));
        let vector = format!("lagrange::nalgebra::SVector<{scalar}, {dimension}>");
        let is_array = place.index.is_some();
        let each = if is_array { format!("[{vector}; {count}]") } else { vector };
        let width = dimension * count;
        let body = of_balance(emission, balance, &nodes, |values| {
            let vectors = |values: &[String]| {
                let vectors: Vec<String> = values
                    .chunks(dimension)
                    .map(|parts| format!("lagrange::nalgebra::SVector::from([{}])", parts.join(", ")))
                    .collect();
                if is_array { format!("[{}]", vectors.join(", ")) } else { vectors.concat() }
            };
            let rows: Vec<String> = values.chunks(width).map(vectors).collect();
            format!("{record}::from([{}])", rows.join(", "))
        });
        let name = &place.name;
        let doc = format!(
            "Cartesian forces of the constraints on `{name}` \\[N\\], by name: λ ∂f/∂r where f is written through its position r, \
             or in coordinates that are components of it. \
             What f says of other coordinates is not in it.\n\n# Errors\n\nA singular system, with its cause and the time."
        );
        let signature = format!(
            "{PREFIX}{name}(&self, state: &{}{parameter}) -> ::core::result::Result<{record}<{each}>, lagrange::MotionError<{scalar}>>",
            emission.state_type()
        );
        text.push_str("#[allow(unused_variables)]\n");
        text.push_str(&method(&doc, &signature, &body));
    }
    text
}
