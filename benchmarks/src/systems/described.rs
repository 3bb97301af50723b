//! The systems as a user describes them, with the parameters of the peers' benchmarks, for any scalar: one
//! number or the lanes of a SIMD vector.

use std::marker::PhantomData;

use lagrangian::prelude::*;

/// Gravitational acceleration [m/s²].
const G: f64 = 9.81;

/// Planar double pendulum, absolute angles, unit masses and lengths.
pub struct DoublePendulum<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [theta: [2]])]
impl<R: Real> DoublePendulum<R> {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        R::from_f64(G) * (self.upper(q).y + self.lower(q).y)
    }
}

/// Mass on a spring that swings.
pub struct SpringPendulum<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [r, theta])]
impl<R: Real> SpringPendulum<R> {
    #[kinetic]
    fn energy_of_motion(&self, q: &Coordinates<R>, v: &Velocities<R>) -> R {
        0.5 * (v.r.powi(2) + (q.r * v.theta).powi(2))
    }

    #[potential]
    fn gravity_and_spring(&self, q: &Coordinates<R>) -> R {
        -R::from_f64(G) * q.r * q.theta.cos() + 20.0 * (q.r - 1.0).powi(2)
    }
}

/// Hénon–Heiles potential.
pub struct HenonHeiles<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [x, y])]
impl<R: Real> HenonHeiles<R> {
    #[kinetic]
    fn energy_of_motion(&self, v: &Velocities<R>) -> R {
        0.5 * (v.x.powi(2) + v.y.powi(2))
    }

    #[potential]
    fn galaxy(&self, q: &Coordinates<R>) -> R {
        0.5 * (q.x.powi(2) + q.y.powi(2)) + q.x.powi(2) * q.y - q.y.powi(3) / 3.0
    }
}

/// Kepler problem, μ = 1.
pub struct Kepler<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [x, y])]
impl<R: Real> Kepler<R> {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn sun(&self, q: &Coordinates<R>) -> R {
        -1.0 / self.planet(q).norm()
    }
}

/// Seven stars in a plane with masses 1 to 7.
pub struct Pleiades<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [x: [7], y: [7]])]
impl<R: Real> Pleiades<R> {
    fn masses() -> [R; 7] {
        [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    }

    #[point(mass = Self::masses())]
    fn stars(&self, q: &Coordinates<R>) -> [Vector2<R>; 7] {
        core::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        let (masses, stars) = (Self::masses(), self.stars(q));
        let mut potential = 0.0;
        for i in 0..7 {
            for j in 0..i {
                potential -= masses[i] * masses[j] / (stars[i] - stars[j]).norm();
            }
        }
        potential
    }
}

/// Heavy symmetric top: I₁ = 1, I₃ = 0.6, m g l = 2.
pub struct Top<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [phi, theta, psi])]
impl<R: Real> Top<R> {
    #[kinetic]
    fn energy_of_motion(&self, q: &Coordinates<R>, v: &Velocities<R>) -> R {
        let spin = v.psi + v.phi * q.theta.cos();
        0.5 * (v.theta.powi(2) + (v.phi * q.theta.sin()).powi(2)) + 0.5 * 0.6 * spin.powi(2)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        2.0 * q.theta.cos()
    }
}

/// Spherical pendulum, θ from the downward vertical.
pub struct SphericalPendulum<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [theta, phi])]
impl<R: Real> SphericalPendulum<R> {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates<R>) -> Vector3<R> {
        let radius = q.theta.sin();
        Vector3::new(radius * q.phi.cos(), radius * q.phi.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        R::from_f64(G) * self.bob(q).z
    }
}

/// Cart and pole with damping and a periodic force; θ from upright.
pub struct CartPole<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [x, theta])]
impl<R: Real> CartPole<R> {
    #[point(mass = 1.0)]
    fn cart(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, 0.0)
    }

    #[point(mass = 0.2)]
    fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * 0.5
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        0.2 * R::from_f64(G) * self.tip(q).y
    }

    #[dissipation]
    fn bearings(&self, v: &Velocities<R>) -> R {
        0.5 * (0.1 * v.x.powi(2) + 0.02 * v.theta.powi(2))
    }

    #[force(at = cart)]
    fn motor(&self, t: R) -> Vector2<R> {
        Vector2::new(2.0 * (1.5 * t).cos(), 0.0)
    }
}

/// The same with an input for the force, as a control loop has it.
pub struct DrivenCartPole<R>(pub PhantomData<R>);

#[lagrangian(coordinates = [x, theta], inputs = [motor])]
impl<R: Real> DrivenCartPole<R> {
    #[point(mass = 1.0)]
    fn cart(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, 0.0)
    }

    #[point(mass = 0.2)]
    fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * 0.5
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        0.2 * R::from_f64(G) * self.tip(q).y
    }

    #[dissipation]
    fn bearings(&self, v: &Velocities<R>) -> R {
        0.5 * (0.1 * v.x.powi(2) + 0.02 * v.theta.powi(2))
    }

    #[force(at = cart)]
    fn motor(&self, u: &Inputs<R>) -> Vector2<R> {
        Vector2::new(u.motor, 0.0)
    }
}

/// A planar chain of unit links with unit masses at the joints, written with positions.
macro_rules! chain {
    ($name:ident, $count:literal) => {
        /// Planar chain.
        pub struct $name<R>(pub PhantomData<R>);

        #[lagrangian(coordinates = [theta: [$count]])]
        impl<R: Real> $name<R> {
            #[point(mass = 1.0)]
            fn joints(&self, q: &Coordinates<R>) -> [Vector2<R>; $count] {
                let mut joints = [Vector2::zeros(); $count];
                let mut end = Vector2::zeros();
                for i in 0..$count {
                    end += Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
                    joints[i] = end;
                }
                joints
            }

            #[potential]
            fn gravity(&self, q: &Coordinates<R>) -> R {
                self.joints(q).iter().map(|joint| R::from_f64(G) * joint.y).sum()
            }
        }
    };
}

chain!(Chain3, 3);
chain!(Chain5, 5);
chain!(Chain10, 10);
chain!(Chain20, 20);
