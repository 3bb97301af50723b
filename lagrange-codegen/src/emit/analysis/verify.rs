//! The certificate: the implementation of the runtime's `Verifiable`, and the test that the attribute's
//! `verify` adds.

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{format_ident, quote};

use crate::emit::body::{self, Source};
use crate::emit::methods::{arguments, method};
use crate::emit::{COMPLETIONS, Emission, scalar};
use crate::expr::NodeId;
use crate::mechanics::analysis::Balance;
use crate::model::{Attitude, ConstraintKind, Term};
use crate::simplify::simplify;
use crate::syntax::item::Argument;
use crate::syntax::{Record, Scalar};

/// `verify` and `verify_at`.
pub(super) fn methods(emission: &Emission<'_>) -> String {
    let result = "::core::result::Result<lagrange::Certificate, lagrange::Violation>";
    let (count, given) = (emission.count(), emission.model.inputs.len());
    let first = method(
        "Checks identities of this model at sampled states: the mass matrix is positive, Ṁ − 2C is skew, the accelerations satisfy \
         Lagrange's equations, the power balance holds, conserved quantities stay, gradients of constraints are their \
         derivatives, and the energies are those of the described functions. Coordinates and velocities are between −1 and 1: \
         where the scales of the motion are far from one, `verify_at` takes states of your own.\n\n# Errors\n\nThe first identity that does not hold, and by how much.",
        &format!("verify(&self) -> {result}"),
        &format!("lagrange::verify::verify::<Self, {count}, {given}>(self)"),
    );
    let second = method(
        "Checks the identities of `verify` at given states, moved onto the constraints if there are any.\n\n# Errors\n\n\
         The first identity that does not hold, and by how much.",
        &format!("verify_at(&self, states: &[{}]) -> {result}", emission.state_type()),
        &format!("lagrange::verify::verify_at::<Self, {count}, {given}>(self, states)"),
    );
    first + &second
}

/// The items of `Verifiable` as text.
pub(in crate::emit) fn implementation(emission: &mut Emission<'_>, affine: bool, conserved: usize) -> String {
    let (scalar, count) = (emission.scalar.to_string(), emission.count());
    let held = emission.equations.conditions.count();
    let place = format!("&self, state: &{}", emission.state_type());
    let driven = format!("{place}, u: &{}", emission.input_type());
    let (vector, matrix) = (emission.vector_type(), format!("[[{scalar}; {count}]; {count}]"));
    let option = |ty: &str| format!("::core::option::Option<{ty}>");
    let zero = scalar::zero(&emission.scalar);
    let nearest =
        if held > 0 { "self.consistent(*state).ok()" } else { "::core::option::Option::Some(*state)" };
    let coriolis = if affine {
        "::core::option::Option::Some(self.coriolis_matrix(state).data.0)"
    } else {
        "::core::option::Option::None"
    };
    let integral = if emission.equations.jacobi_integral.is_some() { "jacobi_integral" } else { "energy" };
    let (residual, gradient) = if held > 0 {
        (
            format!("self.constraint_residuals(state).get(constraint).copied().unwrap_or({zero})"),
            format!(
                "self.constraint_jacobian(state).data.0.map(|column| \
                 column.get(constraint).copied().unwrap_or({zero}))"
            ),
        )
    } else {
        (zero.clone(), format!("[{zero}; {count}]"))
    };
    let holonomic: Vec<String> = emission
        .model
        .constraints
        .iter()
        .map(|constraint| (constraint.kind == ConstraintKind::Holonomic).to_string())
        .collect();
    let energies = if emission.model.lagrangian.is_empty() {
        "::core::option::Option::Some([self.kinetic_energy(state), self.potential_energy(state)])"
    } else {
        "::core::option::Option::None"
    };
    let rate = rate(emission);
    let loads = loads(emission);
    let described = described(emission);
    let functions = [
        (format!("nearest_at({place}) -> {}", option(&emission.state_type())), nearest.to_owned()),
        (format!("mass_at({place}) -> {matrix}"), "self.mass_matrix(state).data.0".to_owned()),
        (format!("coriolis_at({place}) -> {}", option(&matrix)), coriolis.to_owned()),
        (format!("momenta_at({place}) -> {vector}"), "self.momenta(state)".to_owned()),
        (format!("integral_at({place}) -> {scalar}"), format!("self.{integral}(state)")),
        (format!("integral_rate_at({driven}) -> {}", option(&scalar)), rate),
        (
            format!(
                "driven_at({driven}) -> {}",
                option(&format!("lagrange::verify::Driven<{scalar}, {count}>"))
            ),
            loads,
        ),
        (
            format!("conserved_at({place}, index: usize) -> {scalar}"),
            format!("self.conserved(state).get(index).copied().unwrap_or({zero})"),
        ),
        (format!("constraint_at({place}, constraint: usize) -> {scalar}"), residual),
        (format!("gradient_at({place}, constraint: usize) -> {vector}"), gradient),
        (
            "is_holonomic(constraint: usize) -> bool".to_owned(),
            format!("<[bool]>::get(&[{}], constraint).copied().unwrap_or(false)", holonomic.join(", ")),
        ),
        (format!("energies_at({place}) -> {}", option(&format!("[{scalar}; 2]"))), energies.to_owned()),
        (
            format!("described_at({place}, time: {scalar}) -> lagrange::verify::Described<{scalar}>"),
            described,
        ),
    ];
    let mut text = format!(
        "const CONSERVED: usize = {conserved};\nconst CONSTRAINTS: usize = {held};\n\
         const DEFINITE: bool = {};\n",
        emission.equations.definite
    );
    for (signature, body) in functions {
        text.push_str(&format!("fn {signature} {{\n{}\n}}\n", body::imported(body)));
    }
    text
}

/// `, u` if a method on a state takes inputs as well.
fn inputs_of(emission: &mut Emission<'_>, nodes: &[NodeId]) -> &'static str {
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, nodes);
    if arguments(emission, &nodes).contains("inputs") { ", u" } else { "" }
}

/// The rate of the Jacobi integral, or of the energy.
fn rate(emission: &mut Emission<'_>) -> String {
    let constrained = emission.equations.conditions.count() > 0;
    let all = if emission.model.inputs.is_empty() { "" } else { ", u" };
    match (emission.equations.jacobi_integral.is_some(), constrained) {
        (true, false) => {
            let Balance { jacobi_rate, .. } = Balance::of(emission.model, emission.equations);
            let given = inputs_of(emission, &[jacobi_rate]);
            format!("::core::option::Option::Some(self.jacobi_rate(state{given}))")
        }
        (true, true) => format!("self.jacobi_rate(state{all}).ok()"),
        (false, _) => format!("self.energy_rate(state{all}).ok()"),
    }
}

/// Accelerations, and Q − ∂D/∂v + Aᵀλ.
fn loads(emission: &mut Emission<'_>) -> String {
    let equations = emission.equations;
    let (count, given, held) = (emission.count(), emission.model.inputs.len(), equations.conditions.count());
    let zero = scalar::zero(&emission.scalar);
    let applied = if equations.power.is_some() {
        let inputs = inputs_of(emission, &equations.applied);
        format!("self.applied_forces(state{inputs})")
    } else {
        format!("[{zero}; {count}]")
    };
    if held == 0 {
        let inputs = if given == 0 { "" } else { ", u" };
        return format!(
            "::core::option::Option::Some(lagrange::verify::Driven {{ \
             accelerations: self.accelerations(state{inputs}).ok()?, loads: {applied} }})"
        );
    }
    format!(
        "let constants = <Self as lagrange::System<{count}, {given}>>::constants(self);\n\
         let balance = <Self as lagrange::Surface<{count}, {given}, {held}>>::balance_at(\
         self, &constants, state.t, &state.q, &state.v, u);\n\
         let mut loads = {applied};\n\
         for (load, column) in loads.iter_mut().zip(&self.constraint_jacobian(state).data.0) {{\n\
         for (&entry, &multiplier) in column.iter().zip(&balance.multipliers) {{\n*load += entry * multiplier;\n}}\n}}\n\
         ::core::option::Option::Some(lagrange::verify::Driven {{ accelerations: balance.accelerations, loads }})"
    )
}

/// Energies from the user's own functions.
fn described(emission: &mut Emission<'_>) -> String {
    let zero_node = emission.model.graph.zero();
    let model = &*emission.model;
    let mut placed: Vec<(&str, NodeId, [NodeId; 9])> = Vec::new();
    for point in &model.points {
        placed.push((&point.name, point.mass, [zero_node; 9]));
    }
    for body in &model.bodies {
        let mut entries = [zero_node; 9];
        match &body.attitude {
            Attitude::Planar { inertia, .. } => entries[0] = *inertia,
            Attitude::Spatial { inertia, .. } => {
                entries.iter_mut().zip(inertia.iter().flatten()).for_each(|(to, &from)| *to = from);
            }
        }
        placed.push((&body.name, body.mass, entries));
    }
    let nodes: Vec<NodeId> =
        placed.iter().flat_map(|&(_, mass, inertia)| std::iter::once(mass).chain(inertia)).collect();
    let (number, count) = (emission.scalar.to_string(), emission.count());
    let zero = scalar::zero(&emission.scalar);
    body::plain(model, &emission.scalar, &nodes, Source::State, |values| {
        let weights: Vec<String> = values
            .chunks(10)
            .map(|chunk| {
                let rows: Vec<String> =
                    chunk[1..].chunks(3).map(|row| format!("[{}]", row.join(", "))).collect();
                format!("({}, [{}])", chunk[0], rows.join(", "))
            })
            .collect();
        let mut text = format!(
            "let weights: [({number}, [[{number}; 3]; 3]); {}] = [{}];\n\
             let mut described = lagrange::verify::Described {{ kinetic: {zero}, potential: {zero}, lagrangian: {zero}, \
             uncertainty: {zero} }};\n\
             let path = |shift: {number}| lagrange::State::<{number}, {count}> {{ t: state.t + shift, \
             q: ::core::array::from_fn(|i| state.q[i] + shift * state.v[i]), v: state.v }};\n",
            weights.len(),
            weights.join(", ")
        );
        for (index, (name, ..)) in placed.iter().enumerate() {
            let (function, element) = name.split_at(name.find('[').unwrap_or(name.len()));
            text.push_str(&format!(
                "let (energy, doubt) = lagrange::verify::kinetic(|shift| {{\nlet state = &path(shift);\n{}{element}\n}}, \
                 time, weights[{index}].0, weights[{index}].1);\n\
                 described.kinetic += energy;\ndescribed.uncertainty += doubt;\n",
                call(emission, function)
            ));
        }
        let terms = |terms: &[Term], field: &str| -> String {
            let add = |term: &Term| format!("described.{field} += {{\n{}\n}};\n", call(emission, &term.name));
            terms.iter().map(add).collect()
        };
        text.push_str(&terms(&model.kinetic, "kinetic"));
        text.push_str(&terms(&model.potential, "potential"));
        text.push_str(&terms(&model.lagrangian, "lagrangian"));
        text + "described"
    })
}

/// A call of a function of the user at `state`.
fn call(emission: &Emission<'_>, name: &str) -> String {
    let item = emission.item;
    let Some(function) = item.functions.iter().find(|function| *function.name == *name) else {
        return String::new();
    };
    let mut text = String::new();
    let mut arguments = Vec::new();
    let is_complete = emission.is_state_complete();
    for parameter in &function.parameters {
        match parameter.argument {
            Some(Argument::Time) => arguments.push("state.t".to_owned()),
            Some(Argument::Record(record)) => {
                let (local, field, completion) = match record {
                    Record::Velocities => ("velocities", "v", COMPLETIONS[1]),
                    Record::Coordinates | Record::Inputs => ("coordinates", "q", COMPLETIONS[0]),
                };
                let value = if is_complete {
                    let (ident, scalar) = (item.record_ident(record), &item.scalar);
                    format!("<{ident}<{scalar}> as ::core::convert::From<_>>::from(state.{field})")
                } else {
                    format!("self.{completion}(state)")
                };
                text.push_str(&format!("let {local} = {value};\n"));
                arguments.push(format!("lagrange::verify::given(&{local})"));
            }
            None => {}
        }
    }
    let raw = if syn::parse_str::<Ident>(name).is_ok() { "" } else { "r#" };
    format!("{text}self.{raw}{name}({})", arguments.join(", "))
}

/// The test that the attribute's `verify` adds.
pub(in crate::emit) fn test(emission: &Emission<'_>) -> Option<TokenStream> {
    let item = emission.item;
    let example = item.verify.as_ref()?;
    let name = snake_case(&item.name.to_string());
    let name = format_ident!("{name}_satisfies_its_identities");
    let (self_ty, generics) = (&item.self_ty, &item.generics);
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let concrete = match &item.scalar {
        Scalar::F64 | Scalar::F32 => quote!(#self_ty),
        Scalar::Generic(parameter) => replaced(quote!(#self_ty), parameter),
    };
    Some(quote! {
        #[cfg(test)]
        impl #impl_generics #self_ty #where_clause {
            #[doc(hidden)]
            fn __verified() -> Self {
                #example
            }
        }

        #[cfg(test)]
        #[test]
        #[allow(unnameable_test_items)]
        fn #name() {
            if let ::core::result::Result::Err(violation) = <#concrete>::__verified().verify() {
                ::core::panic!("{violation}");
            }
        }
    })
}

/// A type with `f64` for the type parameter of its scalar.
fn replaced(tokens: TokenStream, parameter: &Ident) -> TokenStream {
    tokens
        .into_iter()
        .map(|token| match token {
            TokenTree::Ident(ident) if ident == *parameter => {
                TokenTree::Ident(Ident::new("f64", ident.span()))
            }
            TokenTree::Group(group) => TokenTree::Group(proc_macro2::Group::new(
                group.delimiter(),
                replaced(group.stream(), parameter),
            )),
            other => other,
        })
        .collect()
}

fn snake_case(name: &str) -> String {
    let mut text = String::new();
    for (index, c) in name.chars().enumerate() {
        if c.is_uppercase() && index > 0 {
            text.push('_');
        }
        text.extend(c.to_lowercase());
    }
    text
}
