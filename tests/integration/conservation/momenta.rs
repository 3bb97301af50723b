//! Momenta of cyclic coordinates, and linear and angular momentum of free systems.

use lagrangian::prelude::*;

use crate::support::close::{all_close, between};
use crate::support::motion::{TIGHT, drift};

/// Three masses joined by springs, free in space.
struct Molecule {
    m: [f64; 3],
    k: f64,
    length: f64,
}

#[lagrangian(coordinates = [a: [3], b: [3], c: [3]])]
impl Molecule {
    #[point(mass = self.m[..])]
    fn atoms(&self, q: &Coordinates) -> [Vector3<f64>; 3] {
        [Vector3::from(q.a), Vector3::from(q.b), Vector3::from(q.c)]
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        let [a, b, c] = self.atoms(q);
        self.spring(a - b) + self.spring(b - c) + self.spring(c - a)
    }

    fn spring(&self, stretch: Vector3<f64>) -> f64 {
        0.5 * self.k * (stretch.norm() - self.length).powi(2)
    }
}

const MOLECULE: Molecule = Molecule { m: [1.0, 2.0, 3.5], k: 30.0, length: 1.0 };

fn start() -> State<f64, 9> {
    let q = [0.0, 0.0, 0.0, 1.2, 0.1, 0.0, 0.5, 0.9, -0.1];
    let v = [0.3, 1.0, -0.2, -0.5, 0.4, 0.8, 0.7, -0.3, 0.1];
    State::new(q, v)
}

fn momentum(state: &State<f64, 9>) -> Vector3<f64> {
    MOLECULE.momenta(state).chunks(3).map(Vector3::from_column_slice).sum()
}

fn angular_momentum(state: &State<f64, 9>) -> Vector3<f64> {
    let momenta = MOLECULE.momenta(state);
    let parts = state.q.chunks(3).zip(momenta.chunks(3));
    parts.map(|(r, p)| Vector3::from_column_slice(r).cross(&Vector3::from_column_slice(p))).sum()
}

#[test]
fn a_free_molecule_keeps_its_momentum_and_angular_momentum() {
    for axis in 0..3 {
        let mut motion = MOLECULE.simulate(start()).with_tolerance(TIGHT);
        between(-1.0, drift(&mut motion, 1.0, 100, |s| momentum(s)[axis]), 1e-12);
        let mut motion = MOLECULE.simulate(start()).with_tolerance(TIGHT);
        between(-1.0, drift(&mut motion, 1.0, 100, |s| angular_momentum(s)[axis]), 1e-10);
    }
    between(1.0, angular_momentum(&start()).norm(), 10.0);
}

#[test]
fn the_centre_of_mass_moves_uniformly() {
    let total: f64 = MOLECULE.m.iter().sum();
    let centre = |state: &State<f64, 9>| {
        let weighted = MOLECULE.atoms(&state.q.into()).into_iter().zip(MOLECULE.m).map(|(r, m)| r * m);
        weighted.sum::<Vector3<f64>>() / total
    };
    let velocity = momentum(&start()) / total;
    let mut motion = MOLECULE.simulate(start()).with_tolerance(TIGHT);
    let end = motion.advance_to(50.0).unwrap();
    all_close(centre(end).as_slice(), (centre(&start()) + 50.0 * velocity).as_slice(), 1e-12);
}

/// A bead on a parabola that turns freely: the angle is cyclic, the radius is not.
struct Bowl {
    inertia: f64,
}

#[lagrangian(coordinates = [r, phi, s])]
impl Bowl {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.r * q.phi.cos(), q.r * q.phi.sin(), 0.5 * q.r * q.r)
    }

    /// A flywheel geared to the bead: s is cyclic too, and coupled to the angle.
    #[kinetic]
    fn flywheel(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * self.inertia * (v.s + q.r * v.phi).powi(2)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.bead(q).z
    }
}

#[test]
fn cyclic_momenta_stay_and_the_others_do_not() {
    let bowl = Bowl { inertia: 0.4 };
    let start = State::new([1.0, 0.0, 0.0], [0.5, 2.0, -1.0]);
    let run = |index: usize| {
        let mut motion = bowl.simulate(start).with_tolerance(TIGHT);
        drift(&mut motion, 0.25, 200, |s| bowl.momenta(s)[index])
    };
    between(1.0, run(0), 100.0);
    between(-1.0, run(1), 1e-12);
    between(-1.0, run(2), 1e-12);
}
