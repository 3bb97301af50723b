//! Reactions that narrow loads take out of their limits inside a step.
//!
//! What friction or a contact holds has no acceleration that could disagree with the equations, whatever load
//! comes: a pulse on a block that sticks, or one that lifts a body off the ground, may lie between the places
//! that a series or samples of a reaction see. What such loads depend on shows where they are narrow
//! ([`hidden`](crate::integrator::hidden)). There, and at the end of the step, the equations are asked for
//! reactions. Where a guard is much smaller than the step knows, the piece ends on the way. The next series
//! starts nearer, and knows more.

use super::course::Course;
use super::guards::{Guard, Guards, Parts};
use super::narrow::InGuards;
use super::scene::{entry, most};
use super::turning::{has_pairs, pairs};
use super::{Along, Functions, Switching};
use crate::integrator::hidden::{Hiding, InEquations, PLACES, Passage, SAMPLES, range, sample};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, any, smaller};
use crate::number::rounded::Rounded;
use crate::system::System;
use crate::system::control::Held;
use crate::system::state::State;

/// Safety factor on what one of the places of a step shows of a load that is wider than these are apart.
const WIDE: f64 = 2.0;

/// The same where a narrow load lies: a quarter of its width beside a place at which exp(−1) is left of a
/// Gaussian, and where tanh has made an eighth of its way.
const NARROW: f64 = 8.0;

/// Looks at the end of a step, and where functions vary on it, at all places of the step and where they may
/// hide between these. `look` is told the safety factor.
fn look_along<H: Hiding<R, N>, R: Real, const N: usize>(
    hiding: &H,
    state_at: &impl Fn(R) -> State<R, N>,
    look: &mut impl FnMut(R, f64),
) {
    let apart = R::from_f64(1.0 / PLACES as f64);
    let states: [State<R, N>; SAMPLES] = array(|index| state_at(R::from_f64(sample(index)) * apart));
    let mut varies = false;
    hiding.along(&states, |kind, values| {
        let [range, unit] = range(kind, &values.map(|value| value.part(0)));
        // What is not finite somewhere has no range.
        varies |= !any(unit - range);
    });
    if varies {
        for place in 1..PLACES {
            look(R::from_f64(place as f64) * apart, WIDE);
        }
        Passage { hiding, state_at, theta: R::one() }.look(&states, |part| {
            look(part, NARROW);
            R::zero()
        });
    }
    look(R::one(), WIDE);
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// Whether narrow functions can hide from reactions that guards are made of.
    pub(super) fn can_be_overloaded(&self) -> bool {
        (S::NARROW || S::InRegime::STEEP) && self.has_reactions()
    }

    /// The first part of a step at which a narrow load takes a guard of reactions below zero, without the
    /// step's knowing: its polynomials, or the values at both ends where these do not converge.
    #[inline(never)]
    pub(super) fn overloaded_inside(&self, course: &Course<'_, S::Scalar, N>) -> Option<(S::Scalar, Guard)> {
        let one: S::Scalar = num_traits::One::one();
        let state_at = |part| course.at(self.start, part)[0];
        let are_foreseen = self.are_foreseen(course);
        // At rest a step is no longer than the series of reactions converge as the motion does.
        let allowed = if are_foreseen && course.rests() { course.left } else { course.left.sqrt() };
        let (mut first, mut sharing, mut ends) = (None, None, None);
        let State { t, q, v } = self.start;
        let start = self.parts(|x| x, *t, [q, v]);
        let mut look = |part: S::Scalar, safety: f64| {
            let state = state_at(part);
            let there = self.guards_at(&state, &state);
            let expected = if are_foreseen {
                self.foreseen(course, &start, part)
            } else {
                *ends.get_or_insert_with(|| self.least_of_ends(&state_at(one)))
            };
            // Others may bear what one does not: then its own guard does not tell how much is left.
            let mut shares = |guard| match guard {
                Guard::Row(row) if self.may_share(guard) => {
                    sharing.get_or_insert_with(|| self.sharing()).get(row).copied().unwrap_or(false)
                }
                _ => false,
            };
            let turned = self.turned(&there);
            let fallen = self.all().filter(|&guard| self.is_of_reactions(guard)).find(|&guard| {
                let &Rounded { value, error } = there.get(guard);
                let (value, error) = (value.part(0), error.part(0));
                let expected = expected.get(guard).part(0);
                let lost = error + error / S::Scalar::epsilon() * (allowed + turned);
                let lacks = S::Scalar::from_f64(safety) * (expected - value);
                if shares(guard) { lacks > lost } else { smaller(value, expected - lacks) < -lost }
            });
            if let Some(guard) = fallen
                && first.is_none_or(|(other, _)| part < other)
            {
                first = Some((part, guard));
            }
        };
        if S::NARROW {
            let hiding: InGuards<'_, S, N, K, C, W> =
                InGuards { in_regime: self.in_regime, inputs: self.inputs };
            look_along(&hiding, &state_at, &mut look);
        }
        if S::InRegime::STEEP {
            let control = Held(*self.inputs);
            let hiding = InEquations { system: self.in_regime, control: &control, roots: false };
            look_along(&hiding, &state_at, &mut look);
        }
        first
    }

    /// The angle \[rad] by which rounding errors of a state may turn friction. A slip in two directions that
    /// is about to come to rest has a direction with few digits, and reactions have no more.
    fn turned(&self, guards: &Functions<Rounded<S::Scalar>, C, W>) -> S::Scalar {
        let zero: S::Scalar = num_traits::Zero::zero();
        if const { !has_pairs(&S::ROWS) } {
            return zero;
        }
        let slips = |row: usize| entry(&self.regime.slip, row) != zero;
        let mut angle = zero;
        for row in pairs(&S::ROWS).map(|[row, _]| row).filter(|&row| slips(row)) {
            if let Some(&Rounded { value, error }) = guards.rows.get(row) {
                angle = most(angle, error.part(0) / value.part(0).abs());
            }
        }
        angle
    }

    /// Whether guards of reactions have polynomials that converge on the whole of a step, to half of the
    /// digits of its tolerance.
    fn are_foreseen(&self, course: &Course<'_, S::Scalar, N>) -> bool {
        (0..C).filter(|&row| self.is_reaction(row)).all(|row| {
            let Some((start, gain)) = course.gain_of_reaction(row, C) else { return false };
            let is_known = [S::ALONG.fixed[row], S::BACKWARD[row]].iter().all(|&own| own != Along::Unknown);
            is_known && gain.last <= course.left.sqrt() * (start.abs() + gain.most)
        })
    }

    /// Guards of reactions after a part of a step, as its polynomials give them.
    fn foreseen(
        &self,
        course: &Course<'_, S::Scalar, N>,
        start: &Parts<S::Scalar, C, W>,
        part: S::Scalar,
    ) -> Functions<S::Scalar, C, W> {
        let reactions = array(|row| course.reaction_at(row, C, part));
        let along = |own: Along, start: S::Scalar| match own {
            Along::Series(index) => start + course.gain_of_function_at(index, S::FOLLOWED, part),
            Along::Constant | Along::Unknown => start,
        };
        let fixed = array(|row| along(S::ALONG.fixed[row], start.functions.fixed[row]));
        let backward = array(|row| along(S::BACKWARD[row], start.backward[row]));
        self.made(|x| x, Parts { functions: Functions { fixed, ..start.functions }, backward }, &reactions)
    }

    /// The guards of reactions at the start and at the end of the step, the smaller of each.
    fn least_of_ends(&self, end: &State<S::Scalar, N>) -> Functions<S::Scalar, C, W> {
        let [start, end] = [self.start, end].map(|state| self.guards_at(state, state));
        let least = |[start, end]: [Rounded<S::Scalar>; 2]| smaller(start.value, end.value);
        Functions {
            rows: array(|row| least([start.rows[row], end.rows[row]])),
            fixed: array(|row| least([start.fixed[row], end.fixed[row]])),
            kinks: array(|kink| least([start.kinks[kink], end.kinks[kink]])),
        }
    }
}
