//! Stand-ins for the generated items after a mistake, so that the rest of a program compiles and our messages
//! are the only ones.

mod contacts;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::constraints::{self, Held};
use super::velocities::UNKNOWN;
use super::{COMPLETIONS, analysis, oriented, over, proofs, records};
use crate::syntax::body::Expr;
use crate::syntax::constant;
use crate::syntax::item::RoleKind;
use crate::syntax::types::TypeKind;
use crate::syntax::{Group, Item, Record, Scalar};

/// All items of a system that a program may use, without content, as far as declarations are known.
pub(crate) fn stubs(item: &mut Item) -> TokenStream {
    for groups in [&mut item.coordinates, &mut item.inputs] {
        keep_fields(groups);
    }
    let item = &*item;
    let unnamed = [(Record::Coordinates, &item.coordinates), (Record::Inputs, &item.inputs)];
    let unnamed = unnamed.into_iter().filter(|(_, groups)| groups.is_empty()).map(|(record, _)| record);
    let velocities = item.coordinates.is_empty().then_some(Record::Velocities);
    let aliases = unnamed.chain(velocities).map(|record| {
        // Signatures may name what is not declared.
        let name = item.record_ident(record);
        quote!(#[doc(hidden)] pub type #name<R = f64> = [R; 0];)
    });
    let aliases: TokenStream = aliases.collect();
    if item.coordinates.is_empty() {
        return aliases;
    }
    let records = records::records(item);
    let Item { self_ty, generics, crate_path, .. } = item;
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let scalar = match &item.scalar {
        Scalar::F64 => format_ident!("f64"),
        Scalar::F32 => format_ident!("f32"),
        Scalar::Generic(parameter) => parameter.clone(),
    };
    let total = |groups: &[Group]| groups.iter().map(Group::size).sum::<usize>();
    let (declared, inputs) = (total(&item.coordinates), total(&item.inputs));
    let count = declared.saturating_sub(item.eliminated());
    let held = constraints::declared(item);
    let total_held: usize = held.iter().map(|(_, length)| length.unwrap_or(1)).sum();
    let parameters = item.sensitivities.len();
    let directions = over::directions(count, parameters);
    let switches = contacts::any(item);
    let linearization = (item.jacobians && !switches).then(|| {
        let place = quote!(
            &self, _: &(), _: #scalar, _: &[#scalar; #count], _: &[#scalar; #count]
        );
        quote! {
            impl #impl_generics lagrange::Linearized<#count, #inputs> for #self_ty #where_clause {
                fn residual_at(
                    #place, _: &[#scalar; #count], _: &[#scalar; #inputs]
                ) -> [#scalar; #count] { loop {} }
                fn linearization_at(
                    #place, _: &[#scalar; #count], _: &[#scalar; #inputs]
                ) -> lagrange::Linearization<#scalar, #count> { loop {} }
                fn by_inputs_at(#place, _: &[#scalar; #inputs]) -> [[#scalar; #inputs]; #count] { loop {} }
            }

            impl #impl_generics lagrange::Tangent<#count, #inputs, #total_held> for #self_ty #where_clause {
                const HOLONOMIC: [bool; #total_held] = [false; #total_held];
                const TURNS: [bool; #total_held] = [false; #total_held];
                fn balanced_at(
                    #place, _: &[#scalar; #inputs]
                ) -> lagrange::Balance<#scalar, #count, #total_held> { loop {} }
                fn deviations_at(
                    &self, _: #scalar, _: &[#scalar; #count], _: &[#scalar; #count]
                ) -> lagrange::Residuals<#scalar, #total_held> { loop {} }
                fn imbalance_at(
                    &self, _: &(), _: &lagrange::Place<'_, #scalar, #count, #inputs, #total_held>
                ) -> lagrange::Imbalance<#scalar, #count, #total_held> { loop {} }
                fn variation_at(
                    &self, _: &(), _: &lagrange::Place<'_, #scalar, #count, #inputs, #total_held>
                ) -> lagrange::Variation<#scalar, #count, #inputs, #total_held> { loop {} }
            }

            impl #impl_generics lagrange::Parametric<#count, #inputs, #total_held, #parameters>
                for #self_ty #where_clause
            {
                fn by_parameters_at(
                    &self, _: &(), _: &lagrange::Place<'_, #scalar, #count, #inputs, #total_held>
                ) -> lagrange::ByParameters<#scalar, #count, #total_held, #parameters> { loop {} }
            }
        }
    });
    let sensitive = item.jacobians.then(|| {
        quote! {
            impl #impl_generics lagrange::Sensitive<#count, #inputs, #total_held, #parameters, #directions>
                for #self_ty #where_clause
            {
                const PARAMETERS: [&'static str; #parameters] = [""; #parameters];
                type Over<__Other: lagrange::Real> = __Over<__Other>;
                fn over<__Other: lagrange::Real>(
                    &self, _: impl ::core::ops::FnMut(#scalar, ::core::option::Option<usize>) -> __Other
                ) -> __Over<__Other> { loop {} }
            }
        }
    });
    let over = item.jacobians.then(|| {
        let over = over_any(&format_ident!("__Over"), count, inputs);
        let sizes = (count, inputs);
        // Lanes of motions need series.
        let smooth =
            (!switches).then(|| smooth(&quote!(<R: lagrange::Real>), &quote!(__Over<R>), &quote!(R), sizes));
        quote!(#over #smooth)
    });
    let reactions = (!held.is_empty()).then(|| constraints::record(item, &held));
    let constrained = (!held.is_empty()).then(|| {
        let record = constraints::record_ident(item);
        quote! {
            impl #impl_generics lagrange::Constrained<#count, #inputs> for #self_ty #where_clause {
                type Reactions = #record<#scalar>;
                fn reactions_at(
                    &self, _: &(), _: #scalar, _: &[#scalar; #count], _: &[#scalar; #count], _: &[#scalar; #inputs]
                ) -> lagrange::Reactions<#record<#scalar>> { loop {} }
            }
        }
    });
    let method = if switches { contacts::method(&held) } else { quote!(lagrange::Jets) };
    let regimes = switches.then(|| contacts::implementations(item, &held, &quote!(#scalar), (count, inputs)));
    // With switches, fixed steps are those through switches.
    let smooth = (!switches).then(|| {
        smooth(&quote!(#impl_generics), &quote!(#self_ty #where_clause), &quote!(#scalar), (count, inputs))
    });
    let certificate = item.analysis.then(|| analysis::certificate(item, &quote!(#scalar), count, inputs));
    let (named_events, guards) = super::events::stubs(item, count);
    let proofs = proofs::proofs(item, &proofs::ALL, count, inputs);
    let mut methods = methods(item, &quote!(#scalar), count, inputs);
    methods.extend(constraint_methods(item, &held, &quote!(#scalar), count, inputs));
    methods.extend(super::velocities::stubs(item, &scalar.to_string()));
    methods.extend(analysis::stubs(item, &quote!(#scalar), count, inputs));
    let is_complete = declared == count && !item.has_orientations();
    let completions = (!is_complete).then(|| completions(item, &quote!(#scalar), count));
    let state = (item.has_orientations() && declared == count && is_free(item, oriented::METHOD))
        .then(|| oriented::stub(item, &quote!(#scalar), count));
    quote! {
        #aliases
        #records
        #reactions
        #named_events
        const _: () = {
            use #crate_path::__private as lagrange;

            #[allow(missing_docs, dead_code, clippy::all)]
            impl #impl_generics #self_ty #where_clause {
                pub const COORDINATES: [&'static str; #count] = [""; #count];
                pub const COST: lagrange::Costs = lagrange::Costs {
                    before: lagrange::Cost::new(0, 0, 0, 0, 0),
                    after: lagrange::Cost::new(0, 0, 0, 0, 0),
                };
                pub const STRUCTURE: lagrange::Structure =
                    lagrange::Structure { mass_matrix: "", facts: &[], skipped: &[] };
                pub const EQUATIONS: &'static str = "";
                #methods
                #completions
                #state
            }

            impl #impl_generics lagrange::System<#count, #inputs> for #self_ty #where_clause {
                type Scalar = #scalar;
                type Method = #method;
                type Constants = ();
                fn constants(&self) {}
                fn accelerations_at(
                    &self, _: &(), _: #scalar, _: &[#scalar; #count], _: &[#scalar; #count], _: &[#scalar; #inputs]
                ) -> [#scalar; #count] { loop {} }
                fn energy_at(
                    &self, _: &(), _: #scalar, _: &[#scalar; #count], _: &[#scalar; #count]
                ) -> #scalar { loop {} }
            }

            #proofs
            #guards
            #regimes
            #certificate
            #constrained
            #linearization
            #sensitive
            #over
            #smooth
        };
    }
}

/// An implementation of `Smooth` for a type.
fn smooth(
    generics: &TokenStream,
    ty: &TokenStream,
    scalar: &TokenStream,
    (count, inputs): (usize, usize),
) -> TokenStream {
    quote! {
        impl #generics lagrange::Smooth<#count, #inputs> for #ty {
            type JetConstants = ();
            type Tables<const ORDERS: usize> = ();
            fn jet_constants(&self) {}
            fn jet_at<const ORDERS: usize>(
                &self, _: &(), _: #scalar, _: &[#scalar; #count], _: &[#scalar; #count], _: &[#scalar; #inputs],
                _: #scalar, _: usize, _: &mut (), _: &mut lagrange::Series<#scalar, #count, ORDERS>
            ) -> bool { loop {} }
        }
    }
}

/// A system over any scalar.
fn over_any(name: &Ident, count: usize, inputs: usize) -> TokenStream {
    quote! {
        #[doc(hidden)]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        pub struct #name<R>([R; 0]);

        impl<R: lagrange::Real> lagrange::System<#count, #inputs> for #name<R> {
            type Scalar = R;
            type Method = lagrange::Dop853;
            type Constants = ();
            fn constants(&self) {}
            fn accelerations_at(
                &self, _: &(), _: R, _: &[R; #count], _: &[R; #count], _: &[R; #inputs]
            ) -> [R; #count] { loop {} }
            fn energy_at(&self, _: &(), _: R, _: &[R; #count], _: &[R; #count]) -> R { loop {} }
        }
    }
}

/// Removes groups whose names cannot be fields of a struct, or are those of earlier groups.
fn keep_fields(groups: &mut Vec<Group>) {
    let mut names: Vec<String> = Vec::new();
    groups.retain(|group| {
        let name = group.ident.to_string();
        let is_field = syn::parse_str::<syn::Ident>(&name).is_ok() && !names.contains(&name);
        names.push(name);
        is_field
    });
}

/// The inherent methods, without those whose names the user has taken.
fn methods(item: &Item, scalar: &TokenStream, count: usize, inputs: usize) -> TokenStream {
    let given = (inputs > 0).then(|| quote!(, _: &[#scalar; #inputs]));
    let none = None;
    let vector = quote!([#scalar; #count]);
    let matrix = quote!(lagrange::nalgebra::SMatrix<#scalar, #count, #count>);
    let result = quote!(::core::result::Result<#vector, lagrange::MotionError<#scalar>>);
    [
        ("accelerations", &given, &result),
        ("applied_forces", &given, &vector),
        ("power", &given, scalar),
        ("mass_matrix", &none, &matrix),
        ("bias", &none, &vector),
        ("momenta", &none, &vector),
        ("kinetic_energy", &none, scalar),
        ("potential_energy", &none, scalar),
        ("energy", &none, scalar),
        ("jacobi_integral", &none, scalar),
    ]
    .into_iter()
    .filter(|(name, ..)| is_free(item, name))
    .map(|(name, inputs, output)| {
        let name = format_ident!("{name}");
        quote!(pub fn #name(&self, _: &lagrange::State<#scalar, #count> #inputs) -> #output { loop {} })
    })
    .collect()
}

/// The methods that give all declared coordinates and velocities of a state.
fn completions(item: &Item, scalar: &TokenStream, count: usize) -> TokenStream {
    COMPLETIONS
        .into_iter()
        .zip([Record::Coordinates, Record::Velocities])
        .filter(|(name, _)| is_free(item, name))
        .map(|(name, record)| {
            let (name, record) = (format_ident!("{name}"), item.record_ident(record));
            quote!(pub fn #name(&self, _: &lagrange::State<#scalar, #count>) -> #record<#scalar> { loop {} })
        })
        .collect()
}

/// Whether no function of the user has this name.
fn is_free(item: &Item, name: &str) -> bool {
    item.functions.iter().all(|function| *function.name != *name)
}

/// The methods of a system with constraints.
fn constraint_methods(
    item: &Item,
    held: &[Held],
    scalar: &TokenStream,
    count: usize,
    inputs: usize,
) -> TokenStream {
    if held.is_empty() {
        return TokenStream::new();
    }
    let total: usize = held.iter().map(|(_, length)| length.unwrap_or(1)).sum();
    let record = constraints::record_ident(item);
    let given = (inputs > 0).then(|| quote!(, _: &[#scalar; #inputs]));
    let none = None;
    let state = quote!(lagrange::State<#scalar, #count>);
    let result = |ty: TokenStream| quote!(::core::result::Result<#ty, lagrange::MotionError<#scalar>>);
    let each = quote!([#scalar; #total]);
    let methods = [
        ("reactions", &given, result(quote!(lagrange::Reactions<#record<#scalar>>))),
        ("reaction_forces", &given, result(quote!(#record<[#scalar; #count]>))),
        ("reaction_power", &given, result(scalar.clone())),
        ("energy_rate", &given, result(scalar.clone())),
        ("constraint_residuals", &none, each.clone()),
        ("constraint_rates", &none, each),
        ("constraint_jacobian", &none, quote!(lagrange::nalgebra::SMatrix<#scalar, #total, #count>)),
    ];
    let is_free = |name: &str| item.functions.iter().all(|function| *function.name != *name);
    let methods = methods.into_iter().filter(|(name, ..)| is_free(name)).map(|(name, inputs, output)| {
        let name = format_ident!("{name}");
        quote!(pub fn #name(&self, _: &#state #inputs) -> #output { loop {} })
    });
    // Whether a constraint acts on a particle or body is unknown.
    let on_places = item.functions.iter().filter_map(|function| {
        if !matches!(function.meant(), Some(RoleKind::Point { .. } | RoleKind::Body { .. })) {
            return None;
        }
        let known = function.output.as_ref().and_then(|output| force_on(item, &output.kind, scalar));
        let force = known.unwrap_or_else(|| quote!(lagrange::nalgebra::SVector<#scalar, #UNKNOWN>));
        let (name, result) =
            (format_ident!("{}{}", constraints::PREFIX, &*function.name), result(quote!(#record<#force>)));
        Some(quote!(pub fn #name(&self, _: &#state #given) -> #result { loop {} }))
    });
    let consistent = is_free("consistent").then(|| {
        let result = result(state.clone());
        quote!(pub fn consistent(&self, state: #state) -> #result { loop {} })
    });
    quote! {
        pub const CONSTRAINTS: [&'static str; #total] = [""; #total];
        #(#methods)*
        #(#on_places)*
        #consistent
    }
}

/// The type of the force on the particles or bodies that a function returns.
fn force_on(item: &Item, kind: &TypeKind, scalar: &TokenStream) -> Option<TokenStream> {
    let length = |length: &Expr| {
        constant::integer(length, &item.constants).and_then(|length| usize::try_from(length).ok())
    };
    let dimension = match kind {
        TypeKind::Array(element, count) => {
            let (element, count) = (force_on(item, &element.kind, scalar)?, length(count)?);
            return Some(quote!([#element; #count]));
        }
        TypeKind::Tuple(parts) => return force_on(item, &parts.first()?.kind, scalar),
        TypeKind::Scalar => 1,
        TypeKind::Vector(dimension) => length(dimension)?,
        TypeKind::Point(dimension) | TypeKind::Isometry(dimension) => *dimension,
        _ => return None,
    };
    Some(quote!(lagrange::nalgebra::SVector<#scalar, #dimension>))
}
