//! Lanes that shorten their steps: beside a flat position, and before a wall that series do not see.

use lagrangian::prelude::*;
use lagrangian::wide::f64x4;
use lagrangian::{Batch, Lanes};

/// A parallelogram of three bars by their angles; the closing hinge is two constraints, which the flat
/// position makes one.
struct Bars<R> {
    ground: R,
}

#[lagrangian(coordinates = [angle: [3]])]
impl<R: Real> Bars<R> {
    fn along(angle: R) -> Vector2<R> {
        Vector2::new(angle.cos(), angle.sin())
    }

    #[body(mass = R::one(), inertia = R::from_f64(0.1))]
    fn bars(&self, q: &Coordinates<R>) -> [(Vector2<R>, R); 3] {
        let tip = Self::along(q.angle[0]);
        [
            (tip * 0.5, q.angle[0]),
            (tip + Self::along(q.angle[1]) * (0.5 * self.ground), q.angle[1]),
            (Vector2::new(self.ground, R::zero()) + Self::along(q.angle[2]) * 0.5, q.angle[2]),
        ]
    }

    #[holonomic]
    fn hinge(&self, q: &Coordinates<R>) -> Vector2<R> {
        Self::along(q.angle[0]) + Self::along(q.angle[1]) * self.ground
            - Self::along(q.angle[2])
            - Vector2::new(self.ground, R::zero())
    }
}

#[test]
fn every_lane_passes_a_flat_position_on_its_branch() {
    let bars = Bars { ground: Lanes::<f64x4>::from([1.3, 1.3, 1.7, 2.0]) };
    for k in 0..20 {
        // From further before the flat position to behind it.
        let angle = [0, 1, 2, 3].map(|i| -0.1 + 0.009 * f64::from(k) + 0.003 * f64::from(i));
        let (angle, speed) = (Lanes::from(angle), Lanes::from([5.0, 4.0, 3.0, 6.0]));
        let none = angle - angle;
        let start = State::new([angle, none, angle], [speed, none, speed]);
        let energy = bars.energy(&start);
        let mut batch = Batch::new(&bars, start);
        let end = *batch.advance_to(0.5).unwrap_or_else(|error| panic!("{k}: {error}"));
        let [a, b, c] = end.q.map(<[f64; 4]>::from);
        let change = <[f64; 4]>::from(bars.energy(&end) / energy);
        for lane in 0..4 {
            assert!((change[lane] - 1.0).abs() < 1e-8, "{k}, lane {lane}: {}", change[lane]);
            assert!(b[lane].abs() + (a[lane] - c[lane]).abs() < 1e-7, "{k}, lane {lane}: {b:?}");
        }
    }
}

/// A particle before a steep wall of potential energy, which Taylor series do not see from afar.
struct Wall<R> {
    mass: R,
    steepness: R,
}

#[lagrangian(coordinates = [x])]
impl<R: Real> Wall<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn wall(&self, q: &Coordinates<R>) -> R {
        (-self.steepness * q.x).exp()
    }
}

#[test]
fn a_lane_may_meet_a_wall_when_others_have_arrived() {
    let steepness = Lanes::<f64x4>::from([200.0, 2000.0, 500.0, 1000.0]);
    let wall = Wall { mass: Lanes::from([1.0; 4]), steepness };
    for k in 0..10 {
        // The first goes away from the wall, the others come to it at different times, the last too late.
        let speeds = [1.0, -1.0 - 0.01 * f64::from(k), -0.8, -0.3];
        let start = State::new([Lanes::from([1.0; 4])], [Lanes::from(speeds)]);
        let mut batch = Batch::new(&wall, start);
        let end = *batch.advance_to(1.5).unwrap_or_else(|error| panic!("{k}: {error}"));
        let speed = <[f64; 4]>::from(end.v[0]);
        for (lane, expected) in [1.0, 1.0 + 0.01 * f64::from(k), 0.8, -0.3].into_iter().enumerate() {
            assert!((speed[lane] - expected).abs() < 1e-8, "{k}, lane {lane}: {}", speed[lane]);
        }
    }
}
