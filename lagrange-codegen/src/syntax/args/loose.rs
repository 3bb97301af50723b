//! Declarations from arguments that do not parse: the generated items outlive the mistake.

use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};

use super::{Argument, Declaration, KNOWN, WORDS};
use crate::syntax::item::Kind;
use crate::syntax::pieces::{between_commas, is_punct, read_as, unnamed};

/// The arguments that can be read.
pub fn arguments(tokens: TokenStream) -> Vec<Argument> {
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    let mut found: Vec<Argument> = Vec::new();
    let mut claimed: Vec<usize> = Vec::new();
    for (index, tree) in trees.iter().enumerate() {
        let TokenTree::Ident(key) = tree else { continue };
        match key.to_string().as_str() {
            "coordinates" | "inputs" | "sensitivities" => {
                let behind = trees[index + 1..].iter().take_while(|tree| !is_key(tree));
                let list =
                    behind.enumerate().find_map(|(distance, tree)| Some((distance, in_brackets(tree)?)));
                if let Some((distance, list)) = list {
                    claimed.push(index + 1 + distance);
                    found.push(listed(key.clone(), list));
                }
            }
            "crate" => {
                let path = trees.iter().skip(index + 2).take_while(|tree| !is_punct(tree, ','));
                let path = read_as(path.cloned().collect());
                found.extend(path.map(|path| Argument::Crate(key.clone(), path)));
            }
            // A certificate includes the analysis.
            "verify" => found.push(Argument::Word(syn::Ident::new("analysis", key.span()))),
            word if WORDS.contains(&word) => found.push(Argument::Word(key.clone())),
            _ => {}
        }
    }
    // A list without a key is the coordinates, or else the inputs, if these are missing. One that begins with
    // `self` is the sensitivities.
    for (index, tree) in trees.iter().enumerate() {
        let Some(list) = in_brackets(tree).filter(|_| !claimed.contains(&index)) else { continue };
        let of_parameters =
            matches!(list.clone().into_iter().next(), Some(TokenTree::Ident(word)) if word == "self");
        let keys = if of_parameters { &["sensitivities"][..] } else { &["coordinates", "inputs"] };
        let is_missing = |key: &&&str| found.iter().all(|argument| argument.key() != **key);
        if let Some(key) = keys.iter().find(is_missing) {
            found.push(listed(Ident::new(key, Span::call_site()), list));
        }
    }
    let keys: Vec<String> = found.iter().map(|argument| argument.key().to_string()).collect();
    let mut index = 0..;
    found.retain(|_| index.next().is_some_and(|index| !keys[..index].contains(&keys[index])));
    found
}

fn is_key(tree: &TokenTree) -> bool {
    matches!(tree, TokenTree::Ident(word) if KNOWN.iter().any(|key| word == key))
}

/// A list with its key. An element that cannot be read counts, too.
fn listed(key: Ident, list: TokenStream) -> Argument {
    let elements = between_commas(list).into_iter();
    if key == "sensitivities" {
        let parameter = |tokens| read_as(tokens).unwrap_or_else(|| syn::parse_quote!(self));
        return Argument::Sensitivities(key, elements.map(parameter).collect());
    }
    let names = elements.enumerate().map(|(index, tokens)| declaration(index, tokens));
    Argument::Names(key.clone(), names.collect())
}

fn in_brackets(tree: &TokenTree) -> Option<TokenStream> {
    match tree {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket => Some(group.stream()),
        _ => None,
    }
}

/// A declared name with as much of its type as can be read. Without a name, `index` makes one.
fn declaration(index: usize, tokens: TokenStream) -> Declaration {
    if let Some(declaration) = read_as(tokens.clone()) {
        return declaration;
    }
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    let ident = trees.iter().find_map(|tree| match tree {
        // A keyword is no name.
        TokenTree::Ident(_) => read_as::<Ident>(tree.clone().into()),
        _ => None,
    });
    let length = trees.iter().find_map(in_brackets).and_then(read_as);
    let named = |name: &str| trees.iter().any(|tree| matches!(tree, TokenTree::Ident(word) if word == name));
    let kind = if named("Rotation") {
        Kind::Rotation
    } else if named("Pose") {
        Kind::Pose
    } else {
        Kind::Scalar
    };
    let ident = ident.filter(|ident| ident != "Rotation" && ident != "Pose");
    let ident = ident.unwrap_or_else(|| unnamed(index, Span::call_site()));
    Declaration { ident, kind, length }
}
