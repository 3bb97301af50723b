//! A pole on a cart that a motor drives.

use lagrangian::prelude::*;

/// A cart on a rail with a pole hinged to it.
#[derive(Clone, Copy, Debug)]
pub struct CartPole {
    /// Mass of the cart \[kg].
    pub cart_mass: f64,
    /// Mass at the tip of the pole \[kg].
    pub pole_mass: f64,
    /// Length of the pole \[m].
    pub length: f64,
    /// Damping of the hinge \[N m s/rad].
    pub damping: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [x, theta], inputs = [motor])]
impl CartPole {
    #[point(mass = self.cart_mass)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    /// The angle is measured from the upward vertical.
    #[point(mass = self.pole_mass)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.pole_mass * self.g * self.tip(q).y
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.theta.powi(2)
    }

    #[force(on = x)]
    fn drive(&self, u: &Inputs) -> f64 {
        u.motor
    }
}

impl CartPole {
    /// The force \[N] of a state feedback that holds the pole up.
    pub fn feedback(state: &State<f64, 2>) -> [f64; 1] {
        let State { q: [x, theta], v: [speed, rate], .. } = *state;
        [3.125 * x + 25.0 * theta + 3.5 * speed + 4.625 * rate]
    }
}
