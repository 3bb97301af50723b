//! Derivatives by a field that is several parameters.

use lagrangian::prelude::*;

pub struct Block {
    pub inertia: [f64; 3],
}

#[lagrangian(coordinates = [attitude: Rotation], sensitivities = [self.inertia])]
impl Block {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn block(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.attitude)
    }
}

fn main() {}
