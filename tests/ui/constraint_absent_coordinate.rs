//! The wrong coordinate is to be eliminated; what uses the system is no second mistake.

use lagrangian::prelude::*;

pub struct Slide {
    pub mass: f64,
    pub rate: f64,
}

#[lagrangian(coordinates = [x, y, angle])]
impl Slide {
    #[point(mass = self.mass)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x + q.angle.cos(), q.y + q.angle.sin())
    }

    #[holonomic(eliminate = x)]
    fn drive(&self, q: &Coordinates, t: f64) -> f64 {
        q.angle - self.rate * t
    }
}

fn main() {
    let slide = Slide { mass: 1.0, rate: 2.0 };
    let state = State::at_rest([0.0, 1.0]);
    println!("{} {}", slide.coordinates(&state).angle, slide.velocities(&state).angle);
}
