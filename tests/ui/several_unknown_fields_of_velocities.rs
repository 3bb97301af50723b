//! A body in the plane has one angular velocity.
use lagrangian::prelude::*;

struct Wheel {
    mass: f64,
}

#[lagrangian(coordinates = [x, angle])]
impl Wheel {
    #[body(mass = self.mass, inertia = 1.0)]
    fn hub(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, 1.0), q.angle)
    }

    #[dissipation]
    fn air(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.hub_velocity(q, v).angular_velocity_in_body.powi(2)
    }

    #[nonholonomic]
    fn rolling(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.hub_velocity(q, v).of(Vector2::new(q.x, 0.0)).x
    }
}

fn main() {}
