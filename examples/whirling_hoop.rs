//! A bead on a whirling hoop: in Cartesian coordinates, where a turning plane is a constraint that does work,
//! and by its angle in the hoop, where it rests as the hoop turns. Where it can rest, and whether that is
//! stable, changes with the rate.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};

use lagrangian::pictures::{Chart, Figure};
use lagrangian::prelude::*;

/// A bead that slides on a circular hoop, which turns about its vertical diameter at a given rate.
#[derive(Clone, Copy, Debug)]
pub struct WhirlingHoop {
    /// Mass of the bead \[kg].
    pub mass: f64,
    /// Radius of the hoop \[m].
    pub radius: f64,
    /// Angular velocity of the hoop \[rad/s].
    pub rate: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl WhirlingHoop {
    #[point(mass = self.mass)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * q.z
    }

    #[holonomic]
    fn sphere(&self, q: &Coordinates) -> f64 {
        self.bead(q).norm() - self.radius
    }

    /// The plane of the hoop, which turns; the unit gradient makes the multiplier the force of the hoop
    /// across it.
    #[holonomic]
    fn plane(&self, q: &Coordinates, t: f64) -> f64 {
        q.y * (self.rate * t).cos() - q.x * (self.rate * t).sin()
    }
}

impl WhirlingHoop {
    /// The bead at an angle from the upward vertical in the hoop at time zero, where the hoop is in the x-z
    /// plane.
    fn at_angle(&self, phi: f64, phi_dot: f64) -> State<f64, 3> {
        let (sin, cos) = phi.sin_cos();
        let along = self.radius * phi_dot;
        State::new(
            [self.radius * sin, 0.0, self.radius * cos],
            [along * cos, self.rate * self.radius * sin, -along * sin],
        )
    }

    /// Angle from the upward vertical \[rad], from 0 to 2π round the hoop, and its rate.
    fn angle(&self, state: &State<f64, 3>) -> (f64, f64) {
        let (sin, cos) = (self.rate * state.t).sin_cos();
        let outward = state.q[0] * cos + state.q[1] * sin;
        let speed = state.v[0] * cos + state.v[1] * sin;
        let angle = outward.atan2(state.q[2]).rem_euclid(2.0 * PI);
        (angle, (speed * state.q[2] - outward * state.v[2]) / self.radius.powi(2))
    }
}

/// The same bead by its angle in the hoop. The hoop's motion enters T: its part without velocities, T₀, lifts
/// the bead.
#[derive(Clone, Copy, Debug)]
pub struct InHoop(pub WhirlingHoop);

#[lagrangian(coordinates = [phi], jacobians)]
impl InHoop {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * self.0.mass * self.0.radius.powi(2) * (v.phi.powi(2) + (self.0.rate * q.phi.sin()).powi(2))
    }

    /// The angle is measured from the upward vertical.
    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.mass * self.0.g * self.0.radius * q.phi.cos()
    }
}

impl InHoop {
    /// The relative equilibrium \[rad] near a guess, and whether a small disturbance stays small.
    fn rest(&self, guess: f64) -> Result<(f64, bool), Box<dyn Error>> {
        let rest = self.equilibrium([guess], &[])?.state;
        let modes = self.modes(&rest, &[])?;
        Ok((rest.q[0], modes.iter().all(|mode| mode.eigenvalue.re <= 0.0)))
    }
}

/// Sideways force and energy balance, then phase portraits on both sides of the bifurcation.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n", WhirlingHoop::STRUCTURE);
    let hoop = WhirlingHoop { mass: 1.0, radius: 0.5, rate: 6.0, g: 9.81 };
    let start = hoop.at_angle(2.0, 0.3);
    let mut motion = hoop.simulate(start).with_tolerance(1e-13);

    println!("  t [s]   angle [rad]   sideways [N]   T + V [J]   motor [W]   residual");
    let mut worst = 0.0_f64;
    for k in 0..=5 {
        let t = f64::from(k);
        let state = *motion.advance_to(t)?;
        let sideways = motion.reactions().plane;
        let (phi, _) = hoop.angle(&state);
        let power = hoop.energy_rate(&state)?;
        let residual = hoop.constraint_residuals(&state).into_iter().map(f64::abs).fold(0.0, f64::max);
        println!(
            "{t:7.2} {phi:13.9} {sideways:14.9} {:11.6} {power:11.6} {residual:10.1e}",
            hoop.energy(&state)
        );
        // The motor turns the hoop against the sideways force at the bead's distance from the axis.
        worst = worst.max((power - sideways * hoop.rate * hoop.radius * phi.sin()).abs()).max(residual);
    }
    let (phi, phi_dot) = hoop.angle(motion.state());
    let exact = (1.989_927_259_958_213, -0.042_410_897_838_195_84);
    println!(
        "\nAfter 5 s: {phi:.15}, {phi_dot:.15}; one equation for the angle gives {:.15}, {:.15}",
        exact.0, exact.1
    );

    let portrait = |title: &str, hoop: WhirlingHoop| -> Result<Chart, Box<dyn Error>> {
        let mut chart = Chart::new(title, "angle from the top [rad]", "rate [rad/s]");
        for (phi, phi_dot) in
            [(PI, 0.6), (PI, 1.8), (PI, 3.5), (2.2, 0.0), (2.0 * PI - 2.2, 0.0), (FRAC_PI_2, 0.0), (1.0, 0.0)]
        {
            let mut motion = hoop.simulate(hoop.at_angle(phi, phi_dot));
            let states = motion.every(0.02).take(250).collect::<Result<Vec<_>, _>>()?;
            chart = chart.line("", states.iter().map(|state| hoop.angle(state)));
        }
        let rests = [0.3, 2.2, PI].map(|guess| InHoop(hoop).rest(guess));
        let rests = rests.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(chart.dots(rests.into_iter().flat_map(|(phi, _)| [(phi, 0.0), (2.0 * PI - phi, 0.0)])))
    };
    let critical = (hoop.g / hoop.radius).sqrt();
    println!("\n  rate [rad/s]   rest [rad from the bottom]   stable   bottom stable");
    let (mut raised, mut stable, mut unstable) = (Vec::new(), Vec::new(), Vec::new());
    let mut off = 0.0_f64;
    for tenths in 1_i32..=130 {
        let rate = 0.1 * f64::from(tenths);
        let frame = InHoop(WhirlingHoop { rate, ..hoop });
        let ((bottom, bottom_is_stable), (phi, is_stable)) = (frame.rest(PI)?, frame.rest(2.0)?);
        if bottom_is_stable { &mut stable } else { &mut unstable }.push((rate, bottom - PI));
        if rate > critical {
            raised.push((rate, PI - phi));
            off = off.max((phi.cos() + (critical / rate).powi(2)).abs());
        }
        if tenths % 26 == 0 {
            println!("{rate:14.1} {:28.9} {is_stable:>8} {bottom_is_stable:>15}", PI - phi);
        }
        // The bead always rests stably. The bottom is stable below the critical rate.
        assert!(is_stable && bottom_is_stable == (rate < critical), "{rate} rad/s");
    }
    let charts = [
        portrait("Slow, 3 rad/s: the bottom is stable", WhirlingHoop { rate: 3.0, ..hoop })?,
        portrait("Fast, 6 rad/s: the bottom is a saddle", hoop)?,
        Chart::new("Where the bead can rest", "rate of the hoop [rad/s]", "angle from the bottom [rad]")
            .line("raised, stable", raised.iter().copied())
            .line("raised, other side", raised.iter().map(|&(rate, phi)| (rate, -phi)))
            .line("bottom, stable", stable)
            .line("bottom, unstable", unstable),
    ];
    println!("Drawn: {}", Figure::new(charts).save("target/whirling_hoop.svg")?.display());

    assert!(off < 1e-14, "relative equilibria are off by {off:e}");
    assert!(worst < 1e-11, "the energy balance or the constraints are off by {worst:e}");
    assert!((phi - exact.0).abs() < 1e-11 && (phi_dot - exact.1).abs() < 1e-10, "{phi}, {phi_dot}");
    Ok(())
}
