//! A relativistic charge in crossed electric and magnetic fields: gyration and drift, against closed forms.
//!
//! Here L is written down as it stands: it is no difference of energies, and its inertia grows with the
//! speed.

use std::error::Error;
use std::f64::consts::TAU;

use lagrangian::pictures::Chart;
use lagrangian::prelude::*;

/// A charge that moves in the x-y plane, E along y, B along z.
#[derive(Clone, Copy, Debug)]
pub struct Charge {
    /// Rest mass \[kg].
    pub mass: f64,
    /// Electric charge \[C].
    pub charge: f64,
    /// Speed of light \[m/s].
    pub c: f64,
    /// Electric field \[V/m].
    pub electric: f64,
    /// Magnetic flux density \[T].
    pub magnetic: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Charge {
    /// A in the symmetric gauge, so that curl A = B.
    fn vector_potential(&self, q: &Coordinates) -> Vector2<f64> {
        0.5 * self.magnetic * Vector2::new(-q.y, q.x)
    }

    #[lagrangian]
    fn free(&self, v: &Velocities) -> f64 {
        let c2 = self.c.powi(2);
        -self.mass * c2 * (1.0 - v.as_vector().norm_squared() / c2).sqrt()
    }

    #[lagrangian]
    fn in_field(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.charge * (v.as_vector().dot(&self.vector_potential(q)) + self.electric * q.y)
    }
}

impl Charge {
    /// Velocity \[m/s] with which the gyration drifts along x, whatever the charge does.
    pub fn drift(&self) -> f64 {
        self.electric / self.magnetic
    }

    /// Period \[s] of the velocity \[m/s]. Seen from the drift there is no electric field: the charge runs in
    /// a circle in a field weaker by γ, and the clocks of that frame go slower by γ.
    pub fn period(&self, velocity: [f64; 2]) -> f64 {
        let gamma = |speed_squared: f64| (1.0 - speed_squared / self.c.powi(2)).sqrt().recip();
        let [x, y] = velocity;
        let frame = gamma(self.drift().powi(2));
        let inner = frame * gamma(x * x + y * y) * (1.0 - x * self.drift() / self.c.powi(2));
        TAU * self.mass * inner * frame.powi(2) / (self.charge * self.magnetic)
    }
}

/// Three starts in the same fields.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n", Charge::STRUCTURE);
    // Units in which the charge, its mass and the speed of light are 1: slow gyration takes 2π.
    let charge = Charge { mass: 1.0, charge: 1.0, c: 1.0, electric: 0.3, magnetic: 1.0 };
    let mut chart =
        Chart::new("Gyration drifts across the electric field", "x [c/ω]", "y [c/ω]").equal_scales();
    let mut misses: Vec<f64> = Vec::new();
    println!("Drift E/B = {} c; a slow gyration takes {TAU:.6}", charge.drift());
    println!("path   start x′ [c]     period   drift after it [c]   velocity error   energy error");
    for (name, speed) in [("loops", -0.6), ("cusps", 0.0), ("waves", 0.15)] {
        let start = State::new([0.0, 0.0], [speed, 0.0]);
        let period = charge.period(start.v);
        let mut motion = charge.simulate(start).with_tolerance(1e-13);
        let path = motion.every(period / 200.0).take(701).collect::<Result<Vec<_>, _>>()?;
        chart = chart.line(name, path.iter().map(|state| (state.q[0], state.q[1])));

        // After a period the velocity is what it was, and the place has moved by the drift alone.
        let end = *motion.advance_to(period)?;
        let drift = end.q[0] / period;
        let velocity = (end.velocities() - start.velocities()).norm();
        let energy = charge.energy(&end) - charge.energy(&start);
        println!("{name}  {speed:13.2} {period:10.6} {drift:20.15} {velocity:16.1e} {energy:14.1e}");
        misses.extend([drift - charge.drift(), end.q[1], velocity, energy].map(f64::abs));
    }
    println!("Drawn: {}", chart.save("target/charge_in_magnetic_field.svg")?.display());

    let worst = misses.into_iter().fold(0.0, f64::max);
    println!("Largest deviation from the closed form: {worst:.1e}");
    assert!(worst < 1e-10, "the motion is {worst:e} from the closed form");
    Ok(())
}
