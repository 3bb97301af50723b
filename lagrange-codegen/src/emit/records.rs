//! The structs that give coordinates, velocities and inputs their names.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::syntax::{Group, Item, Record};

/// `…Coordinates`, `…Velocities`, and `…Inputs` where there are any.
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

fn record(item: &Item, record: Record, groups: &[Group], title: &str) -> TokenStream {
    let name = item.record_ident(record);
    let path = &item.crate_path;
    let doc = format!("{title} of [`{}`].", item.name);
    let title = name.to_string();
    let count: usize = groups.iter().map(|group| group.length.unwrap_or(1)).sum();
    let (mut fields, mut parts, mut flat, mut shown) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut offset = 0;
    for group in groups {
        let ident: &Ident = &group.ident;
        let field_doc = format!("`{}`", group.name());
        match group.length {
            Some(length) => {
                fields.push(quote!(#[doc = #field_doc] pub #ident: [R; #length]));
                parts.push(quote!(#ident: ::core::array::from_fn(|i| values[#offset + i])));
                flat.extend((0..length).map(|i| quote!(record.#ident[#i])));
                offset += length;
            }
            None => {
                fields.push(quote!(#[doc = #field_doc] pub #ident: R));
                parts.push(quote!(#ident: values[#offset]));
                flat.push(quote!(record.#ident));
                offset += 1;
            }
        }
        let label = group.name().to_string();
        shown.push(quote!(.field(#label, &self.#ident)));
    }
    quote! {
        #[doc = #doc]
        pub struct #name<R = f64> { #(#fields),* }

        impl<R: ::core::marker::Copy> ::core::marker::Copy for #name<R> {}

        impl<R: ::core::marker::Copy> ::core::clone::Clone for #name<R> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<R: ::core::fmt::Debug> ::core::fmt::Debug for #name<R> {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.debug_struct(#title)#(#shown)*.finish()
            }
        }

        impl<R: ::core::marker::Copy> ::core::convert::From<[R; #count]> for #name<R> {
            fn from(values: [R; #count]) -> Self {
                Self { #(#parts),* }
            }
        }

        impl<R: ::core::marker::Copy> ::core::convert::From<#name<R>> for [R; #count] {
            fn from(record: #name<R>) -> Self {
                [#(#flat),*]
            }
        }

        impl<R: #path::__private::Real> #name<R> {
            /// All components in order.
            pub fn as_vector(&self) -> #path::__private::nalgebra::SVector<R, #count> {
                <[R; #count]>::from(*self).into()
            }
        }
    }
}
