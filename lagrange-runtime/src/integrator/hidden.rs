//! Where a step passes narrow functions that its series does not show.
//!
//! A wall exp(−x/w), a bump exp(−(x/w)²) or a step tanh(x/w) can underflow, or vanish beside other terms, a
//! few of its widths away. What it is a function of does not: x/w is a smooth function along the step. So the
//! narrow function lies where its argument passes zero, or is largest or smallest, and its width is the time
//! in which the argument changes by one. A power, such as (x² + ε²)^(−3/2) or cos⁴⁰t, is narrow where its
//! base is smallest or largest, and its width is the time in which it changes by a factor of about e. A root
//! or a pole has its kink where its base vanishes.

use core::cell::Cell;

use crate::number::elements::{Each, array};
use crate::number::real::{Real, any};
use crate::system::System;
use crate::system::control::Control;
use crate::system::hidden::Hidden;
use crate::system::state::State;

/// The number of places of a step at which arguments are looked at, and a series is compared with the
/// equations. The last one is the end of the step.
pub(crate) const PLACES: usize = 7;

/// The most steps of the search for a place. Every third one halves the bracket of its zero.
const STEPS: usize = 159;

/// How near, as a part of the width of the function, a place is found.
const NEAR: f64 = 0.25;

/// The most halvings of a step on which an argument varies too fast for the places.
const HALVINGS: usize = 5;

/// The third difference of an argument at places, as a part of its range, up to which they show its course: a
/// sine has six of them in its period then.
pub(super) const SMOOTH: f64 = 0.5;

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
    /// Whether roots count.
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
            if self.roots || kind != Hidden::Root {
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

/// The same on a part of the step.
struct Part<'a, R, V> {
    of: &'a Argument<'a, V>,
    /// Where it begins, and the time between two places.
    from: R,
    apart: R,
    /// The values at its samples.
    values: [R; SAMPLES],
    /// The end of the step.
    end: R,
}

impl<H, R: Real, P> Passage<'_, H, R, P> {
    /// Looks where functions may hide between places, and gives the lanes that disagree. Lanes without such a
    /// function look at the end of the step.
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
            argument.places(values, self.theta, &mut |theta| faults = faults.max(look(theta)));
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

impl<R: Real, V: Fn(R) -> R> Part<'_, R, V> {
    fn range(&self) -> [R; 2] {
        range(self.of.kind, &self.values)
    }

    /// Whether the places show the course of an argument of this range.
    fn is_smooth(&self, [range, unit]: [R; 2]) -> bool {
        let bound = (R::from_f64(SMOOTH) * range).max(unit);
        let exceeds = |number: R, bound: R| any(number.abs() - bound);
        let differ = |values: &[R]| match *values {
            [a, b, c, d] => exceeds((d - a) - R::from_f64(3.0) * (c - b), bound),
            _ => false,
        };
        let (places, between) = self.values.split_at(PLACES + 1);
        let strays = |(index, at): (usize, f64)| {
            let place = self.from + R::from_f64(at) * self.apart;
            let value = between.get(index).copied().unwrap_or_else(|| (self.of.value_at)(place));
            let cubic = places.get(at as usize - 1..).map_or(value, |around| cubic(around, at % 1.0));
            exceeds(value - cubic, bound * R::from_f64(0.5))
        };
        !places.windows(4).any(differ) && !BETWEEN.into_iter().enumerate().any(strays)
    }

    fn at(&self, place: usize) -> (R, R) {
        let value = self.values.get(place).copied().unwrap_or_else(R::zero);
        (self.from + R::from_f64(place as f64) * self.apart, value)
    }

    /// Visits the places at which the function is largest or steepest. `unit` is the least change of the
    /// argument that makes a difference.
    fn places(&self, unit: R, visit: &mut impl FnMut(R)) {
        for place in 1..PLACES + 1 {
            self.crossings(self.at(place - 1), self.at(place), visit);
        }
        for place in 1..PLACES {
            let middle = self.at(place);
            let Some((vertex, width)) = self.vertex(place, unit) else { continue };
            for beside in [R::zero(), -width, width] {
                visit((vertex + beside).max(R::zero()).min(self.end));
            }
            // An argument that passes zero and comes back.
            let turned = (vertex, (self.of.value_at)(vertex));
            if any(-(turned.1 * middle.1)) {
                self.crossings(self.at(place - 1), turned, visit);
                self.crossings(turned, self.at(place + 1), visit);
            }
        }
    }

    /// Visits the places at which an argument passes one and minus one, and those on both sides of the zero
    /// of a root.
    fn crossings(&self, from: (R, R), to: (R, R), visit: &mut impl FnMut(R)) {
        let (zero, one) = (R::zero(), R::one());
        match self.of.kind {
            Hidden::Argument => {}
            Hidden::Base(_) => return,
            Hidden::Root => {
                let passes = -(from.1 * to.1);
                if any(passes) {
                    for beside in self.around(zero, from, to, passes) {
                        visit(beside.where_positive(passes, self.end));
                    }
                }
                return;
            }
        }
        // Otherwise one of the places lies within the function.
        let wide = (from.1 - to.1).abs() - (one + one);
        if !any(wide) {
            return;
        }
        // Zero may be one of the two places. A force may be none there.
        for level in [-one, one] {
            let opposite = wide.min(-((from.1 - level) * (to.1 - level)));
            if any(opposite) {
                visit(self.reaching(level, from, to, opposite));
            }
        }
    }

    /// The place at which the argument has a value, in the lanes where `active` is positive; the end in the
    /// others.
    fn reaching(&self, level: R, from: (R, R), to: (R, R), active: R) -> R {
        let [_, theta] = self.around(level, from, to, active);
        theta.where_positive(active, self.end)
    }

    /// Places on both sides of the one at which the argument has a value, the second one nearest to it, in
    /// the lanes where `active` is positive. The Illinois variant of false position (M. Dowell, P. Jarratt,
    /// BIT 11, 1971), with halvings between its steps.
    fn around(&self, level: R, from: (R, R), to: (R, R), active: R) -> [R; 2] {
        let (one, half) = (R::one(), R::from_f64(0.5));
        let ((mut low, mut below), (mut high, mut above)) = ((from.0, from.1 - level), (to.0, to.1 - level));
        // A root has no width.
        let near = if self.of.kind == Hidden::Root { R::zero() } else { R::from_f64(NEAR) };
        for tried in 1..=STEPS {
            let apart = high - low;
            let part = if tried % 3 == 0 { half } else { above / (above - below) };
            let theta = (high - part * apart).where_positive(active, self.end);
            let value = (self.of.value_at)(theta) - level;
            let opposite = -(value * above);
            below = above.where_positive(opposite, below * half);
            low = high.where_positive(opposite, low);
            (high, above) = (theta, value);
            let resolved = R::epsilon() * self.end.abs() - (high - low).abs();
            if (near - value.abs()).max(resolved).where_positive(active, one).is_positive() {
                break;
            }
        }
        [low, high]
    }

    /// Where the argument is largest or smallest near a place, and the width of the function there; `None`
    /// where that is not narrower than the places are apart. The end and zero in lanes of which this is true.
    fn vertex(&self, place: usize, unit: R) -> Option<(R, R)> {
        let (zero, one, half) = (R::zero(), R::one(), R::from_f64(0.5));
        let [before, (middle, value), after] = [self.at(place - 1), self.at(place), self.at(place + 1)];
        let (slope, bend) = Self::parabola(before.1, value, after.1);
        if !any(bend.abs() - (unit + unit)) {
            return None;
        }
        let shift = -(slope / bend);
        // A parabola does not place its vertex exactly. So the nearest places share one, and one at an end
        // may seem to lie beyond.
        let reach = |is_outermost| R::from_f64(if is_outermost { 2.0 } else { 0.75 });
        let inside = (shift + reach(place == 1)).min(reach(place + 1 == PLACES) - shift);
        let active = inside.min(one - self.width(value, slope * shift, bend));
        if !any(active) {
            return None;
        }
        let (mut vertex, mut width, mut step) = (middle + shift * self.apart, zero, half * self.apart);
        for tried in 0..STEPS {
            let at = vertex.where_positive(active, self.end);
            let (centre, left, right) = ((self.of.value_at)(at), at - step, at + step);
            let (slope, bend) = Self::parabola((self.of.value_at)(left), centre, (self.of.value_at)(right));
            let shift = (-(slope / bend)).max(-one).min(one);
            width = self.width(centre, slope * shift, bend) * step;
            vertex = at + shift * step;
            let near = R::from_f64(NEAR) * width - (shift * step).abs();
            // Two parabolas of like length may be wrong alike. A shorter one tells.
            if tried > 0 && near.where_positive(active, one).is_positive() {
                break;
            }
            step = (step * R::from_f64(0.125)).max(width);
            // A root that touches zero has no width.
            if !any(step - R::epsilon() * self.end.abs()) {
                break;
            }
        }
        Some((vertex.where_positive(active, self.end), width.where_positive(active, zero)))
    }

    /// Slope and second derivative of a parabola at the second of three places that are one apart.
    fn parabola(before: R, value: R, after: R) -> (R, R) {
        (R::from_f64(0.5) * (after - before), (after - value) - (value - before))
    }

    /// The time in which an argument with this second derivative changes by one, or a power by a factor. The
    /// parabola falls by half of `change` from the value to its vertex.
    fn width(&self, value: R, change: R, bend: R) -> R {
        let unit = self.of.kind.power::<R>().map_or(R::one(), |power| {
            // Far from the vertex the parabola is no good measure of a small value there.
            value.abs().min((value + R::from_f64(0.5) * change).abs()) / power
        });
        ((unit + unit) / bend.abs()).sqrt()
    }
}

/// The cubic polynomial through four values at places that are one apart, a part of the way from the second
/// to the third.
fn cubic<R: Real>(values: &[R], part: f64) -> R {
    let weights = [
        -part * (part - 1.0) * (part - 2.0) / 6.0,
        (part + 1.0) * (part - 1.0) * (part - 2.0) / 2.0,
        -(part + 1.0) * part * (part - 2.0) / 2.0,
        (part + 1.0) * part * (part - 1.0) / 6.0,
    ];
    values.iter().zip(weights).fold(R::zero(), |sum, (&value, weight)| sum + R::from_f64(weight) * value)
}

#[cfg(test)]
mod tests;
