//! Chains of hinged rods that fall on a rough floor: their frictions cannot all stick beside the straight line.

use lagrangian::prelude::*;

use crate::support::close::{between, close_on};
use crate::support::sample::Samples;

/// Balls of 1 kg in a row, of which neighbours are 1 m apart, by the place of the first ball and the angles of
/// the rods.
struct Chain {
    friction: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [x, y, phi: [RODS]])]
impl Chain {
    const RODS: usize = 3;

    #[point(mass = 1.0)]
    fn balls(&self, q: &Coordinates) -> [Vector2<f64>; Self::RODS + 1] {
        let mut place = Vector2::new(q.x, q.y);
        let mut places = [place; Self::RODS + 1];
        for i in 0..Self::RODS {
            place += Vector2::new(q.phi[i].cos(), q.phi[i].sin());
            places[i + 1] = place;
        }
        places
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        let mut sum = 0.0;
        for i in 0..=Self::RODS {
            sum += 9.81 * self.balls(q)[i].y;
        }
        sum
    }

    #[unilateral(restitution = self.restitution)]
    fn heights(&self, q: &Coordinates) -> [f64; Self::RODS + 1] {
        let mut gaps = [0.0; Self::RODS + 1];
        for i in 0..=Self::RODS {
            gaps[i] = self.balls(q)[i].y;
        }
        gaps
    }

    #[friction(coefficient = self.friction, normal = heights)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; Self::RODS + 1] {
        let mut slips = [0.0; Self::RODS + 1];
        for i in 0..=Self::RODS {
            slips[i] = self.balls_velocity(q, v)[i].x;
        }
        slips
    }
}

fn fall_flat_and_rest(numbers: impl Iterator<Item = u64>) {
    for number in numbers {
        let mut samples = Samples::new(number);
        let chain = Chain { friction: samples.number(0.3, 0.9), restitution: samples.number(0.0, 0.4) };
        let [a, b, c, x, da, db, dc] =
            [0.4, 0.4, 0.4, 0.5, 0.5, 0.5, 0.5].map(|most| samples.number(-most, most));
        let start = State::new([0.0, 1.5, a, b, c], [x, 0.0, da, db, dc]);
        let mut motion = chain.simulate(start).with_tolerance(1e-9);
        let mut energy = chain.energy(&start);
        for step in 1..=32 {
            let state = *motion.advance_to(0.125 * f64::from(step)).unwrap();
            let now = chain.energy(&state);
            assert!(now < energy + 1e-8, "{state:?}");
            energy = now;
        }
        // Flat, at rest, with its weight on all four balls together.
        assert_eq!(motion.state().v, [0.0; 5]);
        between(-1e-8, energy, 1e-8);
        let bears: f64 = motion.reactions().heights.iter().sum();
        close_on(4.0 * 9.81, bears, 4.0 * 9.81, 1e-9);
    }
}

#[test]
fn chains_fall_flat_and_rest() {
    fall_flat_and_rest(0..3);
}

#[test]
#[ignore = "a minute without optimisation: scripts/check.sh runs it"]
fn many_chains_fall_flat_and_rest() {
    fall_flat_and_rest(3..60);
}
