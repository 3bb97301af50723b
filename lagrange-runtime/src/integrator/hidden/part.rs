//! A part of a step, at whose places the argument of a function that may hide is known: where the function is
//! largest or steepest.

use super::{Argument, BETWEEN, PLACES, SAMPLES, SMOOTH, range};
use crate::number::real::{Real, any};
use crate::system::hidden::Hidden;

/// The most steps of the search for a place. Every third one halves the bracket of its zero.
const STEPS: usize = 159;

/// How near, as a part of the width of the function, a place is found.
const NEAR: f64 = 0.25;

/// What a function that may hide depends on, on a part of a step.
pub(super) struct Part<'a, R, V> {
    pub of: &'a Argument<'a, V>,
    /// Where it begins, and the time between two places.
    pub from: R,
    pub apart: R,
    /// The values at its samples.
    pub values: [R; SAMPLES],
    /// The end of the step.
    pub end: R,
}

impl<R: Real, V: Fn(R) -> R> Part<'_, R, V> {
    pub fn range(&self) -> [R; 2] {
        range(self.of.kind, &self.values)
    }

    /// Whether the places show the course of an argument of this range.
    pub fn is_smooth(&self, [range, unit]: [R; 2]) -> bool {
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
    pub fn places(&self, unit: R, visit: &mut impl FnMut(R)) {
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
            Hidden::Base(_) | Hidden::Angle => return,
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
            // Zero itself counts as a value on the side of `above`, so that it stays in the bracket.
            let value = value.where_positive(value.abs(), value + R::epsilon() * above);
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
mod tests {
    use super::cubic;

    #[test]
    fn a_cubic_polynomial_is_its_own_interpolation() {
        let value = |x: f64| 1.0 - 2.0 * x + 3.0 * x * x - 0.5 * x * x * x;
        let values = [-1.0, 0.0, 1.0, 2.0].map(value);
        for part in [0.0, 0.2, 0.618, 1.0] {
            assert!((cubic(&values, part) - value(part)).abs() < 1e-14, "{part}");
        }
    }
}
