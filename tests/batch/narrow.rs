//! Narrow functions in lanes: each lane meets them at places of its own.

use lagrangian::prelude::*;
use lagrangian::wide::{f64x4, f64x8};
use lagrangian::{Batch, Lanes};

/// A bump, detents and a fence, which turn a body back that has less energy than they are high.
struct Bumps<R> {
    width: R,
}

#[lagrangian(coordinates = [x, y, z])]
impl<R: Real> Bumps<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        0.5 * (v.x * v.x + v.y * v.y + v.z * v.z)
    }

    #[potential]
    fn bumps(&self, q: &Coordinates<R>) -> R {
        let detents = (-(q.y.sin() / self.width).powi(2)).exp();
        (-(q.x / self.width).powi(2)).exp() + detents + (1.0 + (q.z / self.width).tanh())
    }
}

#[test]
fn every_lane_meets_its_own() {
    let widths = [1e-2, 1e-5, 1e-3, 0.1, 1e-6, 3e-2, 1e-4, 0.3];
    let places = [-3.0, -9.0, -5.0, -5.0, -4.0, -3.3, -9.0, -7.0];
    let speeds = [0.7, 1.1, 0.3, 0.9, 1.2, 0.5, 0.8, 1.0];
    let bumps = Bumps::<Lanes<f64x8>> { width: widths.into() };
    let [place, speed] = [places, speeds].map(Lanes::from);
    let detent = Lanes::splat(1.2);
    let start = State::new([place, detent, place], [speed; 3]);
    for tolerance in [1e-6, 1e-10] {
        let end = *Batch::new(&bumps, start).with_tolerance(tolerance).advance_to(25.0).unwrap();
        let [x, y, z] = [end.v[0], end.q[1], end.v[2]].map(<[f64; 8]>::from);
        for lane in 0..8 {
            let (found, expected) = ([x[lane], z[lane]], -speeds[lane]);
            assert!(
                found.iter().all(|v| (v - expected).abs() < 1e4 * tolerance),
                "{lane}: {found:?} {expected}"
            );
            assert!(0.0 < y[lane] && y[lane] < core::f64::consts::PI, "{lane}: {}", y[lane]);
        }
    }
}

/// The motions of one start in lanes of different lengths agree with the motion alone.
#[test]
fn lanes_agree_with_a_motion_alone() {
    let alone = Bumps { width: 1e-3 };
    let start = State::new([-4.0, 1.0, -6.0], [0.8, 0.9, 0.7]);
    let expected = *alone.simulate(start).with_tolerance(1e-12).advance_to(30.0).unwrap();
    let bumps = Bumps::<Lanes<f64x4>> { width: Lanes::splat(1e-3) };
    let wide = State::new(start.q.map(Lanes::splat), start.v.map(Lanes::splat));
    let found = *Batch::new(&bumps, wide).with_tolerance(1e-12).advance_to(30.0).unwrap();
    for (found, expected) in found.iter().zip(expected.iter()) {
        assert!(
            <[f64; 4]>::from(found).iter().all(|found| (found - expected).abs() < 1e-7),
            "{found:?} {expected}"
        );
    }
}
