//! Small oscillations of a chain that hangs by one end, and by both: equilibrium, tensions, frequencies and
//! shapes.

use std::error::Error;

use lagrangian::pictures::{Chart, Figure};
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

#[lagrangian(coordinates = [theta: [LINKS]], jacobians)]
impl Chain {
    const LINKS: usize = 12;

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

/// The same with both ends on hooks of equal height; the last joint carries nothing.
#[derive(Clone, Copy, Debug)]
pub struct Garland {
    /// Mass of each joint between links \[kg].
    pub mass: f64,
    /// Length of each link \[m].
    pub length: f64,
    /// Distance of the hooks \[m].
    pub span: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [theta: [LINKS]], jacobians)]
impl Garland {
    const LINKS: usize = 12;

    fn ends(&self, q: &Coordinates) -> [Vector2<f64>; Self::LINKS] {
        let mut end = Vector2::zeros();
        q.theta.map(|theta| {
            end += self.length * Vector2::new(theta.sin(), -theta.cos());
            end
        })
    }

    #[point(mass = self.mass)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; Self::LINKS - 1] {
        let ends = self.ends(q);
        std::array::from_fn(|i| ends[i])
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.joints(q).iter().map(|joint| self.mass * self.g * joint.y).sum()
    }

    /// The last link ends on the second hook, whose force is the multiplier.
    #[holonomic]
    fn hook(&self, q: &Coordinates) -> [f64; 2] {
        let end = self.ends(q)[Self::LINKS - 1];
        [end.x - self.span, end.y]
    }
}

/// The value of Laguerre's polynomial of degree `n`, and its slope.
fn laguerre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k + 1.0 - x) * value - k * before) / (k + 1.0));
    }
    (value, n as f64 * (value - before) / x)
}

/// Draws the rest and the ends of a swing: displacements to first order, the largest of them 0.15 m.
fn drawn<const J: usize, const N: usize>(
    title: &str,
    joints: impl Fn(&[f64; N]) -> [Vector2<f64>; J],
    rest: &[f64; N],
    shape: &[f64; N],
) -> Chart {
    let moved = |share: f64| joints(&std::array::from_fn(|i| rest[i] + share * shape[i]));
    let step = 1e-6 / shape.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let (at_rest, above, below) = (moved(0.0), moved(step), moved(-step));
    let displacements: [Vector2<f64>; J] = std::array::from_fn(|i| above[i] - below[i]);
    let largest = displacements.iter().fold(0.0_f64, |most, displacement| most.max(displacement.norm()));
    let mut chart = Chart::new(title, "x [m]", "y [m]").equal_scales();
    for (share, age) in [(-0.15, 0.2), (0.15, 0.2), (0.0, 1.0)] {
        let places = at_rest.iter().zip(&displacements).map(|(rest, by)| rest + by * (share / largest));
        let line = std::iter::once((0.0, 0.0)).chain(places.map(|place| (place.x, place.y)));
        chart = chart.linkage("", age, line);
    }
    chart
}

/// Compares the frequencies of the hanging chain, and the equilibrium of the garland, with closed forms.
/// Draws modes of both.
pub fn main() -> Result<(), Box<dyn Error>> {
    let chain = Chain { mass: 0.1, length: 0.1, g: 9.81 };
    let hanging = chain.equilibrium([0.3; Chain::LINKS], &[])?;
    let modes = chain.modes(&hanging.state, &[])?;
    println!("Hung up at one end, ω² l/g are the zeros of Laguerre's polynomial L₁₂:\n");
    println!("  mode   frequency [Hz]        ω² l/g   distance from the zero");
    let mut worst = 0.0_f64;
    for (n, mode) in (1..).zip(&modes) {
        let zero = mode.frequency().powi(2) * chain.length / chain.g;
        let (value, slope) = laguerre(Chain::LINKS, zero);
        let distance = (value / slope / zero).abs();
        worst = worst.max(distance);
        println!("{n:6} {:16.6} {zero:13.9} {distance:24.1e}", mode.frequency() / std::f64::consts::TAU);
    }

    let garland = Garland { mass: 0.1, length: 0.1, span: 0.8, g: 9.81 };
    let guess = std::array::from_fn(|i| 0.4 + 0.2 * i as f64);
    let sagging = garland.equilibrium(guess, &[])?;
    let [pull, lift] = sagging.multipliers;
    let oscillations = garland.modes(&sagging.state, &[])?;
    println!("\nBetween two hooks: the second pulls with {:.6} N and carries {:.6} N", pull, lift);
    let weight = garland.mass * garland.g;
    // In a chain at rest the slopes of the links are in arithmetic progression: H (tan − tan) = m g.
    let slopes = sagging.state.q.map(|theta| -1.0 / theta.tan());
    let catenary = slopes.windows(2).map(|pair| (pull * (pair[1] - pair[0]) / weight - 1.0).abs());
    let catenary = catenary.fold((lift - 5.5 * weight).abs() / weight, f64::max);
    println!("The slopes of its links are in arithmetic progression within {catenary:.1e}");
    println!(
        "{} modes from {:.4} to {:.4} rad/s",
        oscillations.len(),
        oscillations[0].frequency(),
        oscillations.last().map_or(0.0, |mode| mode.frequency())
    );

    let mut charts = Vec::new();
    for (n, mode) in (1..).zip(&modes).take(3) {
        let shape: [f64; Chain::LINKS] = std::array::from_fn(|i| mode.shape[i].re);
        let joints = |q: &[f64; Chain::LINKS]| chain.joints(&(*q).into());
        let title = format!("One end, mode {n}: {:.2} rad/s", mode.frequency());
        charts.push(drawn(&title, joints, &hanging.state.q, &shape));
    }
    for (n, mode) in (1..).zip(&oscillations).take(3) {
        let shape: [f64; Garland::LINKS] = std::array::from_fn(|i| mode.shape[i].re);
        let joints = |q: &[f64; Garland::LINKS]| garland.ends(&(*q).into());
        let title = format!("Two ends, mode {n}: {:.2} rad/s", mode.frequency());
        charts.push(drawn(&title, joints, &sagging.state.q, &shape));
    }
    println!("Drawn: {}", Figure::new(charts).save("target/chain_modes.svg")?.display());

    assert!(worst < 1e-12, "a frequency is off by {worst:e}");
    assert!(catenary < 1e-11, "the chain at rest is off by {catenary:e}");
    assert_eq!(oscillations.len(), Garland::LINKS - 2);
    Ok(())
}
