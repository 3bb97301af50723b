//! Steps on which a root, a logarithm or a denominator may vanish.
//!
//! The distance of two points that meet is |x|, but its series goes on as x. That of a pole goes on
//! behind it, too. Both happen where some function of the state vanishes ([`Hidden::Root`]), which a few
//! places of a step show well enough: steps on which none comes near zero, and no angle in them turns about
//! between places, need no further look.

use super::hidden::{Hiding, SMOOTH, turns_about};
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::hidden::Hidden;
use crate::system::state::State;

/// The places of a step, its ends included. The square of an oscillation turns by no more than a right angle
/// between two of them, on the longest steps that its series allows at coarse tolerances.
const PLACES: usize = 5;

/// The state after a part of a step, by the cubic polynomial through coordinates and velocities at both ends
/// (Hermite): near enough, and cheaper than a series.
fn between<R: Real, const N: usize>([start, end]: [&State<R, N>; 2], h: R, part: f64) -> State<R, N> {
    let number = R::from_f64;
    let (place, left) = (part * part * (3.0 - 2.0 * part), 1.0 - part);
    let (leave, arrive) = (part * left * left, -part * part * left);
    // Their derivatives.
    let (pace, leaves, arrives) = (6.0 * part * left, left * (1.0 - 3.0 * part), part * (3.0 * part - 2.0));
    let change = |i: usize| end.q[i] - start.q[i];
    State {
        t: start.t + h * number(part),
        q: array(|i| {
            let bent = number(leave) * start.v[i] + number(arrive) * end.v[i];
            start.q[i] + number(place) * change(i) + h * bent
        }),
        v: array(|i| {
            let bent = number(leaves) * start.v[i] + number(arrives) * end.v[i];
            number(pace) * change(i) / h + bent
        }),
    }
}

/// Whether a root comes near zero between three evenly spaced places with these values, or may: positive in
/// the lanes where it does.
fn dips<R: Real>([before, middle, after]: [R; 3]) -> R {
    let [quarter, half, two, beside] = [0.25, 0.5, 2.0, 1.5].map(R::from_f64);
    let same = (before * middle).min(middle * after);
    let changes = (-R::one()).where_positive(same, R::one());
    let [before, middle, after] = [before, middle, after].map(|value| value.where_positive(middle, -value));
    let (slope, bend) = (half * (after - before), (after - middle) - (middle - before));
    // The vertex of the parabola through them, where it lies between them or beside. Up to a part of their
    // range the function may be another one.
    let inside = (beside - (slope / bend).abs()).min(bend);
    let lowest = middle - slope * slope / (two * bend);
    let (least, most) = (before.min(middle).min(after), before.max(middle).max(after));
    let falls = quarter * quarter * most - least;
    changes.max(falls).max((half * least + quarter * (most - least) - lowest).min(inside))
}

/// The lanes of a step of `h` \[s] between two states in which a root comes near zero, or may: positive
/// there.
pub(crate) fn near_roots<R: Real, const N: usize>(
    hiding: &impl Hiding<R, N>,
    [start, end]: [&State<R, N>; 2],
    h: R,
) -> R {
    let mut near = -R::one();
    let states: [_; PLACES] = array(|place| match place {
        0 => *start,
        _ if place + 1 == PLACES => *end,
        _ => between([start, end], h, place as f64 / (PLACES - 1) as f64),
    });
    hiding.along(&states, |kind, values| {
        let values = values.map(|value| value.part(0));
        match kind {
            Hidden::Root => {}
            Hidden::Angle => {
                near = near.max(turns_about(&values));
                return;
            }
            Hidden::Argument | Hidden::Base(_) => return,
        }
        for around in values.windows(4) {
            if let &[a, b, c, d] = around {
                let (most, least) = (a.max(b).max(c).max(d), a.min(b).min(c).min(d));
                let range = most - least;
                // A function that varies much, and too fast for these places, may be zero between them.
                let strays = ((d - a) - R::from_f64(3.0) * (c - b)).abs() - R::from_f64(SMOOTH) * range;
                let much = range - R::from_f64(0.25) * most.max(-least);
                near = near.max(dips([a, b, c])).max(dips([b, c, d])).max(strays.min(much));
            }
        }
    });
    near
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_that_pass_or_touch_zero_come_near_it() {
        for at in [0.01, 0.3, 0.5, 0.8, 0.99] {
            let near = |value: &dyn Fn(f64) -> f64| dips([0.0, 0.5, 1.0].map(value)) > 0.0;
            assert!(near(&|t| t - at) && near(&|t| at - t), "{at}");
            assert!(near(&|t| (t - at).powi(2)) && near(&|t| -(t - at).powi(2)), "{at}");
            assert!(near(&|t| (t - at).powi(2) + 1e-6) && near(&|t| (t - at).sin().powi(2)), "{at}");
            assert!(!near(&|t| 1.0 + 0.5 * (t - at)) && !near(&|t| 1.0 + 0.3 * (t - at).powi(2)), "{at}");
        }
    }

    #[test]
    fn cubic_motions_are_known_between_their_ends() {
        let at =
            |t: f64| State { t, q: [1.0 - t + 0.5 * t * t - 0.3 * t * t * t], v: [-1.0 + t - 0.9 * t * t] };
        for part in [0.25, 0.5, 0.75] {
            let [found, expected] = [between([&at(0.5), &at(2.0)], 1.5, part), at(0.5 + 1.5 * part)];
            assert!((found.q[0] - expected.q[0]).abs() < 1e-14 && (found.v[0] - expected.v[0]).abs() < 1e-14);
        }
    }

    /// A root with these values at the places of a step.
    struct Along([f64; PLACES]);

    impl Hiding<f64, 1> for Along {
        fn along<const COUNT: usize>(
            &self,
            states: &[State<f64, 1>; COUNT],
            mut visit: impl FnMut(Hidden, [f64; COUNT]),
        ) {
            visit(Hidden::Root, states.map(|state| self.0[state.q[0].round() as usize]));
        }
    }

    #[test]
    fn roots_that_vary_too_fast_for_the_places_may_be_zero_between_them() {
        for (values, is_near) in [
            ([1.0, 1.2, 1.4, 1.6, 1.8], false),
            ([1.0, 1.2, 1.5, 1.5, 1.5], true),
            // What varies little does not reach zero.
            ([1.0, 1.05, 1.0, 1.05, 1.0], false),
            ([2.0, 1.5, 0.8, 0.05, -0.5], true),
        ] {
            let [start, end] = [0.0, 4.0].map(|q| State { t: q, q: [q], v: [1.0] });
            let near = near_roots(&Along(values), [&start, &end], 4.0);
            assert_eq!(near > 0.0, is_near, "{values:?}: {near}");
        }
    }
}
