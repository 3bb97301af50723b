//! Peaucellier's cell through its flat position, where its rhombus of short rods lies on one line and its two
//! long rods on each other: at the finest tolerances, from starts so close to that position or so far from
//! it that roundings of the state have grown to whole tolerances where it is passed.

use lagrangian::prelude::*;

use crate::support::close::close_on;

/// Lengths of the long rods, of the short ones and of the crank [m].
const LONG: f64 = 2.0;
const SHORT: f64 = 0.8;
const CRANK: f64 = 0.9;

/// By the positions of the joint that the crank leads, of the two at the long rods, and of the one on the
/// line.
struct Cell;

#[lagrangian(coordinates = [led: [2], left: [2], right: [2], drawn: [2]])]
impl Cell {
    #[point(mass = 1.0)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 4] {
        [
            Vector2::new(q.led[0], q.led[1]),
            Vector2::new(q.left[0], q.left[1]),
            Vector2::new(q.right[0], q.right[1]),
            Vector2::new(q.drawn[0], q.drawn[1]),
        ]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (q.led[1] + q.left[1] + q.right[1] + q.drawn[1])
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 7] {
        let [led, left, right, drawn] = self.joints(q);
        let rod = |a: Vector2<f64>, b: Vector2<f64>, length: f64| (a - b).norm_squared() - length * length;
        [
            rod(led, Vector2::new(CRANK, 0.0), CRANK),
            rod(left, Vector2::zeros(), LONG),
            rod(right, Vector2::zeros(), LONG),
            rod(led, left, SHORT),
            rod(led, right, SHORT),
            rod(drawn, left, SHORT),
            rod(drawn, right, SHORT),
        ]
    }
}

/// The start at an angle of the left long rod from the axis of the cell that grows by 2 rad/s.
fn at(angle: f64) -> State<f64, 8> {
    let positions = |s: f64| {
        let root = (SHORT * SHORT - (LONG * s.sin()).powi(2)).sqrt();
        let (near, far) = (LONG * s.cos() - root, LONG * s.cos() + root);
        let axis = (near / (2.0 * CRANK)).acos();
        let at = |r: f64, angle: f64| [r * angle.cos(), r * angle.sin()];
        [at(near, axis), at(LONG, axis + s), at(LONG, axis - s), at(far, axis)]
    };
    let (sin, cos) = angle.sin_cos();
    let root = (SHORT * SHORT - (LONG * sin).powi(2)).sqrt();
    let (along, turning) = (-2.0 * LONG * sin, 2.0 * LONG * LONG * sin * cos / root);
    let (near, near_rate, far_rate) = (LONG * cos - root, along + turning, along - turning);
    let share = near / (2.0 * CRANK);
    let axis_rate = -near_rate / (2.0 * CRANK) / (1.0 - share * share).sqrt();
    let joints = positions(angle);
    let rates =
        [(near_rate, axis_rate), (0.0, axis_rate + 2.0), (0.0, axis_rate - 2.0), (far_rate, axis_rate)];
    let velocities: [_; 4] = core::array::from_fn(|k| {
        let ([x, y], (stretch, turn)) = (joints[k], rates[k]);
        let r = x.hypot(y);
        [stretch * x / r - turn * y, stretch * y / r + turn * x]
    });
    State::new(
        core::array::from_fn(|i| joints[i / 2][i % 2]),
        core::array::from_fn(|i| velocities[i / 2][i % 2]),
    )
}

/// Angles before and behind the flat position.
const ANGLES: [f64; 10] =
    [-1.2e-8, 1.175e-8, -9.25e-6, 6.26e-5, -7.3e-4, -1.624e-3, -1.22e-2, -2.745e-2, -5.68e-2, -6.677e-2];

/// Asserts that the cell is on its branch with its energy: the drawn joint is on the line of Peaucellier, and
/// the long rods are as far apart as the rods unfold at about 2 rad/s.
fn is_on_its_branch(start: &State<f64, 8>, end: &State<f64, 8>, begun: f64, tolerance: f64) {
    // Errors of a few tens of steps, with the rounding of states that end 1e-5 beside the position.
    let allowed = 100.0 * tolerance + f64::EPSILON / 1e-5;
    close_on(10.0, Cell.energy(end), Cell.energy(start), allowed);
    close_on(1.0, end.q[6], (LONG * LONG - SHORT * SHORT) / (2.0 * CRANK), allowed);
    let turn = end.q[3].atan2(end.q[2]) - end.q[5].atan2(end.q[4]);
    assert!((0.5 * turn - begun - 2.0 * end.t).abs() < 0.1, "{begun:e}: {turn}");
}

#[test]
fn the_finest_tolerances_pass_the_flat_position() {
    for angle in ANGLES {
        let start = at(angle);
        for tolerance in [1e-10, 1e-12, 1e-14] {
            let name = |error| panic!("{angle:e} at {tolerance:e}: {error}");
            let mut series = Cell.simulate(start).with_tolerance(tolerance).with_max_steps(1000);
            is_on_its_branch(&start, series.advance_to(0.1).unwrap_or_else(name), angle, tolerance);
            let mut stages =
                Cell.simulate_with::<Dop853>(start).with_tolerance(tolerance).with_max_steps(2000);
            is_on_its_branch(&start, stages.advance_to(0.1).unwrap_or_else(name), angle, tolerance);
        }
    }
}

#[test]
fn targets_close_by_do_not_keep_a_motion_at_the_flat_position() {
    for angle in [-1.2e-8, -7.3e-4, -6.677e-2] {
        let start = at(angle);
        let mut series = Cell.simulate(start).with_tolerance(1e-14);
        let mut stages = Cell.simulate_with::<Dop853>(start).with_tolerance(1e-14);
        for k in 1..=1000 {
            let t = 1e-4 * f64::from(k);
            let name = |error| panic!("{angle:e} at {t}: {error}");
            // Samples closer to the flat position than ends of steps have fewer digits.
            is_on_its_branch(&start, series.advance_to(t).unwrap_or_else(name), angle, 1e-12);
            is_on_its_branch(&start, stages.advance_to(t).unwrap_or_else(name), angle, 1e-12);
        }
    }
}
