//! Velocities that a description names: `self.hub_velocity(q, v)` is the rate of what `hub` returns.
//!
//! The macro writes such a method for every function of the block whose velocity the block mentions, unless
//! the user has written it.

use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use quote::ToTokens;

use super::body::Name;
use super::translate::bare;

/// What stands behind the name of a function in the name of its velocity.
pub const SUFFIX: &str = "_velocity";

/// The names in a block that a function `…_velocity` of its own is called by, each once where it first
/// stands. In an unfinished block every name counts, whatever stands before it.
pub fn mentioned(block: &syn::ItemImpl, is_unfinished: bool) -> Vec<(Name, Span)> {
    let mut found = Vec::new();
    let own = super::self_type(&block.self_ty).map(|segment| &segment.ident);
    let is_called = |trees: &[TokenTree], place: usize| is_unfinished || is_called(trees, place, own);
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
    for (place, tree) in trees.iter().enumerate() {
        match tree {
            TokenTree::Group(group) => search(group.stream(), is_called, found),
            TokenTree::Ident(ident) if is_called(&trees, place) => {
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

/// Whether the identifier at a place is a method called on `self`, or a function of the type.
fn is_called(trees: &[TokenTree], place: usize, own: Option<&Ident>) -> bool {
    let punct = |place: Option<usize>, c: char| {
        let tree = place.and_then(|place| trees.get(place));
        matches!(tree, Some(TokenTree::Punct(punct)) if punct.as_char() == c)
    };
    let word = |place: Option<usize>| match place.and_then(|place| trees.get(place)) {
        Some(TokenTree::Ident(ident)) => Some(ident),
        _ => None,
    };
    let before = |distance: usize| place.checked_sub(distance);
    let is_type = |ident: &Ident| ident == "Self" || own == Some(ident);
    let arguments = matches!(trees.get(place + 1), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
    let on_self = punct(before(1), '.') && word(before(2)).is_some_and(|word| word == "self") && arguments;
    let of_type = punct(before(1), ':') && punct(before(2), ':') && word(before(3)).is_some_and(is_type);
    on_self || of_type
}
