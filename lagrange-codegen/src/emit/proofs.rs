//! Facts about a system as traits that an integrator may demand.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::structure::Facts;
use crate::syntax::Item;

/// All traits of the runtime's module `proved`.
pub(super) const ALL: [&str; 7] =
    ["ConstantMass", "Separable", "Autonomous", "Conservative", "Holonomic", "Scleronomic", "Cyclic"];

/// The traits whose property follows from the equations.
pub(super) fn proved(facts: &Facts) -> Vec<&'static str> {
    let holds = [
        facts.constant_mass,
        facts.separable,
        facts.autonomous,
        facts.conserves(),
        facts.holonomic,
        facts.scleronomic,
        !facts.cyclic.is_empty(),
    ];
    ALL.into_iter().zip(holds).filter_map(|(name, holds)| holds.then_some(name)).collect()
}

/// The implementations of the traits.
pub(super) fn proofs(item: &Item, proved: &[&str], count: usize, inputs: usize) -> TokenStream {
    let Item { self_ty, generics, .. } = item;
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    proved
        .iter()
        .map(|name| {
            let name = format_ident!("{name}");
            quote!(impl #impl_generics lagrange::#name<#count, #inputs> for #self_ty #where_clause {})
        })
        .collect()
}
