use lagrangian::prelude::*;

mod consts {
    pub const PI: f64 = 3.0;
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
        consts::PI * q.x
    }
}

fn main() {}
