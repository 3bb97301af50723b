//! [`Cell`]: the result of a method on a task, and [`Task`]: a motion with its measure, for every method that
//! the system has.

use std::time::Instant;

use lagrangian::prelude::*;
use lagrangian::{Adaptive, FixedStep, Held, Separable, Simulation, Smooth};
use serde::Serialize;

/// Columns of the tables: under error control at the default tolerance and at the finest; in fixed steps.
pub const METHODS: [&str; 17] = [
    "simulate",
    "simulate, fine",
    "Dop853",
    "Dop853, fine",
    "Jet<4>",
    "Jet<6>",
    "Jet<8>",
    "Rk4",
    "Gauss4",
    "Gauss6",
    "Gauss8",
    "Leapfrog",
    "Yoshida4",
    "Yoshida6",
    "Yoshida8",
    "BlanesMoan4",
    "BlanesMoan6",
];

/// The result of a method on a task.
#[derive(Clone, Debug, Serialize)]
pub struct Cell {
    pub benchmark: &'static str,
    pub task: &'static str,
    pub method: &'static str,
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// How it ended.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// It ended with an error, the error that is allowed, the exponent with which the error of the energy
    /// grew, and a cost.
    Done { error: f64, allowed: Option<f64>, drift: Option<f64>, us: f64, steps: u64 },
    /// It stopped with a typed error, at a time [s].
    Failed { cause: String, t: f64 },
    /// It cannot start: the types do not allow it.
    NotOffered,
}

impl Outcome {
    /// Whether the result is worse than the method promises, without an error.
    pub fn is_silently_wrong(&self) -> bool {
        match self {
            Self::Done { error, allowed: Some(allowed), .. } => error > allowed || error.is_nan(),
            Self::Done { error, allowed: None, .. } => !error.is_finite(),
            Self::Failed { .. } | Self::NotOffered => false,
        }
    }
}

/// The distance of a state from the true one.
pub type Distance<R, const N: usize> = Box<dyn Fn(&State<R, N>) -> f64>;

/// The measure of the error of a task.
pub enum Measure<R, const N: usize> {
    /// The error of the state at the end.
    End(Distance<R, N>),
    /// The largest change of the energy, in its unit.
    Energy,
}

/// A motion and its measure.
pub struct Task<S: System<N>, const N: usize> {
    pub name: &'static str,
    pub system: S,
    pub starts: Vec<State<S::Scalar, N>>,
    /// End of the motion [s], a multiple of the step.
    pub span: f64,
    /// Steps of the methods without error control.
    pub steps: u64,
    /// Whether the energy is conserved, and its unit.
    pub energy: Option<f64>,
    pub measure: Vec<Measure<S::Scalar, N>>,
    /// How many times larger an error of the start is at the end.
    pub condition: f64,
    /// The rounding of the coordinates, relative to the measure.
    pub noise: f64,
    /// Tolerances: the default one, and the finest that makes sense for the scalar.
    pub tolerances: [f64; 2],
    /// Whether methods under error control take steps as short as the others do.
    pub limited: bool,
}

/// Octaves of time in which the growth of an error is observed.
const OCTAVES: u32 = 6;
/// Samples in each of them.
const SAMPLES: u64 = 16;

/// Largest errors of the energy in each octave of time.
struct Growth {
    octaves: [f64; OCTAVES as usize],
}

impl Growth {
    /// The slope of the logarithms of error and time by least squares; none where the error is rounding of
    /// the energy itself.
    fn exponent(&self, noise: f64) -> Option<f64> {
        let last = self.octaves[OCTAVES as usize - 1];
        let is_rounding = last.is_nan() || last <= 64.0 * noise;
        if is_rounding || self.octaves.iter().any(|error| error.is_nan() || *error <= 0.0) {
            return None;
        }
        let middle = f64::from(OCTAVES - 1) / 2.0;
        let octave = |i: usize| i as f64 - middle;
        let above = self.octaves.iter().enumerate().map(|(i, error)| octave(i) * error.log2()).sum::<f64>();
        let below = (0..OCTAVES as usize).map(|i| octave(i).powi(2)).sum::<f64>();
        Some(above / below)
    }
}

/// The larger number, or NaN.
fn largest(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

impl<S, const N: usize> Task<S, N>
where
    S: System<N, 0>,
    S::Scalar: Ordered + Into<f64>,
{
    /// The energy at a state.
    fn energy(&self, state: &State<S::Scalar, N>) -> f64 {
        self.system.energy_at(&self.system.constants(), state.t, &state.q, &state.v).into()
    }

    /// Instants of observation as shares of the whole in units of 1/(64 · 16), octave by octave.
    fn instants() -> impl Iterator<Item = (usize, u64)> {
        (0..OCTAVES).flat_map(|octave| (1..=SAMPLES).map(move |i| (octave as usize, (SAMPLES + i) << octave)))
    }

    /// Follows all starts. `go` moves a motion to an instant, a share of the whole, and returns the state
    /// there and the steps so far.
    fn follow<M>(
        &self,
        method: &'static str,
        tolerance: Option<f64>,
        mut begin: impl FnMut(State<S::Scalar, N>) -> M,
        mut go: impl FnMut(&mut M, u64, u64) -> Result<(State<S::Scalar, N>, u64), MotionError<S::Scalar>>,
    ) -> Cell {
        let whole = (2 * SAMPLES) << (OCTAVES - 1);
        let (mut error, mut steps, mut drift, mut failed) = (0.0, 0, None, None);
        let begun = Instant::now();
        'starts: for (start, measure) in self.starts.iter().zip(self.measure.iter().cycle()) {
            let first = self.energy(start);
            let mut motion = begin(*start);
            let mut growth = Growth { octaves: [0.0; OCTAVES as usize] };
            let mut taken = 0;
            let mut end = *start;
            for (octave, share) in Self::instants() {
                match go(&mut motion, share, whole) {
                    Ok((state, steps)) => (end, taken) = (state, steps),
                    Err(MotionError { cause, t }) => {
                        let cause = format!("{cause:?}");
                        let cause = cause.split([' ', '{', '(']).next().unwrap_or_default().to_owned();
                        failed.get_or_insert(Outcome::Failed { cause, t: t.into() });
                        continue 'starts;
                    }
                }
                let Some(unit) = self.energy else { continue };
                let off = (self.energy(&end) - first).abs() / unit;
                growth.octaves[octave] = largest(growth.octaves[octave], off);
            }
            let off = match measure {
                Measure::End(measure) => measure(&end),
                Measure::Energy if self.energy.is_none() => f64::NAN,
                Measure::Energy => growth.octaves.into_iter().fold(0.0, largest),
            };
            (error, steps) = (largest(error, off), steps + taken);
            drift = self.energy.and_then(|_| growth.exponent(self.noise));
        }
        let us = begun.elapsed().as_secs_f64() * 1e6 / self.starts.len() as f64;
        let steps = steps / self.starts.len() as u64;
        // An error within the tolerance in each step adds up to no more than their number, or a hundred where
        // they are few.
        let allowed =
            tolerance.map(|tolerance| self.condition * (tolerance + self.noise) * (steps as f64).max(100.0));
        let done = Outcome::Done { error, allowed, drift, us, steps };
        // The error of one start does not excuse a wrong result of another.
        let outcome = if done.is_silently_wrong() { done } else { failed.unwrap_or(done) };
        Cell { benchmark: "stability", task: self.name, method, outcome }
    }

    /// The result of a method under error control.
    fn controlled<M>(&self, method: &'static str, tolerance: f64) -> Cell
    where
        M: Adaptive<S, Held<S::Scalar, 0>, N, 0>,
    {
        let span = self.span;
        let begin = |start| {
            let motion = Simulation::<S, Held<S::Scalar, 0>, M, N, 0>::new(&self.system, start)
                .with_tolerance(S::Scalar::from_f64(tolerance))
                .with_max_steps(200_000);
            let limit = S::Scalar::from_f64(span / self.steps as f64);
            if self.limited { motion.with_step_limit(limit) } else { motion }
        };
        self.follow(method, Some(tolerance), begin, |motion, share, whole| {
            let t = S::Scalar::from_f64(span * (share as f64 / whole as f64));
            let state = *motion.advance_to(t)?;
            Ok((state, motion.steps().accepted + motion.steps().rejected))
        })
    }

    /// The result of a method in fixed steps.
    fn stepped<M: FixedStep<S, N, 0>>(&self, method: &'static str) -> Cell {
        let h = S::Scalar::from_f64(self.span / self.steps as f64);
        let begin = |start| (self.system.stepper::<M>(start), 0);
        self.follow(method, None, begin, |(motion, taken), share, whole| {
            let until = self.steps * share / whole;
            while *taken < until {
                motion.step(h, &[])?;
                *taken += 1;
            }
            Ok((*motion.state(), *taken))
        })
    }

    /// The results of the methods that every system has.
    pub fn general(&self) -> Vec<Cell>
    where
        S: Smooth<N, 0>,
    {
        let [usual, fine] = self.tolerances;
        vec![
            self.controlled::<S::Method>("simulate", usual),
            self.controlled::<S::Method>("simulate, fine", fine),
            self.controlled::<Dop853>("Dop853", usual),
            self.controlled::<Dop853>("Dop853, fine", fine),
            self.stepped::<Jet<4>>("Jet<4>"),
            self.stepped::<Jet<6>>("Jet<6>"),
            self.stepped::<Jet<8>>("Jet<8>"),
            self.stepped::<Rk4>("Rk4"),
        ]
    }

    /// The results of the methods that need derivatives.
    pub fn implicit(&self) -> Vec<Cell>
    where
        Gauss4: FixedStep<S, N, 0>,
        Gauss6: FixedStep<S, N, 0>,
        Gauss8: FixedStep<S, N, 0>,
    {
        vec![
            self.stepped::<Gauss4>("Gauss4"),
            self.stepped::<Gauss6>("Gauss6"),
            self.stepped::<Gauss8>("Gauss8"),
        ]
    }

    /// The results of the methods that need a constant mass matrix and forces without velocities.
    pub fn split(&self) -> Vec<Cell>
    where
        S: Separable<N, 0>,
    {
        vec![
            self.stepped::<Leapfrog>("Leapfrog"),
            self.stepped::<Yoshida4>("Yoshida4"),
            self.stepped::<Yoshida6>("Yoshida6"),
            self.stepped::<Yoshida8>("Yoshida8"),
            self.stepped::<BlanesMoan4>("BlanesMoan4"),
            self.stepped::<BlanesMoan6>("BlanesMoan6"),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_has_its_exponent() {
        let octaves = std::array::from_fn(|i| 1e-9 * 2.0_f64.powf(1.5 * i as f64));
        let exponent = Growth { octaves }.exponent(f64::EPSILON).expect("growth");
        assert!((exponent - 1.5).abs() < 1e-12, "{exponent}");
        assert_eq!(Growth { octaves: [1e-15; 6] }.exponent(f64::EPSILON), None);
    }

    #[test]
    fn what_is_no_number_is_wrong() {
        let done = |error, allowed| Outcome::Done { error, allowed, drift: None, us: 0.0, steps: 0 };
        assert!(done(f64::NAN, Some(1.0)).is_silently_wrong() && done(f64::NAN, None).is_silently_wrong());
        assert!(done(2.0, Some(1.0)).is_silently_wrong() && !done(0.5, Some(1.0)).is_silently_wrong());
    }
}
