//! The structs that give coordinates, velocities and inputs their names.

use proc_macro2::{TokenStream, TokenTree};
use quote::{format_ident, quote};

use super::oriented;
use crate::syntax::{Group, Item, Record};

/// `…Coordinates`, `…Velocities`, and `…Inputs` if there are any.
pub(super) fn records(item: &Item) -> TokenStream {
    let coordinates = record(item, Record::Coordinates, &item.coordinates, "Generalized coordinates");
    let velocities = record(item, Record::Velocities, &item.coordinates, "Generalized velocities");
    let inputs = if item.inputs.is_empty() {
        TokenStream::new()
    } else {
        record(item, Record::Inputs, &item.inputs, "Inputs")
    };
    quote!(#coordinates #velocities #inputs)
}

/// One struct. Conversions and derives are written out by hand, since derived code would fill half of what
/// `cargo expand` shows.
fn record(item: &Item, record: Record, groups: &[Group], title: &str) -> TokenStream {
    let name = item.record_ident(record);
    let oriented = record != Record::Inputs && item.has_orientations();
    let shown = name.to_string();
    let doc = format!("{title} of [`{}`].", item.title);
    let count: usize = groups.iter().map(Group::size).sum();
    let (mut fields, mut patterns, mut flat, mut debug) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for group in groups {
        let (ident, label) = (&group.ident, group.name().to_string());
        let field_doc = format!("`{label}`");
        let element = group.kind.element(record, &item.crate_path);
        match group.length {
            Some(length) => {
                let parts: Vec<_> = (0..length).map(|i| format_ident!("x{}", flat.len() + i)).collect();
                fields.push(quote!(#[doc = #field_doc] pub #ident: [#element; #length]));
                patterns.push(quote!(#ident: [#(#parts),*]));
                flat.extend(parts);
            }
            None => {
                let part = format_ident!("x{}", flat.len());
                fields.push(quote!(#[doc = #field_doc] pub #ident: #element));
                patterns.push(quote!(#ident: #part));
                flat.push(part);
            }
        }
        debug.push(quote!(.field(#label, &self.#ident)));
    }
    let conversions = match oriented {
        true => oriented::conversions(item, record),
        false => {
            let methods = conversions(item, record, count);
            quote! {
                impl<R> ::core::convert::From<[R; #count]> for #name<R> {
                    fn from([#(#flat),*]: [R; #count]) -> Self {
                        Self { #(#patterns),* }
                    }
                }

                impl<R> ::core::convert::From<#name<R>> for [R; #count] {
                    fn from(#name { #(#patterns),* }: #name<R>) -> Self {
                        [#(#flat),*]
                    }
                }

                #methods
            }
        }
    };
    let path = &item.crate_path;
    let real = oriented.then(|| quote!(#path::__private::Real +));
    let bound = oriented.then(|| quote!(: #path::__private::Real));
    quote! {
        #[doc = #doc]
        #[allow(non_snake_case)]
        pub struct #name<R #bound = f64> { #(#fields),* }

        impl<R: #real ::core::marker::Copy> ::core::marker::Copy for #name<R> {}

        impl<R: #real ::core::marker::Copy> ::core::clone::Clone for #name<R> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<R: #real ::core::fmt::Debug> ::core::fmt::Debug for #name<R> {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.debug_struct(#shown)#(#debug)*.finish()
            }
        }

        #conversions
    }
}

/// The conversions as methods, if the description uses them.
fn conversions(item: &Item, record: Record, count: usize) -> TokenStream {
    let (name, path) = (item.record_ident(record), &item.crate_path);
    let to_array = mentions(&item.cleaned, "to_array").then(|| {
        quote! {
            /// All components in order.
            pub fn to_array(&self) -> [R; #count] {
                <[R; #count] as ::core::convert::From<Self>>::from(*self)
            }
        }
    });
    let vector = |method: &str| {
        let method = format_ident!("{method}");
        quote! {
            /// All components in order.
            pub fn #method(&self) -> #path::__private::nalgebra::SVector<R, #count> {
                ::core::convert::From::from(<[R; #count] as ::core::convert::From<Self>>::from(*self))
            }
        }
    };
    let vectors =
        ["as_vector", "to_vector"].into_iter().filter(|method| mentions(&item.cleaned, method)).map(vector);
    let methods: TokenStream = to_array.into_iter().chain(vectors).collect();
    if methods.is_empty() {
        return methods;
    }
    quote!(impl<R: #path::__private::Real> #name<R> { #methods })
}

/// Whether an identifier occurs in some tokens.
fn mentions(tokens: &TokenStream, name: &str) -> bool {
    tokens.clone().into_iter().any(|token| match token {
        TokenTree::Ident(ident) => ident == name,
        TokenTree::Group(group) => mentions(&group.stream(), name),
        TokenTree::Punct(_) | TokenTree::Literal(_) => false,
    })
}
