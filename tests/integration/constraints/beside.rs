//! Rows that depend on each other on the constraints, and on no state beside them.

use std::f64::consts::FRAC_PI_2;

use lagrangian::prelude::*;

use crate::support::close::{all_close, close_on};

/// A particle on a cylinder, which one constraint demands.
struct Once;

/// The same, demanded a second time with a factor that varies.
struct Twice;

macro_rules! cylinder {
    ($name:ident, $rows:literal $(, $factor:literal)?) => {
        #[lagrangian(coordinates = [x, y, z])]
        impl $name {
            #[point(mass = 1.0)]
            fn place(&self, q: &Coordinates) -> Vector3<f64> {
                Vector3::new(q.x, q.y, q.z)
            }

            #[potential]
            fn field(&self, q: &Coordinates) -> f64 {
                9.81 * q.x + 2.0 * q.z * q.z + 0.5 * q.z * q.y
            }

            #[holonomic]
            fn surface(&self, q: &Coordinates) -> [f64; $rows] {
                let off = q.x * q.x + q.y * q.y - 1.0;
                [off $(, off * (q.z + $factor))?]
            }
        }
    };
}

cylinder!(Once, 1);
cylinder!(Twice, 2, 3.0);

#[test]
fn fixed_steps_are_those_of_one_row() {
    let start = State::new([0.6, 0.8, 0.3], [0.8, -0.6, 1.0]);
    let mut once = Once.simulate(start).with_tolerance(1e-14);
    let expected = *once.advance_to(10.0).unwrap();
    macro_rules! check {
        ($method:ty, $step:expr, $accuracy:expr) => {
            let mut twice = Twice.stepper::<$method>(start);
            for _ in 0..(10.0_f64 / $step).round() as usize {
                twice.step($step, &[]).unwrap();
            }
            all_close(twice.state().q, expected.q, $accuracy);
            all_close(twice.state().v, expected.v, 2.0 * $accuracy);
        };
    }
    check!(Rk4, 0.01, 1e-5);
    check!(Rk4, 0.001, 1e-9);
    check!(Jet<6>, 0.01, 1e-8);
}

#[test]
fn adaptive_steps_are_those_of_one_row() {
    let start = State::new([0.6, 0.8, 0.3], [0.8, -0.6, 1.0]);
    let expected = *Once.simulate(start).with_tolerance(1e-14).advance_to(10.0).unwrap();
    let mut jets = Twice.simulate(start).with_tolerance(1e-13);
    all_close(jets.advance_to(10.0).unwrap().q, expected.q, 1e-11);
    let mut dop853 = Twice.simulate_with::<Dop853>(start).with_tolerance(1e-13);
    all_close(dop853.advance_to(10.0).unwrap().q, expected.q, 1e-10);
}

/// Six bars and six hinges in a ring. The last bar returns turned by half a turn, where the skew part of a
/// rotation matrix vanishes whatever its axis is: three rows of rank one.
struct Ring;

/// The same with one of the three.
struct Lean;

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

fn ring() -> State<f64, 6> {
    Ring.consistent(State::at_rest([-1.746, 2.277, 1.395, 1.898, 1.395, 2.277])).unwrap()
}

/// The second angle after one second.
fn after_one_second() -> f64 {
    Lean.simulate(ring()).with_tolerance(1e-14).advance_to(1.0).unwrap().q[1]
}

/// A function of its own: the tables are large, and without optimisation a frame holds several copies.
fn advanced(state: State<f64, 6>, tolerance: f64, t: f64) -> State<f64, 6> {
    *Ring.simulate(state).with_tolerance(tolerance).advance_to(t).unwrap()
}

#[test]
fn a_ring_of_rank_four_keeps_its_energy_at_any_tolerance() {
    let (start, expected) = (ring(), after_one_second());
    assert!(!Ring.reactions(&start).unwrap().are_unique());
    let energy = Ring.energy(&start);
    for tolerance in [1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13] {
        // At 0.853 s the gradients of two of the three rows nearly vanish.
        let mut state = start;
        for t in [0.8, 0.85, 0.853, 0.86, 1.0] {
            state = advanced(state, tolerance, t);
            close_on(1.0, Ring.energy(&state), energy, 1e2 * tolerance + 1e-12);
        }
        close_on(1.0, state.q[1], expected, 1e-11 + 10.0 * tolerance);
    }
}

#[test]
fn the_ring_keeps_its_energy_in_fixed_steps() {
    let (start, expected) = (ring(), after_one_second());
    let energy = Ring.energy(&start);
    let mut rk4 = Ring.stepper::<Rk4>(start);
    let mut jet = Ring.stepper::<Jet<6>>(start);
    for _ in 0..200 {
        rk4.step(0.005, &[]).unwrap();
        jet.step(0.005, &[]).unwrap();
    }
    close_on(1.0, rk4.energy(), energy, 1e-5);
    close_on(1.0, jet.energy(), energy, 1e-9);
    for end in [rk4.state(), jet.state()] {
        close_on(1.0, end.q[1], expected, 1e-6);
    }
}
