//! Machines with dry friction: a slider-crank through its dead centres, an arm with stops and rough joints,
//! and a friction that is switched off.

use core::f64::consts::PI;

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

/// Lengths of crank and rod \[m], and the limit of the friction in the guide \[N].
const CRANK: f64 = 0.3;
const ROD: f64 = 0.8;
const DRAG: f64 = 2.5;

/// A slider-crank in a horizontal plane, by the angles of crank and rod and the place of the slider.
struct Mechanism;

#[lagrangian(coordinates = [crank, rod, x, y])]
impl Mechanism {
    #[body(mass = 1.5, inertia = 1.5 * CRANK * CRANK / 12.0)]
    fn first(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(0.5 * CRANK * Vector2::new(q.crank.cos(), q.crank.sin()), q.crank)
    }

    #[body(mass = 0.7, inertia = 0.7 * ROD * ROD / 12.0)]
    fn second(&self, q: &Coordinates) -> Isometry2<f64> {
        let pin = CRANK * Vector2::new(q.crank.cos(), q.crank.sin());
        Isometry2::new(pin + 0.5 * ROD * Vector2::new(q.rod.cos(), q.rod.sin()), q.rod)
    }

    #[point(mass = 1.2)]
    fn slider(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> [f64; 2] {
        let end = self.second(q) * Point2::new(0.5 * ROD, 0.0);
        [end.x - q.x, end.y - q.y]
    }

    #[holonomic]
    fn guide(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(limit = DRAG)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

/// The same by the angle of the crank alone. The slip has no gradient in a dead centre.
struct Reduced;

#[lagrangian(coordinates = [crank])]
impl Reduced {
    #[point(mass = 1.2)]
    fn slider(&self, q: &Coordinates) -> Vector2<f64> {
        let up = CRANK * q.crank.sin();
        Vector2::new(CRANK * q.crank.cos() + (ROD * ROD - up * up).sqrt(), 0.0)
    }

    #[kinetic]
    fn wheel(&self, v: &Velocities) -> f64 {
        0.5 * 0.4 * v.crank.powi(2)
    }

    #[friction(limit = DRAG)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.slider_velocity(q, v).x
    }
}

/// The place of the slider at an angle of the crank.
fn place(angle: f64) -> f64 {
    let up = CRANK * angle.sin();
    CRANK * angle.cos() + (ROD * ROD - up * up).sqrt()
}

/// The way of the slider while the crank turns from one angle in the first half turn to another.
fn way(from: f64, to: f64) -> f64 {
    let turns = (to / PI).floor();
    if turns < 1.0 {
        return place(from) - place(to);
    }
    let first = place(from) - place(PI);
    first + (turns - 1.0) * 2.0 * CRANK + (place(to) - place(turns * PI)).abs()
}

/// Friction of a given size takes its size times the way. In a dead centre the slider stands still, and yet
/// friction cannot hold it: it is not the slider that the crank must turn there.
#[test]
fn a_crank_turns_through_its_dead_centres() {
    let (angle, speed): (f64, f64) = (1.0, 20.0);
    let rod = -(CRANK * angle.sin() / ROD).asin();
    let turning = -CRANK * angle.cos() * speed / (ROD * rod.cos());
    let sliding = -CRANK * angle.sin() * speed - ROD * rod.sin() * turning;
    let start = State::new([angle, rod, place(angle), 0.0], [speed, turning, sliding, 0.0]);
    let mut motion = Mechanism.simulate(start).with_tolerance(TIGHT);
    let before = Mechanism.energy(&start);
    let mut last = angle;
    for t in [0.05, 0.2, 0.5, 1.0] {
        let end = *motion.advance_to(t).unwrap();
        close(Mechanism.energy(&end), before - DRAG * way(angle, end.q[0]), 1e-12);
        assert!(end.q[0] > last);
        last = end.q[0];
    }
    assert!(last > 4.0 * PI, "{last}");

    let start = State::new([angle], [speed]);
    let mut motion = Reduced.simulate(start).with_tolerance(TIGHT);
    let before = Reduced.energy(&start);
    // It comes to rest after some turns.
    for t in [0.1, 0.5, 1.0, 3.0, 30.0] {
        let end = *motion.advance_to(t).unwrap();
        close_on(before, Reduced.energy(&end), before - DRAG * way(angle, end.q[0]), 1e-11);
        last = end.q[0];
    }
    assert_eq!(motion.state().v, [0.0]);
    assert!(last > 4.0 * PI, "{last}");
}

/// Two links that hang, with stops and dry friction in both joints and drives that saturate.
struct Arm {
    mass: [f64; 2],
    length: [f64; 2],
    low: [f64; 2],
    high: [f64; 2],
    restitution: f64,
    dry: [f64; 2],
    gain: [f64; 2],
    most: [f64; 2],
    swing: [f64; 2],
}

#[lagrangian(coordinates = [joint: [2]])]
impl Arm {
    #[body(mass = self.mass[0], inertia = self.mass[0] * self.length[0] * self.length[0] / 12.0)]
    fn upper(&self, q: &Coordinates) -> Isometry2<f64> {
        let along = Vector2::new(q.joint[0].sin(), -q.joint[0].cos());
        Isometry2::new(0.5 * self.length[0] * along, q.joint[0])
    }

    #[body(mass = self.mass[1], inertia = self.mass[1] * self.length[1] * self.length[1] / 12.0)]
    fn lower(&self, q: &Coordinates) -> Isometry2<f64> {
        let angle = q.joint[0] + q.joint[1];
        let elbow = self.length[0] * Vector2::new(q.joint[0].sin(), -q.joint[0].cos());
        Isometry2::new(elbow + 0.5 * self.length[1] * Vector2::new(angle.sin(), -angle.cos()), angle)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        let heights = [self.upper(q).translation.vector.y, self.lower(q).translation.vector.y];
        9.81 * (self.mass[0] * heights[0] + self.mass[1] * heights[1])
    }

    #[unilateral(restitution = self.restitution)]
    fn above(&self, q: &Coordinates) -> [f64; 2] {
        [q.joint[0] - self.low[0], q.joint[1] - self.low[1]]
    }

    #[unilateral(restitution = self.restitution)]
    fn below(&self, q: &Coordinates) -> [f64; 2] {
        [self.high[0] - q.joint[0], self.high[1] - q.joint[1]]
    }

    #[friction(limit = self.dry[0])]
    fn shoulder(&self, v: &Velocities) -> f64 {
        v.joint[0]
    }

    #[friction(limit = self.dry[1])]
    fn elbow(&self, v: &Velocities) -> f64 {
        v.joint[1]
    }

    #[force]
    fn drive(&self, q: &Coordinates, v: &Velocities, t: f64) -> [f64; 2] {
        let wanted = self.swing[0] * (self.swing[1] * t).sin();
        let torque = |i: usize| {
            let asked = self.gain[0] * (wanted - q.joint[i]) - self.gain[1] * v.joint[i];
            asked.clamp(-self.most[i], self.most[i])
        };
        [torque(0), torque(1)]
    }
}

/// Joints come to rest at their stops, stick there, and are pulled off again at a time that is rounded. A
/// third of the frictions have the limit zero.
#[test]
fn arms_with_stops_and_rough_joints_go_on() {
    let mut sticks = 0;
    for number in (0..16).chain([64, 110, 114]) {
        let mut random = Samples::new(number);
        let mut pick = |low: f64, high: f64| random.number(low, high);
        let often = |unit: f64, most: f64| (3.0 * unit - 1.0).clamp(0.0, 1.0) * most;
        let arm = Arm {
            mass: [pick(0.5, 3.0), pick(0.5, 3.0)],
            length: [pick(0.3, 1.0), pick(0.3, 1.0)],
            low: [pick(-2.0, -0.5), pick(-2.0, -0.2)],
            high: [pick(0.5, 2.0), pick(0.2, 2.5)],
            restitution: often(pick(0.0, 1.0), 0.9),
            dry: [often(pick(0.0, 1.0), 3.0), often(pick(0.0, 1.0), 3.0)],
            gain: [often(pick(0.0, 1.0), 100.0), often(pick(0.0, 1.0), 10.0)],
            most: [pick(1.0, 30.0), pick(1.0, 20.0)],
            swing: [pick(0.0, 3.0), pick(0.5, 6.0)],
        };
        let q = [pick(arm.low[0], arm.high[0]), pick(arm.low[1], arm.high[1])];
        let start = State::new(q, [pick(-3.0, 3.0), pick(-3.0, 3.0)]);
        let mut motion = arm.simulate(start).with_tolerance(1e-9).with_max_steps(20_000);
        let mut switches = 0;
        while let Some(switch) =
            motion.advance_to_switch(5.0).unwrap_or_else(|error| panic!("{number}: {error}"))
        {
            let [a, b] = switch.state.q;
            let least = (a - arm.low[0]).min(arm.high[0] - a).min(b - arm.low[1]).min(arm.high[1] - b);
            assert!(least >= -1e-13, "{number}: {least}");
            let contacts = motion.contacts();
            let frictions = [(contacts.shoulder, arm.dry[0]), (contacts.elbow, arm.dry[1])];
            for (contact, limit) in frictions {
                assert_eq!(contact == Contact::Idle, limit == 0.0, "{number}: {contact:?}");
                sticks += usize::from(contact == Contact::Sticks);
            }
            switches += 1;
            if switches > 400 {
                break;
            }
        }
        assert!(switches > 0, "{number}");
    }
    assert!(sticks > 10, "{sticks}");
}
