//! S13: a particle inside a hemisphere, with the angle from the upward vertical.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, between, close};
use crate::support::motion::{TIGHT, drift, follows, state_at};
use crate::support::reference::seed;

struct Hemisphere {
    m: f64,
    radius: f64,
    g: f64,
}

#[lagrangian(coordinates = [phi, theta])]
impl Hemisphere {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.m * self.radius.powi(2) * (v.phi.powi(2) + q.phi.sin().powi(2) * v.theta.powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * self.g * self.radius * q.phi.cos()
    }
}

/// The same particle by its Cartesian position.
struct Particle {
    m: f64,
    radius: f64,
    g: Vector3<f64>,
}

#[lagrangian(coordinates = [phi, theta])]
impl Particle {
    #[point(mass = self.m)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        let (sin, cos) = q.phi.sin_cos();
        self.radius * Vector3::new(sin * q.theta.cos(), sin * q.theta.sin(), cos)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.m * self.g.dot(&self.particle(q))
    }
}

const HEMISPHERE: Hemisphere = Hemisphere { m: 0.8, radius: 1.2, g: G };

fn particle() -> Particle {
    Particle { m: 0.8, radius: 1.2, g: Vector3::new(0.0, 0.0, -G) }
}

fn start() -> State<f64, 2> {
    State::new([2.2, 0.0], [0.5, 1.8])
}

#[test]
fn the_states_agree_in_both_forms() {
    let reference = seed("S13").timed_rows::<4>("ph_th_phd_thd");
    follows(&HEMISPHERE, start(), reference.clone(), EASY);
    follows(&particle(), start(), reference, EASY);
}

#[test]
fn energy_and_angular_momentum_have_the_given_values_and_stay() {
    let expected = [seed("S13").number("E"), seed("S13").number("Hz")];
    let quantities = |s: &State<f64, 2>| [HEMISPHERE.energy(s), HEMISPHERE.momenta(s)[1]];
    all_close(quantities(&start()), expected, CLOSED_FORM);
    let particle = particle();
    all_close([particle.energy(&start()), particle.momenta(&start())[1]], expected, CLOSED_FORM);
    for i in 0..2 {
        let mut motion = HEMISPHERE.simulate(start()).with_tolerance(TIGHT);
        between(-1.0, drift(&mut motion, 0.1, 200, |s| quantities(s)[i]), 1e-11);
    }
}

#[test]
fn the_normal_force_follows_from_the_state_and_from_the_energy() {
    let expected = seed("S13").number("N_radial(1)_correct");
    let state = state_at(&HEMISPHERE, start(), 1.0);
    let Hemisphere { m, radius, g } = HEMISPHERE;
    let ([phi, _], [dphi, dtheta]) = (state.q, state.v);
    let radial = m * g * phi.cos() - m * radius * (dphi.powi(2) + (phi.sin() * dtheta).powi(2));
    close(radial, expected, EASY);
    close(3.0 * m * g * phi.cos() - 2.0 * HEMISPHERE.energy(&state) / radius, expected, EASY);
}
