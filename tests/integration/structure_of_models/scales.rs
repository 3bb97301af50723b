//! Certificates of models whose scales are far from one: molecules, orbits, stiff springs.

use lagrangian::prelude::*;

/// A point mass about a centre, in SI units.
struct Orbit {
    mu: f64,
}

#[lagrangian(coordinates = [x, y], analysis)]
impl Orbit {
    #[point(mass = 1.0)]
    fn satellite(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.mu / self.satellite(q).norm()
    }
}

#[test]
fn orbits_of_any_strength_have_a_certificate() {
    for mu in [1e-12, 1.0, 1e6, 1e8, 3.986e14, 1.3e20] {
        let passed = Orbit { mu }.verify().unwrap_or_else(|violation| panic!("mu = {mu:e}: {violation}"));
        assert!(passed.worst < 0.5, "{mu:e}: {passed}");
    }
    let orbit = Orbit { mu: 3.986e14 };
    let states = [State::new([7e6, 0.0], [0.0, 7.5e3]), State::new([-4e7, 1e6], [300.0, -2.9e3])];
    orbit.verify_at(&states).unwrap();
}

/// Two atoms of argon at a distance, by Lennard-Jones.
struct Argon {
    m: f64,
    eps: f64,
    s: f64,
}

#[lagrangian(coordinates = [r], analysis)]
impl Argon {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.m * v.r.powi(2)
    }

    #[potential]
    fn bond(&self, q: &Coordinates) -> f64 {
        let share = (self.s / q.r).powi(6);
        4.0 * self.eps * (share * share - share)
    }
}

#[test]
fn molecules_have_a_certificate_where_they_are() {
    let argon = Argon { m: 6.63e-26, eps: 1.65e-21, s: 3.4e-10 };
    for r in [3.3e-10, 3.82e-10, 5e-10, 9e-10] {
        for v in [0.0, 100.0, -400.0] {
            argon.verify_at(&[State::new([r], [v])]).unwrap_or_else(|violation| panic!("{r:e}: {violation}"));
        }
    }
    argon.verify().unwrap();
}

/// A comb of silicon on springs that is pulled by a voltage and moves in gas.
struct Comb {
    mass: f64,
    stiffness: f64,
    charge: f64,
    damping: f64,
}

#[lagrangian(coordinates = [x, tilt], analysis)]
impl Comb {
    #[body(mass = self.mass, inertia = self.mass * 1e-9)]
    fn plate(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, 0.0), q.tilt)
    }

    #[potential]
    fn forces(&self, q: &Coordinates, t: f64) -> f64 {
        0.5 * self.stiffness * (q.x.powi(2) + 1e-9 * q.tilt.powi(2))
            - self.charge * (1e5 * t).cos().powi(2) / (2e-6 - q.x)
    }

    #[dissipation]
    fn gas(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.x.powi(2)
    }
}

#[test]
fn micromachines_have_a_certificate_where_they_are() {
    let comb = Comb { mass: 1e-10, stiffness: 1.0, charge: 1e-13, damping: 1e-6 };
    let states = [
        State::new([3e-7, 1e-4], [0.02, 3.0]),
        State::new([-5e-7, 0.0], [0.0, -1.0]).at_time(3e-6),
        State::new([3e-7, 1e-6], [0.0, 0.0]).at_time(1e-5),
    ];
    comb.verify_at(&states).unwrap();
    comb.verify().unwrap();
}

/// The sun, a planet and its moon.
struct Moon;

#[lagrangian(coordinates = [x: [3], y: [3]], analysis)]
impl Moon {
    const MASSES: [f64; 3] = [1.989e30, 5.972e24, 7.348e22];

    #[point(mass = Self::MASSES)]
    fn bodies(&self, q: &Coordinates) -> [Vector2<f64>; 3] {
        [Vector2::new(q.x[0], q.y[0]), Vector2::new(q.x[1], q.y[1]), Vector2::new(q.x[2], q.y[2])]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let [sun, earth, moon] = self.bodies(q);
        let [a, b, c] = Self::MASSES;
        -6.674e-11
            * (a * b / (earth - sun).norm() + b * c / (moon - earth).norm() + a * c / (moon - sun).norm())
    }
}

#[test]
fn moons_have_a_certificate_where_they_are() {
    let states = [
        State::new([0.0, 1.496e11, 1.4998e11, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, -0.09, 2.978e4, 3.08e4]),
        State::new([4e8, 1.1e11, 1.101e11, -1e8, 1e11, 1.0037e11], [1.0, -2e4, -2.07e4, 3.0, 2.1e4, 2.17e4]),
    ];
    Moon.verify_at(&states).unwrap();
}

/// A point on a stiff spring.
struct Spring {
    k: f64,
}

#[lagrangian(coordinates = [x, y], analysis)]
impl Spring {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.k * (self.bob(q).norm() - 1.0).powi(2)
    }
}

#[test]
fn springs_of_any_stiffness_have_a_certificate() {
    for k in [1e-9, 1.0, 1e6, 1e9, 1e12, 1e15] {
        Spring { k }.verify().unwrap_or_else(|violation| panic!("k = {k:e}: {violation}"));
    }
}
