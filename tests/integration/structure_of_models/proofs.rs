//! The properties of systems that the macro proves in traits, and those that it does not.

use lagrangian::prelude::*;
use lagrangian::{Autonomous, Conservative, ConstantMass, Cyclic, Holonomic, Scleronomic, Separable};

/// Which proofs a type has: an inherent constant is found before that of a trait, where its bounds hold.
macro_rules! proofs {
    ($system:ty, $count:literal: $($proof:ident)*) => {{
        let mut found = Vec::new();
        $({
            #[allow(dead_code, reason = "where the bound holds")]
            trait Absent {
                const HOLDS: bool = false;
            }
            impl<T> Absent for T {}
            struct Asked<T>(core::marker::PhantomData<T>);
            #[allow(dead_code, reason = "where the bound does not hold")]
            impl<T: $proof<$count>> Asked<T> {
                const HOLDS: bool = true;
            }
            if Asked::<$system>::HOLDS {
                found.push(stringify!($proof));
            }
        })*
        found.join(" ")
    }};
    ($system:ty, $count:literal) => {
        proofs!($system, $count: ConstantMass Separable Autonomous Conservative Holonomic Scleronomic Cyclic)
    };
}

struct Projectile;

#[lagrangian(coordinates = [x, z])]
impl Projectile {
    #[point(mass = 2.0)]
    fn stone(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.z)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        19.62 * q.z
    }
}

struct SphericalPendulum;

#[lagrangian(coordinates = [theta, phi])]
impl SphericalPendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.theta.sin() * q.phi.cos(), q.theta.sin() * q.phi.sin(), -q.theta.cos())
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).z
    }
}

/// A frame that turns at a given rate: T₀ and T₁ are not zero, though time appears nowhere.
struct Turntable;

#[lagrangian(coordinates = [x, y])]
impl Turntable {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * ((v.x - 3.0 * q.y).powi(2) + (v.y + 3.0 * q.x).powi(2))
    }
}

/// A charge in a magnetic field: L has a term linear in the velocities.
struct Charge;

#[lagrangian(coordinates = [x, y])]
impl Charge {
    #[lagrangian]
    fn whole(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2)) + 0.25 * (q.x * v.y - q.y * v.x)
    }
}

struct Relativistic;

#[lagrangian(coordinates = [x])]
impl Relativistic {
    #[lagrangian]
    fn whole(&self, v: &Velocities) -> f64 {
        -(1.0 - v.x.powi(2)).sqrt()
    }
}

/// A pendulum in Cartesian coordinates whose pivot is moved.
struct Moved;

#[lagrangian(coordinates = [x, y])]
impl Moved {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates, t: f64) -> f64 {
        (q.x - 0.1 * t.sin()).hypot(q.y) - 1.0
    }
}

struct Skate;

#[lagrangian(coordinates = [x, y, heading])]
impl Skate {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2) + 0.1 * v.heading.powi(2))
    }

    #[nonholonomic]
    fn no_slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.y * q.heading.cos() - v.x * q.heading.sin()
    }
}

#[test]
fn a_system_has_the_proofs_that_its_equations_give() {
    assert_eq!(
        proofs!(Projectile, 2),
        "ConstantMass Separable Autonomous Conservative Holonomic Scleronomic Cyclic"
    );
    assert_eq!(proofs!(SphericalPendulum, 2), "Autonomous Conservative Holonomic Scleronomic Cyclic");
    assert_eq!(proofs!(Turntable, 2), "ConstantMass Autonomous Conservative Holonomic");
    assert_eq!(proofs!(Charge, 2), "ConstantMass Autonomous Conservative Holonomic");
    assert_eq!(proofs!(Relativistic, 1), "Autonomous Conservative Holonomic Cyclic");
    assert_eq!(proofs!(Moved, 2), "ConstantMass Holonomic");
    // No reaction turns the skate: its spin is conserved.
    assert_eq!(proofs!(Skate, 3), "ConstantMass Autonomous Conservative Scleronomic Cyclic");
}
