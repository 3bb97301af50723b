use lagrangian::prelude::*;

struct Pendulum;

#[lagrangian(coordinates = [theta], analysis = true)]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos())
    }
}

fn main() {}
