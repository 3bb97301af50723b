//! Where a polynomial with known roundings falls through zero.
//!
//! A guard has fallen where it is below zero by more than its roundings; it was zero where the polynomial was zero
//! last. So what touches zero within roundings has not fallen, and nothing falls twice.
//!
//! Coefficients of Bernstein bound a polynomial by their least and largest, and it has no more roots on its interval
//! than they have changes of sign. Those of a part of the interval follow from those of powers without loss: their sum
//! of magnitudes bounds all that is added on the way (R. T. Farouki, "The Bernstein polynomial basis: a centennial
//! retrospective", Computer Aided Geometric Design 29, 2012).

use crate::number::real::{Ordered, Real, larger};
use crate::series::taylor::{TERMS, Taylor, shift};

/// How often the interval is halved at most: where it is that short, two roots count as none.
const LEVELS: usize = 26;

/// Rounds that find the reach of a series; what they leave is found by the next series.
const AGREED: usize = 6;

/// A guard may have so many times the size that it has where it starts: what is far away, as the end of a long free
/// fall, must not hide what is near.
const DROWNED: f64 = 16.0;

/// What is known of a guard where the polynomial starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Before {
    /// Nothing: it may have fallen before.
    Unknown,
    /// It is zero there whatever the polynomial says, and rises.
    Zero,
}

/// A fall through zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fall<R> {
    /// Where the polynomial is zero.
    pub(crate) place: R,
    /// Where the guard is below zero for certain.
    pub(crate) fallen: R,
}

/// Where on \[0, 1] a guard falls through zero first, if it does.
pub(crate) fn falls<R: Ordered>(guard: &Taylor<R>, before: Before) -> Option<Fall<R>> {
    let zero = R::zero();
    let (first, others) = guard.terms().split_first()?;
    let down = others.iter().fold(zero, |sum, &term| if term < zero { sum + term } else { sum });
    let noise = guard.error;
    // What the others take away at most leaves it above zero.
    if *first + down > noise {
        return None;
    }
    let extent = guard.extent();
    let summed = R::from_f64(2.0 * guard.degree as f64 + 2.0) * R::epsilon();
    let noise = noise + summed * extent;
    let mut powers = guard.coefficients;
    let starts_at_zero = match before {
        Before::Unknown if *first < -noise => return Some(Fall { place: zero, fallen: zero }),
        // What is above zero there falls through it as the polynomial does.
        Before::Unknown | Before::Zero => *first <= zero,
    };
    let polynomial = powers.get_mut(..=guard.degree)?;
    let start = polynomial[0];
    if starts_at_zero {
        polynomial[0] = zero;
    }
    let [low, high] = isolated(polynomial, noise)?;
    let place = if starts_at_zero && low == zero {
        behind_zero(polynomial, start, noise, high)
    } else {
        root(polynomial, low, high)
    };
    Some(Fall { place, fallen: high })
}

/// An interval at whose start a polynomial is above −`noise` and at whose end it is below, and whose start is the last
/// such place that halving knows.
fn isolated<R: Ordered>(polynomial: &[R], noise: R) -> Option<[R; 2]> {
    let (zero, half) = (R::zero(), R::from_f64(0.5));
    let (mut level, mut number) = (0_usize, 0_u64);
    let mut width = R::one();
    loop {
        let low = R::from_f64(number as f64) * width;
        let mut part = [zero; TERMS];
        let part = part.get_mut(..polynomial.len())?;
        part.copy_from_slice(polynomial);
        if level > 0 {
            shift(part, low, width);
        }
        let changes = changes(part, noise);
        match changes {
            Changes::Several if level < LEVELS => {
                (level, number, width) = (level + 1, 2 * number, width * half);
                continue;
            }
            Changes::One => return Some([low, low + width]),
            Changes::Several if value(polynomial, low + width) < -noise => return Some([low, low + width]),
            _ => {}
        }
        // Back to the largest part that starts where this one ends.
        number += 1;
        while level > 0 && number.is_multiple_of(2) {
            (level, number, width) = (level - 1, number / 2, width + width);
        }
        if level == 0 {
            return None;
        }
    }
}

/// Changes of sign among coefficients of Bernstein.
enum Changes {
    None,
    One,
    Several,
}

/// Those of a polynomial of this much more than itself.
fn changes<R: Ordered>(powers: &mut [R], more: R) -> Changes {
    let (zero, one) = (R::zero(), R::one());
    let degree = R::from_f64(powers.len() as f64 - 1.0);
    if let Some(first) = powers.first_mut() {
        *first += more;
    }
    // Divided by binomial coefficients, then summed as differences are.
    let (mut weight, mut order) = (one, zero);
    for term in powers.iter_mut().skip(1) {
        order += one;
        weight *= order / (degree - order + one);
        *term *= weight;
    }
    for first in 1..powers.len() {
        let Some((mut before, others)) = powers
            .get_mut(first - 1..)
            .and_then(|rest| rest.split_first_mut().map(|(first, others)| (*first, others)))
        else {
            continue;
        };
        for term in others {
            let own = *term;
            *term = own + before;
            before = own;
        }
    }
    let mut count = 0;
    let mut above = powers.first().is_some_and(|&first| first > zero);
    for &term in powers.iter() {
        if (term > zero) != above {
            above = !above;
            count += 1;
        }
    }
    match count {
        0 if above => Changes::None,
        0 | 1 => Changes::One,
        _ => Changes::Several,
    }
}

/// The zero behind one at the start, of a polynomial that was `start` there.
fn behind_zero<R: Ordered>(polynomial: &[R], start: R, noise: R, mut high: R) -> R {
    let (zero, half) = (R::zero(), R::from_f64(0.5));
    let rest = polynomial.get(1..).unwrap_or_default();
    let mut low = zero;
    if value(rest, zero) <= zero {
        // It rises later, if at all.
        loop {
            let middle = half * (low + high);
            if middle <= low || middle >= high || high <= R::epsilon() {
                return low;
            }
            let here = value(polynomial, middle);
            if here < -noise || here <= zero && slope(polynomial, middle) < zero {
                high = middle;
            } else {
                low = middle;
                if value(rest, middle) > zero {
                    break;
                }
            }
        }
    }
    let place = root(rest, low, high);
    // There the guard is again what it was at the start.
    let slope = place * slope(rest, place);
    let correction = start / slope;
    let corrected = place - correction;
    if correction.abs() <= half * place && corrected <= high { corrected } else { place }
}

/// The root between a place where a polynomial is not below zero and one where it is, to the last bit or two.
fn root<R: Ordered>(polynomial: &[R], mut low: R, mut high: R) -> R {
    let (zero, half) = (R::zero(), R::from_f64(0.5));
    let (from, to) = (value(polynomial, low), value(polynomial, high));
    if from <= zero {
        return low;
    }
    if to >= zero {
        return high;
    }
    // The chord, then Newton's steps as long as they stay in the bracket and halve it or themselves.
    let mut place = low + (high - low) * (from / (from - to));
    let mut last = high - low;
    loop {
        let (here, rate) = (value(polynomial, place), slope(polynomial, place));
        if here == zero {
            return place;
        }
        if here > zero {
            low = place;
        } else {
            high = place;
        }
        let step = -(here / rate);
        let next = place + step;
        let is_good = next > low && next < high && step.abs() <= half * last;
        let next = if is_good { next } else { half * (low + high) };
        let moved = (next - place).abs();
        if next <= low || next >= high || moved <= R::epsilon() * place.abs() {
            return if is_good { next } else { place };
        }
        (last, place) = (moved, next);
    }
}

/// The value of a polynomial: odd and even powers side by side, which neither waits for.
fn value<R: Ordered>(polynomial: &[R], theta: R) -> R {
    let square = theta * theta;
    let (pairs, rest) = polynomial.as_chunks::<2>();
    let mut even = rest.first().copied().unwrap_or(R::zero());
    let mut odd = R::zero();
    for [low, high] in pairs.iter().rev() {
        even = R::mul_add(even, square, *low);
        odd = R::mul_add(odd, square, *high);
    }
    R::mul_add(odd, theta, even)
}

/// The derivative of a polynomial.
fn slope<R: Ordered>(polynomial: &[R], theta: R) -> R {
    let mut order = R::from_f64(polynomial.len() as f64);
    let mut slope = R::zero();
    for &term in polynomial.iter().skip(1).rev() {
        order -= R::one();
        slope = R::mul_add(slope, theta, order * term);
    }
    slope
}

/// The part of the interval on which what has been left away of a guard is less than its roundings.
pub(crate) fn reach<R: Ordered>(guard: &Taylor<R>) -> R {
    let mut reach = R::one();
    if guard.is_whole || guard.degree == 0 {
        return reach;
    }
    // Every other term of an even or odd function is zero.
    let last = [guard.degree, guard.degree - 1].map(|order| {
        let term = guard.coefficients.get(order).copied().unwrap_or(R::zero()).abs();
        (term, order.max(1) as i32)
    });
    // On a shorter part the function is smaller as well: from above, until both agree.
    for _ in 0..AGREED {
        let (size, before) = (size(guard, reach), reach);
        for (term, order) in last {
            if term * reach.powi(order) > R::epsilon() * size {
                reach = (R::epsilon() * size / term).powf(R::from_f64(f64::from(order)).recip());
            }
        }
        if reach >= before {
            break;
        }
    }
    reach
}

/// The part of the interval on which a guard has roundings like those where it starts, by factors of four.
pub(crate) fn clear<R: Ordered>(guard: &Taylor<R>) -> R {
    let mut clear = R::one();
    let [first, second, ..] = guard.coefficients.map(Real::abs);
    for _ in 0..AGREED {
        if size(guard, clear) <= R::from_f64(DROWNED) * larger(first, second * clear) {
            break;
        }
        clear *= R::from_f64(0.25);
    }
    clear
}

/// A bound of a guard on a part of the interval.
fn size<R: Ordered>(guard: &Taylor<R>, part: R) -> R {
    guard.terms().iter().rev().fold(R::zero(), |size, term| R::mul_add(size, part, term.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial with these roots and −1 before its highest power, with roundings as given.
    fn with_roots(roots: &[f64], noise: f64) -> Taylor<f64> {
        let mut terms = [0.0; TERMS];
        terms[0] = 1.0;
        for (degree, root) in roots.iter().enumerate() {
            for k in (0..=degree + 1).rev() {
                let below = if k > 0 { terms[k - 1] } else { 0.0 };
                terms[k] = root * terms[k] - below;
            }
        }
        let mut guard = Taylor::variable(terms[0], terms[1..].iter().copied(), 1.0);
        guard.error = noise;
        guard
    }

    fn first(roots: &[f64]) -> Option<f64> {
        falls(&with_roots(roots, 1e-16), Before::Unknown).map(|fall| fall.place)
    }

    #[test]
    fn the_first_root_of_several() {
        for roots in [&[0.3][..], &[0.3, 0.7, 0.9], &[0.3, 0.300_1, 5.0], &[2.0, 0.3, 1.1, 3.0]] {
            let zero = first(roots).unwrap();
            assert!((zero - 0.3).abs() < 1e-11, "{roots:?}: {zero}");
        }
        assert_eq!(first(&[1.3, 1.5]), None);
        assert_eq!(first(&[-0.5, -0.3]), None);
    }

    #[test]
    fn a_root_is_found_to_the_last_bits() {
        let mut guard = Taylor::variable(0.5, [1.0, -3.0].into_iter(), 1.0);
        guard.error = 1e-16;
        let zero = falls(&guard, Before::Unknown).unwrap().place;
        assert!((zero - (1.0 + 7.0_f64.sqrt()) / 6.0).abs() < 2e-16);
    }

    #[test]
    fn what_touches_zero_has_not_fallen() {
        assert_eq!(first(&[0.4, 0.4]), None);
        let touched = first(&[0.4, 0.4, 0.8]).unwrap();
        assert!((touched - 0.8).abs() < 1e-13, "{touched}");
    }

    #[test]
    fn what_starts_at_zero_rises_first() {
        // A flight, from a little below zero for rounding.
        for start in [0.0, -3e-17, 3e-17] {
            let mut guard = Taylor::variable(start, [1.0, -2.0].into_iter(), 1.0);
            guard.error = 1e-16;
            for before in [Before::Unknown, Before::Zero] {
                let zero: f64 = falls(&guard, before).unwrap().place;
                assert!((zero - 0.5).abs() <= f64::EPSILON, "{zero}");
            }
        }
        // What falls at once, and what rounding lets fall.
        let mut guard = Taylor::variable(0.0, [-1.0].into_iter(), 1.0);
        guard.error = 1e-16;
        assert!(falls(&guard, Before::Zero).unwrap().place < 1e-14);
        let mut guard = Taylor::variable(0.0, [-1e-18, 1.0, -4.0].into_iter(), 1.0);
        guard.error = 1e-16;
        let zero: f64 = falls(&guard, Before::Zero).unwrap().place;
        assert!((zero - 0.25).abs() < 1e-15, "{zero}");
        // What was below zero at the start has fallen before.
        let mut guard = Taylor::variable(-1e-3, [1.0].into_iter(), 1.0);
        guard.error = 1e-16;
        assert_eq!(falls(&guard, Before::Unknown), Some(Fall { place: 0.0, fallen: 0.0 }));
    }

    #[test]
    fn a_truncated_series_reaches_as_far_as_it_converges() {
        let turns = Taylor::variable(0.0, [30.0].into_iter(), 1.0_f64).sin();
        let reach = reach(&turns);
        assert!(reach > 0.1 && reach < 0.6, "{reach}");
        let part = Taylor::variable(0.0, [27.0 * reach].into_iter(), 1.0_f64).sin();
        assert_eq!(super::reach(&part), 1.0);
        let theta = 0.9;
        assert!((value(part.terms(), theta) - (27.0 * reach * theta).sin()).abs() < 1e-13);
    }
}
