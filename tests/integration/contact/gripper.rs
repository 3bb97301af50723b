//! A gripper: two fingers with equal forces press a block. Sideways everything rests, but for what roundings
//! of the forces make of it.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// Fingers at a and b, a block of half the width `r` at (x, y).
struct Gripper {
    finger: f64,
    block: f64,
    friction: f64,
    gravity: f64,
    r: f64,
}

#[lagrangian(coordinates = [a, b, x, y], inputs = [force])]
impl Gripper {
    #[point(mass = self.finger)]
    fn left(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a, 0.0)
    }

    #[point(mass = self.finger)]
    fn right(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.b, 0.0)
    }

    #[point(mass = self.block)]
    fn middle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        self.block * self.gravity * q.y
    }

    #[force(at = left)]
    fn push(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.force, 0.0)
    }

    #[force(at = right)]
    fn pull(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(-u.force, 0.0)
    }

    #[unilateral]
    fn left_gap(&self, q: &Coordinates) -> f64 {
        q.x - q.a - self.r
    }

    #[unilateral]
    fn right_gap(&self, q: &Coordinates) -> f64 {
        q.b - q.x - self.r
    }

    #[friction(coefficient = self.friction, normal = left_gap)]
    fn left_slip(&self, v: &Velocities) -> f64 {
        v.y
    }

    #[friction(coefficient = self.friction, normal = right_gap)]
    fn right_slip(&self, v: &Velocities) -> f64 {
        v.y
    }
}

/// The force sinks to 0.7 of what holds the block, which falls by 0.3 g. Then the force rises to 1.6 of it,
/// which stops the block by 0.6 g, and holds it. No error of a velocity that is a rounding of the forces is
/// small beside it, in a step of any length.
#[test]
fn a_block_that_is_caught_again_rests_in_a_few_steps() {
    let mut samples = Samples::new(43);
    let mut size = |least: f64, most: f64| 10_f64.powf(samples.number(least, most));
    for draw in 0..40 {
        let gripper = Gripper {
            finger: size(-1.0, 1.0),
            block: size(-1.0, 1.0),
            friction: size(-1.0, 0.0),
            gravity: size(0.0, 1.0),
            r: size(-1.0, 0.0),
        };
        let (x, g) = (size(-1.0, 0.0), gripper.gravity);
        let start = State::new([x - gripper.r, x + gripper.r, x, 0.1], [0.0; 4]);
        let holds = gripper.block * g / (2.0 * gripper.friction);
        for tolerance in [1e-6, 1e-10, 1e-13] {
            let mut motion = gripper.simulate(start).with_tolerance(tolerance).with_max_steps(200);
            for part in [1.5, 0.7, 1.6, 2.0, 1.2] {
                motion.set_inputs([part * holds]);
                let t = motion.t() + 0.5;
                let moved = motion.advance_to(t).map(|_| ());
                assert_eq!(moved, Ok(()), "{draw} at {tolerance:e}, {part}");
            }
            let [a, b, middle, y] = motion.state().q;
            let speed = 0.15 * g;
            let fallen = 0.5 * 0.5 * speed + speed * speed / (1.2 * g);
            assert!((y - (0.1 - fallen)).abs() < 1e-12 * g, "{draw} at {tolerance:e}: {y}");
            for (number, start) in [a, b, middle].iter().zip(start.q) {
                assert!((number - start).abs() < 1e-14, "{draw} at {tolerance:e}: {number} for {start}");
            }
        }
    }
}

/// A block on a floor that bears it. A pulse pushes it along the floor.
struct Pushed {
    strength: f64,
    width: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Pushed {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[force(at = block)]
    fn pulse(&self, t: f64) -> Vector2<f64> {
        Vector2::new(self.strength * (-((t - 1.37) / self.width).powi(2)).exp(), 0.0)
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

/// The weight and the reaction have roundings of 1e-15. They do not act along the floor, so a smaller force
/// does all that it does.
#[test]
fn roundings_of_a_weight_hide_no_force_along_the_floor() {
    for strength in [1.0, 1e-12, 1e-17, 1e-25] {
        for width in [0.3, 0.01, 0.001] {
            for speed in [0.0, strength] {
                let pushed = Pushed { strength, width };
                let mut motion = pushed.simulate(State::new([0.0; 2], [speed, 0.0])).with_tolerance(1e-10);
                let [found, _] = motion.advance_to(3.0).expect("motion: no obstacle").v;
                let expected = speed + strength * width * core::f64::consts::PI.sqrt();
                let error = found / expected - 1.0;
                assert!(error.abs() < 1e-9, "{strength:e}, {width}, {speed:e}: {error:e}");
            }
        }
    }
}
