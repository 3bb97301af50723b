//! A slider-crank with equal bars. With the slider at the crank's hinge both bars could turn on as one, the
//! slider at rest.

use std::f64::consts::FRAC_PI_2;

use lagrangian::prelude::*;

use super::super::curve::{Point, Random, offsets, run};
use super::Starts;

/// Equal bars.
#[derive(Clone, Copy, Debug)]
pub struct SliderCrank {
    /// Length of both bars [m].
    pub l: f64,
    /// Masses of knee and slider [kg].
    pub m: [f64; 2],
    /// Moment of inertia of the rod, beside those masses [kg m²].
    pub rod: f64,
}

#[lagrangian(coordinates = [a, b, s])]
impl SliderCrank {
    #[point(mass = self.m[0])]
    fn knee(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a.cos(), q.a.sin()) * self.l
    }

    #[point(mass = self.m[1])]
    fn slider(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.s, 0.0)
    }

    #[kinetic]
    fn rod(&self, v: &Velocities) -> f64 {
        0.5 * self.rod * v.b * v.b
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.m[0] * self.knee(q).y
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> Vector2<f64> {
        (Vector2::new(q.a.cos(), q.a.sin()) + Vector2::new(q.b.cos(), q.b.sin())) * self.l - self.slider(q)
    }
}

/// The slider moving on.
fn curve(l: f64) -> impl Fn(f64) -> Point<3> {
    move |s| {
        let (sin, cos) = s.sin_cos();
        let (a, x) = (FRAC_PI_2 + s, -2.0 * l * sin);
        ([a, -a, x], [1.0, -1.0, -2.0 * l * cos])
    }
}

/// Half of the starts with equal masses, half at random.
pub fn starts(count: usize) -> Starts<SliderCrank, 3> {
    let mut random = Random(4);
    let runs = offsets(count).filter_map(|d| {
        let mut system = SliderCrank { l: 1.0, m: [1.0, 1.0], rod: 0.1 };
        let mut rate = 5.0;
        if random.unit() < 0.5 {
            system.l = random.between(0.5, 1.5);
            system.m = [random.between(0.2, 3.0), random.between(0.2, 3.0)];
            system.rod = random.between(0.05, 0.5);
            rate = if random.unit() < 0.5 { 5.0 } else { -5.0 };
        }
        run(system, curve(system.l), d, rate, 0.5, 0.1)
    });
    Starts { name: "slider", runs: runs.collect() }
}
