//! Friction whose normal force is the common size of several reactions: bearings, and beads on curves in space.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close, close_on};

/// A pendulum on a journal bearing: a pin of radius r turns in a hole, held by two constraints. A stop may be in
/// its way.
struct Journal {
    friction: f64,
    restitution: f64,
}

const MASS: f64 = 2.0;
const INERTIA: f64 = 0.1;
const LENGTH: f64 = 0.5;
const RADIUS: f64 = 0.1;
const STOP: f64 = -1.0;

#[lagrangian(coordinates = [x, y, phi])]
impl Journal {
    #[point(mass = 2.0)]
    fn centre(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * 0.1 * v.phi.powi(2)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * self.centre(q).y
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> [f64; 2] {
        let centre = self.centre(q);
        [centre.x - 0.5 * q.phi.sin(), centre.y + 0.5 * q.phi.cos()]
    }

    #[unilateral(restitution = self.restitution)]
    fn stop(&self, q: &Coordinates) -> f64 {
        q.phi + 1.0 + if self.restitution < 0.5 { 0.0 } else { 1e3 }
    }

    #[friction(coefficient = self.friction, normal = [pin])]
    fn slip(&self, v: &Velocities) -> f64 {
        0.1 * v.phi
    }
}

fn hanging(phi: f64) -> State<f64, 3> {
    State::at_rest([LENGTH * phi.sin(), -LENGTH * phi.cos(), phi])
}
