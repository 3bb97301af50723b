//! S11: a particle on a paraboloid, in parabolic coordinates with v = c as a constraint, and in Cartesian
//! ones.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{between, close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, drift, state_at};
use crate::support::reference::seed;

/// r = u v, z = (u² − v²)/2.
struct Parabolic {
    m: f64,
    c: f64,
}

#[lagrangian(coordinates = [u, v, theta])]
impl Parabolic {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, rate: &Velocities) -> f64 {
        let (u2, v2) = (q.u * q.u, q.v * q.v);
        self.m * ((u2 + v2) * (rate.u.powi(2) + rate.v.powi(2)) + u2 * v2 * rate.theta.powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * (q.u.powi(2) - q.v.powi(2)) / 2.0
    }

    #[holonomic]
    fn surface(&self, q: &Coordinates) -> f64 {
        q.v - self.c
    }
}

struct Cartesian {
    m: f64,
    c: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Cartesian {
    #[point(mass = self.m)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * q.z
    }

    #[holonomic]
    fn surface(&self, q: &Coordinates) -> f64 {
        let c2 = self.c.powi(2);
        q.x.powi(2) + q.y.powi(2) - c2 * (2.0 * q.z + c2)
    }
}

const C: f64 = 0.9;
const PARABOLIC: Parabolic = Parabolic { m: 1.5, c: C };
const CARTESIAN: Cartesian = Cartesian { m: 1.5, c: C };

fn start() -> State<f64, 3> {
    parabolic([0.7, 0.0, 0.4, 2.5])
}

fn parabolic([u, theta, du, dtheta]: [f64; 4]) -> State<f64, 3> {
    State::new([u, C, theta], [du, 0.0, dtheta])
}

fn cartesian([u, theta, du, dtheta]: [f64; 4]) -> State<f64, 3> {
    let (sin, cos) = theta.sin_cos();
    let (r, dr) = (u * C, du * C);
    State::new(
        [r * cos, r * sin, (u * u - C * C) / 2.0],
        [dr * cos - r * dtheta * sin, dr * sin + r * dtheta * cos, u * du],
    )
}

fn row(state: State<f64, 3>) -> [f64; 6] {
    let ([a, b, c], [d, e, f]) = (state.q, state.v);
    [a, b, c, d, e, f]
}

#[test]
fn the_states_agree_in_both_forms() {
    let rows = seed("S11").timed_rows::<4>("u_th_ud_thd");
    both_follow(&PARABOLIC, start(), rows.iter().map(|&(t, x)| (t, row(parabolic(x)))), EASY);
    let begin = cartesian([0.7, 0.0, 0.4, 2.5]);
    both_follow(&CARTESIAN, begin, rows.iter().map(|&(t, x)| (t, row(cartesian(x)))), EASY);
}

#[test]
fn energy_and_angular_momentum_stay_at_the_given_values() {
    let (energy, momentum) = (seed("S11").number("E"), seed("S11").number("h"));
    close(PARABOLIC.energy(&start()), energy, CLOSED_FORM);
    close(PARABOLIC.momenta(&start())[2], momentum, CLOSED_FORM);
    let begin = cartesian([0.7, 0.0, 0.4, 2.5]);
    let about_z = |s: &State<f64, 3>| CARTESIAN.m * (s.q[0] * s.v[1] - s.q[1] * s.v[0]);
    close(CARTESIAN.energy(&begin), energy, CLOSED_FORM);
    close(about_z(&begin), momentum, CLOSED_FORM);
    let run = |quantity: &dyn Fn(&State<f64, 3>) -> f64| {
        drift(&mut PARABOLIC.simulate(start()).with_tolerance(TIGHT), 0.5, 200, quantity)
    };
    between(-1.0, run(&|s| PARABOLIC.energy(s)), 1e-11);
    between(-1.0, run(&|s| PARABOLIC.momenta(s)[2]), 1e-11);
    let run = |quantity: &dyn Fn(&State<f64, 3>) -> f64| {
        drift(&mut CARTESIAN.simulate(begin).with_tolerance(TIGHT), 0.5, 200, quantity)
    };
    between(-1.0, run(&|s| CARTESIAN.energy(s)), 1e-11);
    between(-1.0, run(&about_z), 1e-11);
}

#[test]
fn the_normal_force_agrees() {
    let expected = seed("S11").number("normal_force(1)");
    let mut motion = PARABOLIC.simulate(start()).with_tolerance(TIGHT);
    motion.advance_to(1.0).unwrap();
    let size = motion.state().q[0].hypot(C);
    close(motion.reactions().surface, -expected * size, EASY);
    for state in motion.every(0.2).take(20) {
        let state = state.unwrap();
        let ([u, ..], [du, _, dtheta]) = (state.q, state.v);
        let Parabolic { m, c } = PARABOLIC;
        let force = -(m * du * du * c + m * u * u * c * dtheta * dtheta + m * G * c);
        close(PARABOLIC.reactions(&state).unwrap().surface, force, CLOSED_FORM);
    }
    // The particle presses outward, the paraboloid pushes inward, against the gradient.
    let state = state_at(&CARTESIAN, cartesian([0.7, 0.0, 0.4, 2.5]), 1.0);
    let [x, y, _] = state.q;
    let gradient = 2.0 * x.hypot(y).hypot(C * C);
    close(CARTESIAN.reactions(&state).unwrap().surface, -expected / gradient, EASY);
}

#[test]
fn every_horizontal_circle_has_the_same_rate() {
    let rate = seed("S11").number("circular_orbit_rate_any_radius");
    for u in [0.1, 0.7, 5.0] {
        let a = PARABOLIC.accelerations(&parabolic([u, 0.3, 0.0, rate])).unwrap();
        for a in a {
            close_on(G, a, 0.0, CLOSED_FORM);
        }
        let circle = cartesian([u, 0.3, 0.0, rate]);
        let [ax, ay, az] = CARTESIAN.accelerations(&circle).unwrap();
        let [x, y, _] = circle.q;
        close_on(G, az, 0.0, CLOSED_FORM);
        // Towards the axis, and no more than that.
        close_on(G * u.max(1.0), ax, -rate * rate * x, CLOSED_FORM);
        close_on(G * u.max(1.0), ay, -rate * rate * y, CLOSED_FORM);
    }
}

#[test]
fn the_identities_hold() {
    bound!(PARABOLIC, [true]).holds([start(), parabolic([1.1, 0.3, -0.7, 2.0])]);
    bound!(CARTESIAN, [true]).holds([cartesian([0.7, 0.1, 0.4, 2.5]), cartesian([1.1, 0.3, -0.7, 2.0])]);
}
