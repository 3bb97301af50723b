//! Velocities that a description uses: `self.hub_velocity(q, v)` is the rate of what `hub` returns.
//!
//! The macro writes such a method for every function of the block whose velocity the block uses, unless the
//! user has written it.

use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use quote::ToTokens;

use super::body::Name;
use super::translate::bare;

/// The suffix that makes the name of a function into that of its velocity.
pub const SUFFIX: &str = "_velocity";

/// The names `…_velocity` that a block calls on itself, each with the span of the first call. In an
/// unfinished block every such name counts.
pub fn mentioned(block: &syn::ItemImpl, is_unfinished: bool) -> Vec<(Name, Span)> {
    let mut found = Vec::new();
    let own = super::self_type(&block.self_ty).map(|segment| &segment.ident);
    let is_called = |trees: &[TokenTree], index: usize| is_unfinished || is_called(trees, index, own);
    for item in &block.items {
        if let syn::ImplItem::Fn(function) = item {
            search(function.block.to_token_stream(), &is_called, &mut found);
        }
    }
    found
}

fn search(
    tokens: TokenStream,
    is_called: &dyn Fn(&[TokenTree], usize) -> bool,
    found: &mut Vec<(Name, Span)>,
) {
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    for (index, tree) in trees.iter().enumerate() {
        match tree {
            TokenTree::Group(group) => search(group.stream(), is_called, found),
            TokenTree::Ident(ident) if is_called(&trees, index) => {
                let name = bare(ident);
                let is_new = name.ends_with(SUFFIX) && found.iter().all(|(other, _)| *other != name);
                if is_new {
                    found.push((name, ident.span()));
                }
            }
            TokenTree::Ident(_) | TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

/// Whether the identifier at an index is a method called on `self`, or a function of the type.
fn is_called(trees: &[TokenTree], index: usize, own: Option<&Ident>) -> bool {
    let punct = |index: Option<usize>, c: char| {
        let tree = index.and_then(|index| trees.get(index));
        matches!(tree, Some(TokenTree::Punct(punct)) if punct.as_char() == c)
    };
    let word = |index: Option<usize>| match index.and_then(|index| trees.get(index)) {
        Some(TokenTree::Ident(ident)) => Some(ident),
        _ => None,
    };
    let before = |distance: usize| index.checked_sub(distance);
    let is_type = |ident: &Ident| ident == "Self" || own == Some(ident);
    let arguments = matches!(trees.get(index + 1), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
    let on_self = punct(before(1), '.') && word(before(2)).is_some_and(|word| word == "self") && arguments;
    let of_type = punct(before(1), ':') && punct(before(2), ':') && word(before(3)).is_some_and(is_type);
    on_self || of_type
}
