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
        let mut height = q.x;
        #[cfg(debug_assertions)]
        {
            height = 2.0 * q.x;
        }
        height
    }
}

fn main() {}
