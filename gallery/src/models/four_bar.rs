//! A four-bar linkage: three bars and the frame, closed by a constraint whose multipliers are the force in a
//! hinge.

use alloc::{vec, vec::Vec};

use lagrangian::prelude::*;

use super::double_pendulum::turned;
use crate::{Model, Point, Scene, Slider, follow};

/// Uniform bars of 1 kg a metre, hinged to each other and to a frame.
#[derive(Clone, Copy, Debug)]
pub struct FourBar {
    /// Lengths of crank, coupler and rocker \[m].
    pub length: [f64; 3],
    /// Distance of the hinges in the frame \[m].
    pub frame: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [crank, coupler, rocker])]
impl FourBar {
    #[body(mass = self.length[0], inertia = self.length[0].powi(3) / 12.0)]
    fn first(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.crank.cos(), q.crank.sin()) * (0.5 * self.length[0]), q.crank)
    }

    /// The hinge between crank and coupler.
    fn knee(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.crank.cos(), q.crank.sin()) * self.length[0]
    }

    #[body(mass = self.length[1], inertia = self.length[1].powi(3) / 12.0)]
    fn second(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let along = Vector2::new(q.coupler.cos(), q.coupler.sin());
        (self.knee(q) + along * (0.5 * self.length[1]), q.coupler)
    }

    #[body(mass = self.length[2], inertia = self.length[2].powi(3) / 12.0)]
    fn third(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let along = Vector2::new(q.rocker.cos(), q.rocker.sin());
        (Vector2::new(self.frame, 0.0) + along * (0.5 * self.length[2]), q.rocker)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let heights = [self.first(q).0.y, self.second(q).0.y, self.third(q).0.y];
        self.g * (self.length[0] * heights[0] + self.length[1] * heights[1] + self.length[2] * heights[2])
    }

    /// The end of the coupler.
    fn end(&self, q: &Coordinates) -> Vector2<f64> {
        self.knee(q) + Vector2::new(q.coupler.cos(), q.coupler.sin()) * self.length[1]
    }

    /// From the end of the rocker to that of the coupler. Its multipliers are the force on the coupler there.
    #[holonomic]
    fn hinge(&self, q: &Coordinates) -> [f64; 2] {
        let rocker = Vector2::new(q.rocker.cos(), q.rocker.sin()) * self.length[2];
        let gap = self.end(q) - rocker;
        [gap.x - self.frame, gap.y]
    }
}

impl FourBar {
    /// The closed linkage with this crank angle, elbow upwards, and a rate of the crank \[rad/s].
    fn closed(&self, crank: f64, rate: f64) -> Option<State<f64, 3>> {
        let knee = Vector2::new(crank.cos(), crank.sin()) * self.length[0];
        let across = Vector2::new(self.frame, 0.0) - knee;
        let distance = across.norm();
        let [_, coupler, rocker] = self.length;
        let cos = (distance * distance + coupler * coupler - rocker * rocker) / (2.0 * distance * coupler);
        // NaN means that there is no triangle, either.
        let bend = Some(cos).filter(|cos| cos.abs() < 1.0)?.acos();
        let angle = across.y.atan2(across.x) + bend;
        let end = knee + Vector2::new(angle.cos(), angle.sin()) * coupler - Vector2::new(self.frame, 0.0);
        let q = [crank, angle, end.y.atan2(end.x)];
        // The ends of coupler and rocker have one velocity: Σ ± l n θ′ = 0 with n across each bar.
        let cross = |i: usize, j: usize| (q[j] - q[i]).sin();
        let w = rate * self.length[0] / cross(1, 2);
        let rates = [rate, -w * cross(0, 2) / coupler, -w * cross(0, 1) / rocker];
        self.consistent(State::new(q, rates)).ok()
    }
}

impl Model<3> for FourBar {
    const PARAMETERS: &'static [Slider] = &[
        Slider::new("crank", "m", [0.2, 0.6, 0.01], 0.4),
        Slider::new("coupler", "m", [0.8, 1.4, 0.01], 1.1),
        Slider::new("rocker", "m", [0.6, 1.2, 0.01], 0.8),
        Slider::new("gravity", "m/s²", [0.0, 20.0, 0.1], 9.8),
    ];
    const SETTINGS: &'static [Slider] = &[
        Slider::new("crank angle", "rad", [-3.1, 3.1, 0.01], 1.0),
        Slider::new("crank rate", "rad/s", [-20.0, 20.0, 0.1], 8.0),
    ];
    const REACTIONS: &'static [&'static str] = &["hinge, to the right [N]", "hinge, upwards [N]"];
    const VIEW: [f64; 4] = [-0.8, -1.0, 1.6, 1.3];

    fn new(p: &[f64]) -> Self {
        Self { length: [p[0], p[1], p[2]], frame: 1.0, g: p[3] }
    }

    fn placed(&self, settings: &[f64]) -> Option<State<f64, 3>> {
        self.closed(settings[0], settings[1])
    }

    fn settings(&self, state: &State<f64, 3>) -> Vec<f64> {
        vec![turned(state.q[0]), state.v[0]]
    }

    fn moved(&self, state: &State<f64, 3>, t: f64) -> Result<State<f64, 3>, MotionError<f64>> {
        follow(self, state, t)
    }

    fn energies(&self, state: &State<f64, 3>) -> [f64; 2] {
        [self.kinetic_energy(state), self.potential_energy(state)]
    }

    fn reactions(&self, state: &State<f64, 3>) -> Vec<f64> {
        self.reactions(state).map_or(vec![f64::NAN; 2], |found| found.hinge.to_vec())
    }

    fn draw(&self, state: &State<f64, 3>, scene: &mut Scene) {
        let q = state.q.into();
        let (knee, end): (Point, Point) = (self.knee(&q).into(), self.end(&q).into());
        let middle = self.second(&q).0;
        scene.trail(2, middle.into());
        scene.line(6, [[-0.1, 0.0], [self.frame + 0.1, 0.0]]);
        scene.line(0, [[0.0; 2], knee]);
        scene.line(1, [knee, end]);
        scene.line(3, [end, [self.frame, 0.0]]);
        for joint in [[0.0; 2], knee, end, [self.frame, 0.0]] {
            scene.disc(6, joint, 1.2);
        }
        let force = Model::reactions(self, state);
        scene.arrow(2, end, [0.01 * force[0], 0.01 * force[1]]);
    }

    fn handles(&self, state: &State<f64, 3>) -> Vec<Point> {
        vec![self.knee(&state.q.into()).into()]
    }

    fn dragged(&self, _: &State<f64, 3>, _: usize, [x, y]: Point) -> Option<State<f64, 3>> {
        self.closed(y.atan2(x), 0.0)
    }

    fn kept(&self, state: &State<f64, 3>) -> Option<State<f64, 3>> {
        self.consistent(*state).ok().or_else(|| self.closed(state.q[0], state.v[0]))
    }
}
