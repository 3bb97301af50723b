//! A pole on a cart, which a motor swings up and balances.

use alloc::{vec, vec::Vec};

use lagrangian::prelude::*;

use super::double_pendulum::turned;
use crate::{Model, Point, Scene, Slider};

/// A cart on a rail, driven by a motor, with a pole hinged to it.
#[derive(Clone, Copy, Debug)]
pub struct CartPole {
    /// Mass of the cart \[kg].
    pub cart_mass: f64,
    /// Mass at the tip of the pole \[kg].
    pub pole_mass: f64,
    /// Length of the pole \[m].
    pub length: f64,
    /// Damping of the hinge \[N m s/rad].
    pub damping: f64,
    /// A force on the cart beside the motor's \[N].
    pub push: f64,
    /// The share of the regulator's force that the motor gives: 0 is off, 1 is on.
    pub motor_on: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [x, theta], inputs = [motor])]
impl CartPole {
    #[point(mass = self.cart_mass)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    /// The angle is measured from the upward vertical.
    #[point(mass = self.pole_mass)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.pole_mass * self.g * self.tip(q).y
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.theta.powi(2)
    }

    #[force(at = cart)]
    fn motor(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.motor, 0.0)
    }
}

impl CartPole {
    /// Force \[N] that pumps energy into the hanging pole, and balances it once it is nearly up: the
    /// regulator of `examples/cart_pole.rs`.
    fn swing_up(&self, state: &State<f64, 2>) -> f64 {
        let ([x, theta], [speed, rate]) = (state.q, state.v);
        let (sin, cos) = theta.sin_cos();
        if cos > 0.9 && rate.abs() < 4.0 {
            let gains = [3.162_277_66, 24.995_827_77, 3.561_986_04, 4.665_676_39];
            return gains[0] * x + gains[1] * sin + gains[2] * speed + gains[3] * rate;
        }
        let swing = (self.length * rate).powi(2) / 2.0;
        let lacking = self.g * self.length * (1.0 - cos) - swing;
        let pump = -3.0 * (0.2 * lacking * rate * cos).tanh();
        let acceleration = pump - 5.0 * x - speed;
        let load = sin * (sin * acceleration + self.g * cos - self.length * rate.powi(2));
        self.cart_mass * acceleration + self.pole_mass * load
    }

    fn force(&self, state: &State<f64, 2>) -> f64 {
        self.push + self.motor_on * self.swing_up(state)
    }
}

impl Model<2> for CartPole {
    const PARAMETERS: &'static [Slider] = &[
        Slider::new("push", "N", [-3.0, 3.0, 0.1], 0.0),
        Slider::new("motor (0 is off, 1 is on)", "", [0.0, 1.0, 1.0], 1.0),
        Slider::new("pole length", "m", [0.3, 0.5, 0.01], 0.4),
        Slider::new("damping", "N m s/rad", [0.0, 0.01, 0.001], 0.002),
    ];
    const SETTINGS: &'static [Slider] = &[
        Slider::new("place", "m", [-0.8, 0.8, 0.01], 0.0),
        Slider::new("pole from upright", "rad", [-3.1, 3.1, 0.01], 3.04),
    ];
    const REACTIONS: &'static [&'static str] = &["force of motor and push [N]"];
    const VIEW: [f64; 4] = [-1.2, -0.65, 1.2, 0.65];
    const CONSERVATIVE: bool = false;

    fn new(p: &[f64]) -> Self {
        let [push, motor_on, length, damping] = [p[0], p[1], p[2], p[3]];
        Self { cart_mass: 0.5, pole_mass: 0.2, length, damping, push, motor_on, g: 9.81 }
    }

    fn placed(&self, settings: &[f64]) -> Option<State<f64, 2>> {
        Some(State::at_rest([settings[0], settings[1]]))
    }

    fn settings(&self, state: &State<f64, 2>) -> Vec<f64> {
        vec![state.q[0], turned(state.q[1])]
    }

    fn moved(&self, state: &State<f64, 2>, t: f64) -> Result<State<f64, 2>, MotionError<f64>> {
        let mut motion = self.simulate(*state).with_control(|state| [self.force(state)]);
        motion = motion.with_tolerance(1e-10).with_max_steps(20_000);
        motion.advance_to(t).copied()
    }

    fn energies(&self, state: &State<f64, 2>) -> [f64; 2] {
        [self.kinetic_energy(state), self.potential_energy(state)]
    }

    fn reactions(&self, state: &State<f64, 2>) -> Vec<f64> {
        vec![self.force(state)]
    }

    fn draw(&self, state: &State<f64, 2>, scene: &mut Scene) {
        let q = state.q.into();
        let (cart, tip): (Point, Point) = (self.cart(&q).into(), self.tip(&q).into());
        scene.line(6, [[-1.2, -0.08], [1.2, -0.08]]);
        let corners = [[-0.12, -0.06], [0.12, -0.06], [0.12, 0.06], [-0.12, 0.06]];
        scene.body(0, corners.map(|[x, y]| [cart[0] + x, cart[1] + y]));
        scene.line(6, [cart, tip]);
        scene.disc(1, tip, 2.2);
        scene.arrow(2, cart, [0.05 * self.force(state), 0.0]);
    }

    fn handles(&self, state: &State<f64, 2>) -> Vec<Point> {
        let q = state.q.into();
        vec![self.cart(&q).into(), self.tip(&q).into()]
    }

    fn dragged(&self, state: &State<f64, 2>, handle: usize, [x, y]: Point) -> Option<State<f64, 2>> {
        let mut q = state.q;
        if handle == 0 {
            q[0] = x.clamp(-1.0, 1.0);
        } else {
            q[1] = (x - q[0]).atan2(y);
        }
        Some(State::at_rest(q))
    }
}
