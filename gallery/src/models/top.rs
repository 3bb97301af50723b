//! A spinning top with its tip on the ground. Its orientation is a coordinate: no attitude is singular.

use alloc::{vec, vec::Vec};
use core::f64::consts::TAU;

use lagrangian::prelude::*;

use crate::{Model, Point, Scene, Slider, follow};

/// A symmetric top on a ball joint.
#[derive(Clone, Copy, Debug)]
pub struct Top {
    /// Mass \[kg].
    pub mass: f64,
    /// Moment of inertia across the axis, through the centre of mass \[kg m²].
    pub across: f64,
    /// Moment of inertia about the axis \[kg m²].
    pub along: f64,
    /// Distance from the tip to the centre of mass \[m].
    pub arm: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [attitude: Rotation])]
impl Top {
    #[body(mass = self.mass, inertia = [self.across, self.across, self.along])]
    fn gyroscope(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts((q.attitude * Vector3::new(0.0, 0.0, self.arm)).into(), q.attitude)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.gyroscope(q).translation.vector.z
    }
}

/// Radius of the disc \[m].
const RADIUS: f64 = 0.06;

impl Top {
    /// Seen from 20° above the horizon.
    fn seen(place: Vector3<f64>) -> Point {
        let (sin, cos) = 20_f64.to_radians().sin_cos();
        [place.x, place.z * cos + place.y * sin]
    }

    /// Leaning by an angle towards an azimuth, and spinning.
    fn leaning(&self, [x, y]: Point, spin: f64) -> State<f64, 3> {
        let attitude = UnitQuaternion::from_scaled_axis(Vector3::new(-y, x, 0.0));
        self.state(TopCoordinates { attitude }, TopVelocities { attitude: Vector3::new(0.0, 0.0, spin) })
    }

    fn axis(state: &State<f64, 3>) -> Vector3<f64> {
        TopCoordinates::from(state.q).attitude * Vector3::z()
    }
}

impl Model<3> for Top {
    const PARAMETERS: &'static [Slider] = &[
        Slider::new("mass", "kg", [0.1, 1.0, 0.05], 0.5),
        Slider::new("arm", "m", [0.03, 0.09, 0.005], 0.06),
        Slider::new("gravity", "m/s²", [0.5, 25.0, 0.1], 9.8),
    ];
    const SETTINGS: &'static [Slider] = &[
        Slider::new("lean", "rad", [0.0, 3.0, 0.01], 0.5),
        Slider::new("spin", "rad/s", [-200.0, 200.0, 1.0], 60.0),
    ];
    const VIEW: [f64; 4] = [-0.13, -0.12, 0.13, 0.16];

    fn new(p: &[f64]) -> Self {
        let [mass, arm, g] = [p[0], p[1], p[2]];
        let along = 0.5 * mass * RADIUS * RADIUS;
        Self { mass, across: 0.5 * along, along, arm, g }
    }

    fn placed(&self, settings: &[f64]) -> Option<State<f64, 3>> {
        Some(self.leaning([settings[0], 0.0], settings[1]))
    }

    fn settings(&self, state: &State<f64, 3>) -> Vec<f64> {
        vec![Self::axis(state).z.clamp(-1.0, 1.0).acos(), self.velocities(state).attitude.z]
    }

    fn moved(&self, state: &State<f64, 3>, t: f64) -> Result<State<f64, 3>, MotionError<f64>> {
        follow(self, state, t)
    }

    fn energies(&self, state: &State<f64, 3>) -> [f64; 2] {
        [self.kinetic_energy(state), self.potential_energy(state)]
    }

    fn draw(&self, state: &State<f64, 3>, scene: &mut Scene) {
        let attitude = TopCoordinates::from(state.q).attitude;
        let at = |place: Vector3<f64>| Self::seen(attitude * place);
        let rim = |angle: f64| at(Vector3::new(RADIUS * angle.cos(), RADIUS * angle.sin(), self.arm));
        let tip = at(Vector3::new(0.0, 0.0, 2.0 * self.arm));
        let ground = |angle: f64| Self::seen(Vector3::new(0.1 * angle.cos(), 0.1 * angle.sin(), 0.0));
        scene.line(5, (0..=36).map(|k| ground(f64::from(k) * TAU / 36.0)));
        scene.trail(0, tip);
        scene.line(6, [[0.0; 2], tip]);
        scene.body(0, (0..36).map(|k| rim(f64::from(k) * TAU / 36.0)));
        scene.line(1, [at(Vector3::new(0.0, 0.0, self.arm)), rim(0.0)]);
        scene.disc(1, tip, 1.8);
    }

    fn handles(&self, state: &State<f64, 3>) -> Vec<Point> {
        vec![Self::seen(2.0 * self.arm * Self::axis(state))]
    }

    /// The axis leans to where it is pulled, in the plane of the picture.
    fn dragged(&self, state: &State<f64, 3>, _: usize, [x, y]: Point) -> Option<State<f64, 3>> {
        let spin = self.velocities(state).attitude.z;
        Some(self.leaning([x.atan2(y), 0.0], spin))
    }
}
