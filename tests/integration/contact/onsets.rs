//! Slips that begin where friction has reached its limit and keeps its size: their accelerations grow from
//! zero.

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{close, close_on};

/// A mass on a spring to a slider: the Jenkin element.
struct Jenkin {
    slider: f64,
}

#[lagrangian(coordinates = [x, s])]
impl Jenkin {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x + 0.5 * self.slider * v.s * v.s
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * 100.0 * (q.x - q.s).powi(2)
    }

    #[force(on = x)]
    fn drive(&self, t: f64) -> f64 {
        8.0 * (4.0 * t).sin()
    }

    #[friction(limit = 5.0)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.s
    }
}

/// Times at which the slider begins to slip and stops, in turns: the solutions of both linear systems, joined
/// in 30 digits.
const SWITCHES: [f64; 19] = [
    0.235_392_658_485_538_67,
    0.868_865_976_790_750_6,
    0.871_530_177_750_385_4,
    0.888_405_099_466_290_4,
    0.892_920_279_805_205,
    0.908_479_012_054_224,
    1.069_651_030_193_339_3,
    1.644_132_373_868_894_7,
    1.645_785_514_953_724,
    1.663_878_950_788_476_6,
    1.665_864_443_111_750_9,
    1.683_723_685_649_995_5,
    1.686_055_639_002_994_8,
    1.703_593_689_848_553_5,
    1.706_473_122_222_696_5,
    1.723_513_347_499_049,
    1.727_515_614_134_132_8,
    1.743_562_001_138_159_2,
    1.900_919_850_223_030_7,
];

#[test]
fn a_slider_slips_again_after_a_short_stick() {
    let element = Jenkin { slider: 1e-3 };
    let mut motion = element.simulate(State::at_rest([0.0, 0.0])).with_tolerance(TIGHT);
    for (number, time) in SWITCHES.into_iter().enumerate() {
        let switch = motion.advance_to_switch(2.0).unwrap().unwrap();
        close(switch.state.t, time, 1e-12);
        let now = if number % 2 == 0 { Contact::Slips } else { Contact::Sticks };
        assert_eq!(motion.contacts().slip, now, "switch {number}");
    }
    assert!(motion.advance_to_switch(2.0).unwrap().is_none());
    close(motion.state().q[0], -0.143_187_989_847_350_76, 1e-11);
    close(motion.state().q[1], -0.192_932_047_593_375_1, 1e-11);
}

#[test]
fn a_light_slider_slips_and_sticks_in_turns() {
    let element = Jenkin { slider: 1e-6 };
    let mut motion = element.simulate(State::at_rest([0.0, 0.0]));
    let mut switches = 0;
    while motion.advance_to_switch(2.0).unwrap().is_some() {
        switches += 1;
    }
    // With a slider without mass the spring would be at the limit. This slider has a mass, and the spring
    // swings below the limit.
    assert!(switches > 500 && switches % 2 == 1, "{switches} switches");
    let [x, s] = motion.state().q;
    close_on(0.05, x - s, 0.05, 0.01);
}

/// A disc on a rough floor.
struct Disc {
    friction: f64,
}

#[lagrangian(coordinates = [x, y, z, heading, lean, spin])]
impl Disc {
    #[body(mass = 0.4, inertia = [0.4 * 0.01 / 4.0, 0.4 * 0.01 / 2.0, 0.4 * 0.01 / 4.0])]
    fn disc(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let heading = Rotation3::from_axis_angle(&Vector3::z_axis(), q.heading);
        let up = heading * Rotation3::from_axis_angle(&Vector3::x_axis(), q.lean);
        (Vector3::new(q.x, q.y, q.z), up * Rotation3::from_axis_angle(&Vector3::y_axis(), q.spin))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.4 * 9.81 * q.z
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.z - 0.1 * q.lean.cos()
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let down =
            Vector3::new(q.heading.sin() * q.lean.sin(), -q.heading.cos() * q.lean.sin(), q.lean.cos());
        let speed = self.disc_velocity(q, v).at(Vector3::new(q.x, q.y, q.z) - 0.1 * down);
        Vector2::new(speed.x, speed.y)
    }
}

const DISC: Disc = Disc { friction: 0.1 };

fn thrown() -> State<f64, 6> {
    let height = 0.1 * 0.3_f64.cos();
    State::new([0.0, 0.0, height, 0.0, 0.3, 0.0], [0.5, 0.1, 0.0, 1.0, 0.0, 12.0])
}

#[test]
fn a_rolling_disc_begins_to_slip() {
    // Regularised friction, of ever less regularisation, goes this way.
    let reference = [-0.00255, -0.00028];
    for tolerance in [1e-8, 1e-10] {
        let mut motion = DISC.simulate(thrown()).with_tolerance(tolerance);
        for (time, now) in [(1.22336117518, Contact::Sticks), (1.23427662938, Contact::Slips)] {
            let switch = motion.advance_to_switch(3.0).unwrap().unwrap();
            close(switch.state.t, time, tolerance);
            assert_eq!(motion.contacts().slip, [now; 2]);
        }
        let end = *motion.advance_to(1.334276629).unwrap();
        let slip = DISC.slip(&end.q.into(), &end.v.into());
        for (slip, reference) in slip.iter().zip(reference) {
            close_on(1.0, *slip, reference, 5e-6);
        }
        // Friction at its limit acts against the slip.
        let (force, normal) = (motion.reactions().slip, motion.reactions().floor);
        for (force, slip_along) in force.iter().zip(&slip) {
            close_on(normal, *force, -0.1 * normal * slip_along / slip.norm(), 1e-6);
        }
    }
}

#[test]
fn a_limit_of_steps_ends_a_call_whatever_its_guards_cost() {
    // Fewer than the motion takes after its first slip.
    let mut motion = DISC.simulate(thrown()).with_tolerance(1e-12).with_max_steps(10);
    let error = loop {
        match motion.advance_to_switch(3.0) {
            Ok(Some(_)) => {}
            Ok(None) => panic!("the motion is too short for this test"),
            Err(error) => break error,
        }
    };
    assert_eq!(error.cause, Cause::TooManySteps);
}
