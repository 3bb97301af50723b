//! The mass matrix, and whether its entries are formed.

use super::motion::Motion;
use super::quadratic::Quadratic;
use crate::calculus::pushforward;
use crate::expr::{Dependence, Graph, NodeId};
use crate::model::Model;

/// The most coordinates of a decoupled block whose entries are formed in any case. With a larger block, M is
/// formed only if something asks for its entries: their number is the square of that of the coordinates, and
/// a recursion on the velocities of the kinetic energy takes time in proportion to the coordinates.
const FORMED: usize = 64;

/// M = ∂²L/∂v∂v.
#[derive(Clone, Debug)]
pub enum MassMatrix {
    /// The lower triangle, row by row.
    Formed(Vec<Vec<NodeId>>),
    /// A matrix whose entries nothing asks for.
    Known {
        /// The coordinates of each block that it decouples into, in ascending order.
        blocks: Vec<Vec<usize>>,
        /// Whether it is constant in a run.
        is_constant: bool,
    },
}

impl MassMatrix {
    /// The entries.
    ///
    /// # Panics
    /// Panics if it is not formed. That is a bug: whatever asks for entries must say so before the equations
    /// are derived.
    pub fn rows(&self) -> &[Vec<NodeId>] {
        match self {
            MassMatrix::Formed(rows) => rows,
            MassMatrix::Known { .. } => panic!("mechanics: a mass matrix that is asked for is not formed"),
        }
    }

    /// The entries, if it is formed.
    pub fn entries(&self) -> impl Iterator<Item = NodeId> + '_ {
        let rows = match self {
            MassMatrix::Formed(rows) => rows.as_slice(),
            MassMatrix::Known { .. } => &[],
        };
        rows.iter().flatten().copied()
    }

    /// The entries for replacement, if it is formed.
    pub(super) fn entries_mut(&mut self) -> impl Iterator<Item = &mut NodeId> {
        let rows = match self {
            MassMatrix::Formed(rows) => rows.as_mut_slice(),
            MassMatrix::Known { .. } => &mut [],
        };
        rows.iter_mut().flatten()
    }

    /// M = ∂p/∂v.
    pub(super) fn formed(model: &mut Model, motion: &Motion, momenta: &[NodeId]) -> Vec<Vec<NodeId>> {
        let count = momenta.len();
        let one = model.graph.one();
        let mut mass: Vec<Vec<NodeId>> = vec![Vec::with_capacity(count); count];
        for (column, &velocity) in motion.v.iter().enumerate() {
            let entries = pushforward(&mut model.graph, &momenta[column..], &[(velocity, one)]);
            for (row, entry) in entries.into_iter().enumerate() {
                mass[column + row].push(entry);
            }
        }
        mass
    }

    /// Whether the matrix of so many coordinates may have a block that is formed only on request.
    pub(super) fn is_of_many(count: usize) -> bool {
        count > FORMED
    }

    /// The mass matrix of many coordinates whose kinetic energy is `energy`. `None` if the energy is no
    /// quadratic form, or if a large block is asked for, since a sweep for each column is as good then.
    pub(super) fn of_many(
        graph: &mut Graph,
        energy: NodeId,
        count: usize,
        is_asked_for: bool,
    ) -> Option<MassMatrix> {
        let all: Vec<usize> = (0..count).collect();
        let form = Quadratic::of(graph, energy, &all)?;
        let blocks = form.blocks();
        if blocks.iter().all(|block| block.len() <= FORMED) {
            return Some(MassMatrix::Formed(form.formed(graph)));
        }
        if is_asked_for {
            return None;
        }
        let is_constant = form.coefficients().all(|node| graph.dependence(node).is_fixed());
        Some(MassMatrix::Known { blocks, is_constant })
    }

    /// Whether its entries, or the momenta if it is not formed, depend on some kind of variables.
    pub fn meets(&self, graph: &Graph, momenta: &[NodeId], kind: Dependence) -> bool {
        let nodes: Vec<NodeId> = match self {
            MassMatrix::Formed(_) => self.entries().collect(),
            MassMatrix::Known { .. } => momenta.to_vec(),
        };
        nodes.into_iter().any(|node| graph.dependence(node).meets(kind))
    }
}
