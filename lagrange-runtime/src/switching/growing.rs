//! Slips in two directions that a growing load begins.
//!
//! Where a load has grown to what friction can hold, the slip begins without an acceleration: its speed
//! grows like t², along the load, and friction turns to the load within m|v|/F, a time that begins at zero.
//! A series there has the radius of convergence of that time, so no series can begin. This is what can:
//! friction that turns so fast is against the load itself. So the motion is taken on by a short time τ in
//! one piece, with accelerations under friction against the load at its start, in its middle and at its end.
//! The end is compared with the equations. If it is beyond the tolerance, τ is shortened.
//!
//! If T is the time in which the load grows by its own size, the relative error of this is about (τ/T)³. The
//! motion from there until T takes a few times T/τ steps.

mod load;
mod strays;
mod taken;

use super::choice::Choice;
use super::launch::LAUNCHED;
use super::scales::Scales;
use super::scene::{Scene, above, most, rounding};
use super::turning::has_pairs;
use super::way::{Ramp, Way, shift};
use super::{Regime, Switching};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::system::state::State;
use load::Not;

/// The most times that a time is lengthened or shortened.
pub(super) const TRIES: usize = 128;

/// The factor by which it is lengthened while the load has hardly grown. The first one is so many ulps of the
/// time of the state.
const FACTOR: f64 = 16.0;

/// Rounds that find the time at which slips begin. Each leaves the square of the span of the one before.
const SECANTS: usize = 4;

/// A motion with slips that a growing load has begun, a short time later.
pub(super) struct Grown<R, const N: usize, const C: usize, const W: usize> {
    pub(super) regime: Regime<R, C, W>,
    /// The time that has passed \[s].
    later: R,
    /// The changes of coordinates and velocities until then.
    gain: [[R; N]; 2],
    ramp: Ramp<R, N>,
    pub(super) way: Way<R, N>,
}

impl<R: Real, const N: usize, const C: usize, const W: usize> Grown<R, N, C, W> {
    /// The motion in a regime from velocities `v`, with these accelerations.
    fn along(regime: Regime<R, C, W>, v: &[R; N], ramp: Ramp<R, N>) -> Self {
        Self { regime, later: ramp.lasts, gain: ramp.gain(v), way: Way::along(&ramp), ramp }
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

/// The same, and the time at which slips begin \[s].
type Soon<R, const N: usize, const C: usize, const W: usize> = (Grown<R, N, C, W>, R);

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The motion after a choice by which slips begin, when they are fast enough for a series to begin: with
    /// the accelerations of the choice, or where these are small, when the load has grown. `None` where none
    /// begin, or the load does not grow evenly.
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
        let strength = |rows: [usize; 2]| self.strength(rows, &choice.sizes.accelerations);
        let is_driven =
            |rows: [usize; 2]| above(self.driven_part(rows, &choice.accelerations, strength(rows)), changed);
        if begins.slips(&S::ROWS).all(is_driven) {
            return self.driven(choice, scales);
        }
        match self.soon(choice, scales, false) {
            Ok((grown, _)) => Some(grown),
            Err(regime) if regime == choice.regime => self.driven(choice, scales),
            // Only the slips of the choice begin here. The motion meets those that begin later.
            Err(_) => self.until(choice.regime, &choice.accelerations, scales),
        }
    }

    /// The same where the accelerations of the choice drive the slips.
    fn driven(
        &self,
        choice: &Choice<S::Scalar, N, C, W>,
        scales: &Scales<S::Scalar, C>,
    ) -> Option<Grown<S::Scalar, N, C, W>> {
        let number = S::Scalar::from_f64;
        let mut later: S::Scalar = num_traits::Zero::zero();
        for rows in self.beginning(&choice.regime).slips(&S::ROWS) {
            // Rounding errors tell no time.
            let strength = self.strength(rows, &choice.sizes.accelerations);
            if !above(self.driven_part(rows, &choice.accelerations, strength), rounding()) {
                return None;
            }
            let spans = self.spans(rows, &choice.velocities, &choice.accelerations, &choice.sizes);
            let [least, longest] = spans.each(|span| span.part(0));
            let time = number(LAUNCHED) * least;
            let is_longer = longest.is_positive() && above(time, longest);
            later = most(later, if is_longer { most(longest, least) } else { time });
        }
        // If the load changes before, the slip begins at a slower speed, but not below the one at which
        // roundings leave it no direction.
        let mut slip = number(LAUNCHED) * self.lost.part(0);
        while later.is_finite() && later.is_positive() && !above(rounding(), slip) {
            match self.grown_by(choice.regime, &choice.accelerations, scales, later) {
                Ok(grown) => return Some(grown),
                Err(Not::Strays) => return None,
                Err(_) => {}
            }
            (later, slip) = (later * number(1.0 / FACTOR), slip * number(1.0 / FACTOR));
        }
        None
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
                Err(Not::Grown | Not::Strays) => break,
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
        let zero: S::Scalar = num_traits::Zero::zero();
        let [least, later] = self.grows(regime, a, scales)?;
        if !is_shared {
            return Ok((self.grown_within(regime, a, scales, [least, later])?, zero));
        }
        let end = self.load_at(regime, a, scales, later)?;
        let middle = self.load_at(regime, a, scales, later * number(0.5))?;
        let onset = self.onset(regime, a, scales, later, [end.most(), middle.most()]);
        let between = self.load_at(regime, a, scales, number(0.5) * (onset + later))?;
        // What drives a slip at once, when the last possible shares are gone, has not grown. In the time that
        // the load takes to grow, it would give a velocity beyond the error of that time.
        let wanted = self.growth();
        let soon = self.load_at(regime, a, scales, onset + wanted * (later - onset));
        let is_driven = soon.is_ok_and(|load| above(load.most(), number(2.0) * wanted * end.most()));
        if is_driven || !end.is_even(&between) {
            return Err(Not::Grown);
        }
        Ok((self.taken_on(regime, a, &middle, &end).ok_or(Not::Grown)?, onset))
    }

    /// When the load has grown as far as is wanted \[s], twice. Where it does not grow that far: from when on
    /// it shows, and until when it grows.
    fn grows(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
    ) -> Result<[S::Scalar; 2], Not<S::Scalar, C, W>> {
        let number = S::Scalar::from_f64;
        let (wanted, zero) = (self.growth(), num_traits::Zero::zero());
        let mut later = self.instant();
        let (mut first, mut largest) = (None, [later, zero]);
        for _ in 0..TRIES {
            let part = match self.load_at(regime, a, scales, later) {
                Ok(load) => load.most(),
                Err(Not::Grown) => zero,
                Err(other) => return Err(other),
            };
            if above(part, wanted) {
                return Ok([later * (wanted / part); 2]);
            }
            let near = rounding::<S::Scalar>() + wanted / number(FACTOR);
            // A load that has shown and falls again grows no further. What comes later is another one. What
            // is as near to rounding errors as to the load that is wanted may be such errors.
            let shown = (rounding::<S::Scalar>() * wanted).sqrt();
            if above(largest[1], most(part + part, shown)) || above(largest[1], most(part, near)) {
                return first.map(|first| [first, largest[0]]).ok_or(Not::Grown);
            }
            if !above(part, rounding()) {
                first = Some(later);
            }
            largest = [later, part];
            later *=
                if above(part, near) { number(1.0 + 1.0 / FACTOR) * wanted / part } else { number(FACTOR) };
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
            let at = |place| self.load_at(regime, a, scales, onset + place).map(|load| load.most());
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
        let in_regime = self.system.in_regime(&stuck.regime);
        let State { t, q, v } = self.moved(&in_regime, &stuck.accelerations, later)?;
        let start = stuck.accelerations;
        let end = S::equations_in(&in_regime, t, &q, &v, self.inputs)?.balance().accelerations;
        let middle = array(|i| S::Scalar::from_f64(0.5) * (start[i] + end[i]));
        let ramp = Ramp { start, middle, end, lasts: later };
        Some(Grown::along(stuck.regime, &self.state.v, ramp))
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
            match self.load_at(regime, a, scales, later) {
                Ok(load) => last = Some(load.later),
                Err(Not::Alone(_)) => break,
                Err(_) => {}
            }
            later *= S::Scalar::from_f64(2.0);
        }
        self.grown_within(regime, a, scales, [self.instant(), last?]).ok()
    }

    /// The motion after the longest time between two that is found. A load that grows no longer has grown
    /// evenly before.
    fn grown_within(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        [least, mut later]: [S::Scalar; 2],
    ) -> Result<Grown<S::Scalar, N, C, W>, Not<S::Scalar, C, W>> {
        loop {
            match self.grown_by(regime, a, scales, later) {
                Err(Not::Grown) if above(later, least) => later *= S::Scalar::from_f64(0.5),
                grown => return grown,
            }
        }
    }

    /// A time that rounding hardly resolves \[s].
    pub(super) fn instant(&self) -> S::Scalar {
        let ulp = S::Scalar::epsilon();
        S::Scalar::from_f64(FACTOR) * ulp * self.state.t.part(0).abs() + ulp.powi(4)
    }

    /// The motion after a time \[s], if the load grows evenly until then. One that does not is another one,
    /// met later.
    fn grown_by(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        later: S::Scalar,
    ) -> Result<Grown<S::Scalar, N, C, W>, Not<S::Scalar, C, W>> {
        let number = S::Scalar::from_f64;
        let (mut later, mut largest) = (later, number(f64::INFINITY));
        for _ in 0..TRIES {
            let end = self.load_at(regime, a, scales, later)?;
            let middle = self.load_at(regime, a, scales, number(0.5) * later)?;
            if !end.is_even(&middle) {
                return Err(Not::Grown);
            }
            let grown = self.taken_on(regime, a, &middle, &end).ok_or(Not::Grown)?;
            // A slow slip varies so fast that a correction would leave derivatives no digits.
            let grown =
                if S::Scalar::PARTS > 1 { grown } else { self.corrected(&grown).ok_or(Not::Grown)? };
            let strays = self.strays(&grown, &end, scales).ok_or(Not::Grown)?;
            // The slip grows like t², and what it does to its own load like t⁴. An error of a time that is
            // much too long tells nothing of a short one.
            let quartic = number(0.9) / strays.error.part(0).sqrt().sqrt();
            let factor = most(quartic, number(1.0 / FACTOR));
            let is_fast = above(strays.known.part(0) * factor * factor, number(1.0));
            if !above(strays.error, number(1.0)) || !is_fast {
                return Ok(grown);
            }
            // A shorter time does not mend the error of an acceleration that stays. That of a load which
            // turns falls like t².
            if above(strays.error, largest) {
                return Err(Not::Strays);
            }
            (later, largest) = (later * factor, strays.error * factor * factor.sqrt());
        }
        Err(Not::Grown)
    }
}
