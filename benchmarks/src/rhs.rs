//! Time of one evaluation of the accelerations.
//!
//! Random states, independent calls of a function that is not inlined, results written. Subjects take turns;
//! the figure is the median over the rounds of the fastest pass over all states, since other processes only
//! ever add to a pass.

use std::convert::Infallible;
use std::error::Error;
use std::hint::black_box;
use std::path::Path;

use serde::Serialize;

use crate::precision::subject::{fastest, median};
use crate::systems::{self, Case};

const ROUNDS: usize = 41;
const SECONDS: f64 = 1e-2;

/// Generated C by peers relative to hand-written dense Rust, in one run on one machine
/// (CasADi 3.8.2, SymForce 0.12.0, SymPy 1.14.0; gcc 12.2, rustc 1.95).
const RECORDED: [(&str, f64, f64); 12] = [
    ("dpend", 31.2 / 26.2, 28.5 / 26.2),
    ("spring", 20.9 / 14.0, 15.2 / 14.0),
    ("hh", 7.59 / 1.77, 2.72 / 1.77),
    ("kepler", 8.7 / 3.72, 16.2 / 3.72),
    ("pleiades", 164.0 / 98.3, 837.0 / 98.3),
    ("top", 19.7 / 13.9, 27.9 / 13.9),
    ("sph", 16.9 / 13.1, 14.8 / 13.1),
    ("cart", 27.9 / 21.4, 21.9 / 21.4),
    ("nlink3", 74.3 / 46.1, 93.9 / 46.1),
    ("nlink5", 198.0 / 88.1, 239.0 / 88.1),
    ("nlink10", 759.0 / 418.0, 966.0 / 418.0),
    ("nlink20", 4960.0 / 1563.0, 5745.0 / 1563.0),
];

/// One record of the JSON file.
#[derive(Serialize)]
struct Record {
    benchmark: &'static str,
    system: &'static str,
    subject: &'static str,
    /// Median time of an evaluation.
    ns: f64,
    /// The largest distance from another implementation, relative to the largest acceleration of a state.
    apart: f64,
}

/// The largest distance of implementations from each other, relative to the largest acceleration of a state:
/// some ten thousand ulps, since the mass matrix of a hundred links has a condition of 1e4.
const AGREEMENT: f64 = 1e-12;

/// Measures all systems, or the one that is named.
pub fn run(only: Option<&str>, json: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let mut records = Vec::new();
    let mut wrong = Vec::new();
    println!(
        "{:10} {:15} {:>10} {:>8} {:>11} {:>8}   recorded: CasADi C, SymForce C",
        "system", "subject", "ns", "/ hand", "/ recursive", "apart"
    );
    systems::for_each(&mut |case: &dyn Case| {
        if only.is_some_and(|name| name != case.name()) {
            return;
        }
        let measured = measure(case);
        let relative = |ns: f64, subject: &str| {
            let other = measured.iter().find(|record| record.subject == subject);
            other.map_or(String::new(), |other| format!("{:.2}", ns / other.ns))
        };
        for record in &measured {
            let recorded = match RECORDED.iter().find(|(name, ..)| *name == case.name()) {
                Some((_, casadi, symforce)) if record.subject == "generated" => {
                    format!("{casadi:.2}, {symforce:.2}")
                }
                _ => String::new(),
            };
            println!(
                "{:10} {:15} {:10.2} {:>8} {:>11} {:8.0e}   {recorded}",
                record.system,
                record.subject,
                record.ns,
                relative(record.ns, "hand"),
                relative(record.ns, "hand-recursive"),
                record.apart
            );
            if record.apart.is_nan() || record.apart > AGREEMENT {
                wrong.push(format!("{} of {}", record.subject, record.system));
            }
        }
        records.extend(measured);
    });
    if let Some(path) = json {
        std::fs::write(path, serde_json::to_string_pretty(&records)?)?;
    }
    if records.is_empty() {
        return Err("no such system".into());
    }
    if !wrong.is_empty() {
        return Err(
            format!("more than {AGREEMENT:e} from another implementation: {}", wrong.join(", ")).into()
        );
    }
    Ok(())
}

/// Compares and times all implementations of a system.
fn measure(case: &dyn Case) -> Vec<Record> {
    let subjects = case.subjects();
    let deviations = case.deviations();
    let mut times = vec![Vec::with_capacity(ROUNDS); subjects.len()];
    for _ in 0..ROUNDS {
        for (subject, times) in times.iter_mut().enumerate() {
            let pass = || -> Result<(), Infallible> {
                black_box(case).run(subject);
                Ok(())
            };
            let (us, ()) = fastest(SECONDS, pass).unwrap_or_else(|never| match never {});
            times.push(us * 1e3 / case.states() as f64);
        }
    }
    let figures = subjects.iter().zip(times).zip(deviations);
    figures
        .map(|((subject, times), apart)| Record {
            benchmark: "rhs",
            system: case.name(),
            subject,
            ns: median(times),
            apart,
        })
        .collect()
}

/// Uniform numbers in (−1, 1), the same in every run.
pub fn uniform() -> impl FnMut() -> f64 {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// States of such numbers.
pub fn random_states<const N: usize>(count: usize) -> Vec<([f64; N], [f64; N])> {
    let mut next = uniform();
    (0..count).map(|_| (std::array::from_fn(|_| next()), std::array::from_fn(|_| next()))).collect()
}
