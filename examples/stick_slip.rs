//! A block on a belt, held by a spring: it sticks, slips and sticks again. Every motion that once sticks runs
//! into the same cycle; a small one about the middle goes on by itself.

use std::error::Error;

use lagrangian::pictures::{Chart, Figure};
use lagrangian::prelude::*;

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

/// Draws motions from several starts into their limit cycle, and measures its period.
pub fn main() -> Result<(), Box<dyn Error>> {
    let belt = Belt {
        mass: 1.0,
        stiffness: 9.0,
        load: 8.0,
        static_friction: 0.5,
        kinetic_friction: 0.3,
        speed: 0.2,
    };
    // It slips from where the spring is as strong as static friction, about the middle that kinetic friction
    // gives, until it is as fast as the belt again.
    let rate = (belt.stiffness / belt.mass).sqrt();
    let [held, middle] =
        [belt.static_friction, belt.kinetic_friction].map(|friction| friction * belt.load / belt.stiffness);
    let slipping = 2.0 * (std::f64::consts::PI - ((held - middle) * rate / belt.speed).atan()) / rate;
    let sticking = 2.0 * (held - middle) / belt.speed;

    let mut phases = Chart::new("A block on a belt: phase portrait", "place [m]", "velocity [m/s]");
    let mut places = Chart::new("Sticking and slipping", "time [s]", "place [m]");
    for (label, start) in [
        ("about the middle", State::at_rest([0.28])),
        ("pulled far", State::at_rest([-0.2])),
        ("sticking", State::new([0.0], [belt.speed])),
    ] {
        let mut motion = belt.simulate(start).with_tolerance(1e-12);
        let states = motion.every(0.02).take(600).collect::<Result<Vec<_>, _>>()?;
        phases = phases.line(label, states.iter().map(|state| (state.q[0], state.v[0])));
        places = places.line(label, states.iter().map(|state| (state.t, state.q[0])));
    }
    println!("Drawn: {}", Figure::new([phases, places]).save("target/stick_slip.svg")?.display());

    // The motion passes this place, near the middle of the cycle, upwards once a period.
    let mut motion = belt.simulate(State::at_rest([-0.2])).with_tolerance(1e-12);
    motion.advance_to(20.0)?;
    let mut times = Vec::new();
    for passage in motion.events(|state: &State<f64, 1>| state.q[0] - 0.3, 60.0).rising() {
        times.push(passage?.state.t);
    }
    let period = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    println!(
        "The block slips for {slipping:.6} s and sticks for {sticking:.6} s: {:.12} s",
        slipping + sticking
    );
    println!("Period of the motion: {period:.12} s over {} cycles", times.len() - 1);
    println!("{}", Belt::STRUCTURE);

    let error = (period / (slipping + sticking) - 1.0).abs();
    assert!(error < 1e-10, "the period is off by {error:e} of itself");
    Ok(())
}
