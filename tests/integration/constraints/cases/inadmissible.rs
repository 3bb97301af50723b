//! S19: a line given in ways that cannot be, or twice: reported, never a NaN, and never another motion.

use lagrangian::Magnitude;
use lagrangian::Name;
use lagrangian::prelude::*;

use crate::cases::CLOSED_FORM;
use crate::support::close::{all_close, close};
use crate::support::motion::{both_follow, state_at};

/// A heavy particle on the line x = 2 y, given once.
struct Line;

#[lagrangian(coordinates = [x, y])]
impl Line {
    #[point(mass = 2.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * q.y
    }

    #[holonomic]
    fn line(&self, q: &Coordinates) -> f64 {
        q.x - 2.0 * q.y
    }
}

/// (i) The square has no gradient where it vanishes: here two factors, which a run may make equal. An
/// exponent of two is refused at compile time.
struct Squared {
    slope: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Squared {
    #[point(mass = 2.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * q.y
    }

    #[holonomic]
    fn line(&self, q: &Coordinates) -> f64 {
        (q.x - 2.0 * q.y) * (q.x - self.slope * q.y)
    }
}

/// (ii) The same line twice.
struct Twice;

#[lagrangian(coordinates = [x, y], allow(redundant))]
impl Twice {
    #[point(mass = 2.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * q.y
    }

    #[holonomic]
    fn line(&self, q: &Coordinates) -> f64 {
        q.x - 2.0 * q.y
    }

    #[holonomic]
    fn again(&self, q: &Coordinates) -> f64 {
        3.0 * q.x - 6.0 * q.y
    }
}

/// (iii) A parallel line at a distance that only a run knows.
struct Parallel {
    offset: f64,
}

#[lagrangian(coordinates = [x, y], allow(redundant))]
impl Parallel {
    #[point(mass = 2.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * q.y
    }

    #[holonomic]
    fn line(&self, q: &Coordinates) -> f64 {
        q.x - 2.0 * q.y
    }

    #[holonomic]
    fn other(&self, q: &Coordinates) -> f64 {
        q.x - 2.0 * q.y - self.offset
    }
}

fn start() -> State<f64, 2> {
    State::new([1.0, 0.5], [-2.0, -1.0])
}

/// Down the line with g sin α cos α of its slope 1/2: x″ = −(2/5) g.
fn sliding(t: f64) -> [f64; 4] {
    let a = -0.4 * 9.81;
    let (x, vx) = (1.0 - 2.0 * t + a * t * t / 2.0, -2.0 + a * t);
    [x, x / 2.0, vx, vx / 2.0]
}

/// The errors of everything that a start can be asked for, where it cannot be.
fn refused(system: &impl System<2, 0, Scalar = f64>, start: State<f64, 2>, is: impl Fn(&Cause) -> bool) {
    let mut jets = system.simulate(start);
    let mut dop853 = system.simulate_with::<Dop853>(start);
    let mut rk4 = system.stepper::<Rk4>(start);
    let errors = [
        jets.advance_to(1.0).expect_err("no motion"),
        dop853.advance_to(1.0).expect_err("no motion"),
        rk4.step(0.01, &[]).expect_err("no motion"),
        system.simulate(start).every(0.1).next().expect("an error").expect_err("no motion"),
    ];
    for error in errors {
        assert!(is(&error.cause), "{error:?}");
        assert_eq!(error.t, start.t);
    }
    for state in [jets.state(), dop853.state(), rk4.state()] {
        assert_eq!(*state, start);
    }
}

#[test]
fn a_square_is_reported() {
    let vanishes = |cause: &Cause| matches!(cause, Cause::VanishingGradient { constraint: 0, .. });
    let squared = Squared { slope: 2.0 };
    refused(&squared, start(), vanishes);
    assert!(vanishes(&squared.accelerations(&start()).unwrap_err().cause));
    assert!(vanishes(&squared.reactions(&start()).map(|_| ()).unwrap_err().cause));
    assert!(vanishes(&squared.consistent(start()).unwrap_err().cause));
    // Two different lines restrain the particle on either of them, but not where they cross.
    let cross = Squared { slope: -3.0 };
    both_follow(&cross, start(), [(0.3, sliding(0.3))], 1e-12);
    refused(&cross, State::at_rest([0.0, 0.0]), vanishes);
}

#[test]
fn a_line_given_twice_holds_like_one() {
    both_follow(&Twice, start(), [0.3, 1.0, 3.0].map(|t| (t, sliding(t))), 1e-12);
    both_follow(&Line, start(), [0.3, 1.0, 3.0].map(|t| (t, sliding(t))), 1e-12);
    let state = state_at(&Twice, start(), 1.0);
    let once = Line.reactions(&state).unwrap();
    let twice = Twice.reactions(&state).unwrap();
    assert!(once.are_unique() && !twice.are_unique());
    // Only the sum is certain; the shortest pair lies along (1, 3).
    close(twice.line + 3.0 * twice.again, once.line, CLOSED_FORM);
    all_close([twice.line, twice.again], [once.line / 10.0, 0.3 * once.line], CLOSED_FORM);
    // The weight across the line: λ (1, −2) carries m g cos α across.
    close(once.line, -2.0 * 9.81 * 2.0 / 5.0, CLOSED_FORM);
}

#[test]
fn a_contradiction_is_reported() {
    let parallel = Parallel { offset: 1.0 };
    let contradictory = |cause: &Cause| matches!(cause, Cause::Contradictory { constraint: 0 | 1, .. });
    refused(&parallel, start(), contradictory);
    refused(&parallel, State::at_rest([1.5, 0.5]), contradictory);
    for place in [[1.0, 0.5], [1.5, 0.5], [0.0, 0.0], [-7.0, 3.0]] {
        let error = parallel.consistent(State::at_rest(place)).unwrap_err();
        assert!(matches!(error.cause, Cause::Contradictory { .. }), "{error:?}");
    }
    // Without a distance between them the two lines are one.
    both_follow(&Parallel { offset: 0.0 }, start(), [(1.0, sliding(1.0))], 1e-12);
}

#[test]
fn a_start_off_the_line_is_reported_and_projected_when_asked_for() {
    let beside = State::new([1.0, 0.25], [-2.0, -1.0]);
    let name = Name::new(&Line::NAMES.constraints[0]);
    let expected = Cause::PositionViolated { constraint: 0, name, by: Magnitude(0.5) };
    refused(&Line, beside, |cause| *cause == expected);
    let across = State::new([1.0, 0.5], [-2.0, 0.0]);
    let expected = Cause::VelocityViolated { constraint: 0, name, by: Magnitude(2.0) };
    refused(&Line, across, |cause| *cause == expected);
    // Equal masses: along the normal (1, −2).
    let projected = Line.consistent(beside).unwrap();
    all_close(projected.q, [0.9, 0.45], CLOSED_FORM);
    all_close(projected.v, [-2.0, -1.0], CLOSED_FORM);
    let projected = Line.consistent(across).unwrap();
    all_close(projected.q, [1.0, 0.5], CLOSED_FORM);
    all_close(projected.v, [-1.6, -0.8], CLOSED_FORM);
    assert!(Line.simulate(projected).advance_to(1.0).is_ok());
}
