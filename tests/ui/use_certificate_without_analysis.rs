use lagrangian::prelude::*;
use lagrangian::verify::Verifiable;

struct Pendulum;

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos())
    }
}

fn certified(_: &impl Verifiable<1>) {}

fn main() {
    certified(&Pendulum);
}
