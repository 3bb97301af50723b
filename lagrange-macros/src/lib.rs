//! The attribute macro of the `lagrangian` crate. It only calls `lagrange-codegen`; see there for
//! the engine, and the `lagrangian` crate for the documentation of the language.
#![forbid(unsafe_code)]

use proc_macro::TokenStream;

/// Derives the equations of motion of the system that an `impl` block describes.
///
/// For crates that depend on `lagrange-runtime` directly; everyone else uses
/// `lagrangian::lagrangian`, which is documented there.
#[proc_macro_attribute]
pub fn lagrangian(args: TokenStream, item: TokenStream) -> TokenStream {
    lagrange_codegen::expand(args.into(), item.into(), "::lagrange_runtime").into()
}

/// The twin that the facade re-exports under the name `lagrangian`.
#[doc(hidden)]
#[proc_macro_attribute]
pub fn lagrangian_facade(args: TokenStream, item: TokenStream) -> TokenStream {
    lagrange_codegen::expand(args.into(), item.into(), "::lagrangian").into()
}
