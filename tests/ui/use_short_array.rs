//! A parameter array with fewer elements than the coordinates it is paired with.

use lagrangian::prelude::*;

pub struct Springs {
    pub mass: f64,
    pub stiffness: [f64; 2],
}

#[lagrangian(coordinates = [x: [3]])]
impl Springs {
    #[point(mass = self.mass)]
    fn blocks(&self, q: &Coordinates) -> [Vector1<f64>; 3] {
        q.x.map(|x| Vector1::new(x))
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        q.x.iter().zip(self.stiffness).map(|(x, k)| 0.5 * k * x.powi(2)).sum()
    }
}

fn main() {}
