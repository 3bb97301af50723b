//! The attribute stands on a trait.

use lagrangian::prelude::*;

#[lagrangian(coordinates = [x])]
pub trait Oscillator {
    fn potential(&self, x: f64) -> f64;
}

fn main() {}
