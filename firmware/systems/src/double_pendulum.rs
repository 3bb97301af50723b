//! Two point masses on massless rods: the classical system with a mass matrix that is not diagonal.

use lagrangian::prelude::*;

use crate::{Experiment, G};

/// The upper mass hangs on the wall, the lower one on the upper.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum<R> {
    /// Masses \[kg].
    pub m: [R; 2],
    /// Rod lengths \[m].
    pub l: [R; 2],
    /// Gravitational acceleration \[m/s²].
    pub g: R,
}

#[lagrangian(coordinates = [theta: [2]])]
impl<R: Real> DoublePendulum<R> {
    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos()) * self.l[0]
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos()) * self.l[1]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
    }
}

impl<R: Real> Experiment<0> for DoublePendulum<R> {
    const NAME: &'static str = "double_pendulum";

    fn new() -> Self {
        Self { m: [0.5, 0.25].map(R::from_f64), l: [0.5, 0.25].map(R::from_f64), g: R::from_f64(G) }
    }

    fn start() -> State<R, 2> {
        State::at_rest([2.0, 1.5].map(R::from_f64))
    }

    fn inputs(_: &State<R, 2>) -> [R; 0] {
        []
    }
}
