//! A chain of ten links: falling like a whip, and swinging in a mode that Laguerre's polynomial knows.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, TAU};

use lagrangian::pictures::Chart;
use lagrangian::prelude::*;

/// Point masses on massless links, hung up at one end, in a vertical plane.
#[derive(Clone, Copy, Debug)]
pub struct Chain {
    /// Mass at the end of each link \[kg].
    pub mass: f64,
    /// Length of each link \[m].
    pub length: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [theta: [LINKS]])]
impl Chain {
    /// A hundred links take one more digit here.
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

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.joints(q).iter().map(|joint| self.mass * self.g * joint.y).sum()
    }
}

/// Sideways displacement of the joints in the slowest mode, from the fixed end to the free end (1), and ω²
/// l/g.
///
/// In a small oscillation the link above joint j, counted from the free end, carries j + 1 masses. That makes
/// the displacements Laguerre polynomials: x_j = L_j(ξ), with ξ = ω² l/g a zero of L_n where the chain is
/// held.
fn slowest_mode() -> ([f64; Chain::LINKS + 1], f64) {
    let shape = |xi: f64| {
        let mut x = [1.0; Chain::LINKS + 1];
        let mut before = 0.0;
        for j in 0..Chain::LINKS {
            x[j + 1] = ((2.0 * j as f64 + 1.0 - xi) * x[j] - j as f64 * before) / (j as f64 + 1.0);
            before = x[j];
        }
        x.reverse();
        x
    };
    // A heavy rope would have ξ = 1.4458/n. The first zero of the chain lies a little below that, the second
    // one far above.
    let (mut low, mut high) = (0.0, 1.4458 / Chain::LINKS as f64);
    while high - low > 4.0 * f64::EPSILON * high {
        let middle = 0.5 * (low + high);
        if shape(middle)[0] > 0.0 { low = middle } else { high = middle }
    }
    (shape(low), low)
}

/// Drops a stretched chain, then swings a hanging one for a period.
pub fn main() -> Result<(), Box<dyn Error>> {
    let chain = Chain { mass: 0.1, length: 0.1, g: 9.81 };
    println!("{}\n\n{}\n", Chain::STRUCTURE, Chain::COST);

    let mut motion = chain.simulate(State::at_rest([FRAC_PI_2; Chain::LINKS]));
    let released = motion.energy();
    let frames = 17;
    let mut strobe = Chart::new("A falling chain every 50 ms", "x [m]", "y [m]").equal_scales();
    println!("  t [s]   tip x [m]   tip y [m]   tip speed [m/s]");
    let mut before = Vector2::new(1.0, 0.0);
    for (frame, state) in motion.every(0.05).take(frames).enumerate() {
        let state = state?;
        let joints = chain.joints(&state.q.into());
        let tip = joints[Chain::LINKS - 1];
        println!("{:7.2} {:11.4} {:11.4} {:17.2}", state.t, tip.x, tip.y, (tip - before).norm() / 0.05);
        before = tip;
        let links = std::iter::once((0.0, 0.0)).chain(joints.iter().map(|joint| (joint.x, joint.y)));
        let label = match frame {
            0 => "let go",
            last if last + 1 == frames => "0.8 s later",
            _ => "",
        };
        strobe = strobe.linkage(label, frame as f64 / (frames - 1) as f64, links);
    }
    let scale = chain.mass * chain.g * chain.length * 55.0;
    let drift = (motion.energy() - released) / scale;
    println!("\nEnergy error while falling: {drift:.1e} of what a fall to the bottom sets free");
    println!("Drawn: {}", strobe.save("target/ten_link_chain.svg")?.display());

    // The slowest mode returns after a period, but for terms of third order in the amplitude.
    let (shape, xi) = slowest_mode();
    let period = TAU / (xi * chain.g / chain.length).sqrt();
    let amplitude = 1e-3;
    let hanging: [f64; Chain::LINKS] = std::array::from_fn(|i| amplitude * (shape[i + 1] - shape[i]));
    let mut motion = chain.simulate(State::at_rest(hanging));
    let swung = motion.advance_to(period)?;
    let miss = swung.q.iter().zip(hanging).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / amplitude;
    println!("Slowest mode: ω² l/g = {xi:.10}, period {period:.6} s; returns to {miss:.1e} of its amplitude");

    assert!(drift.abs() < 1e-8, "the energy changed by {drift:e}");
    assert!(miss < 1e-5, "after a period the chain is {miss:e} of its amplitude off");
    Ok(())
}
