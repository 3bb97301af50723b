//! Constraints far from the origin, where coordinates are large and a constraint depends on their small
//! difference.

use lagrangian::prelude::*;

use crate::support::close::{close, close_on};

const EARTH: f64 = 3.986004418e14;

/// Two masses in low orbit on a rod of 100 m.
struct Tether {
    length: f64,
}

#[lagrangian(coordinates = [p: [4]])]
impl Tether {
    #[point(mass = 1.0)]
    fn ends(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [Vector2::new(q.p[0], q.p[1]), Vector2::new(q.p[2], q.p[3])]
    }

    #[potential]
    fn earth(&self, q: &Coordinates) -> f64 {
        self.ends(q).iter().map(|end| -EARTH / end.norm()).sum()
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        let [a, b] = self.ends(q);
        (b - a).norm_squared() - self.length.powi(2)
    }
}

/// The same by its centre and its angle.
struct Rod {
    length: f64,
}

#[lagrangian(coordinates = [x, y, angle])]
impl Rod {
    #[point(mass = 1.0)]
    fn ends(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        let centre = Vector2::new(q.x, q.y);
        let half = 0.5 * self.length * Vector2::new(q.angle.cos(), q.angle.sin());
        [centre - half, centre + half]
    }

    #[potential]
    fn earth(&self, q: &Coordinates) -> f64 {
        self.ends(q).iter().map(|end| -EARTH / end.norm()).sum()
    }
}

#[test]
fn a_tether_in_orbit_keeps_its_length_and_its_spin() {
    let (tether, rod) = (Tether { length: 100.0 }, Rod { length: 100.0 });
    let radius: f64 = 6.8e6;
    let orbit = (EARTH / radius.powi(3)).sqrt();
    let (near, far) = (radius - 50.0, radius + 50.0);
    let start = State::new([near, 0.0, far, 0.0], [0.0, orbit * near - 0.1, 0.0, orbit * far + 0.1]);
    let spin = orbit + 0.2 / 100.0;
    let twin = State::new([radius, 0.0, 0.0], [0.0, orbit * radius, spin]);

    let seconds = 2e4;
    let expected =
        *rod.simulate(twin).with_tolerance(1e-14).with_step_limit(50.0).advance_to(seconds).unwrap();
    // A rounding of a coordinate is a nanometre, and the error of a step is relative to coordinates.
    for (tolerance, accuracy) in [(1e-10, 1e-3), (1e-13, 1e-6)] {
        let end = *tether.simulate(start).with_tolerance(tolerance).advance_to(seconds).unwrap();
        let [q, v] = [end.q, end.v].map(|x| Vector2::new(x[2] - x[0], x[3] - x[1]));
        close_on(1.0, q.norm() / 100.0, 1.0, 1e-9);
        close_on(1.0, q.dot(&v) / 100.0, 0.0, 1e-9);
        close(q.perp(&v) / q.norm_squared(), expected.v[2], accuracy);
    }
}

#[test]
fn a_start_off_a_far_rod_is_refused() {
    let start = State::new([6.8e6, 0.0, 6.8e6 + 100.1, 0.0], [0.0, 7000.0, 0.0, 7000.0]);
    let tether = Tether { length: 100.0 };
    let error = tether.simulate(start).advance_to(1.0).unwrap_err();
    assert!(matches!(error.cause, Cause::PositionViolated { constraint: 0, .. }), "{error}");
    assert!(tether.simulate(tether.consistent(start).unwrap()).advance_to(1.0).is_ok());
}
