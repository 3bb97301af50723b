//! Which modules a module names: use trees and paths, relative ones and renamed ones included.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, TokenTree};

use crate::tree::Module;

/// A path as it is written, and the name that it gets by a `use`.
struct Named {
    segments: Vec<String>,
    /// The name in scope; `*` for all names of a module; none outside of `use`.
    name: Option<String>,
}

/// The modules of a crate and what their names stand for.
pub struct Names {
    modules: BTreeMap<Vec<String>, Scope>,
}

/// The meanings of names in a module.
#[derive(Default)]
struct Scope {
    children: BTreeSet<String>,
    /// Names from `use`, with the paths that are written there.
    imports: BTreeMap<String, Vec<String>>,
    /// Modules from which `use …::*` takes all names.
    globs: Vec<Vec<String>>,
    written: Vec<Vec<String>>,
}

/// Renames may form rings; no honest chain is as long.
const LONGEST_CHAIN: usize = 20;

impl Names {
    pub fn new(modules: &[Module]) -> Self {
        let mut scopes = BTreeMap::new();
        for module in modules {
            let mut scope = Scope { children: module.children.clone(), ..Scope::default() };
            let mut named = Vec::new();
            paths(&module.tokens, &mut named);
            for Named { segments, name } in named {
                match name.as_deref() {
                    Some("*") => scope.globs.push(segments.clone()),
                    Some(name) => drop(scope.imports.insert(name.to_owned(), segments.clone())),
                    None => {}
                }
                scope.written.push(segments);
            }
            scopes.insert(module.path.clone(), scope);
        }
        Self { modules: scopes }
    }

    /// The paths of all modules.
    pub fn modules(&self) -> impl Iterator<Item = &Vec<String>> {
        self.modules.keys()
    }

    /// The modules in which the items stand that a module names, except the module itself.
    pub fn named_by(&self, module: &[String]) -> BTreeSet<Vec<String>> {
        let written = &self.modules[module].written;
        let found = written.iter().filter_map(|path| self.resolve(module, path, LONGEST_CHAIN));
        found.filter(|named| named != module).collect()
    }

    /// The module in which the item of a path stands; none of another crate.
    fn resolve(&self, at: &[String], path: &[String], chain: usize) -> Option<Vec<String>> {
        let chain = chain.checked_sub(1)?;
        let (first, rest) = path.split_first()?;
        let mut here = match first.as_str() {
            "crate" => Vec::new(),
            "self" => at.to_vec(),
            "super" => at.split_last()?.1.to_vec(),
            _ => {
                let scope = &self.modules[at];
                if scope.children.contains(first) {
                    return self.descend(at.to_vec(), path, chain);
                }
                let target = scope.imports.get(first)?;
                // `use first;` and `use first::…` of another crate.
                if target.first() == Some(first) {
                    return None;
                }
                let whole = [target.as_slice(), rest].concat();
                return self.resolve(at, &whole, chain);
            }
        };
        let mut rest = rest;
        while let Some((word, after)) = rest.split_first() {
            match word.as_str() {
                "super" => drop(here.pop()?),
                "self" => {}
                _ => break,
            }
            rest = after;
        }
        self.descend(here, rest, chain)
    }

    /// Follows names from a module down, through what is exported again.
    fn descend(&self, mut here: Vec<String>, path: &[String], chain: usize) -> Option<Vec<String>> {
        for (place, name) in path.iter().enumerate() {
            let scope = &self.modules[&here];
            if scope.children.contains(name) {
                here.push(name.clone());
                continue;
            }
            let rest = &path[place + 1..];
            if let Some(target) = scope.imports.get(name) {
                let whole = [target.as_slice(), rest].concat();
                return self.resolve(&here, &whole, chain).or(Some(here));
            }
            break;
        }
        Some(here)
    }

    /// The modules, other than children, from which a module takes all names: that hides which names it
    /// takes.
    pub fn globs(&self, module: &[String]) -> Vec<String> {
        let foreign = |path: &&Vec<String>| self.resolve(module, path, LONGEST_CHAIN).is_some();
        self.modules[module].globs.iter().filter(foreign).map(|path| path.join("::")).collect()
    }

    /// Rings of modules with one parent, below the root, that need each other, each as the names of its
    /// members.
    pub fn rings(&self) -> Vec<Vec<String>> {
        let mut found = Vec::new();
        // Modules at the root have layers instead.
        for (parent, scope) in self.modules.iter().filter(|(parent, _)| !parent.is_empty()) {
            let mut needs: BTreeMap<&String, BTreeSet<&String>> = BTreeMap::new();
            for child in &scope.children {
                let whole = [parent.as_slice(), std::slice::from_ref(child)].concat();
                let inside = self.modules.keys().filter(|path| path.starts_with(&whole));
                let named = inside.flat_map(|path| self.named_by(path));
                let siblings = named
                    .filter(|path| path.starts_with(parent))
                    .filter_map(|path| scope.children.get(path.get(parent.len())?));
                needs.insert(child, siblings.filter(|sibling| *sibling != child).collect());
            }
            let reach = |from: &String| {
                let (mut seen, mut open) = (BTreeSet::new(), vec![from.clone()]);
                while let Some(next) = open.pop() {
                    for &sibling in &needs[&next] {
                        if seen.insert(sibling.clone()) {
                            open.push(sibling.clone());
                        }
                    }
                }
                seen
            };
            let reached: BTreeMap<&String, BTreeSet<String>> =
                scope.children.iter().map(|child| (child, reach(child))).collect();
            let mut told = BTreeSet::new();
            for child in &scope.children {
                if !reached[child].contains(child) || told.contains(child) {
                    continue;
                }
                let members: Vec<String> =
                    reached[child].iter().filter(|other| reached[other].contains(child)).cloned().collect();
                told.extend(members.iter().cloned());
                let name =
                    |member: &String| [parent.as_slice(), std::slice::from_ref(member)].concat().join("::");
                found.push(members.iter().map(name).collect());
            }
        }
        found
    }
}

/// All paths that stand in tokens and may name a module.
fn paths(tokens: &[TokenTree], found: &mut Vec<Named>) {
    let mut place = 0;
    while place < tokens.len() {
        match &tokens[place] {
            TokenTree::Group(group) => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                paths(&inner, found);
                place += 1;
            }
            // `use<…>` tells what a type captures.
            TokenTree::Ident(word) if *word == "use" && !is_mark(tokens.get(place + 1), '<') => {
                let end = tokens[place..].iter().position(|token| is_mark(Some(token), ';'));
                let end = end.map_or(tokens.len(), |end| place + end);
                tree(&tokens[place + 1..end], &[], found);
                place = end;
            }
            TokenTree::Ident(_) => {
                let mut segments = Vec::new();
                while let Some(TokenTree::Ident(word)) = tokens.get(place) {
                    segments.push(word.to_string());
                    place += 1;
                    if !is_path_separator(tokens, place) {
                        break;
                    }
                    place += 2;
                }
                // One word names no module: `pub(crate)`.
                if segments.len() > 1 {
                    found.push(Named { segments, name: None });
                }
            }
            _ => place += 1,
        }
    }
}

/// The paths of a use tree.
fn tree(tokens: &[TokenTree], prefix: &[String], found: &mut Vec<Named>) {
    let mut segments = prefix.to_vec();
    let mut name = None;
    let mut place = 0;
    while place < tokens.len() {
        match &tokens[place] {
            TokenTree::Ident(word) if *word == "as" => {
                name = tokens.get(place + 1).map(ToString::to_string);
                place += 2;
            }
            TokenTree::Ident(word) => {
                segments.push(word.to_string());
                place += 1;
            }
            TokenTree::Punct(mark) if mark.as_char() == '*' => {
                name = Some("*".to_owned());
                place += 1;
            }
            TokenTree::Punct(_) => place += 1,
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                for branch in inner.split(|token| is_mark(Some(token), ',')) {
                    if !branch.is_empty() {
                        tree(branch, &segments, found);
                    }
                }
                return;
            }
            _ => place += 1,
        }
    }
    // `a::{self}` is `a`.
    if segments.len() > 1 && segments.last().is_some_and(|last| last == "self") {
        segments.pop();
    }
    let name = name.or_else(|| segments.last().cloned());
    found.push(Named { segments, name });
}

fn is_mark(token: Option<&TokenTree>, expected: char) -> bool {
    matches!(token, Some(TokenTree::Punct(mark)) if mark.as_char() == expected)
}

fn is_path_separator(tokens: &[TokenTree], place: usize) -> bool {
    is_mark(tokens.get(place), ':')
        && is_mark(tokens.get(place + 1), ':')
        && matches!(tokens.get(place + 2), Some(TokenTree::Ident(_)))
}
