use lagrangian::prelude::*;

struct Pendulum;

#[lagrangian(coordinates = [theta], analysis)]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn hamiltonian(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }
}

fn main() {}
