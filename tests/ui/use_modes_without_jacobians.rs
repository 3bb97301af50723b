//! Modes of a system whose derivatives are not generated.

use lagrangian::prelude::*;

pub struct Puck {
    pub mass: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }
}

fn main() {
    let puck = Puck { mass: 1.0 };
    let modes = puck.modes(&State::at_rest([0.0, 0.1]), &[]).unwrap();
    println!("{}", modes.len());
}
