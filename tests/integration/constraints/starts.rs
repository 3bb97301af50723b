//! Where a motion may begin: starts off the constraints are errors, and `consistent` projects them.

use lagrangian::Magnitude;
use lagrangian::Name;
use lagrangian::prelude::*;

use crate::support::close::{all_close, between, close, close_on};
use crate::support::sample::Samples;

const G: f64 = 9.81;

/// A heavy bead on an ellipse, with more inertia across than along: M is not a multiple of 1.
struct Ellipse {
    m: [f64; 2],
    axes: [f64; 2],
}

#[lagrangian(coordinates = [x, y])]
impl Ellipse {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        (self.m[0] * v.x.powi(2) + self.m[1] * v.y.powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m[1] * G * q.y
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates) -> f64 {
        (q.x / self.axes[0]).powi(2) + (q.y / self.axes[1]).powi(2) - 1.0
    }
}

/// Two masses at a wall and on a floor, joined by a bar, and a runner that must not slip sideways.
struct Corner;

#[lagrangian(coordinates = [upper: [2], lower: [2], runner: [2], heading])]
impl Corner {
    #[point(mass = [2.0, 3.0])]
    fn ends(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [Vector2::from(q.upper), Vector2::from(q.lower)]
    }

    #[body(mass = 1.5, inertia = 0.2)]
    fn runner(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::from(q.runner), q.heading)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (2.0 * q.upper[1] + 3.0 * q.lower[1])
    }

    #[holonomic]
    fn sides(&self, q: &Coordinates) -> [f64; 2] {
        [q.upper[0], q.lower[1]]
    }

    #[holonomic]
    fn bar(&self, q: &Coordinates) -> f64 {
        let [upper, lower] = self.ends(q);
        (upper - lower).norm() - 1.25
    }

    #[nonholonomic]
    fn blade(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.runner[0] * q.heading.sin() - v.runner[1] * q.heading.cos()
    }
}

/// Two circles, which meet, touch or stay apart.
struct Circles {
    distance: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Circles {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[holonomic]
    fn left(&self, q: &Coordinates) -> f64 {
        q.x.powi(2) + q.y.powi(2) - 1.0
    }

    #[holonomic]
    fn right(&self, q: &Coordinates) -> f64 {
        (q.x - self.distance).powi(2) + q.y.powi(2) - 1.0
    }
}

const ELLIPSE: Ellipse = Ellipse { m: [4.0, 1.0], axes: [2.0, 1.0] };

/// A state of the corner that its constraints allow.
fn corner() -> State<f64, 7> {
    // 0.75, 1, 1.25 is a right triangle; the bar turns.
    State::new([0.0, 1.0, 0.75, 0.0, 2.0, 1.0, 0.0], [0.0, -0.6, 0.8, 0.0, 1.5, 0.0, 0.7])
}

#[test]
fn the_violated_constraint_is_named_and_the_state_stays() {
    assert_eq!(Corner::CONSTRAINTS, ["sides[0]", "sides[1]", "bar", "blade"]);
    let spoiled = |places: &[usize], by: f64, velocity: bool| {
        let mut state = corner();
        let numbers = if velocity { &mut state.v } else { &mut state.q };
        places.iter().for_each(|&place| numbers[place] += by);
        state
    };
    let violated = |velocity: bool, constraint: usize, by: f32| {
        let (name, by) = (Name::new(&Corner::NAMES.constraints[constraint]), Magnitude(by));
        if velocity {
            Cause::VelocityViolated { constraint, name, by }
        } else {
            Cause::PositionViolated { constraint, name, by }
        }
    };
    // Moved as a whole, the bar keeps its length.
    let causes = [
        (spoiled(&[0, 2], 0.125, false), violated(false, 0, 0.125)),
        (spoiled(&[1, 3], -0.25, false), violated(false, 1, 0.25)),
        (spoiled(&[0, 2], 0.5, true), violated(true, 0, 0.5)),
        (spoiled(&[5], 0.5, true), violated(true, 3, 0.5)),
    ];
    for (start, expected) in causes {
        let mut jets = Corner.simulate(start);
        let mut dop853 = Corner.simulate_with::<Dop853>(start);
        let mut jet = Corner.stepper::<Jet<6>>(start);
        let errors = [
            jets.advance_to(0.1).unwrap_err(),
            dop853.advance_to(0.1).unwrap_err(),
            jet.step(0.01, &[]).unwrap_err(),
        ];
        for error in errors {
            assert_eq!((error.cause, error.t), (expected, 0.0));
        }
        for state in [jets.state(), dop853.state(), jet.state()] {
            assert_eq!(*state, start);
        }
        // It stays an error, and nothing moves.
        assert_eq!(jets.advance_to(0.2).unwrap_err().cause, expected);
        assert_eq!(jet.step(0.01, &[]).unwrap_err().cause, expected);
    }
    // The bar is too short by more than rounding, and the message has the length.
    let error = Corner.simulate(spoiled(&[1], -1e-3, false)).advance_to(0.1).unwrap_err();
    let Cause::PositionViolated { constraint: 2, by, .. } = error.cause else { panic!("{error:?}") };
    assert!(error.to_string().contains("constraint `bar` by"), "{error}");
    between(0.7e-3, f64::from(by.0), 0.9e-3);
}

#[test]
fn a_start_written_with_ten_digits_is_good_and_loses_its_roundings() {
    let mut start = corner();
    start.q[2] += 2e-11;
    start.v[2] -= 3e-11;
    for state in [
        *Corner.simulate(start).advance_to(0.0).unwrap(),
        *Corner.simulate_with::<Dop853>(start).advance_to(0.0).unwrap(),
        *Corner.stepper::<Rk4>(start).step(0.0, &[]).unwrap(),
    ] {
        for value in Corner.constraint_residuals(&state).into_iter().chain(Corner.constraint_rates(&state)) {
            close_on(1.0, value, 0.0, 1e-15);
        }
        all_close(state.q, start.q, 1e-10);
    }
    // With six digits it is not.
    start.q[2] += 1e-6;
    assert!(Corner.simulate(start).advance_to(0.0).is_err());
}

#[test]
fn a_good_state_is_left_alone() {
    let state = corner();
    assert_eq!(Corner.consistent(state).unwrap(), state);
    assert_eq!(*Corner.simulate(state).advance_to(0.0).unwrap(), state);
}

#[test]
fn velocities_are_projected_across_the_constraints() {
    let mut rough = corner();
    rough.v = [0.4, -0.7, 0.2, 0.3, 1.1, -0.8, 0.5];
    let projected = Corner.consistent(rough).unwrap();
    assert_eq!(projected.q, rough.q);
    for rate in Corner.constraint_rates(&projected) {
        close_on(1.0, rate, 0.0, 1e-15);
    }
    // M δv is a combination of the gradients: its product with every motion that they allow vanishes.
    let (mass, rows) = (Corner.mass_matrix(&rough), Corner.constraint_jacobian(&rough));
    let change = projected.velocities() - rough.velocities();
    let momentum = mass * change;
    let gram = rows * rows.transpose();
    let along = rows.transpose() * gram.try_inverse().expect("independent rows") * (rows * momentum);
    between(0.5, momentum.norm(), 5.0);
    close_on(1.0, (momentum - along).norm(), 0.0, 1e-14);
}

#[test]
fn coordinates_are_projected_across_the_constraints() {
    // The projection goes along the gradient at the end, up to an error that falls with the distance: each
    // Newton step goes along the gradient where the step starts.
    let tilt = |distance: f64| {
        let (sin, cos) = 0.7_f64.sin_cos();
        let rough = State::at_rest([2.0 * cos + distance, sin + distance]);
        let projected = ELLIPSE.consistent(rough).unwrap();
        close_on(1.0, ELLIPSE.constraint_residuals(&projected)[0], 0.0, 1e-15);
        let change = projected.coordinates() - rough.coordinates();
        let row = ELLIPSE.constraint_jacobian(&projected);
        let tangent = nalgebra::Vector2::new(-row[1], row[0]).normalize();
        (ELLIPSE.mass_matrix(&rough) * change).dot(&tangent).abs() / change.norm()
    };
    between(1e-12, tilt(1e-4), 1e-3);
    between(8.0, tilt(1e-2) / tilt(1e-3), 12.0);
    // Where the surface is flat, or curved alike in all directions, the nearest point is found at any
    // distance.
    let mut rough = corner();
    (rough.q[0], rough.q[3]) = (0.2, -0.3);
    let projected = Corner.consistent(rough).unwrap();
    close_on(1.0, projected.q[0], 0.0, 1e-16);
    close_on(1.0, projected.q[3], 0.0, 1e-16);
    let circle = Circles { distance: 0.0 };
    let projected = circle.consistent(State::at_rest([3.0, 4.0, 5.0])).unwrap();
    all_close(projected.q, [0.6, 0.8, 5.0], 1e-15);
}

#[test]
fn projecting_twice_changes_nothing() {
    let mut rough = corner();
    (rough.q, rough.v) = ([0.1, 1.1, 0.7, -0.1, 2.0, 1.0, 0.3], [0.4, -0.7, 0.2, 0.3, 1.1, -0.8, 0.5]);
    let once = Corner.consistent(rough).unwrap();
    assert_eq!(Corner.consistent(once).unwrap(), once);
    assert!(Corner.simulate(once).advance_to(0.1).is_ok());
    let once = ELLIPSE.consistent(State::new([3.0, -1.0], [1.0, 2.0])).unwrap();
    assert_eq!(ELLIPSE.consistent(once).unwrap(), once);
    assert!(ELLIPSE.simulate(once).advance_to(1.0).is_ok());
}

#[test]
fn far_starts_find_the_surface_too() {
    for place in [[100.0, 1.0], [0.01, 0.02], [-3.0, 7.0], [1e3, -1e3], [1e-9, 1e-3]] {
        let projected = ELLIPSE.consistent(State::new(place, [1.0, 1.0])).unwrap();
        close_on(1.0, ELLIPSE.constraint_residuals(&projected)[0], 0.0, 1e-14);
        close_on(1.0, ELLIPSE.constraint_rates(&projected)[0], 0.0, 1e-14);
        // The projected state is not on the far side.
        assert!(projected.q[0] * place[0] > 0.0, "{projected:?}");
    }
}

#[test]
fn circles_that_meet_hold_and_circles_apart_cannot() {
    let meeting = Circles { distance: 1.0 };
    let projected = meeting.consistent(State::new([0.4, 0.7, 3.0], [1.0, 1.0, 1.0])).unwrap();
    all_close(projected.q, [0.5, 0.75_f64.sqrt(), 3.0], 1e-15);
    close_on(1.0, projected.v[0].hypot(projected.v[1]), 0.0, 1e-15);
    close(projected.v[2], 1.0, 1e-15);
    for distance in [2.5, 3.0, 100.0] {
        let apart = Circles { distance };
        for y in [0.0, 0.3, -2.0] {
            let error = apart.consistent(State::at_rest([0.4, y, 0.0])).unwrap_err();
            let refused = matches!(
                error.cause,
                Cause::NoConsistentState { .. }
                    | Cause::Contradictory { .. }
                    | Cause::VanishingGradient { .. }
            );
            // The error of a projection does not advise to project.
            assert!(refused && !error.to_string().contains("consistent("), "{error}");
        }
    }
}

#[test]
fn a_centre_has_no_direction() {
    let error = ELLIPSE.consistent(State::at_rest([0.0, 0.0])).unwrap_err();
    assert!(matches!(error.cause, Cause::VanishingGradient { constraint: 0, .. }));
    let error = ELLIPSE.simulate(State::at_rest([0.0, 0.0])).advance_to(1.0).unwrap_err();
    assert!(matches!(
        error.cause,
        Cause::VanishingGradient { constraint: 0, .. } | Cause::PositionViolated { constraint: 0, .. }
    ));
}

#[test]
fn numbers_that_are_none_are_refused() {
    for bad in [f64::NAN, f64::INFINITY] {
        let start = State::at_rest([bad, 0.0]);
        assert_eq!(ELLIPSE.consistent(start).unwrap_err().cause, Cause::NotFinite);
        assert_eq!(ELLIPSE.simulate(start).advance_to(1.0).unwrap_err().cause, Cause::NotFinite);
        let start = State::new([2.0, 0.0], [0.0, bad]);
        assert_eq!(ELLIPSE.consistent(start).unwrap_err().cause, Cause::NotFinite);
        let flat = Ellipse { axes: [bad, 1.0], ..ELLIPSE };
        assert!(flat.simulate(State::at_rest([0.5, 0.5])).advance_to(1.0).is_err());
    }
}

/// A four-bar linkage by the angles of its bars.
struct FourBar {
    bars: [f64; 3],
    base: f64,
}

#[lagrangian(coordinates = [angle: [3]])]
impl FourBar {
    #[point(mass = 1.0)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 3] {
        let bars: [f64; 3] = self.bars;
        let mut end = Vector2::zeros();
        [0, 1, 2].map(|bar| {
            end += bars[bar] * Vector2::new(q.angle[bar].cos(), q.angle[bar].sin());
            end
        })
    }

    #[holonomic]
    fn closed(&self, q: &Coordinates) -> Vector2<f64> {
        self.joints(q)[2] - Vector2::new(self.base, 0.0)
    }
}

/// A heavy load on a light hook.
struct Crane {
    load: f64,
}

#[lagrangian(coordinates = [x: [2], y: [2]])]
impl Crane {
    #[point(mass = 1.0)]
    fn hook(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x[0], q.y[0])
    }

    #[point(mass = self.load)]
    fn load(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x[1], q.y[1])
    }

    #[holonomic]
    fn ropes(&self, q: &Coordinates) -> [f64; 2] {
        [self.hook(q).norm() - 1.0, (self.load(q) - self.hook(q)).norm() - 1.0]
    }
}

/// Corrections of a rough start are cut short where constraints nearly depend on each other. They go on until
/// they are done.
#[test]
fn rough_starts_end_on_their_constraints() {
    let mut samples = Samples::new(21);
    let mut found = 0;
    for _ in 0..1000 {
        let bars = [0; 3].map(|_| samples.number(0.3, 1.5));
        let linkage = FourBar { bars, base: samples.number(0.3, 1.5) };
        let start = State::at_rest([0; 3].map(|_| samples.number(0.0, 6.3)));
        let Ok(state) = linkage.consistent(start) else { continue };
        let off = linkage.constraint_residuals(&state).iter().fold(0.0, |off: f64, r| off.max(r.abs()));
        assert!(off < 1e-12, "{bars:?} {start:?}: {off:e}");
        found += 1;
    }
    assert!(found > 800, "{found}");
    for load in [1.0, 100.0, 1000.0] {
        let crane = Crane { load };
        for _ in 0..50 {
            let [dx, dy] = [0; 2].map(|_| samples.number(-0.1, 0.1));
            let state = crane.consistent(State::at_rest([0.1, 0.2 + dx, -0.995, -1.99 + dy])).unwrap();
            let off = crane.constraint_residuals(&state).iter().fold(0.0, |off: f64, r| off.max(r.abs()));
            assert!(off < 1e-12, "{load} {dx} {dy}: {off:e}");
        }
    }
}
