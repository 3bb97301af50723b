//! Gaps and switches that are narrow beside a step: bumps and steps of the ground, zones of a force.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// A ball over a ground with a narrow feature at x = 0.
macro_rules! ground {
    ($name:ident, |$self:ident, $x:ident| $height:expr) => {
        struct $name {
            width: f64,
            height: f64,
            gravity: f64,
        }

        #[lagrangian(coordinates = [x, y])]
        impl $name {
            #[point(mass = 1.0)]
            fn ball(&self, q: &Coordinates) -> Vector2<f64> {
                Vector2::new(q.x, q.y)
            }

            #[potential]
            fn weight(&self, q: &Coordinates) -> f64 {
                self.gravity * q.y
            }

            #[unilateral(restitution = 0.5)]
            fn ground(&$self, q: &Coordinates) -> f64 {
                let $x = q.x / $self.width;
                q.y - $self.height * $height
            }
        }
    };
}

ground!(Bump, |self, x| (-x * x).exp());
ground!(Stair, |self, x| 0.5 * (1.0 + x.tanh()));
ground!(Ridge, |self, x| 1.0 / (1.0 + x * x).powi(3));

/// Compares a flight towards the feature from afar with one that begins beside it.
macro_rules! compare {
    ($samples:ident, $($name:ident)*) => {$({
        let width = 10_f64.powf($samples.number(-4.0, -0.5));
        let tolerance = 10_f64.powf($samples.number(-12.0, -6.0));
        let height = $samples.number(0.3, 1.0);
        let (distance, speed) = ($samples.number(3.0, 30.0), $samples.number(0.5, 3.0));
        let scene = $name { width, height, gravity: $samples.number(-1.0, 1.0).max(0.0) };
        // Where the ball would fly past the feature.
        let (at_x, low) = (distance / speed, height * $samples.number(0.2, 0.8));
        let at = |t: f64| {
            let y = low + 0.5 * scene.gravity * (at_x * at_x - t * t);
            State { t, q: [-distance + speed * t, y], v: [speed, -scene.gravity * t] }
        };
        let until = at_x + 0.1 / speed;
        let near = at((distance - 3.0 * width) / speed);
        let [end, expected] = [at(0.0), near].map(|start| {
            *scene.simulate(start).with_tolerance(tolerance).advance_to(until).unwrap()
        });
        // The normal turns by one over a width.
        let bound = 1e3 * tolerance * distance / width;
        assert!(expected.q[0] < 10.0 * width, "{} {width}: {expected:?}", stringify!($name));
        if bound < 0.1 {
            for (found, expected) in end.v.iter().zip(&expected.v) {
                close_on(1.0, *found, *expected, bound);
            }
        } else {
            assert!(end.q[0] < 10.0 * width, "{} {width} {tolerance}: {end:?}", stringify!($name));
        }
    })*};
}

#[test]
fn balls_meet_narrow_features_of_the_ground() {
    let mut samples = Samples::new(1);
    for _ in 0..60 {
        compare!(samples, Bump Stair Ridge);
    }
}

/// A mass on a line that is pushed inside a narrow zone.
struct Zone {
    width: f64,
    work: f64,
}

#[lagrangian(coordinates = [x])]
impl Zone {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[force(on = x)]
    fn push(&self, q: &Coordinates) -> f64 {
        if (-(q.x / self.width).powi(2)).exp() > 0.5 { self.work / self.width } else { 0.0 }
    }
}

#[test]
fn narrow_zones_do_their_work() {
    let mut samples = Samples::new(2);
    for _ in 0..60 {
        let width = 10_f64.powf(samples.number(-6.0, -0.5));
        let tolerance = 10_f64.powf(samples.number(-13.0, -5.0));
        let zone = Zone { width, work: samples.number(0.1, 1.0) };
        let (distance, speed) = (samples.number(1.0, 30.0), samples.number(0.5, 3.0));
        let start = State::new([-distance], [speed]);
        let mut motion = zone.simulate(start).with_tolerance(tolerance);
        let end = motion.advance_to(2.0 * distance / speed).unwrap();
        let gain = 2.0 * zone.work * 2.0_f64.ln().sqrt();
        // Where the zone begins and ends is rounded like the place of the mass.
        let bound = 1e3 * tolerance + 16.0 * f64::EPSILON * distance / width;
        close_on(1.0, 0.5 * end.v[0].powi(2) - 0.5 * speed * speed, gain, bound);
    }
}
