//! A pole on a cart that a motor drives: the textbook plant of control.

use lagrangian::prelude::*;

use crate::{Experiment, G};

/// A cart on a rail with a pole hinged to it.
#[derive(Clone, Copy, Debug)]
pub struct CartPole<R> {
    /// Mass of the cart \[kg].
    pub cart_mass: R,
    /// Mass at the tip of the pole \[kg].
    pub pole_mass: R,
    /// Length of the pole \[m].
    pub length: R,
    /// Damping of the hinge \[N m s/rad].
    pub damping: R,
    /// Gravitational acceleration \[m/s²].
    pub g: R,
}

#[lagrangian(coordinates = [x, theta], inputs = [motor])]
impl<R: Real> CartPole<R> {
    #[point(mass = self.cart_mass)]
    fn cart(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, R::zero())
    }

    /// The angle is measured from the upward vertical.
    #[point(mass = self.pole_mass)]
    fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.pole_mass * self.g * self.tip(q).y
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities<R>) -> R {
        0.5 * self.damping * v.theta.powi(2)
    }

    #[force(on = x)]
    fn drive(&self, u: &Inputs<R>) -> R {
        u.motor
    }
}

impl<R: Real> Experiment<1> for CartPole<R> {
    const NAME: &'static str = "cart_pole";

    fn new() -> Self {
        let [cart_mass, pole_mass, length, damping, g] =
            [0.5, 0.1875, 0.375, 0.001953125, G].map(R::from_f64);
        Self { cart_mass, pole_mass, length, damping, g }
    }

    fn start() -> State<R, 2> {
        State::at_rest([0.0, 0.1875].map(R::from_f64))
    }

    /// A state feedback that holds the pole up.
    fn inputs(state: &State<R, 2>) -> [R; 1] {
        let gains = [3.125, 25.0, 3.5, 4.625].map(R::from_f64);
        [gains.into_iter().zip(state.iter()).map(|(gain, x)| gain * x).sum()]
    }
}
