//! A mass on an elastic spring: separable, for the splitting methods, and with jacobians, for the Gauss
//! methods.

use lagrangian::prelude::*;

use crate::{Experiment, G};

/// A mass that hangs on a spring and swings in a plane.
#[derive(Clone, Copy, Debug)]
pub struct Spring<R> {
    /// Mass \[kg].
    pub mass: R,
    /// Length of the slack spring \[m].
    pub length: R,
    /// Stiffness \[N/m].
    pub stiffness: R,
    /// Gravitational acceleration \[m/s²].
    pub g: R,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl<R: Real> Spring<R> {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn elastic(&self, q: &Coordinates<R>) -> R {
        let bob = self.bob(q);
        let stretch = bob.norm() - self.length;
        0.5 * self.stiffness * stretch.powi(2) + self.mass * self.g * bob.y
    }
}

impl<R: Real> Experiment<0> for Spring<R> {
    const NAME: &'static str = "spring";

    fn new() -> Self {
        let [mass, length, stiffness, g] = [0.5, 0.5, 25.0, G].map(R::from_f64);
        Self { mass, length, stiffness, g }
    }

    fn start() -> State<R, 2> {
        State::at_rest([0.5, -0.25].map(R::from_f64))
    }

    fn inputs(_: &State<R, 2>) -> [R; 0] {
        []
    }
}
