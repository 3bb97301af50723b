//! Where a step passes narrow functions that its series does not show.
//!
//! A wall exp(−x/w), a bump exp(−(x/w)²) or a step tanh(x/w) can underflow, or vanish beside other terms, a
//! few of its widths away. What it is a function of does not: x/w is a smooth function along the step. So the
//! narrow function lies where its argument passes zero, or is largest or smallest, and its width is the time
//! in which the argument changes by one. A power, such as (x² + ε²)^(−3/2) or cos⁴⁰t, is narrow where its
//! base is smallest or largest, and its width is the time in which it changes by a factor of about e. A root
//! or a pole has its kink where its base vanishes. Places tell little of a function of an angle that turns
//! about between them, so a step turns angles no further than they can follow.

mod part;

use core::cell::Cell;

use self::part::Part;
use crate::number::elements::{Each, array};
use crate::number::real::{Real, any};
use crate::system::System;
use crate::system::control::Control;
use crate::system::hidden::Hidden;
use crate::system::state::State;

/// The number of places of a step at which arguments are looked at, and a series is compared with the
/// equations. The last one is the end of the step.
pub(crate) const PLACES: usize = 7;

/// The most halvings of a step on which an argument varies too fast for the places.
const HALVINGS: usize = 5;

/// The third difference of an argument at places, as a part of its range, up to which they show its course: a
/// sine has six of them in its period then.
pub(super) const SMOOTH: f64 = 0.5;

/// The most radians of an angle between two places. A function of its sine and cosine of up to degree three
/// has more than two places in its period then.
const RESOLVED: f64 = 1.0;

/// Places between the others, in times between these: an argument that varies faster may look smooth at
/// places that are evenly apart.
const BETWEEN: [f64; 3] = [1.382, 3.618, 5.236];

/// The places at which every argument is looked at: the start, those of the step, and the first one between.
pub(crate) const SAMPLES: usize = PLACES + 2;

/// The same, in times between places.
pub(crate) fn sample(index: usize) -> f64 {
    if index > PLACES { BETWEEN[0] } else { index as f64 }
}

/// Functions that can hide from a step.
pub(crate) trait Hiding<R, const N: usize> {
    /// Visits what they depend on, at each of these states.
    fn along<const PLACES: usize>(
        &self,
        states: &[State<R, N>; PLACES],
        visit: impl FnMut(Hidden, [R; PLACES]),
    );
}

/// Those in the equations of a system under control.
pub(crate) struct InEquations<'a, S, C, const K: usize> {
    pub system: &'a S,
    pub control: &'a C,
    /// Whether roots count, and angles.
    pub roots: bool,
}

impl<S, C, const N: usize, const K: usize> Hiding<S::Scalar, N> for InEquations<'_, S, C, K>
where
    S: System<N, K>,
    C: Control<S::Scalar, N, K>,
{
    fn along<const PLACES: usize>(
        &self,
        states: &[State<S::Scalar, N>; PLACES],
        mut visit: impl FnMut(Hidden, [S::Scalar; PLACES]),
    ) {
        let inputs = states.each(|state| self.control.inputs(&state));
        self.system.hidden_along(states, &inputs, |kind, values| {
            if self.roots || !matches!(kind, Hidden::Root | Hidden::Angle) {
                visit(kind, values);
            }
        });
    }
}

/// A step, and the functions that may hide in it.
pub(crate) struct Passage<'a, H, R, P> {
    pub hiding: &'a H,
    /// The state a part of the step after its start.
    pub state_at: &'a P,
    /// The length of the step.
    pub theta: R,
}

/// The states of a step from a function that keeps what it has made of it, as the polynomial of a method. A
/// state that is not known is NaN.
pub(crate) fn states_of<R: Real, const N: usize>(
    at: impl FnMut(R) -> Option<State<R, N>>,
) -> impl Fn(R) -> State<R, N> {
    let at = Cell::new(Some(at));
    move |part| {
        let nan = R::from_f64(f64::NAN);
        let mut own = at.take();
        let state = own.as_mut().and_then(|own| own(part));
        at.set(own);
        state.unwrap_or(State { t: nan, q: [nan; N], v: [nan; N] })
    }
}

/// What a function that may hide depends on.
struct Argument<'a, V> {
    kind: Hidden,
    /// Its value at any part of the step.
    value_at: &'a V,
}

impl<H, R: Real, P> Passage<'_, H, R, P> {
    /// Looks where functions may hide between places, and gives the lanes that disagree or in which an angle
    /// turns about. Lanes without such a function look at the end of the step.
    pub(crate) fn search<const N: usize>(&self, look: impl FnMut(R) -> R) -> R
    where
        H: Hiding<R, N>,
        P: Fn(R) -> State<R, N>,
    {
        let apart = self.theta * R::from_f64(1.0 / PLACES as f64);
        self.look(&array(|index| (self.state_at)(R::from_f64(sample(index)) * apart)), look)
    }

    /// The same with the states at these places.
    pub(crate) fn look<const N: usize>(
        &self,
        states: &[State<R, N>; SAMPLES],
        mut look: impl FnMut(R) -> R,
    ) -> R
    where
        H: Hiding<R, N>,
        P: Fn(R) -> State<R, N>,
    {
        let (mut faults, mut index) = (R::zero(), 0);
        self.hiding.along(states, |kind, values| {
            if kind == Hidden::Angle {
                if let Some((evenly, _)) = values.split_first_chunk::<{ PLACES + 1 }>() {
                    faults = faults.max(turns_about(evenly));
                }
                return;
            }
            let value_at = |theta| {
                let (mut found, mut other) = (R::zero(), 0);
                self.hiding.along(&[(self.state_at)(theta)], |_, [value]| {
                    if other == index {
                        found = value.part(0);
                    }
                    other += 1;
                });
                found
            };
            let argument = Argument { kind, value_at: &value_at };
            let values = values.map(|value| value.part(0));
            // Where a base is zero, the derivatives of a root in its width are no numbers.
            argument.places(values, self.theta, &mut |theta| faults = faults.max(look(theta.part(0))));
            index += 1;
        });
        faults
    }
}

impl<V> Argument<'_, V> {
    /// Visits the places at which the function is largest or steepest, if they lie between those of the step,
    /// at which its argument has these values. Where it varies too fast for them, in parts of the step.
    fn places<R: Real>(&self, values: [R; SAMPLES], end: R, visit: &mut impl FnMut(R))
    where
        V: Fn(R) -> R,
    {
        let part = |apart: R, number: usize| {
            let from = apart * R::from_f64((number * PLACES) as f64);
            let place = |index: usize| from + apart * R::from_f64(sample(index));
            Part { of: self, from, apart, values: array(|k| (self.value_at)(place(k))), end }
        };
        let mut apart = end * R::from_f64(1.0 / PLACES as f64);
        let whole = Part { of: self, from: R::zero(), apart, values, end };
        let [range, unit] = whole.range();
        if !any(range - unit) {
            return;
        }
        if whole.is_smooth([range, unit]) {
            whole.places(unit, visit);
            return;
        }
        let mut parts = 1;
        for halving in 1..=HALVINGS {
            (apart, parts) = (apart * R::from_f64(0.5), 2 * parts);
            let is_last = halving == HALVINGS;
            let is_smooth = |part: Part<'_, R, V>| part.is_smooth(part.range());
            if is_last || (0..parts).all(|number| is_smooth(part(apart, number))) {
                for part in (0..parts).map(|number| part(apart, number)) {
                    part.places(part.range()[1], visit);
                }
                return;
            }
        }
    }
}

/// The range of what a function depends on, and the least change of it that makes a difference.
pub(crate) fn range<R: Real, const LENGTH: usize>(kind: Hidden, values: &[R; LENGTH]) -> [R; 2] {
    let first = values[0];
    let (mut low, mut high, mut least) = (first, first, first.abs());
    for &value in values {
        (low, high, least) = (low.min(value), high.max(value), least.min(value.abs()));
    }
    let unit = kind.power::<R>().map_or(R::one(), |power| least / power);
    [high - low, unit]
}

/// The lanes in which an angle turns further between two neighbouring places than these can follow a function
/// of it.
pub(super) fn turns_about<R: Real>(angles: &[R]) -> R {
    let most = angles.windows(2).fold(R::zero(), |most, pair| match *pair {
        [before, after] => most.max((after - before).part(0).abs()),
        _ => most,
    });
    (most - R::from_f64(RESOLVED)).max(R::zero())
}

#[cfg(test)]
mod tests;
