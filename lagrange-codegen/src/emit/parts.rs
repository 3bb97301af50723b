//! The computations of a step for each block of the mass matrix, as lists of nodes (to plan), slots (to
//! store) or texts (to print).

use super::Emission;
use crate::expr::NodeId;
use crate::structure::{Block, Method};

/// The computations of a step for one block of the mass matrix.
#[derive(Clone, Debug)]
pub(super) struct Part<T> {
    /// The coordinates of the block.
    pub coordinates: Vec<usize>,
    /// Where and when it is factored.
    pub kind: Kind,
    /// The lower triangle, row by row, if the runtime factors it.
    pub entries: Vec<T>,
    /// The accelerations, if the factorisation is written out, else the right-hand side.
    pub results: Vec<T>,
}

/// Where and when a block is factored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// In the generated code.
    WrittenOut,
    /// By the runtime.
    Runtime {
        /// The type of the factorisation: `Ldlt` or `Lu`.
        factor: &'static str,
        /// Whether the entries are the same all through a run.
        constant: bool,
    },
}

impl<T> Part<T> {
    /// Applies a function to every item, in a fixed order.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Part<U> {
        Part {
            coordinates: self.coordinates,
            kind: self.kind,
            entries: self.entries.into_iter().map(&mut f).collect(),
            results: self.results.into_iter().map(&mut f).collect(),
        }
    }

    /// Whether the factorisation is made once per run.
    pub fn factored_once(&self) -> bool {
        matches!(self.kind, Kind::Runtime { constant: true, .. })
    }
}

impl Part<NodeId> {
    /// The parts of all blocks.
    pub fn all(emission: &Emission<'_>) -> Vec<Part<NodeId>> {
        emission.solution.blocks.iter().map(|block| Part::of(emission, block)).collect()
    }

    fn of(emission: &Emission<'_>, block: &Block) -> Part<NodeId> {
        let coordinates = block.coordinates.clone();
        let constant = block.constant;
        let factor = match &block.method {
            Method::WrittenOut { solution, .. } | Method::Recursive { solution, .. } => {
                let results = solution.clone();
                return Part { coordinates, kind: Kind::WrittenOut, entries: Vec::new(), results };
            }
            Method::Ldlt => "Ldlt",
            Method::Lu => "Lu",
        };
        let lower = |row: usize| block.coordinates[..=row].iter().map(move |&j| (block.coordinates[row], j));
        let entries =
            (0..coordinates.len()).flat_map(lower).map(|(i, j)| emission.solved.mass.rows()[i][j]).collect();
        let results = coordinates.iter().map(|&i| emission.solved.force[i]).collect();
        Part { coordinates, kind: Kind::Runtime { factor, constant }, entries, results }
    }
}
