//! Pieces of tokens that do not parse as a whole.

use proc_macro2::{TokenStream, TokenTree};
use syn::parse::Parse;

/// Tokens between commas outside angle brackets.
pub fn between_commas(tokens: TokenStream) -> Vec<TokenStream> {
    let mut parts = vec![TokenStream::new()];
    let (mut depth, mut previous) = (0_i32, None);
    for tree in tokens {
        match &tree {
            TokenTree::Punct(punct) if punct.as_char() == '<' => depth += 1,
            TokenTree::Punct(punct) if punct.as_char() == '>' && previous != Some('-') => depth -= 1,
            _ => {}
        }
        previous = match &tree {
            TokenTree::Punct(punct) => Some(punct.as_char()),
            _ => None,
        };
        match is_punct(&tree, ',') && depth <= 0 {
            true => parts.push(TokenStream::new()),
            false => parts.last_mut().expect("there is one from the start").extend([tree]),
        }
    }
    parts.retain(|part| !part.is_empty());
    parts
}

/// Whether a token is this mark.
pub fn is_punct(tree: &TokenTree, c: char) -> bool {
    matches!(tree, TokenTree::Punct(punct) if punct.as_char() == c)
}

/// Some tokens, if they parse.
pub fn read_as<T: Parse>(tokens: TokenStream) -> Option<T> {
    syn::parse2(tokens).ok()
}
