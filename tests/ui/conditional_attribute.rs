use lagrangian::prelude::*;

struct System {
    mass: f64,
}

#[lagrangian(coordinates = [x])]
impl System {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x * v.x
    }

    #[cfg_attr(debug_assertions, potential)]
    fn height(&self, q: &Coordinates) -> f64 {
        q.x
    }
}

fn main() {}
