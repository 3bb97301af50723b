//! The parallelogram by the places of its joints in space, in a plane that leans.

use lagrangian::prelude::*;

use super::super::curve::{Point, offsets, run};
use super::Starts;

/// Bars of 1 m without mass between joints of 1 kg and 1.5 kg.
#[derive(Clone, Copy, Debug)]
pub struct Leaning;

/// Orthonormal: along the ground, across it in the plane, and normal to the plane.
const ALONG: [f64; 3] = [2.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0];
const ACROSS: [f64; 3] = [-2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0];
const NORMAL: [f64; 3] = [1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0];

#[lagrangian(coordinates = [first: [3], second: [3]])]
impl Leaning {
    #[point(mass = 1.0)]
    fn one(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::from(q.first)
    }

    #[point(mass = 1.5)]
    fn two(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::from(q.second)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (self.one(q).z + 1.5 * self.two(q).z)
    }

    #[holonomic]
    fn lengths(&self, q: &Coordinates) -> [f64; 3] {
        let ground = Vector3::from(ALONG);
        [
            self.one(q).norm_squared() - 1.0,
            (self.two(q) - ground).norm_squared() - 1.0,
            (self.two(q) - self.one(q)).norm_squared() - 1.0,
        ]
    }

    #[holonomic]
    fn plane(&self, q: &Coordinates) -> [f64; 2] {
        let normal = Vector3::from(NORMAL);
        [self.one(q).dot(&normal), self.two(q).dot(&normal)]
    }
}

/// Both joints on circles.
fn curve(s: f64) -> Point<6> {
    let (sin, cos) = s.sin_cos();
    let place = |i: usize| cos * ALONG[i % 3] + sin * ACROSS[i % 3] + if i < 3 { 0.0 } else { ALONG[i % 3] };
    let tangent = |i: usize| cos * ACROSS[i % 3] - sin * ALONG[i % 3];
    (std::array::from_fn(place), std::array::from_fn(tangent))
}

/// Through flat at 5 rad/s.
pub fn starts(count: usize) -> Starts<Leaning, 6> {
    Starts {
        name: "points3",
        runs: offsets(count).filter_map(|d| run(Leaning, curve, d, 5.0, 0.5, 0.1)).collect(),
    }
}
