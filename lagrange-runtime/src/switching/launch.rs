//! Slips in two directions that begin: their directions, and how they begin.

use super::choice::Sizes;
use super::scene::{Scene, Status, above, entry, extent, most, product, rounding};
use super::turning::{TURNS, Turning, pairs};
use super::{Regime, Switching};
use crate::constraints::Balance;
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::state::State;

/// The slip at which a slip in two directions begins, in errors of velocities. These turn it by no more than
/// the inverse of this number.
const LAUNCHED: f64 = 16.0;

/// Which slips in two directions begin: the rows of both directions.
pub(super) struct Begins<const C: usize>([bool; C]);

impl<const C: usize> Begins<C> {
    /// Whether a row is that of a slip that begins.
    pub(super) fn has(&self, row: usize) -> bool {
        self.0.get(row) == Some(&true)
    }

    /// Whether any slip begins.
    pub(super) fn any(&self) -> bool {
        self.0.contains(&true)
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The slips that begin in a regime.
    pub(super) fn beginning(&self, regime: &Regime<S::Scalar, C, W>) -> Begins<C> {
        let mut begins = [false; C];
        for rows in pairs(&S::ROWS) {
            let slips = |row: usize| entry(&regime.slip, row) != num_traits::Zero::zero();
            if self.status.get(rows[0]) == Some(&Status::Rests) && slips(rows[0]) {
                for row in rows {
                    if let Some(begins) = begins.get_mut(row) {
                        *begins = true;
                    }
                }
            }
        }
        Begins(begins)
    }

    /// Velocities with the smallest slip whose direction the motion knows, in the directions in which slips
    /// begin. These are the directions of their accelerations under friction against them.
    #[cold]
    pub(super) fn begun(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        begins: &Begins<C>,
    ) -> Option<[S::Scalar; N]> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let State { t, q, v } = &self.state;
        let mut stuck = *regime;
        for [row, other] in pairs(&S::ROWS).filter(|[row, _]| begins.has(*row)) {
            stuck.slip[row] = zero;
            (stuck.active[row], stuck.active[other]) = (true, true);
        }
        let held = S::equations_in(&self.system.in_regime(&stuck), *t, q, v, self.inputs)?;
        let strengths = self.balance(&stuck, v)?.1.accelerations;
        let mut slips = held.balance().multipliers.each(|force| -force);
        let (mut turning, mut is_scaled) = (Turning::new(), false);
        let mut velocities = *v;
        for _ in 0..TURNS {
            let mut lack = [zero; C];
            for [row, other] in pairs(&S::ROWS).filter(|[row, _]| begins.has(*row)) {
                let length = slips[row].hypot(slips[other]);
                if !length.is_positive() {
                    return None;
                }
                let lost = most(self.speeds[row], self.speeds[other]) * self.lost;
                // In the time that rounding hides, forces change a velocity by this.
                let [a, b] = [row, other].each(|row| extent(&self.gradients[row], &strengths));
                let hidden = S::Scalar::from_f64(4.0) * S::Scalar::epsilon() * t.abs() * most(a, b);
                let least = most(lost, hidden);
                let least = if least.is_positive() { least } else { S::Scalar::epsilon() * self.lost };
                let size = least * S::Scalar::from_f64(LAUNCHED);
                for row in [row, other] {
                    lack[row] = size * slips[row] / length - self.laws.rows.rates[row];
                }
            }
            let (change, _) = held.saddle.solve(&[zero; N], &lack);
            velocities = array(|i| v[i] + change[i]);
            let (balance, sizes) = self.balance(regime, &velocities)?;
            let (mut lacks, mut is_done) = ([zero; C], true);
            for [row, other] in pairs(&S::ROWS).filter(|[row, _]| begins.has(*row)) {
                let rates = [row, other].each(|row| self.rate(row, &balance.accelerations));
                let speed = rates[0].hypot(rates[1]);
                let noise = rounding::<S::Scalar>() * extent(&self.gradients[row], &sizes.accelerations);
                // If nothing accelerates the slip, it takes the direction of the force that drives it.
                if !above(speed, noise) {
                    continue;
                }
                if !is_scaled {
                    let share = speed / slips[row].hypot(slips[other]);
                    (slips[row], slips[other]) = (share * slips[row], share * slips[other]);
                }
                (lacks[row], lacks[other]) = (rates[0] - slips[row], rates[1] - slips[other]);
                is_done = is_done && !above(lacks[row].hypot(lacks[other]), noise);
            }
            if is_done {
                break;
            }
            is_scaled = true;
            let share = turning.share(&slips, &lacks);
            slips = array(|row| slips[row] + share * lacks[row]);
        }
        Some(velocities)
    }

    /// The time in which slips that begin grow to those of `velocities`. It is unknown if it is so long that
    /// accelerations change meanwhile.
    #[cold]
    pub(super) fn later(
        &self,
        begins: &Begins<C>,
        velocities: &[S::Scalar; N],
        balance: &Balance<S::Scalar, N, C>,
        sizes: &Sizes<S::Scalar, N>,
    ) -> Option<S::Scalar> {
        let mut later = num_traits::Zero::zero();
        for rows in pairs(&S::ROWS).filter(|[row, _]| begins.has(*row)) {
            let [x, y] = rows.each(|row| self.laws.rows.rates[row] + self.change(row, velocities));
            let [turn_x, turn_y] = rows.each(|row| self.rate(row, &balance.accelerations));
            let [a, b] = rows.each(|row| extent(&self.gradients[row], &sizes.accelerations));
            let (speed, strength) = (turn_x.hypot(turn_y), most(a, b));
            let time = x.hypot(y) / speed;
            // The time scale of the motion as a whole is its speed over its acceleration.
            let whole = most(self.speeds[rows[0]], self.speeds[rows[1]]);
            if !time.is_finite() || above(time * strength * strength, whole * speed) {
                return None;
            }
            later = most(later, time);
        }
        Some(later)
    }

    /// The change of the rate of a row by velocities.
    pub(super) fn change(&self, row: usize, velocities: &[S::Scalar; N]) -> S::Scalar {
        let change = array(|i| velocities[i] - self.state.v[i]);
        self.gradients.get(row).map_or(num_traits::Zero::zero(), |gradient| product(gradient, &change))
    }
}
