use lagrangian::prelude::*;

struct Body;

#[lagrangian(coordinates = [attitude: Rotation], inputs = [torque: Rotation])]
impl Body {
    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * v.attitude.norm_squared()
    }
}

fn main() {}
