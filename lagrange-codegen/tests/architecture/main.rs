//! Rules of the source trees that a machine can keep: layers, rings, tokens, sizes, widths, hash maps.
//! Sources are read as tokens, so that no way to write a path escapes.

mod imports;
mod tree;

use std::fs;
use std::path::{Path, PathBuf};

use imports::Names;
use proc_macro2::TokenTree;
use tree::{Module, modules, modules_of};

/// The engine: lower layers first. A module may name only its own room and rooms of lower layers.
const ENGINE: [(&str, u32); 19] = [
    ("collections", 0),
    ("number", 0),
    ("diagnostics", 0),
    ("expr", 1),
    ("model", 2),
    ("calculus", 2),
    ("simplify", 3),
    ("kinematics", 3),
    ("syntax", 3),
    ("lower", 4),
    ("mechanics", 4),
    ("eliminate", 5),
    ("structure", 5),
    ("schedule", 5),
    ("jets", 6),
    ("orders", 7),
    ("regimes", 8),
    ("emit", 9),
    ("expand", 10),
];

/// The runtime: the same.
const RUNTIME: [(&str, u32); 9] = [
    ("number", 0),
    ("linear", 1),
    ("series", 1),
    ("system", 2),
    ("constraints", 3),
    ("integrator", 4),
    ("motion", 5),
    ("switching", 6),
    ("analysis", 6),
];

/// Modules that name something above them, and why.
const DEBTS: [(&str, &str, &str); 2] = [
    ("system", "motion::simulation", "`System::simulate`: one import gives a system and its motions"),
    ("system", "motion::stepper", "`System::stepper`: the same"),
];

/// Modules beside each other that need each other.
const RINGS: [&str; 12] = [
    "emit::eliminated, emit::methods",
    "emit::constraints::methods, emit::constraints::places",
    "lower::coordinates, lower::interpreter, lower::parameter, lower::quaternion, lower::scalar, lower::scope, \
     lower::shape, lower::value",
    "mechanics::equations, mechanics::forces",
    "syntax::args, syntax::body, syntax::constant, syntax::friction, syntax::hygiene, syntax::item, syntax::translate, syntax::types",
    "analysis::sensitive, analysis::variational",
    "analysis::modes::spectrum, analysis::modes::vectors",
    "constraints::retraction, constraints::solution, constraints::stages, constraints::start",
    "integrator::dense, integrator::dop853",
    "linear::saddle, linear::schur",
    "motion::roots::pieces, motion::roots::polynomial, motion::roots::zeros",
    "switching::hybrid, switching::run, switching::standstill",
];

/// Modules that know no tokens.
const TOKEN_FREE: [&str; 14] = [
    "collections",
    "number",
    "expr",
    "model",
    "calculus",
    "kinematics",
    "simplify",
    "eliminate",
    "mechanics",
    "structure",
    "schedule",
    "jets",
    "orders",
    "regimes",
];

/// Folders whose files people read from start to end.
const LIBRARIES: [&str; 13] = [
    "cargo-lagrange/src",
    "lagrange-codegen/src",
    "lagrange-macros/src",
    "lagrange-runtime/src",
    "src",
    "examples",
    "firmware",
    "gallery/src",
    "lagrange-ensemble/src",
    "lagrange-gpu/src",
    "lagrange-gpu/kernels",
    "lagrange-mpi/src",
    "lagrange-pictures/src",
];

/// The Rust files below a folder, except build outputs.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the entry can be read").path();
        if path.is_dir() && !path.ends_with("target") {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn engine() -> Vec<Module> {
    modules(&root().join("lagrange-codegen/src"))
}

fn runtime() -> Vec<Module> {
    modules(&root().join("lagrange-runtime/src"))
}

/// Every name of something above: the module, what it names.
fn upward(names: &Names, layers: &[(&str, u32)]) -> Vec<(String, String)> {
    let layer = |room: &str| layers.iter().find(|(name, _)| *name == room).map(|&(_, layer)| layer);
    let mut found = Vec::new();
    // The root of a crate may name everything, and nobody the root.
    for module in names.modules().filter(|module| !module.is_empty() && module[0] != "__private") {
        let own = layer(&module[0]).unwrap_or_else(|| panic!("give the module `{}` a layer", module[0]));
        for named in names.named_by(module) {
            let is_below = |room: &String| *room == module[0] || layer(room).is_some_and(|other| other < own);
            if !named.first().is_some_and(is_below) {
                found.push((module.join("::"), named.join("::")));
            }
        }
    }
    found
}

#[test]
fn modules_name_only_lower_layers() {
    assert_eq!(upward(&Names::new(&engine()), &ENGINE), []);
    let debts: Vec<_> =
        DEBTS.iter().map(|(module, named, _)| (module.to_string(), named.to_string())).collect();
    assert_eq!(upward(&Names::new(&runtime()), &RUNTIME), debts);
}

#[test]
fn no_module_takes_all_names_of_another() {
    for module in [engine(), runtime()] {
        let names = Names::new(&module);
        for module in names.modules() {
            assert_eq!(names.globs(module), [""; 0], "in {}", module.join("::"));
        }
    }
}

#[test]
fn modules_beside_each_other_form_no_rings() {
    let rings = [engine(), runtime()].map(|modules| Names::new(&modules).rings());
    let rings: Vec<String> = rings.concat().iter().map(|ring| ring.join(", ")).collect();
    assert_eq!(rings, RINGS);
}

/// All identifiers in tokens.
fn words(tokens: impl IntoIterator<Item = TokenTree>, found: &mut Vec<String>) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => words(group.stream(), found),
            TokenTree::Ident(word) => found.push(word.to_string()),
            _ => {}
        }
    }
}

/// Whether a module names one of these.
fn says(module: &Module, names: &[&str]) -> bool {
    let mut found = Vec::new();
    words(module.tokens.iter().cloned(), &mut found);
    found.iter().any(|word| names.contains(&word.as_str()))
}

#[test]
fn the_mathematical_core_knows_no_tokens() {
    for module in engine() {
        if module.path.first().is_some_and(|room| TOKEN_FREE.contains(&room.as_str())) {
            let names = says(&module, &["syn", "quote", "proc_macro2"]);
            assert!(!names, "{} names a crate of tokens", module.file.display());
        }
    }
}

#[test]
fn files_are_read_in_one_sitting() {
    for path in LIBRARIES.iter().flat_map(|folder| rust_files(&root().join(folder))) {
        let text = fs::read_to_string(&path).expect("the file is text");
        assert!(text.lines().count() <= 400, "{} has more than 400 lines", path.display());
        assert!(text.starts_with("//!"), "{} does not say what it is for", path.display());
    }
}

/// Columns of a line, as `rustfmt.toml` has it for code. Tables are as wide as they are.
const COLUMNS: usize = 110;

#[test]
fn comments_are_no_wider_than_code() {
    let mut wide = Vec::new();
    for path in LIBRARIES.iter().flat_map(|folder| rust_files(&root().join(folder))) {
        let text = fs::read_to_string(&path).expect("the file is text");
        for (line, number) in text.lines().zip(1..) {
            let is_wide = line.trim_start().starts_with("//") && line.chars().count() > COLUMNS;
            let is_table = line.trim_start().trim_start_matches(['/', '!', ' ']).starts_with('|');
            if is_wide && !is_table {
                wide.push(format!("{}:{number}", path.display()));
            }
        }
    }
    assert!(wide.is_empty(), "wider than {COLUMNS} columns:\n{}", wide.join("\n"));
}

#[test]
fn hash_maps_cannot_be_iterated() {
    for module in engine() {
        if module.path.first().is_none_or(|room| room != "collections") {
            let names = says(&module, &["HashMap", "HashSet"]);
            assert!(!names, "{} names a hash map: use `Lookup`", module.file.display());
        }
    }
}

/// The names above it in a module `low` with this text, where `high` is above and has `high::inner::thing`.
fn planted(text: &str) -> Vec<String> {
    let high = "pub use inner::thing; pub mod inner { pub fn thing() {} }";
    let low = format!("pub mod beside {{ pub fn own() {{}} }} {text}");
    let crate_text = format!("pub use high::inner as door; mod high {{ {high} }} mod low {{ {low} }}");
    let names = Names::new(&modules_of(&crate_text));
    upward(&names, &[("low", 0), ("high", 1)]).into_iter().map(|(_, named)| named).collect()
}

#[test]
fn the_rules_catch_planted_faults() {
    for fault in [
        "use crate::high::inner::thing;",
        "use crate::{low::{beside::own}, high::{inner}};",
        "use crate::{low::beside::own, high::inner::{self as friend}};",
        "mod deep { mod deeper { use super::super::super::high::thing; } }",
        "use crate as top; fn f() { top::high::thing() }",
        "use super::high as friend; fn f() { friend::thing() }",
        "fn f() { print!(\"{}\", crate::high::inner::thing()) }",
        "fn f() { use crate::high::thing as t; t() }",
        "pub use crate::door::thing;",
        "macro_rules! m { () => { $crate::high::inner::thing() } }",
    ] {
        let found = planted(fault);
        assert!(found.contains(&"high::inner".to_owned()), "{fault}: {found:?}");
    }
    let allowed = "use core::fmt; use beside::own; use self::beside as b; fn f() { b::own(); fmt::write() }
        #[cfg(test)] use crate::{high::thing, high}; #[cfg(test)] mod tests { use crate::high::thing; }
        // crate::high::thing
        /// crate::high::thing
        const S: &str = \"crate::high::thing\"; fn g<'a>() -> impl Sized + use<'a> {}";
    assert_eq!(planted(allowed), [""; 0]);
    assert_eq!(planted("use crate::high::*;").len(), 1);
}

#[test]
fn rings_are_found() {
    let crate_text =
        "mod a { mod x { use super::y; } mod y { use super::z::f; } mod z { fn f() { super::x::g() } }
        mod w { use super::x; } }";
    let names = Names::new(&modules_of(crate_text));
    assert_eq!(names.rings(), [["a::x", "a::y", "a::z"]]);
}

#[test]
fn words_are_found_in_macros_and_renames() {
    let crate_text = "mod a { use proc_macro2 as pm; } mod b { fn f() { quote::quote!(x) } }
        mod c { const S: &str = \"syn\"; }";
    let found: Vec<bool> = modules_of(crate_text)
        .iter()
        .skip(1)
        .map(|module| says(module, &["quote", "proc_macro2", "syn"]))
        .collect();
    assert_eq!(found, [true, true, false]);
}
