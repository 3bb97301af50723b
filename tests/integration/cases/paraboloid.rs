//! S11: a particle on a paraboloid in parabolic coordinates, with v = c eliminated.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, between, close, close_on};
use crate::support::motion::{TIGHT, drift, follows, state_at};
use crate::support::reference::seed;
use crate::support::sample::Samples;

/// r = u c, z = (u² − c²)/2.
struct Paraboloid {
    m: f64,
    c: f64,
    g: f64,
}

#[lagrangian(coordinates = [u, theta])]
impl Paraboloid {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let (u2, c2) = (q.u * q.u, self.c * self.c);
        self.m * ((u2 + c2) * v.u.powi(2) + u2 * c2 * v.theta.powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * self.g * (q.u.powi(2) - self.c.powi(2)) / 2.0
    }
}

/// The same particle by its Cartesian position.
struct Particle(Paraboloid);

#[lagrangian(coordinates = [u, theta])]
impl Particle {
    #[point(mass = self.0.m)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        let c = self.0.c;
        Vector3::new(q.u * c * q.theta.cos(), q.u * c * q.theta.sin(), (q.u * q.u - c * c) / 2.0)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.m * self.0.g * self.particle(q).z
    }
}

const PARABOLOID: Paraboloid = Paraboloid { m: 1.5, c: 0.9, g: G };
const PARTICLE: Particle = Particle(PARABOLOID);

fn start() -> State<f64, 2> {
    State::new([0.7, 0.0], [0.4, 2.5])
}

#[test]
fn the_states_agree_in_both_forms() {
    let reference = seed("S11").timed_rows::<4>("u_th_ud_thd");
    follows(&PARABOLOID, start(), reference.clone(), EASY);
    follows(&PARTICLE, start(), reference, EASY);
}

#[test]
fn energy_and_angular_momentum_have_the_given_values() {
    close(PARABOLOID.energy(&start()), seed("S11").number("E"), CLOSED_FORM);
    close(PARABOLOID.momenta(&start())[1], seed("S11").number("h"), CLOSED_FORM);
    close(PARTICLE.energy(&start()), seed("S11").number("E"), CLOSED_FORM);
    close(PARTICLE.momenta(&start())[1], seed("S11").number("h"), CLOSED_FORM);
}

#[test]
fn energy_and_angular_momentum_stay() {
    let run = |quantity: &dyn Fn(&State<f64, 2>) -> f64| {
        let mut motion = PARABOLOID.simulate(start()).with_tolerance(TIGHT);
        drift(&mut motion, 0.5, 200, quantity)
    };
    between(-1.0, run(&|s| PARABOLOID.energy(s)), 1e-11);
    between(-1.0, run(&|s| PARABOLOID.momenta(s)[1]), 1e-11);
}

#[test]
fn the_normal_force_follows_from_the_state() {
    let state = state_at(&PARABOLOID, start(), 1.0);
    let Paraboloid { m, c, g } = PARABOLOID;
    let ([u, _], [du, dtheta]) = (state.q, state.v);
    let force = m * c * (du * du + (u * dtheta).powi(2) + g) / (u * u + c * c).sqrt();
    close(force, seed("S11").number("normal_force(1)"), EASY);
}

#[test]
fn every_horizontal_circle_has_the_same_rate() {
    let rate = seed("S11").number("circular_orbit_rate_any_radius");
    for u in [0.1, 0.7, 5.0] {
        let circle = State::new([u, 0.3], [0.0, rate]);
        for a in [PARABOLOID.accelerations(&circle).unwrap(), PARTICLE.accelerations(&circle).unwrap()] {
            // Gravity and the centrifugal term, each g u/(u² + c²), cancel.
            close_on(G, a[0], 0.0, CLOSED_FORM);
            assert_eq!(a[1], 0.0);
        }
    }
}

#[test]
fn both_forms_are_the_same_system() {
    let mut samples = Samples::new(11);
    for _ in 0..20 {
        let state = samples.state(0.5, 2.0);
        let found = PARABOLOID.accelerations(&state).unwrap();
        all_close(found, PARTICLE.accelerations(&state).unwrap(), 1e-12);
        all_close(PARABOLOID.mass_matrix(&state).as_slice(), PARTICLE.mass_matrix(&state).as_slice(), 1e-12);
    }
}
