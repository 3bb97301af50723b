//! Motions in the lanes of SIMD vectors against the same motions one by one.

mod narrow;
mod shortened;

use lagrangian::prelude::*;
use lagrangian::wide::{f32x8, f64x4, f64x8};
use lagrangian::{Batch, Lanes};

/// Two point masses on massless rods, the lower one damped.
struct Pendulum<R> {
    length: R,
    g: R,
    damping: R,
}

#[lagrangian(coordinates = [theta: [2]], inputs = [torque])]
impl<R: Real> Pendulum<R> {
    #[point(mass = R::one())]
    fn upper(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos()) * self.length
    }

    #[point(mass = R::one())]
    fn lower(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.g * (self.upper(q).y + self.lower(q).y)
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities<R>) -> R {
        0.5 * self.damping * v.theta[1].powi(2)
    }

    #[force(on = theta)]
    fn motor(&self, u: &Inputs<R>) -> [R; 2] {
        [u.torque, R::zero()]
    }
}

/// A planet, which may fall into its sun.
struct Planet<R> {
    mu: R,
}

#[lagrangian(coordinates = [x, y])]
impl<R: Real> Planet<R> {
    #[point(mass = R::one())]
    fn planet(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        -self.mu / self.planet(q).norm()
    }
}

/// A pendulum on a rod whose pivot slides down a wire: five Cartesian coordinates of two masses, and two
/// constraints.
struct Slider<R> {
    length: R,
    g: R,
    slope: R,
}

#[lagrangian(coordinates = [pivot: [2], bob: [3]])]
impl<R: Real> Slider<R> {
    #[point(mass = 2.0)]
    fn pivot(&self, q: &Coordinates<R>) -> Vector3<R> {
        Vector3::new(q.pivot[0], R::zero(), q.pivot[1])
    }

    #[point(mass = R::one())]
    fn bob(&self, q: &Coordinates<R>) -> Vector3<R> {
        Vector3::from(q.bob)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.g * (2.0 * q.pivot[1] + q.bob[2])
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates<R>) -> R {
        q.pivot[1] - self.slope * q.pivot[0]
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        (self.bob(q) - self.pivot(q)).norm() - self.length
    }
}

const LENGTHS: [f64; 8] = [0.5, 0.7, 1.0, 1.1, 1.3, 1.7, 2.0, 3.0];
const ANGLES: [f64; 8] = [0.0, 1e-8, 0.1, 0.5, 1.0, -1.2, 0.3, 2.0];
const TORQUES: [f64; 8] = [0.0, 0.1, -0.3, 0.0, 0.2, 0.5, -0.1, 0.05];

fn alone(lane: usize, tolerance: f64, t: f64) -> State<f64, 2> {
    let pendulum = Pendulum { length: LENGTHS[lane], g: 9.81, damping: 0.1 };
    let start = State::at_rest([ANGLES[lane], 0.2]);
    let mut motion = pendulum.simulate(start).with_inputs([TORQUES[lane]]).with_tolerance(tolerance);
    *motion.advance_to(t).expect("the motion goes on")
}

fn eight() -> Pendulum<Lanes<f64x8>> {
    Pendulum { length: LENGTHS.into(), g: Lanes::splat(9.81), damping: Lanes::splat(0.1) }
}

fn lanes(x: Lanes<f64x8>) -> [f64; 8] {
    x.into()
}

#[test]
fn every_lane_moves_as_it_would_alone() {
    let pendulum = eight();
    let start = State::at_rest([ANGLES.into(), Lanes::splat(0.2)]);
    let mut batch = Batch::new(&pendulum, start).with_tolerance(1e-13);
    batch.set_inputs([TORQUES.into()]);
    for t in [0.3, 2.0, 1.0] {
        let state = *batch.advance_to(t).expect("all lanes go on");
        assert_eq!(lanes(state.t), [t; 8]);
        for lane in 0..8 {
            let expected = alone(lane, 1e-14, t);
            for i in 0..2 {
                let (q, v) = (lanes(state.q[i])[lane], lanes(state.v[i])[lane]);
                assert!((q - expected.q[i]).abs() < 1e-10, "lane {lane} at {t}: {q}, {}", expected.q[i]);
                assert!((v - expected.v[i]).abs() < 1e-9, "lane {lane} at {t}: {v}, {}", expected.v[i]);
            }
        }
    }
}

#[test]
fn the_tolerance_controls_the_error() {
    let pendulum = eight();
    let start = State::at_rest([ANGLES.into(), Lanes::splat(0.2)]);
    let mut last = 1.0;
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let mut batch = Batch::new(&pendulum, start).with_tolerance(tolerance);
        batch.set_inputs([TORQUES.into()]);
        let state = *batch.advance_to(2.0).expect("all lanes go on");
        let error = (0..8)
            .map(|lane| (lanes(state.q[0])[lane] - alone(lane, 1e-14, 2.0).q[0]).abs())
            .fold(0.0, f64::max);
        assert!(error < 100.0 * tolerance && error < 0.1 * last, "{error} at {tolerance}");
        last = error;
    }
}

#[test]
fn single_precision_has_eight_lanes_too() {
    let pendulum = Pendulum::<Lanes<f32x8>> {
        length: Lanes::splat(1.0),
        g: Lanes::splat(9.81),
        damping: Lanes::splat(0.1),
    };
    let angles: [f32; 8] = ANGLES.map(|angle| 0.1 * angle as f32);
    let mut batch = Batch::new(&pendulum, State::at_rest([angles.into(), Lanes::splat(0.1)]));
    let state = *batch.advance_to(1.0).expect("all lanes go on");
    for lane in 0..8 {
        let alone = Pendulum { length: 1.0, g: 9.81, damping: 0.1 };
        let mut motion = alone.simulate(State::at_rest([f64::from(angles[lane]), 0.1]));
        let expected = motion.advance_to(1.0).expect("the motion goes on").q[0];
        let found: [f32; 8] = state.q[0].into();
        assert!((f64::from(found[lane]) - expected).abs() < 1e-4, "lane {lane}: {} {expected}", found[lane]);
    }
}

#[test]
fn lanes_in_different_units_of_time_go_side_by_side() {
    // Periods from 2π·1e-9 s to 2π·1e6 s.
    let mu = [1e18, 1.0, 1e-6, 1e-12];
    let planet = Planet::<Lanes<f64x4>> { mu: mu.into() };
    let speed: [f64; 4] = mu.map(f64::sqrt);
    let start = State::new([Lanes::splat(1.0), Lanes::splat(0.0)], [Lanes::splat(0.0), speed.into()]);
    let mut batch = Batch::new(&planet, start).with_tolerance(1e-12);
    let state = *batch.advance_to(1e-7).expect("all lanes go on");
    let (x, y): ([f64; 4], [f64; 4]) = (state.q[0].into(), state.q[1].into());
    for lane in 0..4 {
        let (sin, cos) = (1e-7 * speed[lane]).sin_cos();
        assert!((x[lane] - cos).abs() < 1e-9 && (y[lane] - sin).abs() < 1e-9, "lane {lane}");
    }
}

#[test]
fn a_collision_in_one_lane_is_an_error_with_the_last_good_state() {
    let planet = Planet::<Lanes<f64x4>> { mu: Lanes::splat(1.0) };
    let sideways = Lanes::from([1.0, 1.0, 0.0, 1.0]);
    let start = State::new([Lanes::splat(1.0), Lanes::splat(0.0)], [Lanes::splat(0.0), sideways]);
    let mut batch = Batch::new(&planet, start);
    let error = batch.advance_to(5.0).expect_err("the third planet falls into the sun");
    assert!(matches!(error.cause, Cause::StepTooSmall | Cause::NotFinite), "{error:?}");
    let t: [f64; 4] = batch.state().t.into();
    // Free fall from distance 1: π / √8.
    assert!(t[2] < 1.1108 && t[2] > 1.1, "{t:?}");
    assert!(batch.state().is_finite());
}

#[test]
fn bad_arguments_are_errors() {
    let pendulum = eight();
    let start = State::at_rest([ANGLES.into(), Lanes::splat(0.2)]);
    let cause =
        |batch: &mut Batch<'_, _, 2, 1>, t| batch.advance_to(t).map(|_| ()).map_err(|error| error.cause);
    let mut batch = Batch::new(&pendulum, start);
    assert_eq!(cause(&mut batch, f64::NAN), Err(Cause::InvalidTime));
    assert_eq!(cause(&mut batch, 0.0), Ok(()));
    let mut batch = Batch::new(&pendulum, start).with_tolerance(-1.0);
    assert_eq!(cause(&mut batch, 1.0), Err(Cause::InvalidTolerance));
    let mut batch = Batch::new(&pendulum, start).with_max_steps(2);
    assert_eq!(cause(&mut batch, 100.0), Err(Cause::TooManySteps));
    let mut unknown = ANGLES;
    unknown[5] = f64::NAN;
    let mut batch = Batch::new(&pendulum, State::at_rest([unknown.into(), Lanes::splat(0.2)]));
    assert_eq!(cause(&mut batch, 1.0), Err(Cause::NotFinite));
}

/// A swing through an angle in one vertical plane, the pivot at rest. Lanes differ in length and angle.
fn hanging(length: f64, angle: f64) -> State<f64, 5> {
    let (sin, cos) = angle.sin_cos();
    let rate = 0.3;
    State::new(
        [0.0, 0.0, 0.6 * length * sin, 0.8 * length * sin, -length * cos],
        [0.0, 0.0, rate * 0.6 * length * cos, rate * 0.8 * length * cos, rate * length * sin],
    )
}

fn sliders(steep: &[f64; 8]) -> (Slider<Lanes<f64x8>>, State<Lanes<f64x8>, 5>) {
    let slider = Slider { length: LENGTHS.into(), g: Lanes::splat(9.81), slope: (*steep).into() };
    let starts: [State<f64, 5>; 8] = std::array::from_fn(|lane| hanging(LENGTHS[lane], ANGLES[lane]));
    let gather = |number: &dyn Fn(&State<f64, 5>) -> f64| {
        Lanes::from(std::array::from_fn(|lane| number(&starts[lane])))
    };
    let start = State::new(
        std::array::from_fn(|i| gather(&|state| state.q[i])),
        std::array::from_fn(|i| gather(&|state| state.v[i])),
    );
    (slider, start)
}

/// Wires from flat to steep.
const SLOPES: [f64; 8] = [0.0, 0.1, -0.3, 0.5, 1.0, -2.0, 0.2, 0.7];

#[test]
fn constrained_lanes_move_as_they_would_alone_and_stay_on_their_constraints() {
    let (slider, start) = sliders(&SLOPES);
    let mut batch = Batch::new(&slider, start).with_tolerance(1e-13);
    for t in [0.2, 1.5, 0.7] {
        let state = *batch.advance_to(t).expect("all lanes go on");
        let residuals = slider.constraint_residuals(&state).map(lanes);
        let rates = slider.constraint_rates(&state).map(lanes);
        for lane in 0..8 {
            let single = Slider { length: LENGTHS[lane], g: 9.81, slope: SLOPES[lane] };
            let mut motion = single.simulate(hanging(LENGTHS[lane], ANGLES[lane])).with_tolerance(1e-14);
            let expected = *motion.advance_to(t).expect("the motion goes on");
            for i in 0..5 {
                let (q, v) = (lanes(state.q[i])[lane], lanes(state.v[i])[lane]);
                assert!((q - expected.q[i]).abs() < 1e-10, "lane {lane} at {t}: {q}, {}", expected.q[i]);
                assert!((v - expected.v[i]).abs() < 1e-9, "lane {lane} at {t}: {v}, {}", expected.v[i]);
            }
            let speed = expected.v.iter().fold(1.0_f64, |speed, v| speed.max(v.abs()));
            for c in 0..2 {
                let (f, w) = (residuals[c][lane], rates[c][lane]);
                assert!(f.abs() < 1e-14 && w.abs() < 1e-14 * speed, "lane {lane} at {t}: {f:e}, {w:e}");
            }
        }
    }
}

#[test]
fn reactions_come_in_lanes() {
    let (slider, start) = sliders(&SLOPES);
    let reactions = slider.reactions(&start).expect("regular in all lanes");
    assert!(reactions.are_unique());
    for lane in 0..8 {
        let single = Slider { length: LENGTHS[lane], g: 9.81, slope: SLOPES[lane] };
        let expected = single.reactions(&hanging(LENGTHS[lane], ANGLES[lane])).expect("regular");
        for (found, expected) in [(reactions.wire, expected.wire), (reactions.rod, expected.rod)] {
            assert!((lanes(found)[lane] - expected).abs() < 1e-12 * expected.abs().max(1.0), "lane {lane}");
        }
    }
}

#[test]
fn one_lane_off_its_constraints_is_an_error_or_projected_when_asked_for() {
    let (slider, start) = sliders(&SLOPES);
    let mut places: [f64; 8] = start.q[4].into();
    places[5] -= 1e-3;
    let mut spoiled = start;
    spoiled.q[4] = places.into();
    let error = Batch::new(&slider, spoiled).advance_to(1.0).expect_err("the sixth rod is too long");
    assert!(matches!(error.cause, Cause::PositionViolated { constraint: 1, .. }), "{error:?}");
    let mended = slider.consistent(spoiled).expect("a near state");
    assert!(Batch::new(&slider, mended).advance_to(0.1).is_ok());
    for (found, expected) in mended.iter().zip(start.iter()) {
        let (found, expected) = (lanes(found), lanes(expected));
        for lane in (0..8).filter(|lane| *lane != 5) {
            assert!((found[lane] - expected[lane]).abs() < 1e-15, "lane {lane}");
        }
    }
}

/// Each lane with the derivatives by its own start, against single motions of dual numbers.
#[test]
fn lanes_carry_derivatives() {
    type Vector = Lanes<f64x4>;
    let starts = [[1.0, 0.0, 0.1, 0.9], [0.8, 0.3, -0.2, 1.1], [1.2, -0.1, 0.0, 1.0], [0.5, 0.5, -0.9, 0.9]];
    let lanes = |i: usize| Vector::from(starts.map(|start| start[i]));
    let planet = Planet { mu: lagrangian::Dual::<Vector, 4>::constant(Vector::from([1.0; 4])) };
    let number = |i: usize| lagrangian::Dual::variable(lanes(i), i);
    let mut batch = Batch::new(&planet, State::new([number(0), number(1)], [number(2), number(3)]));
    batch = batch.with_tolerance(1e-14);
    let found = *batch.advance_to(3.0).unwrap();
    for (lane, start) in starts.into_iter().enumerate() {
        let planet = Planet { mu: lagrangian::Dual::<f64, 4>::constant(1.0) };
        let number = |i: usize| lagrangian::Dual::variable(start[i], i);
        let mut motion = planet
            .simulate(State::new([number(0), number(1)], [number(2), number(3)]))
            .with_tolerance(lagrangian::Dual::constant(1e-14));
        let expected = motion.advance_to(lagrangian::Dual::constant(3.0)).unwrap();
        let in_lane = |x: Vector| <[f64; 4]>::from(x)[lane];
        for (found, expected) in found.iter().zip(expected.iter()) {
            assert!((in_lane(found.value) - expected.value).abs() < 1e-12);
            for (found, expected) in found.slopes.into_iter().zip(expected.slopes) {
                assert!((in_lane(found) - expected).abs() < 1e-12 * expected.abs().max(10.0), "{lane}");
            }
        }
    }
}
