//! Parallel cranks: under one coupler, where all hinges but two are redundant; and in a row with a coupler
//! from each to the next.

use lagrangian::prelude::*;

use super::super::curve::{Point, offsets, run};
use super::Starts;

/// One coupler on several cranks.
macro_rules! cranks {
    ($name:ident, $make:ident, $label:literal, $n:literal, $coordinates:literal, $rows:literal) => {
        #[doc = concat!("A coupler on ", $n, " cranks of 1 m and 1 kg, hinged at distances that are not equal.")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        #[lagrangian(coordinates = [t: [$n], x, y, phi], allow(redundant))]
        impl $name {
            #[kinetic]
            fn turning(&self, v: &Velocities) -> f64 {
                v.t.iter().map(|w| w * w / 6.0).sum()
            }

            #[body(mass = 2.0, inertia = 0.4)]
            fn coupler(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
                (Vector2::new(q.x, q.y), q.phi)
            }

            #[potential]
            fn gravity(&self, q: &Coordinates) -> f64 {
                let cranks: f64 = q.t.iter().map(|angle| 0.5 * angle.sin()).sum();
                9.81 * (2.0 * q.y + cranks)
            }

            #[holonomic]
            fn hinges(&self, q: &Coordinates) -> [f64; $rows] {
                let mut rows = [0.0; $rows];
                for i in 0..$n {
                    let at = 0.3 * i as f64 + 0.05 * (i * i) as f64;
                    rows[2 * i] = q.x + at * q.phi.cos() - at - q.t[i].cos();
                    rows[2 * i + 1] = q.y + at * q.phi.sin() - q.t[i].sin();
                }
                rows
            }
        }

        #[doc = concat!("Starts with ", $n, " cranks.")]
        pub fn $make(count: usize) -> Starts<$name, $coordinates> {
            let curve = |s: f64| -> Point<$coordinates> {
                let (mut q, mut tangent) = ([s; $coordinates], [1.0; $coordinates]);
                (q[$n], q[$n + 1], q[$n + 2]) = (s.cos(), s.sin(), 0.0);
                (tangent[$n], tangent[$n + 1], tangent[$n + 2]) = (-s.sin(), s.cos(), 0.0);
                (q, tangent)
            };
            starts($label, count, || $name, curve)
        }
    };
}

cranks!(Cranks2, two, "cranks2", 2, 5, 4);
cranks!(Cranks3, three, "cranks3", 3, 6, 6);
cranks!(Cranks8, eight, "cranks8", 8, 11, 16);

/// Four cranks of 1 m and 1 kg at distances of 1, 0.8 and 1.2 m, and a bar of 1 kg from each to the next.
#[derive(Clone, Copy, Debug)]
pub struct Row4;

#[lagrangian(coordinates = [crank: [4], coupler: [3]])]
impl Row4 {
    const GAPS: [f64; 3] = [1.0, 0.8, 1.2];

    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        v.crank.iter().map(|w| w * w / 6.0).sum()
    }

    #[body(mass = 1.0, inertia = 0.08)]
    fn couplers(&self, q: &Coordinates) -> [(Vector2<f64>, f64); 3] {
        core::array::from_fn(|i| {
            let middle = 0.5 * Self::GAPS[i] * Self::along(q.coupler[i]);
            let foot = Vector2::new(Self::GAPS.iter().take(i).sum(), 0.0);
            (foot + Self::along(q.crank[i]) + middle, q.coupler[i])
        })
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let cranks: f64 = q.crank.iter().map(|angle| 0.5 * angle.sin()).sum();
        let couplers: f64 = self.couplers(q).iter().map(|body| body.0.y).sum();
        9.81 * (cranks + couplers)
    }

    #[holonomic]
    fn hinges(&self, q: &Coordinates) -> [f64; 6] {
        let mut rows = [0.0; 6];
        for i in 0..3 {
            let gap = Self::along(q.crank[i]) + Self::GAPS[i] * Self::along(q.coupler[i])
                - Self::along(q.crank[i + 1])
                - Vector2::new(Self::GAPS[i], 0.0);
            rows[2 * i] = gap.x;
            rows[2 * i + 1] = gap.y;
        }
        rows
    }
}

/// Starts of the row.
pub fn row(count: usize) -> Starts<Row4, 7> {
    let curve = |s: f64| -> Point<7> { ([s, s, s, s, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]) };
    starts("row4", count, || Row4, curve)
}

/// Starts along a curve at 5 rad/s.
fn starts<S, const N: usize>(
    name: &'static str,
    count: usize,
    system: fn() -> S,
    curve: impl Fn(f64) -> Point<N>,
) -> Starts<S, N>
where
    S: System<N, 0, Scalar = f64>,
{
    let runs = offsets(count).filter_map(|d| run(system(), &curve, d, 5.0, 0.5, 0.1));
    Starts { name, runs: runs.collect() }
}
