//! An integer among the fields, without a conversion.

use lagrangian::prelude::*;

pub struct Spring {
    pub mass: f64,
    pub coils: i32,
}

#[lagrangian(coordinates = [x])]
impl Spring {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        (self.coils as i64).abs() * q.x
    }
}

fn main() {}
