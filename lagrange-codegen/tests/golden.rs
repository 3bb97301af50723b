//! Expansions of a few systems, reviewed as text: `golden/<case>.in.rs` → `golden/<case>.out.rs`.
//!
//! `UPDATE_GOLDEN=1 cargo test -p lagrange-codegen --test golden` rewrites them; review the difference.

use std::fs;
use std::path::Path;

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Item, Meta};

fn expansion(source: &str) -> String {
    let file: syn::File = syn::parse_str(source).expect("the description is Rust");
    let Some(Item::Impl(mut block)) = file.items.into_iter().next() else {
        panic!("the file holds one impl block")
    };
    let Meta::List(arguments) = block.attrs.remove(0).meta else {
        panic!("the first attribute is the macro's")
    };
    let tokens: TokenStream =
        lagrange_codegen::expand(arguments.tokens, block.into_token_stream(), "::lagrangian");
    prettyplease::unparse(&syn::parse2(tokens).expect("the expansion is Rust"))
}

fn check(case: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
    let source = fs::read_to_string(folder.join(format!("{case}.in.rs"))).expect("the description exists");
    let found = expansion(&source);
    assert!(!found.contains("compile_error"), "{found}");
    let golden = folder.join(format!("{case}.out.rs"));
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(golden, found).expect("the golden file can be written");
        return;
    }
    let expected = fs::read_to_string(golden).expect("the golden file exists");
    assert_eq!(found, expected, "the expansion of {case} changed; see the head of this file");
}

#[test]
fn double_pendulum() {
    check("double_pendulum");
}

#[test]
fn cart_pole() {
    check("cart_pole");
}

#[test]
fn heavy_top() {
    check("heavy_top");
}

#[test]
fn elastic_pendulum_with_jacobians() {
    check("elastic_pendulum");
}

#[test]
fn cartesian_pendulum_with_a_constraint() {
    check("cartesian_pendulum");
}

#[test]
fn rotating_pendulum_with_analysis() {
    check("rotating_pendulum");
}
