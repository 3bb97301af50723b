use lagrangian::prelude::*;

#[derive(Clone)]
struct Vector2<T>(T, T);

impl<T> Vector2<T> {
    fn new(x: T, y: T) -> Self {
        Vector2(y, x)
    }
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

    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 2.0 * q.x)
    }
}

fn main() {}
