use lagrangian::prelude::*;

const COUNT: i32 = 3;

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
        match 2 {
            COUNT => q.x,
            _ => 2.0 * q.x,
        }
    }
}

fn main() {}
