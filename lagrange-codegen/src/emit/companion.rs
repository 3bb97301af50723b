//! A struct of numbers in place of a system. Motions with derivatives run on one, and each regime of a system
//! that switches is one.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::body::{self, Source};
use super::tokens::Parameters;
use super::{Emission, constraints, jets, methods, proofs, system};
use crate::syntax::Scalar;

/// The items of `System` of a system with contacts, from those that define its constants.
pub(super) type Contacts<'a> = dyn Fn(&Emission<'_>, &str) -> String + 'a;

/// The type parameter for the scalar of a system that is emitted over any scalar.
pub(super) fn any(own: &Scalar) -> Scalar {
    Scalar::Generic(match own {
        Scalar::Generic(ident) => ident.clone(),
        Scalar::F64 | Scalar::F32 => format_ident!("R"),
    })
}

/// A struct of numbers for all parameters, with the implementations of the system. `constrained` gives the
/// items of `Constrained`, an empty text if the system does not implement it.
pub(super) fn companion(
    emission: &mut Emission<'_>,
    name: &str,
    contacts: Option<&Contacts<'_>>,
    constrained: impl Fn(&Emission<'_>) -> String,
) -> TokenStream {
    let (system, constants, surface, parts) = match emission.solution.saddle {
        Some(method) => {
            let all = constraints::system(emission, method);
            (all.system, all.constants, Some((all.surface, constrained(emission))), all.parts)
        }
        None => (system::system(emission).0, system::NO_CONSTANTS.to_owned(), None, String::new()),
    };
    let system = contacts.map_or(system, |contacts| contacts(emission, &constants));
    let smooth = emission.jets.zip(emission.orders).filter(|_| contacts.is_none());
    let smooth = smooth.map(|(jets, orders)| jets::jets(emission, jets, orders));
    let mut methods = energy(emission) + &parts;
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
    let proved = if contacts.is_some() { Vec::new() } else { proofs::proved(emission.facts) };
    let proofs = proved.into_iter().map(|name| {
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

/// The energy that `energy_at` calls.
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
