//! Momenta integrated by parts: another equal form of d/dt p = f.
//!
//! Where p = Σ a b with functions a of known rates, d/dt p = Σ a′ b + Σ a b′. Of a kinetic energy ½ Σ m u²
//! with u = dx/dt, the terms a′ b are those that ∂T/∂q holds, too (d'Alembert's principle: what is left is
//! Σ ∂x/∂q m ü). They cancel, and with them their convolutions:
//!
//! s′ = Σ a b′,  d/dt s = f − Σ a′ b.
//!
//! The series of s is affine in the unknown velocities with the same matrix as that of p, because a does not
//! depend on them.

use super::auxiliary::{Auxiliary, Relation, Value};
use crate::collections::Lookup;
use crate::expr::{Exponent, Graph, Node, NodeId, Variable};
use crate::number::Number;

const ONCE: Exponent = Exponent(2);

/// The functions with polynomial rates, and their rates.
pub(super) struct Rates<'a> {
    /// Rates of coordinates and of the time.
    pub direction: &'a Lookup<NodeId, NodeId>,
    /// Auxiliaries, by index.
    pub auxiliaries: &'a [Auxiliary],
}

impl Rates<'_> {
    fn of(&self, graph: &Graph, node: NodeId) -> Option<NodeId> {
        if let Node::Variable(Variable::Auxiliary(index)) = *graph.node(node) {
            return match self.auxiliaries.get(index as usize)?.relation {
                Relation::Flow(rate) => Some(rate),
                _ => None,
            };
        }
        self.direction.get(&node).copied()
    }
}

/// A term of a momentum, a b.
struct Term {
    coefficient: Number,
    /// a; 1 if there is none.
    slope: NodeId,
    /// b.
    argument: NodeId,
    /// The terms of a′ b, with their coefficients.
    lost: Vec<(NodeId, Number)>,
}

/// Replaces momenta and their rates, the first roots, if all terms a′ b cancel. Returns the auxiliaries that
/// it adds.
pub(super) fn by_parts(
    graph: &mut Graph,
    roots: &mut [NodeId],
    count: usize,
    rates: &Rates<'_>,
) -> Vec<Auxiliary> {
    let mut added = Vec::new();
    for i in 0..count {
        let (momentum, force) = (roots[i], roots[count + i]);
        let Some(terms) = terms(graph, momentum, rates) else { continue };
        let lost: Vec<_> = terms.iter().flat_map(|term| term.lost.iter().copied()).collect();
        let Some(force) = without(graph, force, &lost) else { continue };
        let mut groups: Vec<(Number, Vec<(NodeId, NodeId)>)> = Vec::new();
        for term in terms {
            let pair = (term.slope, term.argument);
            match groups.iter_mut().find(|(coefficient, _)| *coefficient == term.coefficient) {
                Some((_, pairs)) => pairs.push(pair),
                None => groups.push((term.coefficient, vec![pair])),
            }
        }
        let mut parts = Vec::with_capacity(groups.len());
        for (coefficient, pairs) in groups {
            let index = (rates.auxiliaries.len() + added.len()) as u32;
            let products: Vec<_> = pairs.iter().map(|&(a, b)| (graph.mul(a, b), Number::ONE)).collect();
            let value = graph.sum(Number::ZERO, &products);
            added.push(Auxiliary {
                origin: value,
                value: Value::Same(value),
                relation: Relation::Chain(pairs),
            });
            parts.push((graph.variable(Variable::Auxiliary(index)), coefficient));
        }
        roots[i] = graph.sum(Number::ZERO, &parts);
        roots[count + i] = force;
    }
    added
}

/// The terms of a momentum; `None` if there is nothing to gain.
fn terms(graph: &mut Graph, momentum: NodeId, rates: &Rates<'_>) -> Option<Vec<Term>> {
    let sum = match graph.node(momentum).clone() {
        Node::Sum { terms, .. } => terms,
        _ => vec![(momentum, Number::ONE)],
    };
    let mut found = Vec::with_capacity(sum.len());
    for (node, coefficient) in sum {
        let factors = graph.factors(node);
        let (known, rest): (Vec<_>, Vec<_>) = factors.iter().copied().partition(|&(factor, exponent)| {
            exponent.as_integer().is_some_and(|power| power > 0) && rates.of(graph, factor).is_some()
        });
        if rest.is_empty() {
            return None;
        }
        let (slope, argument) = (graph.product(&known), graph.product(&rest));
        let mut lost = Vec::new();
        for &(factor, exponent) in &known {
            let Some(rate) = rates.of(graph, factor) else { continue };
            let mut others = factors.clone();
            if let Some(other) = others.iter_mut().find(|&&mut (other, _)| other == factor) {
                other.1 = Exponent(other.1.0 - ONCE.0);
            }
            others.retain(|&(_, exponent)| exponent.0 != 0);
            let power = Number::halves(exponent.0);
            let rate = match graph.node(rate).clone() {
                Node::Sum { offset, terms } if offset.is_zero() => terms,
                _ => vec![(rate, Number::ONE)],
            };
            for (term, share) in rate {
                let mut product = others.clone();
                for (factor, exponent) in graph.factors(term) {
                    match product.iter_mut().find(|(known, _)| *known == factor) {
                        Some((_, known)) => known.0 += exponent.0,
                        None => product.push((factor, exponent)),
                    }
                }
                lost.push((graph.product(&product), coefficient * power * share));
            }
        }
        found.push(Term { coefficient, slope, argument, lost });
    }
    found.iter().any(|term| !term.lost.is_empty()).then_some(found)
}

/// `force` less the terms, if it contains all of them.
fn without(graph: &mut Graph, force: NodeId, lost: &[(NodeId, Number)]) -> Option<NodeId> {
    lost.iter().try_fold(force, |force, &(term, coefficient)| {
        less(graph, force, (term, coefficient), &mut Vec::new())
    })
}

/// `node` less a term that it contains, be it inside a product with a sum. `tried` are the nodes that were
/// searched for a product.
fn less(
    graph: &mut Graph,
    node: NodeId,
    (product, coefficient): (NodeId, Number),
    tried: &mut Vec<(NodeId, NodeId)>,
) -> Option<NodeId> {
    if node == product && coefficient.is_one() {
        return Some(graph.zero());
    }
    if tried.contains(&(node, product)) {
        return None;
    }
    tried.push((node, product));
    match graph.node(node).clone() {
        Node::Sum { offset, mut terms } => {
            if let Some(index) = terms.iter().position(|&term| term == (product, coefficient)) {
                terms.remove(index);
                return Some(graph.sum(offset, &terms));
            }
            let index = (0..terms.len()).find_map(|index| {
                let (term, share) = terms[index];
                // The rates of kinetic energies and of momenta have the same factors, up to the sign.
                let coefficient = if share.is_one() {
                    coefficient
                } else if share == Number::MINUS_ONE {
                    -coefficient
                } else {
                    return None;
                };
                less(graph, term, (product, coefficient), tried).map(|left| (index, left))
            });
            let (index, left) = index?;
            terms[index].0 = left;
            Some(graph.sum(offset, &terms))
        }
        Node::Product(factors) => {
            let wanted = graph.factors(product);
            for (index, &(sum, exponent)) in factors.iter().enumerate() {
                if exponent != ONCE || !matches!(graph.node(sum), Node::Sum { .. }) {
                    continue;
                }
                let mut others = factors.clone();
                others.remove(index);
                let Some(rest) = quotient(&wanted, &others) else { continue };
                let rest = graph.product(&rest);
                if let Some(left) = less(graph, sum, (rest, coefficient), tried) {
                    others.push((left, ONCE));
                    return Some(graph.product(&others));
                }
            }
            None
        }
        _ => None,
    }
}

/// The remaining factors of a product after a division without remainder.
fn quotient(
    product: &[(NodeId, Exponent)],
    divisor: &[(NodeId, Exponent)],
) -> Option<Vec<(NodeId, Exponent)>> {
    let mut left = product.to_vec();
    for &(factor, exponent) in divisor {
        let (_, known) = left.iter_mut().find(|(known, _)| *known == factor)?;
        if known.0 < exponent.0 {
            return None;
        }
        known.0 -= exponent.0;
    }
    left.retain(|&(_, exponent)| exponent.0 != 0);
    Some(left)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flow(graph: &mut Graph, value: NodeId, rate: NodeId) -> Auxiliary {
        let origin = graph.constant(Number::ZERO);
        Auxiliary { origin, value: Value::Same(value), relation: Relation::Flow(rate) }
    }

    #[test]
    fn a_rod_needs_the_rates_of_its_momentum_alone() {
        let mut graph = Graph::default();
        let [v, w] = [0, 1].map(|i| graph.variable(Variable::Velocity(i)));
        let [sine, cosine] = [0, 1].map(|i| graph.variable(Variable::Auxiliary(i)));
        let (flow_of_sine, product) = (graph.mul(v, cosine), graph.mul(v, sine));
        let flow_of_cosine = graph.neg(product);
        let auxiliaries = [flow(&mut graph, sine, flow_of_sine), flow(&mut graph, cosine, flow_of_cosine)];
        // The velocity (x, y) of a mass on a rod whose support has the velocity (w, 2 w).
        let x = graph.sum(Number::ZERO, &[(flow_of_sine, Number::ONE), (w, Number::ONE)]);
        let y = graph.sum(Number::ZERO, &[(product, Number::ONE), (w, Number::integer(2))]);
        let [along, across] = [graph.mul(cosine, x), graph.mul(sine, y)];
        let momentum = graph.add(along, across);
        // −s (v x + 49) + v c y
        let turned = graph.mul(v, x);
        let pulled = graph.sum(Number::integer(49), &[(turned, Number::ONE)]);
        let [lost, gained] =
            [graph.mul(sine, pulled), graph.product(&[(v, ONCE), (cosine, ONCE), (y, ONCE)])];
        let force = graph.sub(gained, lost);
        let rates = Rates { direction: &Lookup::default(), auxiliaries: &auxiliaries };

        let mut roots = [momentum, force];
        let added = by_parts(&mut graph, &mut roots, 1, &rates);
        let weight = graph.scale(sine, Number::integer(-49));
        assert_eq!(roots, [graph.variable(Variable::Auxiliary(2)), weight]);
        let [Auxiliary { relation: Relation::Chain(terms), .. }] = &added[..] else { panic!("{added:?}") };
        assert_eq!(terms.len(), 2);
        assert!([(cosine, x), (sine, y)].iter().all(|term| terms.contains(term)));

        // With another sign, nothing cancels.
        let mut roots = [momentum, graph.add(gained, lost)];
        let before = roots;
        assert!(by_parts(&mut graph, &mut roots, 1, &rates).is_empty());
        assert_eq!(roots, before);
    }

    #[test]
    fn a_momentum_that_is_conserved_stays() {
        let mut graph = Graph::default();
        let [r, angle] = [0, 1].map(|i| graph.variable(Variable::Coordinate(i)));
        let [rate, turn] = [0, 1].map(|i| graph.variable(Variable::Velocity(i)));
        let square = graph.powi(r, 2);
        let momentum = graph.mul(square, turn);
        let mut roots = [momentum, graph.zero()];
        let mut direction = Lookup::default();
        [(r, rate), (angle, turn)]
            .into_iter()
            .for_each(|(variable, rate)| _ = direction.insert(variable, rate));
        let rates = Rates { direction: &direction, auxiliaries: &[] };
        assert!(by_parts(&mut graph, &mut roots, 1, &rates).is_empty());
        assert_eq!(roots[0], momentum);
    }
}
