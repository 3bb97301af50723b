//! Loads that exceed for a moment what friction holds: of one friction at any tolerance, of two that share a
//! load, of a slip in two directions.

use lagrangian::prelude::*;

use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

/// A mass on a line with a brake, or with two that hold as much together, under a load that swings.
macro_rules! braked {
    ($name:ident, $($brake:ident $share:literal)*) => {
        struct $name {
            load: f64,
            pace: f64,
        }

        #[lagrangian(coordinates = [x])]
        impl $name {
            #[point(mass = 1.0)]
            fn mass(&self, q: &Coordinates) -> Vector1<f64> {
                Vector1::new(q.x)
            }

            #[force(on = x)]
            fn swing(&self, t: f64) -> f64 {
                self.load * (self.pace * t).sin()
            }

            $(
                #[friction(limit = $share, static_limit = 2.0 * $share)]
                fn $brake(&self, v: &Velocities) -> f64 {
                    v.x
                }
            )*
        }
    };
}

braked!(One, brake 0.5);
braked!(Two, left 0.3 right 0.2);

#[test]
fn a_friction_lets_go_at_any_tolerance() {
    let mut samples = Samples::new(1);
    for _ in 0..200 {
        let tolerance = 10_f64.powf(samples.number(-12.0, -4.0));
        // The series of a load is within a few tolerances.
        let excess = 10_f64.powf(samples.number(-4.0, -0.5)).max(100.0 * tolerance);
        let (load, pace) = (1.0 + excess, samples.number(0.5, 8.0));
        let start = State::at_rest([0.0]);
        let until = samples.number(1.7, 3.6) / pace;
        let one = One { load, pace }.simulate(start).with_tolerance(tolerance).advance_to_switch(until);
        let two = Two { load, pace }.simulate(start).with_tolerance(tolerance).advance_to_switch(until);
        for (switch, frictions) in [(one, 1), (two, 2)] {
            let switch = switch.unwrap();
            let switch =
                switch.unwrap_or_else(|| panic!("{frictions}: {tolerance:e} {excess:e} {pace} {until}"));
            close(switch.state.t * pace, load.recip().asin(), 1e-9);
        }
    }
}

/// A puck on a table that a steady force and one that swings push, across each other.
struct Puck {
    steady: f64,
    load: f64,
    pace: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = 1.0)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[force(on = x)]
    fn swing(&self, t: f64) -> f64 {
        self.load * (self.pace * t).sin()
    }

    #[force(on = y)]
    fn push(&self) -> f64 {
        self.steady
    }

    #[friction(limit = 1.0)]
    fn table(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x, v.y)
    }
}

#[test]
fn a_puck_that_is_hardly_moved_stays_near() {
    let mut samples = Samples::new(2);
    let mut all = vec![(1e-6, 0.2, 1e-3, 3.0)];
    all.extend((0..20).map(|_| {
        let (tolerance, steady) = (10_f64.powf(samples.number(-8.0, -5.0)), samples.number(0.05, 0.9));
        // The less the excess, the more steps it takes: the direction of a slow slip turns fast.
        (tolerance, steady, 10_f64.powf(samples.number(-1.8, -0.5)), samples.number(0.5, 8.0))
    }));
    for (tolerance, steady, excess, pace) in all {
        let load = (1.0 - steady * steady).sqrt() * (1.0 + excess);
        let puck = Puck { steady, load, pace };
        let mut motion = puck.simulate(State::at_rest([0.0; 2])).with_tolerance(tolerance);
        let end = *motion.advance_to(3.0 / puck.pace).unwrap();
        // What the loads have beyond the limit, for as long as they have it, pushes it no further.
        let time = 2.0 * (2.0 * excess / (1.0 + excess)).sqrt() / puck.pace;
        let bound = 2.0 * excess * time * time;
        close_on(1.0, end.q[0].hypot(end.q[1]), 0.0, bound);
        assert!(end.q[0] > 0.0 && end.q[1] > 0.0, "{tolerance} {steady} {excess}: {end:?}");
    }
}
