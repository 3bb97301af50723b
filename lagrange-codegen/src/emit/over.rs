//! The same equations over any scalar, with numbers of it for the user's parameters: what a motion with
//! derivatives runs on.
//!
//! The code is that of the system, with a type parameter for the scalar. The user's expressions are evaluated
//! once, where such a system is made.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::body::{self, Source};
use super::tokens::{Parameters, placeholder};
use super::{Emission, constraints, jets, methods, proofs, system};
use crate::syntax::Scalar;

/// The struct, which no one names.
pub(super) const NAME: &str = "__Over";

/// The type parameter of the conversion: no user's generics have its name.
const OTHER: &str = "__Other";

/// Directions that a motion carries at once, at most: more of them share less of the work on the values,
/// since one value serves eight already, and the tables of their series leave the caches.
const AT_ONCE: usize = 8;

/// In how many directions at once a system is differentiated, so that all passes are alike.
pub(super) fn directions(count: usize, parameters: usize) -> usize {
    let all = 2 * count + parameters;
    all.div_ceil(all.div_ceil(AT_ONCE).max(1))
}

/// The struct with its implementations.
pub(super) fn over(emission: &mut Emission<'_>) -> TokenStream {
    let own = emission.scalar.clone();
    let scalar = match &own {
        Scalar::Generic(ident) => ident.clone(),
        Scalar::F64 | Scalar::F32 => format_ident!("R"),
    };
    emission.scalar = Scalar::Generic(scalar);
    let method = emission.method.take();
    let items = numbers(emission, NAME, constraints::implementations);
    (emission.scalar, emission.method) = (own, method);
    items
}

/// A struct of numbers for all parameters, with the implementations of the system. `constrained` gives the
/// items of `Constrained`, none if that is not implemented.
pub(super) fn numbers(
    emission: &mut Emission<'_>,
    name: &str,
    constrained: impl Fn(&Emission<'_>) -> String,
) -> TokenStream {
    let (system, surface) = match emission.solution.saddle {
        Some(method) => {
            let constraints::Implementations { system, surface, .. } = constraints::system(emission, method);
            (system, Some((surface, constrained(emission))))
        }
        None => (system::system(emission).0, None),
    };
    let smooth = emission.jets.zip(emission.orders).map(|(jets, orders)| jets::jets(emission, jets, orders));
    let mut methods = energy(emission);
    if system.contains("self.mass_matrix(") {
        methods.push_str(&methods::mass_matrix(emission));
    }

    let kept = Parameters::kept(emission.model);
    let (count, inputs) = (emission.count(), emission.model.inputs.len());
    let (held, parameters) = (emission.equations.conditions.count(), emission.model.parameters.len());
    let name = format_ident!("{name}");
    let (generics, short, scalar) = match &emission.scalar {
        Scalar::Generic(scalar) => (quote!(<#scalar: lagrange::Real>), quote!(<#scalar>), scalar.clone()),
        Scalar::F64 => (quote!(), quote!(), format_ident!("f64")),
        Scalar::F32 => (quote!(), quote!(), format_ident!("f32")),
    };
    let itself = quote!(#name #short);
    let implementation = |name: TokenStream, items: &str| {
        let items = kept.parse(items);
        quote! {
            #[automatically_derived]
            #[allow(clippy::all)]
            impl #generics #name #itself {
                #items
            }
        }
    };
    let methods = implementation(TokenStream::new(), &methods);
    let system = implementation(quote!(lagrange::System<#count, #inputs> for), &system);
    let surface = surface.map(|(surface, constrained)| {
        let surface = implementation(quote!(lagrange::Surface<#count, #inputs, #held> for), &surface);
        let constrained = (!constrained.is_empty())
            .then(|| implementation(quote!(lagrange::Constrained<#count, #inputs> for), &constrained));
        quote!(#surface #constrained)
    });
    let smooth = smooth.map(|items| implementation(quote!(lagrange::Smooth<#count, #inputs> for), &items));
    let proofs = proofs::proved(emission.facts).into_iter().map(|name| {
        let name = format_ident!("{name}");
        quote!(impl #generics lagrange::#name<#count, #inputs> for #itself {})
    });
    quote! {
        #[doc(hidden)]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        pub struct #name #short {
            parameters: [#scalar; #parameters],
        }

        #methods
        #system
        #surface
        #smooth
        #(#proofs)*
    }
}

/// The items of `Sensitive` that make one from the user's system.
pub(super) fn conversion(emission: &Emission<'_>) -> String {
    let model = &*emission.model;
    let (mut values, mut numbers) = (String::new(), Vec::new());
    for (index, name) in (0_u32..).zip(&model.locals.parameters) {
        values.push_str(&format!("let {name}: {} = {};\n", emission.scalar, placeholder(index)));
        let listed = match model.sensitivities.iter().position(|&listed| listed == index) {
            Some(place) => format!("::core::option::Option::Some({place})"),
            None => "::core::option::Option::None".to_owned(),
        };
        numbers.push(format!("__parameter({name}, {listed})"));
    }
    format!(
        "type Over<{OTHER}: lagrange::Real> = {NAME}<{OTHER}>;\n\
         fn over<{OTHER}: lagrange::Real>(&self, mut __parameter: impl ::core::ops::FnMut({}, ::core::option::Option<usize>) -> {OTHER}) \
         -> {NAME}<{OTHER}> {{\n{values}{NAME} {{ parameters: [{}] }}\n}}\n",
        emission.scalar,
        numbers.join(", ")
    )
}

/// What `energy_at` calls.
fn energy(emission: &Emission<'_>) -> String {
    let equations = emission.equations;
    let nodes = if emission.model.lagrangian.is_empty() {
        vec![equations.kinetic_energy, equations.potential_energy]
    } else {
        vec![equations.energy]
    };
    let body =
        body::plain(emission.model, &emission.scalar, &nodes, Source::State, |values| values.join(" + "));
    let (state, scalar) = (emission.state_type(), &emission.scalar);
    format!("#[inline]\nfn energy(&self, state: &{state}) -> {scalar} {{\n{body}\n}}\n")
}
