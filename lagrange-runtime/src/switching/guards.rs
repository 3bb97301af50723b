//! Guards: what ends a regime where it falls through zero.

use super::scene::{Scales, extent, most, product, rounding};
use super::{Functions, Regime, Row, Switching};
use crate::constraints::Balance;
use crate::linear::SaddlePoint;
use crate::motion::roots::{Kind, Memory, Polynomial, Side, Unresolved};
use crate::number::real::{Ordered, Real};
use crate::series::taylor::Taylor;
use crate::system::error::Cause;
use crate::system::state::State;

/// Evaluations of all guards that are kept: those of a polynomial of degree 16, and what tests it.
const KEPT: usize = 24;

/// A step is halved so often before its guards are given up.
const HALVINGS: i32 = 24;

/// Which guard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Guard {
    Row(usize),
    Kink(usize),
}

/// What each guard is, in a regime.
#[derive(Clone, Copy, Debug)]
pub(super) struct Watch<R, const C: usize> {
    /// Rows that have a guard.
    rows: [bool; C],
    /// Whether reactions are among them.
    reactions: bool,
    /// Slip velocities in two directions where the step starts: while the slip has a part in the same direction
    /// it has not turned back.
    directions: [R; C],
}

/// Values of all guards and their sizes.
#[derive(Clone, Copy, Debug)]
struct Values<R, const C: usize, const W: usize> {
    rows: [R; C],
    row_sizes: [R; C],
    kinks: [R; W],
    kink_sizes: [R; W],
}

impl<R: Real, const C: usize, const W: usize> Values<R, C, W> {
    const fn of(zero: R) -> Self {
        Self { rows: [zero; C], row_sizes: [zero; C], kinks: [zero; W], kink_sizes: [zero; W] }
    }

    fn get(&self, guard: Guard) -> (R, R) {
        let (value, size) = match guard {
            Guard::Row(row) => (self.rows.get(row), self.row_sizes.get(row)),
            Guard::Kink(kink) => (self.kinks.get(kink), self.kink_sizes.get(kink)),
        };
        (value.copied().unwrap_or(R::one()), size.copied().unwrap_or(R::zero()))
    }
}

/// The guards of a regime.
pub(super) struct Guards<'a, S, const N: usize, const K: usize, const C: usize, const W: usize>
where
    S: Switching<N, K, C, W>,
{
    pub(super) system: &'a S,
    pub(super) in_regime: &'a S::InRegime,
    pub(super) regime: &'a Regime<S::Scalar, C, W>,
    pub(super) inputs: &'a [S::Scalar; K],
    watch: Watch<S::Scalar, C>,
    /// Whether the motion is a polynomial.
    is_along: bool,
}

impl<'a, S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'a, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The guards of a step that starts at a state.
    pub(super) fn new(
        system: &'a S,
        in_regime: &'a S::InRegime,
        regime: &'a Regime<S::Scalar, C, W>,
        inputs: &'a [S::Scalar; K],
        start: &State<S::Scalar, N>,
        is_along: bool,
    ) -> Self {
        let zero: S::Scalar = num_traits::Zero::zero();
        let slips = |row: usize| regime.slip[row] != zero;
        let mut watch = Watch { rows: [false; C], reactions: false, directions: [zero; C] };
        let mut turns = false;
        for (row, kind) in S::ROWS.iter().enumerate() {
            (watch.rows[row], watch.reactions) = match kind {
                Row::Bilateral => {
                    let drives = S::ROWS.iter().enumerate().any(|(other, kind)| {
                        matches!(kind, Row::Friction { normal: Some(normal), .. } if *normal == row)
                            && slips(other)
                    });
                    (drives, watch.reactions || drives)
                }
                Row::Unilateral => (true, watch.reactions || regime.active[row]),
                Row::Friction { pair, .. } => {
                    let is_first = pair.is_none_or(|other| row < other);
                    turns = turns || pair.is_some() && slips(row);
                    let is_active = regime.active[row] && is_first;
                    (is_active || slips(row), watch.reactions || is_active)
                }
            };
        }
        if turns {
            watch.directions = system.laws_at(start.t, &start.q, &start.v).rows.rates;
        }
        Self { system, in_regime, regime, inputs, watch, is_along }
    }

    /// Whether there is nothing to look at.
    pub(super) fn is_empty(&self) -> bool {
        W == 0 && !self.watch.rows.contains(&true)
    }

    /// The rows whose guards are reactions, or all of which a method without polynomials knows nothing else.
    fn is_sampled(&self, row: usize) -> bool {
        self.watch.rows[row] && (!self.is_along || self.is_reaction(row))
    }

    /// Whether the guard of a row is made of reactions.
    fn is_reaction(&self, row: usize) -> bool {
        S::ROWS[row] == Row::Bilateral || self.regime.active[row]
    }

    /// The guards that are polynomials where the motion is one.
    pub(super) fn along(&self) -> impl Iterator<Item = Guard> + '_ {
        let rows = (0..C).filter(|&row| self.watch.rows[row] && !self.is_reaction(row)).map(Guard::Row);
        rows.chain((0..W).map(Guard::Kink))
    }

    /// The guards that are looked at by samples.
    fn sampled(&self) -> impl Iterator<Item = Guard> + '_ {
        let kinks = if self.is_along { 0 } else { W };
        (0..C).filter(|&row| self.is_sampled(row)).map(Guard::Row).chain((0..kinks).map(Guard::Kink))
    }

    /// One of the guards that are no reactions.
    pub(super) fn guard<T: Real>(
        &self,
        guard: Guard,
        functions: &Functions<T, C, W>,
        number: impl Fn(S::Scalar) -> T,
    ) -> T {
        let signed = |sign: S::Scalar, value: T| if (-sign).is_positive() { -value } else { value };
        match guard {
            Guard::Kink(kink) => signed(self.regime.kinks[kink], functions.kinks[kink]),
            Guard::Row(row) => match S::ROWS[row] {
                Row::Friction { pair: None, .. } => signed(self.regime.slip[row], functions.rows[row]),
                Row::Friction { pair: Some(other), .. } => {
                    let along = |row: usize| number(self.watch.directions[row]) * functions.rows[row];
                    along(row) + along(other)
                }
                Row::Unilateral | Row::Bilateral => functions.rows[row],
            },
        }
    }

    /// The functions of guards that are no reactions, at a state, with their roundings.
    fn functions(&self, state: &State<S::Scalar, N>) -> Functions<Taylor<S::Scalar>, C, W> {
        let [q, v] = [state.q, state.v].map(|numbers| numbers.map(Taylor::value));
        S::functions_in(self.in_regime, Taylor::constant, Taylor::value(state.t), &q, &v)
    }

    /// One of those guards at a state, with its roundings.
    pub(super) fn value(&self, guard: Guard, state: &State<S::Scalar, N>) -> Taylor<S::Scalar> {
        self.guard(guard, &self.functions(state), Taylor::constant)
    }

    /// The multipliers at a state, and the forces at their rows that they are differences of: what bears nothing,
    /// as one of three feet does whose load is on the line between the others, is known no better than the load.
    fn multipliers(&self, state: &State<S::Scalar, N>) -> [[S::Scalar; C]; 2] {
        let zero: S::Scalar = num_traits::Zero::zero();
        let State { t, q, v } = state;
        let Some(equations) = S::equations_in(self.in_regime, *t, q, v, self.inputs) else {
            return [[S::Scalar::from_f64(f64::NAN); C], [zero; C]];
        };
        let Balance { multipliers, .. } = equations.balance();
        let units = equations.saddle.units();
        let forces: [S::Scalar; N] = core::array::from_fn(|i| {
            let borne = equations.gradients.iter().zip(&multipliers);
            borne.fold(equations.forces[i].abs(), |sum, (row, &force)| sum + (row[i] * force).abs())
                * units[i]
        });
        let sizes = core::array::from_fn(|row| {
            let gradient = core::array::from_fn(|i| equations.gradients[row][i] * units[i]);
            let squares = product(&gradient, &gradient);
            let size = if squares.is_positive() { extent(&gradient, &forces) / squares } else { zero };
            most(size, multipliers[row].abs())
        });
        [multipliers, sizes]
    }

    /// All guards at a state that are looked at by samples.
    fn values(&self, state: &State<S::Scalar, N>) -> Values<S::Scalar, C, W> {
        let mut values = Values::of(num_traits::Zero::zero());
        if self.watch.reactions {
            let laws = self.system.laws_at(state.t, &state.q, &state.v);
            let [multipliers, sizes] = self.multipliers(state);
            for row in (0..C).filter(|&row| self.is_sampled(row) && self.is_reaction(row)) {
                let reaction = multipliers[row];
                (values.rows[row], values.row_sizes[row]) = match S::ROWS[row] {
                    Row::Bilateral => (self.regime.side[row] * reaction, sizes[row]),
                    Row::Unilateral => (reaction, sizes[row]),
                    Row::Friction { normal, pair } => {
                        let limit =
                            laws.fixed[row] * normal.map_or(num_traits::One::one(), |row| multipliers[row]);
                        let other = pair.map_or(num_traits::Zero::zero(), |row| multipliers[row]);
                        let force = reaction * reaction + other * other;
                        (limit * limit - force, limit * limit + force)
                    }
                };
            }
        }
        if self.is_along {
            return values;
        }
        let functions = self.functions(state);
        for guard in self.along() {
            let value = self.guard(guard, &functions, Taylor::constant);
            let known = (value.start(), value.error / S::Scalar::epsilon());
            match guard {
                Guard::Row(row) => (values.rows[row], values.row_sizes[row]) = known,
                Guard::Kink(kink) => (values.kinks[kink], values.kink_sizes[kink]) = known,
            }
        }
        values
    }

    /// The first guard looked at by samples that falls through zero on a step between two times, before a part of it
    /// has passed, and the part that has passed then. `at` gives the state after a part.
    pub(super) fn first(
        &self,
        scales: &Scales<S::Scalar, C>,
        [start, end]: [S::Scalar; 2],
        until: S::Scalar,
        mut at: impl FnMut(S::Scalar) -> Option<State<S::Scalar, N>>,
    ) -> Result<Option<(S::Scalar, Guard)>, Cause> {
        let (zero, one): (S::Scalar, S::Scalar) = (num_traits::Zero::zero(), num_traits::One::one());
        let half = S::Scalar::from_f64(0.5);
        let shortest = half.powi(HALVINGS);
        if self.sampled().next().is_none() || until == zero {
            return Ok(None);
        }
        let (mut from, mut to) = (zero, until);
        let nan = Values::of(S::Scalar::from_f64(f64::NAN));
        // Time is rounded, so that a guard is known no better than it changes meanwhile.
        let late = most(start.abs(), end.abs()) / (end - start).abs();
        loop {
            let width = to - from;
            let mut kept = [(-one, Values::of(zero)); KEPT];
            let mut count = 0;
            let mut values = |place: S::Scalar| {
                if let Some((_, values)) = kept.iter().take(count).find(|(at, _)| *at == place) {
                    return *values;
                }
                let part = if place == one { to } else { from + place * width };
                let values = at(part).map_or(nan, |state| self.values(&state));
                if let Some(free) = kept.get_mut(count) {
                    *free = (place, values);
                    count += 1;
                }
                values
            };
            let mut earliest: Option<(S::Scalar, Guard)> = None;
            let mut unresolved = None;
            for guard in self.sampled() {
                let late = late / (S::Scalar::from_f64(4.0) * width);
                match self.falls(guard, scales, late, &mut |place| values(place).get(guard)) {
                    Ok(Some(place)) if earliest.is_none_or(|(other, _)| place < other) => {
                        earliest = Some((place, guard));
                    }
                    Ok(_) => {}
                    Err(why) => unresolved = Some(why),
                }
            }
            match (unresolved, earliest) {
                // What lies before all that is not resolved is known; the rest of the step does not matter.
                (Some(why), _) if width <= shortest => {
                    return Err(why.cause());
                }
                (Some(_), _) => to = from + half * width,
                (None, Some((place, guard))) => {
                    let part = if place == one { to } else { from + place * width };
                    return Ok(Some((part, guard)));
                }
                (None, None) if to >= until => return Ok(None),
                (None, None) => {
                    let next = to + width + width;
                    (from, to) = (to, if next < until { next } else { until });
                }
            }
        }
    }

    /// How long after the zero of a guard a time is that rounding has made of it, from its values there and a little
    /// earlier.
    pub(super) fn late(&self, guard: Guard, [earlier, there]: [&State<S::Scalar, N>; 2]) -> S::Scalar {
        let [before, value] = [earlier, there].map(|state| self.values(state).get(guard).0);
        let late = value / (value - before) * (there.t - earlier.t);
        let ulps = S::Scalar::from_f64(4.0) * S::Scalar::epsilon() * there.t.abs();
        if late.abs() <= ulps { late } else { num_traits::Zero::zero() }
    }

    /// The size of the guard of a row in the course of the motion.
    fn scale(&self, row: usize, scales: &Scales<S::Scalar, C>) -> S::Scalar {
        let is_active = self.regime.active[row];
        match S::ROWS[row] {
            Row::Unilateral if !is_active => scales.gaps[row],
            Row::Bilateral | Row::Unilateral => scales.reactions[row],
            Row::Friction { .. } if is_active => scales.reactions[row] * scales.reactions[row],
            Row::Friction { pair: None, .. } => scales.speeds[row],
            Row::Friction { pair: Some(other), .. } => {
                let direction = self.watch.directions[row].hypot(self.watch.directions[other]);
                direction * most(scales.speeds[row], scales.speeds[other])
            }
        }
    }

    /// Where a guard falls through zero on a part of the step.
    fn falls(
        &self,
        guard: Guard,
        scales: &Scales<S::Scalar, C>,
        late: S::Scalar,
        value: &mut impl FnMut(S::Scalar) -> (S::Scalar, S::Scalar),
    ) -> Result<Option<S::Scalar>, Unresolved> {
        let (zero, one) = (num_traits::Zero::zero(), num_traits::One::one());
        let (start, end) = (value(zero), value(one));
        let scale = match guard {
            Guard::Row(row) => self.scale(row, scales),
            Guard::Kink(_) => zero,
        };
        let spread = [0.25, 0.5, 0.75].iter().fold((end.0 - start.0).abs(), |spread, &place| {
            most(spread, (value(S::Scalar::from_f64(place)).0 - start.0).abs())
        });
        let size = most(start.1, end.1) + late * spread;
        let polynomial = Polynomial::interpolate(size, |place| value(place).0)?;
        let noise = most(polynomial.noise(), rounding::<S::Scalar>() * most(start.1, scale));
        let is_gap = matches!(guard, Guard::Row(row)
            if S::ROWS[row] == Row::Unilateral && !self.regime.active[row]);
        let memory = if start.0 > noise {
            Memory::Side(Side::Above)
        } else if start.0 >= -noise || is_gap {
            // What has just begun begins at zero.
            Memory::Zero(Some(Side::Above))
        } else {
            return Ok(Some(zero));
        };
        let zero = polynomial.first(Kind::Falling, memory);
        Ok(zero.map(|zero| zero.polish(|place| value(place).0)))
    }
}
