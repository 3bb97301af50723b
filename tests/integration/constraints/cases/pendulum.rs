//! S01, A01, S20: a pendulum in Cartesian coordinates, its rod as a constraint in several forms.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, between, close};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, drift, root, state_at};
use crate::support::reference::seed;

/// S01: x points down, and the rod has a unit gradient.
struct Pendulum {
    m: f64,
    l: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Pendulum {
    #[point(mass = self.m)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.m * G * q.x
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.l
    }
}

/// The same with the square of the length.
struct Squared {
    m: f64,
    l: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Squared {
    #[point(mass = self.m)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.m * G * q.x
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm_squared() - self.l.powi(2)
    }
}

const PENDULUM: Pendulum = Pendulum { m: 1.3, l: 0.7 };
const SQUARED: Squared = Squared { m: 1.3, l: 0.7 };

fn start() -> State<f64, 2> {
    let (sin, cos) = 1.0_f64.sin_cos();
    State::at_rest([0.7 * cos, 0.7 * sin])
}

/// Angle and rate, from straight down.
fn turn(state: &State<f64, 2>) -> [f64; 2] {
    let ([x, y], [vx, vy]) = (state.q, state.v);
    [y.atan2(x), (x * vy - y * vx) / (x * x + y * y)]
}

/// The state at t = 1 by elliptic functions.
fn swung() -> [f64; 4] {
    let reference = seed("S01");
    let (x, y, rate) = (reference.number("x(1)"), reference.number("y(1)"), reference.number("theta_d(1)"));
    [x, y, -rate * y, rate * x]
}

#[test]
fn states_agree_with_elliptic_functions() {
    both_follow(&PENDULUM, start(), [(1.0, swung())], EASY);
    both_follow(&SQUARED, start(), [(1.0, swung())], EASY);
    let reference = seed("S01");
    let expected = [reference.number("theta(1)"), reference.number("theta_d(1)")];
    all_close(turn(&state_at(&PENDULUM, start(), 1.0)), expected, EASY);
}

#[test]
fn fixed_steps_reach_the_same_state() {
    let mut jet = PENDULUM.stepper::<Jet<6>>(start());
    let mut rk4 = PENDULUM.stepper::<Rk4>(start());
    for _ in 0..1000 {
        jet.step(0.001, &[]).unwrap();
        rk4.step(0.001, &[]).unwrap();
    }
    all_close([jet.state().q, jet.state().v].concat(), swung(), EASY);
    all_close([rk4.state().q, rk4.state().v].concat(), swung(), EASY);
    let tension = seed("S01").number("tension(1)");
    close(jet.reactions(&[]).rod, -tension, EASY);
    close(rk4.reactions(&[]).rod, -tension, EASY);
}

#[test]
fn the_reaction_is_the_tension_for_a_unit_gradient() {
    let reference = seed("S01");
    let tension = reference.number("tension(1)");
    let mut motion = PENDULUM.simulate(start()).with_tolerance(TIGHT);
    motion.advance_to(1.0).unwrap();
    close(motion.reactions().rod, -tension, EASY);
    assert!(motion.reactions().are_unique());
    // The gradient of the square is twice the length.
    let mut squared = SQUARED.simulate(start()).with_tolerance(TIGHT);
    squared.advance_to(1.0).unwrap();
    close(squared.reactions().rod, -tension / 1.4, EASY);
    let [x, y, ..] = swung();
    let force = SQUARED.reaction_forces(squared.state()).unwrap().rod;
    all_close(force, [-tension * x / 0.7, -tension * y / 0.7], EASY);
}

#[test]
fn the_force_law_holds_at_every_state() {
    let mut motion = PENDULUM.simulate(start());
    for state in motion.every(0.05).take(40) {
        let state = state.unwrap();
        let [angle, rate] = turn(&state);
        let tension = 1.3 * (G * angle.cos() + 0.7 * rate * rate);
        close(PENDULUM.reactions(&state).unwrap().rod, -tension, CLOSED_FORM);
        close(SQUARED.reactions(&state).unwrap().rod, -tension / 1.4, CLOSED_FORM);
        assert_eq!(PENDULUM.reaction_power(&state).unwrap(), 0.0);
    }
}

#[test]
fn the_period_and_the_tension_at_the_bottom_agree() {
    let reference = seed("S01");
    let period = reference.number("period");
    let found = root(&PENDULUM, start(), 1.01 * period, |s| {
        let a = PENDULUM.accelerations(s).unwrap();
        (s.q[0] * s.v[1] - s.q[1] * s.v[0], s.q[0] * a[1] - s.q[1] * a[0])
    });
    close(found, period, EASY);
    let bottom = state_at(&PENDULUM, start(), period / 4.0);
    close(PENDULUM.reactions(&bottom).unwrap().rod, -reference.number("tension_bottom"), EASY);
}

#[test]
fn the_identities_hold() {
    let states = [0.0, 0.3, 1.1].map(|t| state_at(&PENDULUM, start(), t));
    bound!(PENDULUM, [true]).holds(states);
    bound!(SQUARED, [true]).holds(states);
    assert_eq!(Pendulum::CONSTRAINTS, ["rod"]);
}

/// A01, and S20 with a third coordinate and the plane of the motion given twice.
struct Benchmark;

#[lagrangian(coordinates = [x, y])]
impl Benchmark {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        q.x.powi(2) + q.y.powi(2) - 1.0
    }
}

struct Redundant;

#[lagrangian(coordinates = [x, y, z], allow(redundant))]
impl Redundant {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm_squared() - 1.0
    }

    #[holonomic]
    fn plane(&self, q: &Coordinates) -> [f64; 2] {
        [q.z, 2.0 * q.z]
    }
}

fn samples() -> impl Iterator<Item = (f64, [f64; 4])> + Clone {
    let samples = seed("A01").part("samples").elements();
    let rows: Vec<_> = samples
        .iter()
        .map(|sample| {
            // The reference counts the angle clockwise.
            let (x, y, rate) = (sample.number("x"), sample.number("y"), -sample.number("rate"));
            (sample.number("t"), [x, y, -rate * y, rate * x])
        })
        .collect();
    rows.into_iter()
}

#[test]
fn the_benchmark_pendulum_agrees_for_ten_seconds() {
    both_follow(&Benchmark, State::at_rest([-1.0, 0.0]), samples(), EASY);
    let period = seed("A01").number("period");
    let found = root(&Benchmark, State::at_rest([-1.0, 0.0]), 0.99 * period, |s| {
        let a = Benchmark.accelerations(s).unwrap();
        (s.q[0] * s.v[1] - s.q[1] * s.v[0], s.q[0] * a[1] - s.q[1] * a[0])
    });
    close(found, period, EASY);
}

#[test]
fn the_benchmark_pendulum_keeps_its_energy_and_reaches_the_largest_tension() {
    let mut motion = Benchmark.simulate(State::at_rest([-1.0, 0.0])).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.1, 100, |s| Benchmark.energy(s)), 1e-12);
    let reference = seed("A01");
    let bottom = state_at(&Benchmark, State::at_rest([-1.0, 0.0]), reference.number("period") / 4.0);
    // The gradient has the length 2.
    close(Benchmark.reactions(&bottom).unwrap().rod, -reference.number("max_tension_N") / 2.0, EASY);
}

#[test]
fn redundant_constraints_change_nothing() {
    let rows = samples().map(|(t, [x, y, vx, vy])| (t, [x, y, 0.0, vx, vy, 0.0]));
    both_follow(&Redundant, State::at_rest([-1.0, 0.0, 0.0]), rows, EASY);
    let state = state_at(&Redundant, State::at_rest([-1.0, 0.0, 0.0]), 1.0);
    let plain = State { t: state.t, q: [state.q[0], state.q[1]], v: [state.v[0], state.v[1]] };
    let reactions = Redundant.reactions(&state).unwrap();
    assert!(!reactions.are_unique());
    close(reactions.rod, Benchmark.reactions(&plain).unwrap().rod, CLOSED_FORM);
    all_close(reactions.plane, [0.0, 0.0], CLOSED_FORM);
    assert_eq!(Redundant::CONSTRAINTS, ["rod", "plane[0]", "plane[1]"]);
}
