use lagrangian::prelude::*;

struct System {
    mass: f64,
}

#[lagrangian(coordinates = [x, theta])]
impl System {
    #[body(mass = self.mass, inertia = -0.5)]
    fn bar(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, 0.0), q.theta)
    }
}

fn main() {}
