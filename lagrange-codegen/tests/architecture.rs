//! Rules of the source tree that a machine can keep: layers, sizes, hash maps.

use std::fs;
use std::path::{Path, PathBuf};

/// Lower layers first; a module may name only modules of its own and lower layers.
const LAYERS: [(&str, u32); 18] = [
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

/// The Rust files in a folder and those below it, what was built left out.
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

fn sources() -> Vec<(String, PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    rust_files(&root)
        .into_iter()
        .map(|path| {
            let inner = path.strip_prefix(&root).expect("the file is below src");
            let module = inner.iter().next().expect("the path has a component").to_string_lossy();
            let text = fs::read_to_string(&path).expect("the file is text");
            (module.trim_end_matches(".rs").to_owned(), path, text)
        })
        .collect()
}

/// The first segments of all paths that start with `crate::`.
fn named_modules(text: &str) -> Vec<String> {
    let mut named = Vec::new();
    for part in text.split("crate::").skip(1) {
        let group: &str = if part.starts_with('{') { part.split('}').next().unwrap_or(part) } else { part };
        for name in group.trim_start_matches('{').split(',') {
            let name: String = name.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            named.push(name);
            if !part.starts_with('{') {
                break;
            }
        }
    }
    named
}

fn layer(module: &str) -> Option<u32> {
    LAYERS.iter().find(|(name, _)| *name == module).map(|&(_, layer)| layer)
}

#[test]
fn modules_name_only_lower_layers() {
    for (module, path, text) in sources() {
        let Some(own) = layer(&module) else { continue };
        for named in named_modules(&text) {
            let Some(other) = layer(&named) else { continue };
            assert!(
                other < own || named == module,
                "{}: `{module}` names `{named}`, which is not below it",
                path.display()
            );
        }
    }
}

#[test]
fn every_module_has_a_layer() {
    for (module, path, _) in sources() {
        let known = layer(&module).is_some() || ["lib", "expand"].contains(&module.as_str());
        assert!(known, "{}: give the module a layer", path.display());
    }
}

#[test]
fn the_mathematical_core_knows_no_tokens() {
    for (module, path, text) in sources() {
        if TOKEN_FREE.contains(&module.as_str()) {
            for token_crate in ["syn::", "quote::", "proc_macro2::"] {
                assert!(!text.contains(token_crate), "{} names {token_crate}", path.display());
            }
        }
    }
}

#[test]
fn files_are_read_in_one_sitting() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folders = [
        "cargo-lagrange/src",
        "lagrange-codegen/src",
        "lagrange-macros/src",
        "lagrange-runtime/src",
        "src",
        "examples",
        "firmware",
    ];
    for path in folders.iter().flat_map(|folder| rust_files(&root.join(folder))) {
        let text = fs::read_to_string(&path).expect("the file is text");
        assert!(text.lines().count() <= 400, "{} has more than 400 lines", path.display());
        assert!(text.starts_with("//!"), "{} does not say what it is for", path.display());
    }
}

#[test]
fn hash_maps_cannot_be_iterated() {
    for (module, path, text) in sources() {
        if module != "collections" {
            let names = text.contains("HashMap") || text.contains("HashSet");
            assert!(!names, "{} names a hash map: use `Lookup`", path.display());
        }
    }
}

#[test]
fn the_rules_catch_a_planted_fault() {
    assert_eq!(
        named_modules("use crate::emit::emit; use crate::{lower, mechanics};"),
        ["emit", "lower", "mechanics"]
    );
    assert!(layer("emit") > layer("expr"));
}
