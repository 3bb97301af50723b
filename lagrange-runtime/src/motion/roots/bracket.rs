//! A root in a bracket.

use crate::number::real::{Ordered, larger};

/// Steps after which the bracket counts as small enough. At worst every other step halves the bracket, and
/// the root takes twice as many steps as it has bits.
const STEPS: usize = 400;

/// The root of `f` between two points with values of opposite sign, to the last bit or two.
///
/// Inverse quadratic interpolation where the three last points allow it, else halving: Chandrupatla, "A new
/// hybrid quadratic/bisection algorithm for finding the zero of a nonlinear function without using
/// derivatives", Advances in Engineering Software 28 (1997).
pub(super) fn solve<R: Ordered>(mut f: impl FnMut(R) -> R, low: (R, R), high: (R, R)) -> R {
    let (zero, one, half) = (R::zero(), R::one(), R::from_f64(0.5));
    let (mut a, mut b, mut c) = (high, low, low);
    let mut part = half;
    for step in 0..STEPS {
        let best = if a.1.abs() < b.1.abs() { a } else { b };
        let width = (b.0 - a.0).abs();
        let tolerance = R::epsilon() * (best.0.abs() + R::epsilon());
        if best.1 == zero || width <= tolerance {
            return best.0;
        }
        let least = tolerance / width;
        if step > 0 {
            part = interpolated(a, b, c).unwrap_or(half);
        }
        if part < least {
            part = least;
        }
        if part > one - least {
            part = one - least;
        }
        if least > half {
            part = half;
        }
        let x = a.0 + part * (b.0 - a.0);
        if x == a.0 || x == b.0 {
            return best.0;
        }
        let next = (x, f(x));
        if (next.1 < zero) == (a.1 < zero) {
            c = a;
        } else {
            c = b;
            b = a;
        }
        a = next;
    }
    if a.1.abs() < b.1.abs() { a.0 } else { b.0 }
}

/// Where between `a` and `b` the inverse parabola through three points is zero, if it is monotone there.
fn interpolated<R: Ordered>(a: (R, R), b: (R, R), c: (R, R)) -> Option<R> {
    let one = R::one();
    let xi = (a.0 - b.0) / (c.0 - b.0);
    let phi = (a.1 - b.1) / (c.1 - b.1);
    let monotone = phi * phi < xi && (one - phi) * (one - phi) < one - xi;
    let part = a.1 / (b.1 - a.1) * c.1 / (b.1 - c.1)
        + (c.0 - a.0) / (b.0 - a.0) * (a.1 / (c.1 - a.1)) * (b.1 / (c.1 - b.1));
    (monotone && part.is_finite()).then_some(larger(part, R::zero()))
}
