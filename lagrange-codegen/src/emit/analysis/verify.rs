//! The certificate.

use proc_macro2::TokenStream;

use crate::emit::Emission;

/// `verify` and `verify_at`.
pub(super) fn methods(_emission: &mut Emission<'_>, _affine: bool) -> String {
    String::new()
}

/// The test that the attribute asks for.
pub(in crate::emit) fn test(_emission: &Emission<'_>) -> Option<TokenStream> {
    None
}
