//! The velocity of something that is no position.
use lagrangian::prelude::*;

struct Rod {
    mass: f64,
}

#[lagrangian(coordinates = [angle])]
impl Rod {
    fn links(&self, _q: &Coordinates) -> usize {
        3
    }

    #[point(mass = self.mass)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.angle.sin(), -q.angle.cos())
    }

    #[dissipation]
    fn air(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.links_velocity(q, v) * v.angle.powi(2)
    }
}

fn main() {}
