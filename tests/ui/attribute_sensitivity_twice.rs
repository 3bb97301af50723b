//! Derivatives by the same parameter twice.

use lagrangian::prelude::*;

pub struct Pendulum {
    pub length: f64,
}

#[lagrangian(coordinates = [theta], sensitivities = [self.length, self.length])]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }
}

fn main() -> Result<(), MotionError<f64>> {
    let pendulum = Pendulum { length: 1.0 };
    let start = State::at_rest([1.0]);
    let _ = pendulum.sensitivities(&start, &[])?;
    let _ = pendulum.variational().motion(start)?.advance_to(1.0)?;
    Ok(())
}
