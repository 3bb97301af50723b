//! The tolerance of each number in a step of Dormand–Prince 8(5,3), and the norm of the error of a step.
//!
//! The tolerance of a number is absolute + relative · size. Its size is the largest that it has, or that its
//! derivatives make of it, in the step: |q|, h|v| and h²|a| for a coordinate, |v| and h|a| for a velocity. So
//! a number that passes through zero is compared with its motion, and units do not matter.
//!
//! Two errors stay in proportion to the motion in steps of any length: those of accelerations that are
//! nothing but rounding errors, and those of jumps. [`unavoidable`](super::unavoidable) finds them; they do
//! not count. Hairer, Nørsett, Wanner, "Solving ODEs I", 2nd ed., II.4.

use num_traits::Zero;

use super::super::Field;
use super::super::slopes::Slope;
use super::super::step_size;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger};
use crate::system::limits::Limits;
use crate::system::state::{State, difference};

/// A step that has been tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tried<'a, R, const N: usize> {
    pub from: &'a State<R, N>,
    pub to: &'a State<R, N>,
    /// Slope at `from`.
    pub slope: &'a Slope<R, N>,
    /// Length of the step \[s], with its sign.
    pub h: R,
    /// Estimated errors of the mean slope, of orders 5 and 3.
    pub estimates: [&'a Slope<R, N>; 2],
}

impl<R: Ordered, const N: usize> Tried<'_, R, N> {
    /// The error of the step in tolerances, without the `unavoidable` errors of the coordinates and of the
    /// velocities. It is not finite where a number of the step is not.
    #[inline]
    pub fn error(&self, limits: &Limits<R>, unavoidable: &[[R::Lane; N]; 2]) -> R {
        let mut error = R::zero();
        for part in 0..R::PARTS {
            let of_part = R::splat(self.error_of(part, limits, unavoidable));
            if !of_part.is_finite() {
                return of_part;
            }
            error = larger(error, of_part);
        }
        error
    }

    /// The same of a step whose end is moved onto the constraints afterwards.
    ///
    /// That removes errors across the constraints. Their effect along the constraints is of second order, so
    /// they may have half of the digits. Accelerations across constraints that pin a coordinate are nothing
    /// but rounding errors.
    #[cold]
    pub fn projected_error<F: Field<R, N>>(
        &self,
        f: &F,
        limits: &Limits<R>,
        unavoidable: &[[R::Lane; N]; 2],
    ) -> R {
        let along = self.estimates.each(|estimate| f.along(self.to, *estimate));
        let across: [_; 2] = array(|i| Slope {
            q: difference(&self.estimates[i].q, &along[i].q),
            v: difference(&self.estimates[i].v, &along[i].v),
        });
        let half = Limits { relative: larger(limits.relative, R::epsilon()).sqrt(), ..*limits };
        let parts = [(along, limits), (across, &half)];
        let [along, across] = parts.each(|([fifth, third], limits)| {
            Tried { estimates: [&fifth, &third], ..*self }.error(limits, unavoidable)
        });
        // `larger` returns the second of two that cannot be compared.
        if along.is_finite() { larger(along, across) } else { along }
    }

    /// The error of the values, or of one of their derivatives, in tolerances: h e₅² / √(e₅² + 0.01 e₃²), of
    /// order h⁸, where e₅ and e₃ are root mean squares of the estimates of all numbers.
    #[inline]
    fn error_of(&self, part: usize, limits: &Limits<R>, unavoidable: &[[R::Lane; N]; 2]) -> R::Lane {
        let of = |x: R| x.part(part).largest();
        let h = self.length();
        let tolerances = self.tolerances(part, limits);
        let [fifth, third] = self.estimates.each(|estimate| [&estimate.q, &estimate.v]);
        let (mut sum5, mut sum3) = (R::Lane::zero(), R::Lane::zero());
        for n in 0..N {
            for k in 0..2 {
                let mut error = h * of(fifth[k][n]).abs();
                if part == 0 {
                    // `larger` returns the second of two that cannot be compared, so NaN stays.
                    error = larger(R::Lane::zero(), error - unavoidable[k][n]);
                }
                if error.is_positive() || !error.is_finite() {
                    let (fifth, third) = (error / tolerances[k][n], h * of(third[k][n]) / tolerances[k][n]);
                    sum5 += fifth * fifth;
                    sum3 += third * third;
                }
            }
        }
        step_size::error(sum5, sum3, 2 * N)
    }

    /// Tolerated errors of coordinates and of velocities.
    #[inline]
    fn tolerances(&self, part: usize, limits: &Limits<R>) -> [[R::Lane; N]; 2] {
        let of = |x: R| x.part(part).largest().abs();
        let h = self.length();
        let sizes: [_; N] = array(|n| {
            let turn = h * of(self.slope.v[n]);
            let way = h * larger(of(self.slope.q[n]), turn);
            let [from, to] = [self.from, self.to];
            let size = larger(larger(of(from.q[n]), of(to.q[n])), way);
            (size, larger(larger(of(from.v[n]), of(to.v[n])), turn))
        });
        let sizes = [sizes.each(|(q, _)| q), sizes.each(|(_, v)| v)];
        let relative = relative(limits);
        let given = limits.absolute.map(Real::largest);
        sizes.each(|sizes| {
            let absolute = if part == 0 {
                given.unwrap_or_else(R::Lane::zero)
            } else {
                // The equations of derivatives are linear and have no scale, so an error of one is relative
                // to the whole of its column.
                let whole = sizes.iter().fold(R::Lane::zero(), |most, &size| larger(most, size));
                given.unwrap_or(relative) * whole
            };
            sizes.each(|size| larger(absolute, step_size::least()) + relative * size)
        })
    }

    /// The length of the step without its sign.
    #[inline]
    pub fn length(&self) -> R::Lane {
        self.h.largest().abs()
    }
}

/// The relative tolerance; below rounding it means rounding.
#[inline]
pub(super) fn relative<R: Ordered>(limits: &Limits<R>) -> R::Lane {
    larger(limits.relative, R::epsilon()).largest()
}

#[cfg(test)]
mod tests;
