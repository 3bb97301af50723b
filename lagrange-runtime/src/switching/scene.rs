//! Rows of a system that stand still and rows that move, at one state.

use num_traits::Zero;

use super::ended::Ended;
use super::known::Known;
use super::scales::Scales;
pub(super) use super::scales::{above, most, rounding};
use super::sided::laws_on;
use super::{Coefficients, Laws, Regime, Row, Switching};
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::System;
use crate::system::error::Cause;
use crate::system::state::State;

/// The number of a row; zero if there is no such row.
pub(super) fn entry<R: Real, const C: usize>(numbers: &[R; C], row: usize) -> R {
    numbers.get(row).copied().unwrap_or(R::zero())
}

/// Sets the number of a row, if there is such a row.
pub(super) fn put<T, const C: usize>(numbers: &mut [T; C], row: usize, number: T) {
    if let Some(own) = numbers.get_mut(row) {
        *own = number;
    }
}

/// Σ aᵢ xᵢ.
pub(super) fn product<R: Real, const N: usize>(a: &[R; N], x: &[R; N]) -> R {
    a.iter().zip(x).fold(R::zero(), |sum, (&a, &x)| a.mul_add(x, sum))
}

/// Σ |aᵢ xᵢ|.
pub(super) fn extent<R: Real, const N: usize>(a: &[R; N], x: &[R; N]) -> R {
    a.iter().zip(x).fold(R::zero(), |sum, (&a, &x)| sum + (a * x).abs())
}

/// The coefficients, of those forward and backward, that act against a slip in the direction of this sign.
pub(super) fn against<R: Real, const C: usize>(
    [forward, backward]: &[Coefficients<R, C>; 2],
    slip: R,
) -> &Coefficients<R, C> {
    if (-slip).is_positive() { backward } else { forward }
}

/// The state of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Status {
    /// A constraint that always holds.
    Holds,
    /// A gap that is open or opens; friction of such a contact, or friction that can hold nothing.
    Apart,
    /// A gap that is zero and closes: an impact.
    Meets,
    /// A gap that is zero and stays so for the moment.
    Touches,
    /// A slip velocity that is zero.
    Rests,
    /// A slip velocity that is not.
    Slips,
}

/// The limit of a friction that sticks.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sticking {
    /// By the coefficient at rest.
    ByForces,
    /// By that of a slip: in an impact there is no rest before it.
    ByImpulses,
}

/// A state with all numbers that decide about its regime.
pub(super) struct Scene<'a, S, const N: usize, const K: usize, const C: usize, const W: usize>
where
    S: Switching<N, K, C, W>,
{
    pub(super) system: &'a S,
    pub(super) state: State<S::Scalar, N>,
    pub(super) inputs: &'a [S::Scalar; K],
    pub(super) kinks: [S::Scalar; W],
    pub(super) laws: Laws<S::Scalar, C, W>,
    /// Coefficients of friction forward and backward.
    pub(super) coefficients: [Coefficients<S::Scalar, C>; 2],
    pub(super) status: [Status; C],
    /// Gaps that are zero.
    pub(super) is_closed: [bool; C],
    /// Contacts that have opened at this time, and frictions that have let go.
    pub(super) opened: [bool; C],
    /// Regimes that have ended at this time.
    pub(super) ended: Ended<C>,
    /// Sizes of rates and slip velocities.
    pub(super) speeds: [S::Scalar; C],
    /// The part of them that a slip in two directions has to exceed for its direction to be known.
    pub(super) lost: S::Scalar,
    /// The gradients of all rows, active or not.
    pub(super) gradients: [[S::Scalar; N]; C],
    /// γ of all rows.
    pub(super) gamma: [S::Scalar; C],
    /// Units in which no coordinate is larger than another.
    pub(super) units: [S::Scalar; N],
}

impl<'a, S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'a, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    pub(super) fn new(
        system: &'a S,
        state: &State<S::Scalar, N>,
        inputs: &'a [S::Scalar; K],
        kinks: [S::Scalar; W],
        scales: &Scales<S::Scalar, C>,
        known: &Known<C>,
    ) -> Self {
        let State { t, q, v } = *state;
        let laws = laws_on(system, state, inputs, &kinks);
        let (mut gradients, mut gamma) = ([[num_traits::Zero::zero(); N]; C], [num_traits::Zero::zero(); C]);
        let [mut units, mut forces] = [[num_traits::Zero::zero(); N]; 2];
        let all = Regime { active: [true; C], kinks, ..Regime::open(&S::ROWS) };
        let in_regime = system.in_regime(&all);
        if let Some(rows) = S::rows_in(&in_regime, t, &q, &v, inputs) {
            (gradients, gamma, units, forces) = (rows.gradients, rows.gamma, rows.units, rows.forces);
        }
        let speeds = array(|row| most(scales.speeds[row], laws.rows.rate_sizes[row]));
        let mut scene = Self {
            system,
            state: *state,
            inputs,
            kinks,
            coefficients: S::coefficients_in(&in_regime, t, &q, &v, inputs, &laws),
            laws,
            status: [Status::Apart; C],
            is_closed: [false; C],
            opened: known.opened,
            ended: known.ended,
            speeds,
            lost: scales.lost(),
            gradients,
            gamma,
            units,
        };
        for row in 0..C {
            let play = if known.alone { scene.play(row, &forces) } else { num_traits::Zero::zero() };
            scene.is_closed[row] = scene.closes(row, scales, known, play);
            scene.status[row] = scene.status_of(row, known);
        }
        // Friction acts only in a contact that touches, and only if its limit is not zero in all of the
        // regime.
        let contacts = scene.status;
        let is_none: [bool; C] = array(|row| scene.is_frictionless(row));
        for ((status, row), is_none) in scene.status.iter_mut().zip(S::ROWS).zip(is_none) {
            if let Row::Friction { normal, .. } = row
                && (is_none || normal.is_some_and(|normal| contacts.get(normal) == Some(&Status::Apart)))
            {
                *status = Status::Apart;
            }
        }
        scene
    }

    /// Whether a row is a gap of zero, up to its own rounding errors, the effect of those of time and some
    /// `play`.
    fn closes(&self, row: usize, scales: &Scales<S::Scalar, C>, known: &Known<C>, play: S::Scalar) -> bool {
        let rows = &self.laws.rows;
        let gap = most(scales.gaps[row], rows.position_sizes[row]);
        let is_zero = !above(rows.positions[row], rounding::<S::Scalar>() * gap + self.by_time(row) + play);
        S::ROWS[row] == Row::Unilateral
            && (known.fired == Some(row) || known.closed[row] || is_zero && !known.only)
    }

    /// The gap that counts as zero at a state alone, where no motion has shown how large gaps are: the effect
    /// of a rounding error of the largest coordinate, and the way that forces close within a time that
    /// rounding hides.
    fn play(&self, row: usize, forces: &[S::Scalar; N]) -> S::Scalar {
        let largest =
            self.state.q.iter().fold(num_traits::Zero::zero(), |largest, &q| most(largest, q.abs()));
        let (hidden, half) = (self.hidden(), S::Scalar::from_f64(0.5));
        let fall = half * hidden * hidden * self.effect(row, &array(|i| forces[i].abs()));
        S::Scalar::epsilon() * self.extent_of(row, &[largest; N]) + fall
    }

    /// The change of a gap by the rounding errors of time.
    pub(super) fn by_time(&self, row: usize) -> S::Scalar {
        self.hidden() * self.laws.rows.rates[row].abs()
    }

    /// The time that rounding hides \[s].
    fn hidden(&self) -> S::Scalar {
        S::Scalar::from_f64(8.0) * S::Scalar::epsilon() * self.state.t.abs()
    }

    /// The rate up to which a row of this speed counts as at rest: the rounding errors of the rate, and what
    /// those of time change.
    fn least_rate(&self, row: usize, speed: S::Scalar) -> S::Scalar {
        rounding::<S::Scalar>() * speed + self.hidden() * self.gamma[row].abs()
    }

    fn status_of(&self, row: usize, known: &Known<C>) -> Status {
        let rows = &self.laws.rows;
        let fired = known.fired == Some(row);
        match S::ROWS[row] {
            Row::Bilateral | Row::Load => Status::Holds,
            Row::Unilateral => {
                let rate = rows.rates[row];
                if !self.is_closed[row] {
                    Status::Apart
                } else if known.rested[row]
                    || !above(rate.abs(), self.least_rate(row, self.speeds[row]))
                    || known.settled && !rate.is_positive()
                {
                    Status::Touches
                } else if rate.is_positive() {
                    Status::Apart
                } else {
                    Status::Meets
                }
            }
            Row::Friction { pair, .. } => {
                let (own, speed) = (self.least_rate(row, self.speeds[row]), rows.rates[row]);
                let (least, slip) = pair.map_or((own, speed.abs()), |other| {
                    let least = self.least_rate(other, self.speeds[other]);
                    (most(own, least), speed.hypot(rows.rates[other]))
                });
                let is_other = pair.is_some_and(|other| known.fired == Some(other));
                if fired || is_other || known.rested[row] || !above(slip, least) {
                    Status::Rests
                } else {
                    Status::Slips
                }
            }
        }
    }

    /// Removes velocities that contacts and friction have stopped: those that are rounding errors of the
    /// fastest one of this scene, or of the speed that a row had which holds now. The remainder has no
    /// digits, and no series could find its scale.
    ///
    /// A row that holds goes on holding: it loses all velocities that it couples, or those alone that are
    /// rounding errors of the others.
    /// A slip in two directions keeps its velocities: it has a direction as long as they are not zero.
    pub(super) fn still(&self, v: &mut [S::Scalar; N], regime: &Regime<S::Scalar, C, W>) {
        let zero: S::Scalar = num_traits::Zero::zero();
        let slips: [bool; C] = array(|row| match S::ROWS[row] {
            Row::Friction { pair: Some(other), .. } => entry(&regime.slip, row.min(other)) != zero,
            _ => false,
        });
        let holds: [bool; C] = array(|row| regime.active[row] || slips[row]);
        let fastest = self.units.iter().zip(&self.state.v).fold(zero, |fastest, (&unit, &v)| {
            if unit.is_positive() { most(fastest, v.abs() / unit) } else { fastest }
        });
        let ulps = S::Scalar::from_f64(8.0) * S::Scalar::epsilon();
        let now = *v;
        let lever = |row: usize| self.extent_of(row, &self.units);
        // The gradient of a row that holds or slips, without entries that are rounding errors.
        let part = |row: usize, i: usize| match self.gradients.get(row) {
            Some(own) if holds.get(row) == Some(&true) => {
                let (own, unit) = (entry(own, i), entry(&self.units, i));
                if above(own.abs() * unit, ulps * lever(row)) { own } else { zero }
            }
            _ => zero,
        };
        // Whether a row would notice that it loses this velocity alone.
        let notices = |row: usize, i: usize| {
            above((part(row, i) * entry(&now, i)).abs(), S::Scalar::epsilon() * self.extent_of(row, &now))
        };
        let has_row = |stopped: &[bool; C], has_stopped: bool, is_one: &dyn Fn(usize) -> bool| {
            stopped.iter().enumerate().any(|(row, &own)| own == has_stopped && is_one(row))
        };
        let mut stopped: [bool; C] = array(|row| {
            let moving = entry(&self.laws.rows.rates, row) - self.along(row, &self.state.v);
            let size = most(entry(&self.speeds, row), fastest * lever(row));
            let is_slow = |i: usize| {
                let speed = entry(&now, i).abs() * lever(row);
                part(row, i) == zero || !above(speed, ulps * size * entry(&self.units, i))
            };
            !slips[row] && !above(moving.abs(), ulps * size) && (0..N).all(is_slow)
        });
        // A row that shares a velocity with one that moves has not stopped either.
        for _ in 0..C {
            let last = stopped;
            for (row, stopped) in stopped.iter_mut().enumerate() {
                let is_kept =
                    |i: usize| part(row, i) != zero && has_row(&last, false, &|row| notices(row, i));
                *stopped &= !(0..N).any(is_kept);
            }
            if stopped == last {
                break;
            }
        }
        for (i, (v, &unit)) in v.iter_mut().zip(&self.units).enumerate() {
            let is_slow = !above(v.abs(), ulps * fastest * unit);
            let has_stopped = || has_row(&stopped, true, &|row| part(row, i) != zero);
            if !has_row(&stopped, false, &|row| notices(row, i)) && (is_slow || has_stopped()) {
                *v -= v.part(0);
            }
        }
    }

    /// Brings a state onto the constraints of a regime. A friction at rest demands nothing of places, but
    /// corrections of places keep to it. Where it depends on the contacts, as a brake of the angle of a box
    /// on two feet does, a foot would stay beside the floor. So the contacts are closed without it.
    pub(super) fn bring_onto(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        state: &mut State<S::Scalar, N>,
    ) -> Result<(), Cause> {
        let bring = |regime: &Regime<S::Scalar, C, W>, state: &mut State<S::Scalar, N>| {
            let in_regime = self.system.in_regime(regime);
            in_regime.project_at(&in_regime.constants(), state, None)
        };
        bring(regime, state)?;
        let mut loose = *regime;
        for (is_active, _) in
            loose.active.iter_mut().zip(&S::ROWS).filter(|(_, row)| matches!(row, Row::Friction { .. }))
        {
            *is_active = false;
        }
        let is_contact = |row: &usize| S::ROWS[*row] == Row::Unilateral && regime.active[*row];
        if loose.active == regime.active || !(0..C).any(|row| is_contact(&row)) {
            return Ok(());
        }
        let rows = laws_on(self.system, state, self.inputs, &self.kinks).rows;
        let is_beside =
            |row: usize| above(rows.positions[row].abs(), rounding::<S::Scalar>() * rows.position_sizes[row]);
        if (0..C).filter(is_contact).any(is_beside) {
            bring(&loose, state)?;
            bring(regime, state)?;
        }
        Ok(())
    }

    /// Removes coordinates that have no digits, like a velocity that has been stopped: those of which a
    /// projection has made a half or more, and those of a contact that is closed, or rests, of whose gap
    /// nothing is left but roundings of what it was; where they are roundings of what the gap of each active
    /// row was.
    pub(super) fn place(
        &self,
        before: &[S::Scalar; N],
        State { q, v, .. }: &mut State<S::Scalar, N>,
        regime: &Regime<S::Scalar, C, W>,
        scales: &Scales<S::Scalar, C>,
    ) {
        let ulps = S::Scalar::from_f64(8.0) * S::Scalar::epsilon();
        let sizes = &self.laws.rows.position_sizes;
        let holds: [bool; C] = array(|row| {
            let rests = self.is_closed[row] && self.extent_of(row, v) == S::Scalar::zero();
            regime.active[row] || rests
        });
        for (i, (q, &before)) in q.iter_mut().zip(before).enumerate() {
            let slope = |row: usize| {
                let gradient = self.gradients.get(row).filter(|_| holds.get(row) == Some(&true));
                gradient.map_or(S::Scalar::zero(), |gradient| entry(gradient, i))
            };
            let couples = |row: &usize| slope(*row) != S::Scalar::zero();
            // By its own size, not by what the row would notice: a gap hardly depends on what lies along it.
            let is_seen = |row: usize| {
                let size = most(entry(&scales.gaps, row), entry(sizes, row));
                let all = q.abs() * self.extent_of(row, &self.units);
                couples(&row) && above(all, ulps * size * entry(&self.units, i))
            };
            let is_nothing = |row: usize| {
                S::ROWS.get(row) == Some(&Row::Unilateral)
                    && !above(entry(sizes, row), ulps * entry(&scales.gaps, row))
            };
            let made = *q - before;
            let is_made = !above(q.abs(), (made + made).abs());
            let mut rows = (0..C).filter(couples).peekable();
            let is_left = rows.peek().is_some() && rows.all(is_nothing);
            if (is_made || is_left) && !(0..C).any(is_seen) {
                *q -= q.part(0);
            }
        }
    }

    /// The coefficients against a slip in the direction of this sign.
    pub(super) fn against(&self, slip: S::Scalar) -> &Coefficients<S::Scalar, C> {
        against(&self.coefficients, slip)
    }

    /// Whether any contact closes.
    pub(super) fn has_impact(&self) -> bool {
        self.status.contains(&Status::Meets)
    }
}
