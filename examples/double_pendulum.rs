//! A double pendulum that swings over: table, a film, phase portraits, and how well the energy is kept.

use std::error::Error;

use lagrangian::pictures::{Figure, Record};
use lagrangian::prelude::*;

/// Two point masses on massless rods, swinging in a vertical plane.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    /// Masses \[kg].
    pub m: [f64; 2],
    /// Rod lengths \[m].
    pub l: [f64; 2],
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [theta: [2]])]
impl DoublePendulum {
    /// Both angles are measured from the downward vertical.
    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        self.l[0] * Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + self.l[1] * Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
    }
}

/// Simulates, tabulates and draws 20 seconds.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("Structure\n{}\n", DoublePendulum::STRUCTURE);
    println!("Cost of one evaluation of the accelerations\n{}\n", DoublePendulum::COST);

    let pendulum = DoublePendulum { m: [1.0, 1.0], l: [1.0, 1.0], g: 9.81 };
    let start = State::at_rest([2.0, 2.5]);
    let mut motion = pendulum.simulate(start).with_tolerance(1e-12);
    let record = Record::of(&mut motion, 10.0, 1000)?;
    let rest = Record::of(&mut motion, 10.0, 1000)?;

    let energy = pendulum.energy(&start);
    let error = |state| (pendulum.energy(state) - energy) / energy;
    println!("    t [s]   θ₁ [rad]   θ₂ [rad]  θ₁′ [rad/s]  θ₂′ [rad/s]        E [J]     ΔE/E₀");
    for state in record.states().iter().step_by(100).chain(rest.states().iter().step_by(100).skip(1)) {
        let ([upper, lower], [upper_rate, lower_rate]) = (state.q, state.v);
        println!(
            "{:9.2} {upper:10.5} {lower:10.5} {upper_rate:12.5} {lower_rate:12.5} {:12.8} {:9.1e}",
            state.t,
            pendulum.energy(state),
            error(state),
        );
    }
    let steps = motion.steps();
    println!("\n{} steps, {} rejected, {} evaluations", steps.accepted, steps.rejected, steps.evaluations);

    let film =
        record.film().trail(DoublePendulum::lower).rods(|p, q| [Vector2::zeros(), p.upper(q), p.lower(q)]);
    println!("Drawn: {}", film.save("target/double_pendulum.svg")?.display());
    let portraits = [record.phase_portrait("theta[0]")?, record.phase_portrait("theta[1]")?];
    println!("Drawn: {}", Figure::new(portraits).save("target/double_pendulum.portraits.svg")?.display());
    let energies = record.energies(DoublePendulum::kinetic_energy, DoublePendulum::potential_energy);
    let energies = Figure::new([energies, record.energy_change()]);
    println!("Drawn: {}", energies.save("target/double_pendulum.energies.svg")?.display());

    let worst =
        record.states().iter().chain(rest.states()).map(|state| error(state).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-9, "the energy changed by {worst:e} of itself");
    Ok(())
}
