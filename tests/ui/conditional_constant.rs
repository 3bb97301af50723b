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

    #[cfg(debug_assertions)]
    const G: f64 = 9.81;
    #[cfg(not(debug_assertions))]
    const G: f64 = 1.62;

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        Self::G * q.x
    }
}

fn main() {}
