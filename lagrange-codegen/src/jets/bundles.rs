//! Convolutions side by side, as instances of a pattern.
//!
//! Convolutions that share factors form a connected part. The parts of a system, such as the links of a chain
//! or the pairs of bodies, often have the same pattern, and are instances of it. A bundle is made of these:
//! its factors are columns with one entry for each instance, and a vector of a column is loaded once for all
//! convolutions of the pattern. Where this would take more loads, and in parts too large to compare,
//! convolutions are instances of the pattern a · b.

use super::recurrence::{Convolution, Operand};
use crate::collections::Lookup;

/// Parts with more factors are not compared.
const LARGEST: usize = 48;

/// Instances of one pattern.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bundle {
    /// The factors, by index in the pattern, then by instance.
    pub columns: Vec<Vec<Operand>>,
    /// The products of the pattern, by the indices of their factors.
    pub products: Vec<(usize, usize)>,
    /// Indices of the convolutions, by product of the pattern, then by instance.
    pub convolutions: Vec<Vec<usize>>,
}

impl Bundle {
    /// The number of instances.
    pub fn instances(&self) -> usize {
        self.convolutions.first().map_or(0, Vec::len)
    }
}

/// A connected part in its canonical form.
struct Part {
    pattern: Pattern,
    factors: Vec<Operand>,
    convolutions: Vec<usize>,
}

/// The common structure of isomorphic parts: the number of factors, and the indices of the factors of each
/// product.
#[derive(Clone, PartialEq, Eq)]
struct Pattern {
    factors: usize,
    products: Vec<(usize, usize)>,
}

/// Groups all convolutions.
pub fn bundles(convolutions: &[Convolution]) -> Vec<Bundle> {
    let mut groups: Vec<(Pattern, Vec<Part>)> = Vec::new();
    let mut loose = Vec::new();
    for part in connected(convolutions) {
        match canonical(convolutions, &part) {
            Some(part) => match groups.iter_mut().find(|(pattern, _)| *pattern == part.pattern) {
                Some((_, parts)) => parts.push(part),
                None => groups.push((part.pattern.clone(), vec![part])),
            },
            None => loose.extend(part),
        }
    }
    let mut bundles = Vec::new();
    for (pattern, parts) in groups {
        // The cost of a row is that of loading its columns, in vectors.
        let vectors = |length: usize| length.div_ceil(4);
        if pattern.factors * vectors(parts.len()) > 2 * vectors(parts.len() * pattern.products.len()) {
            loose.extend(parts.iter().flat_map(|part| part.convolutions.iter().copied()));
            continue;
        }
        bundles.push(Bundle {
            columns: (0..pattern.factors)
                .map(|i| parts.iter().map(|part| part.factors[i]).collect())
                .collect(),
            convolutions: (0..pattern.products.len())
                .map(|i| parts.iter().map(|part| part.convolutions[i]).collect())
                .collect(),
            products: pattern.products,
        });
    }
    loose.sort_unstable();
    if !loose.is_empty() {
        let factors = |pick: fn(&Convolution) -> Operand| {
            loose.iter().map(|&index| pick(&convolutions[index])).collect()
        };
        bundles.push(Bundle {
            columns: vec![factors(|product| product.left), factors(|product| product.right)],
            products: vec![(0, 1)],
            convolutions: vec![loose],
        });
    }
    bundles
}

/// The convolutions of each connected part, parts and convolutions in ascending order.
fn connected(convolutions: &[Convolution]) -> Vec<Vec<usize>> {
    let mut part_of: Lookup<Operand, usize> = Lookup::default();
    let mut parts: Vec<Vec<usize>> = Vec::new();
    let mut members: Vec<Vec<Operand>> = Vec::new();
    for (index, convolution) in convolutions.iter().enumerate() {
        let known = [convolution.left, convolution.right].map(|factor| part_of.get(&factor).copied());
        let home = match known {
            [Some(a), Some(b)] if a != b => {
                // The part that began first takes the other.
                let (home, other) = (a.min(b), a.max(b));
                let (moved, factors) =
                    (std::mem::take(&mut parts[other]), std::mem::take(&mut members[other]));
                parts[home].extend(moved);
                for factor in factors {
                    part_of.insert(factor, home);
                    members[home].push(factor);
                }
                home
            }
            [Some(home), _] | [_, Some(home)] => home,
            _ => {
                parts.push(Vec::new());
                members.push(Vec::new());
                parts.len() - 1
            }
        };
        parts[home].push(index);
        for factor in [convolution.left, convolution.right] {
            if part_of.insert(factor, home).is_none() {
                members[home].push(factor);
            }
        }
    }
    parts.retain(|part| !part.is_empty());
    parts.iter_mut().for_each(|part| part.sort_unstable());
    parts
}

/// The canonical form of a part: its factors in an order that isomorphic parts share. Factors are sorted by
/// what distinguishes them. Where nothing does, the first one in the order of the convolutions comes first.
/// `None` if there are more than [`LARGEST`] factors.
fn canonical(convolutions: &[Convolution], part: &[usize]) -> Option<Part> {
    let mut factors: Vec<Operand> = Vec::new();
    let mut ends: Vec<(usize, usize)> = Vec::with_capacity(part.len());
    for &index in part {
        let mut number = |factor: Operand| {
            factors.iter().position(|&known| known == factor).unwrap_or_else(|| {
                factors.push(factor);
                factors.len() - 1
            })
        };
        let Convolution { left, right } = convolutions[index];
        ends.push((number(left), number(right)));
        if factors.len() > LARGEST {
            return None;
        }
    }
    let mut colours: Vec<usize> = factors.iter().map(|factor| usize::from(factor.ramp)).collect();
    loop {
        refine(&mut colours, &ends);
        let shared = (0..factors.len()).find(|&i| colours[i + 1..].contains(&colours[i]));
        let Some(chosen) = shared else { break };
        // Doubling leaves a free colour below each.
        colours.iter_mut().for_each(|colour| *colour = 2 * *colour + 1);
        colours[chosen] -= 1;
    }
    let mut sorted: Vec<((usize, usize), usize)> = ends
        .iter()
        .zip(part)
        .map(|(&(a, b), &index)| ((colours[a].min(colours[b]), colours[a].max(colours[b])), index))
        .collect();
    sorted.sort_unstable();
    let mut order: Vec<usize> = (0..factors.len()).collect();
    order.sort_unstable_by_key(|&i| colours[i]);
    Some(Part {
        pattern: Pattern { factors: factors.len(), products: sorted.iter().map(|&(ends, _)| ends).collect() },
        factors: order.into_iter().map(|i| factors[i]).collect(),
        convolutions: sorted.into_iter().map(|(_, index)| index).collect(),
    })
}

/// Colour refinement. Afterwards colours are ranks without gaps.
fn refine(colours: &mut [usize], ends: &[(usize, usize)]) {
    let mut count = 0;
    loop {
        let mut signatures: Vec<(usize, Vec<(usize, bool)>)> =
            colours.iter().map(|&colour| (colour, Vec::new())).collect();
        for &(a, b) in ends {
            signatures[a].1.push((colours[b], a == b));
            if a != b {
                signatures[b].1.push((colours[a], false));
            }
        }
        signatures.iter_mut().for_each(|(_, neighbours)| neighbours.sort_unstable());
        let mut ranks: Vec<&(usize, Vec<(usize, bool)>)> = signatures.iter().collect();
        ranks.sort_unstable();
        ranks.dedup();
        for (colour, signature) in colours.iter_mut().zip(&signatures) {
            *colour = ranks.binary_search(&signature).unwrap_or_default();
        }
        if ranks.len() == count {
            return;
        }
        count = ranks.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schedule::Slot;

    fn convolution(a: usize, b: usize) -> Convolution {
        let operand = |index| Operand { slot: Slot::of(index), ramp: false };
        Convolution { left: operand(a), right: operand(b) }
    }

    #[test]
    fn isomorphic_parts_are_instances_of_one_pattern() {
        // A triangle with a tail, its factors named in another order each time: 0, 1, 2 and the tail 3.
        let convolutions: Vec<Convolution> = (0..5_usize)
            .flat_map(|part| {
                let at = |i: usize| 10 * part + (i + part) % 4;
                let mut convolutions = vec![
                    convolution(at(0), at(1)),
                    convolution(at(1), at(2)),
                    convolution(at(2), at(0)),
                    convolution(at(0), at(3)),
                ];
                convolutions.rotate_left(part % 4);
                convolutions
            })
            .collect();
        let bundles = bundles(&convolutions);
        assert_eq!(bundles.len(), 1);
        let bundle = &bundles[0];
        assert_eq!((bundle.instances(), bundle.columns.len(), bundle.products.len()), (5, 4, 4));
        for (&(a, b), of_product) in bundle.products.iter().zip(&bundle.convolutions) {
            for (instance, &index) in of_product.iter().enumerate() {
                let (a, b) = (bundle.columns[a][instance], bundle.columns[b][instance]);
                let Convolution { left, right } = convolutions[index];
                assert!((left, right) == (a, b) || (left, right) == (b, a));
            }
        }
    }

    #[test]
    fn every_lane_is_in_one_bundle() {
        let mut convolutions: Vec<Convolution> = (0..30).map(|i| convolution(i, (i * i + 3) % 40)).collect();
        convolutions.extend((50..60).map(|i| convolution(i, i)));
        let bundles = bundles(&convolutions);
        let mut all: Vec<usize> = bundles.iter().flat_map(|bundle| bundle.convolutions.concat()).collect();
        all.sort_unstable();
        assert_eq!(all, (0..40).collect::<Vec<_>>());
        assert!(bundles.iter().any(|bundle| bundle.products == [(0, 0)] && bundle.instances() == 10));
    }

    #[test]
    fn lanes_without_a_likeness_stand_side_by_side() {
        let convolutions: Vec<Convolution> =
            (1..20).flat_map(|i| (1..20).map(move |j| convolution(i, 100 + i * j % 30))).collect();
        let bundles = bundles(&convolutions);
        assert_eq!(bundles.len(), 1);
        assert_eq!(bundles[0].products, [(0, 1)]);
    }
}
