//! An equilibrium of a system with contacts.

use lagrangian::prelude::*;

pub struct Puck {
    pub mass: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

fn main() {
    let puck = Puck { mass: 1.0 };
    let rest = puck.equilibrium([0.0, 0.1], &[]).unwrap();
    println!("{:?}", rest.state.q);
}
