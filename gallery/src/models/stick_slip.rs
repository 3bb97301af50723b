//! A block on a belt, held by a spring: it sticks, slips and sticks again.

use alloc::{vec, vec::Vec};

use lagrangian::prelude::*;

use crate::{Model, Point, Scene, Slider, follow};

/// A block on a moving belt, tied to a wall by a spring.
#[derive(Clone, Copy, Debug)]
pub struct Belt {
    /// Mass of the block \[kg].
    pub mass: f64,
    /// Stiffness of the spring \[N/m].
    pub stiffness: f64,
    /// Force between block and belt \[N].
    pub load: f64,
    /// Coefficient of friction while the block sticks.
    pub static_friction: f64,
    /// The same while it slips.
    pub kinetic_friction: f64,
    /// Speed of the belt \[m/s].
    pub speed: f64,
}

#[lagrangian(coordinates = [x])]
impl Belt {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x.powi(2)
    }

    /// The velocity of the block on the belt.
    #[friction(limit = self.kinetic_friction * self.load, static_limit = self.static_friction * self.load)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - self.speed
    }
}

impl Model<1> for Belt {
    const PARAMETERS: &'static [Slider] = &[
        Slider::new("belt speed", "m/s", [0.05, 1.0, 0.05], 0.2),
        Slider::new("stiffness", "N/m", [2.0, 30.0, 0.5], 9.0),
        Slider::new("static friction", "", [0.3, 0.8, 0.01], 0.5),
        Slider::new("kinetic friction", "", [0.0, 0.3, 0.01], 0.25),
    ];
    const SETTINGS: &'static [Slider] = &[Slider::new("place", "m", [-1.0, 1.0, 0.01], -0.2)];
    const REACTIONS: &'static [&'static str] = &["friction [N]"];
    const VIEW: [f64; 4] = [-1.6, -0.5, 1.2, 0.6];
    const CONSERVATIVE: bool = false;

    fn new(p: &[f64]) -> Self {
        let [speed, stiffness, static_friction, kinetic_friction] = [p[0], p[1], p[2], p[3]];
        Self { mass: 1.0, stiffness, load: 8.0, static_friction, kinetic_friction, speed }
    }

    fn placed(&self, settings: &[f64]) -> Option<State<f64, 1>> {
        Some(State::at_rest([settings[0]]))
    }

    fn settings(&self, state: &State<f64, 1>) -> Vec<f64> {
        vec![state.q[0]]
    }

    fn moved(&self, state: &State<f64, 1>, t: f64) -> Result<State<f64, 1>, MotionError<f64>> {
        follow(self, state, t)
    }

    fn energies(&self, state: &State<f64, 1>) -> [f64; 2] {
        [self.kinetic_energy(state), self.potential_energy(state)]
    }

    fn reactions(&self, state: &State<f64, 1>) -> Vec<f64> {
        vec![self.simulate(*state).reactions().slip]
    }

    fn draw(&self, state: &State<f64, 1>, scene: &mut Scene) {
        let x = state.q[0];
        scene.line(6, [[-1.6, 0.0], [1.2, 0.0]]);
        // Marks on the belt.
        for mark in 0..14 {
            let place = (0.2 * f64::from(mark) + self.speed * state.t) % 2.8;
            scene.line(5, [[place - 1.6, -0.02], [place - 1.6, -0.08]]);
        }
        let coil = |k: u8| {
            let up =
                if k == 0 || k == 16 { 0.0 } else { 0.05 * if k.is_multiple_of(2) { 1.0 } else { -1.0 } };
            [-1.5 + (x + 1.35) * f64::from(k) / 16.0, 0.15 + up]
        };
        scene.line(6, [[-1.5, 0.0], [-1.5, 0.3]]);
        scene.line(5, (0..=16).map(coil));
        scene.body(0, [[-0.15, 0.0], [0.15, 0.0], [0.15, 0.3], [-0.15, 0.3]].map(|[a, b]| [x + a, b]));
        scene.arrow(2, [x, 0.02], [0.1 * Model::reactions(self, state)[0], 0.0]);
    }

    fn handles(&self, state: &State<f64, 1>) -> Vec<Point> {
        vec![[state.q[0], 0.15]]
    }

    fn dragged(&self, _: &State<f64, 1>, _: usize, [x, _]: Point) -> Option<State<f64, 1>> {
        Some(State::at_rest([x.clamp(-1.0, 1.0)]))
    }
}
