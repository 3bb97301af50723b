//! The velocity of a function of more than the state.
use lagrangian::prelude::*;

struct Rod {
    mass: f64,
}

#[lagrangian(coordinates = [angle])]
impl Rod {
    fn along(&self, q: &Coordinates, share: f64) -> Vector2<f64> {
        share * Vector2::new(q.angle.sin(), -q.angle.cos())
    }

    #[point(mass = self.mass)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        self.along(q, 1.0)
    }

    #[dissipation]
    fn air(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.along_velocity(q, v, 0.5).norm_squared()
    }
}

fn main() {}
