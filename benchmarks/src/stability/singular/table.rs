//! Counts over the runs of a case by a method.

use std::collections::BTreeMap;

use super::runs::{Errors, Method, Outcome};

/// A case by a method.
pub struct Row {
    /// The case.
    pub case: &'static str,
    /// The method.
    pub method: Method,
    /// One for each run.
    pub outcomes: Vec<Outcome>,
}

/// A row as it is written to JSON.
#[derive(serde::Serialize)]
pub struct Record {
    benchmark: &'static str,
    case: &'static str,
    method: String,
    runs: usize,
    energy_wrong: usize,
    place_wrong: usize,
    errors: BTreeMap<String, usize>,
    /// Offset of the wrong run that starts furthest away [rad].
    example: Option<f64>,
    worst_energy: f64,
    worst_place: f64,
    steps: f64,
    us: f64,
}

impl Row {
    /// The row for JSON.
    pub fn record(&self) -> Record {
        let ((energy_wrong, place_wrong), runs) = (self.wrong(), self.outcomes.len());
        Record {
            benchmark: "singular",
            case: self.case,
            method: self.method.name(),
            runs,
            energy_wrong,
            place_wrong,
            errors: self.causes().into_iter().map(|(cause, n)| (cause.to_owned(), n)).collect(),
            example: self.example().map(|outcome| outcome.offset),
            worst_energy: self.worst(|errors| errors.energy),
            worst_place: self.worst(|errors| errors.place),
            steps: self.steps(),
            us: self.mean(|outcome| outcome.us),
        }
    }

    /// The numbers of runs with a wrong energy, and with a right energy at a wrong place.
    pub fn wrong(&self) -> (usize, usize) {
        let ends = || self.outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok());
        let energy = ends().filter(|errors| errors.energy_is_wrong()).count();
        (energy, ends().filter(|errors| errors.place_is_wrong() && !errors.energy_is_wrong()).count())
    }

    /// The wrong run with the largest offset: the easiest to look into.
    fn example(&self) -> Option<&Outcome> {
        let wrong = self
            .outcomes
            .iter()
            .filter(|outcome| outcome.result.as_ref().is_ok_and(|errors| errors.are_wrong()));
        wrong.max_by(|a, b| a.offset.abs().total_cmp(&b.offset.abs()))
    }

    /// How many runs ended in each cause.
    pub fn causes(&self) -> BTreeMap<&str, usize> {
        let mut causes = BTreeMap::new();
        for cause in self.outcomes.iter().filter_map(|outcome| outcome.result.as_ref().err()) {
            *causes.entry(cause.as_str()).or_default() += 1;
        }
        causes
    }

    /// The largest of a number over the runs that ended.
    pub fn worst(&self, of: impl Fn(&Errors) -> f64) -> f64 {
        let ends = self.outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok());
        ends.map(of).fold(0.0, |worst, x| if x > worst || x.is_nan() { x } else { worst })
    }

    /// Steps of a run, on average.
    pub fn steps(&self) -> f64 {
        self.mean(|outcome| outcome.steps as f64)
    }

    /// The mean of a number over all runs.
    pub fn mean(&self, of: impl Fn(&Outcome) -> f64) -> f64 {
        self.outcomes.iter().map(of).sum::<f64>() / self.outcomes.len().max(1) as f64
    }
}
