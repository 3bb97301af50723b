//! Slider-cranks whose rod is as long as the crank pass their upright position again and again. There the
//! gradient of the constraint vanishes and two motions meet.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// A slider-crank whose rod is as long as its crank, by the angle of the rod. Where both are upright the
/// gradient vanishes: the slider may stay above the pivot, or go on.
#[derive(Clone, Copy)]
struct Slider {
    m: [f64; 2],
    g: f64,
}

#[lagrangian(coordinates = [crank, rod])]
impl Slider {
    #[point(mass = self.m[0])]
    fn pin(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.crank.cos(), q.crank.sin())
    }

    #[point(mass = self.m[1])]
    fn slider(&self, q: &Coordinates) -> Vector2<f64> {
        self.pin(q) + Vector2::new(q.rod.cos(), q.rod.sin())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m[0] * self.g * self.pin(q).y
    }

    #[holonomic]
    fn guide(&self, q: &Coordinates) -> f64 {
        self.slider(q).y
    }
}

/// The same by the place of the slider.
#[derive(Clone, Copy)]
struct Piston {
    m: [f64; 2],
    g: f64,
}

#[lagrangian(coordinates = [crank, x])]
impl Piston {
    #[point(mass = self.m[0])]
    fn pin(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.crank.cos(), q.crank.sin())
    }

    #[point(mass = self.m[1])]
    fn slider(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m[0] * self.g * self.pin(q).y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        (self.slider(q) - self.pin(q)).norm_squared() - 1.0
    }
}

/// A flat position is passed many times. Steps do not creep into it, where roundings of the state would grow
/// until the branch is lost.
#[test]
fn equal_slider_cranks_pass_their_upright_position_again_and_again() {
    let mut samples = Samples::new(41);
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13] {
        for run in 0..12 {
            let m = [samples.number(0.3, 2.0), samples.number(0.3, 2.0)];
            let g = if run % 2 == 0 { 9.81 } else { 0.0 };
            let (at, rate) = (samples.number(-1.0, 1.0), samples.number(7.0, 12.0));
            let [end, of_piston] = [
                Slider { m, g }
                    .simulate(State::new([at, -at], [rate, -rate]))
                    .with_tolerance(tolerance)
                    .advance_to(8.0)
                    .map(|end| (*end, Slider { m, g }.energy(end))),
                Piston { m, g }
                    .simulate(State::new([at, 2.0 * at.cos()], [rate, -2.0 * rate * at.sin()]))
                    .with_tolerance(tolerance)
                    .advance_to(8.0)
                    .map(|end| (*end, Piston { m, g }.energy(end))),
            ]
            .map(|end| {
                end.unwrap_or_else(|error| panic!("{m:?}, {g}, {at}, {rate} at {tolerance:e}: {error}"))
            });
            let start = Slider { m, g }.energy(&State::new([at, -at], [rate, -rate]));
            for (_, energy) in [end, of_piston] {
                close_on(start.abs() + 20.0, energy, start, 100.0 * tolerance);
            }
            close_on(1.0, (end.0.q[0] + end.0.q[1]).sin(), 0.0, 1e-6);
            close_on(1.0, of_piston.0.q[1], 2.0 * of_piston.0.q[0].cos(), 1e-6);
        }
    }
}
