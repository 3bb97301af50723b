//! No variable of a user takes a name that a generated body binds for itself, such as `coupling`.
//!
//! The descriptions of tests and examples are expanded. A name that a function binds beside the user's, and of
//! which no word stands in the description, is the emitter's own. A coordinate of that name must get another
//! one.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote};
use syn::visit_mut::{self, VisitMut};
use syn::{File, ImplItemFn, ItemImpl, Meta, PatIdent};

/// Words that name a result by themselves. `Names::claim` gives them away, so they are always free.
const CLAIMED: [&str; 3] = ["impulse", "numbers", "x"];

/// Arguments of generated functions, which descriptions have too.
const ARGUMENTS: [&str; 6] = ["t", "q", "v", "u", "state", "inputs"];

/// The descriptions of a file: the arguments of the attribute, and the impl block.
#[derive(Default)]
struct Descriptions(Vec<(TokenStream, TokenStream)>);

impl VisitMut for Descriptions {
    fn visit_item_impl_mut(&mut self, block: &mut ItemImpl) {
        let is_ours = |path: &syn::Path| path.segments.last().is_some_and(|last| last.ident == "lagrangian");
        if let Some(at) = block.attrs.iter().position(|attribute| is_ours(attribute.path()))
            && let Meta::List(arguments) = block.attrs.remove(at).meta
        {
            self.0.push((arguments.tokens, block.to_token_stream()));
        }
    }
}

/// The names that each function binds.
#[derive(Default)]
struct Bound {
    functions: Vec<BTreeSet<String>>,
    is_inside: bool,
}

impl VisitMut for Bound {
    fn visit_impl_item_fn_mut(&mut self, function: &mut ImplItemFn) {
        self.functions.push(BTreeSet::new());
        let before = std::mem::replace(&mut self.is_inside, true);
        visit_mut::visit_impl_item_fn_mut(self, function);
        self.is_inside = before;
    }

    fn visit_pat_ident_mut(&mut self, pattern: &mut PatIdent) {
        if let Some(names) = self.functions.last_mut().filter(|_| self.is_inside) {
            names.insert(pattern.ident.to_string());
        }
        visit_mut::visit_pat_ident_mut(self, pattern);
    }
}

/// The words of a name, without numbers.
fn words(name: &str) -> impl Iterator<Item = String> {
    let parts = name.trim_start_matches("r#").split('_');
    let words = parts.map(|part| part.trim_end_matches(|c: char| c.is_numeric()).to_lowercase());
    words.filter(|word| !word.is_empty())
}

fn collect(tokens: TokenStream, found: &mut BTreeSet<String>) {
    for token in tokens {
        match token {
            TokenTree::Ident(ident) => found.extend(words(&ident.to_string())),
            TokenTree::Group(group) => collect(group.stream(), found),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

fn expanded(arguments: TokenStream, block: TokenStream) -> Vec<BTreeSet<String>> {
    let tokens = lagrange_codegen::expand(arguments, block, "::lagrangian");
    let mut file: File = syn::parse2(tokens).expect("the expansion is Rust");
    let mut bound = Bound::default();
    bound.visit_file_mut(&mut file);
    bound.functions
}

/// Adds the names that generated functions bind for themselves beside names of the user.
fn add_own_names(arguments: TokenStream, block: TokenStream, own: &mut BTreeSet<String>) {
    let mut theirs = BTreeSet::new();
    collect(arguments.clone(), &mut theirs);
    collect(block.clone(), &mut theirs);
    // Every description has these words of the language.
    theirs.retain(|word| !["coordinates", "velocities", "inputs"].contains(&word.as_str()));
    for names in expanded(arguments, block) {
        let (of_user, others): (Vec<String>, Vec<String>) =
            names.into_iter().partition(|name| words(name).any(|word| theirs.contains(&word)));
        // Results without the user's words are numbered, as `w1`, and have claimed their names.
        let is_word = |name: &String| name.chars().all(char::is_alphabetic);
        if of_user.iter().any(|name| !ARGUMENTS.contains(&name.as_str())) {
            own.extend(others.into_iter().filter(is_word));
        }
    }
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder exists") {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn names_of_generated_bodies_are_no_names_of_variables() {
    let engine = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for folder in ["../tests/integration", "../examples"] {
        sources(&engine.join(folder), &mut files);
    }
    let mut own = BTreeSet::new();
    let mut count = 0;
    for path in files {
        let text = fs::read_to_string(&path).expect("the file can be read");
        // Files of other forms, such as parts of a macro, hold no descriptions.
        let Ok(mut file) = syn::parse_file(&text) else { continue };
        let mut descriptions = Descriptions::default();
        descriptions.visit_file_mut(&mut file);
        for (arguments, block) in descriptions.0 {
            add_own_names(arguments, block, &mut own);
            count += 1;
        }
    }
    // Fewer descriptions would not bind these.
    assert!(count > 400 && own.contains("coupling") && own.contains("shares"), "{count}: {own:?}");
    let mut missing = Vec::new();
    for name in own.iter().filter(|name| !CLAIMED.contains(&name.as_str())) {
        let coordinate = format_ident!("{name}");
        let block = quote! {
            impl Spring {
                #[kinetic] fn motion(&self, v: &Velocities) -> f64 { 0.5 * v.#coordinate * v.#coordinate }
                #[potential] fn stretch(&self, q: &Coordinates) -> f64 { q.#coordinate.powi(4) }
            }
        };
        let bound = expanded(quote!(coordinates = [#coordinate]), block);
        let renamed = format!("{name}_2");
        if !bound.iter().any(|names| names.contains(&renamed)) {
            missing.push(name);
        }
    }
    assert!(missing.is_empty(), "not reserved: {missing:?}");
}
