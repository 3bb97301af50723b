//! A rope that goes taut, a ball that rolls on a turntable, and the times of switches of N03 and N12.

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close, close_on};

/// A mass on a rope of one metre: it may be nearer.
struct Leash {
    restitution: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Leash {
    #[point(mass = 0.4)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        0.4 * 9.81 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn rope(&self, q: &Coordinates) -> f64 {
        1.0 - q.x.hypot(q.y)
    }
}

#[test]
fn a_rope_goes_taut_and_keeps_what_goes_round() {
    // From rest at (0.6, 0) the mass falls straight down, until the rope is taut at (0.6, −0.8).
    let speed = (2.0 * 9.81 * 0.8_f64).sqrt();
    let taut = speed / 9.81;
    let leash = Leash { restitution: 0.0 };
    let mut motion = leash.simulate(State::at_rest([0.6, 0.0])).with_tolerance(TIGHT);
    let switch = motion.advance_to_switch(2.0).unwrap().unwrap();
    close(switch.state.t, taut, 1e-12);
    all_close(switch.before.q, [0.6, -0.8], 1e-12);
    // The velocity that is left goes along the circle, (−0.8, −0.6); the rest is the impulse of the rope.
    let along = 0.6 * speed;
    all_close(switch.state.v, [-0.8 * along, -0.6 * along], 1e-12);
    close(motion.impulses().rope, 0.4 * 0.8 * speed, 1e-12);
    // A pendulum from there on, whose rope bears m (v² / l + g cos θ) and stays taut: at the bottom
    // v² = along² + 2 g (1 − 0.8).
    let bottom = (along * along + 2.0 * 9.81 * 0.2).sqrt();
    let event = motion.advance_to_event(|state: &State<f64, 2>| state.q[0], 4.0).unwrap().unwrap();
    all_close(event.state.v, [-bottom, 0.0], 1e-9);
    motion.advance_to(event.state.t).unwrap();
    assert_eq!(motion.contacts().rope, Contact::Closed);
    close(motion.reactions().rope, 0.4 * (bottom * bottom + 9.81), 1e-9);
    // It rises to the height of its energy on the other side.
    let top = motion.advance_to_event(|state: &State<f64, 2>| state.v[1], 4.0).unwrap().unwrap();
    close_on(1.0, top.state.q[1], -1.0 + bottom * bottom / (2.0 * 9.81), 1e-9);
}

#[test]
fn a_rope_goes_slack_above_and_taut_again() {
    // v² = 3.5 g l at the bottom: slack where v² = −g l cos θ, at cos θ = −1/2, with v² = g l / 2.
    let leash = Leash { restitution: 0.0 };
    let start = State::new([0.0, -1.0], [(3.5 * 9.81_f64).sqrt(), 0.0]);
    let mut motion = leash.simulate(start).with_tolerance(TIGHT);
    let slack = motion.advance_to_switch(2.0).unwrap().unwrap().state;
    let (sin, cos) = (0.75_f64.sqrt(), -0.5);
    all_close(slack.q, [sin, -cos], 1e-9);
    let speed = (0.5 * 9.81_f64).sqrt();
    all_close(slack.v, [speed * cos, speed * sin], 1e-9);
    assert_eq!(motion.contacts().rope, Contact::Open);
    // The parabola touches the circle there in three points that coincide. The angles from the horizontal of
    // all four points that a circle shares with a parabola of vertical axis add up to a multiple of 2 π.
    let phi = 0.5_f64.asin();
    let taut = motion.advance_to_switch(3.0).unwrap().unwrap();
    for (found, exact) in taut.before.q.iter().zip([(3.0 * phi).cos(), -(3.0 * phi).sin()]) {
        close_on(1.0, *found, exact, 1e-9);
    }
}

/// A homogeneous ball on a rough table that turns with Ω about the origin: the turns a and b of the ball
/// about the axes of x and y; its spin does not matter.
struct Turntable {
    rate: f64,
}

const RADIUS: f64 = 0.05;

#[lagrangian(coordinates = [x, y, a, b])]
impl Turntable {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y) + 0.2 * RADIUS * RADIUS * (v.a * v.a + v.b * v.b)
    }

    #[friction(limit = 2.0)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x - RADIUS * v.b + self.rate * q.y, v.y + RADIUS * v.a - self.rate * q.x)
    }
}

#[test]
fn a_ball_on_a_turntable_goes_round_in_circles() {
    // It rolls on a circle with two sevenths of the rate of the table.
    let (rate, speed, x) = (3.0, [0.2, 0.1], 0.4);
    let round = 2.0 / 7.0 * rate;
    // At (x, 0) the table moves with Ω x along y.
    let spin = [(rate * x - speed[1]) / RADIUS, speed[0] / RADIUS];
    let start = State::new([x, 0.0, 0.0, 0.0], [speed[0], speed[1], spin[0], spin[1]]);
    let table = Turntable { rate };
    let mut motion = table.simulate(start).with_tolerance(TIGHT);
    for t in [1.0, 5.0, 30.0] {
        let state = *motion.advance_to(t).unwrap();
        assert_eq!(motion.contacts().slip, [Contact::Sticks; 2]);
        let (sin, cos) = (round * t).sin_cos();
        let place = [
            x + (speed[0] * sin - speed[1] * (1.0 - cos)) / round,
            (speed[1] * sin + speed[0] * (1.0 - cos)) / round,
        ];
        for (found, exact) in state.q.iter().zip(place) {
            close_on(1.0, *found, exact, 1e-9);
        }
    }
}

/// N03: a block on a belt, whose spring holds it. Static friction is more than kinetic friction.
struct Belt;

#[lagrangian(coordinates = [x])]
impl Belt {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        4.5 * q.x * q.x
    }

    #[friction(limit = 2.4, static_limit = 4.0)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - 0.2
    }
}

#[test]
fn a_belt_carries_and_loses_a_block_on_time() {
    let mut motion = Belt.simulate(State::new([0.0], [0.2])).with_tolerance(TIGHT);
    let (slip, stick) = (1.286_377_998_043_646, 16.0 / 9.0);
    let mut time = 20.0 / 9.0;
    for _ in 0..20 {
        for (place, lasts) in [(4.0 / 9.0, slip), (0.8 / 9.0, stick)] {
            let state = motion.advance_to_switch(100.0).unwrap().unwrap().state;
            close(state.t, time, 1e-12);
            close_on(0.4, state.q[0], place, 1e-11);
            time += lasts;
        }
    }
}

/// N12: a particle on a rough incline, pushed across the slope.
struct Incline;

#[lagrangian(coordinates = [down, across])]
impl Incline {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.down * v.down + v.across * v.across)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        -9.81 * 0.3_f64.sin() * q.down
    }

    #[friction(limit = 0.45 * 9.81 * 0.3_f64.cos())]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.down, v.across)
    }
}

#[test]
fn a_particle_on_an_incline_stops_on_time() {
    let mut motion = Incline.simulate(State::new([0.0, 0.0], [0.0, 2.0])).with_tolerance(TIGHT);
    let mut stops = None;
    while let Some(switch) = motion.advance_to_switch(2.0).unwrap() {
        stops = Some(switch.state.t);
    }
    close(stops.unwrap(), 0.899_085_121_285_305_2, 1e-12);
}
