//! The modules of a crate, read from its files as rustc reads them: tokens, without tests.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A module without the modules inside it.
pub struct Module {
    /// Its path from the root of the crate, which is empty.
    pub path: Vec<String>,
    pub file: PathBuf,
    /// Its tokens without inner modules and without items under `#[cfg(test)]`.
    pub tokens: Vec<TokenTree>,
    /// The names of inner modules.
    pub children: BTreeSet<String>,
}

/// All modules of the crate whose sources are in `folder`, `lib.rs` first.
pub fn modules(folder: &Path) -> Vec<Module> {
    let mut modules = Vec::new();
    load(&folder.join("lib.rs"), folder, Vec::new(), &mut modules);
    modules
}

/// The modules of one text, as if it were a crate; they must have bodies.
pub fn modules_of(text: &str) -> Vec<Module> {
    let mut modules = Vec::new();
    let tokens: TokenStream = text.parse().expect("the text is Rust");
    split(tokens, Path::new("text"), Path::new("nowhere"), Vec::new(), &mut modules);
    modules
}

fn load(file: &Path, folder: &Path, path: Vec<String>, modules: &mut Vec<Module>) {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let tokens = text.parse().unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    split(tokens, file, folder, path, modules);
}

/// Takes inner modules out of the tokens of a module; `folder` is where their files are.
fn split(tokens: TokenStream, file: &Path, folder: &Path, path: Vec<String>, modules: &mut Vec<Module>) {
    let place = modules.len();
    let file = file.to_owned();
    modules.push(Module {
        path: path.clone(),
        file: file.clone(),
        tokens: vec![],
        children: BTreeSet::new(),
    });
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let (mut kept, mut children) = (Vec::new(), BTreeSet::new());
    let mut rest = tokens.as_slice();
    while !rest.is_empty() {
        let (attributes, item) = attributes(rest);
        if attributes.iter().any(|attribute| attribute == "cfg (test)") {
            rest = &item[length(item)..];
        } else if let [TokenTree::Ident(word), TokenTree::Ident(name), body, ..] = item
            && *word == "mod"
        {
            let name = name.to_string();
            let path = [path.as_slice(), std::slice::from_ref(&name)].concat();
            let inner = folder.join(&name);
            match body {
                TokenTree::Group(body) => split(body.stream(), &file, &inner, path, modules),
                _ => {
                    let alone = folder.join(format!("{name}.rs"));
                    let file = if alone.exists() { alone } else { inner.join("mod.rs") };
                    load(&file, &inner, path, modules);
                }
            }
            children.insert(name);
            rest = &item[3..];
        } else {
            // Attributes may name things as well.
            let taken = rest.len() - item.len() + usize::from(!item.is_empty());
            kept.extend_from_slice(&rest[..taken]);
            rest = &rest[taken..];
        }
    }
    (modules[place].tokens, modules[place].children) = (kept, children);
}

/// The attributes that tokens begin with, as text, and what follows them.
fn attributes(mut tokens: &[TokenTree]) -> (Vec<String>, &[TokenTree]) {
    let mut found = Vec::new();
    while let [TokenTree::Punct(hash), TokenTree::Group(group), rest @ ..] = tokens
        && hash.as_char() == '#'
        && group.delimiter() == Delimiter::Bracket
    {
        found.push(group.stream().to_string());
        tokens = rest;
    }
    (found, tokens)
}

/// How many tokens belong to the item that tokens begin with.
fn length(tokens: &[TokenTree]) -> usize {
    let is_import = |token: &TokenTree| matches!(token, TokenTree::Ident(word) if *word == "use");
    let imports = tokens.iter().take(3).any(is_import);
    let ends = |token: &TokenTree| match token {
        TokenTree::Punct(mark) => mark.as_char() == ';',
        TokenTree::Group(group) => group.delimiter() == Delimiter::Brace && !imports,
        _ => false,
    };
    tokens.iter().position(ends).map_or(tokens.len(), |end| end + 1)
}
