//! A length that is a parameter of the type.

use lagrangian::prelude::*;

pub struct Chain<const N: usize> {
    pub m: [f64; N],
}

#[lagrangian(coordinates = [y: [N]])]
impl<const N: usize> Chain<N> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.m[0] * v.y[0].powi(2)
    }
}

fn main() {}
