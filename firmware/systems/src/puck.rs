//! A puck on a spring, thrown onto a rough floor: it bounces, slips, sticks and slips again.

use lagrangian::prelude::*;

use crate::{Experiment, G};

/// A mass that moves up and down and along a floor.
#[derive(Clone, Copy, Debug)]
pub struct Puck<R> {
    /// Mass \[kg].
    pub mass: R,
    /// Stiffness of a spring along the floor \[N/m].
    pub stiffness: R,
    /// Coefficient of friction.
    pub friction: R,
    /// Coefficient of restitution.
    pub restitution: R,
    /// Gravitational acceleration \[m/s²].
    pub g: R,
}

#[lagrangian(coordinates = [x, y])]
impl<R: Real> Puck<R> {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.mass * self.g * q.y
    }

    #[potential]
    fn spring(&self, q: &Coordinates<R>) -> R {
        0.5 * self.stiffness * q.x * q.x
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates<R>) -> R {
        q.y
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn slip(&self, v: &Velocities<R>) -> R {
        v.x
    }
}

impl<R: Real> Experiment<0> for Puck<R> {
    const NAME: &'static str = "puck";

    fn new() -> Self {
        Self {
            mass: R::from_f64(0.25),
            stiffness: R::from_f64(8.0),
            friction: R::from_f64(0.125),
            restitution: R::from_f64(0.5),
            g: R::from_f64(G),
        }
    }

    fn start() -> State<R, 2> {
        State::new([0.0, 0.25].map(R::from_f64), [3.0, 0.0].map(R::from_f64))
    }

    fn inputs(_: &State<R, 2>) -> [R; 0] {
        []
    }
}
