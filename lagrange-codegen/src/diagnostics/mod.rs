//! The error sink: stages report into it, and all mistakes that one of them finds are shown at once.
//!
//! The stages that know no tokens speak of an [`Origin`], a handle to a span of the
//! user's source. Message texts stand in [`catalogue`] and [`physics`].

pub mod catalogue;
pub mod physics;

use proc_macro2::{Span, TokenStream};
use quote::quote_spanned;

/// A span of the user's source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Origin(u32);

/// The spans of origins, and the messages so far.
#[derive(Debug, Default)]
pub struct Diagnostics {
    spans: Vec<Span>,
    errors: Vec<(Span, String)>,
}

impl Diagnostics {
    /// An empty sink.
    pub fn new() -> Diagnostics {
        Diagnostics::default()
    }

    /// The origin of a span.
    pub fn origin(&mut self, span: Span) -> Origin {
        self.spans.push(span);
        Origin(self.spans.len() as u32 - 1)
    }

    /// The span of an origin.
    pub fn span(&self, origin: Origin) -> Span {
        self.spans[origin.0 as usize]
    }

    /// Reports a mistake at an origin.
    pub fn at(&mut self, origin: Origin, message: impl Into<String>) {
        self.error(self.span(origin), message);
    }

    /// Reports a mistake at a span: one for each span, however often a helper
    /// function is inlined or a loop unrolled. The call site may have several.
    pub fn error(&mut self, span: Span, message: impl Into<String>) {
        let message = message.into();
        let same_place = |other: Span| format!("{span:?}") == format!("{other:?}");
        let whole = same_place(Span::call_site());
        if !self.errors.iter().any(|(other, text)| same_place(*other) && (!whole || *text == message)) {
            self.errors.push((span, message));
        }
    }

    /// Whether anything was reported.
    pub fn has_errors(&self) -> bool {
        !self.errors.is_empty()
    }

    /// The messages, in order of their discovery.
    pub fn messages(&self) -> impl Iterator<Item = &str> {
        self.errors.iter().map(|(_, message)| message.as_str())
    }

    /// One `compile_error!` for each mistake, on the user's tokens.
    pub fn to_tokens(&self) -> TokenStream {
        self.errors
            .iter()
            .map(|(span, message)| quote_spanned!(*span=> ::core::compile_error! { #message }))
            .collect()
    }
}
