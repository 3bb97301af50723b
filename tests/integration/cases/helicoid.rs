//! S12a: a particle on a smooth helicoid z = α θ.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY, G};
use crate::support::close::{between, close};
use crate::support::difference::{STEP, rate};
use crate::support::motion::{TIGHT, drift, follows};
use crate::support::reference::seed;

struct Helicoid {
    m: f64,
    alpha: f64,
    g: f64,
}

#[lagrangian(coordinates = [theta, r])]
impl Helicoid {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.m * (v.r * v.r + (q.r * q.r + self.alpha * self.alpha) * v.theta * v.theta) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * self.g * self.alpha * q.theta
    }
}

/// The same particle by its Cartesian position.
struct Particle {
    m: f64,
    alpha: f64,
}

#[lagrangian(coordinates = [theta, r])]
impl Particle {
    #[point(mass = self.m)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.r * q.theta.cos(), q.r * q.theta.sin(), self.alpha * q.theta)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * self.particle(q).z
    }
}

const HELICOID: Helicoid = Helicoid { m: 2.0, alpha: 0.4, g: G };
const PARTICLE: Particle = Particle { m: 2.0, alpha: 0.4 };

fn start() -> State<f64, 2> {
    State::new([0.0, 0.5], [1.5, 0.2])
}

#[test]
fn the_states_agree_in_both_forms() {
    let reference = seed("S12a_smooth").timed_rows::<4>("th_r_thd_rd");
    follows(&HELICOID, start(), reference.clone(), EASY);
    follows(&PARTICLE, start(), reference, EASY);
}

#[test]
fn gravity_changes_the_generalized_momentum_at_a_constant_rate() {
    let Helicoid { m, alpha, g } = HELICOID;
    let mut motion = HELICOID.simulate(start()).with_tolerance(TIGHT);
    let first = HELICOID.momenta(motion.state())[0];
    for t in [0.5, 1.0, 2.0, 5.0] {
        motion.advance_to(t).unwrap();
        close(HELICOID.momenta(motion.state())[0], first - m * g * alpha * t, EASY);
    }
}

#[test]
fn the_axial_angular_momentum_is_not_conserved() {
    let a = HELICOID.accelerations(&start()).unwrap();
    let torque = rate(STEP, &start(), &a, |s| HELICOID.m * s.q[1].powi(2) * s.v[0]);
    // 2 m r r′ θ′ + m r² θ″ with θ″ = −(g α + 2 r r′ θ′)/(r² + α²).
    let expected = 0.6 - 0.5 * (G * 0.4 + 0.3) / 0.41;
    close(torque, expected, CLOSED_FORM);
}

#[test]
fn the_energy_is_conserved() {
    let mut motion = HELICOID.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.1, 50, |s| HELICOID.energy(s)), 1e-11);
}
