//! The parallelogram by the places of its moving joints, with three lengths as constraints.

use lagrangian::prelude::*;

use super::super::curve::{Point, Random, offsets, run};
use super::Starts;

/// Uniform bars between joints that have masses of their own.
#[derive(Clone, Copy, Debug)]
pub struct Joints {
    /// Lengths of the cranks and of coupler and ground [m].
    pub l: [f64; 2],
    /// Masses of the bars: crank, coupler, rocker [kg].
    pub bar: [f64; 3],
    /// Masses of the joints [kg].
    pub m: [f64; 2],
}

#[lagrangian(coordinates = [first: [2], second: [2]])]
impl Joints {
    #[point(mass = self.m[..])]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [Vector2::from(q.first), Vector2::from(q.second)]
    }

    #[kinetic]
    fn bars(&self, v: &Velocities) -> f64 {
        let (a, b) = (Vector2::from(v.first), Vector2::from(v.second));
        (self.bar[0] * a.norm_squared()
            + self.bar[1] * (a.norm_squared() + a.dot(&b) + b.norm_squared())
            + self.bar[2] * b.norm_squared())
            / 6.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let first = self.m[0] + 0.5 * (self.bar[0] + self.bar[1]);
        let second = self.m[1] + 0.5 * (self.bar[1] + self.bar[2]);
        9.81 * (first * q.first[1] + second * q.second[1])
    }

    #[holonomic]
    fn lengths(&self, q: &Coordinates) -> [f64; 3] {
        let [first, second] = self.joints(q);
        let ground = Vector2::new(self.l[1], 0.0);
        [
            0.5 * (first.norm_squared() - self.l[0] * self.l[0]),
            0.5 * ((second - ground).norm_squared() - self.l[0] * self.l[0]),
            0.5 * ((second - first).norm_squared() - self.l[1] * self.l[1]),
        ]
    }
}

/// Starts of linkages, one at each offset from the singular position.
fn starts(name: &'static str, count: usize, mut system: impl FnMut() -> (Joints, f64)) -> Starts<Joints, 4> {
    let runs = offsets(count).filter_map(|d| {
        let (system, rate) = system();
        let [l, ground] = system.l;
        let curve = |s: f64| -> Point<4> {
            let (sin, cos) = s.sin_cos();
            ([l * cos, l * sin, l * cos + ground, l * sin], [-l * sin, l * cos, -l * sin, l * cos])
        };
        run(system, curve, d, rate, 0.5, 0.1)
    });
    Starts { name, runs: runs.collect() }
}

/// Bars of 1 m and 1 kg.
pub fn plain(count: usize) -> Starts<Joints, 4> {
    starts("points", count, || (Joints { l: [1.0; 2], bar: [1.0; 3], m: [0.0; 2] }, 5.0))
}

/// Masses and proportions at random, in both directions.
pub fn unequal(count: usize) -> Starts<Joints, 4> {
    let mut random = Random(3);
    starts("points-unequal", count, move || {
        let l = [random.between(0.5, 1.5), random.between(0.5, 1.5)];
        let bar = [(); 3].map(|()| random.between(0.1, 2.0));
        let m = [(); 2].map(|()| random.between(0.1, 2.0));
        let rate = if random.unit() < 0.5 { 5.0 } else { -5.0 };
        (Joints { l, bar, m }, rate / l[0].sqrt())
    })
}
