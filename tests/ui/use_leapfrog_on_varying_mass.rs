//! A splitting method for a system whose mass matrix depends on the coordinates.

use lagrangian::prelude::*;

pub struct DoublePendulum {
    pub l: [f64; 2],
}

#[lagrangian(coordinates = [theta: [2]])]
impl DoublePendulum {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        self.l[0] * Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + self.l[1] * Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (self.upper(q).y + self.lower(q).y)
    }
}

fn main() {
    let pendulum = DoublePendulum { l: [1.0, 1.0] };
    let _ = pendulum.stepper::<Leapfrog>(State::at_rest([2.0, 2.0]));
}
