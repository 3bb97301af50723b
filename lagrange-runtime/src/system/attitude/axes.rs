//! Momenta, forces and accelerations by named velocities. Angular ones are in body axes, while a state holds
//! rates of parameters.
//!
//! With ρ′ = J(ρ) ω, the conjugate of ω is Jᵀ p, and the mass matrix is Jᵀ M J.

use nalgebra::{SMatrix, Vector3};

use super::{rates, triple};
use crate::number::elements::{Each, array};
use crate::number::real::{Dual, Real};
use crate::system::state::State;

/// A number for each component of the named velocities, in their order: velocities, accelerations, momenta or
/// forces. Components of an orientation are in body axes.
///
/// The velocities of a system with orientations are made of it: `SatelliteVelocities::from(by_name)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByName<R, const N: usize>(pub [R; N]);

/// The body axes of a state: changes between the numbers of the state and named quantities.
#[derive(Clone, Copy, Debug)]
pub struct BodyAxes<R, const N: usize> {
    orientations: &'static [usize],
    state: State<R, N>,
}

impl<R: Real, const N: usize> BodyAxes<R, N> {
    pub(in crate::system) fn new(orientations: &'static [usize], state: &State<R, N>) -> Self {
        Self { orientations, state: *state }
    }

    /// The velocities of the state.
    #[inline]
    #[must_use]
    pub fn velocities(&self) -> ByName<R, N> {
        ByName(self.changed(self.state.v, |rho, rates| angular(rho, rates)))
    }

    /// Their rates at accelerations q″, such as `accelerations` returns. The rate of an angular velocity is
    /// an angular acceleration.
    #[inline]
    #[must_use]
    pub fn accelerations(&self, a: [R; N]) -> ByName<R, N> {
        let v = self.state.v;
        let found = self.changed_at(a, |first, rho, a| {
            let slopes = triple(&v, first);
            let dual = |x: [R; 3], slope: [R; 3]| -> [Dual<R, 1>; 3] {
                array(|i| Dual { value: x[i], slopes: [slope[i]] })
            };
            angular(dual(rho, slopes), dual(slopes, a)).each(|x| x.slopes[0])
        });
        ByName(found)
    }

    /// Accelerations q″ at rates of the named velocities.
    #[inline]
    #[must_use]
    pub fn second_rates(&self, by_name: ByName<R, N>) -> [R; N] {
        let ByName(at_rest) = self.accelerations([R::zero(); N]);
        self.changed_at(by_name.0, |first, rho, a| {
            let drift = triple(&at_rest, first);
            rates(rho, &Vector3::new(a[0] - drift[0], a[1] - drift[1], a[2] - drift[2]))
        })
    }

    /// Momenta or forces; for orientations angular momenta \[kg m²/s] and torques \[N m].
    #[inline]
    #[must_use]
    pub fn loads(&self, conjugate: [R; N]) -> ByName<R, N> {
        ByName(self.changed(conjugate, |rho, p| {
            columns(rho).each(|column| column[0] * p[0] + column[1] * p[1] + column[2] * p[2])
        }))
    }

    /// The mass matrix for named velocities: loads by velocities.
    #[inline]
    #[must_use]
    pub fn matrix(&self, mass: &SMatrix<R, N, N>) -> SMatrix<R, N, N> {
        let half = SMatrix::<R, N, N>::from_columns(&array::<_, N>(|j| {
            self.loads(mass.column(j).into_owned().into()).0.into()
        }));
        let rows = array::<_, N>(|i| self.loads(half.row(i).transpose().into()).0.into());
        SMatrix::<R, N, N>::from_columns(&rows).transpose()
    }

    /// The numbers with those of each orientation changed, given its parameters.
    fn changed(&self, numbers: [R; N], by: impl Fn([R; 3], [R; 3]) -> [R; 3]) -> [R; N] {
        self.changed_at(numbers, |_, rho, x| by(rho, x))
    }

    /// The same with the index of the orientation.
    fn changed_at(&self, mut numbers: [R; N], by: impl Fn(usize, [R; 3], [R; 3]) -> [R; 3]) -> [R; N] {
        for &first in self.orientations {
            let new = by(first, triple(&self.state.q, first), triple(&numbers, first));
            if let Some(place) = numbers.get_mut(first..first + 3) {
                place.copy_from_slice(&new);
            }
        }
        numbers
    }
}

/// The columns of J: rates of the parameters at unit angular velocities.
pub(super) fn columns<R: Real>(rho: [R; 3]) -> [[R; 3]; 3] {
    let (zero, one) = (R::zero(), R::one());
    [[one, zero, zero], [zero, one, zero], [zero, zero, one]].each(|axis| rates(rho, &axis.into()))
}

/// The angular velocity in body axes. J has columns of the length 1 + |ρ|²/16 =: c that are orthogonal, so
/// that its inverse is Jᵀ/c².
pub(super) fn angular<R: Real>(rho: [R; 3], rates: [R; 3]) -> [R; 3] {
    let c = R::one() + super::square(rho) * R::from_f64(1.0 / 16.0);
    columns(rho).each(|column| (column[0] * rates[0] + column[1] * rates[1] + column[2] * rates[2]) / (c * c))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::attitude::rotation;

    /// An orientation behind one other coordinate.
    fn axes() -> BodyAxes<f64, 4> {
        BodyAxes::new(&[1], &State::new([0.7, 0.9, -1.6, 2.1], [0.3, -0.8, 0.5, 1.1]))
    }

    #[test]
    fn velocities_and_rates_are_inverse_to_each_other() {
        let axes = axes();
        let ByName([x, a, b, c]) = axes.velocities();
        let rho = [0.9, -1.6, 2.1];
        let again = rates(rho, &Vector3::new(a, b, c));
        assert_eq!(x, 0.3);
        assert!(again.iter().zip([-0.8, 0.5, 1.1]).all(|(a, b)| (a - b).abs() < 1e-14), "{again:?}");
    }

    /// Angular accelerations against differences of angular velocities along q + τ v + ½ τ² a.
    #[test]
    fn accelerations_are_rates_of_velocities() {
        let (axes, a) = (axes(), [0.2, 1.3, -0.4, 0.9]);
        let State { q, v, .. } = axes.state;
        let at = |tau: f64| {
            let place = core::array::from_fn(|i| q[i] + tau * (v[i] + 0.5 * tau * a[i]));
            let state = State::new(place, core::array::from_fn::<_, 4, _>(|i| v[i] + tau * a[i]));
            BodyAxes::new(&[1], &state).velocities().0
        };
        let (ahead, behind, found) = (at(1e-4), at(-1e-4), axes.accelerations(a));
        for i in 0..4 {
            let slope = (ahead[i] - behind[i]) / 2e-4;
            assert!((found.0[i] - slope).abs() < 1e-7, "{i}: {} {slope}", found.0[i]);
        }
        let again = axes.second_rates(found);
        assert!(again.iter().zip(a).all(|(a, b)| (a - b).abs() < 1e-14), "{again:?}");
    }

    /// Power and energy do not depend on the velocities they are written with.
    #[test]
    fn power_and_energy_stay() {
        let (axes, load) = (axes(), [0.4, -0.2, 0.6, 1.5]);
        let (velocities, loads) = (axes.velocities().0, axes.loads(load).0);
        let dot = |a: [f64; 4], b: [f64; 4]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        assert!((dot(loads, velocities) - dot(load, axes.state.v)).abs() < 1e-14);
        let mass = SMatrix::<f64, 4, 4>::from_fn(|i, j| if i == j { 3.0 } else { 0.1 * (i + j) as f64 });
        let along = |m: SMatrix<f64, 4, 4>, v: [f64; 4]| dot((m * SMatrix::from(v)).into(), v);
        assert!((along(axes.matrix(&mass), velocities) - along(mass, axes.state.v)).abs() < 1e-13);
        assert!((axes.matrix(&mass) - axes.matrix(&mass).transpose()).norm() < 1e-13);
    }

    /// The angular velocity is that of the quaternion.
    #[test]
    fn angular_velocities_turn_the_body() {
        let (axes, tau) = (axes(), 1e-4);
        let State { q, v, .. } = axes.state;
        let place = |tau: f64| rotation(core::array::from_fn(|i| q[i + 1] + tau * v[i + 1]));
        let found = (place(-tau).inverse() * place(tau)).scaled_axis() / (2.0 * tau);
        let ByName([_, a, b, c]) = axes.velocities();
        assert!((found - Vector3::new(a, b, c)).norm() < 1e-7);
    }
}
