//! Guards: what ends a regime where it falls through zero.

use super::scene::{Scales, most, rounding};
use super::{Regime, Row, Switching};
use crate::constraints::Balance;
use crate::error::Cause;
use crate::real::{Ordered, Real};
use crate::roots::{Kind, Memory, Polynomial, Side, Unresolved};
use crate::state::State;

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
pub(super) struct Watch<R, const C: usize, const W: usize> {
    /// Rows that have a guard.
    rows: [bool; C],
    /// Kinks that a step can reach.
    kinks: [bool; W],
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
    watch: Watch<S::Scalar, C, W>,
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
    ) -> Self {
        let zero: S::Scalar = num_traits::Zero::zero();
        let slips = |row: usize| regime.slip[row] != zero;
        let mut watch = Watch { rows: [false; C], kinks: [true; W], reactions: false, directions: [zero; C] };
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
        Self { system, in_regime, regime, inputs, watch }
    }

    /// Whether there is nothing to look at.
    pub(super) fn is_empty(&self) -> bool {
        !self.watch.kinks.contains(&true) && !self.watch.rows.contains(&true)
    }

    /// Leaves out the guards that cannot reach zero while time, coordinates and velocities move by no more than
    /// this from the start of the step.
    pub(super) fn leave_out(
        &mut self,
        start: &State<S::Scalar, N>,
        time: S::Scalar,
        [q, v]: &[[S::Scalar; N]; 2],
    ) {
        let laws = self.system.laws_at(start.t, &start.q, &start.v);
        let reach = self.system.reach_at(time, q, v);
        let is_far = |value: S::Scalar, size: S::Scalar, reach: S::Scalar| {
            value > S::Scalar::from_f64(1.125) * reach + rounding::<S::Scalar>() * size
        };
        let rows = &laws.rows;
        for (row, kind) in S::ROWS.iter().enumerate() {
            let is_left_out = match kind {
                Row::Unilateral if !self.regime.active[row] => {
                    is_far(rows.positions[row], rows.position_sizes[row], reach.positions[row])
                }
                Row::Friction { pair: None, .. } if !self.regime.active[row] => {
                    let speed = self.regime.slip[row] * rows.rates[row];
                    is_far(speed, rows.rate_sizes[row], reach.rates[row])
                }
                _ => false,
            };
            self.watch.rows[row] = self.watch.rows[row] && !is_left_out;
        }
        for (kink, watched) in self.watch.kinks.iter_mut().enumerate() {
            let value = self.regime.kinks[kink] * laws.kinks[kink];
            *watched = !is_far(value, laws.kink_sizes[kink], reach.kinks[kink]);
        }
    }

    /// The multipliers at a state.
    fn multipliers(&self, state: &State<S::Scalar, N>) -> [S::Scalar; C] {
        let State { t, q, v } = state;
        let none = [S::Scalar::from_f64(f64::NAN); C];
        if !self.watch.reactions {
            return none;
        }
        let equations = S::equations_in(self.in_regime, *t, q, v, self.inputs);
        equations.map_or(none, |equations| {
            let Balance { multipliers, .. } = equations.balance();
            multipliers
        })
    }

    /// All guards at a state.
    fn values(&self, state: &State<S::Scalar, N>) -> Values<S::Scalar, C, W> {
        let laws = self.system.laws_at(state.t, &state.q, &state.v);
        let multipliers = self.multipliers(state);
        let mut values = Values::of(num_traits::Zero::zero());
        for (row, kind) in S::ROWS.iter().enumerate() {
            if !self.watch.rows[row] {
                continue;
            }
            let reaction = multipliers[row];
            (values.rows[row], values.row_sizes[row]) = match kind {
                Row::Bilateral => (self.regime.side[row] * reaction, reaction.abs()),
                Row::Unilateral if self.regime.active[row] => (reaction, reaction.abs()),
                Row::Unilateral => (laws.rows.positions[row], laws.rows.position_sizes[row]),
                Row::Friction { normal, pair } if self.regime.active[row] => {
                    let limit =
                        laws.fixed[row] * normal.map_or(num_traits::One::one(), |row| multipliers[row]);
                    let other = pair.map_or(num_traits::Zero::zero(), |row| multipliers[row]);
                    let force = reaction * reaction + other * other;
                    (limit * limit - force, limit * limit + force)
                }
                Row::Friction { pair, .. } => {
                    let rate = |row: usize| (laws.rows.rates[row], laws.rows.rate_sizes[row]);
                    match pair {
                        None => (self.regime.slip[row] * rate(row).0, rate(row).1),
                        Some(other) => {
                            let along = |row: usize| {
                                let direction = self.watch.directions[row];
                                (direction * rate(row).0, direction.abs() * rate(row).1)
                            };
                            let (a, b) = (along(row), along(*other));
                            (a.0 + b.0, a.1 + b.1)
                        }
                    }
                }
            };
        }
        for (kink, &side) in self.regime.kinks.iter().enumerate() {
            values.kinks[kink] = side * laws.kinks[kink];
            values.kink_sizes[kink] = laws.kink_sizes[kink];
        }
        values
    }

    /// The first guard that falls through zero on a step between two times, and the part of the step that has passed
    /// then. `at` gives the state after a part of it.
    pub(super) fn first(
        &self,
        scales: &Scales<S::Scalar, C>,
        [start, end]: [S::Scalar; 2],
        mut at: impl FnMut(S::Scalar) -> Option<State<S::Scalar, N>>,
    ) -> Result<Option<(S::Scalar, Guard)>, Cause> {
        let (zero, one): (S::Scalar, S::Scalar) = (num_traits::Zero::zero(), num_traits::One::one());
        let half = S::Scalar::from_f64(0.5);
        let shortest = half.powi(HALVINGS);
        let (mut from, mut to) = (zero, one);
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
            let rows = (0..C).filter(|&row| self.watch.rows[row]).map(Guard::Row);
            let guards = rows.chain((0..W).filter(|&kink| self.watch.kinks[kink]).map(Guard::Kink));
            let mut earliest: Option<(S::Scalar, Guard)> = None;
            let mut unresolved = None;
            for guard in guards {
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
                    return match why {
                        Unresolved::NotFinite => Err(Cause::NotFinite),
                        Unresolved::Degree => Err(Cause::StepTooSmall),
                    };
                }
                (Some(_), _) => to = from + half * width,
                (None, Some((place, guard))) => {
                    let part = if place == one { to } else { from + place * width };
                    return Ok(Some((part, guard)));
                }
                (None, None) if to >= one => return Ok(None),
                (None, None) => {
                    let next = to + width + width;
                    (from, to) = (to, if next < one { next } else { one });
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
