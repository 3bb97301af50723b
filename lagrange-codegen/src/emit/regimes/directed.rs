//! Coefficients of friction that depend on the direction of the slip or on the sides of kinks.

use quote::format_ident;

use super::super::Emission;
use super::super::body::{self, Source};
use super::NUMBER;
use crate::expr::NodeId;
use crate::regimes::Regimes;
use crate::syntax::Scalar;

/// `coefficients_in`, if a law depends on the direction of a slip or has kinks.
pub(super) fn coefficients(emission: &Emission<'_>, switching: &Regimes) -> String {
    let Some(coefficients) = &switching.coefficients else { return String::new() };
    let (scalar, vector, inputs) = (&emission.scalar, emission.vector_type(), emission.input_type());
    let (rows, kinks) = (switching.rows(), switching.kinks.len());
    let lists = coefficients.iter().flat_map(|coefficients| [&coefficients.kinetic, &coefficients.fixed]);
    let roots: Vec<NodeId> = lists.flatten().copied().collect();
    let body = body::plain(&switching.model, scalar, &roots, Source::Numbers, |values| {
        let mut lists = values.chunks(rows).map(|values| values.join(", "));
        let mut coefficients = || {
            let [kinetic, fixed] = [(); 2].map(|()| lists.next().unwrap_or_default());
            format!("lagrange::Coefficients {{ kinetic: [{kinetic}], fixed: [{fixed}] }}")
        };
        format!("[{}, {}]", coefficients(), coefficients())
    });
    format!(
        "fn coefficients_in(__in_regime: &Self::InRegime, \
         t: {scalar}, q: &{vector}, v: &{vector}, u: &{inputs}, \
         _: &lagrange::Laws<{scalar}, {rows}, {kinks}>) \
         -> [lagrange::Coefficients<{scalar}, {rows}>; 2] {{\n\
         let __number = ::core::convert::identity::<{scalar}>;\n{body}\n}}\n"
    )
}

/// `backward_in`, if a law depends on the direction of a slip.
pub(super) fn backward(emission: &Emission<'_>, switching: &Regimes) -> String {
    if !switching.is_directed {
        return String::new();
    }
    let numbers = Scalar::Generic(format_ident!("{NUMBER}"));
    let [_, backward] = &switching.guards.fixed;
    let body = body::plain(&switching.model, &numbers, backward, Source::Numbers, |values| {
        format!("::core::option::Option::Some([{}])", values.join(", "))
    });
    let (scalar, count, given) = (&emission.scalar, emission.count(), emission.model.inputs.len());
    format!(
        "fn backward_in<{NUMBER}: lagrange::Real>(\n__in_regime: &Self::InRegime, \
         __number: impl ::core::ops::Fn({scalar}) -> {NUMBER}, \
         t: {NUMBER}, q: &[{NUMBER}; {count}], v: &[{NUMBER}; {count}], u: &[{NUMBER}; {given}],\n) \
         -> ::core::option::Option<[{NUMBER}; {rows}]> {{\n{body}\n}}\n",
        rows = switching.rows()
    )
}
