//! `cfg` inside an impl block: which of its cases holds is decided after the macro has run.

use proc_macro2::{Span, TokenStream, TokenTree};

/// A `#[cfg(…)]` or `#[cfg_attr(…)]` in some tokens, if there is any.
pub fn find(tokens: TokenStream) -> Option<Span> {
    let mut stack = vec![tokens];
    while let Some(stream) = stack.pop() {
        let mut after_hash = false;
        for tree in stream {
            match tree {
                TokenTree::Punct(punct) => {
                    after_hash = punct.as_char() == '#' || (after_hash && punct.as_char() == '!')
                }
                TokenTree::Group(group) => {
                    if after_hash
                        && let Some(TokenTree::Ident(ident)) = group.stream().into_iter().next()
                        && (ident == "cfg" || ident == "cfg_attr")
                    {
                        return Some(ident.span());
                    }
                    after_hash = false;
                    stack.push(group.stream());
                }
                TokenTree::Ident(_) | TokenTree::Literal(_) => after_hash = false,
            }
        }
    }
    None
}
