//! Random changes of accepted descriptions through the expansion: none may panic or take long.
//!
//! `cargo run --release -p lagrange-codegen --example fuzz -- COUNT [SEED] [FOLDER]`; the first thousand that
//! are accepted go into the folder as Rust modules, for rustc to check.

#[path = "../tests/fuzz/mutation.rs"]
mod mutation;

use std::io::Write;
use std::time::Instant;

use mutation::{ACCEPTED, Random, is_accepted, mutated};
use proc_macro2::TokenStream;

/// After so many descriptions a line of counts is printed. It tells how far a run came that ends early.
const REPORTED: u64 = 50_000;

/// The macro's words about a panic of its own.
const UNEXPLAINED: &str = "without knowing why";

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |place: usize, default: u64| {
        arguments.get(place).and_then(|text| text.parse().ok()).unwrap_or(default)
    };
    let (count, first) = (number(1, 100_000), number(2, 0));
    let folder = arguments.get(3);
    let (mut accepted, mut panics, mut longest, mut slowest, mut written) = (0_u64, 0_u64, 0.0_f64, first, 0);
    for seed in first..first + count {
        let mut random = Random::new(seed);
        let (fields, args, item) = ACCEPTED[random.below(ACCEPTED.len())];
        let parse = |text: &str| text.parse::<TokenStream>().unwrap_or_default();
        let item = mutated(parse(item), &mut random);
        let (shown, start) = (item.to_string(), Instant::now());
        let expand = || lagrange_codegen::expand(parse(args), item, "::lagrangian").to_string();
        let expansion = std::panic::catch_unwind(std::panic::AssertUnwindSafe(expand));
        let expansion = expansion.unwrap_or_else(|_| UNEXPLAINED.to_string());
        let seconds = start.elapsed().as_secs_f64();
        if expansion.contains(UNEXPLAINED) {
            panics += 1;
            println!("PANIC seed {seed}\n{shown}\n");
        }
        if seconds > longest {
            (longest, slowest) = (seconds, seed);
            println!("longest so far {seconds:.2} s, seed {seed}");
        }
        if (seed + 1 - first).is_multiple_of(REPORTED) {
            println!("{} descriptions, {accepted} accepted, {panics} panics", seed + 1 - first);
        }
        if is_accepted(&expansion) {
            accepted += 1;
            if let Some(folder) = folder.filter(|_| written < 1000) {
                let text = format!("use lagrangian::prelude::*;\n{fields}\n#[lagrangian({args})]\n{shown}\n");
                let file = std::fs::File::create(format!("{folder}/m{written}.rs"));
                if file.and_then(|mut file| file.write_all(text.as_bytes())).is_ok() {
                    written += 1;
                }
            }
        }
    }
    println!("{count} descriptions, {accepted} accepted, {panics} panics");
    println!("the longest took {longest:.2} s, seed {slowest}");
}
