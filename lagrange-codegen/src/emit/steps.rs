//! Fixed steps of a system whose equations switch: those of the runtime's `Hybrid`, under the name `Jet`.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::parse_quote;

use super::Emission;
use crate::regimes::Regimes;
use crate::syntax::{Item, Scalar};

/// The parts of the implementation.
struct Steps {
    memory: TokenStream,
    begin: TokenStream,
    step: TokenStream,
}

/// The implementation of `FixedStep` for `Jet`, if the regimes have series.
pub(super) fn steps(emission: &Emission<'_>, switching: &Regimes) -> Option<TokenStream> {
    switching.jets.as_ref()?;
    let itself = &emission.item.self_ty;
    let (count, inputs) = (emission.count(), emission.model.inputs.len());
    let (rows, kinks) = (switching.rows(), switching.kinks.len());
    let hybrid =
        quote!(<lagrange::Hybrid<Self, #rows, #kinks> as lagrange::FixedStep<#itself, #count, #inputs>>);
    let steps = Steps {
        memory: quote!(#hybrid::Memory),
        begin: quote!(#hybrid::begin(__system)),
        step: quote!(#hybrid::step(__memory, __system, __constants, __from, __length, __inputs)),
    };
    Some(implementation(emission.item, &emission.scalar, (count, inputs), &steps))
}

/// A stand-in while a description is incomplete.
pub(super) fn stub(item: &Item, sizes: (usize, usize)) -> TokenStream {
    let steps = Steps { memory: quote!(()), begin: quote!(), step: quote!(loop {}) };
    implementation(item, &item.scalar, sizes, &steps)
}

fn implementation(
    item: &Item,
    scalar: &Scalar,
    (count, inputs): (usize, usize),
    Steps { memory, begin, step }: &Steps,
) -> TokenStream {
    let mut generics = item.generics.clone();
    generics.params.push(parse_quote!(const __ORDER: usize));
    // To tell which of two guards comes first, numbers need an order.
    if let Scalar::Generic(number) = scalar {
        generics.make_where_clause().predicates.push(parse_quote!(#number: lagrange::Ordered));
    }
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let (itself, scalar) = (&item.self_ty, format_ident!("{}", scalar.to_string()));
    quote! {
        #[automatically_derived]
        #[allow(clippy::all)]
        impl #impl_generics lagrange::FixedStep<#itself, #count, #inputs> for lagrange::Jet<__ORDER> #where_clause {
            type Memory = #memory;
            const SWITCHES: bool = true;
            fn begin(__system: &#itself) -> Self::Memory { #begin }
            fn step(
                __memory: &mut Self::Memory,
                __system: &#itself,
                __constants: &<#itself as lagrange::System<#count, #inputs>>::Constants,
                __from: &lagrange::State<#scalar, #count>,
                __length: #scalar,
                __inputs: &[#scalar; #inputs],
            ) -> ::core::result::Result<lagrange::State<#scalar, #count>, lagrange::Cause> { #step }
        }
    }
}
