//! A double pendulum that swings over: table, paths of both masses, a film, and how well the energy is kept.

use std::error::Error;

use lagrangian::prelude::*;

#[path = "support/film.rs"]
mod film;
#[path = "support/plot.rs"]
mod plot;

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
    let states = motion.every(0.01).take(2001).collect::<Result<Vec<_>, _>>()?;

    let energy = pendulum.energy(&start);
    let error = |state| (pendulum.energy(state) - energy) / energy;
    println!("    t [s]   θ₁ [rad]   θ₂ [rad]  θ₁′ [rad/s]  θ₂′ [rad/s]        E [J]     ΔE/E₀");
    for state in states.iter().step_by(100) {
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

    let path = |mass: fn(&DoublePendulum, &DoublePendulumCoordinates) -> Vector2<f64>| {
        states.iter().take(801).map(move |state| {
            let position = mass(&pendulum, &state.q.into());
            (position.x, position.y)
        })
    };
    let paths = plot::Chart::new("Paths during the first 8 s", "x [m]", "y [m]")
        .equal_scales()
        .line("lower mass", path(DoublePendulum::lower))
        .dots(path(DoublePendulum::lower).take(1))
        .line("upper mass", path(DoublePendulum::upper))
        .dots(path(DoublePendulum::upper).take(1));
    plot::save("double_pendulum_paths", &[paths])?;

    // Ten seconds in 25 frames each; the path is drawn twice as fine.
    let every = |count: usize| states.iter().take(1001).step_by(count).map(|state| state.q.into());
    let joints =
        |q: DoublePendulumCoordinates| vec![[0.0; 2], pendulum.upper(&q).into(), pendulum.lower(&q).into()];
    let moving = film::Film::new(10.0)
        .trail(every(2).map(|q| pendulum.lower(&q).into()))
        .linkage(every(4).map(joints));
    film::save("double_pendulum", &moving)?;
    let errors = plot::Chart::new("Relative energy error at tolerance 10⁻¹²", "time [s]", "|E − E₀| / |E₀|")
        .logarithmic()
        .line("", states.iter().map(|state| (state.t, error(state))));
    plot::save("double_pendulum_energy", &[errors])?;

    let worst = states.iter().map(|state| error(state).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-9, "the energy changed by {worst:e} of itself");
    Ok(())
}
