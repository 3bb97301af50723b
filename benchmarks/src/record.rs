//! [`Record`]: one measured run, and questions about many of them.

use std::error::Error;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::problem;

/// A subject on a system at one tolerance.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Record {
    pub benchmark: String,
    pub system: String,
    pub subject: String,
    pub tolerance: f64,
    pub error: f64,
    /// Time of the whole integration, in batch mode for each trajectory [µs].
    pub us: f64,
    /// The number of steps, or of evaluations where a subject counts nothing else; zero where it counts
    /// nothing.
    pub steps: u64,
}

/// The records of one subject on one system.
pub fn of<'a>(
    records: &'a [Record],
    system: &'a str,
    subject: &'a str,
) -> impl Iterator<Item = &'a Record> + Clone {
    records.iter().filter(move |record| record.system == system && record.subject == subject)
}

/// The systems that were measured, in order.
pub fn systems(records: &[Record]) -> impl Iterator<Item = &'static str> {
    problem::names().filter(|name| records.iter().any(|record| record.system == *name))
}

/// The cheapest run whose error is at or below `accuracy`.
pub fn cheapest<'a>(records: impl Iterator<Item = &'a Record>, accuracy: f64) -> Option<&'a Record> {
    records.filter(|record| record.error <= accuracy).min_by(|a, b| a.us.total_cmp(&b.us))
}

/// The most accurate run.
pub fn best<'a>(records: impl Iterator<Item = &'a Record>) -> Option<&'a Record> {
    records.min_by(|a, b| a.error.total_cmp(&b.error))
}

/// Writes records as JSON.
pub fn write(records: &[Record], path: &Path) -> Result<(), Box<dyn Error>> {
    Ok(std::fs::write(path, serde_json::to_string_pretty(records)?)?)
}
