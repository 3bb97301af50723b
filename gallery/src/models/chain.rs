//! A chain of ten links, hung up at one end.

use alloc::{vec, vec::Vec};
use core::f64::consts::FRAC_PI_2;

use lagrangian::prelude::*;

use super::double_pendulum::turned;
use crate::{Model, Point, Scene, Slider, follow};

/// Point masses on massless links in a vertical plane.
#[derive(Clone, Copy, Debug)]
pub struct Chain {
    /// Mass at the end of each link \[kg].
    pub mass: f64,
    /// Mass at the free end beside it \[kg].
    pub load: f64,
    /// Length of each link \[m].
    pub length: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [theta: [10]])]
impl Chain {
    const LINKS: usize = 10;

    /// Angles are measured from the downward vertical.
    #[point(mass = self.mass)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; Self::LINKS] {
        let mut end = Vector2::zeros();
        q.theta.map(|theta| {
            end += self.length * Vector2::new(theta.sin(), -theta.cos());
            end
        })
    }

    #[point(mass = self.load)]
    fn weight(&self, q: &Coordinates) -> Vector2<f64> {
        self.joints(q)[9]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let links: f64 = self.joints(q).iter().map(|joint| self.mass * self.g * joint.y).sum();
        links + self.load * self.g * self.weight(q).y
    }
}

impl Model<10> for Chain {
    const PARAMETERS: &'static [Slider] = &[
        Slider::new("mass of a link", "kg", [0.05, 0.5, 0.01], 0.1),
        Slider::new("load", "kg", [0.0, 2.0, 0.05], 0.0),
        Slider::new("gravity", "m/s²", [0.5, 25.0, 0.1], 9.8),
    ];
    const SETTINGS: &'static [Slider] = &[
        Slider::new("angle of the chain", "rad", [-3.1, 3.1, 0.01], FRAC_PI_2),
        Slider::new("bend of each link", "rad", [-0.6, 0.6, 0.01], 0.0),
    ];
    const VIEW: [f64; 4] = [-1.2, -1.2, 1.2, 1.0];

    fn new(p: &[f64]) -> Self {
        Self { mass: p[0], load: p[1], length: 0.1, g: p[2] }
    }

    fn placed(&self, settings: &[f64]) -> Option<State<f64, 10>> {
        Some(State::at_rest(core::array::from_fn(|i| settings[0] + settings[1] * i as f64)))
    }

    fn settings(&self, state: &State<f64, 10>) -> Vec<f64> {
        vec![turned(state.q[0]), turned(state.q[1] - state.q[0])]
    }

    fn moved(&self, state: &State<f64, 10>, t: f64) -> Result<State<f64, 10>, MotionError<f64>> {
        follow(self, state, t)
    }

    fn energies(&self, state: &State<f64, 10>) -> [f64; 2] {
        [self.kinetic_energy(state), self.potential_energy(state)]
    }

    fn draw(&self, state: &State<f64, 10>, scene: &mut Scene) {
        let joints = self.joints(&state.q.into()).map(Point::from);
        scene.trail(0, joints[9]);
        scene.line(6, core::iter::once([0.0; 2]).chain(joints));
        scene.disc(6, [0.0; 2], 0.7);
        joints.iter().for_each(|&joint| scene.disc(0, joint, 1.0));
        scene.disc(1, joints[9], 1.2 + self.load);
    }

    fn handles(&self, state: &State<f64, 10>) -> Vec<Point> {
        self.joints(&state.q.into()).map(Into::into).to_vec()
    }

    /// The links follow as if each were pulled by the one below it, then hang from the support again.
    fn dragged(&self, state: &State<f64, 10>, handle: usize, to: Point) -> Option<State<f64, 10>> {
        let mut joints = [[0.0; 2]; 11];
        joints[1..].copy_from_slice(&self.joints(&state.q.into()).map(Point::from));
        joints[handle + 1] = to;
        let pull = |from: Point, end: Point| {
            let along = Vector2::from(end) - Vector2::from(from);
            let length = along.norm().max(f64::MIN_POSITIVE);
            (Vector2::from(from) + along * (self.length / length)).into()
        };
        (0..=handle).rev().for_each(|i| joints[i] = pull(joints[i + 1], joints[i]));
        joints[0] = [0.0; 2];
        (0..10).for_each(|i| joints[i + 1] = pull(joints[i], joints[i + 1]));
        Some(State::at_rest(core::array::from_fn(|i| {
            let [x, y] = [0, 1].map(|axis| joints[i + 1][axis] - joints[i][axis]);
            x.atan2(-y)
        })))
    }
}
