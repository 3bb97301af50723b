//! The systems of the page. One thing is hard in each.

use lagrangian::prelude::*;

/// A mass that damping of rate 10⁴ pulls to a moving place: after A. Prothero and A. Robinson (Math. Comp. 28
/// (1974) 145), x = cos t is a motion whatever the rates are, here 1 and `rate`.
#[derive(Clone, Copy, Debug)]
pub struct Relaxing {
    /// The fast rate [1/s].
    pub rate: f64,
}

#[lagrangian(coordinates = [x], jacobians)]
impl Relaxing {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn pull(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        -(1.0 + self.rate) * (v.x + t.sin()) - self.rate * (q.x - t.cos()) - t.cos()
    }
}

/// A unit mass that swings on a spring so stiff that its oscillation is hundreds of times as fast as the
/// swing.
#[derive(Clone, Copy, Debug)]
pub struct StiffSpring {
    /// Stiffness [N/m].
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl StiffSpring {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring_and_gravity(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * (self.bob(q).norm() - 1.0).powi(2) + 9.81 * q.y
    }
}

/// Planar double pendulum, absolute angles, unit masses and lengths.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum;

#[lagrangian(coordinates = [theta: [2]], jacobians)]
impl DoublePendulum {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (self.upper(q).y + self.lower(q).y)
    }
}

/// The potential of Hénon and Heiles in any unit of length and mass.
#[derive(Clone, Copy, Debug)]
pub struct HenonHeiles<R> {
    /// The length that is one in the original.
    pub size: R,
    /// The mass that is one in the original.
    pub mass: R,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl<R: Real> HenonHeiles<R> {
    #[point(mass = self.mass)]
    fn star(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn galaxy(&self, q: &Coordinates<R>) -> R {
        let (x, y) = (q.x / self.size, q.y / self.size);
        let shape = 0.5 * (x.powi(2) + y.powi(2)) + x.powi(2) * y - y.powi(3) / 3.0;
        self.mass * self.size.powi(2) * shape
    }
}

/// Two masses, 1 and 2, in a plane, on a spring of rest length zero.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// Stiffness [N/m].
    pub stiffness: f64,
}

#[lagrangian(coordinates = [first: [2], second: [2]], jacobians)]
impl Pair {
    #[point(mass = 1.0)]
    fn one(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::from(q.first)
    }

    #[point(mass = 2.0)]
    fn two(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::from(q.second)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * (self.two(q) - self.one(q)).norm_squared()
    }
}

/// A pendulum by the place of its bob, with the rod as a constraint, in any units and about any pivot.
#[derive(Clone, Copy, Debug)]
pub struct Rod<R> {
    /// Place of the pivot.
    pub pivot: [R; 2],
    /// Length of the rod.
    pub length: R,
    /// Mass of the bob.
    pub mass: R,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl<R: Real> Rod<R> {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        9.81 * self.length * self.mass * (q.y - self.pivot[1])
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        0.5 * ((q.x - self.pivot[0]).powi(2) + (q.y - self.pivot[1]).powi(2) - self.length.powi(2))
    }
}

/// A bead on a straight wire that turns at one radian a second, without gravity: r = cosh t from rest at one.
#[derive(Clone, Copy, Debug)]
pub struct Bead;

#[lagrangian(coordinates = [x, y], jacobians)]
impl Bead {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates, t: f64) -> f64 {
        q.x * t.sin() - q.y * t.cos()
    }
}

/// The pendulum of unit length with its rod asked for three times, once with a factor that varies.
#[derive(Clone, Copy, Debug)]
pub struct Thrice;

#[lagrangian(coordinates = [x, y], jacobians, allow(redundant))]
impl Thrice {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 3] {
        let off = 0.5 * (q.x * q.x + q.y * q.y - 1.0);
        [off, 3.0 * off, off * (2.0 + q.x)]
    }
}

/// A parallelogram of three uniform bars of 1 m and 1 kg on a ground of 1 m.
#[derive(Clone, Copy, Debug)]
pub struct Parallelogram;

#[lagrangian(coordinates = [a, b, c], jacobians)]
impl Parallelogram {
    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    #[body(mass = 1.0, inertia = 1.0 / 12.0)]
    fn crank(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::along(q.a) * 0.5, q.a)
    }

    #[body(mass = 1.0, inertia = 1.0 / 12.0)]
    fn coupler(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::along(q.a) + Self::along(q.b) * 0.5, q.b)
    }

    #[body(mass = 1.0, inertia = 1.0 / 12.0)]
    fn rocker(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(1.0, 0.0) + Self::along(q.c) * 0.5, q.c)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (self.crank(q).0.y + self.coupler(q).0.y + self.rocker(q).0.y)
    }

    #[holonomic]
    fn hinge(&self, q: &Coordinates) -> Vector2<f64> {
        Self::along(q.a) + Self::along(q.b) - Self::along(q.c) - Vector2::new(1.0, 0.0)
    }
}
