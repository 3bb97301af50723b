//! Descriptions after random changes: every one is expanded or refused, none panics, none takes long.
//!
//! `cargo run --release -p lagrange-codegen --example fuzz -- 1000000` does the same for longer.

mod mutation;

use std::time::{Duration, Instant};

use mutation::{ACCEPTED, Random, is_accepted, mutated};
use proc_macro2::TokenStream;

/// The number of descriptions; the example takes any number.
const COUNT: u64 = 2000;

#[test]
fn what_is_not_refused_is_expanded() {
    let mut accepted = 0;
    for seed in 0..COUNT {
        let mut random = Random::new(seed);
        let (_, args, item) = ACCEPTED[random.below(ACCEPTED.len())];
        let parse = |text: &str| text.parse::<TokenStream>().expect("the description is made of tokens");
        let item = mutated(parse(item), &mut random);
        let (shown, start) = (item.to_string(), Instant::now());
        let expansion = lagrange_codegen::expand(parse(args), item, "::lagrangian").to_string();
        assert!(!expansion.contains("without knowing why"), "seed {seed}: a panic on\n{shown}");
        assert!(start.elapsed() < Duration::from_secs(20), "seed {seed}: {:?} on\n{shown}", start.elapsed());
        accepted += u64::from(is_accepted(&expansion));
    }
    // Some changes are harmless, most are not.
    assert!(accepted > COUNT / 50 && accepted < COUNT / 2, "{accepted} accepted");
}

#[test]
fn the_descriptions_themselves_are_accepted() {
    for (_, args, item) in ACCEPTED {
        let [args, item] = [args, item].map(|text| text.parse::<TokenStream>().expect("tokens"));
        let expansion = lagrange_codegen::expand(args, item, "::lagrangian").to_string();
        assert!(is_accepted(&expansion), "{expansion}");
    }
}
