//! Roots and denominators that vanish on a motion: points that meet, angles that fold, walls that a body must
//! not pass, however weak they are from afar.

use lagrangian::prelude::*;
use lagrangian::{Batch, Smooth};

use super::line::line;
use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

/// A mass on a spring that is anchored at the origin of the plane.
struct Spring {
    stiffness: f64,
    length: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Spring {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * (self.mass(q).norm() - self.length).powi(2)
    }
}

#[test]
fn a_mass_passes_the_anchor_of_its_spring() {
    let mut samples = Samples::new(1);
    for _ in 0..60 {
        let tolerance = 10_f64.powf(samples.number(-12.0, -5.0));
        let spring = Spring { stiffness: samples.number(1.0, 20.0), length: samples.number(0.2, 0.5) };
        let (angle, speed) = (samples.number(-3.0, 3.0_f64), samples.number(0.0, 1.0));
        let far = 2.5 * spring.length;
        let along = |size: f64| [size * angle.cos(), size * angle.sin()];
        let start = State::new(along(far), along(-speed));
        let mut motion = spring.simulate(start).with_tolerance(tolerance);
        let end = *motion.advance_to(2.0).unwrap();
        close_on(1.0, motion.energy(), spring.energy(&start), 1e3 * tolerance);
        // The direction is that of the start, up to its rounding errors, which grow at each passage.
        close_on(1.0, end.q[0] * angle.sin(), end.q[1] * angle.cos(), 1e-9 + 1e2 * tolerance);
    }
}

line!(Root { pull }, |self, q, _v, _t| self.pull * (q.x * q.x).sqrt(), 0.0);
line!(Norm { pull }, |self, q, _v, _t| self.pull * Vector2::new(q.x, 0.0).norm(), 0.0);
line!(Fold { pull }, |self, q, _v, _t| self.pull * q.x.cos().acos(), 0.0);
line!(Hinge { pull }, |self, q, _v, _t| self.pull * (1.0 - q.x.cos().powi(2)).sqrt(), 0.0);
line!(Absolute { pull }, |self, q, _v, _t| self.pull * q.x.abs(), 0.0);
line!(Sine { pull }, |self, q, _v, _t| self.pull * q.x.sin().abs(), 0.0);
line!(Near { most }, |self, q, _v, _t| (1.0 - (self.most * q.x.cos()).powi(2)).sqrt(), 0.0);
line!(Inverse { push }, |self, q, _v, _t| self.push / (2.0 - q.x), 0.0);
line!(Square { push }, |self, q, _v, _t| self.push / (q.x - 2.0).powi(2), 0.0);

/// The end of a motion.
fn end<S>(system: &S, start: State<f64, 1>, tolerance: f64, t: f64) -> State<f64, 1>
where
    S: System<1, Scalar = f64>,
{
    *system.simulate(start).with_tolerance(tolerance).advance_to(t).unwrap()
}

#[test]
fn roots_of_squares_are_absolute_values() {
    let mut samples = Samples::new(2);
    for _ in 0..60 {
        let tolerance = 10_f64.powf(samples.number(-11.0, -5.0));
        let pull = samples.number(0.5, 3.0);
        let start = State::new([samples.number(0.1, 1.0)], [samples.number(-1.0, 1.0)]);
        let expected = end(&Absolute { pull }, start, 1e-13, 3.0);
        for found in [end(&Root { pull }, start, tolerance, 3.0), end(&Norm { pull }, start, tolerance, 3.0)]
        {
            // A kink behind a square is known to about √ε of the way: 6 of 4000 draws at 1e-11 are worse.
            let bound = 1e3 * tolerance + 4.0 * f64::EPSILON.sqrt();
            close_on(1.0, found.q[0], expected.q[0], bound);
        }
        // This one folds at π as well.
        if expected.q[0].abs() < 1.0 && start.v[0].abs() < 1.0 && pull > 1.0 {
            // The cosine of a small angle has lost half of its digits.
            let bound = 1e3 * tolerance + 1e-6;
            close_on(1.0, end(&Fold { pull }, start, tolerance, 3.0).q[0], expected.q[0], bound);
        }
        let expected = end(&Sine { pull }, start, 1e-13, 3.0);
        close_on(
            1.0,
            end(&Hinge { pull }, start, tolerance, 3.0).q[0],
            expected.q[0],
            1e3 * tolerance + 1e-7,
        );
    }
}

#[test]
fn angles_do_not_turn_about_unseen() {
    // The force is constant from kink to kink, so that a series is good for any number of turns.
    let mut samples = Samples::new(5);
    for _ in 0..300 {
        let tolerance = 10_f64.powf(samples.number(-9.0, -5.0));
        let fold = Fold { pull: samples.number(0.5, 3.0) };
        let start = State::new([samples.number(0.1, 1.0)], [samples.number(-1.0, 1.0)]);
        let alone = end(&fold, start, tolerance, 3.0);
        let mut lane = Batch::new(&fold, start).with_tolerance(tolerance);
        for found in [alone, *lane.advance_to(3.0).unwrap()] {
            // The cosine of a small angle has lost half of its digits.
            close_on(1.0, fold.energy(&found), fold.energy(&start), 1e3 * tolerance + 1e-6);
        }
    }
}

#[test]
fn roots_that_hardly_vanish_keep_the_energy() {
    let mut samples = Samples::new(3);
    for _ in 0..60 {
        let tolerance = 10_f64.powf(samples.number(-11.0, -5.0));
        let near = Near { most: 1.0 - 10_f64.powf(samples.number(-12.0, -2.0)) };
        let start = State::new([samples.number(0.1, 1.0)], [samples.number(1.0, 2.0)]);
        let mut motion = near.simulate(start).with_tolerance(tolerance);
        motion.advance_to(5.0).unwrap();
        // The root of what is left of one has lost digits.
        close_on(1.0, motion.energy(), near.energy(&start), 1e4 * tolerance + 1e-9);
    }
}

#[test]
fn weak_walls_are_walls() {
    let mut samples = Samples::new(4);
    for _ in 0..60 {
        let tolerance = 10_f64.powf(samples.number(-9.0, -6.0));
        let (speed, push) = (samples.number(0.5, 2.0), tolerance * 10_f64.powf(samples.number(-1.0, 2.0)));
        let start = State::new([0.0], [speed]);
        turned(&Inverse { push }, start, tolerance);
        turned(&Square { push }, start, tolerance);
    }
}

/// A body that comes to a wall turns back with its speed, alone and in a lane, or the motion ends with an error
/// where numbers do not resolve the wall.
fn turned<S>(system: &S, start: State<f64, 1>, tolerance: f64)
where
    S: Smooth<1, Scalar = f64, Method = Jets>,
{
    let until = 4.0 / start.v[0];
    let alone = system.simulate(start).with_tolerance(tolerance).advance_to(until).map(|state| state.v[0]);
    let lane = Batch::new(system, start).with_tolerance(tolerance).advance_to(until).map(|state| state.v[0]);
    for found in [alone, lane] {
        match found {
            Ok(speed) => close(speed, -start.v[0], 0.02),
            Err(error) => assert_eq!(error.cause, Cause::StepTooSmall),
        }
    }
}

/// A force of one size towards a place, or away from it.
struct Towards {
    force: f64,
}

#[lagrangian(coordinates = [x])]
impl Towards {
    #[point(mass = 1.0)]
    fn body(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[force(on = x)]
    fn pull(&self, q: &Coordinates) -> f64 {
        let way = q.x - 1.0;
        self.force * way / (way * way).sqrt()
    }
}

#[test]
fn a_step_that_ends_where_a_force_has_no_direction_is_followed_by_others() {
    let mut samples = Samples::new(9);
    for round in 0..300 {
        let force = samples.number(-2.0, 2.0);
        let (x, v) = (samples.number(0.2, 0.9), samples.number(2.0, 5.0_f64));
        let there = (v * v - 2.0 * force * (1.0 - x)).sqrt();
        let end = (v - there) / force + 0.5;
        let tolerance = [1e-6, 1e-8, 1e-10][round % 3];
        let towards = Towards { force };
        let mut motion = towards.simulate(State::new([x], [v])).with_tolerance(tolerance);
        let found = *motion.advance_to(end).unwrap();
        // A square hides from sums what is nearer to its zero than the root of a rounding.
        let known = tolerance.max(f64::EPSILON.sqrt());
        close_on(1.0, found.q[0], 1.0 + 0.5 * there + 0.125 * force, 1e2 * known);
    }
}
