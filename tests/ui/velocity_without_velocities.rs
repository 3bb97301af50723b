//! A velocity is a function of the velocities too.
use lagrangian::prelude::*;

struct Rod {
    mass: f64,
}

#[lagrangian(coordinates = [angle])]
impl Rod {
    #[point(mass = self.mass)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.angle.sin(), -q.angle.cos())
    }

    #[dissipation]
    fn air(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.tip_velocity(q).norm_squared() + v.angle
    }
}

fn main() {}
