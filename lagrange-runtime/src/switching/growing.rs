//! Slips in two directions that a growing load begins.
//!
//! Where a load has grown to what friction can hold, the slip begins without an acceleration: its speed
//! grows like t², along the load, and friction turns to the load within m|v|/F, a time that begins at zero.
//! A series there has the radius of convergence of that time, so no series can begin. This is what can:
//! friction that turns so fast is against the load itself. So the motion is taken on by a short time τ in
//! one piece, with accelerations under friction against the load at its end, which grow linearly from those
//! at its start.
//!
//! If T is the time in which the load grows by its own size, the relative error of this is about (τ/T)³. The
//! motion from there until T takes a few times T/τ steps.

use super::choice::Choice;
use super::scene::{Known, Scales, Scene, Status, above, entry, most, put, rounding};
use super::sided::laws_on;
use super::turning::has_pairs;
use super::way::{Way, shift};
use super::{Regime, Switching};
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::state::State;

/// The most times that a time is lengthened or shortened.
const TRIES: usize = 128;

/// The factor by which it is lengthened while the load has hardly grown. The first one is so many ulps of the
/// time of the state.
const FACTOR: f64 = 16.0;

/// Rounds that find the time at which slips begin. Each leaves the square of the span of the one before.
const SECANTS: usize = 4;

/// The largest of some accelerations, at least zero.
fn most_of<R: Real, const C: usize>(parts: &[R; C]) -> R {
    parts.iter().fold(R::zero(), |a, &b| most(a, b))
}

/// A motion with slips that a growing load has begun, a short time later.
pub(super) struct Grown<R, const N: usize, const C: usize, const W: usize> {
    pub(super) regime: Regime<R, C, W>,
    /// The time that has passed \[s].
    later: R,
    /// The changes of coordinates and velocities until then.
    gain: [[R; N]; 2],
    pub(super) way: Way<R, N>,
}

impl<R: Real, const N: usize, const C: usize, const W: usize> Grown<R, N, C, W> {
    /// The motion with these changes after a time in which accelerations grow linearly.
    fn of(regime: Regime<R, C, W>, later: R, gain: [[R; N]; 2], [a, b]: [&[R; N]; 2]) -> Self {
        Self { regime, later, gain, way: Way::growing(*b, array(|i| (b[i] - a[i]) / later)) }
    }

    /// Takes a state on from the start of the motion to its end, which is this much later where the time of
    /// the event varies.
    pub(super) fn take_on(&self, state: &mut State<R, N>, late: R) {
        let [gain_q, gain_v] = self.gain;
        state.t += self.later;
        state.q = array(|i| state.q[i] + gain_q[i]);
        state.v = array(|i| state.v[i] + gain_v[i]);
        shift(state, &self.way.accelerations, late);
    }
}

/// The same for one time, with the acceleration of each slip as a part of what the forces could give it.
type Ahead<R, const N: usize, const C: usize, const W: usize> = (Grown<R, N, C, W>, [R; C]);

/// The same, and the time at which slips begin \[s].
type Soon<R, const N: usize, const C: usize, const W: usize> = (Grown<R, N, C, W>, R);

/// The reason why there is no such motion for a time.
enum Not<R, const C: usize, const W: usize> {
    /// The load has not grown beyond what friction holds, or not evenly, or no motion is found.
    Grown,
    /// Another regime has begun meanwhile.
    Alone(Regime<R, C, W>),
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The motion after a choice by which slips begin without an acceleration, when the load has grown enough
    /// for a series to begin; `None` where all slips that begin are accelerated, or the load does not grow.
    #[cold]
    pub(super) fn grown(
        &self,
        choice: &Choice<S::Scalar, N, C, W>,
        scales: &Scales<S::Scalar, C>,
    ) -> Option<Grown<S::Scalar, N, C, W>> {
        if const { !has_pairs(&S::ROWS) } {
            return None;
        }
        let begins = self.beginning(&choice.regime);
        // The time of a switch has errors, as velocities have. Whether a slip is driven that is hardly driven
        // here shows by how it grows.
        let changed = self.lost.part(0).sqrt();
        let is_driven = |rows: [usize; 2]| above(self.driven_part(rows, choice), changed);
        if begins.slips(&S::ROWS).all(is_driven) {
            return None;
        }
        match self.soon(choice, scales, false) {
            Ok((grown, _)) => Some(grown),
            Err(regime) if regime == choice.regime => None,
            // Only the slips of the choice begin here. The motion meets those that begin later.
            Err(_) => self.until(choice.regime, &choice.accelerations, scales),
        }
    }

    /// The same where feet have stuck that shared a load. Where the last possible shares are hard to find,
    /// slips begin a little later: then the motion goes on until that time as it is.
    #[cold]
    pub(super) fn loosened(
        &self,
        stuck: &Choice<S::Scalar, N, C, W>,
        scales: &Scales<S::Scalar, C>,
    ) -> Option<Grown<S::Scalar, N, C, W>> {
        if const { !has_pairs(&S::ROWS) } {
            return None;
        }
        let (grown, onset) = self.soon(stuck, scales, true).ok()?;
        // Accelerations have rounding errors, and with them the time at which they grow from zero.
        let least =
            S::Scalar::from_f64(FACTOR) * rounding::<S::Scalar>() * (self.state.t.abs() + grown.later);
        if above(onset, least) { self.until_onset(stuck, onset) } else { Some(grown) }
    }

    /// The motion after a choice that nothing accelerates, when the load has grown enough for a series to
    /// begin, and the time at which slips begin: in the regime of the choice, or in one to which the same
    /// load soon leads. Fails with the last regime in which slips do not grow evenly.
    fn soon(
        &self,
        choice: &Choice<S::Scalar, N, C, W>,
        scales: &Scales<S::Scalar, C>,
        is_shared: bool,
    ) -> Result<Soon<S::Scalar, N, C, W>, Regime<S::Scalar, C, W>> {
        let mut regime = choice.regime;
        for _ in 0..=C {
            match self.grown_in(regime, &choice.accelerations, scales, is_shared) {
                Ok(found) => return Ok(found),
                Err(Not::Grown) => break,
                // The same load soon drives others, too.
                Err(Not::Alone(other)) => regime = other,
            }
        }
        Err(regime)
    }

    /// The acceleration that is grown to, as a part of what the forces could give: the cube root of what
    /// velocities lose anyway.
    fn growth(&self) -> S::Scalar {
        (self.lost.part(0).ln() / S::Scalar::from_f64(3.0)).exp()
    }

    /// The same in a regime, if all its slips that begin grow evenly from now on, or from a later time where
    /// a load is shared.
    fn grown_in(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        is_shared: bool,
    ) -> Result<Soon<S::Scalar, N, C, W>, Not<S::Scalar, C, W>> {
        let number = S::Scalar::from_f64;
        let wanted = self.growth();
        let mut later = self.instant();
        for _ in 0..TRIES {
            let part = match self.ahead(regime, a, scales, later) {
                Ok((_, parts)) => most_of(&parts),
                Err(Not::Grown) => num_traits::Zero::zero(),
                Err(other) => return Err(other),
            };
            if above(part, wanted) {
                later *= wanted / part;
                let (grown, parts) = self.ahead(regime, a, scales, later)?;
                // A load that has not grown evenly is another one, met later.
                let (_, mut halves) = self.ahead(regime, a, scales, later * number(0.5))?;
                let mut onset = num_traits::Zero::zero();
                if is_shared {
                    onset = self.onset(regime, a, scales, later, [most_of(&parts), most_of(&halves)]);
                    (_, halves) = self.ahead(regime, a, scales, number(0.5) * (onset + later))?;
                }
                let is_even = |(&whole, &half): (&S::Scalar, &S::Scalar)| {
                    !above(number(0.4) * whole, half) && !above(half, number(0.6) * whole)
                };
                let are_even = parts.iter().zip(&halves).all(is_even);
                return if are_even { Ok((grown, onset)) } else { Err(Not::Grown) };
            }
            let is_near = above(part, rounding::<S::Scalar>() + wanted / number(FACTOR));
            later *= if is_near { number(1.0 + 1.0 / FACTOR) * wanted / part } else { number(FACTOR) };
        }
        Err(Not::Grown)
    }

    /// The time at which slips begin that have these accelerations at a later time and at half of it: the
    /// zero of their secant, nearer and nearer to that time. Zero if it is past.
    fn onset(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        later: S::Scalar,
        [mut whole, mut half]: [S::Scalar; 2],
    ) -> S::Scalar {
        let number = S::Scalar::from_f64;
        let zero: S::Scalar = num_traits::Zero::zero();
        let (mut onset, mut span) = (zero, later);
        for _ in 0..SECANTS {
            let passed = span * (half + half - whole) / (number(-2.0) * (whole - half));
            if !above(whole, half) || !above(span, passed) {
                break;
            }
            onset = most(onset + passed, zero);
            span = (span - passed) / number(FACTOR);
            let at = |place| self.ahead(regime, a, scales, onset + place).map(|(_, parts)| most_of(&parts));
            (whole, half) = match (at(span), at(number(0.5) * span)) {
                (Ok(whole), Ok(half)) => (whole, half),
                _ => break,
            };
        }
        onset
    }

    /// The motion of a choice until slips begin.
    fn until_onset(
        &self,
        stuck: &Choice<S::Scalar, N, C, W>,
        later: S::Scalar,
    ) -> Option<Grown<S::Scalar, N, C, W>> {
        let a = &stuck.accelerations;
        let in_regime = self.system.in_regime(&stuck.regime);
        let State { t, q, v } = self.moved(&in_regime, a, later)?;
        let b = S::equations_in(&in_regime, t, &q, &v, self.inputs)?.balance().accelerations;
        Some(Grown::of(stuck.regime, later, self.gain(a, &b, later), [a, &b]))
    }

    /// The state after a time with constant accelerations, on the constraints of a regime.
    fn moved(
        &self,
        in_regime: &S::InRegime,
        a: &[S::Scalar; N],
        later: S::Scalar,
    ) -> Option<State<S::Scalar, N>> {
        let mut state = self.state;
        shift(&mut state, a, later);
        state.t += later;
        in_regime.project_at(&in_regime.constants(), &mut state, None).ok()?;
        Some(state)
    }

    /// The changes of coordinates and velocities in a time in which accelerations grow linearly from `a` to
    /// `b`.
    fn gain(&self, a: &[S::Scalar; N], b: &[S::Scalar; N], later: S::Scalar) -> [[S::Scalar; N]; 2] {
        let number = S::Scalar::from_f64;
        let v = &self.state.v;
        [
            array(|i| later * (v[i] + later * (a[i] + a[i] + b[i]) / number(6.0))),
            array(|i| later * (a[i] + b[i]) / number(2.0)),
        ]
    }

    /// The same as far as the regime lasts.
    fn until(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
    ) -> Option<Grown<S::Scalar, N, C, W>> {
        let (mut later, mut last) = (self.instant(), None);
        for _ in 0..TRIES {
            match self.ahead(regime, a, scales, later) {
                Ok((grown, _)) => last = Some(grown),
                Err(Not::Grown) => {}
                Err(Not::Alone(_)) => break,
            }
            later *= S::Scalar::from_f64(2.0);
        }
        last
    }

    /// A time that rounding hardly resolves \[s].
    fn instant(&self) -> S::Scalar {
        let ulp = S::Scalar::epsilon();
        S::Scalar::from_f64(FACTOR) * ulp * self.state.t.part(0).abs() + ulp.powi(4)
    }

    /// The acceleration of a slip, as a part of what the forces could give it.
    fn driven_part(&self, rows: [usize; 2], choice: &Choice<S::Scalar, N, C, W>) -> S::Scalar {
        let [x, y] = rows.each(|row| self.rate(row, &choice.accelerations));
        let [a, b] = rows.each(|row| self.extent_of(row, &choice.sizes.accelerations));
        let size = most(a, b);
        // A number alone: the time that follows from it has no variation.
        if size.is_positive() { (x.hypot(y) / size).part(0) } else { num_traits::Zero::zero() }
    }

    /// The motion after a time \[s], with the accelerations `a` now.
    fn ahead(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        later: S::Scalar,
    ) -> Result<Ahead<S::Scalar, N, C, W>, Not<S::Scalar, C, W>> {
        let number = S::Scalar::from_f64;
        let zero: S::Scalar = num_traits::Zero::zero();
        let begins = self.beginning(&regime);
        let in_regime = self.system.in_regime(&begins.held(&regime));
        let state = self.moved(&in_regime, a, later).ok_or(Not::Grown)?;
        // Contacts that bear and friction at rest: the state has been projected onto them, so that what is
        // left of their rates is rounding errors.
        let rested = array(|row| match self.status.get(row) {
            Some(Status::Touches) => regime.active.get(row) == Some(&true),
            status => status == Some(&Status::Rests),
        });
        let known = Known { closed: self.is_closed, fired: None, settled: true, rested };
        let scene = Scene::new(self.system, &state, self.inputs, self.kinks, scales, &known);
        let there = scene.choose(&regime, None).map_err(|_| Not::Grown)?;
        let slips = |row: usize| entry(&there.regime.slip, row) != zero;
        if !begins
            .slips(&S::ROWS)
            .all(|rows| scene.status.get(rows[0]) == Some(&Status::Rests) && slips(rows[0]))
        {
            return Err(Not::Grown);
        }
        if there.regime != regime {
            return Err(Not::Alone(there.regime));
        }
        let (mut parts, mut slips) = ([zero; C], [zero; C]);
        for rows in begins.slips(&S::ROWS) {
            put(&mut parts, rows[0], scene.driven_part(rows, &there));
            for row in rows {
                put(&mut slips, row, number(0.5) * later * scene.rate(row, &there.accelerations));
            }
        }
        let State { t, q, v } = self.state;
        let b = &there.accelerations;
        let [gain_q, gain_v] = self.gain(a, b, later);
        let (t, q, v) = (t + later, array(|i| q[i] + gain_q[i]), array(|i| v[i] + gain_v[i]));
        // The slip is that of its own accelerations: in the direction of the load, as it is there.
        let rates = laws_on(self.system, &State { t, q, v }, self.inputs, &self.kinks).rows.rates;
        let lack = array(|row| if begins.has(row) { slips[row] - rates[row] } else { zero });
        let equations = S::equations_in(&in_regime, t, &q, &v, self.inputs).ok_or(Not::Grown)?;
        let (change, _) = equations.saddle.solve(&[zero; N], &lack);
        let gain = [gain_q, array(|i| gain_v[i] + change[i])];
        Ok((Grown::of(regime, later, gain, [a, b]), parts))
    }
}
