//! Contacts and frictions that share a load: feet that stick, on which the load is spread in more than one
//! way.
//!
//! The guards of such frictions are those of the shortest reactions. Where one of these reaches its limit,
//! others may bear more, and the feet go on to stick as long as any shares of the load are possible. No
//! series follows that, so the step is searched for the place where the last possible shares are gone.

use super::super::Switching;
use super::super::course::Course;
use super::super::guards::{Guard, Guards, PLACES, Parts};
use super::super::known::Known;
use super::super::loose::may_share;
use super::super::scales::Scales;
use super::super::scene::{Scene, Sticking, above, rounding};
use super::super::turning::has_pairs;
use crate::linear::SaddlePoint;
use crate::motion::roots::{Fall, reach};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::state::State;

/// How often the part of the step is halved in which shares cease to be possible. Halving ends where places
/// have no number between them.
const HALVINGS: usize = 64;

/// The number of parts, of the way from one place to the next, on which the least values of guards are looked
/// for.
const LOOKS: usize = 8;

/// What shares may lack, in ulps of the furthest limit: roundings of the sums that they are made of.
const EXACTLY: f64 = 16.0;

/// How to tell whether shares are possible.
#[derive(Clone, Copy)]
enum Way {
    /// By their margin, to rounding.
    ByMargin,
    /// To rounding. Where limits hardly differ, some shares are not found.
    Exactly,
    /// As for the choice of a regime, which allows for the rounding errors of large forces.
    AsChosen,
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// Whether a guard is that of a reaction that may share a load.
    pub(in crate::switching) fn may_share(&self, guard: Guard) -> bool {
        matches!(guard, Guard::Row(row)
            if self.regime.active.get(row) == Some(&true) && may_share(&S::ROWS, row))
    }

    /// The frictions that stick and the contacts that bear, are watched and share a load.
    pub(in crate::switching) fn sharing(&self) -> [bool; C] {
        let sharing: [bool; C] = array(|row| self.has(Guard::Row(row)) && self.may_share(Guard::Row(row)));
        if !sharing.contains(&true) {
            return sharing;
        }
        let State { t, q, v } = self.start;
        let equations = S::equations_in(self.in_regime, *t, q, v, self.inputs);
        if equations.is_none_or(|found| found.saddle.is_independent()) {
            return [false; C];
        }
        let shared = self.scene(self.start).shared(self.regime);
        array(|row| sharing[row] && shared[row])
    }

    /// Those that do on all of a step: feet that slip share a load only while their slips have one direction.
    pub(super) fn sharing_along(&self, course: &Course<'_, S::Scalar, N>) -> [bool; C] {
        let zero: S::Scalar = num_traits::Zero::zero();
        let sharing = self.sharing();
        let slides = Scene::<S, N, K, C, W>::slides(|row| self.regime.slip.get(row) != Some(&zero));
        if !const { has_pairs(&S::ROWS) } || !slides || !sharing.contains(&true) {
            return sharing;
        }
        let shared = self.scene(&course.at(self.start, num_traits::One::one())[0]).shared(self.regime);
        array(|row| sharing[row] && shared[row])
    }

    /// The part of the step on which the series of all reactions converge. There a load has no more turns
    /// than a search sees.
    pub(super) fn followed(&self, course: &Course<'_, S::Scalar, N>) -> S::Scalar {
        let reaches = (0..C).filter_map(|row| {
            let curve =
                course.curve_of_reaction(row, C).filter(|_| self.regime.active.get(row) == Some(&true))?;
            Some(reach(&curve, course.order().saturating_sub(1), course.left.sqrt()))
        });
        reaches.fold(num_traits::One::one(), smaller)
    }

    /// Where the last possible shares are gone before a part of the step, as far as some places of it show.
    /// `None` if some are possible on all of it, and its start if none are possible right behind that.
    #[cold]
    pub(super) fn shared(
        &self,
        course: &Course<'_, S::Scalar, N>,
        until: S::Scalar,
        start: &Parts<S::Scalar, C, W>,
    ) -> Option<Fall<S::Scalar>> {
        let number = S::Scalar::from_f64;
        let zero: S::Scalar = num_traits::Zero::zero();
        // Cones of friction leave thin sets of shares before the last ones are gone. Without them, and where
        // a regime begins at its limit, the choice knows, which has allowed for rounding errors.
        let has_cones = const { has_pairs(&S::ROWS) };
        let is_within = has_cones && self.holds(self.start, Way::ByMargin);
        let way = if is_within { Way::ByMargin } else { Way::AsChosen };
        let holds = |place: S::Scalar| self.holds(&course.at(self.start, place)[0], way);
        let mut low = zero;
        let between = |low: S::Scalar, high: S::Scalar| {
            let [low, high] = halved(low, high, holds);
            if has_cones {
                return Fall { place: low, fallen: high };
            }
            // What the choice allows for is gone: back to where shares are possible without that.
            let exactly = |place: S::Scalar| self.holds(&course.at(self.start, place)[0], Way::Exactly);
            let mut back = S::Scalar::epsilon() * until;
            while low > back && !exactly(low - back) {
                back = back + back;
            }
            let place = if low > back { halved(low - back, low, exactly)[0] } else { low };
            Fall { place, fallen: high }
        };
        for part in PLACES {
            let place = number(part) * until;
            // A load may be too large for a moment between two places. There the shortest reactions exceed
            // their limits most.
            let mut first: Option<S::Scalar> = None;
            self.exceeded(course, start, [low, place], |most| {
                if first.is_none_or(|first| most < first) && !holds(most) {
                    first = Some(most);
                }
            });
            match first {
                Some(exceeded) => return Some(between(low, exceeded)),
                None if holds(place) => low = place,
                None => return Some(between(low, place)),
            }
        }
        None
    }

    /// Visits the places between two of a step at which the guards of the shortest reactions of rows that
    /// share a load are least, and below zero.
    fn exceeded(
        &self,
        course: &Course<'_, S::Scalar, N>,
        start: &Parts<S::Scalar, C, W>,
        [from, to]: [S::Scalar; 2],
        mut visit: impl FnMut(S::Scalar),
    ) {
        let part = S::Scalar::from_f64(1.0 / LOOKS as f64);
        let apart = (to - from) * part;
        for guard in self.all().filter(|&guard| self.may_share(guard)) {
            for direction in self.directions_of(guard) {
                let Some(curve) = self.curve(guard, direction, course, start) else { continue };
                let at = |look: usize| from + S::Scalar::from_f64(look as f64) * apart;
                // On a short part the values at all places may differ by rounding errors alone.
                let noise = rounding::<S::Scalar>() * curve.on(from, to - from).extent();
                for look in 1..LOOKS {
                    let [before, here, after] = [look - 1, look, look + 1].map(|look| curve.at(at(look)));
                    let is_least = here <= before && here <= after;
                    if here >= num_traits::Zero::zero()
                        || !is_least
                        || !above(larger(before, after) - here, noise)
                    {
                        continue;
                    }
                    // The vertex of the parabola through the three.
                    let bend = (before - here) + (after - here);
                    let shift = S::Scalar::from_f64(0.5) * (before - after) / bend;
                    let is_inside = shift.is_finite() && shift.abs() <= num_traits::One::one();
                    visit(if is_inside { at(look) + shift * apart } else { at(look) });
                }
            }
        }
    }

    /// A state of the step, with contacts closed as in the regime.
    pub(super) fn scene<'s>(&'s self, state: &State<S::Scalar, N>) -> Scene<'s, S, N, K, C, W> {
        let known = Known::settled(self.regime.active);
        Scene::new(self.system, state, self.inputs, self.regime.kinks, &Scales::new(), &known)
    }

    /// Whether reactions are possible with which all goes on at a state as it does in the regime.
    fn holds(&self, state: &State<S::Scalar, N>, way: Way) -> bool {
        let scene = self.scene(state);
        let Some((balance, _)) = scene.balance(self.regime, &state.v) else { return false };
        let drags = scene.drags(self.regime, &state.v);
        match way {
            Way::ByMargin => scene.can_share(self.regime, &drags, &balance.multipliers),
            Way::Exactly | Way::AsChosen => {
                let exactly = S::Scalar::from_f64(EXACTLY) * S::Scalar::epsilon();
                let allowed = if matches!(way, Way::Exactly) { exactly } else { rounding() };
                let (known, sticking) = (&balance.multipliers, Sticking::ByForces);
                scene.shortest_within(allowed, self.regime, &drags, known, sticking).is_some()
            }
        }
    }
}

/// The place up to which something holds between one at which it does and one at which it does not, and the
/// next one.
pub(super) fn halved<R: Ordered>(mut low: R, mut high: R, holds: impl Fn(R) -> bool) -> [R; 2] {
    for _ in 0..HALVINGS {
        let middle = R::from_f64(0.5) * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    [low, high]
}
