use lagrangian::prelude::*;

mod moon {
    pub const G: f64 = 1.62;
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
        const G: f64 = 9.81;
        {
            use moon::*;
            G * q.x
        }
    }
}

fn main() {}
