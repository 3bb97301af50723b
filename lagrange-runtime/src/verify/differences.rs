//! Derivatives by central differences, with their uncertainty.

use crate::real::Real;

/// Steps, each a quarter of the one before.
const STEPS: usize = 5;

/// df/dx at 0 by differences of order four, f′ ≈ (8 (f(h) − f(−h)) − (f(2h) − f(−2h))) / 12h, and by how much the two best
/// steps disagree.
pub fn derivative<R: Real>(f: impl Fn(R) -> R) -> (R, R) {
    let four = R::from_f64(4.0);
    let mut h = (R::epsilon().ln() / R::from_f64(5.0)).exp() * four * R::from_f64(2.0);
    let mut last = quotient(&f, h);
    let mut best: Option<(R, R)> = None;
    for _ in 1..STEPS {
        h /= four;
        let next = quotient(&f, h);
        let difference = (next - last).abs();
        last = next;
        let better = match best {
            Some((_, uncertainty)) => {
                !uncertainty.is_finite() || difference.largest() < uncertainty.largest()
            }
            None => true,
        };
        if better {
            best = Some((next, difference));
        }
    }
    best.unwrap_or((last, last))
}

fn quotient<R: Real>(f: &impl Fn(R) -> R, h: R) -> R {
    let (near, far) = (f(h) - f(-h), f(h + h) - f(-h - h));
    (R::from_f64(8.0) * near - far) / (R::from_f64(12.0) * h)
}
