//! Motions through configurations in which gradients of constraints become dependent. They go straight on and
//! keep their energy.
//!
//! The linkages have one degree of freedom, and a branch of their motions is known, so that a state on the
//! wrong branch is noticed.

use std::f64::consts::FRAC_PI_2;

use lagrangian::prelude::*;

use crate::support::close::{all_close, close_on};

/// A parallelogram of three bars by their angles; the closing hinge is two constraints, which the flat
/// position makes one.
#[derive(Clone, Copy)]
struct Bars {
    m: [f64; 3],
    l: f64,
    ground: f64,
}

#[lagrangian(coordinates = [angle: [3]])]
impl Bars {
    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    #[body(mass = self.m[..], inertia = [self.m[0] / 12.0, self.m[1] / 12.0, self.m[2] / 12.0])]
    fn bars(&self, q: &Coordinates) -> [(Vector2<f64>, f64); 3] {
        let tip = self.l * Self::along(q.angle[0]);
        [
            (0.5 * tip, q.angle[0]),
            (tip + 0.5 * self.ground * Self::along(q.angle[1]), q.angle[1]),
            (Vector2::new(self.ground, 0.0) + 0.5 * self.l * Self::along(q.angle[2]), q.angle[2]),
        ]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let bars = self.bars(q);
        9.81 * (self.m[0] * bars[0].0.y + self.m[1] * bars[1].0.y + self.m[2] * bars[2].0.y)
    }

    #[holonomic]
    fn hinge(&self, q: &Coordinates) -> Vector2<f64> {
        self.l * Self::along(q.angle[0]) + self.ground * Self::along(q.angle[1])
            - self.l * Self::along(q.angle[2])
            - Vector2::new(self.ground, 0.0)
    }
}

/// The same by the places of its two joints.
#[derive(Clone, Copy)]
struct Joints;

#[lagrangian(coordinates = [first: [2], second: [2]])]
impl Joints {
    #[point(mass = 1.0)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [Vector2::new(q.first[0], q.first[1]), Vector2::new(q.second[0], q.second[1])]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (q.first[1] + q.second[1])
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 3] {
        let [first, second] = self.joints(q);
        let ground = Vector2::new(1.0, 0.0);
        [
            first.norm_squared() - 1.0,
            (second - ground).norm_squared() - 1.0,
            (second - first).norm_squared() - 1.0,
        ]
    }
}

/// A coupler on three cranks: the flat position is singular, and two rows are redundant everywhere.
#[derive(Clone, Copy)]
struct Coupler;

#[lagrangian(coordinates = [t: [3], x, y, phi], allow(redundant))]
impl Coupler {
    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        v.t.iter().map(|w| w * w / 6.0).sum()
    }

    #[body(mass = 2.0, inertia = 0.4)]
    fn coupler(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * 2.0 * q.y
    }

    #[holonomic]
    fn hinges(&self, q: &Coordinates) -> [f64; 6] {
        let mut rows = [0.0; 6];
        for i in 0..3 {
            let at = 0.3 * i as f64 + 0.05 * (i * i) as f64;
            rows[2 * i] = q.x + at * q.phi.cos() - at - q.t[i].cos();
            rows[2 * i + 1] = q.y + at * q.phi.sin() - q.t[i].sin();
        }
        rows
    }
}

/// Starts 1e-8 … 0.1 rad before and behind the singular position, at 5 rad/s.
fn starts() -> impl Iterator<Item = f64> {
    (0..15).flat_map(|i| {
        let size = 10_f64.powf(-8.0 + 0.5 * f64::from(i));
        [size, -size]
    })
}

/// The error of a few tens of steps, with the rounding of states that end 1e-5 beside the position.
fn allowed(tolerance: f64) -> f64 {
    100.0 * tolerance + f64::EPSILON / 1e-5
}

/// Half a second by a method: the energy, and a function that vanishes on the branch.
macro_rules! passes {
    ($system:expr, $curve:expr, $off:expr, $method:ty, $tolerances:expr) => {
        for tolerance in $tolerances {
            for s in starts() {
                let system = $system;
                let (q, v) = $curve(s);
                let start = State::new(q, v);
                let kinetic = system.energy(&start) - system.energy(&State::at_rest(q));
                let mut motion = system.simulate_with::<$method>(start).with_tolerance(tolerance);
                let end =
                    *motion.advance_to(0.5).unwrap_or_else(|error| panic!("{s:e} at {tolerance:e}: {error}"));
                close_on(kinetic, system.energy(&end), system.energy(&start), allowed(tolerance));
                close_on(1.0, $off(&end), 0.0, 10.0 * allowed(tolerance));
            }
        }
    };
}

#[test]
fn a_parallelogram_of_bars_passes_its_flat_position() {
    let curve = |s: f64| ([s, 0.0, s], [5.0, 0.0, 5.0]);
    let off = |end: &State<f64, 3>| end.q[1].abs() + (end.q[0] - end.q[2]).abs();
    for (m, l, ground) in [([1.0; 3], 1.0, 1.0), ([0.5, 1.0, 2.5], 0.8, 1.3)] {
        passes!(Bars { m, l, ground }, curve, off, Jets, [1e-6, 1e-8, 1e-10, 1e-12, 1e-14]);
        passes!(Bars { m, l, ground }, curve, off, Dop853, [1e-6, 1e-10]);
    }
}

#[test]
fn a_parallelogram_of_joints_passes_its_flat_position() {
    let curve = |s: f64| {
        let (sin, cos) = s.sin_cos();
        ([cos, sin, 1.0 + cos, sin], [-5.0 * sin, 5.0 * cos, -5.0 * sin, 5.0 * cos])
    };
    let off = |end: &State<f64, 4>| (end.q[2] - end.q[0] - 1.0).abs() + (end.q[3] - end.q[1]).abs();
    passes!(Joints, curve, off, Jets, [1e-6, 1e-8, 1e-10, 1e-12, 1e-14]);
    passes!(Joints, curve, off, Dop853, [1e-6, 1e-10, 1e-12, 1e-14]);
}

#[test]
fn redundant_cranks_pass_their_flat_position() {
    let curve = |s: f64| {
        let (sin, cos) = s.sin_cos();
        ([s, s, s, cos, sin, 0.0], [5.0, 5.0, 5.0, -5.0 * sin, 5.0 * cos, 0.0])
    };
    let off =
        |end: &State<f64, 6>| end.q[5].abs() + (end.q[0] - end.q[1]).abs() + (end.q[0] - end.q[2]).abs();
    passes!(Coupler, curve, off, Jets, [1e-8, 1e-10, 1e-12, 1e-14]);
    passes!(Coupler, curve, off, Dop853, [1e-6, 1e-10, 1e-14]);
}

#[test]
fn what_lies_inside_a_passage_is_on_the_branch() {
    // So close to the flat position the stages of Dormand–Prince mean nothing: the first step is a series.
    for s in [1e-9, -1e-9] {
        let start = State::new([1.0, s, 2.0, s], [-5.0 * s, 5.0, -5.0 * s, 5.0]);
        let (mut series, mut stages) = (start, start);
        let mut expected = Joints.simulate(start).with_tolerance(1e-12);
        let mut motion = Joints.simulate_with::<Dop853>(start).with_tolerance(1e-12);
        for k in (1..=40).chain((1..40).rev()) {
            let t = 2.5e-3 * f64::from(k);
            series = *expected.advance_to(t).expect("series");
            stages = *motion.advance_to(t).expect("stages");
            all_close(stages.q, series.q, 1e-9);
            close_on(1.0, stages.q[3] - stages.q[1], 0.0, 1e-10);
        }
        close_on(25.0, Joints.energy(&stages), Joints.energy(&series), 1e-10);
    }
}

#[test]
fn the_velocity_decides_about_the_branch() {
    // Both branches of equal bars meet in the flat position: as a parallelogram, and with the second bar
    // turning about the end of the first, which lies in the other hinge of the ground.
    let system = Joints;
    let flat = [1.0, 0.0, 2.0, 0.0];
    for (v, branch) in [([0.0, 5.0, 0.0, 5.0], 0), ([0.0, 0.0, 0.0, 5.0], 1)] {
        let start = State::new(flat, v);
        let end = *system.simulate(start).advance_to(0.2).expect("a motion");
        close_on(10.0, system.energy(&end), system.energy(&start), 1e-8);
        let [first, second] = [Vector2::new(end.q[0], end.q[1]), Vector2::new(end.q[2], end.q[3])];
        let off = [(second - first - Vector2::x()).norm(), (first - Vector2::new(1.0, 0.0)).norm()];
        assert!(off[branch] < 1e-8, "{off:?}");
    }
    // A velocity between both branches belongs to no motion.
    let between = State::new(flat, [0.0, 5.0, 0.0, 2.0]);
    let error = system.simulate(between).advance_to(0.2).expect_err("no motion");
    assert!(matches!(error.cause, Cause::Undetermined { .. }), "{error}");
}

#[test]
fn an_upright_start_is_on_no_branch_in_particular() {
    // Away from the flat position nothing is special.
    let start = State::new([FRAC_PI_2, 0.0, FRAC_PI_2], [1.0, 0.0, 1.0]);
    let system = Bars { m: [1.0; 3], l: 1.0, ground: 1.0 };
    let end = *system.simulate(start).advance_to(1.0).expect("a motion");
    close_on(10.0, system.energy(&end), system.energy(&start), 1e-9);
}

/// A four-bar with a base of 2, cranks of 1 and a coupler of 2, crossed, by the places of its two joints.
struct Crossed;

#[lagrangian(coordinates = [first: [2], second: [2]])]
impl Crossed {
    #[point(mass = 1.0)]
    fn first(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.first[0], q.first[1])
    }

    #[point(mass = 0.6)]
    fn second(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.second[0], q.second[1])
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 3] {
        let (first, second) = (self.first(q), self.second(q));
        let ground = Vector2::new(2.0, 0.0);
        [
            first.norm_squared() - 1.0,
            (second - ground).norm_squared() - 1.0,
            (second - first).norm_squared() - 4.0,
        ]
    }
}

/// A start on the way to the flat position, at this speed.
fn towards_flat(w: f64) -> State<f64, 4> {
    let theta = 0.7_f64;
    let psi = -2.0 * (3.0 * (theta / 2.0).tan()).atan();
    let ratio = -3.0 * ((psi / 2.0).cos() / (theta / 2.0).cos()).powi(2);
    let ((a, b), (c, d)) = (theta.sin_cos(), psi.sin_cos());
    let v = [w * a, -w * b, w * ratio * c, -w * ratio * d];
    Crossed.consistent(State::new([b, a, 2.0 + d, c], v)).expect("a start")
}

/// Fixed steps end at given times, some of them right beside the flat position.
#[test]
fn fixed_steps_pass_a_flat_position() {
    for steps in [150, 1500] {
        for k in 0..40 {
            let w = 1.0 + 0.0314159 * f64::from(k);
            let start = towards_flat(w);
            let mut motion = Crossed.stepper::<Jet<8>>(start);
            for _ in 0..steps {
                motion.step(1.5 / w / f64::from(steps), &[]).unwrap_or_else(|error| panic!("{w}: {error}"));
            }
            close_on(w * w, motion.energy(), Crossed.energy(&start), 1e-9);
        }
    }
}

#[test]
fn a_fixed_step_from_beside_a_flat_position_is_right() {
    let system = Bars { m: [0.5, 1.0, 2.5], l: 0.8, ground: 1.3 };
    for s in starts() {
        let start = State::new([s, 0.0, s], [5.0, 0.0, 5.0]);
        let mut motion = system.stepper::<Jet<8>>(start);
        for _ in 0..50 {
            motion.step(0.01, &[]).unwrap_or_else(|error| panic!("{s:e}: {error}"));
        }
        let [a, b, c] = motion.state().q;
        close_on(10.0, motion.energy(), system.energy(&start), 1e-9);
        close_on(1.0, b.abs() + (a - c).abs(), 0.0, 1e-9);
    }
}

#[test]
fn at_the_finest_tolerance_a_passage_ends_soon() {
    let system = Crossed;
    let mut passed = 0;
    for k in 0..40 {
        let w = 1.0 + 0.0314159 * f64::from(k);
        let start = towards_flat(w);
        let mut motion = system.simulate_with::<Dop853>(start).with_tolerance(1e-13).with_max_steps(1000);
        match motion.advance_to(1.5 / w) {
            Ok(end) => {
                close_on(1.0, system.energy(end), system.energy(&start), 1e-10);
                passed += 1;
            }
            Err(error) => match error.cause {
                Cause::ToleranceTooFine { reachable } => {
                    assert!(reachable.0 > 1e-13 && reachable.0 < 1e-8, "{error}");
                }
                cause => {
                    assert!(matches!(cause, Cause::Undetermined { .. } | Cause::StepTooSmall), "{error}")
                }
            },
        }
    }
    assert!(passed > 20, "{passed}");
}
