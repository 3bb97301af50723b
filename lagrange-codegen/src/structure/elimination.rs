//! LDLᵀ of a symmetric matrix on the graph, without operations on zeros, in an order chosen here.
//!
//! The operations are those of the numeric factorisation without pivoting, which is stable for positive
//! definite matrices in any order (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., chapter
//! 10). Constant pivots go first where that costs little fill: their quotients are computed once per run, and
//! the graph simplifies the remaining entries.

use crate::expr::{Graph, Node, NodeId};

/// A factorisation with its solution.
pub(super) struct Elimination {
    /// Coordinate, pivot, and the diagonal entry it started from, in order of elimination.
    pub pivots: Vec<(usize, NodeId, NodeId)>,
    /// Solution, in the order of the block.
    pub solution: Vec<NodeId>,
}

/// An order of elimination for the pattern, and the number of operations. The pivot with the fewest
/// neighbours is next, or a fixed one with at most one neighbour more.
pub(super) fn order(
    graph: &Graph,
    block: &[usize],
    entry: &dyn Fn(usize, usize) -> NodeId,
) -> (Vec<usize>, usize) {
    let count = block.len();
    let mut linked: Vec<Vec<bool>> = block
        .iter()
        .map(|&i| block.iter().map(|&j| i != j && !graph.is_zero(entry(i, j))).collect())
        .collect();
    let mut remaining: Vec<usize> = (0..count).collect();
    let mut order = Vec::with_capacity(count);
    let mut operations = 0;
    while !remaining.is_empty() {
        let degree = |index: usize| remaining.iter().filter(|&&other| linked[index][other]).count();
        // A pivot is no longer fixed once an earlier elimination has changed it.
        let touched = |index: usize| order.iter().any(|&earlier: &usize| linked[earlier][index]);
        let fixed =
            |index: usize| !touched(index) && graph.dependence(entry(block[index], block[index])).is_fixed();
        // Whether a pivot has a numeric factor. Without one, quotients by it need no multiplication by the
        // factor's inverse.
        let scaled = |index: usize| {
            let pivot = entry(block[index], block[index]);
            !graph.as_constant(pivot).unwrap_or(graph.scaled(pivot).0).is_one()
        };
        let Some(&next) = remaining.iter().min_by_key(|&&index| (degree(index), !fixed(index), index)) else {
            break;
        };
        let next = *remaining
            .iter()
            .filter(|&&index| fixed(index) && degree(index) <= degree(next) + 1)
            .min_by_key(|&&index| (degree(index), scaled(index), index))
            .unwrap_or(&next);
        remaining.retain(|&index| index != next);
        let neighbours: Vec<usize> = remaining.iter().copied().filter(|&index| linked[next][index]).collect();
        operations += neighbours.len() * (neighbours.len() + 5) / 2 + 1;
        for &a in &neighbours {
            for &b in &neighbours {
                linked[a][b] |= a != b;
            }
        }
        order.push(next);
    }
    (order, operations)
}

/// Factors and solves `A x = right` for the block, in the given order.
pub(super) fn eliminate(
    graph: &mut Graph,
    block: &[usize],
    order: &[usize],
    entry: &dyn Fn(usize, usize) -> NodeId,
    right: &[NodeId],
) -> Elimination {
    let count = block.len();
    let mut a: Vec<Vec<NodeId>> =
        order.iter().map(|&i| order.iter().map(|&j| entry(block[i], block[j])).collect()).collect();
    let mut x: Vec<NodeId> = order.iter().map(|&i| right[block[i]]).collect();
    let mut pivots = Vec::with_capacity(count);
    let mut divisors = Vec::with_capacity(count);
    let mut factors: Vec<Vec<(usize, NodeId)>> = vec![Vec::new(); count];
    for k in 0..count {
        let coordinate = block[order[k]];
        let (pivot, diagonal) = (a[k][k], entry(coordinate, coordinate));
        pivots.push((coordinate, pivot, diagonal));
        let pivot = guarded(graph, pivot, diagonal);
        divisors.push(pivot);
        for i in k + 1..count {
            if graph.is_zero(a[i][k]) {
                continue;
            }
            let factor = graph.div(a[i][k], pivot);
            factors[k].push((i, factor));
            let column: Vec<NodeId> = a.iter().map(|row| row[k]).collect();
            for (j, &entry) in column.iter().enumerate().take(i + 1).skip(k + 1) {
                if !graph.is_zero(entry) {
                    let correction = graph.mul(factor, entry);
                    a[i][j] = graph.sub(a[i][j], correction);
                    a[j][i] = a[i][j];
                }
            }
            let correction = graph.mul(factor, x[k]);
            x[i] = graph.sub(x[i], correction);
        }
    }
    for k in (0..count).rev() {
        let mut value = graph.div(x[k], divisors[k]);
        for &(i, factor) in &factors[k] {
            let correction = graph.mul(factor, x[i]);
            value = graph.sub(value, correction);
        }
        x[k] = value;
    }
    let mut solution = x.clone();
    for (index, &i) in order.iter().enumerate() {
        solution[i] = x[index];
    }
    Elimination { pivots, solution }
}

/// The pivot, or NaN if subtractions left nothing but rounding errors of the diagonal entry. The guard stands
/// around the sum in it alone, so that the factors beside the sum can still cancel.
pub(super) fn guarded(graph: &mut Graph, pivot: NodeId, diagonal: NodeId) -> NodeId {
    if pivot == diagonal || graph.is_zero(pivot) {
        return pivot;
    }
    let (coefficient, product) = graph.scaled(pivot);
    let moving_sum = graph.factors(product).into_iter().find(|&(factor, exponent)| {
        exponent.0 == 2
            && matches!(graph.node(factor), Node::Sum { .. })
            && !graph.dependence(factor).is_fixed()
    });
    let Some((sum, _)) = moving_sum else {
        // A product without such a sum has lost no digits. A fixed pivot is computed once and guarded as a
        // whole.
        return if graph.dependence(pivot).is_fixed() { graph.pivot(pivot, diagonal) } else { pivot };
    };
    let sum = if coefficient.is_negative() { graph.neg(sum) } else { sum };
    let beside = graph.div(pivot, sum);
    let scale = graph.div(diagonal, beside);
    let guard = graph.pivot(sum, scale);
    graph.mul(beside, guard)
}
