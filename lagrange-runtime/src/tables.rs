//! The tables behind the recurrences of Taylor coefficients. Reached through generated code only.
//!
//! In c\[k] = Σ a\[j] b\[k − j] only the two end terms know coefficients of order k. The interior needs lower orders
//! alone, for every product of a system at once: each product is a lane of two tables, and one sweep over the rows
//! sums all lanes. No lane waits for another, so the sweep runs on vectors of any width. For systems of few products;
//! [`crate::columns`] serves those of many.

use crate::real::Real;

/// So many lanes are summed in the middle of the code that uses them.
const INLINE: usize = 12;

/// Factors of `L` products, coefficients of the orders 1 to `P` (at the index before).
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

    /// Σ left\[j] right\[order − j] over 1 < j < order − 1, for all lanes. The outermost terms, of orders that were just
    /// stored, are the caller's.
    #[inline(always)]
    pub fn interior(&self, order: usize) -> [R; L] {
        let rows = order.saturating_sub(2);
        if L <= INLINE { self.sweep(rows) } else { self.outlined(rows) }
    }

    /// A function of its own: between scalar code the compiler would take its vectors apart.
    #[inline(never)]
    fn outlined(&self, rows: usize) -> [R; L] {
        self.sweep(rows)
    }

    /// The sums over the indices 1 to `rows` − 1 and back.
    #[inline(always)]
    fn sweep(&self, rows: usize) -> [R; L] {
        // One chain of additions for each lane would wait for itself.
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

/// One order after another, until one says that it was the last.
#[inline(always)]
pub fn in_turn(orders: usize, mut expand: impl FnMut(usize) -> bool) {
    for order in 1..=orders {
        if !expand(order) {
            break;
        }
    }
}

/// The same, written out for expansions to a low order `P`, those of fixed steps: the compiler then knows each order,
/// keeps in registers what the next one needs, and leaves out what the first ones lack. A loop takes twice as long.
#[inline(always)]
pub fn in_line<const P: usize>(orders: usize, mut expand: impl FnMut(usize) -> bool) {
    macro_rules! each {
        ($($order:literal)*) => {$(
            if $order > P || !expand($order) {
                return;
            }
        )*};
    }
    if P <= 8 {
        each!(1 2 3 4 5 6 7 8);
    } else {
        in_turn(orders, expand);
    }
}

/// h / order. Not h · (1 / order): the rounding of 1/3 would have the same sign in every step, and the energy would
/// drift with the number of steps instead of its root.
#[inline(always)]
pub fn rate<R: Real>(h: R, order: usize) -> R {
    h / R::from_f64(order as f64)
}

/// The order as a number, to divide by: a multiplication by its reciprocal would have the bias of [`rate`].
#[inline(always)]
pub fn index<R: Real>(order: usize) -> R {
    R::from_f64(order as f64)
}

/// order · coefficient.
#[inline(always)]
pub fn ramp<R: Real>(order: usize, coefficient: R) -> R {
    R::from_f64(order as f64) * coefficient
}

/// μ from κ = rate · μ; zero in a step of no length.
#[inline(always)]
pub fn multiplier<R: Real>(impulse: R, rate: R) -> R {
    if rate == R::zero() { rate } else { impulse / rate }
}

/// The coefficient of order 1 from order 3 on; in order 2, where both ends of the interior are the same term, half of it.
#[inline(always)]
pub fn first<R: Real>(order: usize, first: R, coefficient: R) -> R {
    match order {
        1 => R::from_f64(0.5) * coefficient,
        2 => first + first,
        _ => first,
    }
}

#[cfg(test)]
mod tests;
