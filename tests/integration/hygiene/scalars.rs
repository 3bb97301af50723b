//! Generic scalars with other bounds beside `Real`, and nalgebra's poses over them.

use lagrangian::prelude::*;
use nalgebra::RealField;

use crate::support::close::close;

/// Has the names of functions that generated code calls.
#[allow(dead_code)]
pub trait Unlucky: Copy {
    fn from_f64(x: f64) -> Self;
    fn from_parts(x: f64, y: f64) -> Self;
    fn zero() -> Self;
    fn one() -> Self;
    fn sin_cos(self) -> (Self, Self);
    fn sqrt(self) -> Self;
    fn powi(self, n: i32) -> Self;
    fn recip(self) -> Self;
    fn is_finite(self) -> bool;
}
impl Unlucky for f64 {
    fn from_f64(_: f64) -> Self {
        f64::NAN
    }
    fn from_parts(_: f64, _: f64) -> Self {
        f64::NAN
    }
    fn zero() -> Self {
        f64::NAN
    }
    fn one() -> Self {
        f64::NAN
    }
    fn sin_cos(self) -> (Self, Self) {
        (f64::NAN, f64::NAN)
    }
    fn sqrt(self) -> Self {
        f64::NAN
    }
    fn powi(self, _: i32) -> Self {
        f64::NAN
    }
    fn recip(self) -> Self {
        f64::NAN
    }
    fn is_finite(self) -> bool {
        false
    }
}

/// A rod with a bob at its end.
pub struct Rod<R> {
    length: R,
}

#[lagrangian(coordinates = [x, y], jacobians, analysis)]
impl<R: Real + Unlucky> Rod<R> {
    #[point(mass = 2.0)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }
    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        2.0 * 9.81 * self.bob(q).y
    }
    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        self.bob(q).norm() - self.length
    }
}

/// Poses, quaternions and rotations of the plane as parameters, and a pose as a coordinate.
pub struct Loaded<R> {
    mount: Isometry3<R>,
    moments: [R; 3],
    arm: IsometryMatrix2<R>,
    turn: UnitQuaternion<R>,
    plane: UnitComplex<R>,
}

#[lagrangian(coordinates = [hull: Pose, angle], jacobians)]
impl<R: Real> Loaded<R> {
    #[body(mass = 1.5, inertia = self.moments)]
    fn hull(&self, q: &Coordinates<R>) -> Isometry3<R> {
        q.hull
    }
    #[body(mass = 0.5, inertia = [0.1, 0.2, 0.3])]
    fn load(&self, q: &Coordinates<R>) -> IsometryMatrix3<R> {
        let mount: Isometry3<R> = self.mount;
        let turn: UnitQuaternion<R> = self.turn;
        let rotation = q.hull.rotation.to_rotation_matrix();
        let inner = mount.rotation.to_rotation_matrix()
            * turn.to_rotation_matrix()
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.angle);
        let shift = q.hull.translation.vector + rotation * mount.translation.vector;
        IsometryMatrix3::from_parts(shift.into(), rotation * inner)
    }
    #[potential]
    fn spring(&self, q: &Coordinates<R>) -> R {
        let arm: IsometryMatrix2<R> = self.arm;
        let plane: UnitComplex<R> = self.plane;
        let p =
            arm.rotation * (plane.to_rotation_matrix() * Vector2::new(q.angle, 1.0)) + arm.translation.vector;
        0.5 * 3.0 * p.dot(&p)
    }
}

/// All of nalgebra, by its own bound.
pub struct Field<R> {
    mount: Isometry3<R>,
    moments: [R; 3],
}
#[lagrangian(coordinates = [hull: Pose], jacobians)]
impl<R: Real + RealField> Field<R> {
    #[body(mass = 1.5, inertia = self.moments)]
    fn hull(&self, q: &Coordinates<R>) -> Isometry3<R> {
        let mount: Isometry3<R> = self.mount;
        q.hull * mount * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.3)
    }
    #[potential]
    fn spring(&self, q: &Coordinates<R>) -> R {
        let tip = q.hull * Point3::new(0.0, 0.0, 1.0);
        Real::sin(tip.x) + tip.coords.norm_squared()
    }
}

#[test]
fn calls_of_generated_code_are_those_of_real() {
    let rod = Rod { length: 1.0 };
    let start = rod.consistent(State::at_rest([0.6, -0.8])).unwrap();
    let mut motion = rod.simulate(start);
    motion.advance_to(1.0).unwrap();
    close(motion.energy(), -0.8 * 2.0 * 9.81, 1e-9);
}

#[test]
fn poses_over_any_scalar_are_read_as_they_are_computed() {
    let loaded = Loaded {
        mount: Isometry3::new(Vector3::new(0.1, 0.2, 0.3), Vector3::new(0.4, -0.2, 0.9)),
        moments: [1.0, 2.0, 3.0],
        arm: IsometryMatrix2::new(Vector2::new(0.1, 0.3), 0.4),
        turn: UnitQuaternion::new(Vector3::new(0.3, 0.2, 0.1)),
        plane: UnitComplex::new(2.2),
    };
    let start = State::new([0.0, 0.0, 0.0, 0.1, 0.2, 0.3, 0.5], [0.1, 0.3, 0.2, 1.0, 2.0, 0.4, 0.5]);
    // p = A (C (φ, 1)) + a, so |p|² by hand.
    let (angle, shift) = (0.4_f64 + 2.2, Vector2::new(0.1, 0.3));
    let turned = Vector2::new(0.5 * angle.cos() - angle.sin(), 0.5 * angle.sin() + angle.cos());
    close(loaded.potential_energy(&start), 1.5 * (turned + shift).norm_squared(), 1e-14);
    let mut motion = loaded.simulate(start);
    let energy = motion.energy();
    // The first step compares what was read with the user's functions.
    motion.advance_to(1.0).unwrap();
    close(motion.energy(), energy, 1e-9);
}

#[test]
fn with_nalgebras_bound_a_description_may_use_all_of_it() {
    let field = Field {
        mount: Isometry3::new(Vector3::new(0.1, 0.2, 0.3), Vector3::new(0.4, -0.2, 0.9)),
        moments: [1.0, 2.0, 3.0],
    };
    let mut motion =
        field.simulate(State::new([0.0, 0.0, 0.0, 0.1, 0.2, 0.3], [0.1, 0.3, 0.2, 1.0, 2.0, 0.4]));
    let energy = motion.energy();
    motion.advance_to(1.0).unwrap();
    close(motion.energy(), energy, 1e-9);
}
