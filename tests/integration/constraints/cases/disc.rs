//! C10: a thin disc that rolls on a plane, by energies and as a body in space.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, G, MEDIUM};
use crate::support::close::{all_close, between, close};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, drift, state_at};
use crate::support::reference::classical;

/// Place of the contact, heading, lean to the right, spin.
struct Disc {
    m: f64,
    r: f64,
}

#[lagrangian(coordinates = [x, y, heading, lean, spin])]
impl Disc {
    #[point(mass = self.m)]
    fn centre(&self, q: &Coordinates) -> Vector3<f64> {
        let across = self.r * q.lean.sin();
        let (sin, cos) = q.heading.sin_cos();
        Vector3::new(q.x + across * sin, q.y - across * cos, self.r * q.lean.cos())
    }

    #[kinetic]
    fn rotation(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let (sin, cos) = q.lean.sin_cos();
        let across = self.m * self.r.powi(2) / 4.0;
        across * (v.lean.powi(2) + v.heading.powi(2) * cos.powi(2)) / 2.0
            + across * (v.spin + v.heading * sin).powi(2)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * self.r * q.lean.cos()
    }

    #[nonholonomic]
    fn rolling(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let (sin, cos) = q.heading.sin_cos();
        [v.x - self.r * v.spin * cos, v.y - self.r * v.spin * sin]
    }
}

/// Heading about the vertical, lean about the direction of motion, spin about the axle.
struct Body {
    m: f64,
    r: f64,
}

#[lagrangian(coordinates = [x, y, heading, lean, spin])]
impl Body {
    #[body(mass = self.m, inertia = self.m * self.r.powi(2) / 4.0 * Vector3::new(1.0, 2.0, 1.0))]
    fn disc(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let frame = Rotation3::from_axis_angle(&Vector3::z_axis(), q.heading)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.lean);
        let centre = Vector3::new(q.x, q.y, 0.0) + frame * Vector3::new(0.0, 0.0, self.r);
        (centre, frame * Rotation3::from_axis_angle(&Vector3::y_axis(), q.spin))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * self.disc(q).0.z
    }

    #[nonholonomic]
    fn rolling(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let (sin, cos) = q.heading.sin_cos();
        [v.x - self.r * v.spin * cos, v.y - self.r * v.spin * sin]
    }
}

const DISC: Disc = Disc { m: 1.0, r: 0.4 };
const BODY: Body = Body { m: 1.0, r: 0.4 };

fn start() -> State<f64, 5> {
    let numbers = classical("C10_rolling_disc").numbers::<10>("start");
    State::new(std::array::from_fn(|i| numbers[i]), std::array::from_fn(|i| numbers[5 + i]))
}

#[test]
fn accelerations_and_reactions_at_the_start_agree() {
    let reference = classical("C10_rolling_disc");
    let (a, lambda) = (reference.numbers::<5>("acc0"), reference.numbers::<2>("lam0"));
    all_close(DISC.accelerations(&start()).unwrap(), a, CLOSED_FORM);
    all_close(BODY.accelerations(&start()).unwrap(), a, CLOSED_FORM);
    all_close(DISC.reactions(&start()).unwrap().rolling, lambda, CLOSED_FORM);
    all_close(BODY.reactions(&start()).unwrap().rolling, lambda, CLOSED_FORM);
}

#[test]
fn the_states_agree() {
    let reference = classical("C10_rolling_disc");
    let rows = [1, 3].map(|t| (f64::from(t), reference.numbers::<10>(&format!("state({t})"))));
    both_follow(&DISC, start(), rows, MEDIUM);
    both_follow(&BODY, start(), rows, MEDIUM);
}

#[test]
fn the_published_equations_hold_along_the_motion() {
    let mut motion = DISC.simulate(start()).with_tolerance(TIGHT);
    for state in motion.every(0.3).take(10) {
        let state = state.unwrap();
        let ([.., lean, _], [_, _, turn, tilt, roll]) = (state.q, state.v);
        let [_, _, turn_rate, tilt_rate, roll_rate] = DISC.accelerations(&state).unwrap();
        let (sin, cos, tan) = (lean.sin(), lean.cos(), lean.tan());
        let r = DISC.r;
        let (u1, u2, u3) = (tilt, roll + turn * sin, turn * cos);
        let expected = [
            (6.0 * u2 * u3 * r - u3 * u3 * r * tan + 4.0 * G * sin) / (5.0 * r),
            -2.0 * u1 * u3 / 3.0,
            u1 * (u3 * tan - 2.0 * u2),
        ];
        let found =
            [tilt_rate, roll_rate + turn_rate * sin + turn * cos * tilt, turn_rate * cos - turn * sin * tilt];
        all_close(found, expected, 1e-11);
    }
}

#[test]
fn rolling_takes_no_energy() {
    let mut motion = DISC.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.1, 100, |s| DISC.energy(s)), 1e-11);
    close(DISC.energy(&start()), BODY.energy(&start()), CLOSED_FORM);
}

#[test]
fn the_identities_hold() {
    let states = [0.0, 0.8].map(|t| state_at(&DISC, start(), t));
    bound!(DISC, [false; 2]).holds(states);
    bound!(BODY, [false; 2]).holds(states);
}
