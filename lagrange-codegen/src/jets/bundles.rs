//! Convolutions side by side: lanes grouped into instances of one pattern.
//!
//! Lanes that share factors are connected; the links of a chain or the pairs of bodies are connected parts of
//! the same shape. Such parts form a bundle: its factors are columns, one entry an instance, and each vector
//! of a column is loaded once for all lanes of the pattern. Lanes in parts of a shape of their own are
//! instances of the pattern a · b.

use super::recurrence::{Lane, Operand};
use crate::collections::Lookup;

/// Parts with more factors are not compared.
const LARGEST: usize = 48;

/// Instances of one pattern.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bundle {
    /// The factors, by place in the pattern, then by instance.
    pub columns: Vec<Vec<Operand>>,
    /// The lanes of the pattern, by the places of their factors.
    pub products: Vec<(usize, usize)>,
    /// Indices of the lanes, by product of the pattern, then by instance.
    pub lanes: Vec<Vec<usize>>,
}

impl Bundle {
    /// The number of instances.
    pub fn instances(&self) -> usize {
        self.lanes.first().map_or(0, Vec::len)
    }
}

/// A connected part in its canonical form.
struct Part {
    shape: Shape,
    factors: Vec<Operand>,
    lanes: Vec<usize>,
}

/// What isomorphic parts have in common: the number of factors and the places of the factors of each lane.
#[derive(Clone, PartialEq, Eq)]
struct Shape {
    factors: usize,
    products: Vec<(usize, usize)>,
}

/// Groups all lanes.
pub fn bundles(lanes: &[Lane]) -> Vec<Bundle> {
    let mut groups: Vec<(Shape, Vec<Part>)> = Vec::new();
    let mut loose = Vec::new();
    for part in connected(lanes) {
        match canonical(lanes, &part) {
            Some(part) => match groups.iter_mut().find(|(shape, _)| *shape == part.shape) {
                Some((_, parts)) => parts.push(part),
                None => groups.push((part.shape.clone(), vec![part])),
            },
            None => loose.extend(part),
        }
    }
    let mut bundles = Vec::new();
    for (shape, parts) in groups {
        // What a row costs: loads of columns, in vectors.
        let vectors = |length: usize| length.div_ceil(4);
        if shape.factors * vectors(parts.len()) > 2 * vectors(parts.len() * shape.products.len()) {
            loose.extend(parts.iter().flat_map(|part| part.lanes.iter().copied()));
            continue;
        }
        bundles.push(Bundle {
            columns: (0..shape.factors).map(|i| parts.iter().map(|part| part.factors[i]).collect()).collect(),
            lanes: (0..shape.products.len())
                .map(|i| parts.iter().map(|part| part.lanes[i]).collect())
                .collect(),
            products: shape.products,
        });
    }
    loose.sort_unstable();
    if !loose.is_empty() {
        let factors = |pick: fn(&Lane) -> Operand| loose.iter().map(|&lane| pick(&lanes[lane])).collect();
        bundles.push(Bundle {
            columns: vec![factors(|lane| lane.left), factors(|lane| lane.right)],
            products: vec![(0, 1)],
            lanes: vec![loose],
        });
    }
    bundles
}

/// The lanes of each connected part, parts and lanes in ascending order.
fn connected(lanes: &[Lane]) -> Vec<Vec<usize>> {
    let mut part_of: Lookup<Operand, usize> = Lookup::default();
    let mut parts: Vec<Vec<usize>> = Vec::new();
    let mut members: Vec<Vec<Operand>> = Vec::new();
    for (index, lane) in lanes.iter().enumerate() {
        let known = [lane.left, lane.right].map(|factor| part_of.get(&factor).copied());
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
        for factor in [lane.left, lane.right] {
            if part_of.insert(factor, home).is_none() {
                members[home].push(factor);
            }
        }
    }
    parts.retain(|part| !part.is_empty());
    parts.iter_mut().for_each(|part| part.sort_unstable());
    parts
}

/// The canonical form of a part: factors sorted by what distinguishes them, refined until nothing does; among
/// those that nothing distinguishes, the first one in the order of the lanes comes first.
fn canonical(lanes: &[Lane], part: &[usize]) -> Option<Part> {
    let mut factors: Vec<Operand> = Vec::new();
    let mut ends: Vec<(usize, usize)> = Vec::with_capacity(part.len());
    for &lane in part {
        let mut place = |factor: Operand| {
            factors.iter().position(|&known| known == factor).unwrap_or_else(|| {
                factors.push(factor);
                factors.len() - 1
            })
        };
        let ends_of_lane = (place(lanes[lane].left), place(lanes[lane].right));
        ends.push(ends_of_lane);
        if factors.len() > LARGEST {
            return None;
        }
    }
    let mut colours: Vec<usize> = factors.iter().map(|factor| usize::from(factor.ramp)).collect();
    loop {
        refine(&mut colours, &ends);
        let shared = (0..factors.len()).find(|&i| colours[i + 1..].contains(&colours[i]));
        let Some(chosen) = shared else { break };
        // Twice as many colours leave room below each.
        colours.iter_mut().for_each(|colour| *colour = 2 * *colour + 1);
        colours[chosen] -= 1;
    }
    let mut sorted: Vec<((usize, usize), usize)> = ends
        .iter()
        .zip(part)
        .map(|(&(a, b), &lane)| ((colours[a].min(colours[b]), colours[a].max(colours[b])), lane))
        .collect();
    sorted.sort_unstable();
    let mut places: Vec<usize> = (0..factors.len()).collect();
    places.sort_unstable_by_key(|&i| colours[i]);
    Some(Part {
        shape: Shape { factors: factors.len(), products: sorted.iter().map(|&(ends, _)| ends).collect() },
        factors: places.into_iter().map(|i| factors[i]).collect(),
        lanes: sorted.into_iter().map(|(_, lane)| lane).collect(),
    })
}

/// Colour refinement; colours are ranks afterwards, without gaps.
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

    fn lane(a: usize, b: usize) -> Lane {
        let operand = |index| Operand { slot: Slot::of(index), ramp: false };
        Lane { left: operand(a), right: operand(b) }
    }

    #[test]
    fn isomorphic_parts_are_instances_of_one_pattern() {
        // A triangle with a tail, its factors named in another order each time: 0, 1, 2 and the tail 3.
        let lanes: Vec<Lane> = (0..5_usize)
            .flat_map(|part| {
                let at = |i: usize| 10 * part + (i + part) % 4;
                let mut lanes =
                    vec![lane(at(0), at(1)), lane(at(1), at(2)), lane(at(2), at(0)), lane(at(0), at(3))];
                lanes.rotate_left(part % 4);
                lanes
            })
            .collect();
        let bundles = bundles(&lanes);
        assert_eq!(bundles.len(), 1);
        let bundle = &bundles[0];
        assert_eq!((bundle.instances(), bundle.columns.len(), bundle.products.len()), (5, 4, 4));
        for (&(a, b), of_product) in bundle.products.iter().zip(&bundle.lanes) {
            for (instance, &index) in of_product.iter().enumerate() {
                let (a, b) = (bundle.columns[a][instance], bundle.columns[b][instance]);
                let Lane { left, right } = lanes[index];
                assert!((left, right) == (a, b) || (left, right) == (b, a));
            }
        }
    }

    #[test]
    fn every_lane_is_in_one_bundle() {
        let mut lanes: Vec<Lane> = (0..30).map(|i| lane(i, (i * i + 3) % 40)).collect();
        lanes.extend((50..60).map(|i| lane(i, i)));
        let bundles = bundles(&lanes);
        let mut all: Vec<usize> = bundles.iter().flat_map(|bundle| bundle.lanes.concat()).collect();
        all.sort_unstable();
        assert_eq!(all, (0..40).collect::<Vec<_>>());
        assert!(bundles.iter().any(|bundle| bundle.products == [(0, 0)] && bundle.instances() == 10));
    }

    #[test]
    fn lanes_without_a_likeness_stand_side_by_side() {
        let lanes: Vec<Lane> =
            (1..20).flat_map(|i| (1..20).map(move |j| lane(i, 100 + i * j % 30))).collect();
        let bundles = bundles(&lanes);
        assert_eq!(bundles.len(), 1);
        assert_eq!(bundles[0].products, [(0, 1)]);
    }
}
