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
use super::memory::shift;
use super::scene::{Known, Scales, Scene, Status, above, entry, most, put, rounding};
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

/// A motion with slips that a growing load has begun, a short time later.
pub(super) struct Grown<R, const N: usize, const C: usize, const W: usize> {
    pub(super) regime: Regime<R, C, W>,
    /// The time that has passed \[s].
    pub(super) later: R,
    /// The changes of coordinates and velocities until then.
    pub(super) gain: [[R; N]; 2],
    /// The accelerations at the end of the way, and their rate on it.
    pub(super) way: [[R; N]; 2],
}

/// The same for one time, with the acceleration of each slip as a part of what the forces could give it.
type Ahead<R, const N: usize, const C: usize, const W: usize> = (Grown<R, N, C, W>, [R; C]);

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
        let begins = self.beginning(&choice.regime);
        let is_driven = |rows: [usize; 2]| above(self.driven_part(rows, choice), rounding::<S::Scalar>());
        if begins.slips(&S::ROWS).all(is_driven) {
            return None;
        }
        let a = &choice.accelerations;
        let mut regime = choice.regime;
        for _ in 0..=C {
            match self.grown_in(regime, a, scales) {
                Ok(grown) => return Some(grown),
                Err(Not::Grown) if regime == choice.regime => return None,
                Err(Not::Grown) => break,
                // The same load soon drives others, too.
                Err(Not::Alone(other)) => regime = other,
            }
        }
        // Otherwise only the slips of the choice begin here. The motion meets those that begin later.
        self.until(choice.regime, a, scales)
    }

    /// The same in a regime, if all its slips that begin grow evenly from now on.
    fn grown_in(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
    ) -> Result<Grown<S::Scalar, N, C, W>, Not<S::Scalar, C, W>> {
        let number = S::Scalar::from_f64;
        // The cube root of what velocities lose anyway.
        let wanted = (self.lost.part(0).ln() / number(3.0)).exp();
        let most_of =
            |parts: &[S::Scalar; C]| parts.iter().fold(num_traits::Zero::zero(), |a, &b| most(a, b));
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
                let (_, halves) = self.ahead(regime, a, scales, later * number(0.5))?;
                let is_even = |(&whole, &half): (&S::Scalar, &S::Scalar)| {
                    !above(number(0.4) * whole, half) && !above(half, number(0.6) * whole)
                };
                return if parts.iter().zip(&halves).all(is_even) { Ok(grown) } else { Err(Not::Grown) };
            }
            let is_near = above(part, rounding::<S::Scalar>() + wanted / number(FACTOR));
            later *= if is_near { number(1.0 + 1.0 / FACTOR) * wanted / part } else { number(FACTOR) };
        }
        Err(Not::Grown)
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
        let mut state = self.state;
        shift(&mut state, a, later);
        state.t += later;
        in_regime.project_at(&in_regime.constants(), &mut state, None).map_err(|_| Not::Grown)?;
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
        // The integrals of accelerations that grow linearly.
        let State { t, q, v } = self.state;
        let b = &there.accelerations;
        let state = State {
            t: t + later,
            q: array(|i| q[i] + later * (v[i] + later * (a[i] + a[i] + b[i]) / number(6.0))),
            v: array(|i| v[i] + later * (a[i] + b[i]) / number(2.0)),
        };
        // The slip is that of its own accelerations: in the direction of the load, as it is there.
        let rates = self.system.laws_at(state.t, &state.q, &state.v, self.inputs).rows.rates;
        let lack = array(|row| if begins.has(row) { slips[row] - rates[row] } else { zero });
        let equations = S::equations_in(&in_regime, state.t, &state.q, &state.v, self.inputs);
        let (change, _) = equations.ok_or(Not::Grown)?.saddle.solve(&[zero; N], &lack);
        let gain = [array(|i| state.q[i] - q[i]), array(|i| (state.v[i] - v[i]) + change[i])];
        let way = [*b, array(|i| (b[i] - a[i]) / later)];
        Ok((Grown { regime, later, gain, way }, parts))
    }
}
