//! Fixed steps of a system whose equations switch: those of the runtime's `Hybrid`, by the name of `Jet`.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::parse_quote;

use super::Emission;
use crate::regimes::Regimes;
use crate::syntax::Scalar;

/// The implementation of `FixedStep` for `Jet`, where the regimes have series.
pub(super) fn steps(emission: &Emission<'_>, switching: &Regimes) -> Option<TokenStream> {
    switching.jets.as_ref()?;
    let mut generics = emission.item.generics.clone();
    generics.params.push(parse_quote!(const __ORDER: usize));
    // Which of two guards is first only a number with an order tells.
    if let Scalar::Generic(number) = &emission.scalar {
        generics.make_where_clause().predicates.push(parse_quote!(#number: lagrange::Ordered));
    }
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let (itself, scalar) = (&emission.item.self_ty, format_ident!("{}", emission.scalar.to_string()));
    let (count, inputs) = (emission.count(), emission.model.inputs.len());
    let (rows, kinks) = (switching.rows(), switching.kinks.len());
    let hybrid = quote!(lagrange::Hybrid<Self, #rows, #kinks>);
    Some(quote! {
        #[automatically_derived]
        #[allow(clippy::all)]
        impl #impl_generics lagrange::FixedStep<#itself, #count, #inputs> for lagrange::Jet<__ORDER> #where_clause {
            type Memory = <#hybrid as lagrange::FixedStep<#itself, #count, #inputs>>::Memory;
            const SWITCHES: bool = true;
            fn begin(__system: &#itself) -> Self::Memory {
                <#hybrid as lagrange::FixedStep<#itself, #count, #inputs>>::begin(__system)
            }
            fn step(
                __memory: &mut Self::Memory,
                __system: &#itself,
                __constants: &<#itself as lagrange::System<#count, #inputs>>::Constants,
                __from: &lagrange::State<#scalar, #count>,
                __length: #scalar,
                __inputs: &[#scalar; #inputs],
            ) -> ::core::result::Result<lagrange::State<#scalar, #count>, lagrange::Cause> {
                <#hybrid as lagrange::FixedStep<#itself, #count, #inputs>>::step(
                    __memory, __system, __constants, __from, __length, __inputs,
                )
            }
        }
    })
}
