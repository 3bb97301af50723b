//! The residual and its derivatives where bodies hang on each other: the screws of a state for the runtime,
//! and what other forces add.

use super::{Emission, body, scalar};
use crate::expr::NodeId;
use crate::mechanics::Screws;

/// The bodies of `residual_at` and `linearization_at`, from the other forces and their derivatives by
/// coordinates and then by velocities, row by row.
pub(super) fn bodies(
    emission: &mut Emission<'_>,
    screws: &Screws,
    rest: &[NodeId],
    derivatives: Vec<NodeId>,
) -> (String, String) {
    let (count, zero) = (emission.count(), scalar::zero(&emission.scalar));
    let nodes = screws.nodes();
    let groups = groups(screws);
    let residual = body::simplified(emission, &[nodes.as_slice(), rest].concat(), |values| {
        let (values, rest) = values.split_at(nodes.len());
        let mut text = literal(screws, values);
        text.push_str(&format!(
            "let mut residual = lagrange::screws::residual(&screws, &{groups}, v, accelerations);\n"
        ));
        for (i, force) in rest.iter().enumerate().filter(|(_, force)| **force != zero) {
            text.push_str(&format!("residual[{i}] = residual[{i}] + {force};\n"));
        }
        text + "residual"
    });
    let matrices = body::simplified(emission, &[nodes.as_slice(), &derivatives].concat(), |values| {
        let (values, derivatives) = values.split_at(nodes.len());
        let mut text = literal(screws, values);
        text.push_str(&format!(
            "let mut matrices = lagrange::screws::linearization(&screws, &{groups}, v, accelerations);\n"
        ));
        for (name, entries) in ["by_q", "by_v"].into_iter().zip(derivatives.chunks(count * count)) {
            for (place, entry) in entries.iter().enumerate().filter(|(_, entry)| **entry != zero) {
                let (i, j) = (place / count, place % count);
                text.push_str(&format!("matrices.{name}[{i}][{j}] = matrices.{name}[{i}][{j}] + {entry};\n"));
            }
        }
        text + "matrices"
    });
    (residual, matrices)
}

/// The table of groups.
fn groups(screws: &Screws) -> String {
    let groups = screws.groups.iter().map(|group| {
        let parent = group.parent.unwrap_or(screws.groups.len());
        let (coordinates, given) = (&group.coordinates, group.given.unwrap_or(screws.rates.len()));
        format!(
            "lagrange::screws::Group {{ parent: {parent}, coordinates: &{coordinates:?}, given: {given} }}"
        )
    });
    format!("[{}]", groups.collect::<Vec<_>>().join(", "))
}

/// The statement that puts values in the places of the nodes.
fn literal(screws: &Screws, values: &[String]) -> String {
    let mut values = values.iter();
    let mut row = |size: usize| {
        let entries: Vec<&str> = values.by_ref().take(size).map(String::as_str).collect();
        format!("[{}]", entries.join(", "))
    };
    let mut rows = |count: usize, size: usize| {
        let rows: Vec<String> = (0..count).map(|_| row(size)).collect();
        format!("[{}]", rows.join(", "))
    };
    let (points, of_coordinates) = (rows(screws.points.len(), 3), rows(screws.screws.len(), 6));
    let rates: Vec<String> = screws.rates.iter().map(|_| rows(2, 6)).collect();
    let (changes, inertias) = (rows(screws.changes.len(), 6), rows(screws.inertias.len(), 10));
    let gravity = row(3);
    format!(
        "let screws = lagrange::screws::Screws {{ points: {points}, screws: {of_coordinates}, rates: [{}], \
         changes: {changes}, inertias: {inertias}, gravity: {gravity} }};\n",
        rates.join(", ")
    )
}
