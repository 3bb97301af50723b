//! C13: the acrobot, two planar bodies with friction in the joints and a motor at the elbow.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, all_close_on_largest, close};
use crate::support::difference::{STEP, derivative, eigenvalues, state_matrix};
use crate::support::motion::{TIGHT, numbers};
use crate::support::reference::classical;
use crate::support::sample::Samples;

/// A link: mass, length, distance of the centre of mass, inertia about it, and friction of its joint.
#[derive(Clone, Copy)]
struct Link {
    mass: f64,
    length: f64,
    centre: f64,
    inertia: f64,
    friction: f64,
}

/// Poses as isometries; angles from straight down, the second one relative.
struct Acrobot {
    links: [Link; 2],
    g: f64,
}

#[lagrangian(coordinates = [shoulder, elbow], inputs = [motor])]
impl Acrobot {
    #[body(mass = self.links[0].mass, inertia = self.links[0].inertia)]
    fn upper(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.shoulder.sin(), -q.shoulder.cos()) * self.links[0].centre, q.shoulder)
    }

    #[body(mass = self.links[1].mass, inertia = self.links[1].inertia)]
    fn lower(&self, q: &Coordinates) -> Isometry2<f64> {
        let turn = q.shoulder + q.elbow;
        let joint = Vector2::new(q.shoulder.sin(), -q.shoulder.cos()) * self.links[0].length;
        Isometry2::new(joint + Vector2::new(turn.sin(), -turn.cos()) * self.links[1].centre, turn)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let upper = self.links[0].mass * self.upper(q).translation.vector.y;
        self.g * (upper + self.links[1].mass * self.lower(q).translation.vector.y)
    }

    #[dissipation]
    fn friction(&self, v: &Velocities) -> f64 {
        0.5 * (self.links[0].friction * v.shoulder.powi(2) + self.links[1].friction * v.elbow.powi(2))
    }

    #[force(on = elbow)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.motor
    }
}

/// Poses as pairs of position and angle; the motor as a pair of torques on the two bodies.
struct ByPairs {
    links: [Link; 2],
    g: f64,
}

#[lagrangian(coordinates = [shoulder, elbow], inputs = [motor])]
impl ByPairs {
    fn direction(angle: f64) -> Vector2<f64> {
        let (sin, cos) = angle.sin_cos();
        Vector2::new(sin, -cos)
    }

    #[body(mass = self.links[0].mass, inertia = self.links[0].inertia)]
    fn upper(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (self.links[0].centre * Self::direction(q.shoulder), q.shoulder)
    }

    #[body(mass = self.links[1].mass, inertia = self.links[1].inertia)]
    fn lower(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let turn = q.shoulder + q.elbow;
        let joint = self.links[0].length * Self::direction(q.shoulder);
        (joint + self.links[1].centre * Self::direction(turn), turn)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (self.links[0].mass * self.upper(q).0.y + self.links[1].mass * self.lower(q).0.y)
    }

    #[dissipation]
    fn friction(&self, v: &Velocities) -> f64 {
        let rates = [v.shoulder, v.elbow];
        rates.iter().enumerate().map(|(i, rate)| 0.5 * self.links[i].friction * rate * rate).sum()
    }

    #[force(at = lower)]
    fn motor(&self, u: &Inputs) -> (Vector2<f64>, f64) {
        (Vector2::zeros(), u.motor)
    }

    #[force(at = upper)]
    fn reaction(&self, u: &Inputs) -> (Vector2<f64>, f64) {
        (Vector2::zeros(), -u.motor)
    }
}

const LINKS: [Link; 2] = [
    Link { mass: 1.0, length: 1.0, centre: 0.5, inertia: 0.083, friction: 0.1 },
    Link { mass: 1.0, length: 2.0, centre: 1.0, inertia: 0.33, friction: 0.1 },
];
const ACROBOT: Acrobot = Acrobot { links: LINKS, g: G };
const PAIRS: ByPairs = ByPairs { links: LINKS, g: G };

fn upright() -> State<f64, 2> {
    State::at_rest([std::f64::consts::PI, 0.0])
}

#[test]
fn the_accelerations_agree() {
    let state = State::new([0.3, -0.7], [0.4, 1.1]);
    let expected = classical("C13_acrobot").numbers::<2>("acc_at_(0.3,-0.7,0.4,1.1)_tau=1");
    all_close(ACROBOT.accelerations(&state, &[1.0]).unwrap(), expected, CLOSED_FORM);
    all_close(PAIRS.accelerations(&state, &[1.0]).unwrap(), expected, CLOSED_FORM);
}

#[test]
fn the_free_motion_agrees() {
    let reference = classical("C13_acrobot");
    let mut motion = ACROBOT.simulate(State::at_rest([1.0, 1.0])).with_tolerance(TIGHT);
    let mut pairs = PAIRS.simulate(State::at_rest([1.0, 1.0])).with_tolerance(TIGHT).with_inputs([0.0]);
    for t in [1, 5, 10] {
        let expected = reference.numbers::<4>(&format!("free_state({t})"));
        all_close(numbers(motion.advance_to(f64::from(t)).unwrap()), expected, EASY);
        all_close(numbers(pairs.advance_to(f64::from(t)).unwrap()), expected, EASY);
    }
}

#[test]
fn the_linearisation_about_upright_agrees() {
    let reference = classical("C13_acrobot");
    let matrix = state_matrix(STEP, &upright(), |s| ACROBOT.accelerations(s, &[0.0]).unwrap());
    for (row, expected) in reference.rows::<4>("A_lower").into_iter().enumerate() {
        let found: [f64; 4] = std::array::from_fn(|column| matrix[(2 + row, column)]);
        all_close(found, expected, CLOSED_FORM);
    }
    let expected = reference.rows::<2>("eig_upright");
    for (found, [re, im]) in eigenvalues(&matrix).iter().zip(expected) {
        all_close_on_largest([found.re, found.im], [re, im], CLOSED_FORM);
    }
    let inputs = derivative(1.0, |u| ACROBOT.accelerations(&upright(), &[u]).unwrap());
    all_close(inputs, reference.numbers::<2>("B_lower"), CLOSED_FORM);
}

#[test]
fn friction_and_motor_are_the_applied_forces() {
    let state = State::new([0.3, -0.7], [0.4, 1.1]);
    all_close(ACROBOT.applied_forces(&state, &[2.0]), [-0.04, 2.0 - 0.11], CLOSED_FORM);
    close(ACROBOT.power(&state, &[2.0]), -0.04 * 0.4 + 1.89 * 1.1, CLOSED_FORM);
}

#[test]
fn both_forms_are_the_same_system() {
    let mut samples = Samples::new(13);
    for _ in 0..20 {
        let state = samples.state(-3.0, 3.0);
        let u = [samples.number(-2.0, 2.0)];
        let found = ACROBOT.accelerations(&state, &u).unwrap();
        all_close(found, PAIRS.accelerations(&state, &u).unwrap(), 1e-12);
        all_close(ACROBOT.applied_forces(&state, &u), PAIRS.applied_forces(&state, &u), 1e-12);
        all_close(ACROBOT.mass_matrix(&state).as_slice(), PAIRS.mass_matrix(&state).as_slice(), 1e-13);
        close(ACROBOT.energy(&state), PAIRS.energy(&state), 1e-13);
    }
}
