//! Motions with angular velocities ω, of which states hold the rates ρ′ of parameters. Reached through
//! generated code only.
//!
//! ρ′ = N ω with N = (1 − s) + ½ \[ρ]ₓ + ⅛ ρ ρᵀ and s = |ρ|²/16, where N Nᵀ = (1 + s)².

use super::{cross, dot, rates_at, spin, square, triple};
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
    let [x, y, z] = rho.map(|component| scale * component);
    let w = (R::one() - s) * reciprocal;
    let two = R::from_f64(2.0);
    let [xx, yy, zz] = [x, y, z].map(|component| two * component * component);
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
        let along = [dot(rho, rates), dot(rho, omega), dot(rates, omega)].map(|product| product * eighth);
        let turned = cross(rates, omega);
        let second = core::array::from_fn(|i| {
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

/// The coefficients of ρ and ρ′ in a series that has those of ω in the places of ρ′; those of order 0 are given.
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
            (rho, s) = (flow.map(|flow| rate * flow), rate * growth);
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
            let by_a = [3, 7, 11, 15].map(|i: usize| R::mul_add(left_start[i], a, sums[i]));
            flow = core::array::from_fn(|i| {
                omega[i] + (half * (sums[4 + i] - sums[8 + i]) + (by_a[1 + i] - sums[i]))
            });
            growth = a + by_a[0];
            put(to_v, first, flow);
            if let Some((to_left, to_right)) = tables.row(order) {
                (*to_left, *to_right) = (left_end, right(omega, a));
            }
            true
        },
    );
}
