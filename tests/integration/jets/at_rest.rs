//! Motions from rest at an equilibrium, where forces leave nothing but their rounding errors, and motions that
//! such errors turn.

use lagrangian::prelude::*;
use lagrangian::{Batch, Equilibrium, Smooth};

use crate::support::sample::Samples;

macro_rules! hangs {
    ($name:ident, |$this:tt, $q:ident| $potential:expr) => {
        struct $name {
            mass: f64,
            stiffness: f64,
        }

        #[lagrangian(coordinates = [x, y], jacobians)]
        impl $name {
            #[point(mass = self.mass)]
            fn weight(&$this, $q: &Coordinates) -> Vector2<f64> {
                Vector2::new($q.x, $q.y)
            }

            #[potential]
            fn potential(&$this, $q: &Coordinates) -> f64 {
                $potential
            }
        }
    };
}

hangs!(Linear, |self, q| self.mass * 9.81 * (q.x + q.y)
    + 0.5 * self.stiffness * (q.x * q.x + q.x * q.y + q.y * q.y));
hangs!(Cable, |self, q| self.mass * 9.81 * q.y
    + 0.5
        * self.stiffness
        * (((q.x - 1.0).hypot(q.y) - 0.7).powi(2) + ((q.x + 1.0).hypot(q.y) - 0.8).powi(2)));
hangs!(Morse, |self, q| self.mass * 9.81 * (q.x - q.y)
    + self.stiffness
        * ((1.0 - (0.7 - q.x).exp()).powi(2) + (1.0 - (q.y + 0.4).exp()).powi(2) + 0.1 * q.x * q.y));

/// Whether a motion from an equilibrium rests there for two seconds, alone, in a lane, backward and by
/// Dormand and Prince's method. The fastest takes some twenty steps for an oscillation.
fn rests<S>(system: &S, found: Equilibrium<f64, 2, 0>, tolerance: f64)
where
    S: Smooth<2, Scalar = f64, Method = Jets>,
{
    let start = found.state;
    let near = |state: State<f64, 2>| {
        let far = (0..2).map(|i| (state.q[i] - start.q[i]).abs()).fold(0.0, f64::max);
        assert!(far < 1e-13 * (1.0 + start.q[0].abs() + start.q[1].abs()), "{far:e} at {tolerance:e}");
    };
    for end in [2.0, -2.0] {
        near(*system.simulate(start).with_tolerance(tolerance).with_max_steps(400).advance_to(end).unwrap());
    }
    let mut lane = Batch::new(system, start).with_tolerance(tolerance).with_max_steps(400);
    near(*lane.advance_to(2.0).unwrap());
    let other = system.simulate_with::<Dop853>(start).with_tolerance(tolerance);
    near(*other.with_max_steps(20_000).advance_to(2.0).unwrap());
}

#[test]
fn a_body_stays_at_its_equilibrium() {
    let mut samples = Samples::new(7);
    for round in 0..60 {
        let (mass, stiffness) = (samples.number(0.1, 1.0), samples.number(20.0, 200.0));
        let tolerance = [1e-3, 1e-6, 1e-10, 1e-13][round % 4];
        let linear = Linear { mass, stiffness };
        rests(&linear, linear.equilibrium([0.1, -0.1], &[]).unwrap(), tolerance);
        let cable = Cable { mass, stiffness };
        rests(&cable, cable.equilibrium([0.1, -0.5], &[]).unwrap(), tolerance);
        let morse = Morse { mass, stiffness };
        rests(&morse, morse.equilibrium([0.7, -0.4], &[]).unwrap(), tolerance);
    }
}

/// A car on one tyre whose side force saturates.
struct Car {
    grip: f64,
}

#[lagrangian(coordinates = [x, y, psi])]
impl Car {
    #[body(mass = 1.0, inertia = 1.0)]
    fn car(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.psi)
    }

    fn front(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y) + Rotation2::new(q.psi) * Vector2::new(1.0, 0.0)
    }

    #[force(at = front)]
    fn tyre(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let turned = Rotation2::new(q.psi);
        let slip = turned.inverse() * self.front_velocity(q, v);
        turned * Vector2::new(0.0, -self.grip * (slip.y / slip.x).atan())
    }
}

#[test]
fn a_car_that_starts_straight_ahead_goes_on_so() {
    let mut samples = Samples::new(8);
    for round in 0..80 {
        let tolerance = [1e-6, 1e-8, 1e-10, 1e-12][round % 4];
        let car = Car { grip: 10_f64.powf(samples.number(-1.0, 2.0)) };
        let (heading, speed) = (samples.number(-3.0, 3.0_f64), samples.number(1.0, 40.0));
        let start = State::new([0.0, 0.0, heading], [speed * heading.cos(), speed * heading.sin(), 0.0]);
        let mut motion = car.simulate(start).with_tolerance(tolerance).with_max_steps(200);
        let end = *motion.advance_to(0.2).unwrap();
        assert!((end.q[2] - heading).abs() < 1e-12, "{round}: {end:?}");
    }
}
