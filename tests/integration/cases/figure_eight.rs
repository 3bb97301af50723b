//! P04: three equal masses that chase each other along a figure eight.

use lagrangian::prelude::*;

use super::EASY;
use crate::support::close::{all_close, all_close_on_largest, between, close_on};
use crate::support::motion::{TIGHT, drift, numbers, state_at};
use crate::support::reference::published;

struct ThreeBodies;

#[lagrangian(coordinates = [x: [3], y: [3]])]
impl ThreeBodies {
    #[point(mass = 1.0)]
    fn bodies(&self, q: &Coordinates) -> [Vector2<f64>; 3] {
        std::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let [a, b, c] = self.bodies(q);
        -1.0 / (a - b).norm() - 1.0 / (b - c).norm() - 1.0 / (c - a).norm()
    }
}

fn start() -> State<f64, 6> {
    let reference = published("figure_eight");
    let [x, y, vx, vy] = ["x1_fixed", "y1", "vx3", "vy3"].map(|key| reference.number(key));
    State::new([x, -x, 0.0, y, -y, 0.0], [-vx / 2.0, -vx / 2.0, vx, -vy / 2.0, -vy / 2.0, vy])
}

fn period() -> f64 {
    published("figure_eight").number("T")
}

#[test]
fn the_motion_closes_after_a_period() {
    let end = state_at(&ThreeBodies, start(), period());
    all_close(numbers(&end), numbers(&start()), EASY);
}

#[test]
fn a_third_of_the_period_permutes_the_bodies() {
    let third = state_at(&ThreeBodies, start(), period() / 3.0);
    let next = [1, 2, 0];
    let permuted = |row: &[f64]| next.map(|i| row[i]);
    for (found, begin) in [(&third.q, &start().q), (&third.v, &start().v)] {
        all_close(permuted(&found[..3]), &begin[..3], EASY);
        all_close(permuted(&found[3..]), &begin[3..], EASY);
    }
}

#[test]
fn linear_and_angular_momentum_vanish_and_the_energy_stays() {
    let angular = |s: &State<f64, 6>| {
        let p = ThreeBodies.momenta(s);
        (0..3).map(|i| s.q[i] * p[3 + i] - s.q[3 + i] * p[i]).sum::<f64>()
    };
    close_on(1.0, angular(&start()), 0.0, 1e-15);
    all_close_on_largest([ThreeBodies.momenta(&start())[..3].iter().sum::<f64>()], [0.0], 1e-12);
    for quantity in [&angular as &dyn Fn(&State<f64, 6>) -> f64, &|s| ThreeBodies.energy(s)] {
        let mut motion = ThreeBodies.simulate(start()).with_tolerance(TIGHT);
        between(-1.0, drift(&mut motion, 0.5, 40, quantity), 1e-12);
    }
}
