//! What stands in for the expansion after a mistake, so that only our messages are reported.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{Attribute, ImplItem, Item, ItemImpl};

use super::args::{self, Declaration};
use super::item::{Kind, Record, Scalar};
use super::{generic_scalar, name_of, rewrite, role, self_type};
use crate::diagnostics::Diagnostics;

/// The item without our attributes and without bodies and, `with_records`, the structs that its
/// signatures name. Works for whatever part of the input can be read.
pub fn recover(args: TokenStream, item: TokenStream, with_records: bool) -> TokenStream {
    let Ok(item) = syn::parse2::<Item>(item) else { return TokenStream::new() };
    match item {
        Item::Impl(mut block) => {
            block.attrs.push(syn::parse_quote!(#[allow(unused, clippy::all)]));
            match self_type(&block.self_ty).map(name_of) {
                Some(name) if block.trait_.is_none() => {
                    let records = with_records.then(|| records(args, &name));
                    let block = inherent(block, &name);
                    quote!(#records #block)
                }
                Some(_) | None => {
                    without_bodies(&mut block);
                    block.into_token_stream()
                }
            }
        }
        // A role on a free function, say.
        Item::Fn(mut function) => {
            strip(&mut function.attrs);
            function.into_token_stream()
        }
        other => other.into_token_stream(),
    }
}

fn records(args: TokenStream, name: &syn::Ident) -> TokenStream {
    let mut diagnostics = Diagnostics::new();
    let args = args::parse(args, &mut diagnostics);
    let path = args.crate_path.clone().unwrap_or_else(|| syn::parse_quote!(::lagrangian));
    let has_orientations = args.coordinates.iter().any(|declaration| declaration.kind != Kind::Scalar);
    let bound = has_orientations.then(|| quote!(: #path::__private::Real));
    let structs = Record::ALL.map(|record| {
        let ident = record.ident(name);
        let fields = match record {
            Record::Coordinates | Record::Velocities => fields(&args.coordinates, record, &path),
            Record::Inputs => fields(&args.inputs, record, &path),
        };
        quote! {
            #[doc(hidden)]
            #[allow(missing_docs, dead_code)]
            #[derive(Clone, Copy, Debug)]
            pub struct #ident<R #bound = f64> {
                #(#fields,)*
                #[doc(hidden)]
                pub __scalar: ::core::marker::PhantomData<R>,
            }
        }
    });
    quote!(#(#structs)*)
}

fn inherent(mut block: ItemImpl, name: &syn::Ident) -> ItemImpl {
    without_bodies(&mut block);
    let scalar = generic_scalar(&block.generics).map_or(Scalar::F64, Scalar::Generic);
    rewrite::rename(block, name, &scalar)
}

/// The declared names that can be fields.
fn fields(declarations: &[Declaration], record: Record, path: &syn::Path) -> Vec<TokenStream> {
    let mut names: Vec<String> = Vec::new();
    let mut fields = Vec::new();
    for Declaration { ident, kind, length } in declarations {
        let name = ident.to_string();
        if names.contains(&name) || syn::parse_str::<syn::Ident>(&name).is_err() {
            continue;
        }
        names.push(name);
        let element = kind.element(record, path);
        match length {
            None => fields.push(quote!(pub #ident: #element)),
            Some(syn::Expr::Lit(length)) if matches!(length.lit, syn::Lit::Int(_)) => {
                fields.push(quote!(pub #ident: [#element; #length]))
            }
            Some(_) => {}
        }
    }
    fields
}

/// Takes the role attributes off and empties the bodies, in which unknown names may stand.
fn without_bodies(block: &mut ItemImpl) {
    for item in &mut block.items {
        let ImplItem::Fn(function) = item else { continue };
        let has_role = strip(&mut function.attrs);
        let opaque = matches!(&function.sig.output, syn::ReturnType::Type(_, ty)
            if matches!(&**ty, syn::Type::ImplTrait(_)));
        // A constant function may be the length of an array: it must come to an end.
        let constant = function.sig.constness.is_some();
        if has_role || !(opaque || constant) {
            function.block = syn::parse_quote!({ loop {} });
        }
    }
}

/// Removes role attributes; whether there were any.
fn strip(attributes: &mut Vec<Attribute>) -> bool {
    let before = attributes.len();
    attributes.retain(|attribute| !role::is_role(attribute));
    attributes.len() < before
}
