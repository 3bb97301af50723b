//! Parameters that are not what their type promises: matrices of inertia that are not symmetric, axes that
//! are not of unit length. Components of arrays by each of their names.

use lagrangian::prelude::*;

use crate::support::close::close;

struct Skewed {
    inertia: Matrix3<f64>,
}

#[lagrangian(coordinates = [attitude: Rotation])]
impl Skewed {
    fn moments(&self) -> Matrix3<f64> {
        self.inertia
    }

    #[body(mass = 1.0, inertia = self.moments())]
    fn block(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.attitude)
    }
}

#[test]
fn an_energy_knows_the_symmetric_part_of_an_inertia() {
    let inertia = Matrix3::new(1.0, 0.5, 0.0, 0.0, 2.0, 0.2, 0.1, 0.0, 1.5);
    let even = (inertia + inertia.transpose()) * 0.5;
    let system = Skewed { inertia };
    let angular = Vector3::new(1.0, 2.0, 3.0);
    let start = SkewedCoordinates { attitude: UnitQuaternion::identity() };
    let state = system.state(start, SkewedVelocities { attitude: angular });
    close(system.kinetic_energy(&state), 0.5 * angular.dot(&(inertia * angular)), 1e-15);
    let mass = system.body_axes(&state).matrix(&system.mass_matrix(&state));
    assert!((mass - even).norm() < 1e-15, "{mass}");
    let found = system.body_axes(&state).accelerations(system.accelerations(&state).unwrap());
    let expected = -even.try_inverse().unwrap() * angular.cross(&(even * angular));
    assert!((Vector3::from(found.0) - expected).norm() < 1e-14, "{found:?} {expected}");
}

struct Wheel {
    axis: Vector3<f64>,
}

#[lagrangian(coordinates = [angle])]
impl Wheel {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 3.0])]
    fn wheel(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let axis: Vector3<f64> = self.axis;
        (Vector3::zeros(), Rotation3::from_axis_angle(&Unit::new_unchecked(axis), q.angle))
    }
}

/// The energy is that of the unit axis, and a debug build says that the function has another one.
#[test]
fn an_axis_has_unit_length() {
    let state = State::new([0.4], [1.0]);
    let wheel = Wheel { axis: Vector3::new(0.0, 0.0, 2.0) };
    close(wheel.kinetic_energy(&state), 1.5, 1e-15);
    if cfg!(debug_assertions) {
        assert!(matches!(wheel.accelerations(&state).unwrap_err().cause, Cause::Misread { .. }));
    }
    close(Wheel { axis: Vector3::z() }.kinetic_energy(&state), 1.5, 1e-15);
    assert_eq!(Wheel { axis: Vector3::z() }.accelerations(&state).unwrap(), [0.0]);
}

struct Flywheel {
    inertia: [f64; 3],
    centre: Vector3<f64>,
}

#[lagrangian(coordinates = [attitude: Rotation], sensitivities = [self.inertia[2], self.centre.z], jacobians)]
impl Flywheel {
    #[body(mass = 2.0, inertia = self.inertia)]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        let centre: Vector3<f64> = self.centre;
        Isometry3::from_parts(Translation3::from(q.attitude * centre), q.attitude)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * self.body(q).translation.z
    }
}

#[test]
fn components_have_several_names() {
    let wheel = |third: f64, height: f64| Flywheel {
        inertia: [0.3, 0.4, third],
        centre: Vector3::new(0.1, 0.0, height),
    };
    let state = State::new([0.3, -0.4, 0.2], [0.7, 0.5, -1.1]);
    let found = wheel(0.5, 0.6).sensitivities(&state, &[]).unwrap().accelerations;
    let step = 1e-5;
    let ahead =
        [wheel(0.5 + step, 0.6), wheel(0.5, 0.6 + step)].map(|wheel| wheel.accelerations(&state).unwrap());
    let behind =
        [wheel(0.5 - step, 0.6), wheel(0.5, 0.6 - step)].map(|wheel| wheel.accelerations(&state).unwrap());
    for parameter in 0..2 {
        for i in 0..3 {
            let slope = (ahead[parameter][i] - behind[parameter][i]) / (2.0 * step);
            assert!((found[(i, parameter)] - slope).abs() < 1e-7 * slope.abs().max(1.0), "{found} {slope}");
        }
    }
}
