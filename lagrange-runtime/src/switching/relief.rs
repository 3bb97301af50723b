//! Contacts that bear nothing although they touch and stay: those that others relieve.
//!
//! Four feet on a plane have more loads than equations. They are those of equal stiff springs under the feet:
//! nᵢ = max(0, Aᵢ y) with one small displacement y. Where feet slip, their motion depends on the loads, so a
//! regime in which another foot is relieved is another motion. It agrees with its own consequences, since a
//! foot that depends on the others stays on the plane in either case.

use super::scene::{Scene, above, extent, product};
use super::{Regime, Row, Switching};
use crate::linear::SaddlePoint;
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::state::State;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// Whether a contact that is not active would bear if those that do were equal stiff springs under these
    /// loads, forces or impulses. No if the motion that they leave can open it.
    #[cold]
    pub(super) fn would_bear(&self, row: usize, active: &[bool; C], loads: &[S::Scalar; C]) -> bool {
        self.pressing(row, active, loads).is_positive()
    }

    /// Whether an active contact that bears nothing would be lifted if the others were such springs.
    #[cold]
    pub(super) fn is_lifted(&self, row: usize, active: &[bool; C], loads: &[S::Scalar; C]) -> bool {
        (-self.pressing(row, &array(|other| active[other] && other != row), loads)).is_positive()
    }

    /// How far such springs under active contacts press a contact that depends on them into its surface; zero
    /// for another contact, and where it is a rounding error.
    fn pressing(&self, row: usize, active: &[bool; C], loads: &[S::Scalar; C]) -> S::Scalar {
        let zero: S::Scalar = num_traits::Zero::zero();
        let State { t, q, v } = &self.state;
        let regime = Regime { active: *active, kinks: self.kinks, ..Regime::open(&S::ROWS) };
        let Some(own) = self.gradients.get(row) else { return zero };
        let Some(equations) = S::equations_in(&self.system.in_regime(&regime), *t, q, v, self.inputs) else {
            return zero;
        };
        let half = S::Scalar::epsilon().sqrt();
        let mobility = product(own, &equations.saddle.solve(own, &[zero; C]).0);
        if above(mobility, half * self.effect(row, &array(|i| own[i].abs()))) {
            return zero;
        }
        let is_spring = |row: usize| active[row] && S::ROWS[row] == Row::Unilateral;
        let springs = array(|row| if is_spring(row) { loads[row] } else { zero });
        let (shift, _) = equations.saddle.solve(&[zero; N], &springs);
        let depth = product(own, &shift);
        if above(depth.abs(), half * extent(own, &shift)) { depth } else { zero }
    }

    /// Whether a friction slips, in one of these ways, under a load that contacts determine.
    pub(super) fn slides(slips: impl Fn(usize) -> bool) -> bool {
        S::ROWS.iter().enumerate().any(|(row, kind)| match kind {
            Row::Friction { normal: Some(_), pair } => slips(pair.map_or(row, |other| row.min(other))),
            _ => false,
        })
    }
}
