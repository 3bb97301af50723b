//! A mistake in a system whose motions run in lanes: its series stay.

use lagrangian::prelude::*;
use lagrangian::{Sensitive, Smooth};

pub struct Block {
    pub mass: f64,
}

#[lagrangian(coordinates = [x], jacobians)]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.y.powi(2)
    }
}

/// What lanes ask for.
fn in_lanes<S: Sensitive<1, 0, 0, 0, D>, const D: usize>(_: &S)
where
    S::Over<f64>: Smooth<1>,
{
}

fn main() {
    in_lanes(&Block { mass: 1.0 });
}
