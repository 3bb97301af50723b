//! Andrews' squeezing mechanism: seven bodies, three closed loops, a constant torque; a benchmark of
//! multibody codes.
//!
//! Giles in Schiehlen (ed.), *Multibody Systems Handbook*, 1990; Hairer and Wanner, *Solving Ordinary
//! Differential Equations II*, VII.7; the Test Set for IVP Solvers (Bari) has it as `andrews`.

use std::error::Error;

use lagrangian::pictures::{Chart, Figure};
use lagrangian::prelude::*;

/// Fixed hinges \[m].
const A: [f64; 2] = [-0.069_34, -0.002_27];
const B: [f64; 2] = [-0.036_35, 0.032_73];
/// Where the spring is fixed \[m].
const C: [f64; 2] = [0.014, 0.072];

/// The mechanism; lengths are those of the benchmark.
#[derive(Clone, Copy, Debug)]
pub struct Squeezer {
    /// Masses of the bodies \[kg].
    pub mass: [f64; 7],
    /// Moments of inertia about their centres \[kg m²].
    pub inertia: [f64; 7],
    /// Stiffness of the spring \[N/m] and its length without load \[m].
    pub spring: (f64, f64),
    /// Torque of the motor \[N m].
    pub torque: f64,
}

/// The crank, the coupler against it, the lever, then two pairs of bars; all angles \[rad].
#[lagrangian(coordinates = [beta, theta, gamma, phi, delta, omega, epsilon])]
impl Squeezer {
    #[body(mass = self.mass[0], inertia = self.inertia[0])]
    fn crank(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::along(q.beta) * 0.000_92, q.beta)
    }

    #[body(mass = self.mass[1], inertia = self.inertia[1])]
    fn coupler(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let angle = q.beta + q.theta;
        (Self::along(q.beta) * 0.007 - Self::along(angle) * 0.0115, angle)
    }

    /// The bar that the spring pulls.
    #[body(mass = self.mass[2], inertia = self.inertia[2])]
    fn lever(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::at(B) - Self::across(q.gamma) * 0.018_74 + Self::along(q.gamma) * 0.010_43, q.gamma)
    }

    #[body(mass = self.mass[3], inertia = self.inertia[3])]
    fn lower_outer(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let angle = q.phi + q.delta;
        (Self::at(A) + Self::along(q.delta) * 0.04 - Self::across(angle) * (0.02 - 0.014_21), angle)
    }

    #[body(mass = self.mass[4], inertia = self.inertia[4])]
    fn lower_inner(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::at(A) + Self::along(q.delta) * 0.023_08 + Self::across(q.delta) * 0.009_16, q.delta)
    }

    #[body(mass = self.mass[5], inertia = self.inertia[5])]
    fn upper_outer(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let angle = q.omega + q.epsilon;
        (Self::at(A) - Self::across(q.epsilon) * 0.04 + Self::along(angle) * (0.02 - 0.014_21), angle)
    }

    #[body(mass = self.mass[6], inertia = self.inertia[6])]
    fn upper_inner(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::at(A) - Self::across(q.epsilon) * 0.012_28 - Self::along(q.epsilon) * 0.004_49, q.epsilon)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let end = Self::at(B) + Self::along(q.gamma) * 0.02 - Self::across(q.gamma) * 0.018;
        let (stiffness, length) = self.spring;
        0.5 * stiffness * ((end - Self::at(C)).norm() - length).powi(2)
    }

    #[force(on = beta)]
    fn motor(&self) -> f64 {
        self.torque
    }

    /// The three bars meet at the end of the coupler.
    #[holonomic]
    fn hinges(&self, q: &Coordinates) -> [f64; 6] {
        let end = Self::along(q.beta) * 0.007 - Self::along(q.beta + q.theta) * 0.028;
        let lever = end - (Self::at(B) - Self::across(q.gamma) * 0.035);
        let lower = end - (Self::at(A) + Self::along(q.delta) * 0.04 - Self::across(q.phi + q.delta) * 0.02);
        let upper =
            end - (Self::at(A) - Self::across(q.epsilon) * 0.04 + Self::along(q.omega + q.epsilon) * 0.02);
        [lever.x, lever.y, lower.x, lower.y, upper.x, upper.y]
    }

    fn at(place: [f64; 2]) -> Vector2<f64> {
        Vector2::new(place[0], place[1])
    }

    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    fn across(angle: f64) -> Vector2<f64> {
        Vector2::new(-angle.sin(), angle.cos())
    }
}

impl Squeezer {
    /// The data of the benchmark.
    pub fn benchmark() -> Self {
        Self {
            mass: [0.043_25, 0.003_65, 0.023_73, 0.007_06, 0.070_50, 0.007_06, 0.054_98],
            inertia: [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5],
            spring: (4530.0, 0.077_85),
            torque: 0.033,
        }
    }
}

/// Against reference digits, with the angles drawn as the literature draws them.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n", Squeezer::STRUCTURE);
    let squeezer = Squeezer::benchmark();
    let start = State::at_rest([
        -0.061_713_890_014_276_45,
        0.0,
        0.455_279_819_163_070_4,
        0.222_668_390_165_885_9,
        0.487_364_979_543_842_6,
        -0.222_668_390_165_885_9,
        1.230_547_444_549_821_2,
    ]);
    let mut motion = squeezer.simulate(start).with_tolerance(1e-14);
    let states = motion.every(0.000_1).take(301).collect::<Result<Vec<_>, _>>()?;
    let end = *motion.advance_to(0.03)?;
    let hinges = motion.reactions().hinges;

    let exact = [
        15.810_771_195_153_707,
        -15.756_371_058_411_84,
        0.040_822_240_119_645_8,
        -0.534_730_116_342_079_6,
        0.524_409_965_879_954_1,
        0.534_730_116_342_079_6,
        1.048_080_741_041_938,
    ];
    println!("coordinate   after 0.03 s           reference             error");
    let mut miss = 0.0_f64;
    for ((name, q), exact) in Squeezer::COORDINATES.into_iter().zip(end.q).zip(exact) {
        miss = miss.max((q - exact).abs() / exact.abs().max(1.0));
        println!("{name:10} {q:20.15} {exact:20.15} {:10.1e}", q - exact);
    }
    println!("\nforces at the hinges [N]: {hinges:.3?}");
    let residual = squeezer.constraint_residuals(&end).into_iter().map(f64::abs).fold(0.0, f64::max);
    let work = squeezer.torque * (end.q[0] - start.q[0]);
    let books = squeezer.energy(&end) - squeezer.energy(&start) - work;
    println!(
        "{} steps; loops closed to {residual:.1e} m; energy off the motor's work by {books:.1e} J",
        motion.steps().accepted
    );

    let wrapped = |angle: f64| {
        (angle + std::f64::consts::PI).rem_euclid(2.0 * std::f64::consts::PI) - std::f64::consts::PI
    };
    let mut angles = Chart::new("Angles of the bars", "time [s]", "angle [rad]");
    for (i, name) in Squeezer::COORDINATES.into_iter().enumerate().skip(2) {
        angles = angles.line(name, states.iter().map(|state| (state.t, wrapped(state.q[i]))));
    }
    let charts = [
        angles,
        Chart::new("The crank gathers speed", "time [s]", "rate of the crank [rad/s]")
            .line("", states.iter().map(|state| (state.t, state.v[0]))),
    ];
    println!("Drawn: {}", Figure::new(charts).save("target/squeezer.svg")?.display());

    assert!(miss < 1e-9, "the mechanism is {miss:e} off");
    assert!(residual < 1e-15, "the loops are open by {residual:e} m");
    assert!(books.abs() < 1e-12, "energy appeared: {books:e} J");
    Ok(())
}
