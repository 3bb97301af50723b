//! The motion on which slips begin.

use super::super::scene::{Scene, entry, put};
use super::super::sided::laws_on;
use super::super::way::Ramp;
use super::super::{Regime, Switching};
use super::Grown;
use super::load::Load;
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::system::state::State;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The motion until the end of a time, with the accelerations `a` now and loads in its middle and at its
    /// end.
    pub(super) fn taken_on(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        middle: &Load<S::Scalar, N, C>,
        end: &Load<S::Scalar, N, C>,
    ) -> Option<Grown<S::Scalar, N, C, W>> {
        let number = S::Scalar::from_f64;
        let (zero, later): (S::Scalar, _) = (num_traits::Zero::zero(), end.later);
        let begins = self.beginning(&regime);
        let mut ramp = Ramp { start: *a, middle: middle.accelerations, end: end.accelerations, lasts: later };
        let State { t, q, v } = self.state;
        let [gain_q, gain_v] = ramp.gain(&v);
        let (t, q, v) = (t + later, array(|i| q[i] + gain_q[i]), array(|i| v[i] + gain_v[i]));
        // The slip has the direction of the load, as it is at the end.
        let rates = laws_on(self.system, &State { t, q, v }, self.inputs, &self.kinks).rows.rates;
        let mut lack = [zero; C];
        for rows in begins.slips(&S::ROWS) {
            // Where nothing accelerates the slip, that is so for varied motions, too.
            let size = |load: &dyn Fn(usize) -> S::Scalar| {
                let [x, y] = rows.each(load);
                if x.part(0) == zero && y.part(0) == zero { zero } else { x.hypot(y) }
            };
            let [first, half, last] = [
                size(&|row| self.rate(row, a)),
                size(&|row| entry(&middle.rates, row)),
                size(&|row| entry(&end.rates, row)),
            ];
            let mean = (first + number(4.0) * half + last) / number(6.0);
            for row in rows {
                let slip = later * mean * (entry(&end.rates, row) / last);
                put(&mut lack, row, slip - entry(&rates, row));
            }
        }
        let in_regime = self.system.in_regime(&begins.held(&regime));
        let equations = S::equations_in(&in_regime, t, &q, &v, self.inputs)?;
        let (change, _) = equations.saddle.solve(&[zero; N], &lack);
        // Where the load turns, the slip turns with it: what that adds to its velocity grows like t³.
        for ((middle, end), &change) in ramp.middle.iter_mut().zip(&mut ramp.end).zip(&change) {
            let rate = change / later;
            *middle += number(0.75) * rate;
            *end += number(3.0) * rate;
        }
        Some(Grown::along(regime, &self.state.v, ramp))
    }

    /// A motion on which slips have begun, with the accelerations that the equations have in its middle and
    /// at its end, but for those of the slips. Loads are known where nothing slips, on a motion with constant
    /// accelerations. Beside the slips, a motion may turn meanwhile: a ball that spins does.
    pub(super) fn corrected(&self, grown: &Grown<S::Scalar, N, C, W>) -> Option<Grown<S::Scalar, N, C, W>> {
        let mut end = self.state;
        grown.take_on(&mut end, num_traits::Zero::zero());
        let half = S::Scalar::from_f64(0.5) * grown.later;
        let middle = grown.way.at(self.state.t + half, &end);
        let mut ramp = grown.ramp;
        ramp.middle = self.beside_slips(grown, &middle, ramp.middle)?;
        ramp.end = self.beside_slips(grown, &end, ramp.end)?;
        Some(Grown::along(grown.regime, &self.state.v, ramp))
    }

    /// The accelerations of a regime at a state, with the slips of these accelerations.
    pub(super) fn beside_slips(
        &self,
        grown: &Grown<S::Scalar, N, C, W>,
        State { t, q, v }: &State<S::Scalar, N>,
        accelerations: [S::Scalar; N],
    ) -> Option<[S::Scalar; N]> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let begins = self.beginning(&grown.regime);
        let found = {
            let in_regime = self.system.in_regime(&grown.regime);
            S::equations_in(&in_regime, *t, q, v, self.inputs)?.balance().accelerations
        };
        let in_regime = self.system.in_regime(&begins.held(&grown.regime));
        let equations = S::equations_in(&in_regime, *t, q, v, self.inputs)?;
        let mut lack = [zero; C];
        for row in begins.slips(&S::ROWS).flatten() {
            let gradient = equations.gradients.get(row)?;
            let slip = (0..N).fold(zero, |sum, i| sum + gradient[i] * (accelerations[i] - found[i]));
            put(&mut lack, row, slip);
        }
        let (change, _) = equations.saddle.solve(&[zero; N], &lack);
        let all: [S::Scalar; N] = array(|i| found[i] + change[i]);
        all.iter().all(|a| a.is_finite()).then_some(all)
    }
}
