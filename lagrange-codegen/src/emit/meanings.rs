//! Checks of meanings by rustc: the macro assumes what names usually mean, and the compiler knows.

use proc_macro2::TokenStream;
use quote::quote;

use super::tokens::respan;
use crate::diagnostics::Diagnostics;
use crate::model::Model;
use crate::syntax::{Group, Item};

/// A function that is never called and compiles only if names mean what the macro assumes. A difference is
/// reported where the user wrote the name.
pub(super) fn meanings(item: &Item, model: &Model, diagnostics: &Diagnostics) -> TokenStream {
    // `name @ _` does not compile if a constant or a unit struct has the name, which a local variable of
    // generated code may not have. Names with capitals are not checked: one that is all capitals is written
    // small there.
    let small = |group: &&Group| !group.name().contains(char::is_uppercase);
    let groups = item.coordinates.iter().chain(&item.inputs).filter(small);
    let declared = groups.map(|Group { ident, .. }| quote!(let #ident @ _ = ();));
    let read = model.meanings.iter().map(|meaning| {
        let tokens: TokenStream = meaning.statement.parse().unwrap_or_default();
        respan(tokens, diagnostics.span(meaning.origin))
    });
    let statements: TokenStream = declared.chain(read).collect();
    quote! {
        #[doc(hidden)]
        #[allow(unused, unused_qualifications, unused_results, non_snake_case, non_upper_case_globals)]
        fn __meanings() { #statements }
    }
}
