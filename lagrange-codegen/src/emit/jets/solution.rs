//! The solution of an order: by factorisations of blocks, or by the factors of a mass matrix that is not formed.

use super::bare;
use super::inertia::{AtStart, By};
use super::order::Writer;
use super::terms::chain;
use crate::emit::names::Names;
use crate::expr::NodeId;
use crate::model::Model;
use crate::number::Number;
use crate::structure::{Recursion, Step};
use crate::syntax::Scalar;

/// The steps with names for their factors.
pub(super) struct Named {
    steps: Vec<NamedStep>,
    unknowns: usize,
}

struct NamedStep {
    unknown: usize,
    /// 1 / pivot, where the unknown is eliminated.
    inverse: Option<String>,
    /// Other unknowns with what they are multiplied by; nothing stands for one.
    terms: Vec<(usize, Option<String>)>,
}

impl NamedStep {
    /// A term as a product that is added.
    fn product(&self, factor: &Option<String>, value: &str) -> Product {
        Product { negative: self.inverse.is_some(), factor: factor.clone(), value: value.to_owned() }
    }
}

struct Product {
    negative: bool,
    factor: Option<String>,
    value: String,
}

/// All factors, in a fixed order: of a velocity 1 / pivot first.
pub(super) fn nodes(recursion: &Recursion) -> Vec<NodeId> {
    let mut nodes = Vec::new();
    for step in &recursion.steps {
        if let Step::Eliminate { inverse, .. } = step {
            nodes.push(*inverse);
        }
        nodes.extend(step.terms().iter().map(|&(_, factor)| factor));
    }
    nodes
}

/// Statements that make the inverse of the matrix under a name, from the texts of [`nodes`].
pub(super) fn inverse(
    scalar: &Scalar,
    recursion: &Recursion,
    outputs: &mut impl Iterator<Item = String>,
    name: &str,
) -> String {
    let (places, count) = recursion.places();
    let (mut steps, mut factors) = (Vec::new(), 0);
    for step in &recursion.steps {
        let others: Vec<String> = step.terms().iter().map(|&(x, _)| places[x].to_string()).collect();
        factors += others.len() + usize::from(matches!(step, Step::Eliminate { .. }));
        let (place, others) = (places[step.unknown()], others.join(", "));
        steps.push(format!("lagrange::RecursionStep {{ place: {place}, others: &[{others}] }}"));
    }
    let (size, between) = (recursion.velocities, count - recursion.velocities);
    let factors: Vec<String> = outputs.take(factors).collect();
    format!(
        "let {name} = lagrange::Inverse::<{scalar}, {size}>::of::<{between}>(&[{}], &[{}]);\n\
         if !{name}.is_finite() {{ return false; }}\n",
        steps.join(", "),
        factors.join(", ")
    )
}

/// Statements that name the factors, from the texts of [`nodes`].
pub(super) fn named(
    model: &Model,
    scalar: &Scalar,
    recursion: &Recursion,
    outputs: &mut impl Iterator<Item = String>,
    names: &mut Names,
) -> (String, Named) {
    let mut text = String::new();
    let mut inverses = Vec::new();
    let mut next = |wish: &str| {
        let value = outputs.next().expect("jets: as many texts as factors");
        if value.chars().all(|c| c == '_' || c == '.' || c.is_alphanumeric()) {
            return value;
        }
        let name = names.claim(Some(wish.to_owned()));
        text.push_str(&super::binding(scalar, &name, &value));
        name
    };
    let steps = recursion
        .steps
        .iter()
        .map(|step| {
            let inverse = matches!(step, Step::Eliminate { .. }).then(|| next("inverse"));
            inverses.extend(inverse.clone());
            let is_one = |node: NodeId| model.graph.as_constant(node).is_some_and(Number::is_one);
            let factor = |&(x, node): &(usize, NodeId)| (x, Some(next("factor")).filter(|_| !is_one(node)));
            NamedStep { unknown: step.unknown(), inverse, terms: step.terms().iter().map(factor).collect() }
        })
        .collect();
    text.push_str(&format!(
        "if ![{}].iter().all(|inverse| Real::is_finite(*inverse)) {{ return false; }}\n",
        inverses.join(", ")
    ));
    (text, Named { steps, unknowns: recursion.unknowns })
}

impl Writer<'_, '_> {
    /// The velocities of an order, block by block.
    pub(super) fn solve(&mut self, mass: &AtStart, velocities: &[(String, String)]) {
        for solver in &mass.solvers {
            let mut right = Vec::with_capacity(solver.coordinates.len());
            for &i in &solver.coordinates {
                let mut momentum = self.sorted(self.context.read(self.jets.momenta[i]));
                momentum.iter_mut().for_each(|term| term.negative = !term.negative);
                let partial = chain(None, &momentum, |operand| self.partial_text(operand));
                right.push(match partial {
                    Some(partial) => format!("Real::mul_add(rate, {}, {partial})", self.forces[i]),
                    None => format!("(rate * {})", self.forces[i]),
                });
            }
            match &solver.by {
                By::Nothing => self.bind(&velocities[solver.coordinates[0]].1, &right[0]),
                By::Inverse(inverse) => {
                    let text = format!("{} * {inverse}", right[0]);
                    self.bind(&velocities[solver.coordinates[0]].1, &text);
                }
                By::Recursion(named) => {
                    self.solve_by_recursion(named, &solver.coordinates, &right, velocities)
                }
                By::Factor(factor) => {
                    let names: Vec<&str> =
                        solver.coordinates.iter().map(|&i| velocities[i].1.as_str()).collect();
                    let right: Vec<&str> = right.iter().map(|text| bare(text)).collect();
                    self.body.push_str(&format!(
                        "let [{}] = {factor}.solve([{}]);\n",
                        names.join(", "),
                        right.join(", ")
                    ));
                }
            }
        }
    }

    /// Loads through the steps, and the solution back through them.
    fn solve_by_recursion(
        &mut self,
        named: &Named,
        coordinates: &[usize],
        right: &[String],
        velocities: &[(String, String)],
    ) {
        let mut loads: Vec<Vec<Product>> = (0..named.unknowns).map(|_| Vec::new()).collect();
        let mut own: Vec<Option<String>> = vec![None; named.unknowns];
        for step in &named.steps {
            let start = right.get(step.unknown).cloned();
            let terms = std::mem::take(&mut loads[step.unknown]);
            let Some(load) = self.combined(start, &terms) else { continue };
            let is_name = |text: &str| text.chars().all(|c| c == '_' || c.is_alphanumeric());
            let load = if is_name(&load) {
                load
            } else {
                let name = self.names.claim(Some("load".to_owned()));
                self.bind(&name, &load);
                name
            };
            for (x, factor) in &step.terms {
                loads[*x].push(step.product(factor, &load));
            }
            own[step.unknown] = Some(load);
        }
        let mut values: Vec<Option<String>> = vec![None; named.unknowns];
        for step in named.steps.iter().rev() {
            let start = match (&step.inverse, &own[step.unknown]) {
                (Some(inverse), Some(load)) => Some(format!("({inverse} * {load})")),
                (Some(_), None) => None,
                (None, _) => None,
            };
            let terms: Vec<Product> = step
                .terms
                .iter()
                .filter_map(|(x, factor)| Some(step.product(factor, values[*x].as_deref()?)))
                .collect();
            let text = self.combined(start, &terms).unwrap_or_else(|| self.zero());
            let name = match coordinates.get(step.unknown) {
                Some(&coordinate) => velocities[coordinate].1.clone(),
                None => self.names.claim(Some("speed".to_owned())),
            };
            self.bind(&name, &text);
            values[step.unknown] = Some(name);
        }
    }

    /// A start and products as one chain; `None` for nothing.
    fn combined(&self, start: Option<String>, products: &[Product]) -> Option<String> {
        products.iter().fold(start, |sum, Product { negative, factor, value }| {
            let sign = if *negative { "-" } else { "" };
            Some(match (sum, factor) {
                (None, None) => format!("{sign}{value}"),
                (None, Some(factor)) => format!("({sign}{factor} * {value})"),
                (Some(sum), None) => format!("({sum} {} {value})", if *negative { "-" } else { "+" }),
                (Some(sum), Some(factor)) => {
                    format!("Real::mul_add({sign}{factor}, {value}, {})", bare(&sum))
                }
            })
        })
    }
}
