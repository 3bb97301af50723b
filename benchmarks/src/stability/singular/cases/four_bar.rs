//! Four-bar linkages by the angles of their moving bars, with the closing hinge as two constraints.

use std::f64::consts::PI;

use lagrangian::prelude::*;

use super::super::curve::{Point, Random, offsets, run};
use super::super::runs::Run;
use super::Starts;

/// Three moving bars (crank, coupler, rocker) and the ground.
#[derive(Clone, Copy, Debug)]
pub struct FourBar {
    /// Lengths of the moving bars [m].
    pub l: [f64; 3],
    /// Length of the ground [m].
    pub ground: f64,
    /// Masses [kg].
    pub m: [f64; 3],
    /// Moments of inertia about the centres [kg m²].
    pub inertia: [f64; 3],
    /// Where the centres are, as a share of the length from the first end.
    pub centre: [f64; 3],
    /// Gravitational acceleration [m/s²].
    pub g: [f64; 2],
}

#[lagrangian(coordinates = [angle: [3]])]
impl FourBar {
    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        self.l[0] * Self::along(q.angle[0])
    }

    #[body(mass = self.m[0], inertia = self.inertia[0])]
    fn crank(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (self.centre[0] * self.tip(q), q.angle[0])
    }

    #[body(mass = self.m[1], inertia = self.inertia[1])]
    fn coupler(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (self.tip(q) + self.centre[1] * self.l[1] * Self::along(q.angle[1]), q.angle[1])
    }

    #[body(mass = self.m[2], inertia = self.inertia[2])]
    fn rocker(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(self.ground, 0.0) + self.centre[2] * self.l[2] * Self::along(q.angle[2]), q.angle[2])
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let down = Vector2::new(self.g[0], self.g[1]);
        -(self.m[0] * self.crank(q).0 + self.m[1] * self.coupler(q).0 + self.m[2] * self.rocker(q).0)
            .dot(&down)
    }

    #[holonomic]
    fn hinge(&self, q: &Coordinates) -> Vector2<f64> {
        self.tip(q) + self.l[1] * Self::along(q.angle[1])
            - self.l[2] * Self::along(q.angle[2])
            - Vector2::new(self.ground, 0.0)
    }
}

/// Duration of all runs [s].
const SPAN: f64 = 0.5;
/// The part of it after which they are away from the position that they start beside.
const SHARE: f64 = 0.1;

/// Bars of 1 m and 1 kg.
const EQUAL: FourBar = FourBar {
    l: [1.0; 3],
    ground: 1.0,
    m: [1.0; 3],
    inertia: [1.0 / 12.0; 3],
    centre: [0.5; 3],
    g: [0.0, -9.81],
};

/// The motion as a parallelogram.
fn parallel(s: f64) -> Point<3> {
    ([s, 0.0, s], [1.0, 0.0, 1.0])
}

/// Equal bars, through the flat position or away from it at 5 rad/s.
pub fn equal(count: usize) -> Starts<FourBar, 3> {
    Starts {
        name: "angles",
        runs: offsets(count).filter_map(|d| run(EQUAL, parallel, d, 5.0, SPAN, SHARE)).collect(),
    }
}

/// Masses and proportions of the parallelogram at random, in both directions.
pub fn unequal(count: usize) -> Starts<FourBar, 3> {
    let mut random = Random(1);
    let runs = offsets(count).filter_map(|d| {
        let (crank, ground) = (random.between(0.5, 1.5), random.between(0.5, 1.5));
        let system = bars([crank, ground, crank], ground, [0.0, -9.81], &mut random);
        let rate = if random.unit() < 0.5 { 5.0 } else { -5.0 };
        run(system, parallel, d, rate / crank.sqrt(), SPAN, SHARE)
    });
    Starts { name: "angles-unequal", runs: runs.collect() }
}

/// Bars with masses, inertias and centres at random.
fn bars(l: [f64; 3], ground: f64, g: [f64; 2], random: &mut Random) -> FourBar {
    let m = [(); 3].map(|()| random.between(0.2, 3.0));
    let centre = [(); 3].map(|()| random.between(0.2, 0.8));
    let inertia: [f64; 3] = std::array::from_fn(|i| m[i] * l[i] * l[i] * random.between(0.02, 0.2));
    FourBar { l, ground, m, inertia, centre, g }
}

/// Linkages whose shortest and longest bars are together as long as the others, so that they can lie flat:
/// lengths, masses, inertias and gravity at random.
pub fn random(count: usize) -> Starts<FourBar, 3> {
    let mut random = Random(2);
    let mut runs = Vec::with_capacity(count);
    for d in offsets(count) {
        // Most proportions have a curve of the kind that is followed here, and most motions go on for long
        // enough.
        for _ in 0..100 {
            if let Some(found) = flat(d, &mut random) {
                runs.push(found);
                break;
            }
        }
    }
    Starts { name: "random", runs }
}

/// A linkage at random that lies flat in some way, and a run from beside there.
fn flat(offset: f64, random: &mut Random) -> Option<Run<FourBar, 3>> {
    let l = [(); 3].map(|()| random.between(0.3, 1.5));
    // Directions of the bars as they lie flat; all other signs give no ground, or a linkage that cannot move.
    let sign = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0]][(3.0 * random.unit()) as usize];
    let signed: [f64; 3] = std::array::from_fn(|i| sign[i] * l[i]);
    let ground = signed[0] + signed[1] - signed[2];
    // Proportions that are almost those of a parallelogram or a kite have another singular position at once.
    let apart = |a: f64, b: f64| (a.abs() - b.abs()).abs() > 0.1;
    if ground < 0.2 || !apart(l[0], l[2]) || !apart(l[1], l[2]) || !apart(l[0], l[1]) || !apart(l[2], ground)
    {
        return None;
    }
    let down = random.between(-PI, PI);
    let system = bars(l, ground, [9.81 * down.cos(), 9.81 * down.sin()], random);
    let conic = Conic::of(signed, ground, random.unit() < 0.5)?;
    let fastest = conic.at(0.0).1.iter().fold(0.0_f64, |max, x| max.max(x.abs()));
    let rate = if random.unit() < 0.5 { 5.0 } else { -5.0 };
    let turn = sign.map(|s| if s < 0.0 { PI } else { 0.0 });
    let curve = |s: f64| {
        let (q, tangent) = conic.at(s);
        (std::array::from_fn(|i| q[i] + turn[i]), tangent)
    };
    run(system, curve, offset / fastest, rate / fastest, SPAN, SHARE)
}

/// All configurations of a linkage that lies flat where its angles vanish, its lengths signed. With t and u
/// the tangents of half the angles of crank and rocker, closure is a polynomial c₂₂t²u² + c₂₀t² + c₁₁tu +
/// c₀₂u², and with k = u/t a conic in (k, u) whose two points u = 0 are the two branches through flat.
struct Conic {
    l: [f64; 3],
    ground: f64,
    /// Middle of k, and half its range.
    k: [f64; 2],
    /// Half the range of u.
    u: f64,
}

impl Conic {
    /// The curve, if it is an ellipse, with one or the other branch at parameter zero.
    fn of(l: [f64; 3], ground: f64, other: bool) -> Option<Self> {
        let [a, b, c] = l;
        let c20 = 4.0 * a * (a + b);
        let c02 = 4.0 * c * (c - b);
        let c22 = 4.0 * (a - c) * ground;
        let c11 = -8.0 * a * c;
        let ratio = c02 / c22;
        if ratio <= 0.0 {
            return None;
        }
        let middle = -c11 / (2.0 * c02);
        let half = (middle * middle - c20 / c02).sqrt() * if other { -1.0 } else { 1.0 };
        Some(Self { l, ground, k: [middle, half], u: half * ratio.sqrt() })
    }

    /// The angles at a parameter, with their derivatives.
    fn at(&self, s: f64) -> Point<3> {
        let ([a, b, c], [middle, half]) = (self.l, self.k);
        let side = (middle + half).signum();
        let (k, k1) = ((middle + half * s.cos()) * side, -half * s.sin() * side);
        let (u, u1) = (self.u * s.sin(), self.u * s.cos());
        let (crank, crank1) = (2.0 * (u * side).atan2(k), 2.0 * side * (u1 * k - u * k1) / (k * k + u * u));
        let (rocker, rocker1) = (2.0 * u.atan(), 2.0 * u1 / (1.0 + u * u));
        let x = self.ground + c * rocker.cos() - a * crank.cos();
        let y = c * rocker.sin() - a * crank.sin();
        let coupler = (y / b).atan2(x / b);
        let coupler1 = (c * rocker1 * (rocker - coupler).cos() - a * crank1 * (crank - coupler).cos()) / b;
        ([crank, coupler, rocker], [crank1, coupler1, rocker1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Starts, later states and ends: the curve is that of the constraints, and so is its tangent.
    #[test]
    fn curves_are_on_the_constraints() {
        let starts = [equal(20), unequal(20), random(200)];
        assert!(starts.iter().all(|starts| starts.runs.len() >= 19));
        for run in starts.iter().flat_map(|starts| &starts.runs) {
            for state in [run.start, run.regular, run.end] {
                let fastest = state.v.iter().fold(1.0_f64, |max, v| max.max(v.abs()));
                for residual in run.system.constraint_residuals(&state) {
                    assert!(residual.abs() < 1e-14, "{residual:e}");
                }
                for rate in run.system.constraint_rates(&state) {
                    assert!(rate.abs() < 1e-13 * fastest, "{rate:e}");
                }
            }
            let energy = run.system.energy(&run.start);
            assert!((run.system.energy(&run.end) - energy).abs() < 1e-12 * (1.0 + energy.abs()));
        }
    }
}
