//! Properties that must not be claimed: Lagrangians that depend on time though their equations do not, and
//! forces that a search could overlook.

use lagrangian::prelude::*;
use lagrangian::{Autonomous, Conservative, Cyclic};

use crate::support::close::{all_close, close};

/// Whether types have two proofs.
macro_rules! proofs {
    ($system:ty, $count:literal) => {{
        let mut found = Vec::new();
        proofs!(found, $system, $count: Autonomous Conservative Cyclic);
        found
    }};
    ($found:ident, $system:ty, $count:literal: $($proof:ident)*) => {$({
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
            $found.push(stringify!($proof));
        }
    })*};
}

/// A charge in a field that is written as that of a potential A = −E t.
struct Charge;

#[lagrangian(coordinates = [x], analysis)]
impl Charge {
    #[lagrangian]
    fn whole(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        0.5 * v.x * v.x + t * v.x - q.x * q.x - q.x
    }
}

/// The same with other spellings.
struct Spelled;

#[lagrangian(coordinates = [x], analysis)]
impl Spelled {
    #[lagrangian]
    fn whole(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        0.5 * v.x.powi(2) + t * v.x - q.x.powi(2) - q.x
    }
}

/// The same in parts.
struct Parts {
    field: f64,
}

#[lagrangian(coordinates = [x], analysis)]
impl Parts {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        q.x * q.x + q.x
    }

    #[lagrangian]
    fn of_field(&self, v: &Velocities, t: f64) -> f64 {
        self.field * t * v.x
    }
}

/// Two coordinates, with d(t x y)/dt beside T − y⁴.
struct Twisted;

#[lagrangian(coordinates = [x, y], analysis)]
impl Twisted {
    #[lagrangian]
    fn whole(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y) + t * q.y * v.x + t * q.x * v.y + q.x * q.y - q.y.powi(4)
    }
}

#[test]
fn equations_without_time_do_not_make_a_conserved_energy() {
    let none: [&str; 0] = [];
    assert_eq!(
        [Charge::CONSERVED.len(), Spelled::CONSERVED.len(), Parts::CONSERVED.len(), Twisted::CONSERVED.len()],
        [0; 4]
    );
    assert_eq!(Charge::CONSERVED, none);
    assert_eq!(proofs!(Charge, 1), ["Autonomous"]);
    assert_eq!(proofs!(Spelled, 1), ["Autonomous"]);
    assert_eq!(proofs!(Parts, 1), ["Autonomous"]);
    assert_eq!(proofs!(Twisted, 2), ["Autonomous"]);
    for structure in [Charge::STRUCTURE, Spelled::STRUCTURE, Parts::STRUCTURE, Twisted::STRUCTURE] {
        let text = structure.to_string();
        assert!(!text.contains("conserved") && !text.contains("nothing depends on it"), "{text}");
    }
    let state = State::new([0.3], [0.4]);
    close(Charge.energy_rate(&state).unwrap(), -0.4, 1e-15);
    close(Parts { field: 2.0 }.energy_rate(&state).unwrap(), -0.8, 1e-15);
    all_close(Charge.accelerations(&state).unwrap(), Spelled.accelerations(&state).unwrap(), 1e-15);
    Charge.verify().unwrap();
    Spelled.verify().unwrap();
    Parts { field: 2.0 }.verify().unwrap();
    Twisted.verify().unwrap();
}

/// Forces that act far away, or are small: a stop, one of Hertz's law, a wall of an exponential, a weak
/// field.
struct Stopped;

#[lagrangian(coordinates = [x, y, z, w], analysis)]
impl Stopped {
    #[kinetic]
    fn balls(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2) + v.z.powi(2) + v.w.powi(2))
    }

    #[potential]
    fn obstacles(&self, q: &Coordinates) -> f64 {
        (q.x - 100.0).max(0.0).powi(2)
            + (q.y - 100.0).max(0.0).powf(2.5)
            + (30.0 * (q.z - 20.0)).exp()
            + 1e-14 * q.w
    }
}

/// A stop between two bodies is no force from outside.
struct Buffers;

#[lagrangian(coordinates = [x, y], analysis)]
impl Buffers {
    #[kinetic]
    fn carriages(&self, v: &Velocities) -> f64 {
        0.5 * (2.0 * v.x.powi(2) + 3.0 * v.y.powi(2))
    }

    #[potential]
    fn buffer(&self, q: &Coordinates) -> f64 {
        (1.0 - (q.y - q.x)).max(0.0).powi(2)
    }
}

#[test]
fn forces_far_away_and_weak_ones_break_symmetries() {
    assert_eq!(Stopped::CONSERVED, ["energy"]);
    assert_eq!(Buffers::CONSERVED, ["energy", "momentum along x + y"]);
}
