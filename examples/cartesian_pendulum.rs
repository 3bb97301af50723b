//! A pendulum in Cartesian coordinates: the rod is a constraint, its tension the multiplier.

use std::error::Error;

use lagrangian::pictures::{Figure, Record};
use lagrangian::prelude::*;

/// A point mass on a massless rod, x downwards.
#[derive(Clone, Copy, Debug)]
pub struct Pendulum {
    /// Mass \[kg].
    pub mass: f64,
    /// Length of the rod \[m].
    pub length: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Pendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.mass * self.g * self.bob(q).x
    }

    /// The gradient is a unit vector, so the multiplier is the force of the rod on the bob: negative where it
    /// pulls.
    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

/// Tension against the law of the circle, the drift of a long run, and what happens to a start off the rod.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n", Pendulum::STRUCTURE);
    let pendulum = Pendulum { mass: 1.3, length: 0.7, g: 9.81 };
    let start = State::at_rest([0.7 * 1.0_f64.cos(), 0.7 * 1.0_f64.sin()]);

    // A rod's tension carries the weight's part along it and turns the velocity.
    let law = |state: &State<f64, 2>| {
        let speed_squared = state.v[0].powi(2) + state.v[1].powi(2);
        pendulum.mass * (pendulum.g * state.q[0] + speed_squared) / pendulum.length
    };
    let mut motion = pendulum.simulate(start).with_tolerance(1e-14);
    let mut worst = 0.0_f64;
    println!("  t [s]    tension [N]   by the law of the circle [N]");
    for k in 0..=400 {
        let t = 0.01 * f64::from(k);
        let state = *motion.advance_to(t)?;
        let pull = -motion.reactions().rod;
        worst = worst.max((pull - law(&state)).abs());
        if k % 50 == 0 {
            println!("{t:7.2} {pull:14.9} {:30.9}", law(&state));
        }
    }
    let state = *motion.advance_to(1.0)?;
    let (angle, exact) = (state.q[1].atan2(state.q[0]), -0.935_288_880_545_347_7);
    println!("\nAngle after 1 s: {angle:.15} rad, by elliptic functions {exact:.15}");

    // Ten thousand swings.
    let period = 1.789_730_921_643_471_3;
    let mut long = pendulum.simulate(start).with_tolerance(1e-15);
    let end = *long.advance_to(10_000.0 * period)?;
    let [f] = pendulum.constraint_residuals(&end);
    let drift = (pendulum.energy(&end) / pendulum.energy(&start) - 1.0).abs();
    println!(
        "After 10 000 swings, {} steps: the rod is {:.1e} too long, the energy {drift:.1e} off",
        long.steps().accepted,
        f / pendulum.length
    );

    // A start that violates the constraint is refused, and projected if asked for.
    let sloppy = State::at_rest([0.4, 0.6]);
    let refusal = pendulum.simulate(sloppy).advance_to(1.0).copied();
    println!("\n{}", refusal.as_ref().expect_err("a start off the rod"));
    let projected = pendulum.consistent(sloppy)?;
    println!("Projected: {:?}", projected.q);

    // The picture has y to the right and x downwards, as the description has it.
    let record = Record::of(&mut pendulum.simulate(start), 4.0, 400)?;
    let seen = |_: &Pendulum, q: &PendulumCoordinates| Vector2::new(q.y, -q.x);
    let film = record
        .film()
        .rods(move |p, q| [Vector2::zeros(), seen(p, q)])
        .reaction(seen, |p, state, found| Vector2::new(state.q[1], -state.q[0]) / p.length * found.rod);
    println!("Drawn: {}", film.save("target/cartesian_pendulum.film.svg")?.display());
    let charts = [
        record.phase_portrait("y")?.titled("Phase portrait", "y [m]", "y′ [m/s]"),
        record.energies(Pendulum::kinetic_energy, Pendulum::potential_energy),
        record.reactions().titled("Force of the rod on the bob", "time [s]", "force [N]"),
    ];
    println!("Drawn: {}", Figure::new(charts).save("target/cartesian_pendulum.svg")?.display());

    assert!(worst < 1e-11, "the tension is off by {worst:e} N");
    assert!((angle - exact).abs() < 1e-12, "after 1 s the angle is {angle}");
    assert!(f.abs() < 1e-14, "the rod is {f:e} m too long");
    assert!(drift < 1e-11, "the energy changed by {drift:e} of itself");
    assert!(pendulum.simulate(projected).advance_to(1.0).is_ok());
    Ok(())
}
