//! S18: two particles joined by a rigid rod, thrown through space.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, between, close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, drift, state_at};
use crate::support::reference::seed;

struct Rod {
    m: [f64; 2],
    length: f64,
}

#[lagrangian(coordinates = [first: [3], second: [3]])]
impl Rod {
    #[point(mass = self.m[..])]
    fn ends(&self, q: &Coordinates) -> [Vector3<f64>; 2] {
        [Vector3::from(q.first), Vector3::from(q.second)]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (self.m[0] * q.first[2] + self.m[1] * q.second[2])
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        let [first, second] = self.ends(q);
        (first - second).norm() - self.length
    }
}

const ROD: Rod = Rod { m: [1.0, 2.0], length: 1.5 };

/// Centre at the origin, both ends along x.
fn start() -> State<f64, 6> {
    let reference = seed("S18");
    let ([a, b, c], [d, e, f]) = (reference.numbers::<3>("v1(0)"), reference.numbers::<3>("v2(0)"));
    State::new([1.0, 0.0, 0.0, -0.5, 0.0, 0.0], [a, b, c, d, e, f])
}

/// Uniform rotation at 2 rad/s about (0, 3/5, 4/5) and a parabola of the centre.
fn thrown(t: f64) -> [f64; 12] {
    let (sin, cos) = (2.0 * t).sin_cos();
    let direction = [cos, 0.8 * sin, -0.6 * sin];
    let turning = [-2.0 * sin, 1.6 * cos, -1.2 * cos];
    let centre = [t, 0.0, 2.0 * t - G * t * t / 2.0];
    let speed = [1.0, 0.0, 2.0 - G * t];
    std::array::from_fn(|i| {
        let (arm, axis) = (if i % 6 < 3 { 1.0 } else { -0.5 }, i % 3);
        if i < 6 { centre[axis] + arm * direction[axis] } else { speed[axis] + arm * turning[axis] }
    })
}

#[test]
fn the_ends_agree() {
    both_follow(&ROD, start(), [0.3, 1.0, 4.0].map(|t| (t, thrown(t))), EASY);
    let state = state_at(&ROD, start(), 1.0);
    let reference = seed("S18");
    all_close(&state.q[..3], reference.numbers::<3>("r1(1)"), EASY);
    all_close(&state.q[3..], reference.numbers::<3>("r2(1)"), EASY);
}

#[test]
fn the_tension_is_constant_and_the_pair_of_forces_does_no_work() {
    let tension = seed("S18").number("rod_tension");
    let mut motion = ROD.simulate(start()).with_tolerance(TIGHT);
    for k in 1..20 {
        motion.advance_to(0.2 * f64::from(k)).unwrap();
        close(motion.reactions().rod, -tension, CLOSED_FORM);
        let state = motion.state();
        assert_eq!(ROD.reaction_power(state).unwrap(), 0.0);
        let forces = ROD.reaction_forces(state).unwrap().rod;
        for i in 0..3 {
            close_on(tension, forces[i], -forces[i + 3], CLOSED_FORM);
        }
        let [first, second] = ROD.reactions_on_ends(state).unwrap().rod;
        all_close(first, &forces[..3], CLOSED_FORM);
        all_close(second, &forces[3..], CLOSED_FORM);
        let work: f64 = forces.iter().zip(state.v).map(|(force, v)| force * v).sum();
        close_on(tension * 10.0, work, 0.0, CLOSED_FORM);
    }
}

#[test]
fn momentum_and_energy_are_those_of_a_free_fall() {
    let mut motion = ROD.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.1, 40, |s| ROD.energy(s)), 1e-11);
    let mut motion = ROD.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.1, 40, |s| s.v[0] + 2.0 * s.v[3]), 1e-13);
    let mut motion = ROD.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.1, 40, |s| s.v[2] + 2.0 * s.v[5] + 3.0 * G * s.t), 1e-12);
}

#[test]
fn the_identities_hold() {
    bound!(ROD, [true]).holds([0.0, 0.7].map(|t| state_at(&ROD, start(), t)));
}
