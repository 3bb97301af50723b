//! The components of an orientation's quaternion.
use lagrangian::prelude::*;

struct Body;

#[lagrangian(coordinates = [attitude: Rotation])]
impl Body {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 3.0])]
    fn body(&self, q: &Coordinates) -> (Vector3<f64>, UnitQuaternion<f64>) {
        (Vector3::zeros(), q.attitude)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        1.0 - q.attitude.w
    }
}

fn main() {}
