//! Forces that balance each other through constraints: what moves are roundings of the forces.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// Two jaws at a and b with a body at x between them, tied together. Equal forces, which change with time,
/// press the jaws against the body.
struct Clamp {
    jaw: f64,
    body: f64,
}

#[lagrangian(coordinates = [a, b, x])]
impl Clamp {
    #[point(mass = self.jaw)]
    fn left(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a, 0.0)
    }

    #[point(mass = self.jaw)]
    fn right(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.b, 0.0)
    }

    #[point(mass = self.body)]
    fn middle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[force(at = left)]
    fn push(&self, t: f64) -> Vector2<f64> {
        Vector2::new(1.5 + (3.0 * t).sin(), 0.0)
    }

    #[force(at = right)]
    fn pull(&self, t: f64) -> Vector2<f64> {
        Vector2::new(-1.5 - (3.0 * t).sin(), 0.0)
    }

    #[holonomic]
    fn left_gap(&self, q: &Coordinates) -> f64 {
        q.x - q.a - 0.1
    }

    #[holonomic]
    fn right_gap(&self, q: &Coordinates) -> f64 {
        q.b - q.x - 0.1
    }
}

/// A velocity that is a rounding of the forces has no digits. An error is never small beside it, however
/// short a step is. So forces are the measure.
#[test]
fn a_clamp_that_rests_takes_steps_of_its_forces() {
    let mut samples = Samples::new(17);
    let mut mass = || 10_f64.powf(samples.number(-1.0, 1.0));
    for draw in 0..20 {
        let clamp = Clamp { jaw: mass(), body: mass() };
        for speed in [0.0, 1e-17] {
            for tolerance in [1e-6, 1e-10, 1e-13] {
                let start = State::new([-0.1, 0.1, 0.0], [speed; 3]);
                let mut motion = clamp.simulate(start).with_tolerance(tolerance).with_max_steps(100);
                let moved = motion.advance_to(2.0).map(|end| end.q[2].abs() < 1e-14);
                assert_eq!(moved, Ok(true), "{draw} at {tolerance:e}, {speed:e}");
            }
        }
    }
}
