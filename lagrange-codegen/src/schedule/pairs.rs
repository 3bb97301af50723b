//! Common pairs of factors among many products.
//!
//! Products are flat sets of factors, so which multiplications they share is decided here:
//! the pair that most products contain becomes a factor of its own, again and again (Breuer,
//! "Generation of optimal code for expressions via factorization", CACM 12, 1969).

use std::collections::BTreeMap;

/// A factor: an index into the caller's table, or a pair found here.
pub(super) type Item = u32;

/// Rewrites the products so that pairs which at least two of them contain are single items.
/// New items are numbered from `first_new`; their two factors are returned in that order.
pub(super) fn share_pairs(products: &mut [Vec<Item>], first_new: Item) -> Vec<(Item, Item)> {
    let mut pairs: Vec<(Item, Item)> = Vec::new();
    loop {
        let mut occurrences: BTreeMap<(Item, Item), Vec<usize>> = BTreeMap::new();
        for (index, product) in products.iter().enumerate() {
            if product.len() < 2 {
                continue;
            }
            for (i, &a) in product.iter().enumerate() {
                for &b in &product[i + 1..] {
                    occurrences.entry((a.min(b), a.max(b))).or_default().push(index);
                }
            }
        }
        let mut frequent: Vec<_> =
            occurrences.into_iter().filter(|(_, indices)| indices.len() >= 2).collect();
        if frequent.is_empty() {
            return pairs;
        }
        frequent.sort_by_key(|(pair, indices)| (std::cmp::Reverse(indices.len()), *pair));
        for ((a, b), indices) in frequent {
            let contains = |product: &Vec<Item>| product.contains(&a) && product.contains(&b);
            let still: Vec<usize> = indices.into_iter().filter(|&index| contains(&products[index])).collect();
            if still.len() < 2 {
                continue;
            }
            let new = first_new + pairs.len() as Item;
            pairs.push((a, b));
            for index in still {
                products[index].retain(|&item| item != a && item != b);
                products[index].push(new);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_frequent_pair_goes_first() {
        let mut products = vec![vec![0, 1, 2], vec![0, 1, 3], vec![1, 2], vec![0, 1]];
        let pairs = share_pairs(&mut products, 10);
        assert_eq!(pairs, [(0, 1)]);
        assert_eq!(products, [vec![2, 10], vec![3, 10], vec![1, 2], vec![10]]);
    }
}
