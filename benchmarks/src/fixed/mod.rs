//! Fixed steps, as a control loop takes them: error at the end and time of a step for several lengths.
//!
//! The inputs are held from one instant of control to the next, and every length divides that time, so that
//! all runs integrate the same motion. Methods take turns as in `precision`.

mod cases;
mod tables;

use std::error::Error;
use std::path::Path;

use serde::Serialize;

use crate::precision::Effort;
use crate::precision::subject::{fastest, median};
use cases::Case;

/// A method on a case at one length of its steps.
#[derive(Clone, Debug, Serialize)]
pub struct Record {
    pub benchmark: &'static str,
    pub system: &'static str,
    pub method: &'static str,
    /// Length of a step [s].
    pub h: f64,
    pub error: f64,
    /// Time of a step [ns].
    pub ns: f64,
    pub steps: usize,
}

impl Record {
    /// Time of the whole run [µs].
    pub fn us(&self) -> f64 {
        self.ns * self.steps as f64 * 1e-3
    }
}

/// Measures all cases or one.
pub fn run(system: Option<&str>, json: Option<&Path>, effort: Effort) -> Result<(), Box<dyn Error>> {
    let mut cases = cases::all()?;
    cases.retain(|case| system.is_none_or(|name| name == case.name()));
    if cases.is_empty() {
        return Err("no such system".into());
    }
    let mut records = Vec::new();
    for case in &cases {
        let measured = measure(case.as_ref(), effort);
        print!("{}", tables::all(case.as_ref(), &measured));
        records.extend(measured);
    }
    if let Some(path) = json {
        std::fs::write(path, serde_json::to_string_pretty(&records)?)?;
    }
    Ok(())
}

/// All methods and lengths of a case, without those whose steps are too long to arrive.
fn measure(case: &dyn Case, effort: Effort) -> Vec<Record> {
    let methods = case.methods();
    let mut records = Vec::new();
    for substeps in cases::SUBSTEPS {
        let mut turns = vec![(Vec::new(), Vec::new()); methods.len()];
        for _ in 0..effort.rounds {
            for (method, (times, end)) in turns.iter_mut().enumerate() {
                if let Ok((us, found)) = fastest(effort.turn, || case.run(method, substeps)) {
                    times.push(us);
                    *end = found;
                }
            }
        }
        let (system, steps) = (case.name(), case.holds() * substeps);
        for (method, (times, end)) in methods.iter().zip(turns).filter(|(_, (times, _))| !times.is_empty()) {
            records.push(Record {
                benchmark: "fixed",
                system,
                method,
                h: case.hold() / substeps as f64,
                error: case.error(&end),
                ns: median(times) * 1e3 / steps as f64,
                steps,
            });
        }
    }
    records
}
