//! A quaternion of which nobody says that its length is one.
use lagrangian::prelude::*;

struct Top {
    mass: f64,
}

#[lagrangian(coordinates = [e: [4]])]
impl Top {
    #[body(mass = self.mass, inertia = [1.0, 2.0, 3.0])]
    fn top(&self, q: &Coordinates) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let turn = UnitQuaternion::new_unchecked(Quaternion::new(q.e[0], q.e[1], q.e[2], q.e[3]));
        (turn * Vector3::z(), turn)
    }

    #[holonomic]
    fn unit(&self, q: &Coordinates) -> f64 {
        q.e.iter().map(|part| part * part).sum::<f64>() - 1.0
    }
}

fn main() {}
