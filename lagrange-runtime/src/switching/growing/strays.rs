//! The check of the end of a motion on which slips have begun.

use super::super::Switching;
use super::super::known::Known;
use super::super::launch::LAUNCHED;
use super::super::scales::Scales;
use super::super::scene::{Scene, above, entry, most, rounding};
use super::Grown;
use super::load::Load;
use crate::number::elements::Each;
use crate::number::real::{Ordered, Real};
use crate::system::state::State;

/// How far a motion has strayed from the equations.
pub(super) struct Strays<R> {
    /// The error of a slip, in tolerances.
    pub(super) error: R,
    /// The slowest slip, as a part of what it needs to have a direction.
    pub(super) known: R,
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// How well the end of a motion obeys the equations, in which the slips are those that it has.
    pub(super) fn strays(
        &self,
        grown: &Grown<S::Scalar, N, C, W>,
        end: &Load<S::Scalar, N, C>,
        scales: &Scales<S::Scalar, C>,
    ) -> Option<Strays<S::Scalar>> {
        let number = S::Scalar::from_f64;
        let zero: S::Scalar = num_traits::Zero::zero();
        let mut state = self.state;
        grown.take_on(&mut state, zero);
        let in_regime = self.system.in_regime(&grown.regime);
        let equations = S::equations_in(&in_regime, state.t, &state.q, &state.v, self.inputs)?;
        let found = equations.balance().accelerations;
        let beside = if S::Scalar::PARTS > 1 {
            grown.way.accelerations
        } else {
            self.beside_slips(grown, &state, grown.way.accelerations)?
        };
        let disturbed = {
            let State { t, q, v } = &Self::disturbed(&state);
            S::equations_in(&in_regime, *t, q, v, self.inputs)?.balance().accelerations
        };
        let known = Known::settled(self.is_closed);
        let scene = Scene::new(self.system, &state, self.inputs, self.kinks, scales, &known);
        let mut strays = Strays { error: zero, known: number(f64::INFINITY) };
        for rows in self.beginning(&grown.regime).slips(&S::ROWS) {
            let [x, y] = rows.each(|row| entry(&scene.laws.rows.rates, row));
            let slip = x.hypot(y);
            let along = |rate: &dyn Fn(usize) -> S::Scalar| (x * rate(rows[0]) + y * rate(rows[1])) / slip;
            let lacks = along(&|row| scene.rate(row, &found)) - along(&|row| entry(&end.rates, row));
            let noise = along(&|row| scene.rate(row, &disturbed) - scene.rate(row, &found)).abs();
            let speed = scene.scale_of(rows);
            let ulps = number(LAUNCHED) * S::Scalar::epsilon();
            // Roundings of the accelerations are no error that a shorter time could mend, nor are those of
            // the velocities, which turn a slow slip: friction turns it back at once. What grows like t³ is a
            // quarter of its end in the mean.
            let strength = entry(&end.sizes, rows[0]);
            let lacks = most(lacks.abs() - noise - rounding::<S::Scalar>() * strength, zero);
            let error = number(0.25) * grown.later * lacks;
            // Numbers alone: times that follow from them have no variation.
            let error = error / (most(scales.relative, ulps) * speed);
            let [lacks, whole] = self.all_stray(rows, [&beside, &grown.way.accelerations], &state.v);
            let [noise, _] = self.all_stray(rows, [&disturbed, &found], &state.v);
            let lacks = most(lacks - noise - rounding::<S::Scalar>() * strength, zero);
            // A body that was at rest has the velocity that forces could give it.
            let whole = most(scales.relative, ulps) * most(whole, grown.later * strength);
            let all = number(0.25) * grown.later * lacks / whole;
            strays.error = most(strays.error, most(error.part(0), all.part(0)));
            let known = slip / most(number(LAUNCHED) * ulps * speed, self.hidden_slip(strength));
            let known = known.part(0);
            strays.known = if above(strays.known, known) { known } else { strays.known };
        }
        strays.error.is_finite().then_some(strays)
    }

    /// A state with velocities that are as wrong as they may be, each in another direction than the one
    /// before.
    fn disturbed(state: &State<S::Scalar, N>) -> State<S::Scalar, N> {
        let mut error = S::Scalar::from_f64(LAUNCHED) * S::Scalar::epsilon();
        let mut disturbed = *state;
        for v in &mut disturbed.v {
            *v += error * *v;
            error = -error;
        }
        disturbed
    }

    /// The sizes of the difference of two accelerations and of the velocities `v`, as those of the largest
    /// slip that such a motion could make \[slip/s, slip]. Beside the slip the whole motion may turn while
    /// the load grows: a ball that spins carries its load round.
    fn all_stray(
        &self,
        rows: [usize; 2],
        [one, other]: [&[S::Scalar; N]; 2],
        v: &[S::Scalar; N],
    ) -> [S::Scalar; 2] {
        let zero: S::Scalar = num_traits::Zero::zero();
        let size = |number: &dyn Fn(usize) -> S::Scalar| {
            (0..N).fold(zero, |sum, i| sum + number(i) * number(i)).sqrt()
        };
        // In units in which no coordinate is larger than another.
        let unit = |i: usize| entry(&self.units, i);
        let level = |i: usize, number: S::Scalar| if unit(i).is_positive() { number / unit(i) } else { zero };
        let gradients = rows.each(|row| self.gradients.get(row));
        let slope = gradients
            .into_iter()
            .flatten()
            .fold(zero, |slope, gradient| most(slope, size(&|i| entry(gradient, i) * unit(i))));
        let lacks = size(&|i| level(i, entry(one, i) - entry(other, i)));
        [slope * lacks, slope * size(&|i| level(i, entry(v, i)))]
    }
}
