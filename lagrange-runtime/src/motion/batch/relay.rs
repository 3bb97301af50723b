//! [`Relay`]: one motion after another in each lane of a SIMD vector.
//!
//! A [`Batch`](super::Batch) moves all its lanes to one time and stops if one of them cannot go on. Here each
//! lane has an end of its own, and a lane that has arrived, or has stopped, is given another motion. What a
//! lane does follows from its own numbers: its steps, its unit of time, whether it stops. So the bits of a
//! motion are the same in any lane, beside any others.
//!
//! That holds for systems without functions that hide from series ([`STEEP`](crate::System::STEEP),
//! [`ROOTED`](crate::System::ROOTED)) and without shared pivots ([`Smooth::SHARES_PIVOTS`]), and with
//! constraints that need no decision for all lanes: see [`Relay::unsuited`].

mod abreast;
mod alone;
mod landing;

use num_traits::{One, Zero};

use super::lane::zeros;
pub use super::lane::{get, set};
use super::{ORDERS_PER_DIGIT, tolerated};
use crate::integrator::jets::fall::steepest;
use crate::integrator::jets::{NEAR, SAFETY, last_term, orders};
use crate::number::compensated::add;
use crate::number::elements::Each;
use crate::number::real::{Real, Vector, larger, smaller};
use crate::series::HIGHEST;
use crate::system::attitude;
use crate::system::limits::Limits;
use crate::system::smooth::{Series, Smooth};
use crate::system::state::State;

/// A lane of a scalar.
type Lane<R> = <R as Real>::Lane;

/// The activity of a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It has no motion.
    Idle,
    /// It is on its way.
    Running,
    /// It is at its end. The next step takes it for idle.
    Arrived,
    /// It cannot go on in its lane: its numbers are not finite, its steps vanish or are too many, its
    /// equations have no solution, or its constraints fail a check. A motion of its own tells the cause.
    Stopped,
}

/// Lanes that a relay has at most.
pub const MOST: usize = 16;

/// Motions of `system`, one after the other in each lane of its scalar, by Taylor series.
#[derive(Clone, Copy, Debug)]
pub struct Relay<S: Smooth<N, K>, const N: usize, const K: usize = 0>
where
    S::Scalar: Vector,
{
    system: S,
    constants: S::JetConstants,
    tables: S::Tables<HIGHEST>,
    series: Series<S::Scalar, N, HIGHEST>,
    limits: Limits<Lane<S::Scalar>>,
    /// The order of the series, which follows from the tolerance.
    orders: usize,
    /// The largest ratio of successive terms at this order and tolerance.
    steepest: Lane<S::Scalar>,
    standing: [Standing; MOST],
    /// Attempts that a lane may still make.
    attempts: [u64; MOST],
    /// Whether a lane has begun, and its constraints have not been looked at.
    fresh: [bool; MOST],
    /// Ends \[s].
    target: S::Scalar,
    /// Unit of time of the coefficients \[s], with the direction of the motion; zero if not known.
    unit: S::Scalar,
    state: State<S::Scalar, N>,
    /// The residue of rounding of the state.
    residue: State<S::Scalar, N>,
    /// Where the last step began, and its unit.
    before: (State<S::Scalar, N>, State<S::Scalar, N>, S::Scalar),
    expansions: u64,
}

impl<S: Smooth<N, K>, const N: usize, const K: usize> Relay<S, N, K>
where
    S::Scalar: Vector,
{
    /// Lanes without motions. `system` has the parameters of all lanes, those of idle lanes anything that has
    /// a solution at `start`.
    pub fn new(system: S, start: State<S::Scalar, N>) -> Self {
        let zero: S::Scalar = Zero::zero();
        let none = State { t: zero, q: [zero; N], v: [zero; N] };
        let limits = Limits::new();
        let orders = orders(limits.relative, ORDERS_PER_DIGIT);
        Self {
            constants: system.jet_constants(),
            system,
            tables: S::Tables::default(),
            series: Series::default(),
            orders,
            steepest: steepest(limits.relative, orders),
            limits,
            standing: [Standing::Idle; MOST],
            attempts: [0; MOST],
            fresh: [false; MOST],
            target: start.t,
            unit: zero,
            state: start,
            residue: none,
            before: (start, none, zero),
            expansions: 0,
        }
    }

    /// Why such a system cannot run in lanes: its lanes would depend on each other, or would miss things that
    /// a single motion sees.
    pub fn unsuited() -> Option<&'static str> {
        if S::CONSTRAINED && !S::LANDS_APART {
            Some("has constraints, whose pivots and corrections lanes would share")
        } else if S::STEEP || S::ROOTED {
            Some("has a function that hides from Taylor series, whose steps are compared with the equations")
        } else if S::SHARES_PIVOTS {
            Some("has a mass matrix that may be indefinite, whose pivots lanes would share")
        } else if S::Scalar::COUNT > MOST {
            Some("has more lanes than can be kept apart")
        } else {
            None
        }
    }

    /// As [`Batch::with_tolerance`](super::Batch::with_tolerance); `absolute` as in
    /// [`Simulation::with_tolerances`](crate::Simulation::with_tolerances).
    #[must_use]
    pub fn with_tolerances(mut self, relative: Lane<S::Scalar>, absolute: Option<Lane<S::Scalar>>) -> Self {
        (self.limits.relative, self.limits.absolute) = (relative, absolute);
        self.orders = orders(relative, ORDERS_PER_DIGIT);
        self.steepest = steepest(relative, self.orders);
        self
    }

    /// Longest step \[s].
    #[must_use]
    pub fn with_step_limit(mut self, longest: Lane<S::Scalar>) -> Self {
        self.limits.step = Some(longest);
        self
    }

    /// The largest number of steps of a motion, rejected ones included. Default 10 million.
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.limits.attempts = steps;
        self
    }

    /// The activity of a lane.
    pub fn standing(&self, lane: usize) -> Standing {
        self.standing.get(lane).copied().unwrap_or(Standing::Idle)
    }

    /// The states, lane by lane.
    pub fn state(&self) -> &State<S::Scalar, N> {
        &self.state
    }

    /// Expansions so far, each of all lanes.
    pub fn expansions(&self) -> u64 {
        self.expansions
    }

    /// Replaces the parameters, after which lanes that do not go on must [`begin`](Self::begin) or
    /// [`rest`](Self::rest). Those of lanes that are running must be what they were.
    pub fn set_system(&mut self, system: S) {
        (self.constants, self.system) = (system.jet_constants(), system);
    }

    /// Begins a motion in a lane: `start` to time `end` \[s].
    pub fn begin(&mut self, lane: usize, start: &State<Lane<S::Scalar>, N>, end: Lane<S::Scalar>) {
        set(&mut self.state, lane, start);
        set(&mut self.residue, lane, &zeros());
        self.target.set_lane(lane, end);
        self.unit.set_lane(lane, Zero::zero());
        if let (Some(standing), Some(attempts)) = (self.standing.get_mut(lane), self.attempts.get_mut(lane)) {
            *standing = if start.t == end { Standing::Arrived } else { Standing::Running };
            *attempts = self.limits.attempts;
        }
        if let Some(fresh) = self.fresh.get_mut(lane) {
            *fresh = true;
        }
    }

    /// Leaves a lane idle. It then has the numbers of another lane, `like`, whose parameters it must have,
    /// too: no cause to stop comes from it.
    pub fn rest(&mut self, lane: usize, like: usize) {
        let (state, unit) = (get(&self.state, like), self.unit.lane(like));
        set(&mut self.state, lane, &state);
        self.unit.set_lane(lane, unit);
        if let Some(standing) = self.standing.get_mut(lane) {
            *standing = Standing::Idle;
        }
    }

    /// One step of each lane that is running, of the length that its own series allows. Lanes whose unit of
    /// time was far from the step stay where they are and have a better one for the next call.
    ///
    /// False if some lane needs a look of its own, because its equations have no solution or because lanes
    /// would have to decide together about its constraints; nothing has moved then.
    /// [`Relay::stop_unsolvable`] finds these lanes.
    #[must_use]
    pub fn step(&mut self) -> bool {
        let one: S::Scalar = One::one();
        for lane in 0..S::Scalar::COUNT {
            if self.unit.lane(lane) == Zero::zero() {
                let left = self.target.lane(lane) - self.state.t.lane(lane);
                self.unit.set_lane(lane, if left == Zero::zero() { One::one() } else { left });
            }
        }
        if !(self.begins() && self.expand()) {
            return false;
        }
        let mut tolerated = self.tolerated(one);
        let half = Lane::<S::Scalar>::from_f64(0.5);
        if (0..S::Scalar::COUNT).any(|lane| tolerated.lane(lane) < half) {
            // In a unit much longer than the step the first terms are no measure of the size.
            let closer = self.tolerated(tolerated.min(one));
            for lane in 0..S::Scalar::COUNT {
                if tolerated.lane(lane) < half {
                    tolerated.set_lane(lane, closer.lane(lane));
                }
            }
        }
        self.before = (self.state, self.residue, self.unit);
        self.go_abreast(tolerated) || self.go_apart(tolerated)
    }

    /// Each lane as its own numbers say. False, and nothing has changed, where lanes would have to decide
    /// together.
    fn go_apart(&mut self, tolerated: S::Scalar) -> bool {
        let kept = (self.standing, self.attempts);
        let (mut length, mut theta): (S::Scalar, S::Scalar) = (Zero::zero(), Zero::zero());
        let mut next = self.unit;
        for lane in 0..S::Scalar::COUNT {
            if let Some(found) = self.length(lane, tolerated.lane(lane)) {
                length.set_lane(lane, found.length);
                theta.set_lane(lane, found.theta);
                next.set_lane(lane, found.unit);
            }
        }
        if !self.take(length, theta) {
            (self.standing, self.attempts) = kept;
            return false;
        }
        self.unit = next;
        true
    }

    fn expand(&mut self) -> bool {
        let Self { system, constants, tables, series, state, unit, orders, .. } = self;
        self.expansions += 1;
        let inputs = [Zero::zero(); K];
        system.jet_at(constants, state.t, &state.q, &state.v, &inputs, *unit, *orders, tables, series)
    }

    fn tolerated(&self, span: S::Scalar) -> S::Scalar {
        let Limits { relative, absolute, .. } = self.limits;
        let absolute =
            absolute.map_or(Zero::zero(), |absolute| Lane::<S::Scalar>::from_f64(SAFETY) * absolute);
        let bounds = [last_term(relative), absolute].each(S::Scalar::splat);
        let steepest = S::Scalar::splat(self.steepest);
        tolerated::<S, N, K>(&self.state, &self.series, bounds, steepest, self.orders, span)
    }

    /// The step of a lane, of no length where only its unit changes. `None` leaves the lane as it is.
    fn length(&mut self, lane: usize, tolerated: Lane<S::Scalar>) -> Option<Step<Lane<S::Scalar>>> {
        let number = Lane::<S::Scalar>::from_f64;
        let zero = number(0.0);
        let (Some(standing), Some(attempts)) = (self.standing.get_mut(lane), self.attempts.get_mut(lane))
        else {
            return None;
        };
        if *standing != Standing::Running {
            *standing = Standing::Idle;
            return None;
        }
        let (t, target) = (self.state.t.lane(lane), self.target.lane(lane));
        let left = (target - t) - self.residue.t.lane(lane);
        let unit = self.unit.lane(lane);
        let (direction, unit) = (unit.signum(), unit.abs());
        let resolution = number(4.0) * Lane::<S::Scalar>::epsilon() * larger(target.abs(), t.abs());
        if *attempts == 0 || !(left.is_finite() && get(&self.state, lane).is_finite()) {
            *standing = Standing::Stopped;
            return None;
        }
        *attempts -= 1;
        let is_finite = |rows: &[[S::Scalar; N]; HIGHEST]| {
            rows.get(self.orders - 1).is_some_and(|row| row.iter().all(|x| x.lane(lane).is_finite()))
        };
        let is_finite = tolerated.is_finite() && is_finite(&self.series.q) && is_finite(&self.series.v);
        // The unit changes where the lane is out of the range of the arithmetic or of the domain of the
        // equations. So it does where it is far from the step: coefficients are near the ends of that range.
        let factor = if !is_finite {
            Some(number(1e-3))
        } else if tolerated < number(1.0 / NEAR) || tolerated > number(NEAR) && left.abs() > unit {
            Some(smaller(larger(tolerated, number(1e-6)), number(1e6)))
        } else {
            None
        };
        if let Some(factor) = factor {
            let better = factor * unit;
            if better <= resolution {
                *standing = Standing::Stopped;
            }
            return Some(Step { length: zero, theta: zero, unit: direction * better });
        }
        let natural = self.limits.clip(smaller(tolerated, number(NEAR)) * unit);
        let length = smaller(natural, left.abs());
        if length <= resolution && left.abs() > resolution {
            *standing = Standing::Stopped;
            return None;
        }
        Some(Step { length: direction * length, theta: length / unit, unit: direction * natural })
    }

    /// Goes on by lengths \[s], which are `theta` units. False, and nothing has changed, where lanes would
    /// have to decide together.
    fn take(&mut self, length: S::Scalar, theta: S::Scalar) -> bool {
        let Some(landed) = self.landed(self.reached(length, theta), theta) else { return false };
        let (state, residue) = landed.at;
        let settled = attitude::settle(S::ORIENTATIONS, &state);
        for lane in 0..S::Scalar::COUNT {
            let moves = theta.lane(lane) > Zero::zero();
            let Some(standing) = self.standing.get_mut(lane) else { continue };
            if *standing != Standing::Running || !moves {
                continue;
            }
            if !landed.is_right(lane) {
                *standing = Standing::Stopped;
                continue;
            }
            set(&mut self.state, lane, &get(&state, lane));
            set(&mut self.residue, lane, &get(&residue, lane));
            if let Some(settled) = &settled {
                let settled = get(settled, lane);
                // The same orientations by other triples: the residue of rounding belonged to the old ones.
                if settled != get(&self.state, lane) {
                    let t = self.residue.t.lane(lane);
                    set(&mut self.state, lane, &settled);
                    set(&mut self.residue, lane, &State { t, ..zeros() });
                }
            }
            self.arrives(lane);
        }
        true
    }

    /// States and their residues of rounding after lengths \[s], which are `theta` units.
    #[inline(always)]
    fn reached(&self, length: S::Scalar, theta: S::Scalar) -> (State<S::Scalar, N>, State<S::Scalar, N>) {
        let (gain_q, gain_v) = self.series.gain(theta, self.orders);
        let (mut state, mut residue) = (self.state, self.residue);
        (state.t, residue.t) = add(state.t, residue.t, length);
        for i in 0..N {
            (state.q[i], residue.q[i]) = add(state.q[i], residue.q[i], gain_q[i]);
            (state.v[i], residue.v[i]) = add(state.v[i], residue.v[i], gain_v[i]);
        }
        (state, residue)
    }

    /// Notes that a lane has arrived, or stops it if its numbers are not finite.
    fn arrives(&mut self, lane: usize) {
        let (t, target) = (self.state.t.lane(lane), self.target.lane(lane));
        let left = (target - t) - self.residue.t.lane(lane);
        let resolution =
            Lane::<S::Scalar>::from_f64(4.0) * Lane::<S::Scalar>::epsilon() * larger(target.abs(), t.abs());
        let finite = get(&self.state, lane).is_finite();
        let Some(standing) = self.standing.get_mut(lane) else { return };
        if !finite {
            *standing = Standing::Stopped;
        } else if left.abs() <= resolution {
            self.state.t.set_lane(lane, target);
            self.residue.t.set_lane(lane, Zero::zero());
            *standing = Standing::Arrived;
        }
    }
}

/// A step of a lane: its length \[s], the same in units, and the unit of the next one.
struct Step<L> {
    length: L,
    theta: L,
    unit: L,
}
