//! Steps of lanes that all go on: computed on whole vectors, so that no number is taken out of its lane and
//! put back.

use super::{Lane, NEAR, Relay, Standing};
use crate::number::real::{Real, Vector};
use crate::series::HIGHEST;
use crate::system::attitude;
use crate::system::smooth::Smooth;

impl<S: Smooth<N, K>, const N: usize, const K: usize> Relay<S, N, K>
where
    S::Scalar: Vector,
{
    /// The step of each lane where all of them go on by what their series allow. The bits are then those of
    /// [`Relay::go_apart`]. False, and nothing has changed, where some lane needs another look.
    pub(super) fn go_abreast(&mut self, tolerated: S::Scalar) -> bool {
        let number = S::Scalar::from_f64;
        let zero = <Lane<S::Scalar> as num_traits::Zero>::zero();
        let lanes = self.standing.iter().zip(&self.attempts).take(S::Scalar::COUNT);
        if lanes.into_iter().any(|(&standing, &attempts)| standing != Standing::Running || attempts == 0) {
            return false;
        }
        let left = (self.target - self.state.t) - self.residue.t;
        let is_finite = |rows: &[[S::Scalar; N]; HIGHEST]| {
            rows.get(self.orders - 1).is_some_and(|row| row.iter().all(|x| x.is_finite()))
        };
        let finite = [left, tolerated].into_iter().all(Real::is_finite);
        if !(finite && self.state.is_finite() && is_finite(&self.series.q) && is_finite(&self.series.v)) {
            return false;
        }
        let far = (number(1.0 / NEAR) - tolerated).max(tolerated - number(NEAR));
        let unit = self.unit.abs();
        let mut natural = tolerated * unit;
        if let Some(longest) = self.limits.step {
            natural = natural.min(S::Scalar::splat(longest));
        }
        let length = natural.min(left.abs());
        let theta = length / unit;
        if far.largest() > zero || (self.resolution() - length).largest() >= zero || !theta.is_positive() {
            return false;
        }
        // Exactly one, with the sign of the unit.
        let direction = self.unit / unit;
        let Some(landed) = self.landed(self.reached(direction * length, theta), theta) else { return false };
        if !(0..S::Scalar::COUNT).all(|lane| landed.is_right(lane)) {
            return false;
        }
        let (state, residue) = landed.at;
        if !state.is_finite() || attitude::settle(S::ORIENTATIONS, &state).is_some() {
            return false;
        }
        (self.state, self.residue, self.unit) = (state, residue, direction * natural);
        self.attempts.iter_mut().take(S::Scalar::COUNT).for_each(|attempts| *attempts -= 1);
        let missing = (self.target - self.state.t) - self.residue.t;
        if (self.resolution() - missing.abs()).largest() >= zero {
            (0..S::Scalar::COUNT).for_each(|lane| self.arrives(lane));
        }
        true
    }

    /// Lengths that time does not resolve \[s].
    fn resolution(&self) -> S::Scalar {
        let size = self.target.abs().max(self.state.t.abs());
        S::Scalar::from_f64(4.0) * S::Scalar::epsilon() * size
    }
}
