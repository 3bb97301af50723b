use lagrangian::prelude::*;

struct Damped {
    c: f64,
}

#[lagrangian(coordinates = [x])]
impl Damped {
    #[point(mass = 1.0)]
    fn body(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    /// Meant as a force.
    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        -self.c * v.x
    }
}

fn main() {}
