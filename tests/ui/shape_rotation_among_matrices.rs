//! A sum of a matrix and the matrix of a rotation.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Block {
    #[point(mass = self.mass)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let turned = Rotation3::from_axis_angle(&Vector3::y_axis(), q.x).into_inner();
        let sum = Matrix3::identity() + turned;
        self.stiffness * sum.m11
    }
}

fn main() {}
