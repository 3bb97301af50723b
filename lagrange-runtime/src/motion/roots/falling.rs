//! Where a polynomial with known roundings falls through zero.
//!
//! A guard has fallen where it is below zero by more than its roundings; it was zero where the polynomial was
//! zero last. So what touches zero within roundings has not fallen, and nothing falls twice. A gap that has
//! been above zero for certain cannot have fallen before. It falls where its polynomial does: a contact that
//! closes by roundings opens again and changes no more than these do, while a strike that is missed changes
//! the motion by the root of the depth that it would have.
//!
//! Coefficients of Bernstein bound a polynomial by their least and largest, and it has no more roots on its
//! interval than they have changes of sign. Those of a part of the interval follow from those of powers
//! without loss: their sum of magnitudes bounds all that is added on the way (R. T. Farouki, "The Bernstein
//! polynomial basis: a centennial retrospective", Computer Aided Geometric Design 29, 2012).

use crate::number::elements::Each;
use crate::number::real::{Ordered, Real, larger};
use crate::series::taylor::{TERMS, Taylor, shift};

/// How often the interval is halved at most: where it is that short, two roots count as none.
const LEVELS: usize = 26;

/// Rounds that find the reach of a series, or where a guard is clear. What they leave is found by the next
/// series.
const AGREED: usize = 6;

/// A guard may have so many times the size that it has where it starts: what is far away, as the end of a
/// long free fall, must not hide what is near.
const DROWNED: f64 = 16.0;

/// What is known of a guard where the polynomial starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Before {
    /// Nothing: it may have fallen before.
    Unknown,
    /// It is zero there whatever the polynomial says, and rises.
    Zero,
    /// It has been above zero by more than its roundings: then it falls where its polynomial does.
    Above,
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
    let first = guard.start();
    let noise = if before == Before::Above { zero } else { self::noise(guard) };
    let mut powers = guard.coefficients;
    if before != Before::Zero && first < -noise {
        return Some(Fall { place: zero, fallen: zero });
    }
    // What is above zero there falls through it as the polynomial does.
    let starts_at_zero = first <= zero;
    let polynomial = powers.get_mut(..=guard.degree)?;
    let start = polynomial[0];
    if starts_at_zero {
        polynomial[0] = zero;
    }
    // What the other terms take away at most does not bring it below its roundings, of which a guard that is
    // zero all the time may have none.
    if polynomial[0] + guard.down() >= -noise {
        return None;
    }
    let [low, high] = isolated(polynomial, noise)?;
    let place = if starts_at_zero && low == zero {
        behind_zero(polynomial, start, noise, high)
    } else {
        root(polynomial, low, high, noise)
    };
    Some(Fall { place, fallen: high })
}

/// Where on \[0, 1] a guard that has been above zero is least, if it comes so near to zero there that its
/// roundings do not tell whether it falls: the first such place that halving knows. One that still falls at
/// the end is least further on.
#[cold]
pub(crate) fn touches<R: Ordered>(guard: &Taylor<R>) -> Option<R> {
    let (zero, half) = (R::zero(), R::from_f64(0.5));
    let noise = noise(guard);
    let mut powers = guard.coefficients;
    let polynomial = powers.get_mut(..=guard.degree)?;
    polynomial[0] -= noise;
    let [mut low, mut high] = isolated(polynomial, zero)?;
    let falls = |place: R| with_slope(polynomial, place)[1] < zero;
    if falls(high) {
        (low, high) = (high, R::one());
        if falls(high) {
            return None;
        }
    }
    loop {
        let middle = half * (low + high);
        if middle <= low || middle >= high {
            return Some(middle);
        }
        if falls(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// An interval at whose start a polynomial is above −`noise` and at whose end it is below, and whose start is
/// the last such place that halving knows.
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

/// Coefficients of Bernstein from those of powers: divided by binomial coefficients, then summed as
/// differences are.
fn to_bernstein<R: Ordered>(powers: &mut [R]) {
    let two = R::one() + R::one();
    let degree = R::from_f64(powers.len() as f64 - 1.0);
    let (mut weight, mut order) = (R::one(), R::zero());
    // The weights are the same from both ends.
    let mut terms = &mut *powers;
    while let [first, rest @ .., last] = terms {
        *first *= weight;
        *last *= weight;
        order += R::one();
        weight *= order / (degree - order + R::one());
        terms = rest;
    }
    if let [middle] = terms {
        *middle *= weight;
    }
    // Two sums at a time, of which the second leaves out one term more.
    let mut rest = powers;
    while let [before, first, others @ ..] = rest {
        let (mut last, mut next_to_last) = (*first, *before);
        *first += *before;
        for term in others {
            let own = *term;
            *term = R::mul_add(two, last, own + next_to_last);
            (next_to_last, last) = (last, own);
        }
        rest = rest.get_mut(2..).unwrap_or_default();
    }
}

/// What bounds the roundings of a guard and of sums of its terms.
fn noise<R: Ordered>(guard: &Taylor<R>) -> R {
    let summed = R::from_f64(2.0 * guard.degree as f64 + 2.0) * R::epsilon();
    guard.error + summed * guard.extent()
}

/// Whether a guard starts above zero by more than its roundings.
pub(crate) fn starts_above<R: Ordered>(guard: &Taylor<R>) -> bool {
    guard.start() > noise(guard)
}

/// Whether a guard is above zero on the whole of its interval, by more than its roundings.
pub(crate) fn stays_above<R: Ordered>(guard: &Taylor<R>) -> bool {
    let noise = noise(guard);
    guard.start() + guard.down() > noise
        || guard.start() > noise && guard.end() > noise && is_bounded(guard, noise)
}

/// Whether coefficients of Bernstein are above the roundings.
fn is_bounded<R: Ordered>(guard: &Taylor<R>, noise: R) -> bool {
    let mut part = guard.coefficients;
    let part = part.get_mut(..=guard.degree).unwrap_or_default();
    to_bernstein(part);
    part.iter().all(|&term| term > noise)
}

/// Whether a guard rises from where it starts and does not come back: whether what it gains is a positive
/// multiple of the time, by more than its error.
pub(crate) fn rises<R: Ordered>(guard: &Taylor<R>, before: Before) -> bool {
    if before != Before::Zero && guard.start() < R::zero() {
        return false;
    }
    let noise = noise(guard);
    let mut gains = guard.coefficients;
    let gains = gains.get_mut(1..=guard.degree).unwrap_or_default();
    to_bernstein(gains);
    !gains.is_empty() && gains.iter().all(|&term| term > noise)
}

/// The changes of sign of a polynomial to which `more` is added.
fn changes<R: Ordered>(powers: &mut [R], more: R) -> Changes {
    if let Some(first) = powers.first_mut() {
        *first += more;
    }
    to_bernstein(powers);
    let mut count = 0;
    let mut above = powers.first().is_some_and(|&first| first > R::zero());
    for &term in powers.iter() {
        if (term > R::zero()) != above {
            above = !above;
            count += 1;
        }
    }
    match count {
        0 if above => Changes::None,
        0 | 1 => Changes::One,
        // What hovers about the edge of its roundings has not fallen: halves of it would hover as well.
        _ if powers.iter().all(|&term| term > -more) => Changes::None,
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
            if here < -noise || here <= zero && with_slope(polynomial, middle)[1] < zero {
                high = middle;
            } else {
                low = middle;
                if value(rest, middle) > zero {
                    break;
                }
            }
        }
    }
    let place = root(rest, low, high, noise);
    // There the guard is again what it was at the start.
    let slope = place * with_slope(rest, place)[1];
    let correction = start / slope;
    let corrected = place - correction;
    if correction.abs() <= half * place && corrected <= high { corrected } else { place }
}

/// The root between a place where a polynomial is not below zero and one where it is, to the last bit or two.
fn root<R: Ordered>(polynomial: &[R], mut low: R, mut high: R, noise: R) -> R {
    let half = R::from_f64(0.5);
    let (from, to) = (value(polynomial, low), value(polynomial, high));
    if from <= R::zero() {
        return low;
    }
    if to >= R::zero() {
        return high;
    }
    // The chord, then Newton's steps as long as they stay in the bracket and halve.
    let mut place = low + (high - low) * (from / (from - to));
    let mut last = high - low;
    loop {
        let [here, rate] = with_slope(polynomial, place);
        if here.is_zero() {
            return place;
        }
        if here > R::zero() {
            low = place;
        } else {
            high = place;
        }
        let step = -(here / rate);
        let next = place + step;
        let is_good = next > low && next < high && step.abs() <= half * last;
        // Where roundings make the value, they make the step, and no other place is better.
        if !is_good && rate < R::zero() && here.abs() <= noise {
            return place;
        }
        let next = if is_good { next } else { half * (low + high) };
        let moved = (next - place).abs();
        if next <= low || next >= high || moved <= R::epsilon() * place.abs() {
            return if is_good { next } else { place };
        }
        (last, place) = (moved, next);
    }
}

/// The value of a polynomial: odd and even powers side by side, neither of which waits for the other.
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

/// The value of a polynomial and its derivative, likewise.
fn with_slope<R: Ordered>(polynomial: &[R], theta: R) -> [R; 2] {
    let square = theta * theta;
    let (pairs, rest) = polynomial.as_chunks::<2>();
    let mut even = rest.first().copied().unwrap_or(R::zero());
    let [mut odd, mut even_slope, mut odd_slope] = [R::zero(); 3];
    for [low, high] in pairs.iter().rev() {
        even_slope = R::mul_add(even_slope, square, even);
        odd_slope = R::mul_add(odd_slope, square, odd);
        even = R::mul_add(even, square, *low);
        odd = R::mul_add(odd, square, *high);
    }
    // The slopes are those by the square of the argument.
    let slope = R::mul_add(odd_slope, theta, even_slope) * (theta + theta) + odd;
    [R::mul_add(odd, theta, even), slope]
}

/// The part of the interval on which the last terms of a series to this order are less than a `share` of the
/// guard. Every other term of an even or odd function is zero.
pub(crate) fn reach<R: Ordered>(guard: &Taylor<R>, order: usize, share: R) -> R {
    let mut reach = R::one();
    let last = [order, order.saturating_sub(1)].each(|order| {
        let term = guard.coefficients.get(order).copied().unwrap_or(R::zero()).abs();
        (term, order.max(1) as i32)
    });
    // On a shorter part the function is smaller as well: from above, until both agree.
    for _ in 0..AGREED {
        let (size, before) = (size(guard, reach), reach);
        for (term, order) in last {
            if term * reach.powi(order) > share * size {
                reach = (share * size / term).powf(R::from_f64(f64::from(order)).recip());
            }
        }
        if reach >= before {
            break;
        }
    }
    reach
}

/// The part of the interval on which a guard has roundings like those where it starts, which are `own`, by
/// factors of four. Roundings grow with the guard, and with what it is made of.
pub(crate) fn clear<R: Ordered>(guard: &Taylor<R>, own: R) -> R {
    let mut clear = R::one();
    let [first, second, ..] = guard.coefficients.each(Real::abs);
    let drowned = R::from_f64(DROWNED);
    for _ in 0..AGREED {
        // What is nothing but roundings is so on each part of it.
        let shown = larger(drowned * larger(first, second * clear), guard.error);
        if size(guard, clear) <= shown {
            break;
        }
        clear *= R::from_f64(0.25);
    }
    let terms = R::from_f64(guard.degree as f64 + 1.0);
    if clear < R::one() || guard.error <= drowned * terms * (own + R::epsilon() * guard.extent()) {
        return clear;
    }
    R::from_f64(0.25)
}

/// A bound of a guard on a part of the interval.
fn size<R: Ordered>(guard: &Taylor<R>, part: R) -> R {
    guard.terms().iter().rev().fold(R::zero(), |size, term| R::mul_add(size, part, term.abs()))
}

#[cfg(test)]
mod tests;
