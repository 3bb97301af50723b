//! A function of the user's has the name of a velocity, in a block that the macro does not see.
use lagrangian::prelude::*;

struct Rod {
    mass: f64,
}

impl Rod {
    fn tip_velocity(&self) -> f64 {
        self.mass
    }
}

#[lagrangian(coordinates = [angle])]
impl Rod {
    #[point(mass = self.mass)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.angle.sin(), -q.angle.cos())
    }

    #[dissipation]
    fn air(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.tip_velocity(q, v).norm_squared()
    }
}

fn main() {}
