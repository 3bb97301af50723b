//! Time of a whole integration against the error at its end.
//!
//! All subjects of a system and a tolerance run in turn, several rounds of some milliseconds each, on one
//! core, so that other processes disturb them alike. The time is the median over the rounds of the fastest
//! run in a round: other processes only ever add to a run.

#[cfg(feature = "peers")]
mod crates;
mod ours;
pub mod plot;
pub mod server;
pub mod subject;

use std::collections::HashSet;
use std::error::Error;
use std::path::Path;

use crate::problem::{Problem, problems};
use crate::record::{self, Record};
use server::Server;
use subject::{Sample, Subject};

/// The tolerances of every subject, relative and absolute alike.
pub const TOLERANCES: [f64; 12] =
    [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15];

/// The amount of repetition.
#[derive(Clone, Copy)]
pub struct Effort {
    /// Times that the subjects take turns.
    pub rounds: usize,
    /// Time of a turn [s].
    pub turn: f64,
}

impl Effort {
    /// The effort for figures to keep.
    pub const FULL: Self = Self { rounds: 5, turn: 0.02 };
    /// The effort for a first impression.
    pub const QUICK: Self = Self { rounds: 1, turn: 0.005 };
}

/// [`Plan::slow`] of these systems.
const SLOW: f64 = 0.3;

/// Measures all systems or one, ours and the peers in Rust.
pub fn run(
    system: Option<&str>,
    json: Option<&Path>,
    svg: Option<&Path>,
    effort: Effort,
) -> Result<(), Box<dyn Error>> {
    let records = measure(system, None, effort)?;
    if let Some(path) = json {
        record::write(&records, path)?;
    }
    if let Some(directory) = svg {
        plot::draw_all(&records, directory)?;
    }
    Ok(())
}

/// Measures and prints; with a server its subjects take their turns too.
pub fn measure(
    system: Option<&str>,
    server: Option<&Server>,
    effort: Effort,
) -> Result<Vec<Record>, Box<dyn Error>> {
    let mut records = Vec::new();
    println!(
        "{:10} {:26} {:>9} {:>9} {:>12} {:>9}",
        "system", "subject", "tolerance", "error", "µs", "steps"
    );
    for problem in problems(system)? {
        let mut subjects = ours::subjects(&problem);
        #[cfg(feature = "peers")]
        subjects.extend(crates::subjects(&problem));
        subjects.extend(server.into_iter().flat_map(|server| server.subjects(problem.name)));
        let plan =
            Plan { benchmark: "precision", setting: |_, place| TOLERANCES.get(place).copied(), slow: SLOW };
        series(&problem, &mut subjects, &plan, effort, &mut records);
    }
    Ok(records)
}

/// The settings of a benchmark.
pub struct Plan {
    pub benchmark: &'static str,
    /// The n-th tolerance of a subject, or the setting that takes its place.
    pub setting: fn(&str, usize) -> Option<f64>,
    /// A run that takes longer [s] is not repeated and ends the series of its subject.
    pub slow: f64,
}

/// All tolerances of a system.
pub fn series(
    problem: &Problem,
    subjects: &mut [Box<dyn Subject>],
    plan: &Plan,
    effort: Effort,
    records: &mut Vec<Record>,
) {
    let mut slow = HashSet::new();
    for setting in 0.. {
        let mut turns: Vec<(usize, f64, Vec<Sample>)> = Vec::new();
        let mut is_over = true;
        for (place, subject) in subjects.iter_mut().enumerate().filter(|(place, _)| !slow.contains(place)) {
            let Some(tolerance) = (plan.setting)(subject.name(), setting) else { continue };
            is_over = false;
            // The first run warms up, and tells how long others will take.
            match subject.sample(problem, tolerance, 0.0) {
                Ok(sample) => turns.push((place, tolerance, vec![sample])),
                Err(cause) => println!("{:10} {:26} {tolerance:9.0e} {cause}", problem.name, subject.name()),
            }
        }
        if is_over {
            return;
        }
        for _ in 0..effort.rounds {
            for (place, tolerance, samples) in
                turns.iter_mut().filter(|(.., samples)| samples[0].us < plan.slow * 1e6)
            {
                samples.extend(subjects[*place].sample(problem, *tolerance, effort.turn));
            }
        }
        for (place, tolerance, samples) in turns {
            if samples[0].us >= plan.slow * 1e6 {
                slow.insert(place);
            }
            let record = summary(plan.benchmark, problem, subjects[place].name(), tolerance, &samples);
            println!(
                "{:10} {:26} {:9.0e} {:9.1e} {:12.1} {:9}",
                record.system, record.subject, record.tolerance, record.error, record.us, record.steps
            );
            records.push(record);
        }
    }
}

/// The record of a subject. The warm-up does not count if there are other samples.
fn summary(benchmark: &str, problem: &Problem, subject: &str, tolerance: f64, samples: &[Sample]) -> Record {
    let timed = if samples.len() > 1 { &samples[1..] } else { samples };
    let us = subject::median(timed.iter().map(|sample| sample.us).collect());
    Record {
        benchmark: benchmark.into(),
        system: problem.name.into(),
        subject: subject.into(),
        tolerance,
        error: samples[0].error,
        us,
        steps: samples[0].steps,
    }
}
