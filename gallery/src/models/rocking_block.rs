//! A block that rocks on its corners until it stands: infinitely many impacts in finite time.

use alloc::{vec, vec::Vec};

use lagrangian::prelude::*;

use crate::{Model, Point, Scene, Slider, follow};

/// A uniform block on a rough floor.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Mass \[kg].
    pub mass: f64,
    /// Half of the width \[m].
    pub half_width: f64,
    /// Half of the height \[m].
    pub half_height: f64,
    /// Coefficient of friction of the corners.
    pub friction: f64,
    /// Coefficient of restitution of the corners.
    pub restitution: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Block {
    #[body(mass = self.mass, inertia = self.mass * (self.half_width.powi(2) + self.half_height.powi(2)) / 3.0)]
    fn block(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * q.y
    }

    /// From the middle to the left and the right lower corner.
    fn arms(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        let turn = Rotation2::new(q.phi);
        [-1.0, 1.0].map(|side| turn * Vector2::new(side * self.half_width, -self.half_height))
    }

    /// Heights of the corners.
    #[unilateral(restitution = self.restitution)]
    fn corners(&self, q: &Coordinates) -> [f64; 2] {
        self.arms(q).map(|arm| q.y + arm.y)
    }

    /// Velocities of the corners along the floor.
    #[friction(coefficient = self.friction, normal = corners)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        self.arms(q).map(|arm| v.x - arm.y * v.phi)
    }
}

impl Block {
    /// At rest, tilted about the corner that carries it.
    fn tilted(&self, phi: f64) -> State<f64, 3> {
        let side = if phi > 0.0 { -1.0 } else { 1.0 };
        let (sin, cos) = phi.sin_cos();
        let (w, h) = (side * self.half_width, -self.half_height);
        State::at_rest([w - (cos * w - sin * h), -(sin * w + cos * h), phi])
    }
}

impl Model<3> for Block {
    const PARAMETERS: &'static [Slider] = &[
        Slider::new("half width", "m", [0.1, 0.35, 0.01], 0.2),
        Slider::new("half height", "m", [0.3, 0.6, 0.01], 0.5),
        Slider::new("friction", "", [0.05, 2.0, 0.05], 1.0),
        Slider::new("restitution", "", [0.0, 0.6, 0.05], 0.0),
    ];
    const SETTINGS: &'static [Slider] = &[Slider::new("tilt", "rad", [-0.36, 0.36, 0.01], -0.25)];
    const REACTIONS: &'static [&'static str] = &[
        "left corner, upwards [N]",
        "right corner, upwards [N]",
        "left corner, along the floor [N]",
        "right corner, along the floor [N]",
    ];
    const VIEW: [f64; 4] = [-1.1, -0.15, 1.1, 1.35];
    const CONSERVATIVE: bool = false;

    fn new(p: &[f64]) -> Self {
        Self { mass: 40.0, half_width: p[0], half_height: p[1], friction: p[2], restitution: p[3], g: 9.81 }
    }

    fn placed(&self, settings: &[f64]) -> Option<State<f64, 3>> {
        Some(self.tilted(settings[0]))
    }

    fn settings(&self, state: &State<f64, 3>) -> Vec<f64> {
        vec![state.q[2]]
    }

    fn moved(&self, state: &State<f64, 3>, t: f64) -> Result<State<f64, 3>, MotionError<f64>> {
        follow(self, state, t)
    }

    fn energies(&self, state: &State<f64, 3>) -> [f64; 2] {
        [self.kinetic_energy(state), self.potential_energy(state)]
    }

    fn reactions(&self, state: &State<f64, 3>) -> Vec<f64> {
        let motion = self.simulate(*state);
        let found = *motion.reactions();
        [found.corners, found.slips].concat()
    }

    fn draw(&self, state: &State<f64, 3>, scene: &mut Scene) {
        let q = state.q.into();
        let (w, h) = (self.half_width, self.half_height);
        let pose = self.block(&q);
        scene.line(6, [[-1.1, 0.0], [1.1, 0.0]]);
        scene.body(0, [(-w, -h), (w, -h), (w, h), (-w, h)].map(|(x, y)| (pose * Point2::new(x, y)).into()));
        let forces = Model::reactions(self, state);
        for (side, arm) in self.arms(&q).into_iter().enumerate() {
            let corner = pose.translation.vector + arm;
            scene.arrow(2, corner.into(), [1e-3 * forces[2 + side], 1e-3 * forces[side]]);
        }
        scene.disc(1, (pose * Point2::new(0.0, h)).into(), 1.6);
    }

    fn handles(&self, state: &State<f64, 3>) -> Vec<Point> {
        vec![(self.block(&state.q.into()) * Point2::new(0.0, self.half_height)).into()]
    }

    fn dragged(&self, _: &State<f64, 3>, _: usize, [x, _]: Point) -> Option<State<f64, 3>> {
        Some(self.tilted((-x / self.half_height).clamp(-0.8, 0.8)))
    }

    fn kept(&self, state: &State<f64, 3>) -> Option<State<f64, 3>> {
        Some(self.tilted(state.q[2]))
    }
}
