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
use std::fmt::Display;
use std::fs;
use std::path::Path;

use cases::compiler::{report, text};
use damage::{Damaged, damaged};
use descriptions::MORE;
use mutation::{ACCEPTED, Random};
use serde_json::Value;

/// The number of descriptions, unless `CASES` is another one.
const COUNT: u64 = 24;

/// The first lines of a program. nalgebra has its macros behind a feature.
const HEAD: &str = "use lagrangian::prelude::*;

#[allow(unused_macros)]
macro_rules! vector {
    ($x:expr, $y:expr) => { Vector2::new($x, $y) };
}
";

/// A program behind a description, which uses its system.
fn program(name: &str) -> String {
    let system = if name == "Cart" { "Cart<f64>".to_owned() } else { name.to_owned() };
    format!(
        "fn uses(system: &{system}, q: {name}Coordinates<f64>, v: {name}Velocities<f64>) -> Result<f64, MotionError<f64>> {{
    let start = State::at_rest(core::array::from_fn(|_| 0.5));
    let mut motion = system.simulate(start);
    motion.advance_to(1.0)?;
    let _ = (q, v, <{system}>::COORDINATES, <{system}>::STRUCTURE);
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

/// The number of errors of a program with a description, and the texts of those outside of the description.
fn errors(structure: &str, args: &dyn Display, item: &dyn Display) -> (usize, Vec<String>) {
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join("unfinished.rs");
    let name =
        structure.split_whitespace().nth(2).and_then(|name| name.split('<').next()).unwrap_or_default();
    let before = format!("{HEAD}\n{structure}\n\n#[lagrangian({args})]\n{item}\n\n");
    let end = before.lines().count() as u64;
    fs::write(&source, before + &program(name)).expect("the crate can be written");
    let messages = report(&source, "bin", "metadata");
    let errors = messages.iter().filter(|message| message["level"] == "error");
    let errors: Vec<(u64, &Value)> = errors.filter_map(|error| Some((line(error)?, error))).collect();
    let elsewhere = errors.iter().filter(|(line, _)| *line > end);
    (errors.len(), elsewhere.map(|(_, error)| text(error)).collect())
}

#[test]
fn errors_stand_in_the_description() {
    let count = std::env::var("CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(COUNT);
    let whole: Vec<_> = ACCEPTED.into_iter().chain(MORE).collect();
    for (structure, args, item) in &whole {
        assert_eq!(errors(structure, args, item), (0, Vec::new()));
    }
    let tokens = |text: &str| text.parse().expect("the description is made of tokens");
    let (mut by_number, mut elsewhere) = (BTreeMap::<usize, u32>::new(), Vec::new());
    for seed in 0..count {
        let mut random = Random::new(seed);
        let (structure, args, item) = whole[random.below(whole.len())];
        let Damaged { args, item, .. } = damaged(tokens(args), tokens(item), &mut random);
        let (number, found) = errors(structure, &args, &item);
        *by_number.entry(number).or_default() += 1;
        elsewhere
            .extend(found.into_iter().map(|text| format!("{seed}: #[lagrangian({args})] {item}\n{text}")));
    }
    println!("descriptions by their number of errors: {by_number:?}");
    assert!(elsewhere.is_empty(), "{} errors\n{}", elsewhere.len(), elsewhere.join("\n"));
}
