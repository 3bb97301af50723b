//! A matrix of inertia whose two products of inertia differ.

use lagrangian::prelude::*;

pub struct Block;

#[lagrangian(coordinates = [attitude: Rotation])]
impl Block {
    #[body(mass = 1.0, inertia = Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0))]
    fn block(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.attitude)
    }
}

fn main() {}
