//! Stand-ins for the regimes of a system with contacts or friction.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::{Held, constraints, over_any};
use crate::emit::steps;
use crate::syntax::Item;
use crate::syntax::item::RoleKind;

/// Whether any function is a contact or a friction.
pub(super) fn any(item: &Item) -> bool {
    let switches = |kind: &RoleKind| matches!(kind, RoleKind::Unilateral { .. } | RoleKind::Friction(_));
    item.functions.iter().any(|function| function.meant().is_some_and(switches))
}

/// The integrator. The number of kinks is unknown.
pub(super) fn method(held: &[Held]) -> TokenStream {
    let rows = rows(held);
    quote!(lagrange::Hybrid<lagrange::Dop853, #rows, 0>)
}

/// The implementations that methods of motions need.
pub(super) fn implementations(
    item: &Item,
    held: &[Held],
    scalar: &TokenStream,
    (count, inputs): (usize, usize),
) -> TokenStream {
    let Item { self_ty, generics, .. } = item;
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let (rows, record, name) = (rows(held), constraints::record_ident(item), format_ident!("__InRegime"));
    let in_regime = over_any(&name, count, inputs);
    let steps = steps::stub(item, (count, inputs));
    quote! {
        #in_regime

        #steps

        impl #impl_generics lagrange::Switching<#count, #inputs, #rows, 0> for #self_ty #where_clause {
            type InRegime = #name<#scalar>;
            const ROWS: [lagrange::Row; #rows] = [lagrange::Row::Bilateral; #rows];
            fn in_regime(&self, _: &lagrange::Regime<#scalar, #rows, 0>) -> Self::InRegime { loop {} }
            fn laws_at(
                &self, _: #scalar, _: &[#scalar; #count], _: &[#scalar; #count], _: &[#scalar; #inputs]
            ) -> lagrange::Laws<#scalar, #rows, 0> { loop {} }
            fn functions_in<__Number: lagrange::Real>(
                _: &Self::InRegime, _: impl ::core::ops::Fn(#scalar) -> __Number,
                _: __Number, _: &[__Number; #count], _: &[__Number; #count], _: &[__Number; #inputs],
                _: &lagrange::Wanted<#rows, 0>
            ) -> lagrange::Functions<__Number, #rows, 0> { loop {} }
        }

        impl #impl_generics lagrange::NamedRows<#rows> for #self_ty #where_clause {
            type Rows<__Row> = #record<__Row>;
        }
    }
}

fn rows(held: &[Held]) -> usize {
    held.iter().map(|(_, length)| length.unwrap_or(1)).sum()
}
