use lagrangian::prelude::*;

struct Body;

#[lagrangian(coordinates = [attitude: Quaternion])]
impl Body {
    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * v.attitude.norm_squared()
    }
}

fn main() {}
