//! Bricard's ring of six bars and six hinges, its closure as more rows than it needs: three for a rotation of
//! which one is independent, and two of those nearly vanish in the course of the motion.

use std::f64::consts::FRAC_PI_2;

use lagrangian::prelude::*;

use super::super::curve::offsets;
use super::super::runs::Run;
use super::Starts;

/// With three rows for the rotation.
#[derive(Clone, Copy, Debug)]
pub struct Ring;

/// With the one that is enough.
#[derive(Clone, Copy, Debug)]
pub struct Lean;

macro_rules! ring {
    ($name:ident, $rows:literal) => {
        #[lagrangian(coordinates = [h: [6]])]
        impl $name {
            fn joints(&self, q: &Coordinates) -> ([Vector3<f64>; 6], Rotation3<f64>) {
                let (mut turn, mut place) = (Rotation3::identity(), Vector3::zeros());
                let mut joints = [Vector3::zeros(); 6];
                for k in 0..6 {
                    turn *= Rotation3::from_axis_angle(&Vector3::z_axis(), q.h[k]);
                    place += turn * Vector3::x();
                    let twist = if k % 2 == 0 { FRAC_PI_2 } else { -FRAC_PI_2 };
                    turn *= Rotation3::from_axis_angle(&Vector3::x_axis(), twist);
                    joints[k] = place;
                }
                (joints, turn)
            }

            #[point(mass = 1.0)]
            fn hinges(&self, q: &Coordinates) -> [Vector3<f64>; 5] {
                let (joints, _) = self.joints(q);
                [joints[0], joints[1], joints[2], joints[3], joints[4]]
            }

            #[potential]
            fn gravity(&self, q: &Coordinates) -> f64 {
                self.hinges(q).iter().map(|hinge| 9.81 * (hinge.y + 0.3 * hinge.x)).sum()
            }

            #[holonomic]
            fn place(&self, q: &Coordinates) -> [f64; 3] {
                let (joints, _) = self.joints(q);
                [joints[5].x, joints[5].y, joints[5].z]
            }

            #[holonomic]
            fn turn(&self, q: &Coordinates) -> [f64; $rows] {
                let (_, turn) = self.joints(q);
                let mut rows = [0.0; $rows];
                for (k, (i, j)) in [(0, 1), (0, 2), (1, 2)].into_iter().enumerate().take($rows) {
                    rows[k] = turn.matrix()[(i, j)] - turn.matrix()[(j, i)];
                }
                rows
            }
        }
    };
}

ring!(Ring, 3);
ring!(Lean, 1);

/// When the two rows nearly vanish [s].
const NARROW: f64 = 0.853;

/// Starts at times about [`NARROW`] of one motion from rest. The true motion is that of the lean ring,
/// tolerance 1e-14.
pub fn starts(count: usize) -> Starts<Ring, 6> {
    let rest = State::at_rest([-1.746, 2.277, 1.395, 1.898, 1.395, 2.277]);
    let Ok(rest) = Lean.consistent(rest) else { return Starts { name: "ring", runs: Vec::new() } };
    let mut lean = Lean.simulate(rest).with_tolerance(1e-14);
    let mut at = |t: f64| lean.advance_to(t).copied().ok();
    let run = |from: f64| {
        let start = at(NARROW + from)?.at_time(0.0);
        let regular = at(NARROW + from + 0.15)?.at_time(0.15);
        Some(Run { system: Ring, start, offset: from, regular, end: at(NARROW + from + 0.25)?.at_time(0.25) })
    };
    Starts { name: "ring", runs: offsets(count).filter_map(run).collect() }
}
