//! What is known of one guard, and its zeros on the present interval.

use super::interval::{Interval, Watched};
use super::{Crossing, Guard};
use crate::error::MotionError;
use crate::integrator::Adaptive;
use crate::real::Ordered;
use crate::roots::{Kind, Memory, Polynomial, Side, Unresolved, Zeros};
use crate::simulation::Control;
use crate::state::State;
use crate::system::System;

/// A guard whose roundings on an interval are so many times those at its start is looked at on a shorter one:
/// what is far away, as the end of a long free fall, must not hide what is near.
const DROWNED: f64 = 256.0;

/// A guard that is so many times its noise away from zero is not zero where a search begins.
const AWAY: f64 = 2.0;

/// A guard that was zero and is so many times its noise away from it has jumped.
const JUMPED: f64 = 16.0;

/// A zero that has been found and not been reported.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pending<R> {
    /// Where in the interval.
    pub theta: R,
    pub crossing: Crossing,
}

/// Why a guard tells nothing on an interval.
pub(super) enum Refused<R> {
    /// A shorter one may do.
    TooLong(Unresolved),
    /// The motion is not known there.
    Failed(MotionError<R>),
}

/// A guard along a search.
#[derive(Clone, Debug)]
pub(super) struct Track<R> {
    /// What is known where the interval starts.
    memory: Memory,
    /// Its zeros on the interval that are yet to come.
    zeros: Option<Zeros<R>>,
    /// The next of them.
    pub pending: Option<Pending<R>>,
}

impl<R: Ordered> Track<R> {
    pub fn new() -> Self {
        Self { memory: Memory::Unknown, zeros: None, pending: None }
    }

    /// Whether the guard has reached zero, which has not been reported since it has not left it. From then on it
    /// counts as reported.
    pub fn take_touching(&mut self) -> bool {
        let touches = matches!(self.memory, Memory::Touching(_));
        if touches {
            self.memory = Memory::Zero(None);
        }
        touches
    }

    /// Interpolates the guard on an interval; `states` are those at its ends and between. If `strict`, an
    /// interval on which the start drowns in the roundings of the end is too long.
    pub fn look<S, C, M, G, const N: usize, const K: usize>(
        &mut self,
        watched: &mut Watched<'_, '_, S, C, M, G, N, K>,
        interval: Interval<R>,
        states: &[State<R, N>; 3],
        strict: bool,
    ) -> Result<(), Refused<R>>
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        let [near, far] = watched.sizes(states);
        let mut error = None;
        let polynomial =
            Polynomial::interpolate(far, |theta| watched.at_time(interval.time(theta), &mut error));
        if let Some(error) = error {
            return Err(Refused::Failed(error));
        }
        let polynomial = polynomial.map_err(Refused::TooLong)?;
        let noise = polynomial.noise();
        let eight = R::from_f64(8.0);
        if strict && noise > R::from_f64(DROWNED) * eight * R::epsilon() * near {
            return Err(Refused::TooLong(Unresolved::Degree));
        }
        let start = polynomial.value(R::zero());
        let memory = match self.memory {
            Memory::Unknown => begin(start, R::from_f64(AWAY) * noise),
            Memory::Zero(side) if start.abs() > R::from_f64(JUMPED) * noise => {
                side.map_or_else(|| begin(start, noise), Memory::Side)
            }
            memory => memory,
        };
        self.zeros = Some(polynomial.zeros(memory, R::one()));
        Ok(())
    }

    /// Compares the ends of an interval of the resolution of time, where no polynomial fits the guard. False if
    /// it is no number at the end.
    pub fn compare<S, C, M, G, const N: usize, const K: usize>(
        &mut self,
        watched: &Watched<'_, '_, S, C, M, G, N, K>,
        interval: Interval<R>,
        states: &[State<R, N>; 3],
    ) -> bool
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        let [from, _, to] = states;
        let [from, to] = [from, to].map(|state| watched.at(state));
        if !(from.is_finite() && to.is_finite()) {
            return false;
        }
        // The change across a jump says nothing of roundings.
        let [near, _] = watched.sizes(&[states[0]; 3]);
        let noise = R::from_f64(16.0) * R::epsilon() * near;
        let before = match self.memory {
            Memory::Unknown => begin(from, noise),
            memory => memory,
        };
        self.zeros = None;
        let (came_from, counted) = match before {
            Memory::Side(side) | Memory::Touching(side) => (Some(side), false),
            Memory::Zero(side) => (side, true),
            Memory::Unknown => (None, true),
        };
        self.memory = match (begin(to, noise), came_from) {
            (Memory::Side(side), Some(before)) => {
                let returns = matches!(self.memory, Memory::Touching(_)) && side == before;
                if side != before {
                    self.set(R::one(), side_crossing(side), interval);
                } else if returns {
                    self.set(R::one(), Kind::Grazing, interval);
                }
                Memory::Side(side)
            }
            (Memory::Side(side), None) => Memory::Side(side),
            (_, Some(before)) if !counted => Memory::Touching(before),
            (_, came_from) => Memory::Zero(came_from),
        };
        true
    }

    fn set(&mut self, theta: R, kind: Kind, interval: Interval<R>) {
        let crossing = match (kind, interval.is_backward()) {
            (Kind::Grazing, _) => Crossing::Touching,
            (Kind::Rising, false) | (Kind::Falling, true) => Crossing::Rising,
            (Kind::Falling, false) | (Kind::Rising, true) => Crossing::Falling,
        };
        self.pending = Some(Pending { theta, crossing });
    }

    /// Finds the next zero on the interval, behind those before `after`, to the last bit. At the end of them the
    /// memory is that of the end of the interval.
    pub fn refill<S, C, M, G, const N: usize, const K: usize>(
        &mut self,
        watched: &mut Watched<'_, '_, S, C, M, G, N, K>,
        interval: Interval<R>,
        after: R,
    ) where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        let Some(zeros) = &mut self.zeros else { return };
        match zeros.next() {
            Some(zero) => {
                // A state that is not known will be an error where the event asks for it.
                let mut error = None;
                let theta = zero.polish(|theta| watched.at_time(interval.time(theta), &mut error));
                let theta = if theta > after { theta } else { after };
                self.set(theta, zero.kind, interval);
            }
            None => {
                self.memory = zeros.memory();
                self.zeros = None;
            }
        }
    }
}

/// What is known from a value alone.
fn begin<R: Ordered>(value: R, noise: R) -> Memory {
    if value > noise {
        Memory::Side(Side::Above)
    } else if value < -noise {
        Memory::Side(Side::Below)
    } else {
        Memory::Zero(None)
    }
}

/// The crossing that leads to a side.
fn side_crossing(side: Side) -> Kind {
    match side {
        Side::Above => Kind::Rising,
        Side::Below => Kind::Falling,
    }
}
