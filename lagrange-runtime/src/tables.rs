//! The tables behind the recurrences of Taylor coefficients. Reached through generated code only.
//!
//! In c\[k] = Σ a\[j] b\[k − j] only the two end terms know coefficients of order k. The interior needs lower orders
//! alone, for every product of a system at once: each product is a lane of two tables, and one sweep over the rows
//! sums all lanes. No lane waits for another, so the sweep runs on vectors of any width.

use crate::real::Real;

/// So many lanes are summed in the middle of the code that uses them.
const INLINE: usize = 12;

/// So many lanes are summed in one loop: as many as the registers of common vector units hold.
const TOGETHER: usize = 40;

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

    /// Σ left\[j] right\[order − j] over `EDGE` < j < order − `EDGE`, for all lanes.
    #[inline(always)]
    pub fn interior<const EDGE: usize>(&self, order: usize) -> [R; L] {
        let rows = order.saturating_sub(1 + EDGE);
        let mut sums = [R::zero(); L];
        if L <= INLINE {
            self.sweep::<EDGE, L>(rows, 0, &mut sums);
        } else {
            self.outlined::<EDGE>(rows, &mut sums);
        }
        sums
    }

    /// A function of its own: between scalar code the compiler would take its vectors apart.
    #[inline(never)]
    fn outlined<const EDGE: usize>(&self, rows: usize, sums: &mut [R; L]) {
        if L <= TOGETHER {
            return self.sweep::<EDGE, L>(rows, 0, sums);
        }
        let mut done = 0;
        macro_rules! blocks {
            ($($width:literal)*) => {$(
                while done + $width <= L {
                    self.sweep::<EDGE, $width>(rows, done, sums);
                    done += $width;
                }
            )*};
        }
        blocks!(32 16 8 4);
    }

    /// The sums of `W` lanes from the lane `first` on, over the indices `EDGE` to `rows` − 1 and back.
    #[inline(always)]
    fn sweep<const EDGE: usize, const W: usize>(&self, rows: usize, first: usize, sums: &mut [R; L]) {
        let mut sum = [R::zero(); W];
        let (Some(left), Some(right)) = (self.left.get(EDGE..rows), self.right.get(EDGE..rows)) else {
            return;
        };
        let add = |sum: &mut [R; W], left: &[R; L], right: &[R; L]| {
            if let (Some(left), Some(right)) = (left.get(first..first + W), right.get(first..first + W)) {
                for i in 0..W {
                    sum[i] = Real::mul_add(left[i], right[i], sum[i]);
                }
            }
        };
        if W <= INLINE {
            // Few lanes are few chains of additions, which would wait for themselves.
            let mut other = [R::zero(); W];
            let ((pairs, rest), (before, back)) = (left.as_chunks::<2>(), right.as_rchunks::<2>());
            for ([left, next], [previous, right]) in pairs.iter().zip(back.iter().rev()) {
                add(&mut sum, left, right);
                add(&mut other, next, previous);
            }
            for (left, right) in rest.iter().zip(before) {
                add(&mut sum, left, right);
            }
            for i in 0..W {
                sum[i] += other[i];
            }
        } else {
            for (left, right) in left.iter().zip(right.iter().rev()) {
                add(&mut sum, left, right);
            }
        }
        for (to, from) in sums.iter_mut().skip(first).zip(sum) {
            *to = from;
        }
    }
}

/// h / order. Not h · (1 / order): the rounding of 1/3 would have the same sign in every step, and the energy would
/// drift with the number of steps instead of its root.
#[inline(always)]
pub fn rate<R: Real>(h: R, order: usize) -> R {
    h / R::from_f64(order as f64)
}

/// 1 / order.
#[inline(always)]
pub fn fraction<R: Real>(order: usize) -> R {
    R::recip(R::from_f64(order as f64))
}

/// order · coefficient.
#[inline(always)]
pub fn ramp<R: Real>(order: usize, coefficient: R) -> R {
    R::from_f64(order as f64) * coefficient
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
