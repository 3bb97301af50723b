//! A mass on a spring, tuned so that bouncing feeds swinging: 2 to 1 resonance and energy that wanders to and
//! fro.

use std::error::Error;
use std::f64::consts::TAU;

use lagrangian::pictures::{Chart, Figure};
use lagrangian::prelude::*;

/// A point mass on a spring that swings in a vertical plane.
#[derive(Clone, Copy, Debug)]
pub struct SpringPendulum {
    /// Mass \[kg].
    pub mass: f64,
    /// Stiffness \[N/m].
    pub stiffness: f64,
    /// Length of the unstretched spring \[m].
    pub natural_length: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [r, theta])]
impl SpringPendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        q.r * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * (q.r - self.natural_length).powi(2)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.bob(q).y
    }
}

impl SpringPendulum {
    /// Stiffness and natural length such that the mass hangs at `length` \[m] and bounces twice a swing.
    pub fn resonant(mass: f64, length: f64, g: f64) -> Self {
        Self { mass, stiffness: 4.0 * mass * g / length, natural_length: 0.75 * length, g }
    }
}

/// Lets the mass bounce almost vertically and watches the swing grow.
pub fn main() -> Result<(), Box<dyn Error>> {
    let (length, bounce) = (1.0, 0.06);
    let pendulum = SpringPendulum::resonant(1.0, length, 9.81);
    let swing_rate = (pendulum.g / length).sqrt();
    let period = TAU / swing_rate;

    let start = State::at_rest([length + bounce, 1e-4]);
    let mut motion = pendulum.simulate(start).with_tolerance(1e-12);
    let energy = motion.energy();
    let samples = 100;
    let states = motion.every(period / samples as f64).take(100 * samples).collect::<Result<Vec<_>, _>>()?;

    // Amplitudes of both motions, one of each for a period of the swing.
    let largest = |values: &[State<f64, 2>], value: fn(&State<f64, 2>) -> f64| {
        values.iter().map(|state| value(state).abs()).fold(0.0, f64::max)
    };
    let swings: Vec<f64> = states.chunks(samples).map(|period| largest(period, |state| state.q[1])).collect();
    // A bounce passes its middle at the velocity a ω.
    let bounces: Vec<f64> = states
        .chunks(samples)
        .map(|period| largest(period, |state| state.v[0]) / (2.0 * swing_rate))
        .collect();
    println!("  swings   swing amplitude [rad]   bounce amplitude [mm]");
    for (count, (swing, bounce)) in swings.iter().zip(&bounces).enumerate().step_by(5) {
        println!("{count:8} {swing:23.5} {:23.2}", 1000.0 * bounce);
    }

    // A bounce of amplitude a modulates the swing at twice its frequency ω: Mathieu's equation says that
    // a small swing grows as exp(¾ ω t a / length), to first order in a.
    let growth = (swings[20] / swings[10]).ln() / (10.0 * period);
    let expected = 0.75 * swing_rate * bounce / length;
    println!("\nGrowth of the swing: {growth:.5} /s; Mathieu's equation: {expected:.5} /s");
    let drift = (motion.energy() - energy) / energy;
    println!("Energy error: {drift:.1e}");

    let position = |state: &State<f64, 2>| {
        let bob = pendulum.bob(&state.q.into());
        (bob.x, bob.y)
    };
    let path = Chart::new("Path from the 20th to the 36th swing", "x [m]", "y [m]")
        .equal_scales()
        .line("", states[20 * samples..36 * samples].iter().map(position));
    let times = || (0..).map(|count| f64::from(count) * period);
    let exchange = Chart::new("Bouncing feeds swinging and back", "time [s]", "amplitude [m]")
        .line("swing", times().zip(swings.iter().map(|angle| length * angle)))
        .line("bounce", times().zip(bounces));
    println!("Drawn: {}", Figure::new([path, exchange]).save("target/spring_pendulum.svg")?.display());

    assert!((growth / expected - 1.0).abs() < 0.02, "the swing grows at {growth} /s, not {expected} /s");
    assert!(drift.abs() < 1e-10, "the energy changed by {drift:e} of itself");
    Ok(())
}
