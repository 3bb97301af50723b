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

    const ANGLE: f64 = 0.5;

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        if Self::ANGLE.sin() > 0.479425538604203 { q.x } else { 2.0 * q.x }
    }
}

fn main() {}
