//! A Taylor step of a system whose drag has a kink at rest.

use lagrangian::prelude::*;

pub struct Ball {
    pub mass: f64,
    pub drag: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Ball {
    #[point(mass = self.mass)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[force(at = ball)]
    fn air(&self, v: &Velocities) -> Vector2<f64> {
        let velocity = Vector2::new(v.x, v.y);
        -velocity * (self.drag * velocity.norm())
    }
}

fn main() {
    let ball = Ball { mass: 1.0, drag: 0.1 };
    let _ = ball.stepper::<Jet<6>>(State::at_rest([0.0, 1.0]));
}
