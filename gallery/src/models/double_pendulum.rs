//! Two point masses on massless rods.

use alloc::{vec, vec::Vec};

use lagrangian::prelude::*;

use crate::{Model, Point, Scene, Slider, follow};

/// A double pendulum in a vertical plane.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    /// Masses \[kg].
    pub m: [f64; 2],
    /// Rod lengths \[m].
    pub l: [f64; 2],
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [theta: [2]])]
impl DoublePendulum {
    /// Angles are measured from the downward vertical.
    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        self.l[0] * Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + self.l[1] * Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
    }
}

impl Model<2> for DoublePendulum {
    const PARAMETERS: &'static [Slider] = &[
        Slider::new("upper mass", "kg", [0.2, 5.0, 0.1], 1.0),
        Slider::new("lower mass", "kg", [0.2, 5.0, 0.1], 1.0),
        Slider::new("upper length", "m", [0.3, 1.2, 0.05], 1.0),
        Slider::new("lower length", "m", [0.3, 1.2, 0.05], 1.0),
        Slider::new("gravity", "m/s²", [0.5, 25.0, 0.1], 9.8),
    ];
    const SETTINGS: &'static [Slider] = &[
        Slider::new("upper angle", "rad", [-3.1, 3.1, 0.01], 2.0),
        Slider::new("lower angle", "rad", [-3.1, 3.1, 0.01], 2.5),
    ];
    const VIEW: [f64; 4] = [-2.5, -2.5, 2.5, 2.5];

    fn new(p: &[f64]) -> Self {
        Self { m: [p[0], p[1]], l: [p[2], p[3]], g: p[4] }
    }

    fn placed(&self, settings: &[f64]) -> Option<State<f64, 2>> {
        Some(State::at_rest([settings[0], settings[1]]))
    }

    fn settings(&self, state: &State<f64, 2>) -> Vec<f64> {
        state.q.map(turned).to_vec()
    }

    fn moved(&self, state: &State<f64, 2>, t: f64) -> Result<State<f64, 2>, MotionError<f64>> {
        follow(self, state, t)
    }

    fn energies(&self, state: &State<f64, 2>) -> [f64; 2] {
        [self.kinetic_energy(state), self.potential_energy(state)]
    }

    fn draw(&self, state: &State<f64, 2>, scene: &mut Scene) {
        let q = state.q.into();
        let (upper, lower): (Point, Point) = (self.upper(&q).into(), self.lower(&q).into());
        scene.trail(0, lower);
        scene.line(6, [[0.0; 2], upper, lower]);
        scene.disc(6, [0.0; 2], 0.7);
        scene.disc(1, upper, 1.6 * self.m[0].cbrt());
        scene.disc(0, lower, 1.6 * self.m[1].cbrt());
    }

    fn handles(&self, state: &State<f64, 2>) -> Vec<Point> {
        let q = state.q.into();
        vec![self.upper(&q).into(), self.lower(&q).into()]
    }

    fn dragged(&self, state: &State<f64, 2>, handle: usize, [x, y]: Point) -> Option<State<f64, 2>> {
        let mut q = state.q;
        let from = if handle == 0 { Vector2::zeros() } else { self.upper(&q.into()) };
        q[handle] = (x - from.x).atan2(from.y - y);
        Some(State::at_rest(q))
    }
}

/// An angle within half a turn of zero.
pub(crate) fn turned(angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    sin.atan2(cos)
}
