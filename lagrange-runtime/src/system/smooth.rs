//! [`Smooth`]: systems whose motion has a Taylor series, and the series.

use crate::linear::Independence;
use crate::number::compensated::add_product;
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::System;

/// A system whose motion is analytic, with the recurrences of its Taylor coefficients.
///
/// The macro proves it: no function with a kink or a jump (absolute value, sign, the root of a speed) stands
/// in the equations of motion. Where one does, use [`Dop853`](crate::Dop853) or a fixed-step method.
#[diagnostic::on_unimplemented(
    message = "the motion of `{Self}` has no Taylor series: a function in its equations has a kink or a jump, or contacts switch \
               them",
    label = "this system is not smooth",
    note = "`simulate(…)` works for every system, `stepper::<Rk4>(…)` and `simulate_with::<Dop853>(…)` for every one without \
            contacts and dry friction"
)]
pub trait Smooth<const N: usize, const K: usize = 0>: System<N, K> {
    /// Whether the mass matrix is factored with pivots that all lanes of a vector share, so that rounding
    /// errors of a lane depend on the others.
    const SHARES_PIVOTS: bool = false;

    /// Values that depend on parameters alone, computed once per run.
    type JetConstants: Copy + core::fmt::Debug;

    /// The coefficients of all factors of products, for expansions to order `P`.
    type Tables<const P: usize>: Copy + Default + core::fmt::Debug;

    /// Evaluates [`Smooth::JetConstants`].
    fn jet_constants(&self) -> Self::JetConstants;

    /// Taylor coefficients of the motion through a state, of the orders 1 to `orders` ≤ `P`, in time scaled
    /// by `h` \[s]: coefficient k is x⁽ᵏ⁾ hᵏ / k!. The inputs are held. False where the equations have no
    /// solution; coefficients are not finite where the equations are not.
    #[allow(clippy::too_many_arguments)]
    fn jet_at<const P: usize>(
        &self,
        constants: &Self::JetConstants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
        h: Self::Scalar,
        orders: usize,
        tables: &mut Self::Tables<P>,
        series: &mut Series<Self::Scalar, N, P>,
    ) -> bool;

    /// Coefficients of reactions and of functions of the state along the series that `tables` belong to, of a
    /// system whose equations switch: of reactions from order zero to the one below that of the series, of
    /// functions from the first order on, the rows of an order side by side.
    #[doc(hidden)]
    fn followed<const P: usize>(_tables: &Self::Tables<P>) -> [&[Self::Scalar]; 2] {
        [&[]; 2]
    }
}

/// Taylor coefficients of coordinates and velocities, of the orders 1 to `P`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Series<R, const N: usize, const P: usize> {
    /// Coefficients of the coordinates; coefficient k stands at k − 1.
    pub q: [[R; N]; P],
    /// Coefficients of the velocities.
    pub v: [[R; N]; P],
    /// How independent the constraints are at the point of expansion.
    pub independence: Independence<R>,
}

impl<R: Real, const N: usize, const P: usize> Default for Series<R, N, P> {
    #[inline]
    fn default() -> Self {
        Self { q: [[R::zero(); N]; P], v: [[R::zero(); N]; P], independence: Independence::clear(0) }
    }
}

impl<R: Real, const N: usize, const P: usize> Series<R, N, P> {
    /// Sets the coefficients of an order from 1 to `P`.
    #[inline(always)]
    pub fn set(&mut self, order: usize, q: [R; N], v: [R; N]) {
        if let (Some(to_q), Some(to_v)) = (self.q.get_mut(order - 1), self.v.get_mut(order - 1)) {
            (*to_q, *to_v) = (q, v);
        }
    }

    /// The changes of coordinates and velocities in `theta` units of the scaled time: the terms of the orders
    /// 1 to `orders`, smallest first.
    #[inline]
    pub fn gain(&self, theta: R, orders: usize) -> ([R; N], [R; N]) {
        let [(q, _), (v, _)] = self.rates(theta, orders, false);
        (array(|i| q[i] * theta), array(|i| v[i] * theta))
    }

    /// The same changes, divided by `theta`, and with `all_digits` what rounding has taken from the last sum.
    /// Horner's scheme runs for odd and even orders side by side, so that neither waits for the other.
    #[inline]
    pub(crate) fn rates(&self, theta: R, orders: usize, all_digits: bool) -> [([R; N], [R; N]); 2] {
        let zero = [R::zero(); N];
        let (mut odd, mut even) = ((zero, zero), (zero, zero));
        let square = theta * theta;
        let add = |to: &mut ([R; N], [R; N]), row_q: &[R; N], row_v: &[R; N]| {
            for i in 0..N {
                to.0[i] = R::mul_add(to.0[i], square, row_q[i]);
                to.1[i] = R::mul_add(to.1[i], square, row_v[i]);
            }
        };
        let (Some([first_q, q @ ..]), Some([first_v, v @ ..])) = (self.q.get(..orders), self.v.get(..orders))
        else {
            return [(zero, zero); 2];
        };
        let ((pairs_q, rest_q), (pairs_v, rest_v)) = (q.as_chunks::<2>(), v.as_chunks::<2>());
        if let ([row_q], [row_v]) = (rest_q, rest_v) {
            add(&mut even, row_q, row_v);
        }
        for ([even_q, odd_q], [even_v, odd_v]) in pairs_q.iter().zip(pairs_v).rev() {
            add(&mut odd, odd_q, odd_v);
            add(&mut even, even_q, even_v);
        }
        let sums = |first: &[R; N], even: &[R; N], odd: &[R; N]| {
            let (mut sums, mut lost) = (*first, zero);
            for i in 0..N {
                // Where both sums cancel, what is left has no errors of theirs.
                let others = R::mul_add(odd[i], theta, even[i]);
                if all_digits {
                    (sums[i], lost[i]) = add_product(first[i], R::zero(), others, theta);
                } else {
                    sums[i] = R::mul_add(others, theta, first[i]);
                }
            }
            (sums, lost)
        };
        [sums(first_q, &even.0, &odd.0), sums(first_v, &even.1, &odd.1)]
    }

    /// Derivatives of the velocities by the scaled time, `theta` units after the point of expansion:
    /// accelerations in units of it. Odd and even orders side by side.
    pub(crate) fn slopes(&self, theta: R, orders: usize) -> [R; N] {
        let (mut odd, mut even) = ([R::zero(); N], [R::zero(); N]);
        let (square, mut order) = (theta * theta, R::from_f64(orders as f64));
        let mut add = |to: &mut [R; N], row: &[R; N]| {
            for i in 0..N {
                to[i] = R::mul_add(to[i], square, order * row[i]);
            }
            order -= R::one();
        };
        let Some((pairs, rest)) = self.v.get(..orders).map(<[_]>::as_chunks::<2>) else { return odd };
        if let [row] = rest {
            add(&mut odd, row);
        }
        for [odd_row, even_row] in pairs.iter().rev() {
            add(&mut even, even_row);
            add(&mut odd, odd_row);
        }
        array(|i| R::mul_add(even[i], theta, odd[i]))
    }

    /// The series about a place `shift` units from the present one: the same polynomials without their values
    /// there. (Knuth, "The Art of Computer Programming", vol. 2, § 4.6.4: repeated synthetic division.)
    pub(crate) fn recentre(&mut self, shift: R, orders: usize) {
        // Two divisions go down to the first order: the one that gives the value, which is not kept, and the
        // one that gives the coefficient of the first order.
        for pass in 0..=orders {
            for k in (pass.saturating_sub(1)..orders.saturating_sub(1)).rev() {
                for rows in [&mut self.q, &mut self.v] {
                    let Some([low, high]) =
                        rows.get_mut(k..k + 2).and_then(|pair| pair.as_chunks_mut().0.first_mut())
                    else {
                        continue;
                    };
                    for i in 0..N {
                        low[i] = R::mul_add(shift, high[i], low[i]);
                    }
                }
            }
        }
    }

    /// The changes of coordinates and velocities in one unit of the scaled time, all orders, smallest terms
    /// first.
    #[inline(always)]
    pub fn sum(&self) -> ([R; N], [R; N]) {
        let (mut q, mut v) = ([R::zero(); N], [R::zero(); N]);
        for (row_q, row_v) in self.q.iter().zip(&self.v).rev() {
            for i in 0..N {
                q[i] += row_q[i];
                v[i] += row_v[i];
            }
        }
        (q, v)
    }
}
