//! The solution of an order by the factors of a mass matrix that is not formed.

use super::bare;
use super::order::Writer;
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

/// All factors, in a fixed order.
pub(super) fn nodes(recursion: &Recursion) -> Vec<NodeId> {
    let mut nodes = Vec::new();
    for step in &recursion.steps {
        let (inverse, terms) = match step {
            Step::Substitute { terms, .. } => (None, terms),
            Step::Eliminate { inverse, terms, .. } => (Some(*inverse), terms),
        };
        nodes.extend(inverse);
        nodes.extend(terms.iter().map(|&(_, factor)| factor));
    }
    nodes
}

/// Statements that name the factors, from the texts of [`nodes`].
pub(super) fn at_start(
    model: &Model,
    scalar: &Scalar,
    recursion: &Recursion,
    outputs: &mut impl Iterator<Item = String>,
    names: &mut Names,
) -> (String, Named) {
    let mut text = String::new();
    let mut next = || outputs.next().expect("jets: as many texts as factors");
    let mut bind = |value: String, wish: &str| {
        if value.chars().all(|c| c == '_' || c == '.' || c.is_alphanumeric()) {
            return value;
        }
        let name = names.claim(Some(wish.to_owned()));
        text.push_str(&super::binding(scalar, &name, &value));
        name
    };
    let mut inverses = Vec::new();
    let steps = recursion
        .steps
        .iter()
        .map(|step| {
            let (unknown, is_eliminated, terms) = match step {
                Step::Substitute { unknown, terms } => (*unknown, false, terms),
                Step::Eliminate { unknown, terms, .. } => (*unknown, true, terms),
            };
            let label = model.coordinates.get(unknown).map(|quantity| quantity.label()).unwrap_or_default();
            let inverse = is_eliminated.then(|| bind(next(), &format!("{label}_inverse")));
            inverses.extend(inverse.clone());
            let terms = terms
                .iter()
                .map(|&(x, node)| {
                    let factor = bind(next(), "factor");
                    (x, (!model.graph.as_constant(node).is_some_and(Number::is_one)).then_some(factor))
                })
                .collect();
            NamedStep { unknown, inverse, terms }
        })
        .collect();
    text.push_str(&format!(
        "if ![{}].iter().all(|inverse| Real::is_finite(*inverse)) {{ return false; }}\n",
        inverses.join(", ")
    ));
    (text, Named { steps, unknowns: recursion.unknowns })
}

impl Writer<'_, '_> {
    /// Loads through the steps, and the solution back through them.
    pub(super) fn solve_by_recursion(
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
        let mut asked = vec![false; named.unknowns];
        for step in named.steps.iter().filter(|step| step.inverse.is_some()) {
            step.terms.iter().for_each(|&(x, _)| asked[x] = true);
        }
        for step in &named.steps {
            if asked[step.unknown] {
                step.terms.iter().for_each(|&(x, _)| asked[x] = true);
            }
        }
        for step in named.steps.iter().rev() {
            let start = match (&step.inverse, &own[step.unknown]) {
                (Some(inverse), Some(load)) => Some(format!("({inverse} * {load})")),
                (Some(_), None) => None,
                (None, _) if !asked[step.unknown] => continue,
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
                (Some(sum), Some(factor)) => format!("Real::mul_add({sign}{factor}, {value}, {})", bare(&sum)),
            })
        })
    }
}
