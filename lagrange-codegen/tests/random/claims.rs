//! Claims about random Lagrangians given as a whole: every quantity that is said to be conserved, or free of
//! time, is so.
//!
//! The parts are those that claims could get wrong: terms linear in the velocities that depend on time, total
//! derivatives, which no equation shows, potentials of several summands, and functions that look constant at
//! first. They are written in any order, and as one function or as several with roles of their own.

use std::fmt::Write;

use lagrange_codegen::calculus::pushforward;
use lagrange_codegen::expr::{NodeId, Variable};
use lagrange_codegen::mechanics::Equations;
use lagrange_codegen::mechanics::analysis::integrals;
use lagrange_codegen::model::Model;
use lagrange_codegen::structure::Facts;
use proptest::prelude::*;

use crate::analysis::derived;
use crate::source::Source;

/// The largest rate of a conserved quantity, as a share of the terms that it is the sum of.
const TOLERANCE: f64 = 1e-9;

const KINETIC: [&str; 5] = [
    "0.5 * (v.x * v.x + v.y * v.y)",
    "0.5 * self.m * (v.x.powi(2) + v.y.powi(2))",
    "0.5 * self.m * (v.x * v.x + q.x * q.x * v.y * v.y)",
    "v.x.powi(2) + v.x * v.y + v.y.powi(2) + 0.1 * v.x.powi(4)",
    "0.5 * (v.x - t * v.y).powi(2) + 0.5 * v.y * v.y",
];

/// Functions of coordinates and velocities, with and without time.
const PARTS: [&str; 20] = [
    "q.x",
    "q.x * q.x",
    "q.y.powi(4)",
    "self.m * q.x * q.y",
    "(q.x - q.y).powi(2)",
    "(q.x * q.x + q.y * q.y).sqrt()",
    "(q.x - 30.0).max(0.0).powi(2)",
    "(q.y.abs() - 40.0).max(0.0)",
    "t * v.x",
    "t * v.y * q.x",
    "t * q.y * v.x + t * q.x * v.y",
    "t.cos() * (v.x + v.y)",
    "q.x * v.y - q.y * v.x",
    "(q.x * v.y - q.y * v.x) * t",
    "q.x + t * v.x",
    "2.0 * t * q.x * q.y + t * t * (v.x * q.y + q.x * v.y)",
    "t.cos() * q.y + t.sin() * v.y",
    "2.0 * q.x * v.x * q.y + q.x * q.x * v.y",
    "q.y * t.sin()",
    "2.0 * t + v.x",
];

const FACTORS: [&str; 4] = ["", "2.0 * ", "self.m * ", "-1.5 * "];

/// A description: its kinetic energy, and each part with a factor, a sign, and whether it is a function of
/// its own.
#[derive(Clone, Debug)]
pub struct Whole {
    kinetic: usize,
    parts: Vec<(usize, usize, bool, bool)>,
}

/// Kinetic energies with a few parts.
pub fn strategy() -> BoxedStrategy<Whole> {
    let part = (0..PARTS.len(), 0..FACTORS.len(), any::<bool>(), prop::bool::weighted(0.3));
    (0..KINETIC.len(), prop::collection::vec(part, 1..=5))
        .prop_map(|(kinetic, parts)| Whole { kinetic, parts })
        .boxed()
}

impl Whole {
    fn source(&self) -> Source {
        let mut whole = KINETIC[self.kinetic].to_owned();
        let mut others = String::new();
        for (place, &(part, factor, negative, is_own)) in self.parts.iter().enumerate() {
            let (part, factor) = (PARTS[part], FACTORS[factor]);
            let sign = if negative { "-" } else { "+" };
            let _ = match is_own {
                false => write!(whole, " {sign} {factor}({part})"),
                true if part.contains("v.") => writeln!(
                    others,
                    "#[lagrangian] fn part_{place}(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {{ \
                     {factor}({part}) }}"
                ),
                true => writeln!(
                    others,
                    "#[potential] fn part_{place}(&self, q: &Coordinates, t: f64) -> f64 {{ {factor}({part}) }}"
                ),
            };
        }
        Source {
            arguments: "coordinates = [x, y], allow(no_effect)".to_owned(),
            item: format!(
                "impl Model {{\n#[lagrangian] fn whole(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {{ \
                 {whole} }}\n{others}}}"
            ),
        }
    }
}

/// The numbers of claims.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    pub energies: usize,
    pub others: usize,
}

/// Checks every claim at points near and far.
pub fn check(whole: &Whole) -> Result<Counts, String> {
    let source = whole.source();
    let (mut model, equations) = derived(&source).ok_or_else(|| format!("not derived:\n{source}"))?;
    let facts = Facts::of(&model, &equations);
    let mut claimed = Vec::new();
    let mut counts = Counts::default();
    if facts.conserves() {
        claimed.push(("energy", equations.jacobi_integral.unwrap_or(equations.energy)));
        counts.energies += 1;
    }
    claimed.extend(facts.cyclic.iter().map(|&i| ("momentum of a cyclic coordinate", equations.momenta[i])));
    claimed.extend(
        integrals(&mut model, &equations).iter().map(|integral| ("Noether's integral", integral.value)),
    );
    counts.others += claimed.len() - counts.energies;
    for (name, node) in claimed {
        stays(&mut model, &equations, node).map_err(|error| format!("{name}: {error}\n{source}"))?;
    }
    if facts.autonomous {
        let still: Vec<NodeId> = equations.roots();
        let at = |t: f64| model.graph.evaluate(&still, |variable| value(variable, &POINTS[0], t, &[0.0; 2]));
        if at(0.3) != at(1.9) {
            return Err(format!("the equations depend on time\n{source}"));
        }
    }
    Ok(counts)
}

/// (x, y, vx, vy, m): near and far.
const POINTS: [[f64; 5]; 4] = [
    [0.4, -0.7, 0.9, 0.3, 1.3],
    [33.0, -2.0, 0.5, -0.8, 0.6],
    [-1.1, 44.0, -0.7, 1.4, 1.7],
    [51.0, -47.0, 0.2, 0.6, 0.9],
];

fn value(variable: Variable, point: &[f64; 5], t: f64, a: &[f64; 2]) -> f64 {
    match variable {
        Variable::Coordinate(i) => point[i as usize],
        Variable::Velocity(i) => point[2 + i as usize],
        Variable::Acceleration(i) => a[i as usize],
        Variable::Parameter(_) => point[4],
        Variable::Time => t,
        Variable::Input(_)
        | Variable::Auxiliary(_)
        | Variable::Entry(_)
        | Variable::Multiplier(_)
        | Variable::Position(_) => f64::NAN,
    }
}

/// Whether a quantity has no rate along the motion, by the chain rule with accelerations that are solved for.
fn stays(model: &mut Model, equations: &Equations, node: NodeId) -> Result<(), String> {
    let graph = &mut model.graph;
    let one = graph.one();
    let terms: Vec<NodeId> = [0, 1]
        .into_iter()
        .flat_map(|i| {
            let (q, v) = (Variable::Coordinate(i), Variable::Velocity(i));
            [(q, v), (v, Variable::Acceleration(i))]
        })
        .chain([(Variable::Time, Variable::Time)])
        .map(|(by, along)| {
            let by = graph.variable(by);
            let slope = pushforward(graph, &[node], &[(by, one)])[0];
            if along == Variable::Time {
                slope
            } else {
                let along = graph.variable(along);
                graph.mul(slope, along)
            }
        })
        .collect();
    for point in &POINTS {
        let t = 0.8;
        let solved = [equations.mass.rows()[0][0], equations.mass.rows()[1][0], equations.mass.rows()[1][1]];
        let solved =
            graph.evaluate(&[&solved[..], &equations.force].concat(), |v| value(v, point, t, &[0.0; 2]));
        let [m00, m10, m11, f0, f1] = solved[..] else { return Err("two coordinates".to_owned()) };
        let determinant = m00 * m11 - m10 * m10;
        let a = [(m11 * f0 - m10 * f1) / determinant, (m00 * f1 - m10 * f0) / determinant];
        let values = graph.evaluate(&terms, |v| value(v, point, t, &a));
        let size = values.iter().fold(1.0, |size: f64, value| size + value.abs());
        let rate: f64 = values.iter().sum();
        if rate.abs() > TOLERANCE * size {
            return Err(format!("rate {rate:e} of terms {values:?} at {point:?}"));
        }
    }
    Ok(())
}
