//! Blocks that do not parse, as an editor has them while somebody types: all that can be read, item by item.
//!
//! The compiler has parsed an item before it calls the attribute, and has reported what does not parse, so
//! nothing is reported here. A body that does not parse is kept as tokens. Of a signature, what can be read
//! is kept. The generated items follow from these declarations, so they outlive the mistake.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::quote;
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, FnArg, Ident, ImplItem, ImplItemFn, ItemImpl, Stmt, Token, Type};

use super::pieces::{between_commas, is_punct, read_as, readable, unnamed};
use super::role;

/// The word that rust-analyzer inserts where something is missing, before it calls a macro.
const MISSING: &str = "__ra_fixup";

/// Reads an item. A message tells why it is not whole: an `impl` block does not parse, or a word is missing.
pub fn read(item: TokenStream) -> syn::Result<(syn::Item, Option<String>)> {
    let error = match syn::parse2::<syn::Item>(item.clone()) {
        Ok(read) if !is_missing(&item) => return Ok((read, None)),
        Ok(read) => return Ok((read, Some(format!("`{MISSING}` stands where something is missing")))),
        Err(error) => error,
    };
    let mut trees: Vec<TokenTree> = item.into_iter().collect();
    match trees.pop() {
        Some(TokenTree::Group(body)) if body.delimiter() == Delimiter::Brace => {
            let header: TokenStream = trees.into_iter().collect();
            let Ok(mut block) = syn::parse2::<ItemImpl>(quote!(#header {})) else { return Err(error) };
            block.items = pieces(body.stream()).into_iter().enumerate().filter_map(item_of).collect();
            Ok((syn::Item::Impl(block), Some(error.to_string())))
        }
        _ => Err(error),
    }
}

fn is_missing(tokens: &TokenStream) -> bool {
    tokens.clone().into_iter().any(|tree| match tree {
        TokenTree::Ident(ident) => ident == MISSING,
        TokenTree::Group(group) => is_missing(&group.stream()),
        TokenTree::Punct(_) | TokenTree::Literal(_) => false,
    })
}

/// The tokens of each item. An item ends with its body or a semicolon, or where the next one begins.
fn pieces(tokens: TokenStream) -> Vec<Vec<TokenTree>> {
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    let mut pieces: Vec<Vec<TokenTree>> = vec![Vec::new()];
    let (mut declares, mut is_function) = (false, false);
    for (index, tree) in trees.iter().enumerate() {
        let (before, rest) = (index.checked_sub(1).map(|index| &trees[index]), &trees[index..]);
        let is_pointer = before.is_some_and(|before| is_punct(before, '*'));
        let is_keyword = is_word(tree, &["fn"]);
        // After `fn` without a name another item may begin, but not with a second `fn`.
        let is_open = declares || (is_function && !is_keyword);
        if is_open && !is_pointer && begins(rest) {
            pieces.push(Vec::new());
            (declares, is_function) = (false, false);
        }
        is_function |= is_keyword || (!declares && is_called(rest));
        if is_punct(tree, ';') && !declares {
            // A semicolon before any declaration ends nothing.
            continue;
        }
        // A repeated `fn` declares nothing more.
        declares |= (is_function && !is_keyword) || is_word(tree, &["type"]) || is_constant(rest);
        let ends = match tree {
            TokenTree::Punct(punct) => punct.as_char() == ';',
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                // A block between angle brackets is a length, not a body.
                let is_argument = before.is_some_and(|before| is_punct(before, '<') || is_punct(before, ','))
                    && rest.get(1).is_some_and(|next| is_punct(next, '>') || is_punct(next, ','));
                is_function && !is_argument
            }
            _ => false,
        };
        pieces.last_mut().expect("there is one from the start").push(tree.clone());
        if ends {
            pieces.push(Vec::new());
            (declares, is_function) = (false, false);
        }
    }
    pieces
}

/// Whether an item begins with these tokens.
fn begins(trees: &[TokenTree]) -> bool {
    let [tree, rest @ ..] = trees else { return false };
    let next = rest.first();
    // `fn(f64) -> f64` is a type.
    let is_named = is_word(tree, &["fn", "type"]) && matches!(next, Some(TokenTree::Ident(_)));
    let is_constant_function = is_word(tree, &["const"]) && next.is_some_and(|next| is_word(next, &["fn"]));
    is_attribute(tree, next)
        || is_word(tree, &["pub"])
        || is_named
        || is_constant_function
        || is_constant(trees)
}

/// `const NAME:`.
fn is_constant(trees: &[TokenTree]) -> bool {
    matches!(trees, [word, TokenTree::Ident(_), colon, ..] if is_word(word, &["const"]) && is_punct(colon, ':'))
}

/// A name with parameters: a function without its `fn`.
fn is_called(trees: &[TokenTree]) -> bool {
    let [name @ TokenTree::Ident(_), TokenTree::Group(group), ..] = trees else { return false };
    group.delimiter() == Delimiter::Parenthesis && read_as::<Ident>(name.clone().into()).is_some()
}

fn is_attribute(tree: &TokenTree, next: Option<&TokenTree>) -> bool {
    let brackets =
        |tree: &TokenTree| matches!(tree, TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket);
    is_punct(tree, '#') && next.is_some_and(brackets)
}

fn is_word(tree: &TokenTree, words: &[&str]) -> bool {
    matches!(tree, TokenTree::Ident(ident) if words.iter().any(|word| ident == word))
}

/// An item, whole if it parses. `index` names it if it has no name.
fn item_of((index, piece): (usize, Vec<TokenTree>)) -> Option<ImplItem> {
    let tokens: TokenStream = piece.iter().cloned().collect();
    match syn::parse2::<ImplItem>(tokens) {
        Ok(item) if !matches!(item, ImplItem::Verbatim(_)) => Some(item),
        Ok(_) | Err(_) => function(index, piece).map(ImplItem::Fn),
    }
}

/// A function, without the parts that cannot be read.
fn function(index: usize, piece: Vec<TokenTree>) -> Option<ImplItemFn> {
    let keyword = piece.iter().position(|tree| is_word(tree, &["fn"]));
    let start = keyword.or_else(|| (0..piece.len()).find(|&index| is_called(&piece[index..])))?;
    if piece.len() == 1 {
        return None;
    }
    let (head, rest) = piece.split_at(start);
    let attributes: Vec<Attribute> = head.iter().filter_map(attribute).collect();
    let qualifiers = head.iter().filter(|tree| is_word(tree, &["pub", "const"]));
    let is_name = |tree: &TokenTree| read_as::<Ident>(tree.clone().into());
    let before_parameters = rest.iter().take_while(|tree| !matches!(tree, TokenTree::Group(_)));
    // The last name before the parameters is that of the function.
    let names = before_parameters.enumerate().filter_map(|(index, tree)| Some((index, is_name(tree)?)));
    let (named, name) = names.last().unwrap_or_else(|| (0, unnamed(index, rest[0].span())));
    let mut signature: Vec<TokenTree> = rest[named + 1..].to_vec();
    let is_brace =
        |tree: &TokenTree| matches!(tree, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace);
    let body = signature.pop_if(|tree| is_brace(tree)).map_or_else(TokenStream::new, TokenStream::from);
    let rest: TokenStream = signature.iter().cloned().collect();
    let mut function = match syn::parse2::<ImplItemFn>(quote!(#(#qualifiers)* fn #name #rest {})) {
        Ok(function) => function,
        Err(_) => declared(name, signature)?,
    };
    function.attrs = attributes;
    // The tokens keep their delimiters, whose spans the compiler's message has.
    function.block.stmts = vec![Stmt::Expr(Expr::Verbatim(body), None)];
    Some(function)
}

/// The attribute in brackets, from the first token where it can be read. If there are several ways to read
/// it, the one that is a role.
fn attribute(tree: &TokenTree) -> Option<Attribute> {
    let TokenTree::Group(group) = tree else { return None };
    if group.delimiter() != Delimiter::Bracket {
        return None;
    }
    let inside: Vec<TokenTree> = group.stream().into_iter().collect();
    let from = |start: usize| {
        let tokens: TokenStream = inside[start..].iter().cloned().collect();
        Attribute::parse_outer.parse2(quote!(#[#tokens])).ok()?.pop()
    };
    let role = |start: usize| {
        let word = &inside[start];
        let attribute = Attribute::parse_outer.parse2(quote!(#[#word])).ok()?.pop();
        attribute.filter(role::is_role)
    };
    let read: Vec<Attribute> = (0..inside.len()).filter_map(from).collect();
    let known = read.iter().find(|attribute| role::is_role(attribute)).or(read.first());
    known.cloned().or_else(|| (0..inside.len()).find_map(role))
}

/// A function with the parameters and the return type that can be read.
fn declared(name: Ident, signature: Vec<TokenTree>) -> Option<ImplItemFn> {
    let is_list = |tree: &TokenTree| matches!(tree, TokenTree::Group(group) if group.delimiter() == Delimiter::Parenthesis);
    let open = signature.iter().position(is_list);
    let parameters = open.map_or_else(TokenStream::new, |open| match &signature[open] {
        TokenTree::Group(group) => group.stream(),
        _ => TokenStream::new(),
    });
    let parameters: Punctuated<FnArg, Token![,]> =
        between_commas(parameters).into_iter().filter_map(read_as::<FnArg>).collect();
    let behind = &signature[open.map_or(0, |open| open + 1)..];
    let bounds = behind.iter().position(|tree| is_word(tree, &["where"])).unwrap_or(behind.len());
    let output = readable::<Type>(&behind[..bounds]).or_else(|| readable(&behind[bounds..]));
    let output = output.map(|output| quote!(-> #output));
    syn::parse2(quote!(pub fn #name(#parameters) #output {})).ok()
}
