//! The entries that can differ from zero in the constraint matrix A, and in the factors of A M⁻¹ Aᵀ with a
//! diagonal M.

use std::collections::BTreeSet;

use crate::expr::{Graph, NodeId};

/// The most constraints for which the runtime forms the inverse of A M⁻¹ Aᵀ.
const SMALL: usize = 6;

/// The cost of an operation over a list of entries, in operations on rows of known length.
const LISTED: usize = 4;

/// The pattern of a sparse A, with its constraints in an order of elimination.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sparsity {
    /// The constraints in this order.
    pub order: Vec<usize>,
    /// For each constraint in this order, the coordinates that it depends on.
    pub coordinates: Vec<Vec<usize>>,
    /// For each, the earlier constraints that share a coordinate with it.
    pub coupled: Vec<Vec<usize>>,
    /// For each, the earlier columns in which its row of the factor may differ from zero.
    pub earlier: Vec<Vec<usize>>,
    /// For each, the later rows in which its column of the factor may differ from zero.
    pub later: Vec<Vec<usize>>,
}

impl Sparsity {
    /// The pattern of the gradients of constraints, if it saves operations.
    pub fn of(graph: &Graph, gradients: &[Vec<NodeId>]) -> Option<Sparsity> {
        let size = gradients.first().map_or(0, Vec::len);
        let rows: Vec<BTreeSet<usize>> = gradients
            .iter()
            .map(|row| (0..row.len()).filter(|&i| !graph.is_zero(row[i])).collect())
            .collect();
        if rows.len() <= SMALL {
            return None;
        }
        let found = Self::eliminated(&rows);
        (LISTED * found.operations() < dense(rows.len(), size)).then_some(found)
    }

    /// Orders constraints by the number of their neighbours, fewest first. Among equals come first those that
    /// reach fewer coordinates, since what holds a system to the ground stays far from depending on the rest,
    /// and then those next to the last one, so that a chain is eliminated from one end to the other.
    fn eliminated(rows: &[BTreeSet<usize>]) -> Sparsity {
        let count = rows.len();
        let mut reaching: Vec<Vec<usize>> =
            vec![Vec::new(); rows.iter().flatten().max().map_or(0, |i| i + 1)];
        for (c, row) in rows.iter().enumerate() {
            for &i in row {
                reaching[i].push(c);
            }
        }
        let mut linked: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); count];
        for constraints in &reaching {
            for &c in constraints {
                linked[c].extend(constraints.iter().filter(|&&other| other != c));
            }
        }
        let sharing = linked.clone();
        let mut remaining: BTreeSet<usize> = (0..count).collect();
        let mut touched = vec![0; count];
        let mut order = Vec::with_capacity(count);
        let mut columns = Vec::with_capacity(count);
        while let Some(&next) =
            remaining.iter().min_by_key(|&&c| (linked[c].len(), rows[c].len(), count - touched[c], c))
        {
            remaining.remove(&next);
            let neighbours = std::mem::take(&mut linked[next]);
            for &c in &neighbours {
                linked[c].extend(&neighbours);
                linked[c].remove(&next);
                linked[c].remove(&c);
                touched[c] = order.len() + 1;
            }
            order.push(next);
            columns.push(neighbours);
        }
        let mut indices = vec![0; count];
        for (index, &c) in order.iter().enumerate() {
            indices[c] = index;
        }
        let placed = |constraints: &BTreeSet<usize>| {
            let mut placed: Vec<usize> = constraints.iter().map(|&c| indices[c]).collect();
            placed.sort_unstable();
            placed
        };
        let later: Vec<Vec<usize>> = columns.iter().map(&placed).collect();
        let mut earlier = vec![Vec::new(); count];
        for (index, later) in later.iter().enumerate() {
            for &other in later {
                earlier[other].push(index);
            }
        }
        let coupled = order
            .iter()
            .enumerate()
            .map(|(index, &c)| placed(&sharing[c]).into_iter().take_while(|&other| other < index).collect());
        let coupled = coupled.collect();
        let coordinates = order.iter().map(|&c| rows[c].iter().copied().collect()).collect();
        Sparsity { order, coordinates, coupled, earlier, later }
    }

    /// The number of entries of A that can differ from zero.
    pub fn entries(&self) -> usize {
        self.coordinates.iter().map(Vec::len).sum()
    }

    /// The number of entries of the factor, beside its diagonal, that can differ from zero.
    pub fn factor(&self) -> usize {
        self.later.iter().map(Vec::len).sum()
    }

    /// Whether other gradients are zero wherever this pattern is.
    pub fn covers(&self, graph: &Graph, gradients: &[Vec<NodeId>]) -> bool {
        self.order.len() == gradients.len()
            && self.order.iter().zip(&self.coordinates).all(|(&c, coordinates)| {
                let mut row = gradients[c].iter().enumerate();
                row.all(|(i, &a)| graph.is_zero(a) || coordinates.binary_search(&i).is_ok())
            })
    }

    /// Multiplications of A M⁻¹ Aᵀ, its factorisation, and one solution with A.
    fn operations(&self) -> usize {
        let coupled = self.coupled.iter().flatten().map(|&index| self.coordinates[index].len());
        let factored = self.later.iter().map(|later| later.len() * (later.len() + 3) / 2);
        coupled.sum::<usize>() + factored.sum::<usize>() + 2 * (self.factor() + 2 * self.entries())
    }
}

/// The multiplications of [`Sparsity::operations`] with dense rows.
fn dense(constraints: usize, coordinates: usize) -> usize {
    let formed = constraints * (constraints + 1) / 2 * coordinates;
    formed + constraints.pow(3) / 6 + constraints * constraints + 2 * constraints * coordinates
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(links: usize, ring: bool) -> Vec<BTreeSet<usize>> {
        let ends = |i: usize| [i.checked_sub(1), (i < links - usize::from(ring)).then_some(i)];
        (0..links).map(|i| ends(i).into_iter().flatten().flat_map(|p| [2 * p, 2 * p + 1]).collect()).collect()
    }

    #[test]
    fn a_chain_has_no_fill_and_is_eliminated_from_what_is_held() {
        let rows = chain(12, false);
        assert_eq!(Sparsity::eliminated(&rows).order, (0..12).collect::<Vec<_>>());
        assert_eq!(Sparsity::eliminated(&rows).factor(), 11);
        let reversed: Vec<_> = rows.into_iter().rev().collect();
        let found = Sparsity::eliminated(&reversed);
        assert_eq!(found.order, (0..12).rev().collect::<Vec<_>>());
        assert_eq!(found.coupled, found.earlier);
    }

    #[test]
    fn a_ring_fills_a_row_at_most() {
        let found = Sparsity::eliminated(&chain(50, true));
        assert!(found.factor() < 2 * 50, "{}", found.factor());
    }

    #[test]
    fn the_factor_is_closed_under_elimination() {
        // Any two later places of a column are coupled in the column of the first of them.
        let rows: Vec<BTreeSet<usize>> =
            (0..40).map(|c| [c, (7 * c + 3) % 41, (11 * c * c + 5) % 41].into_iter().collect()).collect();
        let found = Sparsity::eliminated(&rows);
        for later in &found.later {
            for (k, &first) in later.iter().enumerate() {
                assert!(later[k + 1..].iter().all(|other| found.later[first].contains(other)));
            }
        }
        for (index, coupled) in found.coupled.iter().enumerate() {
            assert!(coupled.iter().all(|other| found.earlier[index].contains(other)));
        }
    }
}
