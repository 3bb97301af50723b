//! What declares something in arguments that do not parse: the items that follow from it outlive the mistake.

use super::{Argument, Declaration, WORDS};
use crate::syntax::item::Kind;
use crate::syntax::pieces::{between_commas, is_punct, read_as};
use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};

/// The arguments that can be read, wherever they stand.
pub fn arguments(tokens: TokenStream) -> Vec<Argument> {
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    let mut found: Vec<Argument> = Vec::new();
    for (place, tree) in trees.iter().enumerate() {
        let TokenTree::Ident(key) = tree else { continue };
        let list = || trees[place + 1..].iter().take_while(|tree| !is_punct(tree, ',')).find_map(in_brackets);
        match key.to_string().as_str() {
            "coordinates" | "inputs" => found.extend(list().map(|list| {
                let names = between_commas(list).into_iter().filter_map(declaration);
                Argument::Names(key.clone(), names.collect())
            })),
            "sensitivities" => found.extend(list().map(|list| {
                let parameters = between_commas(list).into_iter().filter_map(read_as);
                Argument::Sensitivities(key.clone(), parameters.collect())
            })),
            "crate" => {
                let path = trees.iter().skip(place + 2).take_while(|tree| !is_punct(tree, ','));
                let path = read_as(path.cloned().collect());
                found.extend(path.map(|path| Argument::Crate(key.clone(), path)));
            }
            // Where there is a certificate, there is an analysis.
            "verify" => found.push(Argument::Word(syn::Ident::new("analysis", key.span()))),
            word if WORDS.contains(&word) => found.push(Argument::Word(key.clone())),
            _ => {}
        }
    }
    if found.iter().all(|argument| argument.key() != "coordinates")
        && let Some(list) = trees.iter().find_map(in_brackets)
    {
        // They come first.
        let key = Ident::new("coordinates", Span::call_site());
        found.push(Argument::Names(key, between_commas(list).into_iter().filter_map(declaration).collect()));
    }
    let keys: Vec<String> = found.iter().map(|argument| argument.key().to_string()).collect();
    let mut place = 0..;
    found.retain(|_| place.next().is_some_and(|place| !keys[..place].contains(&keys[place])));
    found
}

fn in_brackets(tree: &TokenTree) -> Option<TokenStream> {
    match tree {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket => Some(group.stream()),
        _ => None,
    }
}

/// A declared name with as much of its type as can be read.
fn declaration(tokens: TokenStream) -> Option<Declaration> {
    if let Some(declaration) = read_as(tokens.clone()) {
        return Some(declaration);
    }
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    let ident = trees.iter().find_map(|tree| match tree {
        // A keyword is no name.
        TokenTree::Ident(_) => read_as::<Ident>(tree.clone().into()),
        _ => None,
    })?;
    let length = trees.iter().find_map(in_brackets).and_then(read_as);
    let named = |name: &str| trees.iter().any(|tree| matches!(tree, TokenTree::Ident(word) if word == name));
    let kind = if named("Rotation") {
        Kind::Rotation
    } else if named("Pose") {
        Kind::Pose
    } else {
        Kind::Scalar
    };
    Some(Declaration { ident, kind, length })
}
