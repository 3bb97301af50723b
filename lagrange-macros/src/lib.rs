//! The attribute macro of the `lagrangian` crate. It only calls `lagrange-codegen`; see there for
//! the engine, and the `lagrangian` crate for the documentation.
#![forbid(unsafe_code)]

use proc_macro::TokenStream;

/// The attribute for crates that depend on `lagrange-runtime` directly; everyone else uses
/// `lagrangian::lagrangian`.
#[doc = include_str!("attribute.md")]
#[proc_macro_attribute]
pub fn lagrangian(args: TokenStream, item: TokenStream) -> TokenStream {
    lagrange_codegen::expand(args.into(), item.into(), "::lagrange_runtime").into()
}

// The twin that the facade re-exports under the name `lagrangian`. Only the path differs.
#[doc = include_str!("attribute.md")]
#[proc_macro_attribute]
pub fn lagrangian_facade(args: TokenStream, item: TokenStream) -> TokenStream {
    lagrange_codegen::expand(args.into(), item.into(), "::lagrangian").into()
}
