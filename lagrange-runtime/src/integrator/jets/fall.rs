//! What earlier terms of a series say of its last ones.
//!
//! Symmetry makes coefficients vanish, at x = 0 of x″ = −x³ two of any four orders, or nearly vanish beside
//! it. So the last two terms alone could say that a step is short enough when it is not. Earlier terms
//! predict how large they would be otherwise, by one of two rules, of which the more generous one counts:
//!
//! 1. Terms fall from order to order by [`steepest`] at most. That is soon seen.
//! 2. Terms fall from an order k on as they fell to it, with ratios that grow like the order, as those of
//!    an oscillation do, (ωt)ᵏ/k!: the Newton polygon of the series, the hull of its points (k, ln term),
//!    goes on beyond its last vertex. Terms of a motion with many frequencies rise at first and then fall
//!    more steeply than the first rule allows.

use crate::number::real::{Ordered, Real, larger, smaller};
use crate::series::HIGHEST;

use super::last_term;

/// The ratio of successive terms that the first rule allows at least.
const STEEPEST: f64 = 6.0;

/// The largest ratio of successive terms of a series that counts as decay: [`STEEPEST`], or 1.5 times the
/// decay that tolerance and order demand, where that is more. It is more only where [`HIGHEST`] leaves fewer
/// orders per digit, as happens for scalars with more digits than `f64`.
#[inline]
pub(crate) fn steepest<R: Ordered>(tolerance: R, orders: usize) -> R {
    let demanded = (-last_term(tolerance).ln() / R::from_f64(orders as f64)).exp();
    larger(R::from_f64(STEEPEST), R::from_f64(1.5) * demanded)
}

/// A length at which terms of lower orders are small, too, at most the given one. `term` gives the size of an
/// order, in tolerances.
#[inline]
pub(super) fn bounded<R>(orders: usize, steepest: R, length: R, term: impl Fn(usize) -> R) -> R
where
    R: Real + PartialOrd,
{
    let half = orders / 2;
    // All terms at once, as in Horner's scheme: term(k) lengthᵏ against the power of the orders that follow.
    let steep = steepest * length;
    let most = (half..orders - 1).rev().fold(R::zero(), |most, order| larger(most * steep, term(order)));
    if most * steep.powi(half as i32) <= steepest.powi(orders as i32) {
        return length;
    }
    shortened(orders, steepest, length, term)
}

/// The same if some term is too large by the first rule.
#[cold]
fn shortened<R>(orders: usize, steepest: R, length: R, term: impl Fn(usize) -> R) -> R
where
    R: Real + PartialOrd,
{
    let (mut shortened, mut allowed) = (length, steepest);
    for order in (orders / 2..orders - 1).rev() {
        allowed *= steepest;
        let term = term(order) / allowed;
        if term != R::zero() && term * shortened.powi(order as i32) > R::one() {
            shortened = reach(term, order);
        }
    }
    if !length.is_finite() {
        return shortened;
    }
    let last = predicted(orders, |order| term(order) * length.powi(order as i32));
    larger(length * smaller(reach(last, orders), R::one()), shortened)
}

/// The length at which a term of an order falls to one.
#[inline]
pub(super) fn reach<R: Real>(term: R, order: usize) -> R {
    if term == R::zero() {
        return R::from_f64(f64::INFINITY);
    }
    (-term.ln() / R::from_f64(order as f64)).exp()
}

/// The largest last term that a term of the upper half of a series predicts by the second rule. `term`
/// gives the size of an order.
#[cold]
#[inline(never)]
pub(crate) fn predicted<R: Real>(orders: usize, term: impl Fn(usize) -> R) -> R {
    // A term of zero has no logarithm. This one is far below any that counts.
    let least = R::epsilon().powi(4);
    let mut logarithms = [least.ln(); HIGHEST];
    let logarithms = logarithms.get_mut(..orders.saturating_sub(2)).unwrap_or_default();
    for (k, logarithm) in (1..).zip(logarithms.iter_mut()) {
        *logarithm = term(k).max(least).ln();
    }
    // Divided as scalars: a program in single precision has no doubles.
    let number = |count: usize| R::from_f64(count as f64);
    let mut largest = least.ln();
    for (at, &here) in logarithms.iter().enumerate().skip((orders / 2).saturating_sub(1)) {
        let k = at + 1;
        // The mean fall from an earlier order to this one: that from the last vertex where this is one, too.
        let before = logarithms.iter().take(at).enumerate();
        let fall = |(j, &there): (usize, &R)| (there - here) / number(at - j);
        let Some(steepest) = before.map(fall).reduce(R::max) else { continue };
        // The mean of the orders that follow, over k. The geometric mean of their ratios to k is no larger.
        let rise = (number(orders + k + 1) / number(2 * k)).ln();
        largest = largest.max(here - number(orders - k) * (steepest + rise));
    }
    largest.exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (ωt)ᵏ/k! in tolerances, for a size of one.
    fn oscillation(x: f64, tolerance: f64) -> impl Fn(usize) -> f64 {
        move |k| (1..=k).map(|i| x / i as f64).product::<f64>() / last_term(tolerance)
    }

    /// The largest x at which the last term of an oscillation is in the tolerance.
    fn tolerated(tolerance: f64, orders: usize) -> f64 {
        let [mut low, mut high] = [0.0, 1e3];
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            let inside = oscillation(middle, tolerance)(orders) < 1.0;
            if inside { low = middle } else { high = middle }
        }
        low
    }

    const CASES: [(f64, usize); 4] = [(1e-3, 8), (1e-6, 14), (1e-10, 30), (1e-14, HIGHEST)];

    #[test]
    fn a_term_of_the_upper_half_that_is_too_large_shortens_the_step_to_where_it_is_not() {
        for (large, length) in [(18, 0.25_f64.powf(1.0 / 18.0)), (12, 0.5_f64.powf(8.0 / 12.0)), (10, 0.5)] {
            let found = bounded(20, 0.5, 1.0, |order| if order == large { 1.0 } else { 0.0 });
            assert!((found - length).abs() < 1e-14, "{large}: {found}");
        }
        // Ratios of six: the term may be the second power of that.
        let found = bounded(20, 6.0, 1.0, |order| if order == 18 { 72.0 } else { 0.0 });
        assert!((found - 0.5_f64.powf(1.0 / 18.0)).abs() < 1e-14, "{found}");
    }

    #[test]
    fn terms_that_fall_as_fast_as_they_are_to_leave_the_length() {
        // A little below the limit, because powers are rounded.
        assert_eq!(bounded(20, 0.5, 1.0, |order| 0.999 * 0.5_f64.powi(20 - order as i32)), 1.0);
        // The lower half is the motion itself.
        assert_eq!(bounded(20, 0.5, 1.0, |order| if order < 10 { 1e3 } else { 0.0 }), 1.0);
    }

    #[test]
    fn terms_may_fall_by_six_unless_the_highest_order_asks_for_more() {
        assert_eq!(steepest(1e-10, 21), STEEPEST);
        // The last of 10 terms is a thousandth of an ulp: 1.5 times the decay that they demand.
        let demanded = (1e-3 * f64::EPSILON).powf(-0.1);
        let found: f64 = steepest(1e-30, 10);
        assert!((found / (1.5 * demanded) - 1.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn the_hull_of_an_oscillation_predicts_its_last_term() {
        for (tolerance, p) in CASES {
            let term = oscillation(tolerated(tolerance, p), tolerance);
            let found = predicted(p, &term);
            assert!(found < 1.0 && found > 0.5, "{tolerance:e}, {p}: {found}");
        }
    }

    #[test]
    fn a_geometric_series_with_gaps_of_any_width_is_seen() {
        // Two of each `period` orders have terms, which fall threefold an order. The last two have none.
        for period in 3..9 {
            for phase in 0..period {
                let has = |k: usize| (k + phase) % period < 2;
                let p = 24;
                if has(p) || has(p - 1) {
                    continue;
                }
                let term = |k: usize| if has(k) { 3f64.powi((p - k) as i32) } else { 1e-25 };
                let found = predicted(p, term);
                // Less by the rise that is allowed for, over the gap before the last order.
                let k = (1..=p).rev().find(|&k| has(k)).unwrap();
                let expected = ((2 * k) as f64 / (p + k + 1) as f64).powi((p - k) as i32);
                assert!(
                    (found / expected - 1.0).abs() < 1e-12,
                    "{period}, {phase}: {found:e} for {expected:e}"
                );
            }
        }
    }

    #[test]
    fn zeros_predict_nothing_and_a_term_alone_something() {
        assert!(predicted(12, |_| 0.0) < 1e-60);
        // The order 9 alone, 400 times what counts as zero.
        let found = predicted(12, |k| if k == 9 { 1e-60 } else { 0.0 });
        assert!(found > 1e-61 && found < 1e-58, "{found:e}");
    }
}
