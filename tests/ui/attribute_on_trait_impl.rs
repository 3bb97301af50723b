//! The attribute stands on the implementation of a trait.

use lagrangian::prelude::*;

pub trait Potential {
    fn potential(&self, x: f64) -> f64;
}

pub struct Block {
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Potential for Block {
    fn potential(&self, x: f64) -> f64 {
        0.5 * self.stiffness * x * x
    }
}

fn main() {}
