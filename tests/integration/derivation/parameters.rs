//! Where numbers come from: nested structs, arrays, references, constants of every kind, literals.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::difference::slope;

/// A constant outside the macro's sight.
const GRAVITY: f64 = 9.81;

/// A type with a constant of its own.
struct Planet;

impl Planet {
    const PULL: f64 = 3.7;
}

struct Wheel {
    mass: f64,
    radius: f64,
}

struct Axle<'a> {
    wheels: [Wheel; 2],
    grip: (f64, f64),
    frame: &'a Frame,
}

struct Frame {
    weight: f64,
    teeth: u32,
    centre: Vector2<f64>,
}

#[lagrangian(coordinates = [x, y])]
impl Axle<'_> {
    const SCALE: f64 = Self::HALF * 4.0;
    const HALF: f64 = 0.5;

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let [front, rear] = &self.wheels;
        0.5 * (front.mass * front.radius.powi(2) * v.x.powi(2)
            + rear.mass * self.wheels[1].radius * v.y.powi(2))
    }

    #[potential]
    fn forces(&self, q: &Coordinates) -> f64 {
        let (left, right) = self.grip;
        let centre: Vector2<f64> = self.frame.centre;
        left * q.x + right * q.y + self.frame.weight * q.x + (self.frame.teeth as f64) * q.y + centre.y * q.x
    }

    #[potential]
    fn constants(&self, q: &Coordinates) -> f64 {
        const LOCAL: f64 = 100.0;
        GRAVITY * q.x + Planet::PULL * q.y + Self::SCALE * q.x + std::f64::consts::PI * q.y + LOCAL * q.x
    }
}

#[test]
fn parameters_of_every_kind_reach_the_equations() {
    let frame = Frame { weight: 5.0, teeth: 7, centre: Vector2::new(0.25, 0.75) };
    let axle = Axle {
        wheels: [Wheel { mass: 2.0, radius: 3.0 }, Wheel { mass: 0.5, radius: 6.0 }],
        grip: (0.125, 0.5),
        frame: &frame,
    };
    let state = State::new([1.0, 2.0], [3.0, 4.0]);
    assert_eq!(axle.mass_matrix(&state), Matrix2::new(18.0, 0.0, 0.0, 3.0));
    let x = 0.125 + 5.0 + 0.75 + GRAVITY + 2.0 + 100.0;
    let y = 0.5 + 7.0 + 3.7 + std::f64::consts::PI;
    all_close(axle.bias(&state), [x, y], 1e-15);
    close(axle.potential_energy(&state), x * 1.0 + y * 2.0, 1e-15);
    all_close(axle.accelerations(&state).unwrap(), [-x / 18.0, -y / 3.0], 1e-15);
}

/// Parameters that nalgebra's types hold.
struct Mounted {
    axis: Unit<Vector3<f64>>,
    tilt: Rotation3<f64>,
    turn: UnitQuaternion<f64>,
    plane: Rotation2<f64>,
    offset: Translation3<f64>,
}

#[lagrangian(coordinates = [angle])]
impl Mounted {
    #[point(mass = 1.0)]
    fn arm(&self, q: &Coordinates) -> Vector3<f64> {
        let offset: Translation3<f64> = self.offset;
        let turn: UnitQuaternion<f64> = self.turn;
        let spin = Rotation3::from_axis_angle(&self.axis, q.angle);
        let tilt: Rotation3<f64> = self.tilt;
        turn * (tilt * (spin * Vector3::new(1.0, 2.0, 3.0))) + offset.vector
    }

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        let plane: Rotation2<f64> = self.plane;
        let flat = plane * self.arm(q).xy();
        self.arm(q).z + 10.0 * flat.x
    }
}

#[test]
fn rotations_and_translations_can_be_parameters() {
    let mounted = Mounted {
        axis: Unit::new_normalize(Vector3::new(1.0, 1.0, -2.0)),
        tilt: Rotation3::from_euler_angles(0.1, 0.2, 0.3),
        turn: UnitQuaternion::from_euler_angles(-0.5, 0.6, 0.7),
        plane: Rotation2::new(0.4),
        offset: Translation3::new(0.5, -0.5, 1.5),
    };
    let state = State::new([0.8], [1.3]);
    // The arm turns about the axis: the inertia is the squared distance from it.
    let arm = Vector3::new(1.0, 2.0, 3.0);
    let inertia = arm.cross(&mounted.axis).norm_squared();
    close(mounted.mass_matrix(&state)[(0, 0)], inertia, 1e-14);
    close(mounted.potential_energy(&state), mounted.height(&state.q.into()), 1e-14);
    let force = slope(0.005, |x| mounted.height(&[0.8 + x].into()));
    close(mounted.bias(&state)[0], force, 1e-12);
}

/// Literals and constants are exact: 0.1 + 0.2 is 0.3 here, as in the textbook.
struct Literals;

#[lagrangian(coordinates = [x])]
impl Literals {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        (1e-1 + 0.2 + 1_0.2) / 2.0 * v.x * v.x
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        (2.0 / 3.0) * q.x.powi(3) / 2.0
    }
}

#[test]
fn constants_are_folded_exactly() {
    let state = State::new([3.0], [0.0]);
    assert_eq!(Literals.mass_matrix(&state)[(0, 0)], 10.5);
    assert_eq!(Literals.bias(&state), [9.0]);
}

/// Integers, of which a formula takes conversions.
struct Gear {
    teeth: i32,
    stages: usize,
    worn: Vec<u8>,
    is_open: bool,
    stiffness: f64,
}

#[lagrangian(coordinates = [x], jacobians, sensitivities = [self.stiffness])]
impl Gear {
    #[point(mass = (self.stages / 2) as f64)]
    fn rim(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[potential]
    fn ratio(&self, q: &Coordinates) -> f64 {
        let (size, opposite) = ((self.teeth as i64).abs(), -self.teeth as f64);
        let rest: i32 = self.teeth % 4;
        (f64::from(-self.teeth) + opposite + size as f64 + f64::from(rest)) * q.x
    }

    #[potential]
    fn counts(&self, q: &Coordinates) -> f64 {
        (self.worn.len() as f64 + (!self.is_open) as i32 as f64 + f64::from(self.third())) * q.x
            + self.stiffness * self.stages.pow(2) as f64 * q.x
    }

    fn third(&self) -> i32 {
        -self.teeth / 3
    }
}

#[test]
fn integers_are_computed_as_rust_does() {
    let gear = Gear { teeth: -17, stages: 7, worn: vec![1, 2], is_open: false, stiffness: 0.5 };
    let state = State::at_rest([1.0]);
    let force = (17.0 + 17.0 + 17.0 - 1.0) + (2.0 + 1.0 + 5.0) + 0.5 * 49.0;
    close(gear.potential_energy(&state), force, 1e-15);
    all_close(gear.accelerations(&state).unwrap(), [-force / 3.0], 1e-15);
}
