//! Quantities with two values at a kink.
//!
//! None of these items is there where no quantity has two.

use super::super::Emission;
use super::super::body::{self, Source};
use crate::calculus::sizes;
use crate::expr::NodeId;
use crate::regimes::Regimes;

/// `passed_at`, which asks for the others behind each step of a method that does not look for kinks.
pub(in crate::emit) fn passed(emission: &Emission<'_>, switching: &Regimes) -> String {
    let graph = &switching.rows.graph;
    let is_even = switching.jumps.iter().all(|&jump| graph.is_zero(jump));
    if is_even && switching.corners.is_empty() && switching.breaks.is_empty() {
        return String::new();
    }
    let (scalar, inputs) = (&emission.scalar, emission.input_type());
    let (count, given) = (emission.count(), emission.model.inputs.len());
    let (rows, kinks) = (switching.rows(), switching.kinks.len());
    let state = format!("&lagrange::State<{scalar}, {count}>");
    format!(
        "const JUMPS: bool = true;\n\
         fn passed_at(&self, __from: {state}, __to: {state}, u: &{inputs}) \
         -> ::core::result::Result<(), lagrange::Cause> {{\n\
         lagrange::switching::passed::<Self, {count}, {given}, {rows}, {kinks}>(self, __from, __to, u)\n}}\n"
    )
}

/// `jumps_at`, if the energy jumps at a kink.
pub(super) fn jumps(emission: &Emission<'_>, switching: &mut Regimes) -> String {
    let graph = &mut switching.rows.graph;
    if switching.jumps.iter().all(|&jump| graph.is_zero(jump)) {
        return String::new();
    }
    let size = sizes(graph, &[switching.laws.energy])[0];
    let mut roots = switching.jumps.clone();
    roots.extend(vec![size; switching.jumps.len()]);
    let (scalar, vector, inputs) = (&emission.scalar, emission.vector_type(), emission.input_type());
    let body = body::plain(&switching.rows, scalar, &roots, Source::Slices, |values| {
        let (jumps, sizes) = values.split_at(switching.kinks.len());
        format!("[[{}], [{}]]", jumps.join(", "), sizes.join(", "))
    });
    format!(
        "fn jumps_at(&self, t: {scalar}, q: &{vector}, v: &{vector}, u: &{inputs}) -> [[{scalar}; {kinks}]; 2] {{\n{body}\n}}\n",
        kinks = switching.kinks.len()
    )
}

/// `corners_at`, if momenta or rates of constraints have two values at a kink.
pub(super) fn corners(emission: &Emission<'_>, switching: &mut Regimes) -> String {
    if switching.corners.is_empty() {
        return String::new();
    }
    let functions: Vec<NodeId> = switching.corners.iter().map(|corner| corner.function).collect();
    let sizes = sizes(&mut switching.rows.graph, &functions);
    let roots: Vec<NodeId> = switching.corners.iter().map(|corner| corner.gain).chain(sizes).collect();
    let (scalar, vector, inputs) = (&emission.scalar, emission.vector_type(), emission.input_type());
    let body = body::plain(&switching.rows, scalar, &roots, Source::Slices, |values| {
        let (gains, sizes) = values.split_at(switching.corners.len());
        let visits = switching.corners.iter().zip(gains.iter().zip(sizes));
        let visits =
            visits.map(|(corner, (gain, size))| format!("__visit({}, {gain}, {size});", corner.kink));
        visits.collect::<Vec<String>>().join("\n")
    });
    format!(
        "fn corners_at(&self, t: {scalar}, q: &{vector}, v: &{vector}, u: &{inputs}, \
         mut __visit: impl ::core::ops::FnMut(usize, {scalar}, {scalar})) {{\n{body}\n}}\n"
    )
}

/// `breaks_at`, if gaps or constraints jump at a kink.
pub(super) fn breaks(emission: &Emission<'_>, switching: &Regimes) -> String {
    if switching.breaks.is_empty() {
        return String::new();
    }
    let (scalar, vector, inputs) = (&emission.scalar, emission.vector_type(), emission.input_type());
    let roots: Vec<NodeId> = switching.breaks.iter().map(|jump| jump.gain).collect();
    let body = body::plain(&switching.rows, scalar, &roots, Source::Slices, |gains| {
        let visits = switching.breaks.iter().zip(&gains[..]);
        let visits = visits.map(|(jump, gain)| format!("__visit({}, {}, {gain});", jump.kink, jump.row));
        visits.collect::<Vec<String>>().join("\n")
    });
    format!(
        "fn breaks_at(&self, t: {scalar}, q: &{vector}, v: &{vector}, u: &{inputs}, \
         mut __visit: impl ::core::ops::FnMut(usize, usize, {scalar})) {{\n{body}\n}}\n"
    )
}
