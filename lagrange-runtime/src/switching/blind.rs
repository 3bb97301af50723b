//! Events of steps that are blind to narrow functions.
//!
//! A law of friction is narrowest where its slip is zero, and there the step ends. A series that starts far
//! away does not contain what is narrow ([`probe`](crate::integrator::jets::probe)), so that it agrees with
//! the equations before and behind it. At the event itself it does not.

use num_traits::Zero;

use super::guards::Guard;
use super::place::Event;
use super::run::Run;
use super::valid::Found;
use super::{Row, Switching};
use crate::integrator::agreement::Agreement;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, any};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The most halvings of the way to an event at which a series does not agree.
const HALVINGS: usize = 24;

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// The event that ends the piece, or none; where the step does not obey the equations at the event, the
    /// end of a part of it on which it does.
    pub(super) fn agreed_until(
        &mut self,
        found: Found<S, N, K, C, W>,
    ) -> Result<Found<S, N, K, C, W>, Cause> {
        if !M::IS_BLIND {
            return Ok(found);
        }
        let (start, step) = (self.memory.start, self.memory.end);
        let Some(Event { state, guard: Some(Guard::Row(row)), .. }) = &found else { return Ok(found) };
        // A slip in two directions has no accelerations where it ends.
        if !matches!(S::ROWS.get(*row), Some(Row::Friction { pair: None, .. })) {
            return Ok(found);
        }
        let part = (state.t - start.t) / (step.t - start.t);
        if !part.is_positive() || self.agrees(state, part) != Some(false) {
            return Ok(found);
        }
        let mut nearer = part;
        for _ in 0..HALVINGS {
            nearer *= S::Scalar::from_f64(0.5);
            let memory = &mut *self.memory;
            let (in_regime, constants) = (&memory.in_regime, &memory.constants);
            let inner = &mut memory.inner;
            let state = M::within(inner, in_regime, constants, self.control, self.limits, nearer)
                .map_err(|error| error.cause)?;
            if self.agrees(&state, nearer) == Some(true) {
                return Ok(Some(Event::cut(state)));
            }
        }
        Ok(found)
    }

    /// Whether the equations give the accelerations of the polynomial at a state after a part of the step.
    /// `None` for a step without a polynomial, and for equations without a value.
    fn agrees(&self, state: &State<S::Scalar, N>, part: S::Scalar) -> Option<bool> {
        let State { t, q, v } = state;
        let number = S::Scalar::from_f64;
        let memory = &*self.memory;
        let terms = M::terms(&memory.inner)?;
        let theta = part * terms.length;
        let mut slopes = [S::Scalar::zero(); N];
        for (order, row) in terms.v.iter().enumerate().rev() {
            let order = number((order + 1) as f64);
            slopes = array(|i| S::Scalar::mul_add(slopes[i], theta, order * row[i]));
        }
        let expected = slopes.each(|slope| slope / terms.unit);
        let found = memory.in_regime.accelerations_at(&memory.constants, *t, q, v, &self.control.0);
        if !found.iter().all(|found| found.is_finite()) {
            return None;
        }
        let absolute = self.limits.absolute.unwrap_or(S::Scalar::zero());
        let agreement = Agreement {
            start: &memory.start,
            span: theta * terms.unit,
            tolerances: [self.limits.relative, absolute],
        };
        let mut strongest = [S::Scalar::zero(); N];
        Some(!any(agreement.faults(state, [&found, &expected], &mut strongest)))
    }
}
