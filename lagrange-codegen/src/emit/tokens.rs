//! From text to tokens, with the user's expressions in place of parameters.

use proc_macro2::{Group, Ident, Literal, Span, TokenStream, TokenTree};
use quote::{quote, quote_spanned};

use crate::diagnostics::Diagnostics;
use crate::model::{Length, Model};

const PREFIX: &str = "parameter__";

/// The identifier of a parameter in generated text.
pub(super) fn placeholder(parameter: u32) -> String {
    format!("{PREFIX}{parameter}")
}

/// Calls, on the user's spans, that compile only if parameter arrays have the assumed lengths.
pub(super) fn length_checks(model: &Model, diagnostics: &Diagnostics) -> TokenStream {
    let mut done: Vec<(&str, usize)> = Vec::new();
    let mut checks = TokenStream::new();
    for Length { path, length, origin } in &model.lengths {
        if done.contains(&(path.as_str(), *length)) {
            continue;
        }
        done.push((path.as_str(), *length));
        let span = diagnostics.span(*origin).resolved_at(Span::call_site());
        let path = respan(path.parse().unwrap_or_default(), span);
        checks.extend(quote_spanned!(span=> lagrange::solve::has_length::<#length, _>(&#path);));
    }
    checks
}

/// Replaces placeholders by the user's expressions on the user's spans, so that a wrong type is reported
/// where the user wrote it.
pub(super) struct Parameters {
    expressions: Vec<TokenStream>,
}

impl Parameters {
    /// Parses the expressions of all parameters.
    pub fn new(model: &Model, diagnostics: &Diagnostics) -> Parameters {
        let expressions = model
            .parameters
            .iter()
            .map(|parameter| {
                // The user's tokens keep their spans, so that the compiler sees one mistake in the user's
                // function and in the generated code. Only a call of the runtime around them gets another
                // span.
                let span = diagnostics.span(parameter.origin);
                let ours = parameter.path.starts_with("::");
                let span = if ours { span.resolved_at(Span::call_site()) } else { span };
                let tokens: TokenStream = parameter.path.parse().unwrap_or_default();
                respan(tokens, span)
            })
            .collect();
        Parameters { expressions }
    }

    /// Numbers of the system's own in place of the user's expressions.
    pub fn kept(model: &Model) -> Parameters {
        let kept = |index: usize| {
            let index = Literal::usize_unsuffixed(index);
            quote!(self.parameters[#index])
        };
        Parameters { expressions: (0..model.parameters.len()).map(kept).collect() }
    }

    /// Generated text as tokens.
    ///
    /// # Panics
    /// Where the text is not Rust: a bug of the emitter, which the entry point reports as such.
    pub fn parse(&self, text: &str) -> TokenStream {
        let tokens: TokenStream = text.parse().expect("emit: generated text is not made of tokens");
        if text.contains(PREFIX) { self.fill(tokens) } else { tokens }
    }

    fn fill(&self, tokens: TokenStream) -> TokenStream {
        let mut filled = Vec::new();
        for token in tokens {
            match token {
                TokenTree::Ident(ident) => {
                    let name = ident.to_string();
                    let expression = name
                        .strip_prefix(PREFIX)
                        .and_then(|number| number.parse::<usize>().ok())
                        .and_then(|number| self.expressions.get(number));
                    match expression {
                        Some(expression) => filled.extend(expression.clone()),
                        None => filled.push(TokenTree::Ident(ident)),
                    }
                }
                TokenTree::Group(group) => {
                    let mut inner = Group::new(group.delimiter(), self.fill(group.stream()));
                    inner.set_span(group.span());
                    filled.push(TokenTree::Group(inner));
                }
                other @ (TokenTree::Punct(_) | TokenTree::Literal(_)) => filled.push(other),
            }
        }
        filled.into_iter().collect()
    }
}

/// Gives all tokens one span.
pub(super) fn respan(tokens: TokenStream, span: Span) -> TokenStream {
    tokens
        .into_iter()
        .map(|token| match token {
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), respan(group.stream(), span));
                inner.set_span(span);
                TokenTree::Group(inner)
            }
            // `self` is that of the generated method. Other names are resolved where the user wrote them.
            TokenTree::Ident(ident) if ident == "self" => {
                TokenTree::Ident(Ident::new("self", span.resolved_at(Span::call_site())))
            }
            mut other @ (TokenTree::Ident(_) | TokenTree::Punct(_) | TokenTree::Literal(_)) => {
                other.set_span(span);
                other
            }
        })
        .collect()
}
