//! Time of one evaluation of the accelerations.
//!
//! 512 random states, independent calls of a function that is not inlined, results written;
//! the median of many samples, subjects alternating sample by sample.

use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use serde::Serialize;

use crate::systems::{self, Case};

const STATES: usize = 512;
const SAMPLES: usize = 41;

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
    /// Distance from the implementation that differs most, relative to the largest acceleration of a state.
    apart: f64,
}

/// How far implementations may be apart, relative to the largest acceleration of a state: all of them solve
/// positive definite equations, whose condition is below 1e4 at these states.
const AGREEMENT: f64 = 1e-12;

/// Measures all systems, or the one that is named.
pub fn run(only: Option<&str>, json: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let mut records = Vec::new();
    let mut wrong = Vec::new();
    println!(
        "{:10} {:15} {:>10} {:>8} {:>8} {:>8}   recorded: CasADi C, SymForce C",
        "system", "subject", "ns", "/ hand", "/ O(N)", "apart"
    );
    systems::for_each(&mut |case: &dyn Case| {
        if only.is_some_and(|name| name != case.name()) {
            return;
        }
        let measured = measure(case);
        let of = |subject: &str| measured.iter().find(|r| r.subject == subject).map_or(f64::NAN, |r| r.ns);
        for record in &measured {
            let recorded = match RECORDED.iter().find(|(name, ..)| *name == case.name()) {
                Some((_, casadi, symforce)) if record.subject == "generated" => {
                    format!("{casadi:.2}, {symforce:.2}")
                }
                _ => String::new(),
            };
            println!(
                "{:10} {:15} {:10.2} {:8.2} {:8.2} {:8.0e}   {recorded}",
                record.system,
                record.subject,
                record.ns,
                record.ns / of("hand"),
                record.ns / of("hand-recursive"),
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
    let repeats: Vec<usize> = (0..subjects.len()).map(|subject| calibrate(case, subject)).collect();
    let mut times = vec![Vec::with_capacity(SAMPLES); subjects.len()];
    for _ in 0..SAMPLES {
        for (subject, (times, &repeats)) in times.iter_mut().zip(&repeats).enumerate() {
            let start = Instant::now();
            for _ in 0..repeats {
                black_box(case).run(subject);
            }
            times.push(start.elapsed().as_secs_f64() * 1e9 / (repeats * STATES) as f64);
        }
    }
    let medians = times.iter_mut().map(|times| median(times));
    let figures = subjects.iter().zip(medians).zip(deviations);
    figures
        .map(|((subject, ns), apart)| Record { benchmark: "rhs", system: case.name(), subject, ns, apart })
        .collect()
}

/// How often to repeat so that a sample takes about two milliseconds.
fn calibrate(case: &dyn Case, subject: usize) -> usize {
    let start = Instant::now();
    let mut runs = 0;
    while runs < 20 && start.elapsed().as_secs_f64() < 2e-3 {
        black_box(case).run(subject);
        runs += 1;
    }
    let one = start.elapsed().as_secs_f64() / f64::from(runs);
    ((2e-3 / one) as usize).clamp(1, 10_000)
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
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
pub fn random_states<const N: usize>() -> Vec<([f64; N], [f64; N])> {
    let mut next = uniform();
    (0..STATES).map(|_| (std::array::from_fn(|_| next()), std::array::from_fn(|_| next()))).collect()
}
