//! Seven stars in a plane with close encounters, against the published solution.
//!
//! Problem PLEI of the Test Set for IVP Solvers; Hairer, Nørsett and Wanner, Solving ODEs I, section II.10.

use std::error::Error;

use lagrangian::pictures::Chart;
use lagrangian::prelude::*;

/// Point masses that attract each other, in units in which the gravitational constant is 1.
#[derive(Clone, Copy, Debug)]
pub struct Pleiades {
    /// Masses.
    pub mass: [f64; 7],
}

#[lagrangian(coordinates = [x: [STARS], y: [STARS]])]
impl Pleiades {
    const STARS: usize = 7;

    /// `[..]`: a mass for each.
    #[point(mass = self.mass[..])]
    fn stars(&self, q: &Coordinates) -> [Vector2<f64>; Self::STARS] {
        std::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let stars = self.stars(q);
        let mut potential = 0.0;
        for i in 0..Self::STARS {
            for j in 0..i {
                potential -= self.mass[i] * self.mass[j] / (stars[i] - stars[j]).norm();
            }
        }
        potential
    }
}

/// Positions at t = 3, all x before all y.
const PUBLISHED: [f64; 14] = [
    0.370_613_914_397_050_2,
    3.237_284_092_057_233,
    -3.222_559_032_418_324,
    0.659_709_145_577_531,
    0.342_558_170_715_658_4,
    1.562_172_101_400_631,
    -0.700_309_292_221_249_5,
    -3.943_437_585_517_392,
    -3.271_380_973_972_55,
    5.225_081_843_456_543,
    -2.590_612_434_977_47,
    1.198_213_693_392_275,
    -0.242_968_234_493_582_4,
    1.091_449_240_428_98,
];

/// Follows the stars to t = 3.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n\n{}\n", Pleiades::STRUCTURE, Pleiades::COST);
    let stars = Pleiades { mass: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0] };
    let start = State::new(
        PleiadesCoordinates {
            x: [3.0, 3.0, -1.0, -3.0, 2.0, -2.0, 2.0],
            y: [3.0, -3.0, 2.0, 0.0, 0.0, -4.0, 4.0],
        },
        PleiadesVelocities {
            x: [0.0, 0.0, 0.0, 0.0, 0.0, 1.75, -1.5],
            y: [0.0, 0.0, 0.0, -1.25, 1.0, 0.0, 0.0],
        },
    );
    let mut motion = stars.simulate(start).with_tolerance(1e-13);
    let energy = motion.energy();
    let states = motion.every(0.0025).take(1200).collect::<Result<Vec<_>, _>>()?;
    let end = *motion.advance_to(3.0)?;

    let error = |i: usize| end.q[i] - PUBLISHED[i];
    println!("star {:>20} {:>10} {:>20} {:>10}", "x at t = 3", "error", "y at t = 3", "error");
    for (x, y) in (0..Pleiades::STARS).zip(Pleiades::STARS..) {
        println!("{:4} {:20.15} {:10.1e} {:20.15} {:10.1e}", x + 1, end.q[x], error(x), end.q[y], error(y));
    }
    let drift = (motion.energy() - energy) / energy;
    println!("\nEnergy error {drift:.1e} after {} steps", motion.steps().accepted);

    let mut chart = Chart::new("Seven stars until t = 3 (dots)", "x", "y").equal_scales();
    for star in 0..Pleiades::STARS {
        let place = |state: &State<f64, 14>| (state.q[star], state.q[star + Pleiades::STARS]);
        chart = chart.line(&(star + 1).to_string(), states.iter().map(place)).dots([place(&end)]);
    }
    println!("Drawn: {}", chart.save("target/pleiades.svg")?.display());

    let worst = (0..14).map(|i| error(i).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-9, "the published positions are missed by {worst:e}");
    assert!(drift.abs() < 1e-11, "the energy changed by {drift:e} of itself");
    Ok(())
}
