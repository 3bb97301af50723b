//! A cart-pole: the plant and its regulator, for the target in `f32` and for the design on the developer's
//! machine in `f64`, from one description.
//!
//! `gain.rs`, a test, computes the gains from the derivatives of the equations of motion and compares them
//! with those that the target uses.
#![no_std]

use lagrangian::prelude::*;

#[cfg(test)]
mod gain;

/// A cart on a rail, driven by a motor, with a pole hinged to it.
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

#[lagrangian(coordinates = [x, theta], inputs = [motor], jacobians)]
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

    #[force(at = cart)]
    fn drive(&self, u: &Inputs<R>) -> Vector2<R> {
        Vector2::new(u.motor, R::zero())
    }
}

impl<R: Real> CartPole<R> {
    /// A laboratory model: 0.5 kg cart, 0.2 kg on a pole of 0.4 m.
    pub fn laboratory() -> Self {
        let [cart_mass, pole_mass, length, damping, g] = [0.5, 0.2, 0.4, 0.002, 9.81].map(R::from_f64);
        Self { cart_mass, pole_mass, length, damping, g }
    }
}

/// How often the state is sampled and the force set \[Hz].
pub const RATE: u16 = 1000;

/// The largest force of the motor \[N].
pub const STRONGEST: f32 = 6.0;

/// The linear-quadratic regulator of the upright pole: force per metre, radian, metre a second and radian a
/// second.
pub const GAINS: [f32; 4] = [3.136_759_8, 24.866_923, 3.534_815_6, 4.640_286_4];

/// The force of the motor \[N].
#[inline]
pub fn control(state: &State<f32, 2>) -> f32 {
    let force: f32 = GAINS.iter().zip(state.iter()).map(|(gain, x)| gain * x).sum();
    force.clamp(-STRONGEST, STRONGEST)
}
