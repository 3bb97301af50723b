//! The attribute stands on a free function.

use lagrangian::prelude::*;

#[lagrangian(coordinates = [x])]
pub fn potential(x: f64) -> f64 {
    0.5 * x * x
}

fn main() {}
