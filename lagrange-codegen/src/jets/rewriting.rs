//! Equal forms of p and f with fewer convolutions. Each is a proposal, and `Jets::cost` decides.

use super::auxiliary::{Auxiliary, Relation, Value};
use crate::calculus::rebuild;
use crate::collections::Lookup;
use crate::expr::{Exponent, Graph, Node, NodeId, Unary, Variable};
use crate::number::Number;

const ONCE: Exponent = Exponent(2);

/// Products of sines and cosines of two angles as functions of the sum or the difference:
/// cos a cos b + sin a sin b = cos(a − b). One series and its flow stand for two products and their sum.
pub(super) fn contract_angles(graph: &mut Graph, roots: &[NodeId]) -> Vec<NodeId> {
    rewrite(graph, roots, |graph, id, image| {
        let Node::Sum { offset, terms } = graph.node(id).clone() else { return None };
        let mut terms: Vec<_> = terms.iter().map(|&(term, c)| (image(term), c)).collect();
        let mut changed = false;
        'again: loop {
            for i in 0..terms.len() {
                for j in i + 1..terms.len() {
                    if let Some(term) = contracted(graph, terms[i], terms[j]) {
                        terms.swap_remove(j);
                        terms[i] = term;
                        changed = true;
                        continue 'again;
                    }
                }
            }
            break;
        }
        changed.then(|| graph.sum(offset, &terms))
    })
}

/// A sine or cosine among the factors of a product: the function and its argument.
type Trigonometric = (Unary, NodeId);

/// Two terms as one, if they are the two halves of an addition theorem.
fn contracted(
    graph: &mut Graph,
    first: (NodeId, Number),
    second: (NodeId, Number),
) -> Option<(NodeId, Number)> {
    let ((a, ca), (b, cb)) = (first, second);
    if ca.abs() != cb.abs() {
        return None;
    }
    let (Node::Product(left), Node::Product(right)) = (graph.node(a), graph.node(b)) else { return None };
    let common: Vec<_> = left.iter().copied().filter(|factor| right.contains(factor)).collect();
    let own = |factors: &[(NodeId, Exponent)]| -> Option<[Trigonometric; 2]> {
        let mut own = factors.iter().filter(|factor| !common.contains(factor)).map(|&(factor, exponent)| {
            match graph.node(factor) {
                &Node::Unary(function @ (Unary::Sin | Unary::Cos), argument) if exponent == ONCE => {
                    Some((function, argument))
                }
                _ => None,
            }
        });
        let pair = [own.next()??, own.next()??];
        own.next().is_none().then_some(pair)
    };
    let (left, right) = (own(left)?, own(right)?);
    let arguments = |pair: [Trigonometric; 2]| (pair[0].1, pair[1].1);
    let (x, y) = arguments(left);
    if x == y || ![(x, y), (y, x)].contains(&arguments(right)) {
        return None;
    }
    let of = |pair: [Trigonometric; 2], argument: NodeId| {
        if pair[0].1 == argument { pair[0].0 } else { pair[1].0 }
    };
    if of(left, x) == of(right, x) || of(left, y) == of(right, y) {
        return None;
    }
    // sin x sin y with cos x cos y, or sin x cos y with cos x sin y. The coefficient is that of the leading
    // term.
    let even = of(left, x) == of(left, y);
    let lead_is_left = if even { of(left, x) == Unary::Cos } else { of(left, x) == Unary::Sin };
    let (lead, other) = if lead_is_left { (ca, cb) } else { (cb, ca) };
    let same_sign = lead == other;
    let angle = match (even, same_sign) {
        (true, true) | (false, false) => graph.sub(x, y),
        (true, false) | (false, true) => graph.add(x, y),
    };
    let value = graph.unary(if even { Unary::Cos } else { Unary::Sin }, angle);
    let mut factors = common;
    factors.push((value, ONCE));
    Some((graph.product(&factors), lead))
}

/// Products over sums multiplied out where a factor times a term is the flow of an auxiliary, which is
/// computed anyway: s (X ω + g) = X (s ω) + g s, with the flow s ω of a cosine. `flows` are the polynomials
/// of such flows.
///
/// The graph would take the common factor out again, so the product becomes an auxiliary of its own.
pub(super) fn meet_flows(
    graph: &mut Graph,
    roots: &[NodeId],
    flows: &[NodeId],
    auxiliaries: &mut Vec<Auxiliary>,
) -> Vec<NodeId> {
    let mut pairs: Lookup<(NodeId, NodeId), NodeId> = Lookup::default();
    for &flow in flows {
        let bodies: Vec<NodeId> = match graph.node(flow) {
            Node::Sum { terms, .. } => terms.iter().map(|&(term, _)| term).collect(),
            _ => vec![flow],
        };
        for body in bodies {
            if let Node::Product(factors) = graph.node(body)
                && let [(a, ONCE), (b, ONCE)] = factors[..]
                && !pairs.contains(&(a, b))
            {
                let name = graph.variable(Variable::Auxiliary(auxiliaries.len() as u32));
                let (value, relation) = (Value::Same(body), Relation::Same(body));
                auxiliaries.push(Auxiliary { origin: body, value, relation });
                pairs.insert((a, b), name);
                pairs.insert((b, a), name);
            }
        }
    }
    let mut uses: Lookup<NodeId, u32> = Lookup::default();
    for id in graph.cone(roots.iter().copied()) {
        graph.operands(id, |operand| match uses.get_mut(&operand) {
            Some(uses) => *uses += 1,
            None => {
                uses.insert(operand, 1);
            }
        });
    }
    rewrite(graph, roots, |graph, id, image| {
        let Node::Product(factors) = graph.node(id) else { return None };
        // The partner of a factor in a term, as the product of both and the rest of the term.
        let met = |graph: &Graph, factor: NodeId, term: NodeId| match graph.node(term) {
            Node::Product(inner) => inner.iter().enumerate().find_map(|(index, &(partner, exponent))| {
                let product = *pairs.get(&(factor, partner))?;
                let mut rest = inner.clone();
                rest[index].1 = Exponent(exponent.0 - ONCE.0);
                rest.retain(|&(_, exponent)| exponent.0 != 0);
                (exponent.0 >= ONCE.0).then_some((product, rest))
            }),
            _ => pairs.get(&(factor, term)).map(|&product| (product, Vec::new())),
        };
        let (factors, graph) = (factors.clone(), graph);
        // A sum with other uses stays as it is, since multiplied out it would be formed twice.
        let (index, partner) = factors.iter().enumerate().find_map(|(index, &(sum, exponent))| {
            let Node::Sum { terms, .. } = graph.node(sum) else { return None };
            if exponent != ONCE || uses.get(&sum) != Some(&1) {
                return None;
            }
            let meets = |factor: NodeId| terms.iter().any(|&(term, _)| met(graph, factor, term).is_some());
            let partner = factors.iter().position(|&(factor, exponent)| exponent == ONCE && meets(factor))?;
            Some((index, partner))
        })?;
        let factor = factors[partner].0;
        let of = |factors: &[(NodeId, Exponent)], except: &[usize]| -> Vec<(NodeId, Exponent)> {
            let kept = factors.iter().enumerate().filter(|(index, _)| !except.contains(index));
            kept.map(|(_, &(factor, exponent))| (image(factor), exponent)).collect()
        };
        let (alone, others) = (of(&factors, &[index, partner]), of(&factors, &[index]));
        let Node::Sum { offset, terms } = graph.node(factors[index].0).clone() else { return None };
        let mut multiplied = Vec::with_capacity(terms.len() + 1);
        for (term, coefficient) in terms {
            let mut product = match met(graph, factor, term) {
                Some((product, rest)) => {
                    let mut factors = of(&rest, &[]);
                    factors.push((product, ONCE));
                    factors.extend(&alone);
                    factors
                }
                None => {
                    let mut factors = others.clone();
                    factors.push((image(term), ONCE));
                    factors
                }
            };
            product.sort_unstable();
            multiplied.push((graph.product(&product), coefficient));
        }
        if !offset.is_zero() {
            multiplied.push((graph.product(&others), offset));
        }
        Some(graph.sum(Number::ZERO, &multiplied))
    })
}

/// The roots with every node rewritten, operands first. The rule gets a node and the images of its operands;
/// where it returns `None`, the node is rebuilt from these.
fn rewrite(
    graph: &mut Graph,
    roots: &[NodeId],
    rule: impl Fn(&mut Graph, NodeId, &dyn Fn(NodeId) -> NodeId) -> Option<NodeId>,
) -> Vec<NodeId> {
    let mut images: Lookup<NodeId, NodeId> = Lookup::default();
    for id in graph.cone(roots.iter().copied()) {
        let of = |operand: NodeId| images.get(&operand).copied().unwrap_or(operand);
        let image = match rule(graph, id, &of) {
            Some(image) => image,
            None => rebuild(graph, id, of),
        };
        images.insert(id, image);
    }
    roots.iter().map(|root| images.get(root).copied().unwrap_or(*root)).collect()
}
