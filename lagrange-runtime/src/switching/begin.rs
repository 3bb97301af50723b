//! The regime where a motion begins, or where it goes on from a state that is not its own.

use super::kinks::{followed, sides};
use super::known::Known;
use super::run::Run;
use super::scene::{Scene, above, entry, extent, most, rounding};
use super::sided::turn_ahead;
use super::valid::valid;
use super::{Coefficients, Laws, Regime, Row, Switching};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::error::magnitude;
use crate::system::method::Adaptive;
use crate::system::name::Name;
use crate::system::state::State;

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// Finds the regime where the motion begins, or goes on from a state that is not its own.
    pub(super) fn open(&mut self) -> Result<(), Cause> {
        let mut state = self.memory.end;
        if !state.is_finite() {
            return Err(Cause::NotFinite);
        }
        let laws = self.system.laws_at(state.t, &state.q, &state.v, &self.control.0);
        let mut present = self.memory.regime;
        present.kinks = sides(&laws.kinks, &present.kinks, &laws.kink_sizes);
        // Constraints that always hold must hold at the start as well.
        let alone = Regime { kinks: present.kinks, ..Regime::open(&S::ROWS) };
        let in_regime = self.system.in_regime(&alone);
        self.check(&laws, &{
            let State { t, q, v } = &state;
            S::coefficients_in(&in_regime, *t, q, v, &self.control.0, &laws)
        })?;
        if S::InRegime::CONSTRAINED && S::ROWS.contains(&Row::Bilateral) {
            in_regime.begin_at(&in_regime.constants(), &mut state)?;
        } else {
            let State { t, q, v } = &state;
            in_regime.check_at(&in_regime.constants(), *t, q, v).map_err(|cause| cause.named(&S::NAMES))?;
        }
        let closed = self.penetrating(&state, &laws)?;
        let known = Known::new(closed);
        let begun = state;
        let mut regime = self.settle(&mut state, present, known, num_traits::Zero::zero())?;
        if const { C > 0 && W > 0 } {
            // On a kink the motion begins on the side that it goes to. It would spend no time on the other.
            let side = |side: S::Scalar| sides(&laws.kinks, &[side; W], &laws.kink_sizes);
            let (one, a) = (<S::Scalar as num_traits::One>::one(), &self.memory.way.accelerations);
            let (above, below) = (side(one), side(-one));
            let lies = array(|kink| above[kink] != below[kink]);
            let there = State { v: state.v, ..begun };
            let (before, inputs) = (present.kinks, &self.control.0);
            if turn_ahead(self.system, &there, a, inputs, &lies, &mut present.kinks) {
                present.kinks = followed(self.system, &there, inputs, &before, &present.kinks);
                state = begun;
                regime = self.settle(&mut state, present, known, num_traits::Zero::zero())?;
            }
        }
        if S::Scalar::PARTS > 1
            && let Some(row) =
                self.memory.impulses.iter().position(|impulse| *impulse != num_traits::Zero::zero())
        {
            return Err(Cause::SwitchesCoincide { name: S::NAMES.constraint(row), other: Name::NONE });
        }
        self.go_on(regime, state);
        self.memory.fired = None;
        let counts = &mut self.memory.counts;
        counts.evaluations += 1;
        self.memory.is_fresh = false;
        Ok(())
    }

    /// Goes on from the present state, or from one a little later, in a regime.
    pub(super) fn go_on(&mut self, regime: Regime<S::Scalar, C, W>, state: State<S::Scalar, N>) {
        if state.t == self.memory.end.t {
            self.enter(regime, state);
        } else {
            (self.memory.start, self.memory.next) = (self.memory.end, Some((regime, state)));
        }
    }

    /// Checks that the coefficients of restitution and friction are valid, and that gaps, rates and switching
    /// functions are finite.
    fn check(
        &self,
        laws: &Laws<S::Scalar, C, W>,
        coefficients: &[Coefficients<S::Scalar, C>; 2],
    ) -> Result<(), Cause> {
        valid::<S, N, K, C, W>(laws, coefficients, &[num_traits::Zero::zero(); C], |_| true)?;
        if !laws.rows.positions.iter().chain(&laws.kinks).copied().all(Real::is_finite) {
            return Err(Cause::NotFinite);
        }
        // Where a function has a value but no rate, it has no gradient: the distance from a centre, for
        // example, has none at the centre.
        match laws.rows.rates.iter().position(|rate| !rate.is_finite()) {
            Some(row) => Err(Cause::VanishingGradient { constraint: row, name: S::NAMES.constraint(row) }),
            None => Ok(()),
        }
    }

    /// The cause of an error where the gap of an open contact is negative by more than a start may penetrate.
    pub(super) fn missed(&self, laws: &Laws<S::Scalar, C, W>) -> Option<Cause> {
        let share = S::Scalar::from_f64(1.0 / 16.0) * S::Scalar::epsilon().sqrt();
        (0..C).find_map(|row| {
            let gap = laws.rows.positions[row];
            let size = most(laws.rows.position_sizes[row], self.memory.scales.gaps[row]);
            let is_open = S::ROWS[row] == Row::Unilateral && !self.memory.regime.active[row];
            (is_open && above(-gap, share * size)).then(|| Cause::Penetrates {
                constraint: row,
                name: S::NAMES.constraint(row),
                by: magnitude(-gap),
            })
        })
    }

    /// Refuses a start that penetrates by more than √ε/16 of the size of the gap, which for `f64` is the last
    /// digit of a number with nine. Returns the contacts that penetrate by less: they count as closed.
    fn penetrating(
        &self,
        state: &State<S::Scalar, N>,
        laws: &Laws<S::Scalar, C, W>,
    ) -> Result<[bool; C], Cause> {
        let mut closed = [false; C];
        let is_below = |row: usize| {
            S::ROWS[row] == Row::Unilateral
                && above(num_traits::Zero::zero(), entry(&laws.rows.positions, row))
        };
        if !(0..C).any(is_below) {
            return Ok(closed);
        }
        let share = S::Scalar::from_f64(1.0 / 16.0) * S::Scalar::epsilon().sqrt();
        let known = Known::settled([false; C]);
        let scene = Scene::new(
            self.system,
            state,
            &self.control.0,
            self.memory.regime.kinks,
            &self.memory.scales,
            &known,
        );
        for row in (0..C).filter(|&row| is_below(row)) {
            let gap = laws.rows.positions[row];
            let by_state = extent(&scene.gradients[row], &state.q);
            let size = most(most(laws.rows.position_sizes[row], self.memory.scales.gaps[row]), by_state);
            // The size of a gap that is one coordinate is the gap itself. Then the other coordinates tell
            // what is small.
            let most_of = state.q.iter().fold(num_traits::Zero::zero(), |size, &q| most(size, q.abs()));
            let own = laws.rows.position_sizes[row] == -gap;
            let size = if own { most(self.memory.scales.gaps[row], most_of + gap) } else { size };
            // Where all that makes the gap is as small, it is zero beside the other coordinates.
            let one: S::Scalar = num_traits::One::one();
            let beside = rounding::<S::Scalar>() * most_of * extent(&scene.gradients[row], &[one; N]);
            // The time of a state of another motion is rounded.
            if above(-gap, share * size + scene.by_time(row)) && above(laws.rows.position_sizes[row], beside)
            {
                return Err(Cause::Penetrates {
                    constraint: row,
                    name: S::NAMES.constraint(row),
                    by: magnitude(-gap),
                });
            }
            closed[row] = true;
        }
        Ok(closed)
    }
}
