//! S08 in its second form: a double pendulum in four Cartesian coordinates with two rods.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, between, close};
use crate::support::constrained::bound;
use crate::support::difference::{STEP, derivative, eigenvalues};
use crate::support::motion::{TIGHT, both_follow, drift, state_at};
use crate::support::reference::seed;

/// x points down; the rods have gradients that are unit vectors for each mass.
struct Rods {
    m: [f64; 2],
    l: [f64; 2],
}

#[lagrangian(coordinates = [x: [2], y: [2]])]
impl Rods {
    #[point(mass = self.m[..])]
    fn masses(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [Vector2::new(q.x[0], q.y[0]), Vector2::new(q.x[1], q.y[1])]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -G * (self.m[0] * q.x[0] + self.m[1] * q.x[1])
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 2] {
        let [upper, lower] = self.masses(q);
        [upper.norm() - self.l[0], (lower - upper).norm() - self.l[1]]
    }
}

const RODS: Rods = Rods { m: [1.0, 1.0], l: [1.0, 1.0] };

/// From the first angle, the second relative to it, and their rates.
fn cartesian([upper, bend, turn, bending]: [f64; 4]) -> [f64; 8] {
    let (lower, both) = (upper + bend, turn + bending);
    let (x, y) = ([upper.cos(), upper.cos() + lower.cos()], [upper.sin(), upper.sin() + lower.sin()]);
    let (first, second) = ([-upper.sin(), upper.cos()], [-lower.sin(), lower.cos()]);
    let velocity = |axis: usize| [turn * first[axis], turn * first[axis] + both * second[axis]];
    let ([vx0, vx1], [vy0, vy1]) = (velocity(0), velocity(1));
    [x[0], x[1], y[0], y[1], vx0, vx1, vy0, vy1]
}

fn state([a, b, c, d, e, f, g, h]: [f64; 8]) -> State<f64, 4> {
    State::new([a, b, c, d], [e, f, g, h])
}

fn start() -> State<f64, 4> {
    state(cartesian([1.0, 0.5, 0.0, 0.0]))
}

#[test]
fn states_agree_with_those_of_two_angles() {
    let rows = seed("S08").timed_rows::<4>("state_th1_th2rel_rates");
    let rows = rows.into_iter().map(|(t, row)| (t, cartesian(row)));
    both_follow(&RODS, start(), rows, EASY);
}

#[test]
fn the_reactions_are_the_tensions() {
    let [upper, lower] = seed("S08").numbers("rod_tensions(10)");
    let mut motion = RODS.simulate(start()).with_tolerance(TIGHT);
    motion.advance_to(10.0).unwrap();
    all_close(motion.reactions().rods, [-upper, -lower], EASY);
    let mut dop853 = RODS.simulate_with::<Dop853>(start()).with_tolerance(TIGHT);
    dop853.advance_to(10.0).unwrap();
    all_close(dop853.reactions().rods, [-upper, -lower], EASY);
    assert!(dop853.reactions().are_unique());
}

#[test]
fn small_swings_have_the_linear_frequencies() {
    // Accelerations of the angles beside the lowest state, where they are y″ of the masses and of their
    // difference.
    let mut matrix = nalgebra::DMatrix::zeros(4, 4);
    for column in 0..2 {
        let slopes = derivative(STEP, |x| {
            let mut angles = [0.0; 4];
            angles[column] = x;
            let [.., upper, lower] = RODS.accelerations(&state(cartesian(angles))).unwrap();
            let second = lower - upper;
            [upper, second - upper]
        });
        (matrix[(2, column)], matrix[(3, column)]) = (slopes[0], slopes[1]);
        matrix[(column, 2 + column)] = 1.0;
    }
    let mut found: Vec<f64> =
        eigenvalues(&matrix).iter().map(|value| value.im).filter(|x| *x > 0.0).collect();
    found.sort_by(f64::total_cmp);
    all_close(found, seed("S08").numbers::<2>("linear_omegas"), CLOSED_FORM);
}

#[test]
fn energy_stays_and_the_rods_do_no_work() {
    let mut motion = RODS.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.1, 100, |s| RODS.energy(s)), 1e-12);
    let forces = RODS.reaction_forces(motion.state()).unwrap().rods;
    // The lower rod pulls both masses with equal forces.
    close(forces[1][0], -forces[1][1], CLOSED_FORM);
    close(forces[1][2], -forces[1][3], CLOSED_FORM);
    assert_eq!(RODS.reaction_power(motion.state()).unwrap(), 0.0);
}

#[test]
fn the_identities_hold() {
    bound!(RODS, [true; 2]).holds([0.0, 0.7, 2.0].map(|t| state_at(&RODS, start(), t)));
    assert_eq!(Rods::CONSTRAINTS, ["rods[0]", "rods[1]"]);
}
