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

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        mod moon {
            pub const G: f64 = 1.62;
        }
        moon::G * q.x
    }
}

fn main() {}
