//! S07: a wheel that rolls upright on a plane and turns: rolling as two nonholonomic constraints.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, G, MEDIUM};
use crate::support::close::{all_close, close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, state_at};
use crate::support::reference::seed;

/// Mass, moments about the axle and about the vertical, radius.
#[derive(Clone, Copy)]
struct Rim {
    m: f64,
    axle: f64,
    vertical: f64,
    radius: f64,
}

/// The place of the contact, heading and spin.
struct Wheel(Rim);

#[lagrangian(coordinates = [x, y, heading, spin])]
impl Wheel {
    #[point(mass = self.0.m)]
    fn centre(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        (self.0.axle * v.spin.powi(2) + self.0.vertical * v.heading.powi(2)) / 2.0
    }

    #[nonholonomic]
    fn rolling(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let (sin, cos) = q.heading.sin_cos();
        [v.x + self.0.radius * v.spin * cos, v.y + self.0.radius * v.spin * sin]
    }
}

/// With the height of the centre, the ground as a constraint, and a motor on the axle.
struct Driven(Rim);

#[lagrangian(coordinates = [x, y, z, heading, spin], inputs = [torque])]
impl Driven {
    #[point(mass = self.0.m)]
    fn centre(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        (self.0.axle * v.spin.powi(2) + self.0.vertical * v.heading.powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.m * G * q.z
    }

    #[force(on = spin)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.torque
    }

    #[holonomic]
    fn ground(&self, q: &Coordinates) -> f64 {
        q.z - self.0.radius
    }

    #[nonholonomic]
    fn rolling(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let (sin, cos) = q.heading.sin_cos();
        [v.x + self.0.radius * v.spin * cos, v.y + self.0.radius * v.spin * sin]
    }
}

/// With the point of the rim that was at the ground at first: a place without mass, which the constraints
/// carry along.
struct Full(Rim);

#[lagrangian(coordinates = [x1, y1, z1, x2, y2, z2, heading, spin])]
impl Full {
    #[point(mass = self.0.m)]
    fn centre(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x1, q.y1, q.z1)
    }

    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        (self.0.axle * v.spin.powi(2) + self.0.vertical * v.heading.powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.m * G * q.z1
    }

    #[nonholonomic]
    fn rolling(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let (sin, cos) = q.heading.sin_cos();
        [v.x1 + self.0.radius * v.spin * cos, v.y1 + self.0.radius * v.spin * sin]
    }

    #[holonomic]
    fn rim(&self, q: &Coordinates) -> [f64; 3] {
        let (across, r) = (self.0.radius * q.spin.sin(), self.0.radius);
        [
            q.x2 - q.x1 - across * q.heading.cos(),
            q.y2 - q.y1 - across * q.heading.sin(),
            q.z2 - q.z1 + r * q.spin.cos(),
        ]
    }

    #[holonomic]
    fn ground(&self, q: &Coordinates) -> f64 {
        q.z1 - self.0.radius
    }
}

/// With a fixed heading rolling is integrable.
struct Straight(Rim);

#[lagrangian(coordinates = [x, spin], inputs = [torque], allow(integrable))]
impl Straight {
    #[point(mass = self.0.m)]
    fn centre(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        self.0.axle * v.spin.powi(2) / 2.0
    }

    #[force(on = spin)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.torque
    }

    #[nonholonomic]
    fn rolling(&self, v: &Velocities) -> f64 {
        v.x + self.0.radius * v.spin
    }
}

const RIM: Rim = Rim { m: 1.2, axle: 0.03, vertical: 0.016, radius: 0.25 };
const WHEEL: Wheel = Wheel(RIM);
const DRIVEN: Driven = Driven(RIM);
const FULL: Full = Full(RIM);

fn start() -> State<f64, 4> {
    State::new([0.0; 4], [-1.0, 0.0, 0.6, 4.0])
}

fn driven(state: &State<f64, 4>) -> State<f64, 5> {
    let ([x, y, heading, spin], [vx, vy, turn, roll]) = (state.q, state.v);
    State::new([x, y, RIM.radius, heading, spin], [vx, vy, 0.0, turn, roll]).at_time(state.t)
}

fn full(state: &State<f64, 4>) -> State<f64, 8> {
    let ([x, y, heading, spin], [vx, vy, turn, roll]) = (state.q, state.v);
    let ([x2, y2, z2], [vx2, vy2, vz2]) = rim_point(state);
    State::new([x, y, RIM.radius, x2, y2, z2, heading, spin], [vx, vy, 0.0, vx2, vy2, vz2, turn, roll])
        .at_time(state.t)
}

/// Place and velocity of the point of the rim that was at the ground at first.
fn rim_point(state: &State<f64, 4>) -> ([f64; 3], [f64; 3]) {
    let ([x, y, heading, spin], [vx, vy, turn, roll]) = (state.q, state.v);
    let (sin, cos) = heading.sin_cos();
    let (up, along) = spin.sin_cos();
    let r = RIM.radius;
    let place = [x + r * up * cos, y + r * up * sin, r - r * along];
    let velocity = [
        vx + r * (roll * along * cos - turn * up * sin),
        vy + r * (roll * along * sin + turn * up * cos),
        r * roll * up,
    ];
    (place, velocity)
}

#[test]
fn the_wheel_rolls_on_a_circle() {
    let reference = seed("S07");
    let (heading, spin) = (reference.number("theta(3)"), reference.number("phi(3)"));
    let (x, y) = (reference.number("x1(3)"), reference.number("y1(3)"));
    let row = [x, y, heading, spin, -heading.cos(), -heading.sin(), 0.6, 4.0];
    both_follow(&WHEEL, start(), [(3.0, row)], MEDIUM);
    let mut motion = WHEEL.simulate(start()).with_tolerance(TIGHT);
    let radius = reference.number("radius");
    for state in motion.every(0.1).take(100) {
        let state = state.unwrap();
        close(state.q[0].hypot(state.q[1] - -radius), radius, 1e-12);
        all_close([state.v[2], state.v[3]], [0.6, 4.0], 1e-13);
    }
    let (place, _) = rim_point(&state_at(&WHEEL, start(), 3.0));
    all_close(place, reference.numbers::<3>("P2(3)=(x2,y2,z2)"), MEDIUM);
}

#[test]
fn a_place_without_mass_is_carried_along() {
    let reference = seed("S07");
    let (heading, spin) = (reference.number("theta(3)"), reference.number("phi(3)"));
    let (x, y) = (reference.number("x1(3)"), reference.number("y1(3)"));
    let expected = full(&State::new([x, y, heading, spin], [-heading.cos(), -heading.sin(), 0.6, 4.0]));
    let row: [f64; 16] = std::array::from_fn(|i| if i < 8 { expected.q[i] } else { expected.v[i - 8] });
    both_follow(&FULL, full(&start()), [(3.0, row)], MEDIUM);
    let state = state_at(&FULL, full(&start()), 3.0);
    all_close(&state.q[3..6], reference.numbers::<3>("P2(3)=(x2,y2,z2)"), MEDIUM);
    let reactions = FULL.reactions(&state).unwrap();
    all_close(reactions.rolling, reference.numbers::<2>("multipliers(3)"), MEDIUM);
    close(reactions.ground, RIM.m * G, CLOSED_FORM);
    // Nothing pulls at the rim.
    for reaction in reactions.rim {
        close_on(RIM.m * G, reaction, 0.0, CLOSED_FORM);
    }
    assert!(reactions.are_unique());
}

#[test]
fn the_rim_does_not_slip_at_the_ground() {
    for turns in 1..4 {
        let time = f64::from(turns) * std::f64::consts::TAU / 4.0;
        let (place, velocity) = rim_point(&state_at(&WHEEL, start(), time));
        close_on(1.0, place[2], 0.0, 1e-12);
        for component in velocity {
            close_on(1.0, component, 0.0, 1e-12);
        }
    }
}

#[test]
fn rolling_and_the_ground_react() {
    let reference = seed("S07");
    let state = state_at(&WHEEL, start(), 3.0);
    let expected = reference.numbers::<2>("multipliers(3)");
    all_close(WHEEL.reactions(&state).unwrap().rolling, expected, MEDIUM);
    let reactions = DRIVEN.reactions(&driven(&state), &[0.0]).unwrap();
    all_close(reactions.rolling, expected, MEDIUM);
    close(reactions.ground, RIM.m * G, CLOSED_FORM);
}

#[test]
fn a_motor_drives_the_wheel() {
    let expected = seed("S07").number("fixed_heading_phi_dd(tau=0.5)");
    let still = State::new([0.0, 0.0, RIM.radius, 0.3, 0.0], [0.0; 5]);
    let [.., heading, spin] = DRIVEN.accelerations(&still, &[0.5]).unwrap();
    close(spin, expected, CLOSED_FORM);
    assert_eq!(heading, 0.0);
    let straight = Straight(RIM);
    close(straight.accelerations(&State::at_rest([0.0; 2]), &[0.5]).unwrap()[1], expected, CLOSED_FORM);
    let mut motion = straight.simulate(State::at_rest([0.0; 2])).with_inputs([0.5]).with_tolerance(TIGHT);
    let state = motion.advance_to(2.0).unwrap();
    all_close(state.q, [-RIM.radius * 2.0 * expected, 2.0 * expected], CLOSED_FORM);
    // The force of the ground on the wheel: m x″ along the path.
    close(motion.reactions().rolling, -RIM.m * RIM.radius * expected, CLOSED_FORM);
}

#[test]
fn the_identities_hold() {
    let states = [0.0, 1.3].map(|t| state_at(&WHEEL, start(), t));
    bound!(WHEEL, [false; 2]).holds(states);
    bound!(DRIVEN, [true, false, false], inputs = [0.3]).holds(states.map(|state| driven(&state)));
    bound!(FULL, [false, false, true, true, true, true]).holds(states.map(|state| full(&state)));
    assert_eq!(Driven::CONSTRAINTS, ["ground", "rolling[0]", "rolling[1]"]);
}
