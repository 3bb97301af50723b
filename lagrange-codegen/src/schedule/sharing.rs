//! Parts that the products of a program share: pairs of factors, and reciprocals.

use super::divisors::{Division, Divisor, Divisors};
use super::pairs::{Item, share_pairs};
use crate::collections::Lookup;
use crate::expr::{Exponent, Graph, Node, NodeId};

/// All moving products of a cone, with their shared parts.
pub(super) struct Sharing {
    /// The moving part of each product, by node.
    pub moving: Vec<Option<Moving>>,
    /// Factors by item.
    pub factors: Vec<Factor>,
    /// Items beyond the factors: products of two items.
    pub pairs: Vec<(Item, Item)>,
    /// How many products and pairs contain an item.
    pub item_uses: Vec<u32>,
}

/// A moving product: numerator and divisor without the fixed factors.
#[derive(Clone, Debug, Default)]
pub(super) struct Moving {
    /// Factors of the numerator.
    pub items: Vec<Item>,
    /// The divisor.
    pub divisor: Divisor,
}

/// A product as it stands in the graph, without its fixed factors.
struct Fraction {
    id: NodeId,
    above: Vec<(NodeId, Exponent)>,
    below: Divisor,
}

/// A factor of a numerator.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Factor {
    /// A positive power of a node.
    Power(NodeId, Exponent),
    /// The reciprocal of a divisor.
    Reciprocal(Divisor),
    /// The reciprocal of a power (in halves) of a node, raised to a second power.
    BaseReciprocal(NodeId, u32, u32),
}

impl Sharing {
    /// Decides which parts the products of an ascending cone share.
    pub fn of(graph: &Graph, cone: &[NodeId]) -> Sharing {
        let mut divisors = Divisors::default();
        let mut products: Vec<Fraction> = Vec::new();
        for &id in cone {
            if graph.dependence(id).is_fixed() {
                continue;
            }
            if let Node::Product(factors) = graph.node(id) {
                let moving = || factors.iter().copied().filter(|&(f, _)| !graph.dependence(f).is_fixed());
                let above: Vec<_> = moving().filter(|(_, e)| e.0 > 0).collect();
                let below: Divisor = moving().filter(|(_, e)| e.0 < 0).collect();
                divisors.count(&below);
                products.push(Fraction { id, above, below });
            }
        }
        let mut table: Lookup<Factor, Item> = Lookup::default();
        let mut factors: Vec<Factor> = Vec::new();
        let mut lists: Vec<Vec<Item>> = Vec::with_capacity(products.len());
        let mut rests: Vec<Divisor> = Vec::with_capacity(products.len());
        for Fraction { above, below, .. } in &products {
            let mut items = Vec::with_capacity(above.len() + 1);
            let mut add = |factor: Factor| {
                let item = *table.get(&factor).unwrap_or(&(factors.len() as Item));
                if item as usize == factors.len() {
                    table.insert(factor.clone(), item);
                    factors.push(factor);
                }
                items.push(item);
            };
            above.iter().for_each(|&(node, exponent)| add(Factor::Power(node, exponent)));
            let rest = match (below.is_empty(), divisors.division(below)) {
                (true, _) => Vec::new(),
                (false, Division::Reciprocal) => {
                    add(Factor::Reciprocal(below.clone()));
                    Vec::new()
                }
                (false, Division::Split { reciprocals, rest }) => {
                    reciprocals
                        .into_iter()
                        .for_each(|(base, unit, count)| add(Factor::BaseReciprocal(base, unit, count)));
                    rest
                }
            };
            lists.push(items);
            rests.push(rest);
        }
        let pairs = share_pairs(&mut lists, factors.len() as Item);
        let mut item_uses = vec![0; factors.len() + pairs.len()];
        lists.iter().flatten().for_each(|&item| item_uses[item as usize] += 1);
        for &(a, b) in &pairs {
            item_uses[a as usize] += 1;
            item_uses[b as usize] += 1;
        }
        let mut moving = vec![None; graph.len()];
        for ((product, items), divisor) in products.iter().zip(lists).zip(rests) {
            moving[product.id.index()] = Some(Moving { items, divisor });
        }
        Sharing { moving, factors, pairs, item_uses }
    }
}
