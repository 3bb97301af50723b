use lagrangian::prelude::*;

struct Pendulum {
    length: f64,
}

#[lagrangian(coordinates = [x, y], analysis)]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.why)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

fn main() -> Result<(), MotionError<f64>> {
    let pendulum = Pendulum { length: 1.0 };
    let state = State::new([0.0, -1.0], [0.2, 0.0]);
    let force = pendulum.reactions_on_bob(&state)?.rod;
    println!("{} {:?}", force.norm(), pendulum.constraint_residuals(&state));
    Ok(())
}
