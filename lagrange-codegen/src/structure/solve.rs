//! How the accelerations are solved for, block by block.

use super::elimination::{self, eliminate};
use super::facts::Facts;
use super::recursion::{Articulated, Recursion};
use super::sparsity::Sparsity;
use crate::diagnostics::{Diagnostics, physics};
use crate::expr::{Graph, NodeId, Unary};
use crate::mechanics::quadratic::Quadratic;
use crate::mechanics::{Equations, MassMatrix};
use crate::model::Model;
use crate::number::Number;
use crate::simplify::cost::cost;

/// The most operations, about, of a factorisation that is written out. A larger one is a loop of the runtime,
/// which compiles faster and runs on vectors, unless a recursion takes fewer operations.
const WRITTEN_OUT: usize = 30;

/// How one block is solved.
#[derive(Clone, Debug)]
pub enum Method {
    /// Written out: pivots, to find the singular one, and the accelerations.
    WrittenOut {
        /// Pivots that may not be positive.
        pivots: Vec<Pivot>,
        /// Accelerations, in the order of the block.
        solution: Vec<NodeId>,
    },
    /// Written out without the matrix, on the velocities that the kinetic energy is made of.
    Recursive {
        /// The factors.
        recursion: Recursion,
        /// Pivots that may not be positive.
        pivots: Vec<Pivot>,
        /// Accelerations, in the order of the block.
        solution: Vec<NodeId>,
    },
    /// LDLᵀ in the runtime.
    Ldlt,
    /// LU with partial pivoting in the runtime, for matrices of any signature.
    Lu,
}

/// A pivot of a factorisation that is written out.
#[derive(Clone, Copy, Debug)]
pub struct Pivot {
    /// The coordinate it belongs to.
    pub coordinate: usize,
    /// Its value.
    pub value: NodeId,
    /// The size beside which it must not vanish: the diagonal entry, in a recursion times a factor for the
    /// subtractions, or of a determinant the sum of the magnitudes of its products. The same node as `value`
    /// if nothing is subtracted.
    pub scale: NodeId,
}

/// A decoupled block of the mass matrix.
#[derive(Clone, Debug)]
pub struct Block {
    /// Its coordinates.
    pub coordinates: Vec<usize>,
    /// Its method.
    pub method: Method,
    /// Whether its entries are constant all through a run.
    pub constant: bool,
}

/// How the accelerations and multipliers of a constrained system are solved for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Saddle {
    /// M is diagonal: accelerations are eliminated, and A M⁻¹ Aᵀ is factored.
    Diagonal,
    /// The same, over lists of the entries of A and of the factors that can differ from zero.
    Sparse,
    /// The whole of M and A, in the null space of A.
    Whole {
        /// Whether the mass matrix has no negative direction.
        definite: bool,
    },
    /// The same with rows that hold at times.
    Switched {
        /// Whether the mass matrix has no negative direction.
        definite: bool,
    },
}

/// The solution of M a = f, or with constraints of M a − Aᵀλ = f and A a = γ.
#[derive(Clone, Debug)]
pub struct Solution {
    /// All blocks. Without constraints each coordinate is in exactly one. With constraints there are none.
    pub blocks: Vec<Block>,
    /// The method for the accelerations of a system with constraints.
    pub saddle: Option<Saddle>,
    /// The method for its series.
    pub saddle_of_series: Option<Saddle>,
    /// The entries of the gradients and factors that can differ from zero, for the method that uses them.
    pub sparsity: Option<Sparsity>,
    /// The kind of the mass matrix in words.
    kind: &'static str,
}

impl Solution {
    /// Chooses a method for every block, or for all coordinates with constraints. The equations come in the
    /// user's form and in the form that a motion solves. `None` if a block needs a mass matrix that is not
    /// formed.
    pub fn plan(
        model: &mut Model,
        told: (&Equations, &Facts),
        solved: (&Equations, &Facts),
        diagnostics: &mut Diagnostics,
    ) -> Option<Solution> {
        let [saddle, saddle_of_series] = [told, solved].map(|(equations, facts)| {
            (equations.conditions.count() > 0).then(|| saddle(&model.graph, equations, facts))
        });
        if saddle.is_some() {
            let sparsity = Sparsity::of(&model.graph, &told.0.conditions.jacobian);
            let by_places = |method: Option<Saddle>, equations: &Equations| match (method, &sparsity) {
                (Some(Saddle::Diagonal), Some(sparsity))
                    if sparsity.covers(&model.graph, &equations.conditions.jacobian) =>
                {
                    Some(Saddle::Sparse)
                }
                (method, _) => method,
            };
            let saddle_of_series = by_places(saddle_of_series, solved.0);
            let saddle = by_places(saddle, told.0);
            let kind = kind(told.1);
            return Some(Solution { blocks: Vec::new(), saddle, saddle_of_series, sparsity, kind });
        }
        let (equations, facts) = solved;
        let blocks = facts.blocks.iter().map(|block| of_block(model, equations, block, diagnostics));
        let blocks = blocks.collect::<Option<Vec<Block>>>()?;
        Some(Solution { blocks, saddle, saddle_of_series, sparsity: None, kind: kind(facts) })
    }

    /// The nodes that a step computes: accelerations if they are written out, else entries of the mass matrix
    /// and right-hand sides.
    pub fn roots(&self, equations: &Equations) -> Vec<NodeId> {
        if self.saddle.is_some() {
            return equations.roots();
        }
        let mut roots = Vec::new();
        for block in &self.blocks {
            match &block.method {
                Method::WrittenOut { solution, .. } | Method::Recursive { solution, .. } => {
                    roots.extend(solution);
                }
                Method::Ldlt | Method::Lu => {
                    for (index, &i) in block.coordinates.iter().enumerate() {
                        roots
                            .extend(block.coordinates[..=index].iter().map(|&j| equations.mass.rows()[i][j]));
                        roots.push(equations.force[i]);
                    }
                }
            }
        }
        roots
    }

    /// The method in words, for `STRUCTURE`.
    pub fn describe(&self) -> String {
        let kind = self.kind;
        if let Some(saddle) = self.saddle {
            return match saddle {
                Saddle::Diagonal => {
                    format!("{kind}, eliminated from the saddle-point system of the constraints")
                }
                Saddle::Sparse => {
                    let (count, entries) =
                        self.sparsity.as_ref().map_or((0, 0), |it| (it.order.len(), it.factor()));
                    let all = count * count.saturating_sub(1) / 2;
                    format!(
                        "{kind}, eliminated from the saddle-point system of the constraints; of the {count} × {count} \
                         matrix that is left a sparse factorisation has {entries} entries beside the diagonal instead of {all}"
                    )
                }
                Saddle::Whole { .. } | Saddle::Switched { .. } => {
                    format!("{kind}, solved with the constraints in the null space of their gradients")
                }
            };
        }
        let sized = |wanted: fn(&Method) -> bool| {
            self.blocks.iter().filter(|b| wanted(&b.method)).map(|b| b.coordinates.len()).max()
        };
        let written = sized(|m| matches!(m, Method::WrittenOut { .. }));
        let mut parts = Vec::new();
        match written {
            Some(1) => parts.push("divisions".to_owned()),
            Some(size) => parts.push(format!("a factorisation written out ({size} × {size})")),
            None => {}
        }
        if let Some(size) = sized(|m| matches!(m, Method::Recursive { .. })) {
            parts.push(format!("a recursion that does not form it ({size} × {size})"));
        }
        if let Some(size) = sized(|m| matches!(m, Method::Ldlt)) {
            parts.push(format!("LDLᵀ ({size} × {size})"));
        }
        if let Some(size) = sized(|m| matches!(m, Method::Lu)) {
            parts.push(format!("LU with pivoting ({size} × {size})"));
        }
        format!("{kind}, solved by {}", parts.join(" and "))
    }
}

fn kind(facts: &Facts) -> &'static str {
    match (facts.constant_mass, facts.diagonal_mass) {
        (true, true) => "constant and diagonal",
        (true, false) => "constant",
        (false, true) => "diagonal",
        (false, false) if facts.blocks.len() > 1 => "block diagonal",
        (false, false) => "dense",
    }
}

/// The method for a system with constraints. Accelerations are eliminated if M is diagonal without zeros, no
/// row holds at times only, and there are fewer constraints than coordinates. With as many, eliminated
/// accelerations would be differences of large forces, and rest would be noise; by the null space, which is
/// then empty, they are exact.
fn saddle(graph: &Graph, equations: &Equations, facts: &Facts) -> Saddle {
    if equations.conditions.switched.is_some() {
        return Saddle::Switched { definite: equations.definite };
    }
    let full = || equations.mass.rows().iter().enumerate().all(|(i, row)| !graph.is_zero(row[i]));
    let open = equations.conditions.count() < equations.momenta.len();
    match facts.diagonal_mass && open && full() {
        true => Saddle::Diagonal,
        false => Saddle::Whole { definite: equations.definite },
    }
}

/// The method that solves a block. `None` if it needs a mass matrix that is not formed.
fn of_block(
    model: &mut Model,
    equations: &Equations,
    coordinates: &[usize],
    diagnostics: &mut Diagnostics,
) -> Option<Block> {
    let graph = &mut model.graph;
    let mass = match &equations.mass {
        MassMatrix::Formed(mass) => mass,
        MassMatrix::Known { is_constant, .. } => {
            // A small block beside large ones may take a recursion at any cost.
            let bound = if coordinates.len() > 8 { factored(coordinates.len()) } else { u32::MAX };
            let method = recursion(graph, equations, coordinates, bound)?;
            return Some(Block { coordinates: coordinates.to_vec(), method, constant: *is_constant });
        }
    };
    let entry = |i: usize, j: usize| mass[i.max(j)][i.min(j)];
    let constant =
        coordinates.iter().all(|&i| coordinates.iter().all(|&j| graph.dependence(entry(i, j)).is_fixed()));
    let (order, operations) = elimination::order(graph, coordinates, &entry);
    let small = coordinates.len() <= 3 || operations <= WRITTEN_OUT;
    let method = match (equations.definite || coordinates.len() == 1, small) {
        (true, true) => {
            let result = eliminate(graph, coordinates, &order, &entry, &equations.force);
            if let Some(&(coordinate, ..)) = result.pivots.iter().find(|(_, pivot, _)| graph.is_zero(*pivot))
            {
                let quantity = &model.coordinates[coordinate];
                let of = |other: usize| !graph.is_zero(entry(coordinate, other));
                let is_indefinite = !of(coordinate) && coordinates.iter().any(|&other| of(other));
                let text = if is_indefinite { physics::indefinite } else { physics::structurally_singular };
                diagnostics.at(quantity.origin, text(&quantity.written()));
            }
            let mut pivots = unknown(graph, &result.pivots);
            if !equations.definite {
                // A single entry may have either sign.
                for pivot in &mut pivots {
                    pivot.value = graph.powi(pivot.value, 2);
                    pivot.scale = pivot.value;
                }
            }
            Method::WrittenOut { pivots, solution: result.solution }
        }
        (true, false) if constant => Method::Ldlt,
        (true, false) => {
            let dense = dense_cost(graph, equations, mass, coordinates);
            recursion(graph, equations, coordinates, dense).unwrap_or(Method::Ldlt)
        }
        (false, _) if coordinates.len() == 2 => {
            let method = cramer(graph, coordinates, &entry, &equations.force);
            if let Method::WrittenOut { pivots, .. } = &method
                && pivots.iter().any(|pivot| graph.is_zero(pivot.value))
            {
                let quantity = &model.coordinates[coordinates[1]];
                diagnostics.at(quantity.origin, physics::structurally_singular(&quantity.written()));
            }
            method
        }
        (false, _) => Method::Lu,
    };
    Some(Block { coordinates: coordinates.to_vec(), method, constant })
}

/// Operations of an LDLᵀ factorisation and of one solution.
fn factored(size: usize) -> u32 {
    (size * (size * size - 1) / 3 + size * (size - 1) / 2 + 2 * size * size) as u32
}

/// Operations that form a block, factor it, and solve once.
fn dense_cost(graph: &Graph, equations: &Equations, mass: &[Vec<NodeId>], block: &[usize]) -> u32 {
    let size = block.len();
    let entries = (0..size).flat_map(|row| (0..=row).map(move |column| (row, column)));
    let mut formed: Vec<NodeId> = entries.map(|(row, column)| mass[block[row]][block[column]]).collect();
    formed.extend(block.iter().map(|&i| equations.force[i]));
    cost(graph, &formed) + factored(size)
}

/// A recursion for a block, if it takes fewer operations than a bound.
fn recursion(graph: &mut Graph, equations: &Equations, block: &[usize], bound: u32) -> Option<Method> {
    let right: Vec<NodeId> = block.iter().map(|&i| equations.force[i]).collect();
    let mut trial = graph.clone();
    let form = Quadratic::of(&mut trial, equations.inertia, block)?;
    let (recursion, pivots) = Recursion::of(&mut trial, form, bound as usize)?;
    let solution = recursion.solve(&mut trial, &right);
    if cost(&trial, &solution) >= bound {
        return None;
    }
    *graph = trial;
    let pivots: Vec<_> =
        pivots.into_iter().map(|Articulated { index, pivot, scale }| (block[index], pivot, scale)).collect();
    Some(Method::Recursive { recursion, pivots: unknown(graph, &pivots), solution })
}

/// The pivots that are not constants.
fn unknown(graph: &Graph, pivots: &[(usize, NodeId, NodeId)]) -> Vec<Pivot> {
    pivots
        .iter()
        .filter(|&&(_, value, _)| graph.as_constant(value).is_none())
        .map(|&(coordinate, value, scale)| Pivot { coordinate, value, scale })
        .collect()
}

/// Two equations with a matrix of any signature, solved by determinants, which are stable at this size.
fn cramer(
    graph: &mut Graph,
    block: &[usize],
    entry: &dyn Fn(usize, usize) -> NodeId,
    force: &[NodeId],
) -> Method {
    let (i, j) = (block[0], block[1]);
    let (a, b, c) = (entry(i, i), entry(i, j), entry(j, j));
    let (diagonal, off) = (graph.mul(a, c), graph.powi(b, 2));
    let determinant = graph.sub(diagonal, off);
    // A determinant may have either sign. Its magnitude must stay above the rounding errors of its two parts.
    let magnitude = graph.unary(Unary::Abs, determinant);
    let diagonal = graph.unary(Unary::Abs, diagonal);
    let scale = graph.add(diagonal, off);
    let guarded = graph.pivot(magnitude, scale);
    let sign = graph.unary(Unary::Signum, determinant);
    let divisor = graph.mul(guarded, sign);
    let mut component = |a: NodeId, b: NodeId, f: NodeId, g: NodeId| {
        let (first, second) = (graph.mul(a, f), graph.mul(b, g));
        let numerator = graph.sum(Number::ZERO, &[(first, Number::ONE), (second, Number::MINUS_ONE)]);
        graph.div(numerator, divisor)
    };
    let solution = vec![component(c, b, force[i], force[j]), component(a, b, force[j], force[i])];
    let pivots = vec![Pivot { coordinate: i, value: magnitude, scale }];
    Method::WrittenOut { pivots, solution }
}
