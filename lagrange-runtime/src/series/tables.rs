//! The tables behind the recurrences of Taylor coefficients. Reached through generated code only.
//!
//! In c\[k] = Σ a\[j] b\[k − j] only the two end terms contain coefficients of order k. The interior needs
//! lower orders alone, for every product of a system at once. The factors of a product are a column of each
//! of two tables, and one sweep over the rows sums all products. No product waits for another, so the sweep
//! runs on vectors of any width. Numbers that are vectors themselves leave nothing to put side by side: there
//! each factor is stored once, and the sweep takes two rows at a time, so that a coefficient is loaded once
//! for all products that it is a factor of. For systems of few products; [`crate::series::columns`] serves
//! those of many.

use core::marker::PhantomData;
use core::ops::Range;

use crate::number::real::Real;

/// The most products whose sums are written out in the code that uses them.
const INLINE: usize = 12;

/// The highest order of expansions that are written out order by order: those of fixed steps.
const LOW: usize = 8;

/// Whether numbers are vectors, or carry other parts.
pub(super) const fn is_wide<R: Real>() -> bool {
    size_of::<R>() > size_of::<R::Lane>()
}

/// The factors of `L` products. Row k − 1 holds their coefficients of order k, for orders 1 to `P`. Where
/// each factor is stored once, the first `L` of them stand in `left` and the others in `right`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Tables<R, const L: usize, const P: usize> {
    left: [[R; L]; P],
    right: [[R; L]; P],
}

impl<R: Real, const L: usize, const P: usize> Default for Tables<R, L, P> {
    #[inline]
    fn default() -> Self {
        Self { left: [[R::zero(); L]; P], right: [[R::zero(); L]; P] }
    }
}

impl<R: Real, const L: usize, const P: usize> Tables<R, L, P> {
    /// Where the factors of an order go.
    #[inline(always)]
    pub fn row(&mut self, order: usize) -> Option<(&mut [R; L], &mut [R; L])> {
        Some((self.left.get_mut(order - 1)?, self.right.get_mut(order - 1)?))
    }

    /// Σ left\[j] right\[order − j] over 1 < j < order − 1, for all products. The outermost terms, of
    /// orders that were just stored, are the caller's.
    #[inline(always)]
    pub fn interior(&self, order: usize) -> [R; L] {
        let rows = order.saturating_sub(2);
        if P <= LOW {
            return self.few(rows);
        }
        if L <= INLINE { self.sweep(rows) } else { self.outlined(rows) }
    }

    /// Σ left\[j] right\[order − j] over 0 < j < order, for all products.
    #[inline(always)]
    pub fn all(&self, order: usize) -> [R; L] {
        let mut sum = self.interior(order);
        let mut add = |row: usize| {
            if let (Some(left), Some(right)) = (self.left.get(row - 1), self.right.get(order - row - 1)) {
                for i in 0..L {
                    sum[i] = Real::mul_add(left[i], right[i], sum[i]);
                }
            }
        };
        if order > 1 {
            add(1);
        }
        if order > 2 {
            add(order - 1);
        }
        sum
    }

    /// A function of its own: between scalar code the compiler would take its vectors apart.
    #[inline(never)]
    fn outlined(&self, rows: usize) -> [R; L] {
        self.sweep(rows)
    }

    /// The interior sums where their number of terms is known: nothing is added to zero. The loop counts an
    /// index. A loop over references stays a loop on graphics processors, and the tables then stay in memory.
    #[inline(always)]
    fn few(&self, rows: usize) -> [R; L] {
        let mut sum = [R::zero(); L];
        for row in 1..rows.min(P) {
            let (left, right) = (&self.left[row], &self.right[rows - row]);
            for i in 0..L {
                sum[i] = if row == 1 { left[i] * right[i] } else { Real::mul_add(left[i], right[i], sum[i]) };
            }
        }
        sum
    }

    /// The sums over the indices 1 to `rows` − 1 and back.
    #[inline(always)]
    fn sweep(&self, rows: usize) -> [R; L] {
        // In a single chain of additions each would wait for the one before it.
        let (mut sum, mut other) = ([R::zero(); L], [R::zero(); L]);
        let (Some(left), Some(right)) = (self.left.get(1..rows), self.right.get(1..rows)) else {
            return sum;
        };
        let add = |sum: &mut [R; L], left: &[R; L], right: &[R; L]| {
            for i in 0..L {
                sum[i] = Real::mul_add(left[i], right[i], sum[i]);
            }
        };
        let ((pairs, rest), (before, back)) = (left.as_chunks::<2>(), right.as_rchunks::<2>());
        for ([left, next], [previous, right]) in pairs.iter().zip(back.iter().rev()) {
            add(&mut sum, left, right);
            add(&mut other, next, previous);
        }
        for (left, right) in rest.iter().zip(before) {
            add(&mut sum, left, right);
        }
        for i in 0..L {
            sum[i] += other[i];
        }
        sum
    }
}

/// How many sums of vectors stay in registers while rows go by: as many as half of sixteen registers hold.
const fn together<R>() -> usize {
    const REGISTER: usize = if cfg!(target_feature = "avx512f") {
        64
    } else if cfg!(target_feature = "avx") {
        32
    } else {
        16
    };
    match size_of::<R>().div_ceil(REGISTER) {
        0 | 1 => 8,
        2 => 4,
        _ => 2,
    }
}

/// Replaces the sums of a group, by a function of the indices of the factors and of the sum. The sums are
/// written out, so that the compiler knows the factors of a product and keeps sums in registers. A loop over
/// products would stay a loop.
#[inline(always)]
fn each<S: Pairs<N>, R: Copy, const N: usize>(
    group: &Range<usize>,
    sums: &mut [R; N],
    next: impl Fn([usize; 2], R) -> R,
) {
    macro_rules! written {
        ($($index:literal)*) => {{
            const { assert!(N <= [$($index),*].len(), "more products than are written out") };
            $(if $index < N && group.start <= $index && $index < group.end {
                sums[$index] = next(S::FACTORS[$index], sums[$index]);
            })*
        }};
    }
    written!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
}

/// The interior sums if each factor is stored once: Σ a\[j] b\[order − j] over 1 < j < order − 1. Each sweep
/// over the rows makes as many of them as stay in registers.
#[inline(always)]
fn shared<S: Pairs<N>, R: Real, const L: usize, const P: usize, const N: usize>(
    tables: &Tables<R, L, P>,
    order: usize,
) -> [R; N] {
    let mut sums = [R::zero(); N];
    macro_rules! groups {
        ($($first:literal)*) => {$(
            if $first < N && $first % together::<R>() == 0 {
                group::<S, R, L, P, N>(tables, &($first..$first + together::<R>()), order, &mut sums);
            }
        )*};
    }
    groups!(0 2 4 6 8 10 12 14);
    sums
}

/// The sums of a group.
#[inline(always)]
fn group<S: Pairs<N>, R: Real, const L: usize, const P: usize, const N: usize>(
    tables: &Tables<R, L, P>,
    group: &Range<usize>,
    order: usize,
    sums: &mut [R; N],
) {
    let rows = 1..order.saturating_sub(2);
    let (Some(left), Some(right)) = (tables.left.get(rows.clone()), tables.right.get(rows)) else { return };
    let half = left.len() / 2;
    let ((left_low, left_high), (right_low, right_high)) = (left.split_at(half), right.split_at(half));
    let mut high = left_high.iter().zip(right_high);
    let of = |(left, right): (&[R; L], &[R; L]), factor: usize| {
        if factor < L { left[factor] } else { right[factor - L] }
    };
    if left.len() % 2 == 1
        && let Some(middle) = high.next()
    {
        each::<S, R, N>(
            group,
            sums,
            #[inline(always)]
            |[a, b], _| of(middle, a) * of(middle, b),
        );
    }
    // From the middle outwards: the row that was written last comes last.
    for (low, high) in left_low.iter().zip(right_low).rev().zip(high) {
        each::<S, R, N>(
            group,
            sums,
            #[inline(always)]
            |[a, b], sum| {
                if a == b {
                    Real::mul_add(of(low, a) + of(low, a), of(high, a), sum)
                } else {
                    Real::mul_add(of(low, a), of(high, b), Real::mul_add(of(high, a), of(low, b), sum))
                }
            },
        );
    }
}

/// One order after another, until `expand` returns false.
#[inline(always)]
pub fn in_turn(orders: usize, mut expand: impl FnMut(usize) -> bool) {
    for order in 1..=orders {
        if !expand(order) {
            break;
        }
    }
}

/// The same, written out for expansions to a low order `P`, those of fixed steps: the compiler then knows
/// each order, keeps in registers what the next one needs, and leaves out what the first ones lack. A loop
/// takes twice as long.
#[inline(always)]
pub fn in_line<const P: usize>(orders: usize, mut expand: impl FnMut(usize) -> bool) {
    macro_rules! each {
        ($($order:literal)*) => {$(
            if $order > P || !expand($order) {
                return;
            }
        )*};
    }
    if P <= LOW {
        each!(1 2 3 4 5 6 7 8);
    } else {
        in_turn(orders, expand);
    }
}

/// h / order. Not h · (1 / order): the rounding of 1/3 would have the same sign in every step, and the energy
/// would drift with the number of steps instead of its root.
#[inline(always)]
pub fn rate<R: Real>(h: R, order: usize) -> R {
    h / R::from_f64(order as f64)
}

/// The order as a number, to divide by: a multiplication by its reciprocal would have the bias of [`rate`].
#[inline(always)]
pub fn index<R: Real>(order: usize) -> R {
    R::from_f64(order as f64)
}

/// μ from κ = rate · μ; zero in a step of no length.
#[inline(always)]
pub fn multiplier<R: Real>(impulse: R, rate: R) -> R {
    if rate == R::zero() { rate } else { impulse / rate }
}

/// The coefficient of time, which is the unit of time in order 1.
#[inline(always)]
pub fn time<R: Real>(h: R, order: usize) -> R {
    if order == 1 { h } else { R::zero() }
}

/// The products of a system with few of them. They are constants of a type: the compiler knows them wherever
/// it puts the code, inlined or not.
pub trait Pairs<const L: usize> {
    /// The indices of the factors of each product. Unoptimised code would have a copy of an array on the
    /// stack for each use of it.
    const FACTORS: &'static [[usize; 2]; L];
}

/// The convolutions of the `L` products `S` of `F` factors. The sweep leaves out their outermost terms, whose
/// coefficients of the first and of the last order are kept here as well: a sweep over a row that was just
/// written would wait for it.
#[derive(Debug)]
pub struct Convolutions<'a, S, R, const F: usize, const L: usize, const W: usize, const P: usize> {
    tables: &'a mut Tables<R, W, P>,
    products: PhantomData<S>,
    /// The coefficients of order 1. In order 2 both outermost terms are the same one. Where the compiler does
    /// not know the order, both are added there, too, so until then these are half of the coefficients.
    first: [R; F],
    /// The coefficients of the last order.
    last: [R; F],
}

impl<'a, S: Pairs<L>, R: Real, const F: usize, const L: usize, const W: usize, const P: usize>
    Convolutions<'a, S, R, F, L, W, P>
{
    /// Before the first order.
    #[inline(always)]
    pub fn new(tables: &'a mut Tables<R, W, P>, _products: S) -> Self {
        Self { tables, products: PhantomData, first: [R::zero(); F], last: [R::zero(); F] }
    }

    /// Σ a\[j] b\[order − j] over 0 < j < order, for all products a b.
    #[inline(always)]
    pub fn sums(&self, order: usize) -> [R; L] {
        let mut sums = [R::zero(); L];
        let interior: &[R] = if is_wide::<R>() {
            &shared::<S, R, W, P, L>(self.tables, order)
        } else {
            &self.tables.interior(order)
        };
        for i in 0..L {
            let [a, b] = S::FACTORS[i];
            let ([first, other], [last, next]) =
                ([self.first[a], self.first[b]], [self.last[a], self.last[b]]);
            sums[i] = match order {
                1 if P <= LOW => R::zero(),
                2 if P <= LOW => last * next,
                3 if P <= LOW && a == b => (first + first) * last,
                3 if P <= LOW => Real::mul_add(first, next, other * last),
                _ if a == b => Real::mul_add(first + first, last, interior[i]),
                _ => Real::mul_add(first, next, Real::mul_add(other, last, interior[i])),
            };
        }
        sums
    }

    /// Takes in the coefficients of all factors of an order.
    #[inline(always)]
    pub fn add(&mut self, order: usize, factors: [R; F]) {
        for (i, &coefficient) in factors.iter().enumerate() {
            let first = &mut self.first[i];
            *first = match order {
                1 if P <= LOW => coefficient,
                1 => R::from_f64(0.5) * coefficient,
                2 if P > LOW => *first + *first,
                _ => *first,
            };
        }
        self.last = factors;
        let Some((left, right)) = self.tables.row(order) else { return };
        if is_wide::<R>() {
            for (to, &coefficient) in left.iter_mut().chain(right).zip(&factors) {
                *to = coefficient;
            }
        } else {
            for (i, &[a, b]) in S::FACTORS.iter().enumerate() {
                (left[i], right[i]) = (factors[a], factors[b]);
            }
        }
    }
}

#[cfg(test)]
mod tests;
