//! Derivatives by central differences, with their uncertainty.

use crate::number::real::Real;

/// Ratio of each step to the one before.
const GROWTH: f64 = 4.0;

/// Differences this many times as uncertain as the best one have steps beyond the scale of the function.
const BEYOND: f64 = 1e3;

/// df/dx at 0 by differences of order four, f′ ≈ (8 (f(h) − f(−h)) − (f(2h) − f(−2h))) / 12h, and by how much
/// it is uncertain.
///
/// `scale` is a change of x in which f may change by its own size, at most. Steps grow from half the digits
/// of it. At first the share of rounding errors falls. From some step on, which is not known beforehand, f is
/// no longer the polynomial that the formula takes it for. The best step is where consecutive differences
/// agree, and the search ends where they disagree again: further away a function may be flat.
pub fn derivative<R: Real>(f: impl Fn(R) -> R, scale: R) -> (R, R) {
    let number = R::from_f64;
    let mut h = scale * R::epsilon().sqrt();
    if !h.is_positive() {
        // No step is short beside such a scale, and nothing is known.
        return (R::zero(), R::one() / R::zero());
    }
    let (mut last, _) = quotient(&f, h);
    let mut before: Option<R> = None;
    let mut best: Option<(R, R)> = None;
    while (h - scale * number(0.5 / GROWTH)).largest() < R::zero().largest() {
        h *= number(GROWTH);
        let (next, size) = quotient(&f, h);
        let difference = (next - last).abs();
        let rounding = size * R::epsilon();
        // Two rounding errors may agree by chance; hardly twice in a row.
        let doubt = before.map(|before| difference + before / number(GROWTH) + rounding / h);
        (last, before) = (next, Some(difference));
        let Some(doubt) = doubt.filter(|doubt| doubt.is_finite()) else { continue };
        match best {
            Some((_, least)) if (doubt - least).largest() >= R::zero().largest() => {
                if (doubt - least * number(BEYOND)).largest() > R::zero().largest() {
                    break;
                }
            }
            _ => best = Some((next, doubt)),
        }
    }
    best.unwrap_or((last, R::one() / R::zero()))
}

/// The difference, and the size of what it subtracts: beside a place at which f vanishes, rounding errors are
/// those of the values beside.
fn quotient<R: Real>(f: &impl Fn(R) -> R, h: R) -> (R, R) {
    let [before, after] = [f(-h), f(h)];
    let (near, far) = (after - before, f(h + h) - f(-h - h));
    let size = before.abs().max(after.abs());
    ((R::from_f64(8.0) * near - far) / (R::from_f64(12.0) * h), size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_know_their_uncertainty_at_any_scale() {
        let check = |f: &dyn Fn(f64) -> f64, scale: f64, slope: f64, share: f64| {
            let (found, doubt) = derivative(f, scale);
            assert!(
                (found - slope).abs() <= 2.0 * doubt + 1e-14 * slope.abs(),
                "{found} ± {doubt}, not {slope}"
            );
            assert!(doubt <= share * slope.abs(), "{found} ± {doubt} of {slope}");
        };
        for scale in [1e-9, 1.0, 1e12] {
            check(&|x| (1.0 + x / scale).sqrt(), scale, 0.5 / scale, 1e-9);
            check(&|x| (1.0 + x / scale).powi(-12), scale, -12.0 / scale, 1e-8);
            // A function of a far smaller scale than is known.
            check(&|x| (1e4 * x / scale).sin(), scale, 1e4 / scale, 1e-7);
            // A bump, which is flat a little further away.
            check(&|x| (-(1e3 * x / scale - 1.0).powi(2)).exp(), scale, 2e3 / scale * (-1.0_f64).exp(), 1e-7);
            // Linear functions have no scale.
            check(&|x| 3.0 * x / scale + 5.0, scale, 3.0 / scale, 1e-8);
        }
        // What the place itself hides beside a step is not known.
        let (slope, doubt) = derivative(|x: f64| (1e-160 + x).powi(2), 1.0);
        assert!((slope - 2e-160).abs() <= doubt, "{slope} ± {doubt}");
        // Below the smallest numbers there are no steps.
        for scale in [0.0, 5e-324, -1.0, f64::NAN] {
            assert_eq!(derivative(|x: f64| x, scale), (0.0, f64::INFINITY));
        }
        let (slope, doubt) = derivative(|x: f32| (1.0 + x).ln(), 1.0);
        assert!((slope - 1.0).abs() <= 2.0 * doubt && doubt < 1e-3, "{slope} ± {doubt}");
        assert_eq!(derivative(|_: f64| 7.0, 1.0).0, 0.0);
    }
}
