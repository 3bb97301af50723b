//! The replacement of the expansion after a mistake, so that only our messages are reported.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{Attribute, Expr, ImplItem, Item, ItemImpl, Stmt};

use super::item::Scalar;
use super::{generic_scalar, name_of, rewrite, role, self_type, unfinished};
use crate::diagnostics::catalogue;

/// The item without our attributes. Its bodies may hold unknown names, so only an editor sees them, for
/// completion.
pub fn recover(item: TokenStream) -> TokenStream {
    let Ok((item, _)) = unfinished::read(item) else { return TokenStream::new() };
    match item {
        Item::Impl(mut block) => {
            block.attrs.push(syn::parse_quote!(#[allow(unused, unexpected_cfgs, clippy::all)]));
            hide_bodies(&mut block);
            match self_type(&block.self_ty).map(name_of) {
                Some(name) if block.trait_.is_none() => {
                    let scalar = generic_scalar(&block.generics).map_or(Scalar::F64, Scalar::Generic);
                    rewrite::rename(block, &name, &scalar).into_token_stream()
                }
                Some(_) | None => block.into_token_stream(),
            }
        }
        // The attribute may stand on a free function.
        Item::Fn(mut function) => {
            strip(&mut function.attrs);
            function.into_token_stream()
        }
        other => other.into_token_stream(),
    }
}

/// An item that keeps a program from being built if the compiler accepts what the macro cannot read.
pub fn refusal(reason: &str) -> TokenStream {
    let message = catalogue::unread(reason);
    quote! {
        const _: () = {
            #[used]
            static REFUSED: fn() = refused;
            fn refused() { const { ::core::panic!(#message) } }
        };
    }
}

/// Removes the role attributes and hides the bodies from the compiler.
fn hide_bodies(block: &mut ItemImpl) {
    for item in &mut block.items {
        let ImplItem::Fn(function) = item else { continue };
        let has_role = strip(&mut function.attrs);
        let opaque = matches!(&function.sig.output, syn::ReturnType::Type(_, ty)
            if matches!(&**ty, syn::Type::ImplTrait(_)));
        // A constant function may give the length of an array, so an endless loop will not do.
        let constant = function.sig.constness.is_some();
        if has_role || !(opaque || constant) {
            let body = &function.block;
            let shown = quote!(#[cfg(rust_analyzer)] #body #[cfg(not(rust_analyzer))] { loop {} });
            function.block.stmts = vec![Stmt::Expr(Expr::Verbatim(shown), None)];
        }
    }
}

/// Removes role attributes and tells whether there were any.
fn strip(attributes: &mut Vec<Attribute>) -> bool {
    let before = attributes.len();
    attributes.retain(|attribute| !role::is_role(attribute));
    attributes.len() < before
}
