//! Bodies in a plane: every way to write a pose, against the sum of ½ m ṙ² and ½ I φ̇².

use lagrangian::prelude::*;

use crate::support::close::{all_close, all_close_on_largest, close};
use crate::support::difference::slope;
use crate::support::identities::model;
use crate::support::sample::Samples;

/// One pose written in many ways: at (x + cos φ, sin φ), turned by φ + 2 x.
struct Poses;

/// How many bodies there are.
const SPELLINGS: f64 = 9.0;

#[lagrangian(coordinates = [x, phi])]
impl Poses {
    fn place(q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x + q.phi.cos(), q.phi.sin())
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn isometry(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Self::place(q), q.phi + 2.0 * q.x)
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn parts(&self, q: &Coordinates) -> Isometry2<f64> {
        let turn = UnitComplex::new(q.phi) * UnitComplex::from_angle(2.0 * q.x);
        Isometry2::from_parts(Translation2::from(Self::place(q)), turn)
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn matrix(&self, q: &Coordinates) -> IsometryMatrix2<f64> {
        let turn = Rotation2::new(q.phi) * Rotation2::new(-2.0 * q.x).inverse();
        IsometryMatrix2::from_parts(Translation2::new(q.x + q.phi.cos(), q.phi.sin()), turn)
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn composed(&self, q: &Coordinates) -> Isometry2<f64> {
        let slide = Isometry2::translation(q.x, 0.0);
        slide * Isometry2::rotation(q.phi) * Translation2::new(1.0, 0.0) * UnitComplex::new(2.0 * q.x)
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn inverse(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Self::place(q), q.phi + 2.0 * q.x).inverse().inverse()
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn pair(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::place(q), q.phi + 2.0 * q.x)
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn point_and_rotation(&self, q: &Coordinates) -> (Point2<f64>, Rotation2<f64>) {
        (Point2::origin() + Self::place(q), Rotation2::new(q.phi + 2.0 * q.x))
    }

    #[body(mass = [0.5, 1.5], inertia = 0.25)]
    fn several(&self, q: &Coordinates) -> [Isometry2<f64>; 2] {
        [self.isometry(q), self.composed(q)]
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn moved_point(&self, q: &Coordinates) -> Isometry2<f64> {
        let arm = Isometry2::new(Vector2::new(q.x, 0.0), q.phi);
        let end = arm * Point2::new(1.0, 0.0);
        Isometry2::new(end.coords, arm.rotation.angle() + 2.0 * q.x)
    }
}

#[test]
fn every_pose_has_the_same_inertia() {
    let mut samples = Samples::new(1);
    for _ in 0..10 {
        let state: State<f64, 2> = samples.state(-0.7, 0.7);
        let phi = state.q[1];
        let [[xx, xp], [_, pp]] = [[2.0 + 0.5 * 4.0, -2.0 * phi.sin() + 0.5 * 2.0], [0.0, 2.0 + 0.5]];
        let expected = SPELLINGS * Matrix2::new(xx, xp, xp, pp);
        all_close(Poses.mass_matrix(&state).as_slice(), expected.as_slice(), 1e-14);
        let rate = state.v[1];
        all_close_on_largest(Poses.bias(&state), [SPELLINGS * -2.0 * phi.cos() * rate * rate, 0.0], 1e-13);
    }
    model!(Poses).holds(-1.0, 1.0);
}

#[test]
fn poses_are_still_ordinary_functions() {
    let q = PosesCoordinates { x: 0.3, phi: -0.4 };
    for pose in
        [Poses.isometry(&q), Poses.parts(&q), Poses.composed(&q), Poses.inverse(&q), Poses.moved_point(&q)]
    {
        all_close(pose.translation.vector.as_slice(), [0.3 + 0.4_f64.cos(), -0.4_f64.sin()], 1e-15);
        close(pose.rotation.angle(), 0.2, 1e-14);
    }
}

/// A rolling half disc: its centre of mass is off the axis.
struct HalfDisc {
    m: f64,
    r: f64,
    g: f64,
}

#[lagrangian(coordinates = [phi])]
impl HalfDisc {
    /// Distance of the centre of mass from the axis.
    fn offset(&self) -> f64 {
        4.0 * self.r / (3.0 * std::f64::consts::PI)
    }

    fn inertia(&self) -> f64 {
        self.m * (self.r * self.r / 2.0 - self.offset().powi(2))
    }

    #[body(mass = self.m, inertia = self.inertia())]
    fn disc(&self, q: &Coordinates) -> Isometry2<f64> {
        let axis = Vector2::new(-self.r * q.phi, self.r);
        Isometry2::new(axis + self.offset() * Vector2::new(q.phi.sin(), -q.phi.cos()), q.phi)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * self.g * self.disc(q).translation.vector.y
    }
}

#[test]
fn a_half_disc_rocks_at_the_textbooks_rate() {
    let disc = HalfDisc { m: 1.3, r: 0.4, g: 9.81 };
    let stiffness = -slope(0.005, |x| disc.accelerations(&State::at_rest([x])).unwrap()[0]);
    let d = 4.0 / (3.0 * std::f64::consts::PI);
    // ω² = g d / (r (3/2 − 2 d)) with the offset d r.
    close(stiffness, disc.g * d / (disc.r * (1.5 - 2.0 * d)), 1e-12);
    model!(disc).holds(-1.0, 1.0);
}
