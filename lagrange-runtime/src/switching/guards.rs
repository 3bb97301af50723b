//! Guards: functions that end a regime where they fall through zero.

mod values;
mod watch;

use super::scales::Scales;
use super::scene::{entry, most, rounding};
use super::sided::laws_on;
use super::{Functions, Regime, Row, Switching};
use crate::motion::roots::{Kind, Memory, Polynomial, Side, Unresolved};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::number::rounded::Rounded;
use crate::system::error::Cause;
use crate::system::state::State;
pub(super) use values::Parts;
pub(super) use values::{PLACES, is_clear};
use values::{Seen, Values};
use watch::Watch;

/// The most halvings of a step before its guards are given up.
const HALVINGS: i32 = 24;

/// The rounding errors below which a kink counts as zero where another one is crossed: those of both and of
/// the time at which they are.
const AT_ZERO: f64 = 4.0;

/// A guard by its kind and index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Guard {
    Row(usize),
    Kink(usize),
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
    /// Where the step starts.
    pub(super) start: &'a State<S::Scalar, N>,
    watch: Watch<S::Scalar, C, W>,
}

impl<'a, S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'a, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The guards of a step that starts at a state. If it is no polynomial (`is_along`), all are sampled.
    pub(super) fn new(
        system: &'a S,
        in_regime: &'a S::InRegime,
        regime: &'a Regime<S::Scalar, C, W>,
        inputs: &'a [S::Scalar; K],
        start: &'a State<S::Scalar, N>,
        is_along: bool,
    ) -> Self {
        let zero: S::Scalar = num_traits::Zero::zero();
        let slips = |row: usize| regime.slip[row] != zero;
        let mut watch = Watch::new(!is_along);
        let mut turns = false;
        for (row, kind) in S::ROWS.iter().enumerate() {
            watch.rows[row] = match kind {
                // Friction that slips has the sign of the reaction that drives it in its equations. Beyond
                // the zero of a load its series has the other sign.
                Row::Bilateral | Row::Load => S::ROWS.iter().enumerate().any(|(other, kind)| {
                    matches!(kind, Row::Friction { normal: Some(normal), .. } if *normal == row)
                        && slips(other)
                }),
                Row::Unilateral => true,
                Row::Friction { pair, .. } => {
                    let is_first = pair.is_none_or(|other| row < other);
                    turns = turns || pair.is_some() && slips(row);
                    regime.active[row] && is_first || slips(row)
                }
            };
        }
        if turns {
            watch.directions = laws_on(system, start, inputs, &regime.kinks).rows.rates;
        }
        Self { system, in_regime, regime, inputs, start, watch }
    }

    /// Whether no guard is watched.
    pub(super) fn is_empty(&self) -> bool {
        W == 0 && !self.watch.rows.contains(&true)
    }

    /// Whether any guard is made of reactions.
    pub(super) fn has_reactions(&self) -> bool {
        (0..C).any(|row| self.watch.rows[row] && self.is_reaction(row))
    }

    /// Whether a guard is made of reactions.
    pub(super) fn is_of_reactions(&self, guard: Guard) -> bool {
        matches!(guard, Guard::Row(row) if self.is_reaction(row))
    }

    /// Whether the guard of a row is made of reactions.
    pub(super) fn is_reaction(&self, row: usize) -> bool {
        // Not by index: the compiler for small processors does not rule out its panic here.
        matches!(S::ROWS.get(row), Some(Row::Bilateral | Row::Load))
            || self.regime.active.get(row) == Some(&true)
    }

    /// All guards, watched or not.
    pub(super) fn every() -> impl Iterator<Item = Guard> {
        // One range, since the code that follows would be compiled for each part of a chain.
        (0..C + W).map(|place| if place < C { Guard::Row(place) } else { Guard::Kink(place - C) })
    }

    /// All guards that are watched.
    pub(super) fn all(&self) -> impl Iterator<Item = Guard> + '_ {
        Self::every().filter(|&guard| self.watch.has(guard))
    }

    /// The guards that are watched by samples.
    fn sampled(&self) -> impl Iterator<Item = Guard> + '_ {
        self.all().filter(|&guard| self.watch.is_sampled(guard))
    }

    /// The functions of a regime in the guards that are watched.
    pub(super) fn parts<T: Real>(
        &self,
        number: impl Fn(S::Scalar) -> T + Copy,
        t: T,
        [q, v]: [&[T; N]; 2],
    ) -> Parts<T, C, W> {
        let u = self.inputs.each(number);
        let functions = S::functions_in(self.in_regime, number, t, q, v, &u, &self.wanted());
        let backward = S::backward_in(self.in_regime, number, t, q, v, &u).unwrap_or(functions.fixed);
        Parts { functions, backward }
    }

    /// The guards that functions of a regime and reactions make, at the indices of their rows and kinks.
    pub(super) fn made<T: Real>(
        &self,
        number: impl Fn(S::Scalar) -> T + Copy,
        Parts { mut functions, backward }: Parts<T, C, W>,
        reactions: &[T; C],
    ) -> Functions<T, C, W> {
        let Functions { rows, fixed, kinks } = &mut functions;
        let turn = |sign: S::Scalar, value: &mut T| {
            if (-sign).is_positive() {
                *value = -*value;
            }
        };
        for (kink, &side) in kinks.iter_mut().zip(&self.regime.kinks) {
            turn(side, kink);
        }
        for row in (0..C).filter(|&row| self.watch.rows[row]) {
            match S::ROWS[row] {
                Row::Bilateral | Row::Load => {
                    rows[row] = reactions[row];
                    turn(self.regime.side[row], &mut rows[row]);
                }
                Row::Unilateral if self.regime.active[row] => rows[row] = reactions[row],
                Row::Unilateral => {}
                Row::Friction { normal, pair } if self.regime.active[row] => {
                    let limit = |coefficient: T| match normal {
                        Some(normal) => {
                            let mut load = entry(reactions, normal);
                            turn(entry(&self.regime.side, normal), &mut load);
                            coefficient * load
                        }
                        None => coefficient,
                    };
                    let force = reactions[row];
                    rows[row] = match pair {
                        Some(other) => {
                            let (limit, other) = (limit(fixed[row]), entry(reactions, other));
                            limit * limit - (force * force + other * other)
                        }
                        None => {
                            let (forward, back) = (limit(fixed[row]) + force, limit(backward[row]) - force);
                            if (forward - back).is_positive() { back } else { forward }
                        }
                    };
                }
                Row::Friction { pair: None, .. } => turn(self.regime.slip[row], &mut rows[row]),
                // This is zero where the slip has turned by a right angle, or has come to rest. The other of
                // a pair has no guard of its own.
                Row::Friction { pair: Some(other), .. } => {
                    let along = |row: usize| number(self.watch.directions[row]) * rows[row];
                    rows[row] = along(row) + along(other);
                }
            }
        }
        functions
    }

    /// The guards at a state whose numbers are within these errors, with reactions that are known.
    pub(super) fn rounded(
        &self,
        state: &State<S::Scalar, N>,
        errors: &State<S::Scalar, N>,
        reactions: &[Rounded<S::Scalar>; C],
    ) -> Functions<Rounded<S::Scalar>, C, W> {
        let rounded = |numbers: &[S::Scalar; N], errors: &[S::Scalar; N]| {
            array(|i| Rounded { value: numbers[i], error: errors[i] })
        };
        let (q, v) = (rounded(&state.q, &errors.q), rounded(&state.v, &errors.v));
        let t = Rounded { value: state.t, error: errors.t };
        self.made(Rounded::exact, self.parts(Rounded::exact, t, [&q, &v]), reactions)
    }

    /// The guards at a state whose numbers are sums of summands of these sizes.
    pub(super) fn guards_at(
        &self,
        state: &State<S::Scalar, N>,
        sizes: &State<S::Scalar, N>,
    ) -> Functions<Rounded<S::Scalar>, C, W> {
        let ulps = |sizes: &[S::Scalar; N]| sizes.each(|size| S::Scalar::epsilon() * size.abs());
        let t = S::Scalar::epsilon() * sizes.t.abs();
        let errors = State { t, q: ulps(&sizes.q), v: ulps(&sizes.v) };
        let mut reactions = [Rounded::exact(num_traits::Zero::zero()); C];
        if self.has_reactions() {
            let [multipliers, sizes] = self.multipliers(state);
            reactions =
                array(|row| Rounded { value: multipliers[row], error: S::Scalar::epsilon() * sizes[row] });
        }
        self.rounded(state, &errors, &reactions)
    }

    /// One of the guards at a state with its derivatives.
    pub(super) fn varying(&self, guard: Guard, state: &State<S::Scalar, N>) -> S::Scalar {
        let State { t, q, v } = state;
        let own = self.only(guard);
        let reactions =
            if own.has_reactions() { self.multipliers(state)[0] } else { [num_traits::Zero::zero(); C] };
        *own.made(|x| x, own.parts(|x| x, *t, [q, v]), &reactions).get(guard)
    }

    /// One of the guards at a state whose numbers are sums of summands of these sizes, without derivatives.
    pub(super) fn value(
        &self,
        guard: Guard,
        state: &State<S::Scalar, N>,
        sizes: &State<S::Scalar, N>,
    ) -> Rounded<S::Scalar> {
        let Rounded { value, error } = *self.only(guard).guards_at(state, sizes).get(guard);
        Rounded { value: value.part(0), error: error.part(0) }
    }

    /// All guards that are watched by samples, at a state.
    fn values(&self, state: &State<S::Scalar, N>) -> Values<S::Scalar, C, W> {
        let mut values = Values::of(num_traits::Zero::zero());
        let guarded = self.guards_at(state, state);
        for guard in self.sampled() {
            let &Rounded { value, error } = guarded.get(guard);
            let known = (value.part(0), error.part(0) / S::Scalar::epsilon());
            match guard {
                Guard::Row(row) => values.set_row(row, known),
                Guard::Kink(kink) => values.set_kink(kink, known),
            }
        }
        values
    }

    /// The first guard watched by samples that falls through zero on a step between two times, and the part
    /// of the step that has passed then; `None` if none falls within the part `until`. `at` gives the state
    /// after a part. Each part that is examined after the first is one of the `attempts`.
    pub(super) fn first(
        &self,
        scales: &Scales<S::Scalar, C>,
        [start, end]: [S::Scalar; 2],
        until: S::Scalar,
        attempts: &mut u64,
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
        // Time is rounded, so a guard is uncertain by its change in an ulp of time. That is ε · `late` of the
        // step.
        let late = most(start.abs(), end.abs()) / (end - start).abs();
        loop {
            let width = to - from;
            let mut seen = Seen::new();
            let mut look = |place: S::Scalar| {
                let part = if place == one { to } else { from + place * width };
                at(part).map_or(nan, |state| self.values(&state))
            };
            let mut values = |place: S::Scalar| seen.at(place, &mut look);
            let mut earliest: Option<(S::Scalar, Guard)> = None;
            let mut unresolved = None;
            for guard in self.sampled() {
                let late = late / (S::Scalar::from_f64(4.0) * width);
                match self.falls(guard, scales, late, &mut |place| values(place).get(guard)) {
                    Ok(Some(place)) if earliest.is_none_or(|(other, _)| place < other) => {
                        earliest = Some((place, guard));
                    }
                    Ok(_) => {}
                    // No polynomial knows the distance from a centre at the centre, or follows the errors
                    // of a reaction that drives a slow slip.
                    Err(_) if is_clear(|place| values(place).get(guard).0) => {}
                    Err(why) => unresolved = Some(why),
                }
            }
            match (unresolved, earliest) {
                // What no polynomial knows on so short a part cannot be followed at all.
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
            *attempts = attempts.checked_sub(1).ok_or(Cause::TooManySteps)?;
        }
    }

    /// The delay of a time after the zero of a guard that the rounding of time has made, from values of the
    /// guard there and a little earlier; zero if it is more than rounding can make.
    pub(super) fn late(&self, guard: Guard, [earlier, there]: [&State<S::Scalar, N>; 2]) -> S::Scalar {
        let [before, value] = [earlier, there].each(|state| self.value(guard, state, state).value);
        let late = value / (value - before) * (there.t - earlier.t);
        let ulps = S::Scalar::from_f64(4.0) * S::Scalar::epsilon() * there.t.abs();
        if late.abs() <= ulps { late } else { num_traits::Zero::zero() }
    }

    /// Whether a kink that was on its side earlier is at zero, within rounding, at a later state.
    pub(super) fn has_fallen(&self, kink: usize, states: [&State<S::Scalar, N>; 2]) -> bool {
        let [earlier, there] = states.each(|state| self.value(Guard::Kink(kink), state, state));
        let errors = S::Scalar::from_f64(AT_ZERO);
        earlier.value > errors * earlier.error && there.value <= errors * there.error
    }

    /// The size of the guard of a row in the course of the motion.
    pub(super) fn scale(&self, row: usize, scales: &Scales<S::Scalar, C>) -> S::Scalar {
        let Some(&kind) = S::ROWS.get(row) else { return num_traits::Zero::zero() };
        let is_active = self.regime.active[row];
        match kind {
            Row::Unilateral if !is_active => scales.gaps[row],
            Row::Bilateral | Row::Unilateral | Row::Load => scales.reactions[row],
            Row::Friction { pair: None, .. } if is_active => scales.reactions[row],
            Row::Friction { .. } if is_active => scales.reactions[row] * scales.reactions[row],
            Row::Friction { pair: None, .. } => scales.speeds[row],
            Row::Friction { pair: Some(other), .. } => {
                let direction = self.watch.directions[row].hypot(entry(&self.watch.directions, other));
                direction * most(scales.speeds[row], entry(&scales.speeds, other))
            }
        }
    }

    /// The place where a guard falls through zero on a part of the step, if it does. A function of its own:
    /// its code would stand in each of many places.
    #[inline(never)]
    fn falls(
        &self,
        guard: Guard,
        scales: &Scales<S::Scalar, C>,
        late: S::Scalar,
        value: &mut dyn FnMut(S::Scalar) -> (S::Scalar, S::Scalar),
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
        let memory = if start.0 > noise {
            Memory::Side(Side::Above)
        } else if start.0 >= -noise || self.is_gap(guard) || self.has_crossed(guard) {
            // A regime that has just begun begins at zero.
            Memory::Zero(Some(Side::Above))
        } else {
            return Ok(Some(zero));
        };
        let zero = polynomial.first(Kind::Falling, memory);
        Ok(zero.map(|zero| zero.polish(|place| value(place).0)))
    }
}
