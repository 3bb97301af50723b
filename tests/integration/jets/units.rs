//! Nothing depends on the units of mass, length and time.

use lagrangian::Ordered;
use lagrangian::prelude::*;

use crate::support::close::close;

/// A planet, and a pendulum on a spring; generic.
#[derive(Clone, Copy)]
struct Pair<R> {
    mass: R,
    length: R,
    g: R,
    mu: R,
    k: R,
}

#[lagrangian(coordinates = [x, y, theta, r])]
impl<R: Real> Pair<R> {
    #[point(mass = self.mass)]
    fn planet(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta.sin(), -q.theta.cos()) * q.r
    }

    #[potential]
    fn sun(&self, q: &Coordinates<R>) -> R {
        -self.mass * self.mu / self.planet(q).norm()
    }

    #[potential]
    fn weight(&self, q: &Coordinates<R>) -> R {
        self.mass * self.g * self.bob(q).y + 0.5 * self.k * (q.r - self.length).powi(2)
    }
}

/// The same in units of `mass` \[kg], `length` \[m], `time` \[s].
fn pair<R: Real>(mass: f64, length: f64, time: f64) -> Pair<R> {
    let of = |x: f64| R::from_f64(x);
    Pair {
        mass: of(1.5 / mass),
        length: of(1.0 / length),
        g: of(9.75 / (length / time / time)),
        mu: of(1.25 / (length * length * length / time / time)),
        k: of(40.0 / (mass / time / time)),
    }
}

fn start(length: f64, time: f64) -> State<f64, 4> {
    let speed = length / time;
    State::new(
        [0.75 / length, 0.125 / length, 1.0, 1.125 / length],
        [-0.25 / speed, 1.25 / speed, 0.5 * time, 0.25 / speed],
    )
}

/// The numbers of a state, back in metres and seconds.
fn back(state: &State<f64, 4>, length: f64, time: f64) -> [f64; 8] {
    let ([x, y, theta, r], [vx, vy, spin, vr]) = (state.q, state.v);
    let speed = length / time;
    [x * length, y * length, theta, r * length, vx * speed, vy * speed, spin / time, vr * speed]
}

/// At the end, after a few samples, in metres and seconds; with the number of expansions.
fn run(mass: f64, length: f64, time: f64, tolerance: f64) -> ([f64; 8], u64) {
    let pair = pair::<f64>(mass, length, time);
    let mut motion = pair.simulate(start(length, time)).with_tolerance(tolerance);
    assert!(motion.every(0.25 / time).take(5).all(|sample| sample.is_ok()));
    let end = back(motion.advance_to(4.0 / time).unwrap(), length, time);
    (end, motion.steps().evaluations)
}

#[test]
fn units_that_are_powers_of_two_give_the_same_bits() {
    for tolerance in [1e-6, 1e-10, 1e-15] {
        let expected = run(1.0, 1.0, 1.0, tolerance);
        for exponent in [-40, -20, -3, 1, 10, 30, 40] {
            let unit = 2.0_f64.powi(exponent);
            assert_eq!(run(unit, 1.0, 1.0, tolerance), expected, "mass 2^{exponent}");
            assert_eq!(run(1.0, unit, 1.0, tolerance), expected, "length 2^{exponent}");
            assert_eq!(run(1.0, 1.0, unit, tolerance), expected, "time 2^{exponent}");
            assert_eq!(run(unit, unit, unit.recip(), tolerance), expected, "all 2^{exponent}");
        }
    }
}

#[test]
fn units_that_are_powers_of_ten_give_the_same_motion() {
    let (expected, expansions) = run(1.0, 1.0, 1.0, 1e-14);
    for exponent in [-12, -5, 7, 12] {
        let unit = 10.0_f64.powi(exponent);
        for (mass, length, time) in [(unit, 1.0, 1.0), (1.0, unit, 1.0), (1.0, 1.0, unit), (unit, unit, unit)]
        {
            let (found, count) = run(mass, length, time, 1e-14);
            for (found, expected) in found.into_iter().zip(expected) {
                close(found, expected, 3e-13);
            }
            assert!(count.abs_diff(expansions) <= 1, "{count} and {expansions} expansions");
        }
    }
}

#[test]
fn fixed_steps_have_no_units_either() {
    let end = |mass: f64, length: f64, time: f64| {
        let pair = pair::<f64>(mass, length, time);
        let mut motion = pair.stepper::<Jet<10>>(start(length, time));
        for _ in 0..100 {
            motion.step(0.0625 / time, &[]).unwrap();
        }
        back(motion.state(), length, time)
    };
    let expected = end(1.0, 1.0, 1.0);
    for exponent in [-40, 7, 40] {
        let unit = 2.0_f64.powi(exponent);
        assert_eq!(end(unit, unit.recip(), unit), expected);
        assert_eq!(end(1.0, unit, unit), expected);
    }
}

#[test]
fn single_precision_has_room_for_units_too() {
    let end = |mass: f64, length: f64, time: f64| {
        let pair = pair::<f32>(mass, length, time);
        let begin = start(length, time);
        let begin = State::new(begin.q.map(|x| x as f32), begin.v.map(|x| x as f32));
        let mut motion = pair.simulate(begin);
        let state = *motion.advance_to((2.0 / time) as f32).unwrap();
        let state = State::new(state.q.map(f64::from), state.v.map(f64::from));
        (back(&state, length, time), motion.steps().evaluations)
    };
    let pair = pair::<f64>(1.0, 1.0, 1.0);
    let mut motion = pair.simulate(start(1.0, 1.0));
    let exact = back(motion.advance_to(2.0).unwrap(), 1.0, 1.0);
    let expected = end(1.0, 1.0, 1.0);
    for (found, exact) in expected.0.into_iter().zip(exact) {
        close(found, exact, 2e-4);
    }
    for exponent in [-12, -3, 4, 12] {
        let unit = 2.0_f64.powi(exponent);
        for (mass, length, time) in [(unit, 1.0, 1.0), (1.0, unit, 1.0), (1.0, 1.0, unit)] {
            assert_eq!(end(mass, length, time), expected, "2^{exponent}");
        }
    }
}

/// A spring that a weightless pendulum hangs on, in any scalar.
struct Elastic<R> {
    length: R,
}

#[lagrangian(coordinates = [x, y])]
impl<R: Real> Elastic<R> {
    #[point(mass = R::one())]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates<R>) -> R {
        15.0 * (self.bob(q).norm() - self.length).powi(2)
    }
}

/// Where the pendulum is at the end, in units of `length`, and the number of steps.
fn elastic<R: Ordered>(length: R, tolerance: f64) -> ([R; 4], u64) {
    let of = |x: f64| R::from_f64(x) * length;
    let start = State::new([of(1.125), of(0.25)], [of(0.125), of(1.25)]);
    let pendulum = Elastic { length };
    let mut motion = pendulum.simulate(start).with_tolerance(R::from_f64(tolerance));
    let State { q: [x, y], v: [vx, vy], .. } = *motion.advance_to(R::from_f64(3.0)).unwrap();
    ([x, y, vx, vy].map(|x| x / length), motion.steps().accepted)
}

/// An upright pendulum that falls from there, linearized.
struct Upright;

#[lagrangian(coordinates = [angle])]
impl Upright {
    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        0.5 * v.angle * v.angle
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        -2.0 * q.angle * q.angle
    }
}

#[test]
fn numbers_far_below_one_have_as_many_digits() {
    for tolerance in [1e-3, 1e-6, 1e-10, 1e-15] {
        for exponent in [-100, -200, -300] {
            let found = elastic(2.0_f64.powi(exponent), tolerance);
            assert_eq!(found, elastic(1.0, tolerance), "2^{exponent} at {tolerance:e}");
        }
        let found = elastic(2.0_f32.powi(-36), tolerance);
        assert_eq!(found, elastic(1.0_f32, tolerance), "f32 at {tolerance:e}");
    }
    for tolerance in [1e-6, 1e-10, 1e-15] {
        // From 1e-80 to a number of ordinary size.
        let [start, end] = [1e-80, 1e-80 * (2.0 * 92.0_f64).cosh()];
        let mut motion = Upright.simulate(State::at_rest([start])).with_tolerance(tolerance);
        let found = motion.advance_to(92.0).unwrap().q[0];
        // Errors of single steps add up, and each grows as the angle does.
        close(found / end, 1.0, tolerance.max(f64::EPSILON) * 10.0 * motion.steps().accepted as f64);
    }
}
