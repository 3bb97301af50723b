//! A pendulum in Cartesian coordinates: the rod is a constraint, with a reaction that is its tension.

use lagrangian::prelude::*;

use crate::{Experiment, G};

/// A mass on a massless rod.
#[derive(Clone, Copy, Debug)]
pub struct Rod<R> {
    /// Mass \[kg].
    pub mass: R,
    /// Length of the rod \[m].
    pub length: R,
    /// Gravitational acceleration \[m/s²].
    pub g: R,
}

#[lagrangian(coordinates = [x, y])]
impl<R: Real> Rod<R> {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.mass * self.g * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        self.bob(q).norm() - self.length
    }
}

impl<R: Real> Experiment<0> for Rod<R> {
    const NAME: &'static str = "rod";

    fn new() -> Self {
        Self { mass: R::from_f64(0.5), length: R::from_f64(0.625), g: R::from_f64(G) }
    }

    /// All numbers are exact, so the start is on the constraint in every arithmetic: a 3-4-5 triangle.
    fn start() -> State<R, 2> {
        State::new([0.375, -0.5].map(R::from_f64), [1.0, 0.75].map(R::from_f64))
    }

    fn inputs(_: &State<R, 2>) -> [R; 0] {
        []
    }
}
