//! The residual and its derivatives in systems whose bodies carry each other: the screws of a state, from
//! which the runtime computes them, and the terms of other forces.

use super::{Emission, body, scalar};
use crate::expr::NodeId;
use crate::mechanics::Screws;

/// The implementation of the runtime's `Carried`.
pub(super) struct Carried {
    /// Its name with the sizes.
    pub path: String,
    /// Its items.
    pub items: String,
}

/// Bodies of functions of `Linearized`.
pub(super) struct Bodies {
    pub residual_at: String,
    pub linearization_at: String,
    pub factored_at: String,
}

/// The function that turns a state into screws. `place` is the text of its arguments.
pub(super) fn carried(emission: &mut Emission<'_>, screws: &Screws, place: &str) -> Carried {
    let (count, inputs) = (emission.count(), emission.model.inputs.len());
    let (groups, rates, changes) = (screws.groups.len(), screws.rates.len(), screws.changes.len());
    let state = body::simplified(emission, &screws.nodes(), |values| literal(screws, values));
    let items = format!(
        "const GROUPS: [lagrange::screws::Group; {groups}] = {};\n\
         #[inline]\nfn screws_at({place}) -> lagrange::screws::Screws<{}, {count}, {groups}, {rates}, {changes}> \
         {{\n{state}\n}}\n",
        table(screws),
        emission.scalar,
    );
    Carried {
        path: format!("lagrange::screws::Carried<{count}, {inputs}, {groups}, {rates}, {changes}>"),
        items,
    }
}

/// The bodies, from the other forces and their derivatives by coordinates and then by velocities, row by row.
pub(super) fn bodies(
    emission: &mut Emission<'_>,
    carried: &Carried,
    rest: &[NodeId],
    derivatives: &[NodeId],
) -> Bodies {
    let (count, zero) = (emission.count(), scalar::zero(&emission.scalar));
    let itself = format!("<Self as {}>", carried.path);
    let with = |given: &str| {
        format!("&{itself}::screws_at(self, _constants, t, q, v), &{itself}::GROUPS, v, {given}")
    };
    let added = |derivatives: &[String]| {
        let mut text = String::new();
        for (name, entries) in ["by_q", "by_v"].into_iter().zip(derivatives.chunks(count * count)) {
            for (index, entry) in entries.iter().enumerate().filter(|(_, entry)| **entry != zero) {
                let (i, j) = (index / count, index % count);
                text.push_str(&format!("matrices.{name}[{i}][{j}] = matrices.{name}[{i}][{j}] + {entry};\n"));
            }
        }
        text
    };
    let residual_at = body::simplified(emission, rest, |rest| {
        let mut text = format!("let mut residual = lagrange::screws::residual({});\n", with("accelerations"));
        for (i, force) in rest.iter().enumerate().filter(|(_, force)| **force != zero) {
            text.push_str(&format!("residual[{i}] = residual[{i}] + {force};\n"));
        }
        text + "residual"
    });
    let linearization_at = body::simplified(emission, derivatives, |derivatives| {
        let given = with("accelerations");
        format!(
            "let mut matrices = lagrange::screws::linearization({given});\n{}matrices",
            added(derivatives)
        )
    });
    let factored_at = body::simplified(emission, &[rest, derivatives].concat(), |values| {
        let (rest, derivatives) = values.split_at(rest.len());
        let given = with(&format!("&[{}], matrices", rest.join(", ")));
        format!("lagrange::screws::factored({given});\n{}", added(derivatives))
    });
    Bodies { residual_at, linearization_at, factored_at }
}

/// The table of groups.
fn table(screws: &Screws) -> String {
    let groups = screws.groups.iter().map(|group| {
        let parent = group.parent.unwrap_or(screws.groups.len());
        let (coordinates, given) = (&group.coordinates, group.given.unwrap_or(screws.rates.len()));
        format!(
            "lagrange::screws::Group {{ parent: {parent}, coordinates: &{coordinates:?}, given: {given} }}"
        )
    });
    format!("[{}]", groups.collect::<Vec<_>>().join(", "))
}

/// The struct with values in place of the nodes.
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
        "lagrange::screws::Screws {{ points: {points}, screws: {of_coordinates}, rates: [{}], \
         changes: {changes}, inertias: {inertias}, gravity: {gravity} }}",
        rates.join(", ")
    )
}
