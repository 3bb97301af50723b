//! Coordinates whose accelerations are not determined.

use super::matching::Matching;
use crate::calculus::velocity_degrees;
use crate::diagnostics::{Diagnostics, physics};
use crate::expr::Variable;
use crate::mechanics::{Equations, MassMatrix};
use crate::model::Model;

/// Reports coordinates without inertia, unless a constraint of its own determines each, and coordinates whose
/// inertia depends on that of the others. `rows` are the patterns of the gradients of the constraints. The
/// matrix (M Aᵀ; A 0) must be regular.
pub(in crate::mechanics) fn inertia(
    model: &Model,
    equations: &Equations,
    rows: &[Vec<bool>],
    diagnostics: &mut Diagnostics,
) {
    let mass = match &equations.mass {
        MassMatrix::Formed(mass) => mass,
        // A recursion finds what is singular.
        MassMatrix::Known { .. } => {
            let without = |i: &usize| model.graph.is_zero(equations.momenta[*i]);
            for coordinate in (0..model.coordinates.len()).filter(without).map(|i| &model.coordinates[i]) {
                diagnostics.at(coordinate.origin, physics::no_inertia(&coordinate.written(), false));
            }
            return;
        }
    };
    let inertial = |i: usize, j: usize| !model.graph.is_zero(mass[i.max(j)][i.min(j)]);
    let (count, held) = (mass.len(), rows.len());
    let mut determined =
        Matching::new(held, |coordinate: usize, constraint: usize| rows[constraint][coordinate]);
    let mut massless = false;
    for (row, coordinate) in model.coordinates.iter().enumerate() {
        if (0..count).all(|column| !inertial(row, column)) && !determined.add(row) {
            massless = true;
            let linear = model.lagrangian.iter().chain(&model.kinetic).any(|term| {
                model.graph.depends_on(term.value, Variable::Velocity(row as u32))
                    && velocity_degrees(&model.graph, term.value).at_most(1)
            });
            diagnostics.at(coordinate.origin, physics::no_inertia(&coordinate.written(), linear));
        }
    }
    if massless {
        return;
    }
    // Rows of A come first. They can all be matched, so a row without a match is a coordinate.
    let mut whole = Matching::new(count + held, |row: usize, column: usize| {
        match (row.checked_sub(held), column < count) {
            (None, true) => rows[row][column],
            (None, false) => false,
            (Some(coordinate), true) => inertial(coordinate, column),
            (Some(coordinate), false) => rows[column - count][coordinate],
        }
    });
    if let Some(row) = (0..held + count).find(|&row| !whole.add(row))
        && let Some(coordinate) = model.coordinates.get(row.wrapping_sub(held))
    {
        diagnostics.at(coordinate.origin, physics::structurally_singular(&coordinate.written()));
    }
}
