//! [`Subject`]: an integrator under its own name; [`Function`], one that lives in this process.

use std::hint::black_box;
use std::time::Instant;

use crate::problem::Problem;

/// A few runs.
pub struct Sample {
    /// Time of the fastest run, for each trajectory [µs].
    pub us: f64,
    pub error: f64,
    pub steps: u64,
}

/// A subject of a benchmark. Subjects take turns.
pub trait Subject {
    /// Its name in all reports.
    fn name(&self) -> &str;

    /// Runs for `seconds`, at least once.
    fn sample(&mut self, problem: &Problem, tolerance: f64, seconds: f64) -> Result<Sample, String>;
}

/// The end of a run: (q, v) of one trajectory after the other, and the number of steps.
pub struct Outcome {
    pub end: Vec<f64>,
    pub steps: u64,
}

/// A subject that is a function of the tolerance.
pub struct Function<F> {
    pub name: &'static str,
    /// Motions that one run integrates side by side.
    pub trajectories: u32,
    pub run: F,
}

impl<F: Fn(f64) -> Result<Outcome, String>> Subject for Function<F> {
    fn name(&self) -> &str {
        self.name
    }

    fn sample(&mut self, problem: &Problem, tolerance: f64, seconds: f64) -> Result<Sample, String> {
        let (us, Outcome { end, steps }) = fastest(seconds, || (self.run)(black_box(tolerance)))?;
        Ok(Sample { us: us / f64::from(self.trajectories), error: problem.error(&end), steps })
    }
}

/// Runs for `seconds`, at least once. Returns the time of the fastest run [µs] and the result of the last
/// one.
pub fn fastest<T, E>(seconds: f64, run: impl Fn() -> Result<T, E>) -> Result<(f64, T), E> {
    let begin = Instant::now();
    let mut fastest = f64::INFINITY;
    loop {
        let start = Instant::now();
        let outcome = black_box(&run)()?;
        fastest = fastest.min(start.elapsed().as_secs_f64() * 1e6);
        if begin.elapsed().as_secs_f64() >= seconds {
            return Ok((fastest, outcome));
        }
    }
}

/// The median.
pub fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    let middle = times.len() / 2;
    if times.len() % 2 == 1 { times[middle] } else { 0.5 * (times[middle - 1] + times[middle]) }
}
