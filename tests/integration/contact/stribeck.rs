//! Laws of friction that are narrow at rest: exp(−(v/w)²) is nothing where a step begins, and all where the
//! slip ends. Times follow from ∫ dv/a.

use lagrangian::prelude::*;

use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

/// ∫ dv / a(v) by Simpson's rule.
fn time(from: f64, to: f64, a: impl Fn(f64) -> f64) -> f64 {
    let parts = 20_000;
    let step = (to - from) / f64::from(parts);
    let weight = |i: i32| if i == 0 || i == parts { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    (0..=parts).map(|i| weight(i) / a(from + f64::from(i) * step)).sum::<f64>() * step / 3.0
}

/// Two inertias that a clutch couples; the first one is driven.
struct Clutch {
    inertias: [f64; 2],
    drive: f64,
    slow: f64,
    more: f64,
    width: f64,
}

#[lagrangian(coordinates = [a: [2]])]
impl Clutch {
    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * (self.inertias[0] * v.a[0].powi(2) + self.inertias[1] * v.a[1].powi(2))
    }

    #[force(on = a)]
    fn drive(&self) -> [f64; 2] {
        [self.drive, 0.0]
    }

    fn slip_rate(&self, v: &Velocities) -> f64 {
        v.a[0] - v.a[1]
    }

    fn law(&self, v: &Velocities) -> f64 {
        self.slow + self.more * (-(self.slip_rate(v) / self.width).powi(2)).exp()
    }

    #[friction(limit = law)]
    fn slip(&self, v: &Velocities) -> f64 {
        self.slip_rate(v)
    }
}

#[test]
fn a_clutch_slips_until_its_law_says() {
    let mut samples = Samples::new(3);
    for _ in 0..100 {
        let inertias = [samples.number(0.2, 2.0), samples.number(0.2, 2.0)];
        let both = 1.0 / inertias[0] + 1.0 / inertias[1];
        let (slow, more) = (samples.number(0.3, 1.0), samples.number(0.1, 0.6));
        let width = samples.number(0.01, 0.1);
        // The drive turns the slip round: from −v₀ through zero to its end.
        let drive = samples.number(1.5, 3.0) * (slow + more) * both * inertias[0];
        let clutch = Clutch { inertias, drive, slow, more, width };
        let law = |slip: f64| slow + more * (-(slip / width).powi(2)).exp();
        let start = samples.number(-3.0, -0.3);
        let until = time(start, 0.0, |slip| drive / inertias[0] + both * law(slip));
        let end = samples.number(0.3, 3.0);
        let whole = until + time(0.0, end, |slip| drive / inertias[0] - both * law(slip));
        for tolerance in [1e-8, 1e-10, 1e-12] {
            let mut motion = clutch.simulate(State::new([0.0; 2], [start, 0.0])).with_tolerance(tolerance);
            let turn = motion.advance_to_switch(100.0).unwrap().unwrap().state;
            close(turn.t, until, 10.0 * tolerance + 1e-10);
            let v = motion.advance_to(whole).unwrap().v;
            close(v[0] - v[1], end, 10.0 * tolerance + 1e-9);
        }
    }
}

/// The same as a smooth force on one coordinate.
struct Bump {
    force: f64,
    more: f64,
    width: f64,
}

#[lagrangian(coordinates = [x])]
impl Bump {
    #[point(mass = 1.0)]
    fn place(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[force(on = x)]
    fn bump(&self, v: &Velocities) -> f64 {
        -self.force - self.more * (-(v.x / self.width).powi(2)).exp()
    }
}

#[test]
fn a_velocity_passes_a_narrow_force() {
    let mut samples = Samples::new(4);
    for _ in 0..300 {
        let (force, more) = (samples.number(0.5, 3.0), samples.number(0.2, 1.0));
        let width = samples.number(0.01, 0.1);
        let (start, end) = (samples.number(0.3, 2.0), samples.number(-2.0, -0.3));
        let bump = Bump { force, more, width };
        let whole = time(start, end, |v| -force - more * (-(v / width).powi(2)).exp());
        let v = bump.simulate(State::new([0.0], [start])).advance_to(whole).unwrap().v[0];
        close(v, end, 1e-8);
    }
}

/// A block that a belt takes along against a spring.
struct Belt {
    stiffness: f64,
    kinetic: f64,
    fixed: f64,
    width: f64,
    speed: f64,
}

impl Belt {
    fn sample(samples: &mut Samples) -> Self {
        let [stiffness, kinetic, fixed, width, speed] =
            [[1.0, 20.0], [0.5, 1.0], [1.0, 2.0], [0.02, 0.5], [0.05, 0.5]]
                .map(|[a, b]| samples.number(a, b));
        Self { stiffness, kinetic, fixed, width, speed }
    }
}

#[lagrangian(coordinates = [x])]
impl Belt {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x * q.x
    }

    fn law(&self, v: &Velocities) -> f64 {
        self.kinetic + (self.fixed - self.kinetic) * (-((v.x - self.speed) / self.width).powi(2)).exp()
    }

    #[friction(limit = law)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - self.speed
    }
}

/// The same, which says once more what holds at rest.
struct Repeated(Belt);

#[lagrangian(coordinates = [x])]
impl Repeated {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.0.stiffness * q.x * q.x
    }

    fn law(&self, v: &Velocities) -> f64 {
        self.0.kinetic
            + (self.0.fixed - self.0.kinetic) * (-((v.x - self.0.speed) / self.0.width).powi(2)).exp()
    }

    #[friction(limit = law, static_limit = self.0.fixed)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - self.0.speed
    }
}

/// The bound that the static value is no less than the kinetic one is then zero at rest, with the rounding
/// errors of the law.
#[test]
fn the_static_value_may_be_that_of_the_law_at_rest() {
    let mut samples = Samples::new(61);
    for _ in 0..40 {
        let belt = Belt::sample(&mut samples);
        let start = State::new([0.0], [belt.speed]);
        let mut motion = belt.simulate(start).with_tolerance(1e-11);
        let lets_go = motion.advance_to_switch(99.0).unwrap().expect("the spring pulls it loose");
        close(lets_go.state.t, belt.fixed / (belt.stiffness * belt.speed), 1e-12);
        let expected = *motion.advance_to(lets_go.state.t + 3.0).unwrap();
        let repeated = Repeated(belt);
        let mut motion = repeated.simulate(start).with_tolerance(1e-11).with_max_steps(10_000);
        let end = motion.advance_to(expected.t).unwrap();
        close_on(1.0, end.q[0], expected.q[0], 1e-7);
        close_on(1.0, end.v[0], expected.v[0], 1e-6);
    }
}

/// A block on a spring, with a law whose peak is the limit at rest.
struct Peak;

#[lagrangian(coordinates = [x])]
impl Peak {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        10.0 * q.x.powi(2)
    }

    fn law(&self, v: &Velocities) -> f64 {
        1.0 + 0.5 * (-v.x.abs() / 0.1).exp()
    }

    #[friction(limit = law, static_limit = 1.5)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_limit_at_rest_may_be_the_peak_of_the_law_at_any_time() {
    for speed in (0..20).map(|i| 0.5 + 0.05 * f64::from(i)) {
        let start = State::new([0.0], [speed]);
        let expected = Peak.simulate(start).advance_to(3.0).unwrap().q[0];
        for time in [10.0, 100.0, 1e3, 1e4, 1e6, -1e5] {
            let found = Peak.simulate(start.at_time(time)).advance_to(time + 3.0).unwrap().q[0];
            // The time at which a slip ends has rounding errors, and in these the friction changes.
            close_on(1.0, found, expected, 1e-9 + 1e2 * f64::EPSILON * time.abs());
        }
    }
}
