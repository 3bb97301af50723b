//! A pole on a cart: swung up and balanced, in f64 under error control and in f32 as a microcontroller would.

use std::error::Error;
use std::f64::consts::PI;

use lagrangian::Ordered;
use lagrangian::pictures::{Chart, Figure};
use lagrangian::prelude::*;

/// A cart on a rail, driven by a motor, with a pole hinged to it.
#[derive(Clone, Copy, Debug)]
pub struct CartPole<R> {
    /// Mass of the cart \[kg].
    pub cart_mass: R,
    /// Mass at the tip of the pole \[kg].
    pub pole_mass: R,
    /// Length of the pole \[m].
    pub length: R,
    /// Damping of the hinge \[N m s/rad].
    pub damping: R,
    /// Gravitational acceleration \[m/s²].
    pub g: R,
}

#[lagrangian(coordinates = [x, theta], inputs = [motor])]
impl<R: Real> CartPole<R> {
    #[point(mass = self.cart_mass)]
    fn cart(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, R::zero())
    }

    /// The angle is measured from the upward vertical.
    #[point(mass = self.pole_mass)]
    fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.pole_mass * self.g * self.tip(q).y
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities<R>) -> R {
        0.5 * self.damping * v.theta.powi(2)
    }

    #[force(at = cart)]
    fn motor(&self, u: &Inputs<R>) -> Vector2<R> {
        Vector2::new(u.motor, R::zero())
    }
}

impl<R: Ordered> CartPole<R> {
    /// A laboratory model: 0.5 kg cart, 0.2 kg on a pole of 0.4 m.
    pub fn laboratory() -> Self {
        let [cart_mass, pole_mass, length, damping, g] = [0.5, 0.2, 0.4, 0.002, 9.81].map(R::from_f64);
        Self { cart_mass, pole_mass, length, damping, g }
    }

    /// Motor force \[N] that pumps energy into the hanging pole, and balances it once it is nearly up.
    pub fn swing_up(&self, state: &State<R, 2>) -> R {
        let ([x, theta], [speed, rate]) = (state.q, state.v);
        let (sin, cos) = theta.sin_cos();
        if cos > R::from_f64(0.9) && rate.abs() < R::from_f64(4.0) {
            // The linear-quadratic regulator of the upright pole, for weights 1, 1, 0.1, 0.1 on x, θ, x′, θ′
            // and 0.1 on the force; the sine spares the angle from counting turns.
            let gains = [3.162_277_66, 24.995_827_77, 3.561_986_04, 4.665_676_39].map(R::from_f64);
            return gains[0] * x + gains[1] * sin + gains[2] * speed + gains[3] * rate;
        }
        // Whether the cart pushes with or against the pole is decided by the energy that the pole lacks.
        let swing = (self.length * rate).powi(2) / R::from_f64(2.0);
        let lacking = self.g * self.length * (R::one() - cos) - swing;
        let strongest = R::from_f64(3.0);
        let pump = -strongest * (R::from_f64(0.2) * lacking * rate * cos).tanh();
        let acceleration = pump - R::from_f64(5.0) * x - speed;
        // The cart also bears the pole.
        let load = sin * (sin * acceleration + self.g * cos - self.length * rate.powi(2));
        self.cart_mass * acceleration + self.pole_mass * load
    }
}

/// Swings the pole up twice and compares.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n\n{}\n", CartPole::<f64>::STRUCTURE, CartPole::<f64>::COST);
    let samples = 801;

    // The design: f64, feedback at every instant, steps chosen by the integrator.
    let plant = CartPole::<f64>::laboratory();
    let hanging = [0.0, PI - 0.1];
    let mut design = plant.simulate(State::at_rest(hanging)).with_control(|state| [plant.swing_up(state)]);
    let designed = design.every(0.01).take(samples).collect::<Result<Vec<_>, _>>()?;

    // The target: f32, a new force once a millisecond, one step of RK4 each. A held force does the work F Δx.
    let small = CartPole::<f32>::laboratory();
    let mut target = small.stepper::<Rk4>(State::at_rest(hanging.map(|value| value as f32)));
    let mut ran = vec![*target.state()];
    let (released, mut work, mut loss) = (target.energy(), 0.0, 0.0);
    while ran.len() < samples {
        for _ in 0..10 {
            let before = *target.state();
            let force = small.swing_up(&before);
            let after = target.step(1e-3, &[force])?;
            work += f64::from(force * (after.q[0] - before.q[0]));
            loss += f64::from(0.5e-3 * small.damping * (before.v[1].powi(2) + after.v[1].powi(2)));
        }
        ran.push(*target.state());
    }
    let gain = f64::from(target.energy() - released);

    println!("  t [s]   cart [m]   pole [rad]   motor [N]   power [W]   pole in f32 [rad]");
    for (state, ran) in designed.iter().zip(&ran).step_by(40) {
        let input = [plant.swing_up(state)];
        let power = plant.power(state, &input);
        let ([x, theta], [motor], small) = (state.q, input, ran.q[1]);
        println!("{:7.2} {x:10.4} {theta:12.4} {motor:11.3} {power:11.3} {small:19.4}", state.t);
    }
    println!(
        "\nIn f32 the motor's work {work:.5} J less the hinge's loss {loss:.5} J is the energy gained {gain:.5} J"
    );

    let angle = Chart::new("Swinging up and balancing", "time [s]", "pole from upright [rad]")
        .line("f64, error control", designed.iter().map(|state| (state.t, state.q[1])))
        .line("f32, RK4 at 1 kHz", ran.iter().map(|state| (state.t.into(), state.q[1].into())));
    let force = Chart::new("What the motor does", "time [s]", "force [N]")
        .line("", designed.iter().map(|state| (state.t, plant.swing_up(state))));
    println!("Drawn: {}", Figure::new([angle, force]).save("target/cart_pole.svg")?.display());

    for (name, angle) in [("f64", designed[samples - 1].q[1]), ("f32", ran[samples - 1].q[1].into())] {
        assert!(angle.sin().abs() < 5e-3 && angle.cos() > 0.0, "{name}: after 8 s the pole is at {angle}");
    }
    assert!((work - loss - gain).abs() < 1e-4, "{work} J less {loss} J, but the energy grew by {gain} J");
    Ok(())
}
