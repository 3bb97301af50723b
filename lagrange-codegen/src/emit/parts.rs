//! The blocks of the mass matrix as lists of results: which nodes, which slots, which texts.

use super::Emission;
use crate::expr::NodeId;
use crate::structure::Method;

/// What is computed for one block.
#[derive(Clone, Debug)]
pub(super) struct Part<T> {
    /// The coordinates of the block.
    pub coordinates: Vec<usize>,
    /// How it is solved.
    pub kind: Kind,
    /// Pivots to check with their scales, where the factorisation is written out.
    pub pivots: Vec<(usize, T, T)>,
    /// Lower triangle, row by row, where the runtime factors.
    pub entries: Vec<T>,
    /// Accelerations where the factorisation is written out, else the right-hand side.
    pub results: Vec<T>,
}

/// Where and when a block is factored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// In the generated code.
    WrittenOut,
    /// By the runtime's function of this name, once per run if constant.
    Runtime {
        /// `ldlt` or `lu`.
        function: &'static str,
        /// The type that it returns.
        factor: &'static str,
        /// Whether the entries are the same all through a run.
        constant: bool,
    },
}

impl<T> Part<T> {
    /// Every item through a function, in a fixed order.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Part<U> {
        Part {
            coordinates: self.coordinates,
            kind: self.kind,
            pivots: self.pivots.into_iter().map(|(i, value, scale)| (i, f(value), f(scale))).collect(),
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
        let equations = emission.equations;
        let runtime = |coordinates: &[usize], function, factor, constant| {
            let lower = |place: usize| coordinates[..=place].iter().map(move |&j| (coordinates[place], j));
            Part {
                coordinates: coordinates.to_vec(),
                kind: Kind::Runtime { function, factor, constant },
                pivots: Vec::new(),
                entries: (0..coordinates.len()).flat_map(lower).map(|(i, j)| equations.mass[i][j]).collect(),
                results: coordinates.iter().map(|&i| equations.force[i]).collect(),
            }
        };
        let part = |block: &crate::structure::Block| match &block.method {
            Method::WrittenOut { pivots, solution } => Part {
                coordinates: block.coordinates.clone(),
                kind: Kind::WrittenOut,
                pivots: pivots.iter().map(|pivot| (pivot.coordinate, pivot.value, pivot.scale)).collect(),
                entries: Vec::new(),
                results: solution.clone(),
            },
            Method::Ldlt => runtime(&block.coordinates, "ldlt", "Ldlt", block.constant),
            Method::Lu => runtime(&block.coordinates, "lu", "Lu", block.constant),
        };
        emission.solution.blocks.iter().map(part).collect()
    }
}
