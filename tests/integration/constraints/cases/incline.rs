//! S04: a mass on a smooth incline with a spring along it; the line is the constraint.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, close, close_on};
use crate::support::constrained::bound;
use crate::support::difference::{STEP, slope};
use crate::support::motion::{TIGHT, both_follow};
use crate::support::reference::seed;

/// x is horizontal, y points up; the incline falls from the origin, where the spring is fastened.
struct Incline {
    m: f64,
    k: f64,
    angle: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Incline {
    #[point(mass = self.m)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring_and_gravity(&self, q: &Coordinates) -> f64 {
        self.k * (q.x.powi(2) + q.y.powi(2)) / 2.0 + self.m * G * q.y
    }

    #[holonomic]
    fn plane(&self, q: &Coordinates) -> f64 {
        q.x * self.angle.sin() + q.y * self.angle.cos()
    }
}

const INCLINE: Incline = Incline { m: 2.0, k: 50.0, angle: std::f64::consts::FRAC_PI_6 };

/// A state at a distance along the incline, with a speed along it.
fn along(distance: f64, speed: f64) -> State<f64, 2> {
    let (sin, cos) = INCLINE.angle.sin_cos();
    State::new([distance * cos, -distance * sin], [speed * cos, -speed * sin])
}

fn acceleration(distance: f64) -> f64 {
    let a = INCLINE.accelerations(&along(distance, 0.0)).unwrap();
    let (sin, cos) = INCLINE.angle.sin_cos();
    a[0] * cos - a[1] * sin
}

#[test]
fn the_equilibrium_and_its_frequency_agree() {
    let reference = seed("S04");
    let place = reference.number("q_eq");
    close_on(G, acceleration(place), 0.0, CLOSED_FORM);
    let stiffness = -slope(STEP, |x| acceleration(place + x));
    close(stiffness.sqrt(), reference.number("omega"), CLOSED_FORM);
}

#[test]
fn the_normal_force_is_the_reaction_everywhere() {
    let expected = seed("S04").number("normal_force");
    close(INCLINE.reactions(&along(seed("S04").number("q_eq"), 0.0)).unwrap().plane, expected, CLOSED_FORM);
    let mut motion = INCLINE.simulate(along(0.5, -1.0)).with_tolerance(TIGHT);
    for k in 1..10 {
        motion.advance_to(0.3 * f64::from(k)).unwrap();
        close(motion.reactions().plane, expected, CLOSED_FORM);
    }
}

#[test]
fn the_mass_swings_about_the_equilibrium() {
    let reference = seed("S04");
    let (place, omega) = (reference.number("q_eq"), reference.number("omega"));
    let rows = [0.7, 3.0].map(|t| {
        let (sin, cos) = (omega * t).sin_cos();
        let state = along(place + 0.3 * cos + 0.2 * sin, omega * (0.2 * cos - 0.3 * sin));
        (t, [state.q[0], state.q[1], state.v[0], state.v[1]])
    });
    both_follow(&INCLINE, along(place + 0.3, 0.2 * omega), rows, EASY);
}

#[test]
fn the_identities_hold() {
    bound!(INCLINE, [true]).holds([along(0.4, 0.7), along(-0.2, 2.0)]);
    let (sin, cos) = INCLINE.angle.sin_cos();
    all_close(INCLINE.constraint_jacobian(&along(0.4, 0.7)).as_slice(), [sin, cos], CLOSED_FORM);
}
