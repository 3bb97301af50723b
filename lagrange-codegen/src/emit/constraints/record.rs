//! The struct with a field for each constraint.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::model::Constraint;
use crate::syntax::Item;

/// `…Reactions`.
pub(in crate::emit) fn record_ident(item: &Item) -> Ident {
    format_ident!("{}Reactions", item.name)
}

/// One value of a type `T` for each constraint, with the conversions from and to an array of all.
pub(in crate::emit) fn record(item: &Item, constraints: &[Constraint]) -> TokenStream {
    let name = record_ident(item);
    let shown = name.to_string();
    let doc = format!("One value for each constraint of [`{}`].", item.name);
    let (mut fields, mut patterns, mut flat, mut debug) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut left = constraints;
    while let Some(first) = left.first() {
        let length = left.iter().take_while(|constraint| constraint.name == first.name).count();
        let (group, rest) = left.split_at(length);
        left = rest;
        let parts: Vec<_> = (0..length).map(|i| format_ident!("x{}", flat.len() + i)).collect();
        let (ident, label) = (format_ident!("{}", first.name), &first.name);
        let field_doc = format!("`{label}`");
        if group.iter().all(|constraint| constraint.index.is_some()) {
            fields.push(quote!(#[doc = #field_doc] pub #ident: [T; #length]));
            patterns.push(quote!(#ident: [#(#parts),*]));
        } else {
            fields.push(quote!(#[doc = #field_doc] pub #ident: T));
            patterns.push(quote!(#ident: #(#parts)*));
        }
        debug.push(quote!(.field(#label, &self.#ident)));
        flat.extend(parts);
    }
    let count = flat.len();
    quote! {
        #[doc = #doc]
        #[allow(non_snake_case)]
        pub struct #name<T = f64> { #(#fields),* }

        impl<T: ::core::marker::Copy> ::core::marker::Copy for #name<T> {}

        impl<T: ::core::marker::Copy> ::core::clone::Clone for #name<T> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<T: ::core::fmt::Debug> ::core::fmt::Debug for #name<T> {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.debug_struct(#shown)#(#debug)*.finish()
            }
        }

        impl<T> ::core::convert::From<[T; #count]> for #name<T> {
            fn from([#(#flat),*]: [T; #count]) -> Self {
                Self { #(#patterns),* }
            }
        }

        impl<T> ::core::convert::From<#name<T>> for [T; #count] {
            fn from(#name { #(#patterns),* }: #name<T>) -> Self {
                [#(#flat),*]
            }
        }
    }
}
