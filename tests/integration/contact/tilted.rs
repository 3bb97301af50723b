//! Contacts whose gap hardly depends on a coordinate: a floor whose normal is given by an angle, a floor that
//! is flat where the body lands. What moves along such a floor goes on.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// A ball above a floor through the origin.
struct Ball {
    restitution: f64,
    angle: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Ball {
    #[point(mass = 1.0)]
    fn centre(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.centre(q).dot(&Vector2::new(self.angle.cos(), self.angle.sin()))
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        self.centre(q).dot(&Vector2::new(self.angle.cos(), self.angle.sin()))
    }
}

/// A ball above a plain with a hill.
struct Hill {
    height: f64,
    at: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Hill {
    #[point(mass = 1.0)]
    fn centre(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = 0.0)]
    fn ground(&self, q: &Coordinates) -> f64 {
        self.centre(q).y - self.height * (-(q.x - self.at).powi(2)).exp()
    }
}

/// The gap of a floor at an angle whose cosine is a rounding error depends on x by 1e-17 … 1e-14.
#[test]
fn a_ball_that_lands_on_a_floor_at_an_angle_keeps_its_place_along_it() {
    let mut samples = Samples::new(97);
    for turns in [0.25, -0.75, 1.25, 10.25, 0.0, 1.0, 0.1, 0.24999999999, 0.5] {
        let angle = turns * std::f64::consts::TAU;
        let (normal, along) = ((angle.cos(), angle.sin()), (angle.sin(), -angle.cos()));
        for run in 0..30 {
            let restitution = if run % 3 == 0 { 0.0 } else { samples.number(0.1, 0.7) };
            let (height, place, speed) =
                (samples.number(0.1, 1.0), samples.number(-10.0, 10.0), samples.number(-2.0, 2.0));
            let start = State::new(
                [height * normal.0 + place * along.0, height * normal.1 + place * along.1],
                [speed * along.0, speed * along.1],
            );
            let ball = Ball { restitution, angle };
            let end =
                *ball.simulate(start).advance_to(8.0).unwrap_or_else(|error| panic!("{turns}: {error}"));
            let [x, y] = end.q;
            let found = (x * along.0 + y * along.1, x * normal.0 + y * normal.1);
            assert!((found.0 - place - 8.0 * speed).abs() < 1e-10, "{turns}, {restitution}: {end:?}");
            assert!(found.1.abs() < 1e-13, "{turns}, {restitution}: {end:?}");
        }
    }
}

#[test]
fn a_ball_that_lands_far_from_a_hill_keeps_its_place() {
    for far in [5.0, 6.0, 7.5, 10.0, 20.0] {
        for at in [1.0 - far, 3.0 - far, 8.0] {
            let hill = Hill { height: 0.2, at };
            let place = at + far;
            for speed in [0.0, 0.3] {
                let start = State::new([place, 0.5], [speed, 0.0]);
                let end = *hill.simulate(start).advance_to(3.0).unwrap_or_else(|error| panic!("{error}"));
                // Five widths away the hill still has a slope of 3e-11.
                assert!((end.q[0] - place - 3.0 * speed).abs() < 1e-8, "{far}, {at}, {speed}: {end:?}");
            }
        }
    }
}
