//! A rotation by a vector of three coordinates.
use lagrangian::prelude::*;

struct Body;

#[lagrangian(coordinates = [turn: [3]])]
impl Body {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 3.0])]
    fn body(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        (Vector3::zeros(), Rotation3::from_scaled_axis(Vector3::new(q.turn[0], q.turn[1], q.turn[2])))
    }
}

fn main() {}
