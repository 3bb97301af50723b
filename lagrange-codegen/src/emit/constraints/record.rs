//! The struct with a field for each constraint.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::model::Constraint;
use crate::regimes::LOAD;
use crate::syntax::Item;

/// `…Reactions`.
pub(in crate::emit) fn record_ident(item: &Item) -> Ident {
    format_ident!("{}Reactions", item.name)
}

/// A constraint function's name, and the number of its constraints if it returns an array.
pub(in crate::emit) type Held = (String, Option<usize>);

/// The constraint functions of a model.
pub(in crate::emit) fn held(constraints: &[Constraint]) -> Vec<Held> {
    let mut held: Vec<Held> = Vec::new();
    for constraint in constraints {
        match held.last_mut() {
            Some((name, Some(length))) if *name == constraint.name => *length += 1,
            _ => held.push((constraint.name.clone(), constraint.index.map(|_| 1))),
        }
    }
    held
}

/// The constraint functions, as far as declarations are known.
pub(in crate::emit) fn declared(item: &Item) -> Vec<Held> {
    let constraints = item.functions.iter().filter(|function| item.has_multiplier(function));
    constraints.map(|function| (function.name.to_string(), item.components(function))).collect()
}

/// One value of a type `T` for each constraint, with the conversions from and to an array of all.
pub(in crate::emit) fn record(item: &Item, held: &[Held]) -> TokenStream {
    let name = record_ident(item);
    let shown = name.to_string();
    let doc = format!("One value for each constraint of [`{}`].", item.title);
    let (mut fields, mut patterns, mut flat, mut debug) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (label, length) in held {
        let parts: Vec<_> = (0..length.unwrap_or(1)).map(|i| format_ident!("x{}", flat.len() + i)).collect();
        let ident = field(label);
        let is_load = label.starts_with(LOAD);
        let field_doc = format!("`{label}`");
        let hidden = is_load.then(|| quote!(#[doc(hidden)]));
        match length {
            Some(length) => {
                fields.push(quote!(#hidden #[doc = #field_doc] pub #ident: [T; #length]));
                patterns.push(quote!(#ident: [#(#parts),*]));
            }
            None => {
                fields.push(quote!(#[doc = #field_doc] pub #ident: T));
                patterns.push(quote!(#ident: #(#parts)*));
            }
        }
        if !is_load {
            debug.push(quote!(.field(#label, &self.#ident)));
        }
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

/// The name of a field; functions may have raw names.
fn field(label: &str) -> Ident {
    match syn::parse_str::<Ident>(label) {
        Ok(ident) => ident,
        Err(_) => Ident::new_raw(label, proc_macro2::Span::call_site()),
    }
}
