//! Functions that are narrow beside a step: bumps that turn a body back, detents that hold it, pulses of time
//! and high powers, of widths and at tolerances of every size. References are closed forms.

use std::f64::consts::PI;

use lagrangian::prelude::*;
use lagrangian::{Batch, Dop853, Smooth};

use super::line::line;
use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

line!(Bump { width, height }, |self, q, _v, _t| self.height * (-(q.x / self.width).powi(2)).exp(), 0.0);
line!(Sech { width, height }, |self, q, _v, _t| self.height / (q.x / self.width).cosh().powi(2), 0.0);
line!(Rise { width, height }, |self, q, _v, _t| self.height * (1.0 + (q.x / self.width).tanh()), 0.0);
line!(
    Detents { width, height },
    |self, q, _v, _t| self.height * (-(q.x.sin() / self.width).powi(2)).exp(),
    0.0
);
line!(
    Soft { width, height },
    |self, q, _v, _t| self.height * (1.0 + (q.x / self.width).powi(2)).powi(-3),
    0.0
);
line!(
    Pulse { width, height },
    |self, q, _v, t| 0.0 * q.x,
    self.height * (-((t - 20.0) / self.width).powi(2)).exp()
);
line!(
    Beats { width, height },
    |self, q, _v, t| 0.0 * q.x,
    self.height * ((t.sin() / self.width).powi(2) + 1.0).powi(-2)
);
line!(Flat { width, height }, |self, q, _v, _t| self.height * (q.x / self.width).powi(22), 0.0);
line!(Cosines { width, height }, |self, q, _v, t| 0.0 * q.x, self.height * (t / self.width).cos().powi(40));

/// Calls a test with random widths, heights and tolerances.
fn many(seed: u64, check: impl Fn(f64, f64, f64, &mut Samples)) {
    let mut samples = Samples::new(seed);
    for _ in 0..60 {
        let width = 10_f64.powf(samples.number(-6.0, -0.5));
        let tolerance = 10_f64.powf(samples.number(-13.0, -5.0));
        let height = samples.number(0.3, 1.0);
        check(width, height, tolerance, &mut samples);
    }
}

/// The velocity after some time, by a motion, by a lane and by another method.
fn velocity<S>(system: &S, start: State<f64, 1>, tolerance: f64, t: f64) -> f64
where
    S: Smooth<1, Scalar = f64, Method = Jets>,
{
    let end = *system.simulate(start).with_tolerance(tolerance).advance_to(t).unwrap();
    let lane = Batch::new(system, start).with_tolerance(tolerance).advance_to(t).unwrap().v[0];
    close_on(1.0, lane, end.v[0], 1e3 * tolerance);
    let other = by_stages(system, start, tolerance, t);
    close_on(1.0, other, end.v[0], 1e4 * tolerance);
    end.v[0]
}

/// The same by a method whose steps know the equations at their stages alone.
fn by_stages<S: System<1, Scalar = f64>>(system: &S, start: State<f64, 1>, tolerance: f64, t: f64) -> f64 {
    system.simulate_with::<Dop853>(start).with_tolerance(tolerance).advance_to(t).unwrap().v[0]
}

#[test]
fn bumps_turn_a_body_back_that_has_less_energy() {
    many(1, |width, height, tolerance, samples| {
        let speed = samples.number(0.2, 0.9) * (2.0 * height).sqrt();
        let start = State::new([-samples.number(3.0, 30.0)], [speed]);
        for found in [
            velocity(&Bump { width, height }, start, tolerance, 200.0),
            velocity(&Sech { width, height }, start, tolerance, 200.0),
            velocity(&Rise { width, height }, start, tolerance, 200.0),
        ] {
            close(found, -speed, 1e4 * tolerance);
        }
        // The force of this one reaches far.
        let found = velocity(&Soft { width, height }, start, tolerance, 200.0);
        close(found, -speed, 1e4 * tolerance);
    });
}

#[test]
fn detents_hold_a_body_that_has_less_energy() {
    many(2, |width, height, tolerance, samples| {
        let speed = samples.number(0.2, 0.9) * (2.0 * height).sqrt();
        let detents = Detents { width, height };
        let start = State::new([samples.number(1.0, 2.0)], [speed]);
        let mut motion = detents.simulate(start).with_tolerance(tolerance);
        for time in [3.0, 10.0, 50.0, 100.0] {
            let place = motion.advance_to(time).unwrap().q[0];
            assert!(0.0 < place && place < PI, "{width} {height} {tolerance} {start:?}: {place}");
        }
    });
}

#[test]
fn pulses_push_by_their_integrals() {
    many(3, |width, height, tolerance, samples| {
        let start = State::new([0.0], [samples.number(-1.0, 1.0)]).at_time(samples.number(-30.0, 15.0));
        // Narrow pulses push as far as wide ones. Time resolves them to a part ε t/w.
        let tolerance = tolerance.max(2.0 * 20.0 * f64::EPSILON / width);
        let pulse = Pulse { width, height: height / width };
        let gain = velocity(&pulse, start, tolerance, 40.0) - start.v[0];
        close_on(1.0, gain, height * PI.sqrt(), 1e3 * tolerance);
        // ∫ dt / (1 + (sin t / w)²)² over a half turn.
        let beats = Beats { width, height: height / width };
        let gain = velocity(&beats, start.at_time(-0.5 * PI), tolerance, 0.5 * PI) - start.v[0];
        let expected = height * PI * (1.0 + 2.0 * width * width) / (2.0 * (1.0 + width * width).powf(1.5));
        close_on(1.0, gain, expected, 1e3 * tolerance);
    });
}

#[test]
fn high_powers_are_seen_from_where_they_are_nothing() {
    many(4, |_, height, tolerance, samples| {
        let flat = Flat { width: 1.0, height };
        for place in [0.0, samples.number(-0.7, 0.7)] {
            let start = State::new([place], [samples.number(0.5, 2.0)]);
            let mut motion = flat.simulate(start).with_tolerance(tolerance);
            motion.advance_to(30.0).unwrap();
            close(motion.energy(), flat.energy(&start), 1e4 * tolerance);
        }
        // (40 choose 20) / 2⁴⁰ of the time.
        let mean = (1..=20).fold(1.0, |mean, k| mean * f64::from(20 + k) / f64::from(4 * k));
        let turns = 5.0 * PI;
        let start = State::new([0.0], [samples.number(-1.0, 1.0)]).at_time(samples.number(0.0, 3.0));
        let found = velocity(&Cosines { width: 1.0, height }, start, tolerance, start.t + turns) - start.v[0];
        close_on(1.0, found, height * mean * turns, 1e3 * tolerance);
    });
}

line!(
    Versines { height },
    |self, q, _v, _t| self.height * (1.0 - q.x.cos()).powi(5) * (1.0 - (2.0 * q.x).cos()).powi(5),
    0.0
);

#[test]
fn products_of_powers_are_seen_from_where_they_are_nothing() {
    let mut samples = Samples::new(5);
    for _ in 0..200 {
        let tolerance = 10_f64.powf(samples.number(-13.0, -5.0));
        let flat = Versines { height: samples.number(-0.1, 0.1) };
        let place = 10_f64.powf(samples.number(-9.0, -0.3));
        let start = State::new([place], [samples.number(0.5, 2.0)]);
        let alone = *flat.simulate(start).with_tolerance(tolerance).advance_to(6.0).unwrap();
        let mut lane = Batch::new(&flat, start).with_tolerance(tolerance);
        for found in [alone, *lane.advance_to(6.0).unwrap()] {
            close(flat.energy(&found), flat.energy(&start), 1e4 * tolerance + 1e-12);
        }
    }
}

/// A bead on a ring with a bump on each side, in Cartesian coordinates.
struct Ring {
    width: f64,
    height: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Ring {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn ring(&self, q: &Coordinates) -> f64 {
        q.x.hypot(q.y) - 1.0
    }

    #[potential]
    fn bumps(&self, q: &Coordinates) -> f64 {
        self.height * (-(q.x / self.width).powi(2)).exp()
    }
}

#[test]
fn bumps_hold_a_bead_on_a_ring() {
    many(5, |width, height, tolerance, samples| {
        let speed = samples.number(0.2, 0.9) * (2.0 * height).sqrt();
        let angle = samples.number(-0.9, 0.9_f64);
        let start = State::new([angle.cos(), angle.sin()], [-speed * angle.sin(), speed * angle.cos()]);
        let ring = Ring { width, height };
        let mut motion = ring.simulate(start).with_tolerance(tolerance);
        let mut other = ring.simulate_with::<Dop853>(start).with_tolerance(tolerance);
        for time in [3.0, 10.0, 30.0] {
            let places = [motion.advance_to(time), other.advance_to(time)].map(|state| state.unwrap().q[0]);
            assert!(
                places.iter().all(|&place| place > 0.0),
                "{width} {height} {tolerance} {start:?}: {places:?}"
            );
        }
    });
}

line!(
    Slope { width, height },
    |self, q, _v, _t| self.height * (-(q.x / self.width).powi(2)).exp() + 0.1 * q.x.max(0.0),
    0.0
);

#[test]
fn bumps_turn_a_body_back_before_a_kink() {
    many(6, |width, height, tolerance, samples| {
        let speed = samples.number(0.2, 0.9) * (2.0 * height).sqrt();
        let start = State::new([-samples.number(3.0, 30.0)], [speed]);
        let slope = Slope { width, height };
        let end = *slope.simulate(start).with_tolerance(tolerance).advance_to(200.0).unwrap();
        close(end.v[0], -speed, 1e4 * tolerance);
        close(by_stages(&slope, start, tolerance, 200.0), -speed, 1e4 * tolerance);
    });
}

/// A mass on a line that an input pushes, and a bump.
struct Pushed {
    width: f64,
    height: f64,
}

#[lagrangian(coordinates = [x], inputs = [push])]
impl Pushed {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn bump(&self, q: &Coordinates) -> f64 {
        self.height * (-(q.x / self.width).powi(2)).exp()
    }

    #[force(on = x)]
    fn pushed(&self, u: &Inputs) -> f64 {
        u.push
    }
}

#[test]
fn bumps_turn_a_body_back_that_a_law_of_the_state_drives() {
    many(7, |width, height, tolerance, samples| {
        let speed = samples.number(0.2, 0.9) * (2.0 * height).sqrt();
        // The law is a weak spring to where the body starts, which it passes again after it has turned.
        let from = -samples.number(3.0, 5.0);
        let start = State::new([from], [speed]);
        let pushed = Pushed { width, height };
        let law = |state: &State<f64, 1>| [1e-3 * (from - state.q[0])];
        let mut motion = pushed.simulate(start).with_control(law).with_tolerance(tolerance);
        let end = *motion.advance_to(200.0).unwrap();
        assert!(end.q[0] < 0.0, "{width} {height} {tolerance} {start:?}: {end:?}");
        let energy = |state: &State<f64, 1>| pushed.energy(state) + 0.5e-3 * (state.q[0] - from).powi(2);
        close_on(1.0, energy(&end), energy(&start), 1e4 * tolerance);
    });
}

/// The same bump in single precision.
struct Single {
    width: f32,
}

#[lagrangian(coordinates = [x])]
impl Single {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f32 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn bump(&self, q: &Coordinates) -> f32 {
        (-(q.x / self.width).powi(2)).exp()
    }
}

#[test]
fn single_precision_meets_them_too() {
    for width in [0.1, 1e-2, 1e-3] {
        let single = Single { width };
        for speed in [0.3, 0.8, 1.2_f32] {
            let end = *single.simulate(State::new([-5.0], [speed])).advance_to(60.0).unwrap();
            close(f64::from(end.v[0]), f64::from(-speed), 1e-3);
        }
    }
}
