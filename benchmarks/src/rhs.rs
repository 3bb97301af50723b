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
    ns: f64,
}

/// Measures all systems, or the one that is named.
pub fn run(only: Option<&str>, json: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let mut records = Vec::new();
    println!(
        "{:10} {:12} {:>10} {:>8}   recorded: CasADi C, SymForce C",
        "system", "subject", "ns", "/ hand"
    );
    systems::for_each(&mut |case: &dyn Case| {
        if only.is_some_and(|name| name != case.name()) {
            return;
        }
        let subjects = case.subjects();
        case.check();
        let mut times = vec![Vec::with_capacity(SAMPLES); subjects.len()];
        let repeats = calibrate(case);
        for _ in 0..SAMPLES {
            for (subject, times) in times.iter_mut().enumerate() {
                let start = Instant::now();
                for _ in 0..repeats {
                    black_box(case).run(subject);
                }
                times.push(start.elapsed().as_secs_f64() * 1e9 / (repeats * STATES) as f64);
            }
        }
        let medians: Vec<f64> = times.iter_mut().map(|times| median(times)).collect();
        let hand =
            subjects.iter().position(|&subject| subject == "hand").map_or(f64::NAN, |place| medians[place]);
        for (&subject, &ns) in subjects.iter().zip(&medians) {
            let recorded = match RECORDED.iter().find(|(name, ..)| *name == case.name()) {
                Some((_, casadi, symforce)) if subject == "generated" => {
                    format!("{casadi:.2}, {symforce:.2}")
                }
                _ => String::new(),
            };
            println!("{:10} {:12} {ns:10.2} {:8.2}   {recorded}", case.name(), subject, ns / hand);
            records.push(Record { benchmark: "rhs", system: case.name(), subject, ns });
        }
    });
    if let Some(path) = json {
        std::fs::write(path, serde_json::to_string_pretty(&records)?)?;
    }
    Ok(())
}

/// How often to repeat so that a sample takes about two milliseconds.
fn calibrate(case: &dyn Case) -> usize {
    let start = Instant::now();
    (0..20).for_each(|_| black_box(case).run(0));
    let one = start.elapsed().as_secs_f64() / 20.0;
    ((2e-3 / one) as usize).clamp(1, 10_000)
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Uniform numbers in (−1, 1), the same in every run.
pub fn random_states<const N: usize>() -> Vec<([f64; N], [f64; N])> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..STATES).map(|_| (std::array::from_fn(|_| next()), std::array::from_fn(|_| next()))).collect()
}
