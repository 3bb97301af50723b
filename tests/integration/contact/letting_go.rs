//! Friction that lets go or comes to hold where something else happens at the same time.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close};
use crate::support::sample::Samples;

/// Two blocks of 1 kg on each other; from 1 s on the upper one is pulled. The floor holds more at rest.
struct Stack {
    kinetic: f64,
    fixed: f64,
    between: f64,
    pull: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Stack {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y)
    }

    #[force(on = y)]
    fn pull(&self, t: f64) -> f64 {
        if t < 1.0 { 0.0 } else { self.pull }
    }

    #[friction(limit = self.kinetic, static_limit = self.fixed)]
    fn on_floor(&self, v: &Velocities) -> f64 {
        v.x
    }

    #[friction(limit = self.between)]
    fn between(&self, v: &Velocities) -> f64 {
        v.y - v.x
    }
}

#[test]
fn friction_that_is_not_exceeded_does_not_let_go() {
    for (fixed, between, pull) in [(2.5, 2.0, 2.1), (2.5, 2.0, 2.6), (3.0, 1.5, 2.9), (1.2, 1.1, 5.0)] {
        // With its kinetic limit the floor would let both blocks go, or the lower one, once it has begun.
        let stack = Stack { kinetic: 1.0, fixed, between, pull };
        for start in [State::at_rest([0.0; 2]), State::at_rest([0.0; 2]).at_time(1.0)] {
            let mut motion = stack.simulate(start).with_tolerance(TIGHT);
            let end = motion.advance_to(3.0).unwrap();
            all_close(end.q, [0.0, 2.0 * (pull - between)], 1e-12);
        }
    }
    // The floor lets go where it is exceeded while the blocks stick to each other.
    let stack = Stack { kinetic: 1.0, fixed: 2.0, between: 2.5, pull: 2.25 };
    let mut motion = stack.simulate(State::at_rest([0.0; 2])).with_tolerance(TIGHT);
    all_close(motion.advance_to(3.0).unwrap().q, [1.25; 2], 1e-12);
}

/// Two blocks of 1 kg on each other, both with more friction at rest. The upper one is pulled.
struct Sliding {
    floor: [f64; 2],
    between: [f64; 2],
    pull: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Sliding {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y)
    }

    #[force(on = y)]
    fn pull(&self) -> f64 {
        self.pull
    }

    #[friction(limit = self.floor[0], static_limit = self.floor[1])]
    fn on_floor(&self, v: &Velocities) -> f64 {
        v.x
    }

    #[friction(limit = self.between[0], static_limit = self.between[1])]
    fn between(&self, v: &Velocities) -> f64 {
        v.y - v.x
    }
}

#[test]
fn where_a_slip_ends_the_friction_lets_go_that_is_exceeded() {
    // The floor can hold the pull, the upper friction cannot. With its kinetic limit the floor would let both
    // blocks go backward, in which case nothing would be exceeded either.
    let mut samples = Samples::new(5);
    for _ in 0..100 {
        let floor = [samples.number(0.5, 1.0), samples.number(2.0, 3.0)];
        let between = [samples.number(0.9, 1.2), samples.number(1.3, 1.5)];
        let (pull, speed) = (-samples.number(1.6, 1.9), samples.number(0.01, 0.3));
        let blocks = Sliding { floor, between, pull };
        let stops = 2.0 * speed / (floor[0] - pull);
        let start = State::new([0.0; 2], [speed; 2]);
        let end = *blocks.simulate(start).with_tolerance(TIGHT).advance_to(2.0).unwrap();
        all_close(end.v, [0.0, (pull + between[0]) * (2.0 - stops)], 1e-11);
        let mut stepper = blocks.stepper::<Jet<6>>(start);
        for _ in 0..200 {
            stepper.step(0.01, &[]).unwrap();
        }
        all_close(stepper.state().v, end.v, 1e-10);
    }
}

/// A block on a belt that begins to move.
struct Belt {
    limit: f64,
    begins: f64,
}

#[lagrangian(coordinates = [x])]
impl Belt {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[friction(limit = self.limit)]
    fn slip(&self, v: &Velocities, t: f64) -> f64 {
        v.x - 0.5 * (t - self.begins).max(0.0)
    }
}

#[test]
fn a_block_that_has_stopped_waits_for_a_belt() {
    for limit in [0.3, 0.5, 0.7, 1.1, 1.3, 1.7] {
        for speed in [0.01, 0.03, 0.05, 0.07, 0.1] {
            for begins in [0.5, 1.0, 1.25, 1.5, 2.0] {
                let belt = Belt { limit, begins };
                let start = State::new([0.0], [speed]);
                let stop = speed * speed / (2.0 * limit);
                let mut motion = belt.simulate(start);
                let there = motion.advance_to(begins).unwrap();
                close(there.q[0], stop, 1e-13);
                assert_eq!(there.v, [0.0]);
                let way = if limit < 0.5 { 0.5 * limit } else { 0.25 };
                close(motion.advance_to(begins + 1.0).unwrap().q[0], stop + way, 1e-9);
                let mut sampled = belt.simulate(start);
                for state in sampled.every(0.025).take(100) {
                    state.unwrap();
                }
            }
        }
    }
}

/// Two blocks between a belt, each other and a ceiling.
struct Wedged {
    mass: f64,
    limits: [f64; 3],
}

#[lagrangian(coordinates = [x, y])]
impl Wedged {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (self.mass * v.x * v.x + v.y * v.y)
    }

    #[friction(limit = self.limits[0])]
    fn on_belt(&self, v: &Velocities, t: f64) -> f64 {
        v.x - 0.4 * (t - 3.0).max(0.0)
    }

    #[friction(limit = self.limits[1])]
    fn between(&self, v: &Velocities) -> f64 {
        v.y - v.x
    }

    #[friction(limit = self.limits[2])]
    fn on_top(&self, v: &Velocities) -> f64 {
        v.y
    }
}

#[test]
fn several_frictions_stop_at_once() {
    for step in 1..=200 {
        let part = |k: f64| (k * f64::from(step) * 0.618).fract();
        let (mass, limits) = (1.0 + part(1.0), [1.0 + 2.0 * part(2.0), 9.0, 0.5 + part(3.0)]);
        let speed = 0.1 + 0.4 * part(5.0);
        let wedged = Wedged { mass, limits };
        let start = State::new([-0.3 - part(7.0), -0.8], [speed; 2]);
        let slid = 0.5 * speed * speed * (mass + 1.0) / (limits[0] + limits[2]);
        let end = *wedged.simulate(start).advance_to(2.9).unwrap();
        all_close(end.q, start.q.map(|x| x + slid), 1e-12);
        assert_eq!(end.v, [0.0; 2]);
    }
}

/// A disc on a plate that begins to accelerate, or under a force that begins.
struct Plate {
    limit: f64,
    force: [f64; 2],
    acceleration: [f64; 2],
    begins: f64,
    jump: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Plate {
    #[point(mass = 1.0)]
    fn disc(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[force(at = disc)]
    fn pull(&self, t: f64) -> Vector2<f64> {
        let jump = if t < self.begins { 0.0 } else { self.jump };
        Vector2::new(self.force[0] + jump, self.force[1])
    }

    #[friction(limit = self.limit)]
    fn slip(&self, v: &Velocities, t: f64) -> Vector2<f64> {
        let passed = (t - self.begins).max(0.0);
        Vector2::new(v.x - self.acceleration[0] * passed, v.y - self.acceleration[1] * passed)
    }
}

#[test]
fn a_disc_slips_on_a_plate_that_accelerates_at_once() {
    for step in 1..=200 {
        let part = |k: f64| (k * f64::from(step) * 0.618).fract();
        let (limit, begins) = (1.0 + part(1.0), 0.05 + part(2.0));
        // The force before; it may jump when the plate begins to move.
        let mut force = if step % 3 == 0 { [0.0; 2] } else { [0.0, 0.8 * limit * part(3.0)] };
        let jump = if step % 2 == 0 { 0.0 } else { -part(6.0) };
        let acceleration = [3.0 + part(5.0), -part(7.0)];
        let plate = Plate { limit, force, acceleration, begins, jump };
        force[0] += jump;
        // It slips along its force in the frame of the plate.
        let along = [0, 1].map(|i| force[i] - acceleration[i]);
        let share = limit / along[0].hypot(along[1]);
        let end = *plate.simulate(State::at_rest([0.0; 2])).advance_to(begins + 1.0).unwrap();
        all_close(end.q, [0, 1].map(|i| 0.5 * (force[i] - share * along[i])), 1e-11);
    }
}

#[test]
fn a_disc_that_slips_is_sampled_at_a_jump() {
    for step in 1..=25 {
        let part = |k: f64| (k * f64::from(step) * 0.618).fract();
        let begins = 0.01 * f64::from(step);
        let [limit, jump] = [0.5 + part(1.0), 1.0 - part(2.0)];
        let plate = Plate { limit, force: [0.0; 2], acceleration: [0.0; 2], begins, jump };
        let start = State::new([0.3, 0.4], [2.0 + part(3.0), 1.0]);
        let mut sampled = plate.simulate(start);
        for time in 1..=400 {
            sampled.advance_to(f64::from(time) * 1e-3).unwrap();
        }
        let end = *plate.simulate(start).advance_to(0.4).unwrap();
        all_close(sampled.state().q, end.q, 1e-9);
    }
}

/// A block under a growing force, whose friction falls with its speed.
struct Growing;

#[lagrangian(coordinates = [x])]
impl Growing {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn pull(&self, t: f64) -> f64 {
        t
    }

    fn limit(&self, v: &Velocities) -> f64 {
        1.0 - 0.1 * v.x.abs()
    }

    #[friction(limit = limit)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_slip_begins_slowly_at_any_tolerance() {
    for tolerance in [1e-6, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14] {
        for passed in [1e-5_f64, 3e-4, 3e-3, 1e-2, 1.0] {
            // v' = s + v / 10 from rest, after the time s.
            let speed = 100.0 * ((0.1 * passed).exp_m1() - 0.1 * passed);
            let mut motion = Growing.simulate(State::at_rest([0.0])).with_tolerance(tolerance);
            let found = motion.advance_to(1.0 + passed).unwrap().v[0];
            let least = 1e-15 * passed;
            assert!(
                (found - speed).abs() < (10.0 * tolerance + 1e-10) * speed + least,
                "{tolerance:e} {passed:e}: {found:e} {speed:e}"
            );
        }
    }
}

/// A ball that bounces, with a force that begins at a time, and a clock.
struct Ball {
    restitution: f64,
    begins: f64,
    force: f64,
}

#[lagrangian(coordinates = [y])]
impl Ball {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.y * v.y
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[force(on = y)]
    fn push(&self, t: f64) -> f64 {
        if t < self.begins { 0.0 } else { self.force }
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[event]
    fn clock(&self, t: f64) -> f64 {
        t - self.begins
    }
}

#[test]
fn a_clock_strikes_at_an_impact() {
    for step in 1..=200 {
        let height = 0.5 + 0.003 * f64::from(step);
        let restitution = 0.4 + 0.002 * f64::from(step);
        let fall = (2.0 * height / 9.81_f64).sqrt();
        let begins = fall * (1.0 + 2.0 * restitution);
        for force in [0.0, -2.0] {
            let ball = Ball { restitution, begins, force };
            let mut motion = ball.simulate(State::at_rest([height]));
            let times: Vec<f64> =
                motion.events(BallEvent::Clock, begins + 0.05).map(|event| event.unwrap().state.t).collect();
            assert_eq!(times.len(), 1, "{times:?}");
            close(times[0], begins, 1e-14);
        }
    }
}
