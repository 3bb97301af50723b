//! Systems with constraints as a user describes them; multipliers are kept, and nothing is reduced.

use std::marker::PhantomData;

use lagrangian::prelude::*;

/// Gravitational acceleration [m/s²].
const G: f64 = 9.81;

/// Cartesian pendulum, unit mass and length.
pub struct CartesianPendulum<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [x, y])]
impl<R: Real> CartesianPendulum<R> {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        R::from_f64(G) * self.bob(q).y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        0.5 * (q.x.powi(2) + q.y.powi(2) - 1.0)
    }
}

/// Slider and crank, uniform links of lengths ½ and 1, unit masses.
pub struct SliderCrank<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [theta: [2]])]
impl<R: Real> SliderCrank<R> {
    fn along(angle: R) -> Vector2<R> {
        Vector2::new(angle.cos(), angle.sin())
    }

    #[body(mass = 1.0, inertia = 0.25 / 12.0)]
    fn crank(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Self::along(q.theta[0]) * 0.25, q.theta[0])
    }

    #[body(mass = 1.0, inertia = 1.0 / 12.0)]
    fn rod(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Self::along(q.theta[0]) * 0.5 + Self::along(q.theta[1]) * 0.5, q.theta[1])
    }

    /// Moves along x alone.
    #[point(mass = 1.0)]
    fn slider(&self, q: &Coordinates<R>) -> Vector1<R> {
        Vector1::new(0.5 * q.theta[0].cos() + q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        R::from_f64(G) * (self.crank(q).0.y + self.rod(q).0.y)
    }

    #[holonomic]
    fn guide(&self, q: &Coordinates<R>) -> R {
        0.5 * q.theta[0].sin() + q.theta[1].sin()
    }
}

/// Andrews' squeezing mechanism: seven bodies and three loops, with the data of the Test Set for IVP Solvers.
pub struct Andrews<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [beta, theta, gamma, phi, delta, omega, epsilon])]
impl<R: Real> Andrews<R> {
    /// A vector that turns with a body.
    fn turned(angle: R, x: R, y: R) -> Vector2<R> {
        Vector2::new(angle.cos() * x - angle.sin() * y, angle.sin() * x + angle.cos() * y)
    }

    fn a() -> Vector2<R> {
        Vector2::new(-0.06934, -0.00227)
    }

    fn b() -> Vector2<R> {
        Vector2::new(-0.03635, 0.03273)
    }

    fn c() -> Vector2<R> {
        Vector2::new(0.014, 0.072)
    }

    #[body(mass = 0.04325, inertia = 2.194e-6)]
    fn first(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Self::turned(q.beta, 0.00092, 0.0), q.beta)
    }

    #[body(mass = 0.00365, inertia = 4.410e-7)]
    fn second(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        let sigma = q.beta + q.theta;
        (Self::turned(q.beta, 0.007, 0.0) - Self::turned(sigma, 0.0115, 0.0), sigma)
    }

    #[body(mass = 0.02373, inertia = 5.255e-6)]
    fn third(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Self::b() + Self::turned(q.gamma, 0.01043, -0.01874), q.gamma)
    }

    #[body(mass = 0.00706, inertia = 5.667e-7)]
    fn fourth(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        let chi = q.phi + q.delta;
        (Self::a() + Self::turned(q.delta, 0.04, 0.0) + Self::turned(chi, 0.0, 0.01421 - 0.02), chi)
    }

    #[body(mass = 0.07050, inertia = 1.169e-5)]
    fn fifth(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Self::a() + Self::turned(q.delta, 0.02308, 0.00916), q.delta)
    }

    #[body(mass = 0.00706, inertia = 5.667e-7)]
    fn sixth(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        let psi = q.omega + q.epsilon;
        (Self::a() + Self::turned(q.epsilon, 0.0, -0.04) + Self::turned(psi, 0.02 - 0.01421, 0.0), psi)
    }

    #[body(mass = 0.05498, inertia = 1.912e-5)]
    fn seventh(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Self::a() + Self::turned(q.epsilon, -0.00449, -0.01228), q.epsilon)
    }

    #[potential]
    fn spring(&self, q: &Coordinates<R>) -> R {
        let end = Self::b() + Self::turned(q.gamma, 0.02, -0.018);
        0.5 * 4530.0 * ((end - Self::c()).norm() - 0.07785).powi(2)
    }

    #[force(on = beta)]
    fn motor(&self) -> R {
        0.033
    }

    #[holonomic]
    fn loops(&self, q: &Coordinates<R>) -> [R; 6] {
        let pin = Self::turned(q.beta, 0.007, 0.0) - Self::turned(q.beta + q.theta, 0.028, 0.0);
        let first = pin - Self::turned(q.gamma, 0.0, -0.035) - Self::b();
        let (outer, inner) = (q.phi + q.delta, q.delta);
        let second = pin - Self::turned(outer, 0.0, -0.02) - Self::turned(inner, 0.04, 0.0) - Self::a();
        let (outer, inner) = (q.omega + q.epsilon, q.epsilon);
        let third = pin - Self::turned(outer, 0.02, 0.0) - Self::turned(inner, 0.0, -0.04) - Self::a();
        [first.x, first.y, second.x, second.y, third.x, third.y]
    }
}

/// Car axis of the Test Set for IVP Solvers; stiffness and gravity are one.
pub struct CarAxis<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [xl, yl, xr, yr])]
impl<R: Real> CarAxis<R> {
    #[point(mass = 5e-4)]
    fn left(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.xl, q.yl)
    }

    #[point(mass = 5e-4)]
    fn right(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.xr, q.yr)
    }

    /// Right end of the axle, which follows the road.
    fn axle(t: R) -> Vector2<R> {
        let y = 0.1 * (10.0 * t).sin();
        Vector2::new((1.0 - y.powi(2)).sqrt(), y)
    }

    #[potential]
    fn springs_and_gravity(&self, q: &Coordinates<R>, t: R) -> R {
        let (left, right) = (self.left(q), self.right(q));
        let springs = (left.norm() - 0.5).powi(2) + ((right - Self::axle(t)).norm() - 0.5).powi(2);
        0.5 * springs + 5e-4 * (left.y + right.y)
    }

    /// The left spring stands at right angles to the axle.
    #[holonomic]
    fn upright(&self, q: &Coordinates<R>, t: R) -> R {
        Self::axle(t).dot(&self.left(q))
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        (self.left(q) - self.right(q)).norm_squared() - 1.0
    }
}
