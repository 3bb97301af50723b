//! S05: a mass on a wall and one on a floor, joined by a bar; also with wall and floor as constraints of
//! their own.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::TIGHT;
use crate::support::reference::seed;

/// x1 points down the wall, x2 along the floor; a force acts on the second mass.
struct Bar {
    m: [f64; 2],
    a: f64,
}

#[lagrangian(coordinates = [x1, x2], inputs = [push])]
impl Bar {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        (self.m[0] * v.x1.powi(2) + self.m[1] * v.x2.powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.m[0] * G * q.x1
    }

    #[holonomic]
    fn bar(&self, q: &Coordinates) -> f64 {
        (self.a - q.x1).powi(2) + (self.a + q.x2).powi(2) - 2.0 * self.a.powi(2)
    }

    #[force(on = x2)]
    fn push(&self, u: &Inputs) -> f64 {
        u.push
    }
}

/// Both masses free in the plane; the gradients are unit vectors for each mass, so that reactions are forces.
struct Released {
    m: [f64; 2],
    a: f64,
}

#[lagrangian(coordinates = [upper: [2], lower: [2]], inputs = [push])]
impl Released {
    #[point(mass = self.m[0])]
    fn first(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.upper[0], q.upper[1])
    }

    #[point(mass = self.m[1])]
    fn second(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.lower[0], q.lower[1])
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (self.m[0] * self.first(q).y + self.m[1] * self.second(q).y)
    }

    #[force(at = second)]
    fn push(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.push, 0.0)
    }

    #[holonomic]
    fn wall(&self, q: &Coordinates) -> f64 {
        self.first(q).x
    }

    #[holonomic]
    fn floor(&self, q: &Coordinates) -> f64 {
        self.second(q).y
    }

    #[holonomic]
    fn bar(&self, q: &Coordinates) -> f64 {
        (self.first(q) - self.second(q)).norm() - 2.0_f64.sqrt() * self.a
    }
}

const BAR: Bar = Bar { m: [2.0, 3.0], a: 0.5 };
const RELEASED: Released = Released { m: [2.0, 3.0], a: 0.5 };

/// The bar at an angle from the wall, with a rate.
fn leaning(angle: f64, rate: f64) -> State<f64, 2> {
    let length = 2.0_f64.sqrt() * BAR.a;
    let (sin, cos) = angle.sin_cos();
    State::new([BAR.a - length * cos, length * sin - BAR.a], [length * rate * sin, length * rate * cos])
}

fn released(state: &State<f64, 2>) -> State<f64, 4> {
    let ([x1, x2], [v1, v2]) = (state.q, state.v);
    State::new([0.0, BAR.a - x1, BAR.a + x2, 0.0], [0.0, -v1, v2, 0.0]).at_time(state.t)
}

/// The compression of the bar from the multiplier of the squared length.
fn compression(state: &State<f64, 2>, push: f64) -> f64 {
    2.0 * 2.0_f64.sqrt() * BAR.a * BAR.reactions(state, &[push]).unwrap().bar
}

#[test]
fn a_push_holds_the_bar() {
    let reference = seed("S05");
    let (state, push) = (State::at_rest([0.0, 0.0]), reference.number("F2"));
    close(compression(&state, push), reference.number("bar_compression"), CLOSED_FORM);
    for state in [state, leaning(0.2, 0.0), leaning(1.2, 0.0)] {
        let [x1, x2] = state.q;
        let push = -BAR.m[0] * G * (BAR.a + x2) / (BAR.a - x1);
        for a in BAR.accelerations(&state, &[push]).unwrap() {
            close_on(G, a, 0.0, CLOSED_FORM);
        }
    }
}

#[test]
fn wall_and_floor_react() {
    let reference = seed("S05");
    let (state, push) = (released(&State::at_rest([0.0, 0.0])), reference.number("F2"));
    let reactions = RELEASED.reactions(&state, &[push]).unwrap();
    close(reactions.bar, reference.number("bar_compression"), CLOSED_FORM);
    close(reactions.floor, reference.number("N_floor"), CLOSED_FORM);
    close(reactions.wall, reference.number("N_wall"), CLOSED_FORM);
    let on_first = RELEASED.reactions_on_first(&state, &[push]).unwrap();
    let on_second = RELEASED.reactions_on_second(&state, &[push]).unwrap();
    all_close(on_first.wall, [reactions.wall, 0.0], CLOSED_FORM);
    all_close(on_first.bar, [-reactions.wall, RELEASED.m[0] * G], CLOSED_FORM);
    all_close(on_second.bar, [reactions.wall, -RELEASED.m[0] * G], CLOSED_FORM);
    all_close(on_second.floor, [0.0, reactions.floor], CLOSED_FORM);
    for a in RELEASED.accelerations(&state, &[push]).unwrap() {
        close_on(G, a, 0.0, CLOSED_FORM);
    }
}

#[test]
fn the_bar_slides_down() {
    let reference = seed("S05");
    let start = State::at_rest([0.0, 0.0]);
    let expected = reference.number("released(F2=0)_a0");
    close(BAR.accelerations(&start, &[0.0]).unwrap()[0], expected, CLOSED_FORM);
    let mut motion = BAR.simulate(start).with_tolerance(TIGHT);
    let mut dop853 = BAR.simulate_with::<Dop853>(start).with_tolerance(TIGHT);
    let mut plane = RELEASED.simulate(released(&start)).with_tolerance(TIGHT);
    let mut plane_dop853 = RELEASED.simulate_with::<Dop853>(released(&start)).with_tolerance(TIGHT);
    let x = reference.numbers::<2>("x(0.1)");
    all_close(motion.advance_to(0.1).unwrap().q, x, EASY);
    all_close(dop853.advance_to(0.1).unwrap().q, x, EASY);
    let (x, v) = (reference.numbers::<2>("x(0.2)"), reference.numbers::<2>("v(0.2)"));
    for state in [*motion.advance_to(0.2).unwrap(), *dop853.advance_to(0.2).unwrap()] {
        all_close(state.q, x, EASY);
        all_close(state.v, v, EASY);
        close(compression(&state, 0.0), reference.number("bar_force_compression(0.2)"), EASY);
    }
    for state in [*plane.advance_to(0.2).unwrap(), *plane_dop853.advance_to(0.2).unwrap()] {
        let expected = released(&State::new(x, v));
        all_close(state.q, expected.q, EASY);
        all_close(state.v, expected.v, EASY);
        let reactions = RELEASED.reactions(&state, &[0.0]).unwrap();
        let bar = reference.number("bar_force_compression(0.2)");
        close(reactions.bar, bar, EASY);
        // The force that the bar hands on, beside the weight of the lower mass.
        let length = 2.0_f64.sqrt() * BAR.a;
        close(reactions.wall, bar * (BAR.a + x[1]) / length, EASY);
        close(reactions.floor, BAR.m[1] * G + bar * (BAR.a - x[0]) / length, EASY);
    }
}

#[test]
fn the_identities_hold() {
    let states = [leaning(0.5, 0.8), leaning(1.0, -2.0)];
    bound!(BAR, [true], inputs = [-3.0]).holds(states);
    bound!(RELEASED, [true; 3], inputs = [-3.0]).holds(states.map(|state| released(&state)));
    assert_eq!(Released::CONSTRAINTS, ["wall", "floor", "bar"]);
}
