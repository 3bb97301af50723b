//! M a = f solved on the extended system of the kinetic energy: recursion as a matter of order.
//!
//! The definitions of [`Quadratic`] are taken from the last to the first and substituted, and each velocity
//! is eliminated as soon as no definition that is left names it: its pivot is then positive, an articulated
//! inertia. For a chain or a tree of bodies that is the articulated-body recursion (Featherstone, *Rigid Body
//! Dynamics Algorithms*, chapter 7), and nothing here knows of joints. M is never formed.

use super::elimination::guarded;
use crate::expr::{Graph, NodeId};
use crate::mechanics::quadratic::{Linear, Quadratic, Symmetric, Unknown};
use crate::number::Number;

/// The factors of a mass matrix that is not formed.
#[derive(Clone, Debug)]
pub struct Recursion {
    /// The steps, in the order in which a load is taken through them.
    pub steps: Vec<Step>,
    /// The number of velocities, which are the first unknowns.
    pub velocities: usize,
    /// The number of velocities and definitions.
    pub unknowns: usize,
}

/// One step of the factorisation.
#[derive(Clone, Debug)]
pub enum Step {
    /// An unknown is Σ c x. Its load is added to those of x, and its value follows from theirs.
    Substitute {
        /// The unknown.
        unknown: usize,
        /// x and c.
        terms: Vec<(usize, NodeId)>,
    },
    /// An unknown is its load / pivot − Σ l x.
    Eliminate {
        /// The unknown, a velocity, by its index in the block.
        unknown: usize,
        /// 1 / pivot.
        inverse: NodeId,
        /// x and l.
        terms: Vec<(usize, NodeId)>,
    },
}

/// A pivot, and the size of the number that subtractions have reduced to it: the same node if nothing was
/// subtracted.
#[derive(Clone, Copy, Debug)]
pub struct Articulated {
    /// The place in the block.
    pub index: usize,
    /// Its value.
    pub pivot: NodeId,
    /// Its scale.
    pub scale: NodeId,
}

/// The state of the elimination.
struct Elimination {
    matrix: Symmetric,
    /// The number of remaining definitions that contain each unknown.
    users: Vec<usize>,
    /// The diagonal with nothing subtracted, up to a factor that counts terms. Rounding errors are measured
    /// by it.
    sizes: Vec<Option<NodeId>>,
    /// The length of the longest chain of eliminations that has changed each unknown.
    depths: Vec<u32>,
    steps: Vec<Step>,
    pivots: Vec<Articulated>,
    /// The number of products that may still be made.
    budget: usize,
}

impl Recursion {
    /// Eliminates all unknowns; `None` if a velocity has no inertia or if that takes more products than the
    /// budget, so that the graph does not grow in vain.
    pub(super) fn of(
        graph: &mut Graph,
        form: Quadratic,
        budget: usize,
    ) -> Option<(Recursion, Vec<Articulated>)> {
        let matrix = Symmetric::of(&form);
        let Quadratic { velocities, definitions, .. } = form;
        let unknowns = velocities + definitions.len();
        let sizes = matrix.rows.iter().enumerate().map(|(x, row)| row.get(&x).copied()).collect();
        let mut system = Elimination {
            matrix,
            users: vec![0; unknowns],
            sizes,
            depths: vec![0; unknowns],
            steps: Vec::with_capacity(unknowns),
            pivots: Vec::with_capacity(velocities),
            budget,
        };
        for definition in &definitions {
            definition.iter().for_each(|&(x, _)| system.users[x] += 1);
        }
        let mut left: Vec<Unknown> = (0..velocities).collect();
        system.eliminate_free(graph, &mut left)?;
        for (index, definition) in definitions.into_iter().enumerate().rev() {
            system.substitute(graph, velocities + index, definition)?;
            system.eliminate_free(graph, &mut left)?;
        }
        Some((Recursion { steps: asked_for(system.steps, unknowns), velocities, unknowns }, system.pivots))
    }

    /// The solution for one right-hand side, on the graph.
    pub fn solve(&self, graph: &mut Graph, right: &[NodeId]) -> Vec<NodeId> {
        let zero = graph.zero();
        let mut loads = right.to_vec();
        loads.resize(self.unknowns, zero);
        for step in &self.steps {
            let (unknown, sign, terms) = match step {
                Step::Substitute { unknown, terms } => (unknown, Number::ONE, terms),
                Step::Eliminate { unknown, terms, .. } => (unknown, Number::MINUS_ONE, terms),
            };
            let load = loads[*unknown];
            for &(x, factor) in terms {
                let share = graph.mul(factor, load);
                loads[x] = graph.sum(Number::ZERO, &[(loads[x], Number::ONE), (share, sign)]);
            }
        }
        let mut values = vec![zero; self.unknowns];
        for step in self.steps.iter().rev() {
            let (unknown, start, sign, terms) = match step {
                Step::Substitute { unknown, terms } => (*unknown, None, Number::ONE, terms),
                Step::Eliminate { unknown, inverse, terms } => {
                    (*unknown, Some(graph.mul(loads[*unknown], *inverse)), Number::MINUS_ONE, terms)
                }
            };
            let mut summands: Vec<(NodeId, Number)> =
                start.map(|own| (own, Number::ONE)).into_iter().collect();
            summands.extend(terms.iter().map(|&(x, factor)| (graph.mul(factor, values[x]), sign)));
            values[unknown] = graph.sum(Number::ZERO, &summands);
        }
        values.truncate(right.len());
        values
    }

    /// An index for each unknown, and the number of indices. Velocities have their own. The others, of which
    /// few are in use at a time, share those behind.
    pub fn indices(&self) -> (Vec<usize>, usize) {
        let mut indices: Vec<usize> = (0..self.unknowns).collect();
        let (mut free, mut count) = (Vec::new(), self.velocities);
        let mut placed = vec![false; self.unknowns];
        placed[..self.velocities].fill(true);
        for step in &self.steps {
            for &(x, _) in step.terms() {
                if !std::mem::replace(&mut placed[x], true) {
                    indices[x] = free.pop().unwrap_or_else(|| {
                        count += 1;
                        count - 1
                    });
                }
            }
            if step.unknown() >= self.velocities {
                free.push(indices[step.unknown()]);
            }
        }
        (indices, count)
    }

    /// Whether a product with the inverse takes less time an order than the recursion, in which each
    /// operation waits for another. The recursion makes the inverse once a step.
    pub fn waits(&self) -> bool {
        /// Cycles before an operation can use the result of another.
        const LATENCY: usize = 4;
        /// Multiply–adds of rows per cycle, loads and stores included, on vectors of two.
        const WIDTH: usize = 1;
        /// Orders of a step. They share the cost of the inverse.
        const ORDERS: usize = 12;
        let depth_of = |depths: &[usize], start: usize, terms: &[(usize, NodeId)]| {
            terms.iter().fold(start, |depth, &(x, _)| depth.max(depths[x]) + 1)
        };
        let mut depths = vec![0; self.unknowns];
        let mut values = vec![0; self.unknowns];
        let mut terms = 0;
        for step in &self.steps {
            let load = depths[step.unknown()];
            step.terms().iter().for_each(|&(x, _)| depths[x] = depths[x].max(load) + 1);
            terms += step.terms().len();
        }
        for step in self.steps.iter().rev() {
            let start = if step.unknown() < self.velocities { depths[step.unknown()] + 1 } else { 0 };
            values[step.unknown()] = depth_of(&values, start, step.terms());
        }
        let depth = values.iter().max().copied().unwrap_or(0);
        let product = self.velocities * (self.velocities + 2 * terms / ORDERS) / WIDTH;
        product < LATENCY * depth
    }
}

impl Step {
    /// The unknown of the step.
    pub fn unknown(&self) -> usize {
        match self {
            Step::Substitute { unknown, .. } | Step::Eliminate { unknown, .. } => *unknown,
        }
    }

    /// Other unknowns with their factors.
    pub fn terms(&self) -> &[(usize, NodeId)] {
        match self {
            Step::Substitute { terms, .. } | Step::Eliminate { terms, .. } => terms,
        }
    }
}

/// The steps without definitions that no load reaches. Those serve for the inertia alone.
fn asked_for(mut steps: Vec<Step>, unknowns: usize) -> Vec<Step> {
    let mut reached = vec![false; unknowns];
    steps.retain(|step| {
        let is_kept = matches!(step, Step::Eliminate { .. }) || reached[step.unknown()];
        if is_kept {
            step.terms().iter().for_each(|&(x, _)| reached[x] = true);
        }
        is_kept
    });
    steps
}

impl Elimination {
    /// Eliminates every velocity that is in no definition, those with the fewest neighbours first.
    fn eliminate_free(&mut self, graph: &mut Graph, left: &mut Vec<Unknown>) -> Option<()> {
        loop {
            let free = left.iter().enumerate().filter(|&(_, &v)| self.users[v] == 0);
            let Some((index, _)) =
                free.min_by_key(|&(_, &v)| (self.matrix.rows[v].len(), std::cmp::Reverse(v)))
            else {
                return Some(());
            };
            let velocity = left.remove(index);
            self.eliminate(graph, velocity)?;
        }
    }

    /// Substitutes w = Σ c x into the form.
    fn substitute(&mut self, graph: &mut Graph, unknown: Unknown, terms: Linear) -> Option<()> {
        let row = self.matrix.rows[unknown].len();
        let factors = terms.iter().filter(|&&(_, c)| graph.as_constant(c).is_none_or(|c| !c.abs().is_one()));
        self.budget = self.budget.checked_sub(row * factors.count())?;
        self.matrix.substitute(graph, unknown, &terms);
        for &(x, c) in &terms {
            self.users[x] -= 1;
            self.depths[x] = self.depths[x].max(self.depths[unknown]);
            if let Some(size) = self.sizes[unknown] {
                let square = graph.powi(c, 2);
                let share = graph.mul(square, size);
                let zero = graph.zero();
                self.sizes[x] = Some(graph.add(self.sizes[x].unwrap_or(zero), share));
            }
        }
        self.steps.push(Step::Substitute { unknown, terms });
        Some(())
    }

    fn eliminate(&mut self, graph: &mut Graph, unknown: Unknown) -> Option<()> {
        let row = std::mem::take(&mut self.matrix.rows[unknown]);
        let pivot = *row.get(&unknown)?;
        self.budget = self.budget.checked_sub(row.len() * (row.len() + 1) / 2)?;
        if graph.is_zero(pivot) {
            return None;
        }
        let depth = self.depths[unknown];
        let scale = if depth == 0 { pivot } else { self.scale(graph, unknown, depth)? };
        self.pivots.push(Articulated { index: unknown, pivot, scale });
        let divisor = guarded(graph, pivot, scale);
        let one = graph.one();
        let inverse = graph.div(one, divisor);
        let others: Linear = row.into_iter().filter(|&(other, _)| other != unknown).collect();
        let mut terms = Vec::with_capacity(others.len());
        for (index, &(x, entry)) in others.iter().enumerate() {
            self.matrix.rows[x].remove(&unknown);
            let factor = graph.div(entry, divisor);
            for &(y, other) in &others[..=index] {
                let share = graph.mul(factor, other);
                let share = graph.neg(share);
                self.matrix.add(graph, x, y, share);
            }
            self.depths[x] = self.depths[x].max(depth + 1);
            terms.push((x, factor));
        }
        self.steps.push(Step::Eliminate { unknown, inverse, terms });
        Some(())
    }

    /// The scale that a pivot is compared with. `solve::carries` of the runtime asks for eight ulps, and the
    /// subtractions of k eliminations leave 2 (k + 1) of them, as in the runtime's LDLᵀ.
    fn scale(&self, graph: &mut Graph, unknown: Unknown, depth: u32) -> Option<NodeId> {
        let size = self.sizes[unknown]?;
        Some(graph.scale(size, Number::integer(i128::from(depth.max(3)) + 1) * Number::Ratio(1, 4)))
    }
}

#[cfg(test)]
mod tests;
