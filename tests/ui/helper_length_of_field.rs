//! The length of a helper's array does not follow from a field, whose type the macro does not see.

use lagrangian::prelude::*;

struct System {
    masses: [f64; 2],
}

#[lagrangian(coordinates = [x])]
impl System {
    fn total<const N: usize>(masses: [f64; N]) -> f64 {
        masses.iter().sum::<f64>()
    }

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * Self::total(self.masses) * v.x * v.x
    }
}

fn main() {}
