use lagrangian::prelude::*;

struct Body;

#[lagrangian(coordinates = [attitude: Rotation])]
impl Body {
    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * v.attitude.norm_squared()
    }

    fn state(&self) -> f64 {
        1.0
    }

    fn velocities(&self) -> f64 {
        1.0
    }
}

fn main() {}
