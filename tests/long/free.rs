//! Long runs: the error of the energy is that of rounding, and grows like a random walk. Slow:
//! `scripts/check.sh long`.

use lagrangian::prelude::*;

use crate::close::between;

struct DoublePendulum;

#[lagrangian(coordinates = [upper, lower])]
impl DoublePendulum {
    #[point(mass = 1.0)]
    fn elbow(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.upper.sin(), -q.upper.cos())
    }

    #[point(mass = 1.0)]
    fn hand(&self, q: &Coordinates) -> Vector2<f64> {
        self.elbow(q) + Vector2::new(q.lower.sin(), -q.lower.cos())
    }

    /// Zero at rest, which keeps the digits of small swings.
    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        19.62 * (2.0 * (0.5 * q.upper).sin().powi(2) + (0.5 * q.lower).sin().powi(2))
    }
}

struct SphericalPendulum;

#[lagrangian(coordinates = [theta, phi])]
impl SphericalPendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector3<f64> {
        let (sin, cos) = q.theta.sin_cos();
        Vector3::new(sin * q.phi.cos(), sin * q.phi.sin(), -cos)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).z
    }
}

struct Kepler;

#[lagrangian(coordinates = [x, y])]
impl Kepler {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn sun(&self, q: &Coordinates) -> f64 {
        -1.0 / self.planet(q).norm()
    }
}

/// The root of the mean square of a relative error of the energy over each of `blocks` blocks, each twice as
/// long as the one before, of which the first has `first` samples of `dt`.
fn growth<S: System<2, 0, Scalar = f64, Method = Jets> + lagrangian::Smooth<2>>(
    name: &str,
    system: &S,
    start: State<f64, 2>,
    dt: f64,
    first: u32,
    blocks: u32,
) -> Vec<f64> {
    let mut motion = system.simulate(start).with_tolerance(0.0);
    let energy = motion.energy();
    let mut errors = Vec::new();
    let mut time = 0_u32;
    for block in 0..blocks {
        let count = first << block;
        let mut squares = 0.0;
        for _ in 0..count {
            time += 1;
            motion.advance_to(dt * f64::from(time)).unwrap();
            squares += (motion.energy() / energy - 1.0).powi(2);
        }
        errors.push((squares / f64::from(count)).sqrt());
        let steps = motion.steps().accepted;
        println!("{name}: t = {:.0}, {steps} steps, energy {:.1e}", motion.t(), errors[errors.len() - 1]);
    }
    let ratio = errors[errors.len() - 1] / errors[0];
    println!("{name}: exponent {:.2}", ratio.log2() / f64::from(blocks - 1));
    errors
}

#[test]
fn the_energy_of_a_double_pendulum_walks_at_random() {
    let small = growth("small swings", &DoublePendulum, State::at_rest([0.01, 0.02]), 1.0, 500, 10);
    between(0.0, small[9], 2e-13);
    let large = growth("large swings", &DoublePendulum, State::at_rest([1.1, 0.9]), 1.0, 250, 10);
    between(0.0, large[9], 3e-13);
}

#[test]
fn the_energy_of_a_spherical_pendulum_walks_at_random() {
    let errors = growth("spherical", &SphericalPendulum, State::new([1.0, 0.0], [0.0, 2.0]), 1.0, 500, 10);
    between(0.0, errors[9], 5e-13);
}

/// One walk ends anywhere: twenty planets tell its width, and whether it has a drift.
#[test]
fn the_energy_of_planets_walks_at_random() {
    const PLANETS: usize = 20;
    let chunk = 0.618 * std::f64::consts::TAU * 1600.0;
    let mut walks = [[0.0; PLANETS]; 6];
    for planet in 0..PLANETS {
        let nudge = planet as f64;
        let start = State::new([0.4 + 0.0007 * nudge, 0.0], [0.0, 2.0 - 0.0013 * nudge]);
        let mut motion = Kepler.simulate(start).with_tolerance(0.0);
        let energy = motion.energy();
        for (doublings, errors) in walks.iter_mut().enumerate() {
            motion.advance_to(chunk * f64::from(2_u32 << doublings)).unwrap();
            errors[planet] = motion.energy() / energy - 1.0;
        }
    }
    let count = PLANETS as f64;
    let width = |errors: &[f64; PLANETS]| (errors.iter().map(|e| e * e).sum::<f64>() / count).sqrt();
    let mean = walks[5].iter().sum::<f64>() / count;
    for (doublings, errors) in walks.iter().enumerate() {
        println!("planets: t = {:.0}, energy {:.1e}", chunk * f64::from(2_u32 << doublings), width(errors));
    }
    let exponent = (width(&walks[5]) / width(&walks[0])).log2() / 5.0;
    println!("planets: exponent {exponent:.2}, mean {mean:.1e}");
    between(0.0, width(&walks[5]), 2.5e-13);
    between(0.0, exponent, 0.75);
    // Three standard deviations of a mean without drift.
    between(0.0, mean.abs(), 3.0 * width(&walks[5]) / count.sqrt());
}

#[test]
fn fixed_steps_keep_the_energy_as_well() {
    let mut motion = DoublePendulum.stepper::<Jet<12>>(State::at_rest([0.01, 0.02]));
    let energy = motion.energy();
    let mut largest = 0.0_f64;
    for step in 0..5_000_000 {
        motion.step(0.02, &[]).unwrap();
        if step % 1000 == 0 {
            largest = largest.max((motion.energy() / energy - 1.0).abs());
        }
    }
    println!("fixed steps: energy {largest:.1e}");
    between(0.0, largest, 1e-12);
}
