//! A heavy symmetric top: precession and nutation, its integrals, and the path of its axis on the sphere.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::RangeInclusive;

use lagrangian::pictures::{Chart, Figure};
use lagrangian::prelude::*;

/// A symmetric top with its tip fixed.
#[derive(Clone, Copy, Debug)]
pub struct Top {
    /// Mass \[kg].
    pub mass: f64,
    /// Moment of inertia about any line through the centre of mass across the axis \[kg m²].
    pub across: f64,
    /// Moment of inertia about the axis \[kg m²].
    pub along: f64,
    /// Distance from the tip to the centre of mass \[m].
    pub arm: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [precession, nutation, spin], analysis, verify = Self::new(0.004, 0.0015, 0.25, 0.05, 9.81))]
impl Top {
    /// Euler's angles about z, x′, z″: where the axis points, how far it leans, how far the top has turned.
    fn attitude(&self, q: &Coordinates) -> Rotation3<f64> {
        Rotation3::from_axis_angle(&Vector3::z_axis(), q.precession)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.nutation)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.spin)
    }

    #[body(mass = self.mass, inertia = [self.across, self.across, self.along])]
    fn gyroscope(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        let attitude = self.attitude(q);
        IsometryMatrix3::from_parts((attitude * Vector3::new(0.0, 0.0, self.arm)).into(), attitude)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.gyroscope(q).translation.z
    }
}

impl Top {
    /// From moments of inertia about the tip \[kg m²], and the weight's greatest moment \[N m].
    pub fn new(across: f64, along: f64, moment: f64, arm: f64, g: f64) -> Self {
        let mass = moment / (g * arm);
        Self { mass, across: across - mass * arm * arm, along, arm, g }
    }
}

/// The path of the axis seen from 50° above the horizon, with an initial precession \[rad/s].
fn axis_path(title: &str, top: &Top, precession: f64) -> Result<Chart, Box<dyn Error>> {
    let (sin, cos) = 50_f64.to_radians().sin_cos();
    let seen = |axis: Vector3<f64>| (axis.x, axis.z * cos + axis.y * sin);
    let circle = |colatitude: f64, degrees: RangeInclusive<i32>| {
        let (sin, cos) = colatitude.sin_cos();
        degrees.map(move |degree| {
            let (y, x) = f64::from(degree).to_radians().sin_cos();
            seen(Vector3::new(x * sin, y * sin, cos))
        })
    };
    let outline = (0..=360).map(|degree| f64::from(degree).to_radians().sin_cos());
    let start = State::new([0.0, 0.6, 0.0], [precession, 0.0, 60.0]);
    let mut motion = top.simulate(start);
    let path = motion.every(0.005).take(500).collect::<Result<Vec<_>, _>>()?;
    let axis = |state: &State<f64, 3>| seen(top.attitude(&state.q.into()) * Vector3::z());
    Ok(Chart::new(title, "", "")
        .equal_scales()
        .guide(outline)
        .guide(circle(FRAC_PI_2, 180..=360))
        .guide(circle(0.6, 0..=360))
        .line("", path.iter().map(axis))
        .dots([seen(Vector3::z())]))
}

/// Compares with elliptic integrals, then draws three tops.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n\n{}\n", Top::STRUCTURE, Top::EQUATIONS);
    let top = Top::new(0.004, 0.0015, 0.25, 0.05, 9.81);
    println!("{}\n", top.verify()?);
    let start = State::new([0.0, 0.6, 0.0], [0.0, 0.0, 150.0]);
    let mut motion = top.simulate(start).with_tolerance(1e-13);

    // Let go without precession, the axis falls and returns to rest in a cusp: Newton's method finds when.
    let mut nutation_period = TAU * 0.004 / (0.0015 * 150.0);
    for _ in 0..6 {
        let state = motion.advance_to(nutation_period)?;
        nutation_period -= state.v[1] / top.accelerations(state)?[1];
    }
    let precession = motion.advance_to(nutation_period)?.q[0];
    let lowest = motion.advance_to(0.5 * nutation_period)?.q[1];
    let end = *motion.advance_to(0.5)?;
    let integrals = [top.conserved(&start), top.conserved(&end)];
    assert_eq!(Top::CYCLIC, ["precession", "spin"]);
    // About the vertical and about the axis of the top: C ψ′ cos θ and C ψ′ as long as it does not precess.
    let [about_vertical, about_axis] = top.cyclic_momenta(&start);
    assert!((about_vertical / about_axis - 0.6_f64.cos()).abs() < 1e-14);

    // Elliptic integrals to 30 digits (Goldstein, Classical Mechanics, ch. 5), cut to the precision of f64.
    let compared = [
        ("nutation period [s]", nutation_period, 0.115_482_298_651_751_2),
        ("precession in it [rad]", precession, 0.130_440_343_699_040_57),
        ("cosine of largest lean", lowest.cos(), 0.811_869_209_511_255_8),
        ("precession at 0.5 s [rad]", end.q[0], 0.546_995_295_968_563),
        ("lean at 0.5 s [rad]", end.q[1], 0.617_425_343_711_288_8),
    ];
    println!("{:25} {:>20} {:>20} {:>9}", "", "simulated", "quadrature", "error");
    for (name, simulated, exact) in compared {
        println!("{name:25} {simulated:20.15} {exact:20.15} {:9.1e}", simulated - exact);
    }
    println!("\n{:25} {:>20} {:>20}", "conserved", "at 0.5 s", "at the start");
    for (i, name) in Top::CONSERVED.iter().enumerate() {
        println!("{name:25} {:20.15} {:20.15}", integrals[1][i], integrals[0][i]);
    }

    let charts = [
        axis_path("Started backwards: loops", &top, -2.0)?,
        axis_path("Let go: cusps", &top, 0.0)?,
        axis_path("Started forwards: waves", &top, 1.5)?,
    ];
    println!("Drawn: {}", Figure::new(charts).save("target/heavy_top.svg")?.display());

    for (name, simulated, exact) in compared {
        assert!((simulated - exact).abs() < 1e-10, "{name}: {simulated}, not {exact}");
    }
    for (i, name) in Top::CONSERVED.iter().enumerate() {
        let [before, after] = integrals.map(|integrals| integrals[i]);
        assert!((after / before - 1.0).abs() < 1e-11, "{name}: {before} became {after}");
    }
    Ok(())
}
