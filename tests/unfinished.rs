//! The compiler's messages while a description is being written: a token is missing or too many, and every
//! error stands in the description, never where a program uses its system.
//!
//! `CASES=1000 cargo test --test unfinished -- --nocapture` tries more and prints counts.

#[path = "ui/cases/mod.rs"]
#[allow(dead_code)]
mod cases;
#[path = "../lagrange-codegen/tests/editor/damage.rs"]
#[allow(dead_code)]
mod damage;
#[path = "../lagrange-codegen/tests/editor/descriptions.rs"]
mod descriptions;
#[path = "../lagrange-codegen/tests/fuzz/mutation.rs"]
#[allow(dead_code)]
mod mutation;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use cases::compiler::{report, text};
use damage::damaged;
use descriptions::MORE;
use mutation::{ACCEPTED, Random};
use serde_json::Value;

/// The number of descriptions, unless `CASES` is another one.
const COUNT: u64 = 24;

/// A program behind a description, which uses its system.
fn program(name: &str) -> String {
    let system = if name == "Cart" { "Cart<f64>".to_owned() } else { name.to_owned() };
    format!(
        "fn uses(system: &{system}) -> Result<f64, MotionError<f64>> {{
    let start = State::at_rest(core::array::from_fn(|_| 0.5));
    let mut motion = system.simulate(start);
    motion.advance_to(1.0)?;
    let q: {name}Coordinates<f64> = start.q.into();
    let v: {name}Velocities<f64> = motion.state().v.into();
    let _ = (q, v, {system}::COORDINATES, {system}::STRUCTURE);
    let _ = (system.mass_matrix(motion.state()), system.momenta(motion.state()), system.kinetic_energy(&start));
    Ok(motion.energy())
}}

fn main() {{
    let _ = uses;
}}
"
    )
}

/// The line of a message in the source, if it has one.
fn line(message: &Value) -> Option<u64> {
    let spans = message["spans"].as_array()?;
    let primary = spans.iter().find(|span| span["is_primary"] == true)?;
    primary["line_start"].as_u64()
}

#[test]
fn errors_stand_in_the_description() {
    let count = std::env::var("CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(COUNT);
    let whole: Vec<_> = ACCEPTED.into_iter().chain(MORE).collect();
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join("unfinished.rs");
    let tokens = |text: &str| text.parse().expect("the description is made of tokens");
    let (mut by_number, mut elsewhere) = (BTreeMap::<usize, u32>::new(), Vec::new());
    for seed in 0..count {
        let mut random = Random::new(seed);
        let (structure, args, item) = whole[random.below(whole.len())];
        let name = structure.split_whitespace().nth(2).unwrap_or_default();
        let name = name.split('<').next().unwrap_or_default();
        let damaged = damaged(tokens(args), tokens(item), &mut random);
        let description = format!("#[lagrangian({})]\n{}", damaged.args, damaged.item);
        let before = format!("use lagrangian::prelude::*;\n\n{structure}\n\n{description}\n\n");
        let end = before.lines().count() as u64;
        fs::write(&source, before + &program(name)).expect("the crate can be written");
        let messages = report(&source, "bin", "metadata");
        let errors = messages.iter().filter(|message| message["level"] == "error" && line(message).is_some());
        let errors: Vec<&Value> = errors.collect();
        *by_number.entry(errors.len()).or_default() += 1;
        let found = errors.iter().filter(|error| line(error).is_some_and(|line| line > end));
        elsewhere.extend(found.map(|error| format!("{seed}: {description}\n{}", text(error))));
    }
    println!("descriptions by their number of errors: {by_number:?}");
    assert!(elsewhere.is_empty(), "{} errors\n{}", elsewhere.len(), elsewhere.join("\n"));
}
