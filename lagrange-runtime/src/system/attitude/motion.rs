//! Motions with angular velocities ω, of which states hold the rates ρ′ of parameters. Reached through
//! generated code only.
//!
//! ρ′ = N ω with N = (1 − s) + ½ \[ρ]ₓ + ⅛ ρ ρᵀ and s = |ρ|²/16, where N Nᵀ = (1 + s)².

use super::{cross, dot, rates_at, spin, square, triple};
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::series::tables::{Tables, in_line, rate};
use crate::system::smooth::Series;

/// The matrix of an orientation: columns are the body axes in space axes.
#[inline]
#[must_use]
pub fn axes<R: Real, const N: usize>(q: &[R; N], first: usize) -> [[R; 3]; 3] {
    let rho = triple(q, first);
    let s = square(rho) * R::from_f64(1.0 / 16.0);
    let reciprocal = R::one() / (R::one() + s);
    let scale = R::from_f64(0.5) * reciprocal;
    let [x, y, z] = rho.each(|component| scale * component);
    let w = (R::one() - s) * reciprocal;
    let two = R::from_f64(2.0);
    let [xx, yy, zz] = [x, y, z].each(|component| two * component * component);
    let [xy, yz, zx] = [two * x * y, two * y * z, two * z * x];
    let [wx, wy, wz] = [two * w * x, two * w * y, two * w * z];
    [
        [R::one() - (yy + zz), xy - wz, zx + wy],
        [xy + wz, R::one() - (zz + xx), yz - wx],
        [zx - wy, yz + wx, R::one() - (xx + yy)],
    ]
}

/// The velocities with angular velocities in the places of rates.
#[inline]
#[must_use]
pub fn turning<R: Real, const N: usize, const O: usize>(
    q: &[R; N],
    v: &[R; N],
    orientations: [usize; O],
) -> [R; N] {
    let mut turning = *v;
    for first in orientations {
        put(&mut turning, first, spin(triple(q, first), triple(v, first)));
    }
    turning
}

/// ρ″ = N ω′ + N′ ω in the places of ω′, from ρ′ and ω.
#[inline]
#[must_use]
pub fn accelerations<R: Real, const N: usize, const O: usize>(
    q: &[R; N],
    v: &[R; N],
    turning: &[R; N],
    mut accelerations: [R; N],
    orientations: [usize; O],
) -> [R; N] {
    let (half, eighth) = (R::from_f64(0.5), R::from_f64(0.125));
    for first in orientations {
        let (rho, rates, omega) = (triple(q, first), triple(v, first), triple(turning, first));
        let own = rates_at(rho, triple(&accelerations, first));
        let along = [dot(rho, rates), dot(rho, omega), dot(rates, omega)].each(|product| product * eighth);
        let turned = cross(rates, omega);
        let second = array(|i| {
            own[i] + (half * turned[i] + (rates[i] * along[1] + rho[i] * along[2]) - omega[i] * along[0])
        });
        put(&mut accelerations, first, second);
    }
    accelerations
}

#[inline(always)]
fn put<R: Copy, const N: usize>(numbers: &mut [R; N], first: usize, triple: [R; 3]) {
    if let Some(place) = numbers.get_mut(first..first + 3) {
        place.copy_from_slice(&triple);
    }
}

/// The coefficients of ρ and ρ′ in a series that has those of ω in the places of ρ′; those of order 0 are
/// given.
#[inline]
pub fn complete<R: Real, const N: usize, const P: usize, const O: usize>(
    series: &mut Series<R, N, P>,
    orders: usize,
    h: R,
    q: &[R; N],
    turning: &[R; N],
    orientations: [usize; O],
) {
    for first in orientations {
        complete_one(series, orders, h, (triple(q, first), triple(turning, first)), first);
    }
}

/// The products of an order, four in a row: s ω and s a, both halves of ρ × ω, the terms of ρ·ω, each with a
/// component of ρ a, where a = ⅛ ρ·ω and s′ = (1 + s) a.
const PRODUCTS: usize = 16;

fn left<R: Real>([x, y, z]: [R; 3], s: R) -> [R; PRODUCTS] {
    [s, s, s, s, y, z, x, x, z, x, y, y, x, y, z, z]
}

fn right<R: Real>([x, y, z]: [R; 3], a: R) -> [R; PRODUCTS] {
    [x, y, z, a, z, x, y, a, y, z, x, a, x, y, z, a]
}

#[inline]
fn complete_one<R: Real, const N: usize, const P: usize>(
    series: &mut Series<R, N, P>,
    orders: usize,
    h: R,
    (mut rho, mut omega): ([R; 3], [R; 3]),
    first: usize,
) {
    let (half, eighth) = (R::from_f64(0.5), R::from_f64(0.125));
    let mut s = square(rho) * R::from_f64(1.0 / 16.0);
    let mut a = dot(rho, omega) * eighth;
    let (left_start, right_start) = (left(rho, s), right(omega, a));
    let (mut flow, mut growth) = (rates_at(rho, omega), a + s * a);
    let mut tables = Tables::<R, PRODUCTS, P>::default();
    in_line::<P>(
        orders,
        #[inline(always)]
        |order| {
            let rate = rate(h, order);
            (rho, s) = (flow.each(|flow| rate * flow), rate * growth);
            let (Some(to_q), Some(to_v)) = (series.q.get_mut(order - 1), series.v.get_mut(order - 1)) else {
                return false;
            };
            put(to_q, first, rho);
            omega = triple(to_v, first);
            let (left_end, right_end) = (left(rho, s), right(omega, R::zero()));
            let mut sums = tables.all(order);
            for i in 0..PRODUCTS {
                sums[i] = R::mul_add(left_start[i], right_end[i], sums[i]);
                sums[i] = R::mul_add(left_end[i], right_start[i], sums[i]);
            }
            a = (sums[12] + sums[13] + sums[14]) * eighth;
            let by_a = [3, 7, 11, 15].each(|i: usize| R::mul_add(left_start[i], a, sums[i]));
            flow = array(|i| omega[i] + (half * (sums[4 + i] - sums[8 + i]) + (by_a[1 + i] - sums[i])));
            growth = a + by_a[0];
            put(to_v, first, flow);
            if let Some((to_left, to_right)) = tables.row(order) {
                (*to_left, *to_right) = (left_end, right(omega, a));
            }
            true
        },
    );
}

#[cfg(test)]
mod tests {
    use nalgebra::{UnitQuaternion, Vector3};

    use super::super::{parameters, rates, rotation};
    use super::*;

    /// Orientations up to half a turn with angular velocities, as coordinates 1 to 3 of four.
    fn states() -> impl Iterator<Item = ([f64; 4], [f64; 3])> {
        (0..60).map(|i| {
            let x = f64::from(i);
            let turn = Vector3::new((1.3 * x).sin(), (2.1 * x).cos(), (0.7 * x).sin()) * 0.029 * x;
            let [a, b, c] = parameters(&UnitQuaternion::new(turn));
            ([7.0, a, b, c], [(0.9 * x).cos(), 1.2 * (1.7 * x).sin(), -0.4])
        })
    }

    fn with_rates(q: &[f64; 4], omega: [f64; 3]) -> [f64; 4] {
        let [a, b, c] = rates([q[1], q[2], q[3]], &omega.into());
        [5.0, a, b, c]
    }

    #[test]
    fn axes_are_the_rotation() {
        for (q, _) in states() {
            let expected = rotation([q[1], q[2], q[3]]).to_rotation_matrix();
            let found = axes(&q, 1);
            for (row, entries) in found.iter().enumerate() {
                for (column, entry) in entries.iter().enumerate() {
                    assert!((entry - expected[(row, column)]).abs() < 1e-15, "{found:?} {expected}");
                }
            }
        }
    }

    #[test]
    fn angular_velocities_are_those_of_the_rates() {
        for (q, omega) in states() {
            let found = turning(&q, &with_rates(&q, omega), [1]);
            let expected = [5.0, omega[0], omega[1], omega[2]];
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-15), "{found:?} {expected:?}");
        }
    }

    /// Beside a difference of the rates along ρ + τ ρ′ and ω + τ ω′.
    #[test]
    fn accelerations_are_those_of_the_parameters() {
        let (change, tau) = ([0.6, -0.2, 1.1], 1e-5);
        for (q, omega) in states() {
            let v = with_rates(&q, omega);
            let at = |tau: f64| {
                let q: [f64; 4] = core::array::from_fn(|i| q[i] + tau * v[i]);
                with_rates(&q, core::array::from_fn(|i| omega[i] + tau * change[i]))
            };
            let (after, before) = (at(tau), at(-tau));
            let spin = [5.0, omega[0], omega[1], omega[2]];
            let found = accelerations(&q, &v, &spin, [3.0, change[0], change[1], change[2]], [1]);
            assert_eq!(found[0], 3.0);
            for i in 1..4 {
                let expected = (after[i] - before[i]) / (2.0 * tau);
                assert!((found[i] - expected).abs() < 1e-9, "{found:?} {expected}");
            }
        }
    }

    /// A steady turn, R exp(t \[ω]ₓ): the sum of the series is the parameters of that.
    #[test]
    fn a_steady_turn_has_the_series_of_its_parameters() {
        const ORDERS: usize = 24;
        let h = 0.25;
        for (q, omega) in states() {
            let mut series = Series::<f64, 4, ORDERS>::default();
            for order in 1..=ORDERS {
                series.set(order, [1.0, 9.0, 9.0, 9.0], [2.0, 0.0, 0.0, 0.0]);
            }
            complete(&mut series, ORDERS, h, &q, &[5.0, omega[0], omega[1], omega[2]], [1]);
            let v = with_rates(&q, omega);
            let (gain_q, gain_v) = series.gain(1.0, ORDERS);
            assert_eq!(gain_q[0], ORDERS as f64, "numbers that are none of an orientation stay");
            let turn = rotation([q[1], q[2], q[3]]) * UnitQuaternion::new(Vector3::from(omega) * h);
            // The triple that goes on from the present one.
            let expected = parameters(&turn);
            let expected_rates = rates(expected, &omega.into());
            let square: f64 = expected.iter().map(|x| x * x).sum();
            if square > 15.0 {
                continue;
            }
            for i in 0..3 {
                assert!((q[i + 1] + gain_q[i + 1] - expected[i]).abs() < 1e-13, "{gain_q:?} {expected:?}");
                assert!((v[i + 1] + gain_v[i + 1] - expected_rates[i]).abs() < 1e-12, "{gain_v:?}");
            }
        }
    }
}
