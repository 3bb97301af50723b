//! The knowledge of one guard, and its zeros on the present interval.

use super::interval::{Interval, POINTS, Watched};
use super::{Crossing, Guard};
use crate::motion::roots::{Kind, Memory, Polynomial, Side, Unresolved, Zeros};
use crate::number::elements::Each;
use crate::number::real::{Ordered, larger, smaller};
use crate::system::System;
use crate::system::control::Control;
use crate::system::error::MotionError;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The largest ratio of the rounding errors of a guard on an interval to those at its start; beyond it a
/// shorter interval is taken. The large numbers of a distant time, such as the end of a long free fall, must
/// not hide small ones nearby.
const DROWNED: f64 = 256.0;

/// The number of its rounding errors below which a guard counts as zero where a search begins. It is smaller
/// than in the noise of an interval, so that a guard that was not zero at the end of one search is not zero
/// at the start of the next.
const AT_START: f64 = 4.0;

/// A part of an interval to take the slope over. By as much beyond the interval, Chebyshev polynomials of
/// degree 64 grow to cosh 2, and not more.
const PART: f64 = 1.0 / 4096.0;

/// A guard that was zero has jumped if it is now more than this many times its noise away from zero.
const JUMPED: f64 = 16.0;

/// The resolution of time, in ulps, where no polynomial fits a guard. A zero there is known no better.
pub(super) const RESOLVED: f64 = 64.0;

/// A zero that has been found and not been reported.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pending<R> {
    /// Where in the interval.
    pub theta: R,
    pub crossing: Crossing,
    /// How well the time is known \[s].
    pub blur: R,
}

/// Why a guard tells nothing on an interval.
pub(super) enum Refused<R> {
    /// A shorter one may do.
    TooLong(Unresolved),
    /// This part of it may do.
    Beyond(R),
    /// The motion is not known there.
    Failed(MotionError<R>),
}

/// A guard along a search.
#[derive(Clone, Debug)]
pub(super) struct Track<R> {
    /// The knowledge of the guard where the interval starts.
    memory: Memory,
    /// Where the interval ends: the side that the guard goes on to, and how well a zero there is known.
    beyond: (Option<Side>, R),
    /// The noise of the guard on the interval.
    noise: R,
    /// Its zeros on the interval that are yet to come.
    zeros: Option<Zeros<R>>,
    /// The next of them.
    pending: Option<Pending<R>>,
}

impl<R: Ordered> Track<R> {
    pub fn new() -> Self {
        let (zero, unknown) = (R::zero(), Memory::Unknown);
        Self { memory: unknown, beyond: (None, zero), noise: zero, zeros: None, pending: None }
    }

    /// Notes that the state has other numbers for the same orientations. The guard may then have the other
    /// sign, as components of a quaternion have. That is no zero.
    pub fn renamed(&mut self, before: R, after: R) {
        if (after + before).abs() < (after - before).abs() {
            self.memory = self.memory.opposite();
        }
    }

    /// Notes that the motion has jumped at the end of the interval, and the guard to this value. If it has
    /// come to the other side of zero, that is a crossing there.
    pub fn jumped(&mut self, after: R, interval: Interval<R>) {
        if let (Memory::Side(before), Memory::Side(side)) = (self.memory, begin(after, self.noise))
            && side != before
        {
            self.memory = Memory::Side(side);
            self.set(R::one(), leading_to(side), interval, R::epsilon() * interval.to.abs());
        }
    }

    /// The next zero on the interval that has not been counted. If the search `ends` there, that may be
    /// one at the end of the interval which the guard has not left.
    pub fn next(&self, interval: Interval<R>, ends: bool) -> Option<Pending<R>> {
        self.pending.or_else(|| if ends { self.last(interval) } else { None })
    }

    /// A zero at the end of the interval that has not been counted, because the guard has not left it.
    fn last(&self, interval: Interval<R>) -> Option<Pending<R>> {
        let Memory::Touching(before) = self.memory else { return None };
        let (beyond, blur) = self.beyond;
        let kind = beyond.filter(|&side| side != before).map_or(Kind::Grazing, leading_to);
        Some(Pending { theta: R::one(), crossing: crossing(kind, interval), blur })
    }

    /// Counts the next zero.
    pub fn count<S, C, M, G, const N: usize, const K: usize>(
        &mut self,
        watched: &mut Watched<'_, '_, S, C, M, G, N, K>,
        interval: Interval<R>,
    ) where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        match self.pending.take() {
            Some(counted) => self.refill(watched, interval, counted.theta),
            None => self.memory = Memory::Zero(None),
        }
    }

    /// Interpolates the guard on an interval. `blur` is the uncertainty of the time of its start, if an event
    /// led there. If `strict`, an interval on which the start drowns in the rounding errors of the end is too
    /// long. Kinks nearer to its ends than a `resolution` of time \[s] do not count.
    pub fn look<S, C, M, G, const N: usize, const K: usize>(
        &mut self,
        watched: &mut Watched<'_, '_, S, C, M, G, N, K>,
        interval: Interval<R>,
        states: &[State<R, N>; POINTS],
        (blur, strict, resolution): (Option<R>, bool, R),
    ) -> Result<(), Refused<R>>
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        watched.has_no_kinks(interval, states, resolution)?;
        let sizes = watched.sizes(states);
        let mut error = None;
        let polynomial =
            Polynomial::interpolate(sizes.far, |theta| watched.at_time(interval.time(theta), &mut error));
        if let Some(error) = error {
            return Err(Refused::Failed(error));
        }
        let polynomial = polynomial.map_err(Refused::TooLong)?;
        if G::NARROW && watched.strays(interval, &polynomial) {
            return Err(Refused::TooLong(Unresolved::Degree));
        }
        let (noise, one) = (polynomial.noise(), R::one());
        let roundings = |count| R::from_f64(count) * R::epsilon();
        let (start, part) = (polynomial.value(R::zero()), R::from_f64(PART));
        let second = part * (interval.to - interval.from).abs();
        let [first, ..] = states;
        let rate = (polynomial.value(part) - start).abs() / second;
        let is_drowned = noise > roundings(8.0 * DROWNED) * (sizes.near + rate * interval.from.abs());
        // A guard that stays within the noise on all of the interval, as the gap of a contact that is closed,
        // shows no more on a part of it.
        if strict && is_drowned && polynomial.extent() > noise {
            return Err(Refused::TooLong(Unresolved::Degree));
        }
        let memory = match self.memory {
            Memory::Unknown => {
                let known =
                    blur.map_or(R::zero(), |blur| R::from_f64(4.0) * rate * blur + R::from_f64(2.0) * noise);
                begin(watched.at(first), roundings(AT_START) * sizes.start + known)
            }
            Memory::Zero(side) if start.abs() > R::from_f64(JUMPED) * noise => {
                side.map_or_else(|| begin(start, noise), Memory::Side)
            }
            memory => memory,
        };
        let rate = (polynomial.value(one) - polynomial.value(one - part)).abs() / second;
        let side = match begin(polynomial.value(one + part), R::from_f64(4.0) * noise) {
            Memory::Side(side) => Some(side),
            _ => None,
        };
        self.beyond = (side, blurred(noise, rate, interval));
        self.noise = noise;
        self.zeros = Some(polynomial.zeros(memory, one));
        Ok(())
    }

    /// Compares the ends of an interval of the resolution of time, where no polynomial fits the guard. False
    /// if it is no number at the end.
    pub fn compare<S, C, M, G, const N: usize, const K: usize>(
        &mut self,
        watched: &Watched<'_, '_, S, C, M, G, N, K>,
        interval: Interval<R>,
        states: &[State<R, N>; POINTS],
    ) -> bool
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        let [first, .., last] = states;
        let [from, to] = [first, last].each(|state| watched.at(state));
        if !(from.is_finite() && to.is_finite()) {
            return false;
        }
        let sizes = watched.sizes(states);
        let noise = R::from_f64(RESOLVED) * R::epsilon() * (sizes.near + sizes.by_time);
        let before = match self.memory {
            Memory::Unknown => begin(from, noise),
            memory => memory,
        };
        (self.zeros, self.beyond) = (None, (None, (interval.to - interval.from).abs()));
        let blur = self.beyond.1;
        let (came_from, counted) = match before {
            Memory::Side(side) | Memory::Touching(side) => (Some(side), false),
            Memory::Zero(side) => (side, true),
            Memory::Unknown => (None, true),
        };
        self.memory = match (begin(to, noise), came_from) {
            (Memory::Side(side), Some(before)) => {
                let returns = matches!(self.memory, Memory::Touching(_)) && side == before;
                if side != before {
                    self.set(R::one(), leading_to(side), interval, blur);
                } else if returns {
                    self.set(R::one(), Kind::Grazing, interval, blur);
                }
                Memory::Side(side)
            }
            (Memory::Side(side), None) => Memory::Side(side),
            (_, Some(before)) if !counted => Memory::Touching(before),
            (_, came_from) => Memory::Zero(came_from),
        };
        true
    }

    fn set(&mut self, theta: R, kind: Kind, interval: Interval<R>, blur: R) {
        self.pending = Some(Pending { theta, crossing: crossing(kind, interval), blur });
    }

    /// Finds the next zero on the interval to the last bit, at `after` or behind it. Where none is left, the
    /// memory becomes that of the end of the interval.
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
                let part = R::from_f64(PART);
                let [low, high] =
                    [larger(theta - part, R::zero()), smaller(theta + part, R::one())].each(|theta| {
                        let t = interval.time(theta);
                        (t, watched.at_time(t, &mut error))
                    });
                let rate = ((high.1 - low.1) / (high.0 - low.0)).abs();
                let blur = match zero.kind {
                    Kind::Grazing => R::zero(),
                    _ => blurred(self.noise, rate, interval),
                };
                self.set(theta, zero.kind, interval, blur);
            }
            None => {
                self.memory = zeros.memory();
                self.zeros = None;
            }
        }
    }
}

/// The knowledge of a guard from a value alone.
pub(super) fn begin<R: Ordered>(value: R, noise: R) -> Memory {
    if value > noise {
        Memory::Side(Side::Above)
    } else if value < -noise {
        Memory::Side(Side::Below)
    } else {
        Memory::Zero(None)
    }
}

/// The crossing that leads to a side.
fn leading_to(side: Side) -> Kind {
    match side {
        Side::Above => Kind::Rising,
        Side::Below => Kind::Falling,
    }
}

/// The kind, as time grows, of a zero that was met on the way.
fn crossing<R: Ordered>(kind: Kind, interval: Interval<R>) -> Crossing {
    match (kind, interval.is_backward()) {
        (Kind::Grazing, _) => Crossing::Touching,
        (Kind::Rising, false) | (Kind::Falling, true) => Crossing::Rising,
        (Kind::Falling, false) | (Kind::Rising, true) => Crossing::Falling,
    }
}

/// The uncertainty of the time of a zero that the guard crosses at this rate.
fn blurred<R: Ordered>(noise: R, rate: R, interval: Interval<R>) -> R {
    let resolution = R::epsilon() * larger(interval.from.abs(), interval.to.abs());
    let by_noise = noise / rate;
    // The blur of a crossing is less than a part of the interval.
    let longest = R::from_f64(PART) * (interval.to - interval.from).abs();
    resolution + if by_noise < longest { by_noise } else { R::zero() }
}
