//! Slips in two directions that begin: which do, and the speed and time with which they go on.

use super::choice::Sizes;
use super::scene::{Scene, Status, above, entry, extent, most, product, put};
use super::turning::{has_pairs, pairs};
use super::{Regime, Row, Switching};
use crate::constraints::Balance;
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::state::State;

/// The slip, in errors of velocities, from which on a slip in two directions has a direction: they turn it by
/// no more than the inverse of this number.
pub(super) const LAUNCHED: f64 = 16.0;

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
    /// The slips in two directions that begin in a regime.
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

    /// The same scene, in which slips in two directions that are slower than those that begin are at rest.
    /// The direction of such a slip is an error of velocities, and friction in a wrong direction may leave no
    /// motion. `None` where no slip is that slow.
    #[cold]
    pub(super) fn resting(&self) -> Option<Self> {
        if const { !has_pairs(&S::ROWS) } {
            return None;
        }
        let mut status = self.status;
        for rows in pairs(&S::ROWS) {
            let [x, y] = rows.each(|row| entry(&self.laws.rows.rates, row));
            let [a, b] = rows.each(|row| entry(&self.speeds, row));
            let least = S::Scalar::from_f64(LAUNCHED) * self.lost * most(a, b);
            if status.get(rows[0]) == Some(&Status::Slips) && !above(x.hypot(y), least) {
                rows.into_iter().for_each(|row| put(&mut status, row, Status::Rests));
            }
        }
        (status != self.status).then_some(Self { status, ..*self })
    }

    /// Velocities with the smallest slips whose directions the motion knows, in the directions of these.
    /// `None` where the equations have no solution, or a slip has no direction.
    #[cold]
    pub(super) fn launched(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        begins: &Begins<C>,
        slips: &[S::Scalar; C],
    ) -> Option<[S::Scalar; N]> {
        let State { t, q, v } = &self.state;
        let stuck = begins.held(regime);
        let held = S::equations_in(&self.system.in_regime(&stuck), *t, q, v, self.inputs)?;
        let strengths = self.balance(&stuck, v)?.1.accelerations;
        self.with_slips(regime, slips, begins, &held.saddle, &strengths)
    }

    /// Velocities with slips in the directions of these. Slips of feet that share a load are those of one
    /// motion: the slowest has the size that its direction needs. `None` where a slip has no direction, or
    /// what sticks leaves no such motion.
    fn with_slips(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        slips: &[S::Scalar; C],
        begins: &Begins<C>,
        held: &impl SaddlePoint<S::Scalar, N, C>,
        strengths: &[S::Scalar; N],
    ) -> Option<[S::Scalar; N]> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let (mut factors, mut largest) = ([zero; C], zero);
        for rows in begins.slips(&S::ROWS) {
            let [x, y] = rows.each(|row| entry(slips, row));
            let factor = self.least_slip(rows, strengths) / x.hypot(y);
            if !factor.is_finite() {
                return None;
            }
            largest = most(largest, factor);
            rows.into_iter().for_each(|row| put(&mut factors, row, factor));
        }
        let is_shared = !held.is_independent();
        let lack = array(|row| {
            let factor = if is_shared { largest } else { entry(&factors, row) };
            if begins.has(row) {
                factor * entry(slips, row) - entry(&self.laws.rows.rates, row)
            } else {
                zero
            }
        });
        let (change, _) = held.solve(&[zero; N], &lack);
        let velocities = array(|i| self.state.v[i] + change[i]);
        if !is_shared {
            return Some(velocities);
        }
        // Two feet that stick hold a third one: it does not slip, or they do not stick.
        let length = |rows: [usize; 2], part: &dyn Fn(usize) -> S::Scalar| {
            let [x, y] = rows.each(part);
            x.hypot(y)
        };
        let wanted = |row: usize| entry(&lack, row) + entry(&self.laws.rows.rates, row);
        let slowest = begins.slips(&S::ROWS).map(|rows| length(rows, &wanted));
        let slowest = slowest.reduce(|least, slip| if above(least, slip) { slip } else { least })?;
        let is_met = |rows: [usize; 2]| {
            let missed = |row: usize| self.rate_at(row, &velocities) - wanted(row);
            !above(length(rows, &missed), S::Scalar::from_f64(0.5) * slowest)
        };
        let sticks = |rows: &[usize; 2]| begins.has(rows[0]) || regime.active.get(rows[0]) == Some(&true);
        pairs(&S::ROWS).filter(sticks).all(is_met).then_some(velocities)
    }

    /// The smallest slip whose direction the motion knows, where forces can make such accelerations.
    fn least_slip(&self, rows: [usize; 2], strengths: &[S::Scalar; N]) -> S::Scalar {
        let lost = self.scale_of(rows) * self.lost;
        let least = most(lost, self.hidden_slip(self.strength(rows, strengths)));
        let ulps = S::Scalar::from_f64(LAUNCHED) * S::Scalar::epsilon();
        if least.is_positive() { least } else { ulps * self.lost }
    }

    /// The size of both velocities of a slip in two directions.
    pub(super) fn scale_of(&self, rows: [usize; 2]) -> S::Scalar {
        let [a, b] = rows.each(|row| entry(&self.speeds, row));
        most(a, b)
    }

    /// What accelerations of these sizes could give a slip.
    pub(super) fn strength(&self, rows: [usize; 2], accelerations: &[S::Scalar; N]) -> S::Scalar {
        let [a, b] = rows.each(|row| self.extent_of(row, accelerations));
        most(a, b)
    }

    /// The slip that such a strength makes in the time that rounding hides, with room for a direction.
    pub(super) fn hidden_slip(&self, strength: S::Scalar) -> S::Scalar {
        S::Scalar::from_f64(4.0 * LAUNCHED) * S::Scalar::epsilon() * self.state.t.abs() * strength
    }

    /// Whether the roundings of velocities leave a slip its direction.
    pub(super) fn has_direction(&self, rows: [usize; 2]) -> bool {
        let [x, y] = rows.each(|row| entry(&self.laws.rows.rates, row));
        let [a, b] = rows.each(|row| entry(&self.laws.rows.rate_sizes, row));
        above(x.hypot(y), S::Scalar::from_f64(LAUNCHED) * S::Scalar::epsilon() * most(a, b))
    }

    /// The time \[s] in which a slip that begins grows to that of `velocities`, and the longest in which its
    /// acceleration stays: the part that it is of what forces could give, of the time scale of the motion.
    pub(super) fn spans(
        &self,
        rows: [usize; 2],
        velocities: &[S::Scalar; N],
        accelerations: &[S::Scalar; N],
        sizes: &Sizes<S::Scalar, N>,
    ) -> [S::Scalar; 2] {
        let [x, y] = rows.each(|row| self.rate_at(row, velocities));
        let [turn_x, turn_y] = rows.each(|row| self.rate(row, accelerations));
        let (speed, strength) = (turn_x.hypot(turn_y), self.strength(rows, &sizes.accelerations));
        // The time scale of the motion as a whole is its speed over its acceleration.
        [x.hypot(y) / speed, self.scale_of(rows) * speed / (strength * strength)]
    }

    /// The time \[s] in which slips that begin grow to those of `velocities`. `None` where it is so long that
    /// accelerations change meanwhile, or that a contact closes which is open in the regime.
    #[cold]
    pub(super) fn later(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        begins: &Begins<C>,
        velocities: &[S::Scalar; N],
        balance: &Balance<S::Scalar, N, C>,
        sizes: &Sizes<S::Scalar, N>,
    ) -> Option<S::Scalar> {
        let mut later = num_traits::Zero::zero();
        for rows in begins.slips(&S::ROWS) {
            let [time, longest] = self.spans(rows, velocities, &balance.accelerations, sizes);
            if !time.is_finite() || above(time, longest) {
                return None;
            }
            later = most(later, time);
        }
        // A contact that closes meanwhile would be missed.
        let half = S::Scalar::from_f64(0.5);
        let closes = |row: usize| {
            let open = S::ROWS.get(row) == Some(&Row::Unilateral) && regime.active.get(row) == Some(&false);
            let (gap, rate) = (entry(&self.laws.rows.positions, row), entry(&self.laws.rows.rates, row));
            let change = later * (rate + half * later * self.rate(row, &balance.accelerations));
            open && (-change).is_positive() && (-(gap + change)).is_positive()
        };
        (!(0..C).any(closes)).then_some(later)
    }

    /// The multiplier with which a row balances forces or impulses of these sizes.
    pub(super) fn borne(&self, row: usize, sizes: &[S::Scalar; N]) -> S::Scalar {
        let squares = self.gradients.get(row).map(|gradient| product(gradient, gradient));
        let squares = squares.filter(|squares| squares.is_positive());
        squares.map_or(num_traits::Zero::zero(), |squares| self.extent_of(row, sizes) / squares)
    }

    /// Σ |aᵢ xᵢ| of the gradient of a row.
    pub(super) fn extent_of(&self, row: usize, x: &[S::Scalar; N]) -> S::Scalar {
        self.gradients.get(row).map_or(num_traits::Zero::zero(), |gradient| extent(gradient, x))
    }

    /// The change of the rate of a row where the velocities become these.
    pub(super) fn change(&self, row: usize, velocities: &[S::Scalar; N]) -> S::Scalar {
        self.along(row, &array(|i| velocities[i] - self.state.v[i]))
    }

    /// The rate of a row, or a slip, at these velocities.
    pub(super) fn rate_at(&self, row: usize, velocities: &[S::Scalar; N]) -> S::Scalar {
        entry(&self.laws.rows.rates, row) + self.change(row, velocities)
    }

    /// Σ aᵢ xᵢ of the gradient of a row: what a change of velocities does to its rate.
    pub(super) fn along(&self, row: usize, change: &[S::Scalar; N]) -> S::Scalar {
        self.gradients.get(row).map_or(num_traits::Zero::zero(), |gradient| product(gradient, change))
    }
}
