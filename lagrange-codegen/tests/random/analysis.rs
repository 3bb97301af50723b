//! The results of analysis of random systems, against identities: inertia forces add up, Christoffel symbols
//! contract to the Coriolis matrix, the regressor gives the equations, the parts of T give the Lagrangian.

#![allow(clippy::needless_range_loop, reason = "formulas with indices")]

use lagrange_codegen::calculus::{pullback, pushforward};
use lagrange_codegen::diagnostics::Diagnostics;
use lagrange_codegen::expr::{Graph, NodeId, Variable};
use lagrange_codegen::mechanics::analysis::{Covariant, Inertia, Regressor, christoffel};
use lagrange_codegen::mechanics::{Equations, derive};
use lagrange_codegen::model::Model;
use lagrange_codegen::number::Number;
use lagrange_codegen::{lower, syntax};

use crate::check::Sample;
use crate::source::Source;

/// The largest difference of the two sides of an identity, as a share of the terms that they are sums of.
const TOLERANCE: f64 = 1e-7;

/// The largest terms that are compared: sums of larger ones have too few digits.
const LARGEST: f64 = 1e6;

/// Comparisons made.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    pub covariant: usize,
    pub regressors: usize,
}

/// Checks all identities of one system at one sample.
pub fn check(source: &Source, sample: &Sample) -> Result<Counts, String> {
    let Some((mut model, equations)) = derived(source) else { return Ok(Counts::default()) };
    let count = equations.momenta.len();
    let accelerations: Vec<f64> = (0..count).map(|i| 0.7 - 0.4 * i as f64).collect();
    let mut judge = Judge { sample, accelerations: &accelerations, compared: 0 };
    let mut counts = Counts::default();

    let inertial = total(&mut model, &equations);
    if let Some(covariant) = Covariant::of(&mut model, &equations) {
        let inertia = Inertia::of(&mut model, &equations, &covariant);
        for i in 0..count {
            let parts =
                [inertia.relative[i], inertia.coriolis[i], inertia.gyroscopic[i], inertia.transport[i]];
            judge.sums(&model.graph, "inertia forces", &[&parts[..], &inertial[i]].concat())?;
        }
        let symbols = christoffel(&mut model, equations.mass.rows());
        let graph = &mut model.graph;
        let (time, one) = (graph.variable(Variable::Time), graph.one());
        for k in 0..count {
            for j in 0..count {
                let explicit =
                    pushforward(graph, &[equations.mass.rows()[k.max(j)][k.min(j)]], &[(time, one)])[0];
                let mut terms = vec![graph.neg(covariant.coriolis[k][j])];
                terms.push(graph.scale(explicit, Number::HALF));
                for i in 0..count {
                    let v = graph.variable(Variable::Velocity(i as u32));
                    terms.push(graph.mul(symbols[k][i.max(j)][i.min(j)], v));
                }
                judge.sums(graph, "Coriolis matrix", &terms)?;
            }
        }
        let [t2, t1, t0] = inertia.parts;
        let graph = &mut model.graph;
        let mut terms = vec![graph.neg(t2), graph.neg(t1), graph.neg(t0), equations.potential_energy];
        terms.push(graph.neg(equations.jacobi_integral.unwrap_or(equations.energy)));
        for (i, &p) in equations.momenta.iter().enumerate() {
            let v = graph.variable(Variable::Velocity(i as u32));
            terms.push(graph.mul(p, v));
        }
        judge.sums(&model.graph, "parts of the Lagrangian", &terms)?;
        counts.covariant = judge.compared;
    }
    if let Some(Regressor { lumped, columns }) = Regressor::of(&mut model, &equations) {
        for i in 0..count {
            let graph = &mut model.graph;
            let mut terms: Vec<NodeId> = lumped
                .iter()
                .zip(&columns)
                .map(|(&parameter, column)| {
                    let term = graph.mul(parameter, column[i]);
                    graph.neg(term)
                })
                .collect();
            terms.extend(mass_times_accelerations(&mut model, &equations, i));
            terms.push(equations.bias[i]);
            judge.sums(&model.graph, "regressor", &terms)?;
        }
        counts.regressors = judge.compared - counts.covariant;
    }
    Ok(counts)
}

/// The equations of a description, as facts are read off them.
pub fn derived(source: &Source) -> Option<(Model, Equations)> {
    let mut diagnostics = Diagnostics::new();
    let (arguments, item) = (source.arguments.parse().ok()?, source.item.parse().ok()?);
    let item = syntax::parse(arguments, item, "::lagrangian", &mut diagnostics)?;
    let mut model = lower::lower(&item, &mut diagnostics);
    let equations = derive(&mut model, true, &|lint| item.allows(lint), &mut diagnostics)?;
    let simplified = equations.simplified(&mut model);
    Some((model, simplified))
}

fn mass_times_accelerations(model: &mut Model, equations: &Equations, i: usize) -> Vec<NodeId> {
    (0..equations.momenta.len())
        .map(|j| {
            let a = model.graph.variable(Variable::Acceleration(j as u32));
            model.graph.mul(equations.mass.rows()[i.max(j)][i.min(j)], a)
        })
        .collect()
}

/// M a + b − ∂V/∂q.
fn total(model: &mut Model, equations: &Equations) -> Vec<Vec<NodeId>> {
    let count = equations.momenta.len();
    let q: Vec<NodeId> = (0..count as u32).map(|i| model.graph.variable(Variable::Coordinate(i))).collect();
    let minus_one = model.graph.constant(Number::MINUS_ONE);
    let slopes = pullback(&mut model.graph, &[(equations.potential_energy, minus_one)], &q);
    (0..count)
        .map(|i| {
            let mut terms = mass_times_accelerations(model, equations, i);
            terms.extend([equations.bias[i], slopes[i]]);
            terms
        })
        .collect()
}

struct Judge<'a> {
    sample: &'a Sample,
    accelerations: &'a [f64],
    compared: usize,
}

impl Judge<'_> {
    /// Whether some terms add up to zero.
    fn sums(&mut self, graph: &Graph, what: &str, terms: &[NodeId]) -> Result<(), String> {
        let values = graph.evaluate(terms, |variable| match variable {
            Variable::Coordinate(i) => self.sample.q[i as usize],
            Variable::Velocity(i) => self.sample.v[i as usize],
            Variable::Acceleration(i) => self.accelerations[i as usize],
            Variable::Time => self.sample.t,
            Variable::Input(i) => self.sample.u[i as usize],
            Variable::Parameter(i) => self.sample.parameters[i as usize % self.sample.parameters.len()],
            Variable::Auxiliary(_) | Variable::Entry(_) | Variable::Multiplier(_) | Variable::Position(_) => {
                f64::NAN
            }
        });
        let size = values.iter().fold(1.0, |size: f64, value| size + value.abs());
        // The values are outside the domain of a function, or too large to tell.
        if !size.is_finite() || size > LARGEST {
            return Ok(());
        }
        self.compared += 1;
        let sum: f64 = values.iter().sum();
        if sum.abs() <= TOLERANCE * size {
            Ok(())
        } else {
            Err(format!("{what}: {values:?} add up to {sum:e}"))
        }
    }
}
