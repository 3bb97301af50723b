//! [`Run`]: a start beside a singular position, the true motion where it is known, and the result of a
//! method.

use std::time::Instant;

use lagrangian::prelude::*;
use lagrangian::{FixedStep, Smooth};

/// A method with its setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// `simulate` at a tolerance.
    Jets(f64),
    /// `simulate_with::<Dop853>` at a tolerance.
    Dop853(f64),
    /// `stepper::<Jet<8>>` with a step [s].
    Jet8(f64),
    /// `stepper::<Rk4>` with a step [s].
    Rk4(f64),
}

/// The methods that are tried.
pub const METHODS: [Method; 12] = [
    Method::Jets(1e-6),
    Method::Jets(1e-8),
    Method::Jets(1e-10),
    Method::Jets(1e-12),
    Method::Jets(1e-14),
    Method::Dop853(1e-6),
    Method::Dop853(1e-10),
    Method::Dop853(1e-14),
    Method::Jet8(1e-2),
    Method::Jet8(1e-3),
    Method::Rk4(1e-2),
    Method::Rk4(1e-3),
];

/// Steps after which a run counts as `TooManySteps`. A regular run takes a few dozen by jets and some
/// hundreds by Dop853.
const MAX_STEPS: u64 = 2_000;

impl Method {
    /// Its name in tables.
    pub fn name(self) -> String {
        match self {
            Self::Jets(tolerance) => format!("simulate {tolerance:.0e}"),
            Self::Dop853(tolerance) => format!("Dop853 {tolerance:.0e}"),
            Self::Jet8(h) => format!("Jet<8> h={h:.0e}"),
            Self::Rk4(h) => format!("Rk4 h={h:.0e}"),
        }
    }

    /// The tolerance, where there is one.
    fn tolerance(self) -> Option<f64> {
        match self {
            Self::Jets(tolerance) | Self::Dop853(tolerance) => Some(tolerance),
            Self::Jet8(_) | Self::Rk4(_) => None,
        }
    }
}

/// The smallest distance from the singular position at which methods must end their steps. Let s be the
/// smallest singular value of the scaled constraint gradients, which is about that distance. Rounding
/// determines a state and its velocity to ε/s only, so a method that chooses its steps need not end them
/// where s is below this.
const KEPT: f64 = 1e-5;
/// The factor by which errors of some tens of steps add up; they are not all of the same sign.
const ADDED: f64 = 100.0;
/// The factor by which an error of the energy may grow into one of the place. The motions last half a second,
/// in which neighbouring ones part by less.
const PARTING: f64 = 10.0;

/// A start, and the known parts of its motion.
pub struct Run<S, const N: usize> {
    /// The linkage.
    pub system: S,
    /// The start, on the constraints.
    pub start: State<f64, N>,
    /// How far the start is from the singular position, with the sign of the side.
    pub offset: f64,
    /// A later state of the true motion, away from singular positions.
    pub regular: State<f64, N>,
    /// The true state at the end.
    pub end: State<f64, N>,
}

/// The result of a method on a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The offset of the run.
    pub offset: f64,
    /// Errors of energy and motion, or the cause of an error.
    pub result: Result<Errors, String>,
    /// Steps, rejected ones included.
    pub steps: u64,
    /// Time of the run [µs].
    pub us: f64,
}

/// The errors of an end.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// The error of the energy, relative to the kinetic energy of the start.
    pub energy: f64,
    /// Largest deviation from the true place.
    pub place: f64,
    /// The bound of `energy`. That of `place` is `PARTING` times as large.
    pub allowed: f64,
}

impl Errors {
    /// Whether the energy is off.
    pub fn energy_is_wrong(&self) -> bool {
        self.energy > self.allowed || self.energy.is_nan()
    }

    /// Whether the place is off.
    pub fn place_is_wrong(&self) -> bool {
        self.place > PARTING * self.allowed || self.place.is_nan()
    }

    /// Whether either is.
    pub fn are_wrong(&self) -> bool {
        self.energy_is_wrong() || self.place_is_wrong()
    }
}

/// The end of a motion by a method, or the error that stopped it, and the number of steps.
fn advance<S, const N: usize>(
    system: &S,
    start: State<f64, N>,
    to: f64,
    method: Method,
) -> (Result<State<f64, N>, String>, u64)
where
    S: System<N, 0, Scalar = f64> + Smooth<N, 0>,
{
    let told = |error: MotionError<f64>| {
        let cause = format!("{:?}", error.cause);
        cause.split([' ', '{', '(']).next().unwrap_or_default().to_owned()
    };
    match method {
        Method::Jets(tolerance) => {
            let mut motion = system.simulate(start).with_tolerance(tolerance).with_max_steps(MAX_STEPS);
            let end = motion.advance_to(to).copied().map_err(told);
            (end, motion.steps().accepted + motion.steps().rejected)
        }
        Method::Dop853(tolerance) => {
            let motion = system.simulate_with::<Dop853>(start);
            let mut motion = motion.with_tolerance(tolerance).with_max_steps(MAX_STEPS);
            let end = motion.advance_to(to).copied().map_err(told);
            (end, motion.steps().accepted + motion.steps().rejected)
        }
        Method::Jet8(h) => steps::<S, Jet<8>, N>(system, start, to, h, told),
        Method::Rk4(h) => steps::<S, Rk4, N>(system, start, to, h, told),
    }
}

/// Fixed steps of about `h`, so many that they end at time `to`.
fn steps<S, M, const N: usize>(
    system: &S,
    start: State<f64, N>,
    to: f64,
    h: f64,
    told: fn(MotionError<f64>) -> String,
) -> (Result<State<f64, N>, String>, u64)
where
    S: System<N, 0, Scalar = f64>,
    M: FixedStep<S, N, 0>,
{
    let span = to - start.t;
    let count = (span / h).ceil() as u64;
    let mut motion = system.stepper::<M>(start);
    for step in 0..count {
        if let Err(error) = motion.step(span / count as f64, &[]) {
            return (Err(told(error)), step);
        }
    }
    (Ok(*motion.state()), count)
}

impl<S, const N: usize> Run<S, N>
where
    S: System<N, 0, Scalar = f64> + Smooth<N, 0>,
{
    /// Energy at a state.
    fn energy(&self, state: &State<f64, N>) -> f64 {
        self.system.energy_at(&self.system.constants(), state.t, &state.q, &state.v)
    }

    /// The unit of errors of the energy: the kinetic energy of the start.
    fn scale(&self) -> f64 {
        self.energy(&self.start) - self.energy(&State { v: [0.0; N], ..self.start })
    }

    /// Errors of energy and place at the end; angles count modulo turns.
    fn compare(&self, found: &State<f64, N>, allowed: f64) -> Errors {
        let energy = (self.energy(found) - self.energy(&self.start)).abs() / self.scale();
        let off = |a: f64, b: f64| {
            let turns = ((a - b) / std::f64::consts::TAU).round();
            (a - b).abs().min((a - b - turns * std::f64::consts::TAU).abs())
        };
        let place = self.end.q.iter().zip(&found.q).fold(0.0, |worst, (a, b)| {
            let off = off(*a, *b);
            // `f64::max` would hide NaN.
            if off > worst || off.is_nan() { off } else { worst }
        });
        Errors { energy, place, allowed }
    }

    /// The error that the method may have. For a method of fixed order it depends on the motion, and is
    /// measured on the regular part.
    fn allowed(&self, method: Method) -> f64 {
        match method.tolerance() {
            Some(tolerance) => ADDED * tolerance + f64::EPSILON / KEPT,
            None => {
                let (end, _) = advance(&self.system, self.regular, self.end.t, method);
                let regular = end.map_or(0.0, |end| {
                    let errors = self.compare(&end, 0.0);
                    errors.energy.max(errors.place)
                });
                // Fixed steps end at given times: at worst as near to the singular position as the start.
                ADDED * regular + f64::EPSILON / KEPT.min(self.offset.abs())
            }
        }
    }

    /// Whether halves of fixed steps divide an error by two to the power of the order, within a factor of
    /// four. Then the error is one of steps, which are long for the first part of the motion, and not of the
    /// singular position.
    fn falls_by_order(&self, method: Method, errors: Errors) -> bool {
        let (half, factor) = match method {
            Method::Jet8(h) => (Method::Jet8(h / 2.0), 256.0),
            Method::Rk4(h) => (Method::Rk4(h / 2.0), 16.0),
            Method::Jets(_) | Method::Dop853(_) => return false,
        };
        let (end, _) = advance(&self.system, self.start, self.end.t, half);
        end.is_ok_and(|end| {
            let fell = errors.energy / self.compare(&end, 0.0).energy;
            (factor / 4.0..=factor * 4.0).contains(&fell)
        })
    }

    /// The motion by a method, beside the true one.
    pub fn measure(&self, method: Method) -> Outcome {
        let begun = Instant::now();
        let (end, steps) = advance(&self.system, self.start, self.end.t, method);
        let us = begun.elapsed().as_secs_f64() * 1e6;
        let result = end.map(|end| {
            let errors = self.compare(&end, self.allowed(method));
            if errors.are_wrong() && self.falls_by_order(method, errors) {
                Errors { allowed: errors.energy.max(errors.place), ..errors }
            } else {
                errors
            }
        });
        Outcome { offset: self.offset, result, steps, us }
    }
}
