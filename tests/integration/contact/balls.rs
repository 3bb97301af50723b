//! N01, N05, N07, N09: impacts, several at once, infinitely many of them, rest.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close, close_on};

/// N01: a ball above a floor.
struct Ball {
    mass: f64,
    gravity: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [y])]
impl Ball {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.y * v.y
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        self.mass * self.gravity * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

const BALL: Ball = Ball { mass: 2.0, gravity: 9.81, restitution: 0.8 };

const IMPACTS: [f64; 8] = [
    0.4515236409857309,
    1.1739614665629003,
    1.7519117270246358,
    2.2142719353940246,
    2.5841601020895353,
    2.8800706354459438,
    3.1167990621310704,
    3.306181803479172,
];

#[test]
fn a_ball_bounces_at_the_right_times() {
    let mut motion = BALL.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    for expected in IMPACTS {
        let impact = motion.advance_to_switch(10.0).unwrap().unwrap();
        close_on(1.0, impact.state.t, expected, 1e-12);
        close(impact.state.v[0], -0.8 * impact.before.v[0], 1e-14);
    }
    // The same times by a function of the state.
    let mut motion = BALL.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    for expected in IMPACTS {
        let impact = motion.advance_to_event(|state: &State<f64, 1>| state.q[0], 10.0).unwrap().unwrap();
        close_on(1.0, impact.state.t, expected, 1e-12);
    }
}

#[test]
fn between_impacts_a_ball_is_where_it_should_be() {
    let mut motion = BALL.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    let state = motion.advance_to(3.0).unwrap();
    close(state.q[0], 0.06870746096576572, 1e-11);
    close(state.v[0], -0.01535413338474476, 1e-11);
}

#[test]
fn infinitely_many_impacts_end_in_rest() {
    let mut motion = BALL.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    let state = *motion.advance_to(4.063712768771578 + 1e-9).unwrap();
    assert_eq!(state.v[0], 0.0);
    close_on(1.0, state.q[0], 0.0, 1e-15);
    close(motion.reactions().floor, 2.0 * 9.81, 1e-14);
    let before = motion.steps().accepted;
    let state = *motion.advance_to(1e6).unwrap();
    assert_eq!(state, state.at_time(1e6));
    close_on(1.0, state.q[0], 0.0, 1e-15);
    // Each step may be longer than the one before by a bounded factor alone.
    assert!(motion.steps().accepted <= before + 16, "rest costs {} steps", motion.steps().accepted - before);
}

#[test]
fn just_before_the_last_impact_a_ball_still_moves() {
    let mut motion = BALL.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    let state = motion.advance_to(4.063712768771578 - 1e-5).unwrap();
    assert!(state.v[0] != 0.0 && state.q[0] >= 0.0, "{state:?}");
}

#[test]
fn a_plastic_impact_is_rest_at_once() {
    let ball = Ball { restitution: 0.0, ..BALL };
    let mut motion = ball.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    let state = motion.advance_to(0.5).unwrap();
    assert_eq!(state.v[0], 0.0);
    close_on(1.0, state.q[0], 0.0, 1e-15);
}

#[test]
fn an_elastic_ball_keeps_its_energy() {
    let ball = Ball { restitution: 1.0, ..BALL };
    let mut motion = ball.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    let energy = motion.energy();
    let period = 2.0 * IMPACTS[0];
    let state = *motion.advance_to(100.0 * period).unwrap();
    close(state.q[0], 1.0, 1e-11);
    close(motion.energy(), energy, 1e-13);
}

/// N07: a pendulum that hits a wall at the bottom.
struct Pendulum {
    length: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [phi])]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.phi.sin(), -q.phi.cos())
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }

    #[unilateral(restitution = self.restitution)]
    fn wall(&self, q: &Coordinates) -> f64 {
        q.phi
    }
}

#[test]
fn a_pendulum_hits_a_wall() {
    let pendulum = Pendulum { length: 0.8, restitution: 0.9 };
    let mut motion = pendulum.simulate(State::at_rest([1.3])).with_tolerance(TIGHT);
    let impacts = [
        (0.5011194142935445, 3.814619102173298),
        (1.478873774153719, 3.433157191955968),
        (2.4386878574170034, 3.089841472760371),
        (3.38502318576757, 2.780857325484334),
        (4.32105077169015, 2.5027715929359005),
    ];
    for (time, after) in impacts {
        let impact = motion.advance_to_switch(10.0).unwrap().unwrap();
        close_on(1.0, impact.state.t, time, 1e-12);
        close(impact.state.v[0], after, 1e-11);
    }
}

/// N09: three balls in a row, each with the next a contact.
struct Row {
    restitution: f64,
}

#[lagrangian(coordinates = [x: [3]])]
impl Row {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        v.x.iter().map(|v| 0.5 * v * v).sum()
    }

    #[unilateral(restitution = self.restitution)]
    fn gap(&self, q: &Coordinates) -> [f64; 2] {
        [q.x[1] - q.x[0] - 1.0, q.x[2] - q.x[1] - 1.0]
    }
}

fn row(restitution: f64, places: [f64; 3]) -> [f64; 3] {
    let row = Row { restitution };
    let mut motion = row.simulate(State::new(places, [1.0, 0.0, 0.0])).with_tolerance(TIGHT);
    motion.advance_to(3.0).unwrap().v
}

#[test]
fn several_balls_hit_each_other_at_once() {
    all_close(row(1.0, [-1.0, 1.0, 2.0]), [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0], 1e-13);
    all_close(row(0.5, [-1.0, 1.0, 2.0]), [0.0, 0.5, 0.5], 1e-13);
    all_close(row(1.0, [-1.0, 1.0, 2.25]), [0.0, 0.0, 1.0], 1e-13);
}

/// N05: a disc that hits a rough floor.
struct Disc {
    friction: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Disc {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.2 * (v.x * v.x + v.y * v.y) + 0.5 * 0.5 * 0.4 * 0.1 * 0.1 * v.phi * v.phi
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        0.4 * 9.81 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y - 0.1
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x + 0.1 * v.phi
    }
}

#[test]
fn a_disc_bounces_off_a_rough_floor() {
    for (friction, expected) in [
        (0.1, [2.2469940239280968, 3.100612842649014, -20.060119521438068]),
        (0.6, [2.1666666666666665, 3.100612842649014, -21.666666666666668]),
    ] {
        let disc = Disc { friction, restitution: 0.7 };
        let start = State::new([0.0, 1.1, 0.0], [3.0, 0.0, -5.0]);
        let mut motion = disc.simulate(start).with_tolerance(TIGHT);
        let time = 0.4515236409857309;
        let state = motion.advance_to(time + 1e-3).unwrap();
        let [x, y, phi] = state.v;
        all_close([x, y + 9.81 * (state.t - time), phi], expected, 1e-11);
    }
}

#[test]
fn two_kinds_of_steps_agree() {
    let other: Vec<f64> = (0..2)
        .map(|kind| {
            let disc = Disc { friction: 0.3, restitution: 0.6 };
            let start = State::new([0.0, 1.1, 0.0], [3.0, 0.0, -25.0]);
            let mut motion = disc.simulate(start).with_tolerance(if kind == 0 { 1e-13 } else { 1e-9 });
            motion.advance_to(4.0).unwrap().q[0]
        })
        .collect();
    close(other[0], other[1], 1e-7);
}

/// A ball on a floor that shakes, in single precision.
struct Shaken {
    amplitude: f32,
    rate: f32,
    restitution: f32,
}

#[lagrangian(coordinates = [y])]
impl Shaken {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f32> {
        Vector2::new(0.0, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f32 {
        9.81 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates, t: f32) -> f32 {
        q.y - self.amplitude * (self.rate * t).sin()
    }
}

#[test]
fn no_impact_is_missed_however_far_the_target_is() {
    for i in 0..50 {
        let step = i as f32 / 50.0;
        let system =
            Shaken { amplitude: 0.01 + 0.05 * step, rate: 30.0 - 20.0 * step, restitution: 0.3 + 0.5 * step };
        let mut motion = system.simulate(State::at_rest([0.2 + step]));
        let (mut before, mut impacts) = (*motion.state(), 0);
        // Free flight is a polynomial, so one step would go all the way.
        while let Some(switch) = motion.advance_to_switch(10.0).unwrap() {
            let State { t, q: [y], v: [v] } = switch.state;
            let floor = system.amplitude * (system.rate * t).sin();
            // Rounding errors of the flight, of the phase, and of the time that the state belongs to.
            let (passed, rate) = (t - before.t, system.amplitude * system.rate);
            let flight = before.q[0].abs() + passed * (before.v[0].abs() + 0.5 * 9.81 * passed);
            let speed = v.abs().max((before.v[0] - 9.81 * passed).abs()) + rate;
            let known = 2.0 * f32::EPSILON * (flight + system.amplitude + (rate + speed) * t);
            assert!((y - floor).abs() < known, "{i}: {y} {floor} at {t}");
            (before, impacts) = (switch.state, impacts + 1);
        }
        assert!(impacts > 0 && motion.t() == 10.0, "{i}: {impacts} impacts until {}", motion.t());
    }
}

/// A ball whose numbers are all exact: it strikes at 1/2, 1, 5/4, … up to 3/2.
struct Exact;

#[lagrangian(coordinates = [y])]
impl Exact {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        8.0 * q.y
    }

    #[unilateral(restitution = 0.5)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

#[test]
fn an_impact_at_a_time_that_is_asked_for_is_told_once() {
    let strikes = [0.5, 1.0, 1.25, 1.375];
    for stops in [&[][..], &[0.5], &[1.0], &[0.25, 0.5, 1.0, 1.25], &[0.5, 0.5, 0.75, 1.25]] {
        let mut motion = Exact.simulate(State::at_rest([1.0]));
        let mut told = Vec::new();
        for &stop in stops.iter().chain(&[1.4]) {
            while let Some(switch) = motion.advance_to_switch(stop).unwrap() {
                close(switch.state.v[0], -0.5 * switch.before.v[0], 1e-13);
                told.push(switch.state.t);
            }
            assert_eq!(motion.t(), stop);
        }
        all_close(told, strikes, 1e-13);
    }
    // Only what the state has not yet passed is told.
    let mut motion = Exact.simulate(State::at_rest([1.0]));
    let is_before = motion.advance_to(0.5).unwrap().v[0] < 0.0;
    let first = motion.advance_to_switch(2.0).unwrap().unwrap();
    close(first.state.t, if is_before { 0.5 } else { 1.0 }, 1e-13);
}

/// A mass on a spring that a floor stops shortly before its lowest point.
struct Bob {
    floor: f64,
}

#[lagrangian(coordinates = [y])]
impl Bob {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * q.y * q.y
    }

    #[unilateral(restitution = 0.5)]
    fn gap(&self, q: &Coordinates) -> f64 {
        q.y - self.floor
    }
}

/// A strike has the root of its depth for a speed, so one that is missed changes the motion by much more than
/// its depth. The error is to be that of a few rounding errors of the height of the floor.
#[test]
fn strikes_are_met_down_to_rounding_errors_of_their_depth() {
    for depth in (6..16).map(|digits| 10_f64.powi(-digits)) {
        let bob = Bob { floor: depth - 1.0 };
        let mut motion = bob.simulate(State::new([0.0], [1.0])).with_tolerance(0.0);
        let found = motion.advance_to(6.0).unwrap().q[0];
        let height = -bob.floor;
        let speed = ((1.0 - height) * (1.0 + height)).sqrt();
        let passed = 6.0 - std::f64::consts::PI - height.asin();
        let expected = 0.5 * speed * passed.sin() - height * passed.cos();
        let ulp = f64::EPSILON / speed;
        assert!((found - expected).abs() < 16.0 * ulp, "{depth:e}: {found} instead of {expected}");
    }
}
