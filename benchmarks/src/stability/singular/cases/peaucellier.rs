//! Peaucellier's cell: two long rods from a fixed hinge, four short ones in a rhombus, and a crank that leads
//! a joint of it on a circle through the fixed hinge, so that the opposite joint moves on a straight line.
//! Where the rhombus is flat the long rods lie on each other, and could go on as one.

use lagrangian::prelude::*;

use super::super::curve::{Point, offsets, run};
use super::Starts;

/// By the places of the four joints: the led one, the two at the long rods, the one on the line; 1 kg each.
#[derive(Clone, Copy, Debug)]
pub struct Cell;

/// Length of the long rods, of the short ones, and of the crank [m].
const LONG: f64 = 2.0;
const SHORT: f64 = 0.8;
const CRANK: f64 = 0.9;

#[lagrangian(coordinates = [joint: [8]])]
impl Cell {
    #[point(mass = 1.0)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 4] {
        [
            Vector2::new(q.joint[0], q.joint[1]),
            Vector2::new(q.joint[2], q.joint[3]),
            Vector2::new(q.joint[4], q.joint[5]),
            Vector2::new(q.joint[6], q.joint[7]),
        ]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (q.joint[1] + q.joint[3] + q.joint[5] + q.joint[7])
    }

    fn rod(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
        (a - b).norm_squared() - SHORT * SHORT
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 7] {
        let [led, left, right, drawn] = self.joints(q);
        [
            (led - Vector2::new(CRANK, 0.0)).norm_squared() - CRANK * CRANK,
            left.norm_squared() - LONG * LONG,
            right.norm_squared() - LONG * LONG,
            Self::rod(led, left),
            Self::rod(led, right),
            Self::rod(drawn, left),
            Self::rod(drawn, right),
        ]
    }
}

/// By the angle of a long rod from the axis of the cell.
fn curve(s: f64) -> Point<8> {
    let (sin, cos) = s.sin_cos();
    let root = (SHORT * SHORT - LONG * LONG * sin * sin).sqrt();
    let root1 = -LONG * LONG * sin * cos / root;
    // Distances of the led and the drawn joint from the fixed hinge.
    let (near, near1) = (LONG * cos - root, -LONG * sin - root1);
    let (far, far1) = (LONG * cos + root, -LONG * sin + root1);
    // The axis of the cell, so that the led joint is on its circle.
    let share = near / (2.0 * CRANK);
    let (axis, axis1) = (share.acos(), -near1 / (2.0 * CRANK) / (1.0 - share * share).sqrt());
    let place = |r: f64, r1: f64, angle: f64, angle1: f64| {
        let (sin, cos) = angle.sin_cos();
        ([r * cos, r * sin], [r1 * cos - r * sin * angle1, r1 * sin + r * cos * angle1])
    };
    let joints = [
        place(near, near1, axis, axis1),
        place(LONG, 0.0, axis + s, axis1 + 1.0),
        place(LONG, 0.0, axis - s, axis1 - 1.0),
        place(far, far1, axis, axis1),
    ];
    (std::array::from_fn(|i| joints[i / 2].0[i % 2]), std::array::from_fn(|i| joints[i / 2].1[i % 2]))
}

/// Through the flat position; the rods unfold at 2 rad/s.
pub fn starts(count: usize) -> Starts<Cell, 8> {
    let runs = offsets(count).filter_map(|d| run(Cell, curve, d, 2.0, 0.1, 0.6));
    Starts { name: "peaucellier", runs: runs.collect() }
}
