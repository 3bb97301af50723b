//! The tables behind the recurrences of Taylor coefficients. Reached through generated code only.
//!
//! In c\[k] = Σ a\[j] b\[k − j] only the two end terms know coefficients of order k. The interior needs lower
//! orders alone, for every product of a system at once: each product is a lane of two tables, and one sweep
//! over the rows sums all lanes. No lane waits for another, so the sweep runs on vectors of any width. For
//! systems of few products; [`crate::series::columns`] serves those of many.

use crate::number::real::Real;

/// The largest number of lanes whose sums are written out in the code that uses them.
const INLINE: usize = 12;

/// Expansions to no higher order, those of fixed steps, are written out order by order.
const LOW: usize = 8;

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

    /// Σ left\[j] right\[order − j] over 1 < j < order − 1, for all lanes. The outermost terms, of orders
    /// that were just stored, are the caller's.
    #[inline(always)]
    pub fn interior(&self, order: usize) -> [R; L] {
        let rows = order.saturating_sub(2);
        if P <= LOW {
            return self.few(rows);
        }
        if L <= INLINE { self.sweep(rows) } else { self.outlined(rows) }
    }

    /// A function of its own: between scalar code the compiler would take its vectors apart.
    #[inline(never)]
    fn outlined(&self, rows: usize) -> [R; L] {
        self.sweep(rows)
    }

    /// The same sums where their number of terms is known: nothing is added to zero.
    #[inline(always)]
    fn few(&self, rows: usize) -> [R; L] {
        let mut sum = [R::zero(); L];
        for row in 1..rows.min(P) {
            let factors = self.left[row].iter().zip(&self.right[rows - row]);
            for (sum, (&left, &right)) in sum.iter_mut().zip(factors) {
                *sum = if row == 1 { left * right } else { Real::mul_add(left, right, *sum) };
            }
        }
        sum
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
        if size_of::<R>() > size_of::<R::Lane>() {
            // Numbers that are vectors have few registers, and the lanes of the tables are chains enough.
            for (left, right) in left.iter().zip(right.iter().rev()) {
                add(&mut sum, left, right);
            }
            return sum;
        }
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

/// Σ left\[j] right\[order − j] over 0 < j < order. Of each factor the coefficients of the orders 1 and order
/// − 1 are given, the former as [`first`] keeps it.
#[inline(always)]
pub fn convolution<const P: usize, R: Real>(order: usize, left: [R; 2], right: [R; 2], interior: R) -> R {
    match order {
        1 if P <= LOW => R::zero(),
        2 if P <= LOW => left[1] * right[1],
        3 if P <= LOW => Real::mul_add(left[0], right[1], right[0] * left[1]),
        _ => Real::mul_add(left[0], right[1], Real::mul_add(right[0], left[1], interior)),
    }
}

/// [`convolution`] of a factor with itself.
#[inline(always)]
pub fn squared<const P: usize, R: Real>(order: usize, factor: [R; 2], interior: R) -> R {
    match order {
        1 if P <= LOW => R::zero(),
        2 if P <= LOW => factor[1] * factor[1],
        3 if P <= LOW => (factor[0] + factor[0]) * factor[1],
        _ => Real::mul_add(factor[0] + factor[0], factor[1], interior),
    }
}

/// The coefficient of order 1 for the orders after 3. Where an order is not known to the compiler, both
/// outermost terms are added in order 2 as well, where they are the same term: it is kept as half of itself
/// there.
#[inline(always)]
pub fn first<const P: usize, R: Real>(order: usize, first: R, coefficient: R) -> R {
    match order {
        1 if P <= LOW => coefficient,
        1 => R::from_f64(0.5) * coefficient,
        2 if P > LOW => first + first,
        _ => first,
    }
}

#[cfg(test)]
mod tests;
