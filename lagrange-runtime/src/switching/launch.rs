//! Slips in two directions that begin: their directions, and how they begin.

use super::choice::Sizes;
use super::scene::{Scene, Status, above, entry, extent, most, product, put, rounding};
use super::turning::{TURNS, Turning, pairs};
use super::{Regime, Row, Switching};
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

    /// The slips: the rows of their two directions.
    pub(super) fn slips<'a>(&'a self, rows: &'a [Row; C]) -> impl Iterator<Item = [usize; 2]> + 'a {
        pairs(rows).filter(|rows| self.has(rows[0]))
    }

    /// A regime with these slips held.
    pub(super) fn held<R: Real, const W: usize>(&self, regime: &Regime<R, C, W>) -> Regime<R, C, W> {
        let mut held = *regime;
        let rows = self.0.iter().zip(held.slip.iter_mut().zip(&mut held.active));
        for (_, (slip, active)) in rows.filter(|(begins, _)| **begins) {
            (*slip, *active) = (R::zero(), true);
        }
        held
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
                rows.into_iter().for_each(|row| put(&mut begins, row, true));
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
        let stuck = begins.held(regime);
        let held = S::equations_in(&self.system.in_regime(&stuck), *t, q, v, self.inputs)?;
        let strengths = self.balance(&stuck, v)?.1.accelerations;
        let mut slips = held.balance().multipliers.each(|force| -force);
        let (mut turning, mut is_scaled) = (Turning::new(), false);
        let mut velocities = *v;
        for _ in 0..TURNS {
            let mut lack = [zero; C];
            for [row, other] in begins.slips(&S::ROWS) {
                let length = entry(&slips, row).hypot(entry(&slips, other));
                if !length.is_positive() {
                    return None;
                }
                let lost = most(entry(&self.speeds, row), entry(&self.speeds, other)) * self.lost;
                // In the time that rounding hides, forces change a velocity by this.
                let [a, b] = [row, other].each(|row| self.extent_of(row, &strengths));
                let hidden = S::Scalar::from_f64(4.0) * S::Scalar::epsilon() * t.abs() * most(a, b);
                let least = most(lost, hidden);
                let least = if least.is_positive() { least } else { S::Scalar::epsilon() * self.lost };
                let size = least * S::Scalar::from_f64(LAUNCHED);
                for row in [row, other] {
                    let rate = entry(&self.laws.rows.rates, row);
                    put(&mut lack, row, size * entry(&slips, row) / length - rate);
                }
            }
            let (change, _) = held.saddle.solve(&[zero; N], &lack);
            velocities = array(|i| v[i] + change[i]);
            let (balance, sizes) = self.balance(regime, &velocities)?;
            let (mut lacks, mut is_done) = ([zero; C], true);
            for [row, other] in begins.slips(&S::ROWS) {
                let rates = [row, other].each(|row| self.rate(row, &balance.accelerations));
                let speed = rates[0].hypot(rates[1]);
                let noise = rounding::<S::Scalar>() * self.extent_of(row, &sizes.accelerations);
                // If nothing accelerates the slip, it takes the direction of the force that drives it.
                if !above(speed, noise) {
                    continue;
                }
                let now = [row, other].each(|row| entry(&slips, row));
                let share = if is_scaled { num_traits::One::one() } else { speed / now[0].hypot(now[1]) };
                let scaled = now.each(|slip| share * slip);
                let lack = [rates[0] - scaled[0], rates[1] - scaled[1]];
                for (row, (slip, lack)) in [row, other].into_iter().zip(scaled.into_iter().zip(lack)) {
                    put(&mut slips, row, slip);
                    put(&mut lacks, row, lack);
                }
                is_done = is_done && !above(lack[0].hypot(lack[1]), noise);
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
        for rows in begins.slips(&S::ROWS) {
            let [x, y] = rows.each(|row| entry(&self.laws.rows.rates, row) + self.change(row, velocities));
            let [turn_x, turn_y] = rows.each(|row| self.rate(row, &balance.accelerations));
            let [a, b] = rows.each(|row| self.extent_of(row, &sizes.accelerations));
            let (speed, strength) = (turn_x.hypot(turn_y), most(a, b));
            let time = x.hypot(y) / speed;
            // The time scale of the motion as a whole is its speed over its acceleration.
            let whole = rows.each(|row| entry(&self.speeds, row));
            let whole = most(whole[0], whole[1]);
            if !time.is_finite() || above(time * strength * strength, whole * speed) {
                return None;
            }
            later = most(later, time);
        }
        Some(later)
    }

    /// Σ |aᵢ xᵢ| of the gradient of a row.
    pub(super) fn extent_of(&self, row: usize, x: &[S::Scalar; N]) -> S::Scalar {
        self.gradients.get(row).map_or(num_traits::Zero::zero(), |gradient| extent(gradient, x))
    }

    /// The change of the rate of a row by velocities.
    pub(super) fn change(&self, row: usize, velocities: &[S::Scalar; N]) -> S::Scalar {
        let change = array(|i| velocities[i] - self.state.v[i]);
        self.gradients.get(row).map_or(num_traits::Zero::zero(), |gradient| product(gradient, &change))
    }
}
