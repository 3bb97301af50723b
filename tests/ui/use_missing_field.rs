//! A coordinate is missing in the generated struct.

use lagrangian::prelude::*;

pub struct Cart {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x], inputs = [motor])]
impl Cart {
    #[point(mass = self.mass)]
    fn cart(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x.powi(2)
    }

    #[force(at = cart)]
    fn drive(&self, u: &Inputs) -> f64 {
        u.motor
    }
}

fn main() {
    let cart = Cart { mass: 1.0, stiffness: 4.0 };
    let place = CartCoordinates {};
    let _ = cart.spring(&place);
}
