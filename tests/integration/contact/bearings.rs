//! Friction whose normal force is the common size of several reactions: bearings, and beads on curves in
//! space.

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close, close_on};

/// A pendulum on a journal bearing: a pin of radius r turns in a hole, held by two constraints. A stop may be
/// in its way.
struct Journal {
    friction: f64,
    restitution: f64,
    stop: f64,
}

const MASS: f64 = 2.0;
const INERTIA: f64 = 0.1;
const LENGTH: f64 = 0.5;
const RADIUS: f64 = 0.1;
/// The position of a stop that no motion reaches.
const FAR: f64 = -10.0;

#[lagrangian(coordinates = [x, y, phi])]
impl Journal {
    #[point(mass = 2.0)]
    fn centre(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * 0.1 * v.phi.powi(2)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * self.centre(q).y
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> [f64; 2] {
        let centre = self.centre(q);
        [centre.x - 0.5 * q.phi.sin(), centre.y + 0.5 * q.phi.cos()]
    }

    #[unilateral(restitution = self.restitution)]
    fn stop(&self, q: &Coordinates) -> f64 {
        q.phi - self.stop
    }

    #[friction(coefficient = self.friction, normal = [pin])]
    fn slip(&self, v: &Velocities) -> f64 {
        0.1 * v.phi
    }
}

fn hanging(phi: f64) -> State<f64, 3> {
    State::at_rest([LENGTH * phi.sin(), -LENGTH * phi.cos(), phi])
}

/// Times and angles of the first turning points from 2 rad. The digits are those of the quadratic equation
/// for the reaction, solved by hand, and extrapolated midpoint steps with 22 digits in mpmath.
const TURNS: [[f64; 2]; 3] = [
    [0.9794239360470655, -1.5921139542639653],
    [1.8742654673596182, 1.3060042865400097],
    [2.7269144403089283, -1.0797843899737807],
];

#[test]
fn a_pendulum_on_a_journal_bearing_turns_where_it_should() {
    let journal = Journal { friction: 0.3, restitution: 0.5, stop: FAR };
    let mut motion = journal.simulate(hanging(2.0)).with_tolerance(TIGHT);
    for [time, angle] in TURNS {
        let turn = motion.advance_to_switch(10.0).unwrap().unwrap().state;
        all_close([turn.t, turn.q[2]], [time, angle], 1e-12);
    }
    // It sticks where the lever of its weight is below the radius of the circle of friction, l |sin φ| < μ r.
    let end = *motion.advance_to(100.0).unwrap();
    assert_eq!((end.v, motion.contacts().slip), ([0.0; 3], Contact::Sticks));
    let reactions = motion.reactions();
    close(reactions.pin[0].hypot(reactions.pin[1]), MASS * 9.81, 1e-12);
    assert!((LENGTH * end.q[2].sin()).abs() <= 0.3 * RADIUS, "{end:?}");
    // The friction costs the series no steps.
    assert!(motion.steps().accepted < 150, "{} steps", motion.steps().accepted);
}

#[test]
fn a_pendulum_on_a_journal_bearing_sticks_within_the_circle_of_friction() {
    let edge = (0.3 * RADIUS / LENGTH).asin();
    for (angle, state) in [(0.999 * edge, Contact::Sticks), (1.001 * edge, Contact::Slips)] {
        let journal = Journal { friction: 0.3, restitution: 0.5, stop: FAR };
        let mut motion = journal.simulate(hanging(angle));
        motion.advance_to(1e-6).unwrap();
        assert_eq!(motion.contacts().slip, state, "at {angle}");
    }
}

/// The impulse on the pin is m l Δω, so the friction of the impact takes μ r m l Δω.
#[test]
fn an_impact_has_friction_by_the_common_impulse() {
    let journal = Journal { friction: 0.3, restitution: 0.4, stop: -1.0 };
    let mut motion = journal.simulate(hanging(2.0)).with_tolerance(TIGHT);
    let strike = motion.advance_to_switch(10.0).unwrap().unwrap();
    close_on(1.0, strike.before.q[2], -1.0, 1e-13);
    let before = strike.before.v[2];
    close(strike.state.v[2], -0.4 * before, 1e-13);
    let change = strike.state.v[2] - before;
    let impulses = motion.impulses();
    close(impulses.pin[0].hypot(impulses.pin[1]), MASS * LENGTH * change, 1e-12);
    close(impulses.slip, -0.3 * MASS * LENGTH * change, 1e-12);
    close(impulses.stop, (INERTIA + MASS * LENGTH * LENGTH + RADIUS * 0.3 * MASS * LENGTH) * change, 1e-12);
}

/// S10: a bead on a rough helix, whose normal force is that of two constraints on it.
struct Helix {
    friction: f64,
    fixed: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Helix {
    #[point(mass = 2.0)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * self.bead(q).z
    }

    #[holonomic]
    fn cylinder(&self, q: &Coordinates) -> f64 {
        let bead = self.bead(q);
        bead.x * bead.x + bead.y * bead.y - 0.64
    }

    /// z = 0.24 θ.
    #[holonomic]
    fn thread(&self, q: &Coordinates) -> f64 {
        let bead = self.bead(q);
        let angle = bead.z / 0.24;
        bead.y * angle.cos() - bead.x * angle.sin()
    }

    #[friction(coefficient = self.friction, static_coefficient = self.fixed, normal = bead)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        ((q.x * v.y - q.y * v.x) / 0.8 + 0.3 * v.z) / 1.09_f64.sqrt()
    }
}

fn on_helix(angle: f64, rate: f64) -> State<f64, 3> {
    let (sin, cos) = angle.sin_cos();
    let speed = 0.8 * rate;
    State::new([0.8 * cos, 0.8 * sin, 0.24 * angle], [-speed * sin, speed * cos, 0.24 * rate])
}

#[test]
fn a_bead_climbs_a_rough_helix_and_slides_back() {
    let helix = Helix { friction: 0.2, fixed: 0.25 };
    let mut motion = helix.simulate(on_helix(0.1, 3.0)).with_tolerance(TIGHT);
    let top = motion.advance_to_switch(10.0).unwrap().unwrap().state;
    all_close([top.t, top.q[2] / 0.24], [0.5223053881546121, 0.8727044725184596], 1e-12);
    let speed = |state: &State<f64, 3>| state.v.iter().map(|v| v * v).sum::<f64>();
    let fast = motion.advance_to_event(move |state: &State<f64, 3>| speed(state) - 1.0, 10.0);
    close(fast.unwrap().unwrap().state.t - top.t, 1.0674417908685245, 1e-12);
    close(speed(motion.advance_to(40.0).unwrap()).sqrt(), 3.026659914408635, 1e-12);
}

#[test]
fn a_bead_stays_on_a_helix_as_steep_as_its_friction() {
    for (fixed, state) in [(0.3001, Contact::Sticks), (0.2999, Contact::Slips)] {
        let helix = Helix { friction: 0.2, fixed };
        let mut motion = helix.simulate(on_helix(0.1, 0.0));
        motion.advance_to(1e-3).unwrap();
        assert_eq!(motion.contacts().slip, state, "{fixed}");
        // A bead that slips has begun to move.
        let (force, error) = if fixed > 0.3 { (5.63776551481167, 1e-12) } else { (3.758510331, 1e-4) };
        close(motion.reactions().slip.abs(), force, error);
    }
}

/// Friction so strong that the load would grow with itself has no reaction, or two.
#[test]
fn friction_that_loads_itself_jams() {
    let jam = (INERTIA + MASS * LENGTH * LENGTH) / (RADIUS * MASS * LENGTH);
    let rate = State { v: [LENGTH, 0.0, 1.0], ..hanging(0.0) };
    let start = |friction: f64| {
        Journal { friction, restitution: 0.5, stop: FAR }.simulate(rate).advance_to(1e-6).copied()
    };
    assert!(start(0.99 * jam).is_ok());
    let error = start(1.01 * jam).unwrap_err();
    assert!(matches!(error.cause, Cause::NoReaction { name, .. } if name.as_str() == "slip"), "{error}");
}
