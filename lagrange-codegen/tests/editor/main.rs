//! Descriptions while they are written: a token is missing or too many, and the items that the rest of a
//! program uses are still there.
//!
//! A description owes all items except those that the missing token alone declares: items named after a
//! deleted name, and items that follow from a deleted role or key.
//!
//! `CASES=100000 cargo test --release -p lagrange-codegen --test editor -- --nocapture` tries more and prints
//! shares.

// Its changes are coarser.
#[allow(dead_code)]
#[path = "../fuzz/mutation.rs"]
mod mutation;

mod damage;
mod descriptions;
mod items;

use std::collections::BTreeMap;
use std::fmt;

use damage::{Damaged, Part, damaged};
use descriptions::MORE;
use items::Items;
use mutation::{ACCEPTED, Random};
use proc_macro2::TokenStream;

/// The number of descriptions, unless `CASES` is another one.
const COUNT: u64 = 1000;

/// Roles and arguments that declare items by themselves, and the one name in a list of inputs.
const DECLARE: [&str; 9] =
    ["point", "body", "holonomic", "nonholonomic", "eliminate", "event", "jacobians", "analysis", "motor"];

/// The numbers of descriptions that kept all items, and all that they owe.
#[derive(Default)]
struct Share {
    tried: u64,
    kept: u64,
    paid: u64,
    example: Option<String>,
}

/// Whether an item follows from more than the word that is gone.
fn is_owed(item: &str, gone: Option<&str>) -> bool {
    let named_after = |gone: &str| {
        [gone.into(), format!("reactions_on_{gone}"), format!("{gone}_velocity")].contains(&item.to_string())
    };
    gone.is_none_or(|gone| !DECLARE.contains(&gone) && !named_after(gone))
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let share = |count: u64| 100.0 * count as f64 / self.tried as f64;
        write!(
            f,
            "{} tried, {:.3} % kept all, {:.3} % all they owe",
            self.tried,
            share(self.kept),
            share(self.paid)
        )?;
        self.example.iter().try_for_each(|example| write!(f, ", not\n{example}"))
    }
}

fn expanded(args: TokenStream, item: TokenStream) -> TokenStream {
    lagrange_codegen::expand(args, item, "::lagrangian")
}

fn tokens(text: &str) -> TokenStream {
    text.parse().expect("the description is made of tokens")
}

#[test]
fn generated_items_outlive_what_is_being_written() {
    let count = std::env::var("CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(COUNT);
    let whole: Vec<_> = ACCEPTED.into_iter().chain(MORE).map(|(_, args, item)| (args, item)).collect();
    let declared: Vec<Items> =
        whole.iter().map(|(args, item)| Items::of(expanded(tokens(args), tokens(item)))).collect();
    let mut shares: BTreeMap<Part, Share> = BTreeMap::new();
    for seed in 0..count {
        let mut random = Random::new(seed);
        let case = random.below(whole.len());
        let (args, item) = whole[case];
        let Damaged { args, item, part, gone } = damaged(tokens(args), tokens(item), &mut random);
        let shown = format!("    #[lagrangian({args})] {item}");
        let found = Items::of(expanded(args, item));
        if found.is_accepted {
            // The change has made another valid description.
            continue;
        }
        let missing = declared[case].missing_in(&found);
        let owed: Vec<_> = missing.iter().filter(|item| is_owed(item, gone.as_deref())).collect();
        let share = shares.entry(part).or_default();
        share.tried += 1;
        share.kept += u64::from(missing.is_empty());
        share.paid += u64::from(owed.is_empty());
        if !owed.is_empty() {
            share.example = Some(format!("    {owed:?} in\n{shown}"));
        }
    }
    let all = shares.values().fold((0, 0), |(kept, tried), share| (kept + share.kept, tried + share.tried));
    for (part, share) in &shares {
        println!("{part:?}: {share}");
    }
    println!("all: {} of {} ({:.3} %)", all.0, all.1, 100.0 * all.0 as f64 / all.1 as f64);
    for (part, share) in &shares {
        assert!(share.paid == share.tried, "{part:?}: {share}");
    }
}
