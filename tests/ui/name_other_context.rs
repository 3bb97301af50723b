use lagrangian::prelude::*;

struct System {
    mass: f64,
}

macro_rules! system {
    ($height:expr) => {
        #[lagrangian(coordinates = [x])]
        impl System {
            #[kinetic]
            fn kinetic(&self, v: &Velocities) -> f64 {
                0.5 * self.mass * v.x * v.x
            }

            #[potential]
            fn height(&self, q: &Coordinates) -> f64 {
                let scale = 2.0;
                scale * $height * q.x
            }
        }
    };
}

system!(scale + 1.0);

fn main() {}
