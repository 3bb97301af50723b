//! A signature that is being written.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: ) -> f64 {
        0.5 * self.stiffness * q.x.powi(2)
    }
}

fn main() {
    let block = Block { mass: 1.0, stiffness: 1.0 };
    let mut motion = block.simulate(State::at_rest([1.0]));
    motion.advance_to(1.0).unwrap();
    println!("{}", block.energy(motion.state()));
}
