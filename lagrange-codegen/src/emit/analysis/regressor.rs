//! The equations as a linear function of lumped parameters.

use super::conserved::constant;
use super::with_accelerations;
use crate::emit::body::{self, Source};
use crate::emit::constraints::rows;
use crate::emit::methods::method;
use crate::emit::names::name_accelerations;
use crate::emit::{Emission, equations};
use crate::expr::NodeId;
use crate::mechanics::analysis::Regressor;
use crate::simplify::simplify;

/// `REGRESSOR`, `lumped_parameters` and `regressor`, if the equations are linear in products of the
/// parameters.
pub(super) fn items(emission: &mut Emission<'_>) -> String {
    let Some(Regressor { lumped, columns }) = Regressor::of(emission.model, emission.equations) else {
        return String::new();
    };
    name_accelerations(emission.model);
    let (count, width) = (emission.count(), lumped.len());
    let names: Vec<String> = lumped.iter().map(|&node| equations::expression(emission.model, node)).collect();
    let mut text = constant(
        "REGRESSOR",
        "Lumped parameters π in which the equations are linear, M a + b = Y π; those that identification can \
         tell apart at most. `1` stands for what no parameter multiplies.",
        &names,
    );
    let scalar = emission.scalar.clone();
    let body = body::plain(emission.model, &scalar, &lumped, Source::State, |values| {
        format!("[{}]", values.join(", "))
    });
    text.push_str(&method(
        "Values of the lumped parameters π, in the order of `REGRESSOR`.",
        &format!("lumped_parameters(&self) -> [{scalar}; {width}]"),
        &body,
    ));
    let nodes: Vec<NodeId> = (0..count).flat_map(|i| columns.iter().map(move |column| column[i])).collect();
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let signature = format!(
        "regressor({}) -> lagrange::nalgebra::SMatrix<{scalar}, {count}, {width}>",
        with_accelerations(emission, &nodes)
    );
    let body = body::plain(emission.model, &scalar, &nodes, Source::State, |values| {
        let filled: Vec<Vec<String>> = values.chunks(width.max(1)).map(<[String]>::to_vec).collect();
        rows(&scalar, "matrices", width, &filled) + "lagrange::constraints::matrix(&matrices)"
    });
    text.push_str("#[allow(unused_variables)]\n");
    text.push_str(&method(
        "Regressor Y(q, v, a, t) with Y π = M a + b: a row for each coordinate, a column for each lumped \
         parameter. It has inertia and what a potential or Lagrangian gives; damping and `#[force]` functions \
         are not in it.",
        &signature,
        &body,
    ));
    text
}
