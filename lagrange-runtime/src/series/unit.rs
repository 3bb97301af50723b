//! [`TimeUnit`]: the unit of time in which the coefficients of a series are numbers.

use crate::number::real::Real;

/// The unit of time \[s] of a series: coefficient k is x⁽ᵏ⁾ hᵏ / k!.
pub trait TimeUnit<R>: Copy {
    /// The unit itself, with the direction of time.
    fn length(self) -> R;

    /// The unit divided by an order.
    fn over(self, order: usize) -> R;
}

/// Any length, such as that of a step that the caller chose.
impl<R: Real> TimeUnit<R> for R {
    #[inline(always)]
    fn length(self) -> R {
        self
    }

    /// h / order. Not h · (1 / order): the rounding of 1/3 would have the same sign in every step, and the
    /// energy would drift with the number of steps instead of its root.
    #[inline(always)]
    fn over(self, order: usize) -> R {
        self / R::from_f64(order as f64)
    }
}

/// A power of two. Products with it have no rounding errors, so that neither coefficients nor places in a
/// step have any of the unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Binade<R> {
    /// The power of two, with the direction of time.
    pub(crate) power: R,
    /// From −1 to 1, in every step another one: which of the two numbers around 1 / order is taken. Always
    /// the nearer one would let the energy drift with the number of steps.
    pub(crate) dither: R,
}

impl<R: Real> TimeUnit<R> for Binade<R> {
    #[inline(always)]
    fn length(self) -> R {
        self.power
    }

    #[inline(always)]
    fn over(self, order: usize) -> R {
        self.power.over_order(order, self.dither)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean over steps is the exact quotient: no order has a bias, and powers of two have no error.
    #[test]
    fn quotients_by_orders_have_no_bias() {
        fn check<R: Real + Into<f64>>() {
            let steps = 1 << 16;
            for order in 1..=super::super::HIGHEST {
                let (mut sum, mut worst) = (0.0, 0.0_f64);
                for step in 0..steps {
                    let dither = R::from_f64((2 * step + 1 - steps) as f64 / steps as f64);
                    let unit = Binade { power: R::from_f64(-0.25), dither };
                    let quotient: f64 = -4.0 * unit.over(order).into();
                    let missing = -quotient.mul_add(order as f64, -1.0) / order as f64;
                    sum += missing;
                    worst = worst.max(missing.abs());
                }
                let ulp = R::epsilon().into() / order as f64;
                assert!(worst <= ulp, "{order}: {worst:e}");
                assert!((sum / steps as f64).abs() <= ulp / steps as f64, "{order}: {:e}", sum / ulp);
                assert!(!order.is_power_of_two() || worst == 0.0, "{order}");
            }
        }
        check::<f64>();
        check::<f32>();
    }
}
