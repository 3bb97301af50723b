//! Two masses for three points.

use lagrangian::prelude::*;

pub struct Chain {
    pub m: [f64; 3],
    pub g: f64,
}

#[lagrangian(coordinates = [y: [3]])]
impl Chain {
    #[point(mass = [self.m[0], self.m[1]])]
    fn beads(&self, q: &Coordinates) -> [Vector2<f64>; 3] {
        [Vector2::new(0.0, q.y[0]), Vector2::new(1.0, q.y[1]), Vector2::new(2.0, q.y[2])]
    }
}

fn main() {}
