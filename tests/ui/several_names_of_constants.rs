use lagrangian::prelude::*;

#[allow(non_upper_case_globals)]
const x: f64 = 1.0;

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
        q.x
    }
}

fn main() {}
