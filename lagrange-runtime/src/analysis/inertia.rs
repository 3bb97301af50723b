//! What a model tells about itself: inertia forces by origin, Christoffel symbols, Legendre's transformation.
//!
//! Generated methods of a system with `analysis` in its attribute return [`InertiaForces`] and call the
//! functions here.

use nalgebra::SMatrix;
use num_traits::{One, Zero};

use crate::linear::stored::Stored;
use crate::linear::{Ldlt, Lu};
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::System;
use crate::system::error::{Cause, MotionError};
use crate::system::name::Name;
use crate::system::state::State;

/// Generalized inertia forces −(d/dt ∂T/∂v − ∂T/∂q), by their origin: T = T₂ + T₁ + T₀ with T₂ = ½ vᵀM
/// v and T₁ = g·v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InertiaForces<R, const N: usize> {
    /// −M a.
    pub relative: [R; N],
    /// The contribution of T₂ without accelerations: −Σ \[ij, k] vᵢ vⱼ − ∂M/∂t v, centrifugal and Coriolis
    /// forces of the coordinates.
    pub coriolis: [R; N],
    /// −G v from T₁, with the skew G = ∂g/∂q − (∂g/∂q)ᵀ: Coriolis forces of a moving frame, and magnetic
    /// forces; they do no work.
    pub gyroscopic: [R; N],
    /// ∂T₀/∂q − ∂g/∂t: centrifugal forces of a moving frame, and those of its acceleration.
    pub transport: [R; N],
}

impl<R: Real, const N: usize> InertiaForces<R, N> {
    /// All of them together: what balances applied forces, −∂V/∂q and reactions.
    #[inline]
    #[must_use]
    pub fn total(&self) -> [R; N] {
        array(|i| self.relative[i] + self.coriolis[i] + self.gyroscopic[i] + self.transport[i])
    }
}

/// Refuses negative masses in statics, where masses of zero do no harm.
///
/// The mass matrix of solvable equations of motion may have any signature. If they are not solvable, M + √ε
/// diag M, with ones for zeros of the diagonal, tells a negative mass from a missing one.
///
/// # Errors
/// [`Cause::SingularMassMatrix`] with the coordinate.
pub(super) fn refuse_negative<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    mass: impl FnOnce() -> Stored<[[S::Scalar; N]; N]>,
) -> Result<(), Cause> {
    let State { t, q, v } = state;
    let Err(Cause::SingularMassMatrix { name, .. }) = system.check_at(constants, *t, q, v) else {
        return Ok(());
    };
    let mass = mass();
    let diagonal =
        |x: S::Scalar| if x.is_zero() { S::Scalar::one() } else { S::Scalar::epsilon().sqrt() * x };
    let mut shifted = *mass;
    for (i, row) in shifted.iter_mut().enumerate() {
        row[i] += diagonal(row[i]);
    }
    let found = Ldlt::<S::Scalar, N>::factor(shifted);
    found.map(|_| ()).map_err(|pivot| Cause::SingularMassMatrix { pivot, name }.named(&S::NAMES))
}

/// Symbols symmetric in their last two indices, from those with j ≤ i.
#[inline]
pub fn symmetric<R: Real, const N: usize>(symbols: [[[R; N]; N]; N]) -> [[[R; N]; N]; N] {
    symbols.each(|given| array(|i| array(|j| given[i.max(j)][i.min(j)])))
}

/// Christoffel symbols of the second kind from those of the first.
///
/// # Errors
/// [`Cause::SingularMassMatrix`] with the coordinate, at time `t`.
pub fn second_kind<R: Real, const N: usize>(
    mass: &SMatrix<R, N, N>,
    first: &[[[R; N]; N]; N],
    t: R,
) -> Result<[[[R; N]; N]; N], MotionError<R>> {
    // M is symmetric, so its columns are its rows.
    let factors = Lu::<R, N>::factor(mass.data.0)
        .map_err(|pivot| MotionError { cause: Cause::SingularMassMatrix { pivot, name: Name::NONE }, t })?;
    let mut second = [[[R::zero(); N]; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let raised = factors.solve(array(|k| first[k][i][j]));
            for k in 0..N {
                (second[k][i][j], second[k][j][i]) = (raised[k], raised[k]);
            }
        }
    }
    Ok(second)
}

/// The most corrections. A regular Legendre transformation takes fewer.
const CORRECTIONS: usize = 60;

/// The most halvings of a correction that goes too far.
const HALVINGS: usize = 40;

/// The velocities at which momenta have the values `p`; `at` gives ∂p/∂v (its lower triangle) and p. Newton's
/// method from rest, with corrections halved while they lead to larger residuals; one step where p is affine
/// in v.
///
/// # Errors
/// [`Cause::SingularMassMatrix`], [`Cause::NotFinite`], or [`Cause::NoVelocities`] where none are found.
pub fn velocities<R: Real, const N: usize>(
    at: impl Fn(&[R; N]) -> ([[R; N]; N], [R; N]),
    t: R,
    p: &[R; N],
    affine: bool,
) -> Result<[R; N], MotionError<R>> {
    let error = |cause| MotionError { cause, t };
    let mut v = [R::zero(); N];
    let (mut slopes, mut momenta) = at(&v);
    let mut size = distance(p, &momenta);
    for _ in 0..CORRECTIONS {
        let full = array(|i: usize| array(|j: usize| slopes[i.max(j)][i.min(j)]));
        let factors =
            Lu::factor(full).map_err(|pivot| error(Cause::SingularMassMatrix { pivot, name: Name::NONE }))?;
        let correction = factors.solve(array(|i| p[i] - momenta[i]));
        if affine {
            return finite(correction).ok_or(error(Cause::NotFinite));
        }
        let mut share = R::one();
        let mut improved = false;
        for _ in 0..HALVINGS {
            let next: [R; N] = array(|i| R::mul_add(share, correction[i], v[i]));
            let (next_slopes, next_momenta) = at(&next);
            let next_size = distance(p, &next_momenta);
            if next_momenta.iter().all(|p| p.is_finite()) && next_size < size {
                (v, slopes, momenta, size) = (next, next_slopes, next_momenta, next_size);
                improved = true;
                break;
            }
            share *= R::from_f64(0.5);
        }
        // The search ends well where what is left is a rounding error of the momenta, or of the velocities.
        let sum = |values: &[R; N]| values.iter().fold(R::zero(), |sum, &x| sum + x.abs());
        let rounding = R::epsilon() * R::from_f64(64.0);
        let settled = size <= (sum(p) * rounding).largest()
            || sum(&correction).largest() <= (sum(&v) * rounding).largest();
        if settled && (!improved || size == R::Lane::from_f64(0.0)) {
            return Ok(v);
        }
        if !improved {
            break;
        }
    }
    Err(error(if v.iter().all(|v| v.is_finite()) { Cause::NoVelocities } else { Cause::NotFinite }))
}

fn finite<R: Real, const N: usize>(values: [R; N]) -> Option<[R; N]> {
    values.iter().all(|value| value.is_finite()).then_some(values)
}

fn distance<R: Real, const N: usize>(p: &[R; N], momenta: &[R; N]) -> R::Lane {
    p.iter().zip(momenta).fold(R::zero(), |sum, (&p, &momentum)| sum + (p - momentum).abs()).largest()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relativistic_momenta_give_velocities_below_that_of_light() {
        let at = |v: &[f64; 1]| {
            let gamma = (1.0 - v[0] * v[0]).sqrt().recip();
            ([[gamma.powi(3)]], [gamma * v[0]])
        };
        for p in [0.0, 1e-9, 0.3, -2.0, 100.0] {
            let v = velocities(at, 0.0, &[p], false).unwrap()[0];
            let expected = p / (1.0_f64 + p * p).sqrt();
            assert!((v - expected).abs() <= 1e-14 * expected.abs().max(1e-3), "{p}: {v}, not {expected}");
        }
    }

    #[test]
    fn momenta_that_no_velocities_have_are_an_error() {
        // p = v − v³ is below 0.385 for v from −1 to 1.
        let at = |v: &[f64; 1]| ([[1.0 - 3.0 * v[0] * v[0]]], [v[0] - v[0].powi(3)]);
        assert!(velocities(at, 2.5, &[0.3], false).is_ok());
        assert_eq!(velocities(at, 2.5, &[f64::NAN], false).unwrap_err().t, 2.5);
        let flat = |v: &[f64; 1]| ([[1.0 + v[0] * v[0]].map(f64::recip)], [v[0].atan()]);
        assert!(velocities(flat, 0.0, &[2.0], false).is_err());
    }

    #[test]
    fn symbols_of_the_second_kind_are_raised() {
        let mass = SMatrix::<f64, 2, 2>::new(2.0, 0.0, 0.0, 4.0);
        let first = symmetric([[[1.0, 0.0], [3.0, 0.0]], [[0.0, 0.0], [8.0, 2.0]]]);
        let second = second_kind(&mass, &first, 0.0).unwrap();
        assert_eq!(second, [[[0.5, 1.5], [1.5, 0.0]], [[0.0, 2.0], [2.0, 0.5]]]);
        assert!(second_kind(&SMatrix::zeros(), &first, 0.0).is_err());
    }
}
