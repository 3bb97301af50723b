//! A coin that rolls on a table without slipping: nonholonomic constraints, and the friction that keeps them.

use std::error::Error;

use lagrangian::pictures::{Chart, Figure};
use lagrangian::prelude::*;

/// A thin homogeneous disc on a horizontal plane.
#[derive(Clone, Copy, Debug)]
pub struct RollingDisc {
    /// Mass \[kg].
    pub mass: f64,
    /// Radius \[m].
    pub radius: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

/// The point of contact, the heading of the track, the lean to the right, the angle rolled.
#[lagrangian(coordinates = [x, y, heading, lean, spin])]
impl RollingDisc {
    fn centre(&self, q: &Coordinates) -> Vector3<f64> {
        let aside = Vector3::new(q.heading.sin(), -q.heading.cos(), 0.0) * q.lean.sin();
        Vector3::new(q.x, q.y, 0.0) + self.radius * (aside + q.lean.cos() * Vector3::z())
    }

    /// The disc's own axis is horizontal where the disc does not lean.
    #[body(mass = self.mass, inertia = [
        self.mass * self.radius.powi(2) / 4.0,
        self.mass * self.radius.powi(2) / 2.0,
        self.mass * self.radius.powi(2) / 4.0,
    ])]
    fn disc(&self, q: &Coordinates) -> Isometry3<f64> {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.heading)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.lean)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.spin);
        Isometry3::from_parts(self.centre(q).into(), attitude.into())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.centre(q).z
    }

    /// The contact moves as far as the rim unrolls.
    #[nonholonomic]
    fn rolling(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let speed = self.radius * v.spin;
        [v.x - speed * q.heading.cos(), v.y - speed * q.heading.sin()]
    }
}

/// Against reference digits, then the path of a coin that goes round and of one that wobbles.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n", RollingDisc::STRUCTURE);
    let disc = RollingDisc { mass: 1.0, radius: 0.4, g: 9.81 };
    let start = State::new([0.0, 0.0, 0.0, 0.3, 0.0], [2.0, 0.0, 0.7, -0.2, 5.0]);
    let mut motion = disc.simulate(start).with_tolerance(1e-13);

    println!("  t [s]      x [m]      y [m]   heading   lean [rad]   friction [N]   slip [m/s]   T + V [J]");
    for k in 0..=6 {
        let state = *motion.advance_to(0.5 * f64::from(k))?;
        let [along_x, along_y] = motion.reactions().rolling;
        let slip = disc.constraint_residuals(&state).into_iter().map(f64::abs).fold(0.0, f64::max);
        let [x, y, heading, lean, _] = state.q;
        println!(
            "{:7.2} {x:10.6} {y:10.6} {heading:9.5} {lean:12.6} {:14.6} {slip:12.1e} {:11.8}",
            state.t,
            along_x.hypot(along_y),
            disc.energy(&state)
        );
    }
    let exact = [
        -1.477_278_611_908_957_9,
        -1.378_397_198_428_950_7,
        -5.044_710_756_634_100_1,
        0.505_256_831_147_019_7,
    ];
    let reached = *motion.state();
    let miss = reached.q.iter().zip(exact).map(|(q, exact)| (q - exact).abs()).fold(0.0, f64::max);
    let drift = (disc.energy(&reached) / disc.energy(&start) - 1.0).abs();
    println!("\nAfter 3 s: {miss:.1e} from the reference, energy {drift:.1e} off");

    let path = |title: &str, start: State<f64, 5>, duration: f64| -> Result<Chart, Box<dyn Error>> {
        let mut motion = disc.simulate(start);
        let states = motion.every(0.002).take((duration / 0.002) as usize).collect::<Result<Vec<_>, _>>()?;
        let centre = |state: &State<f64, 5>| {
            let centre = disc.centre(&state.q.into());
            (centre.x, centre.y)
        };
        Ok(Chart::new(title, "x [m]", "y [m]")
            .equal_scales()
            .line("contact", states.iter().map(|state| (state.q[0], state.q[1])))
            .line("centre", states.iter().map(centre)))
    };
    let charts = [
        path("The path of the start above", start, 12.0)?,
        path(
            "Slower: it wobbles along",
            disc.consistent(State::new([0.0, 0.0, 0.0, 0.15, 0.0], [0.0, 0.0, 0.0, 0.0, 4.2]))?,
            12.0,
        )?,
    ];
    println!("Drawn: {}", Figure::new(charts).save("target/rolling_disc.svg")?.display());

    assert!(miss < 1e-10, "the disc is {miss:e} off");
    assert!(drift < 1e-12, "the energy changed by {drift:e} of itself");
    Ok(())
}
