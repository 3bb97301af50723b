//! Pieces of tokens that do not parse as a whole.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use quote::format_ident;
use syn::parse::{Parse, ParseStream, Parser};

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

/// A name for something that has none yet. No program uses it. `index` tells it from others.
pub fn unnamed(index: usize, span: Span) -> Ident {
    format_ident!("__unnamed{index}", span = span)
}

/// The longest run of tokens that can be read. Where no run can be, groups are searched one after the other
/// for their longest run.
pub fn readable<T: Parse>(trees: &[TokenTree]) -> Option<T> {
    let run = |start: usize| {
        let rest = || trees[start..].iter().cloned().collect::<TokenStream>();
        let prefix = |input: ParseStream| {
            let read = input.parse::<T>()?;
            Ok((read, input.parse::<TokenStream>()?.into_iter().count()))
        };
        // If a bracket is not closed, as in `Vector2<f64`, the word before it is read.
        let word = || Some((read_as(trees[start].clone().into())?, trees.len() - start - 1));
        let (read, left) = prefix.parse2(rest()).ok().or_else(word)?;
        Some((trees.len() - start - left, read))
    };
    // The first of the longest runs.
    let longest = (0..trees.len()).rev().filter_map(run).max_by_key(|(length, _)| *length);
    longest.map(|(_, read)| read).or_else(|| {
        trees.iter().find_map(|tree| match tree {
            TokenTree::Group(group) => readable(&group.stream().into_iter().collect::<Vec<_>>()),
            _ => None,
        })
    })
}
