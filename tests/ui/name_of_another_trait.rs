use lagrangian::prelude::*;

trait Gravity {
    fn pull(&self) -> f64;
}

impl Gravity for System {
    fn pull(&self) -> f64 {
        self.mass
    }
}

struct System {
    mass: f64,
}

#[lagrangian(coordinates = [x])]
impl System {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x * v.x
    }

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        <Self as Gravity>::pull(self) * q.x
    }
}

fn main() {}
