//! The macro's findings about a system: operation counts and structure, as constants of the model.

use core::fmt;
use core::ops::Add;

/// Operations of one evaluation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Additions and subtractions.
    pub additions: u32,
    /// Multiplications.
    pub multiplications: u32,
    /// Divisions.
    pub divisions: u32,
    /// Square roots.
    pub square_roots: u32,
    /// Calls of elementary functions; sine and cosine of one angle count once.
    pub functions: u32,
}

impl Cost {
    /// Counts in the order of the fields.
    #[must_use]
    pub const fn new(
        additions: u32,
        multiplications: u32,
        divisions: u32,
        square_roots: u32,
        functions: u32,
    ) -> Self {
        Self { additions, multiplications, divisions, square_roots, functions }
    }

    /// All operations, each counted once whatever it costs.
    #[must_use]
    pub const fn total(&self) -> u32 {
        self.additions + self.multiplications + self.divisions + self.square_roots + self.functions
    }
}

impl Add for Cost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            additions: self.additions + other.additions,
            multiplications: self.multiplications + other.multiplications,
            divisions: self.divisions + other.divisions,
            square_roots: self.square_roots + other.square_roots,
            functions: self.functions + other.functions,
        }
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "{} additions, {} multiplications, {} divisions, {} square roots, {} functions",
            self.additions, self.multiplications, self.divisions, self.square_roots, self.functions
        )
    }
}

/// Operations of one evaluation of the accelerations, as derived and as emitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Costs {
    /// Before optimisation, with those on parameters alone.
    pub before: Cost,
    /// After optimisation, without those done once per run.
    pub after: Cost,
}

impl fmt::Display for Costs {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "before: {}\nafter:  {}", self.before, self.after)
    }
}

/// The properties that the macro has proved of a system, and the work that it therefore left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Structure {
    /// Form of the mass matrix, such as "constant diagonal".
    pub mass_matrix: &'static str,
    /// Proven properties, one phrase each.
    pub facts: &'static [&'static str],
    /// Work that the emitted code does not do, one phrase each.
    pub skipped: &'static [&'static str],
}

impl fmt::Display for Structure {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "mass matrix: {}", self.mass_matrix)?;
        for (title, phrases) in [("facts", self.facts), ("skipped", self.skipped)] {
            if !phrases.is_empty() {
                write!(out, "\n{title}:")?;
            }
            for phrase in phrases {
                write!(out, "\n  - {phrase}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::string::ToString;

    #[test]
    fn the_total_counts_every_kind() {
        let cost = Cost {
            additions: 1,
            multiplications: 20,
            divisions: 300,
            square_roots: 4_000,
            functions: 50_000,
        };
        assert_eq!(cost.total(), 54_321);
        assert_eq!((cost + cost).total(), 2 * 54_321);
    }

    #[test]
    fn empty_lists_are_not_announced() {
        let structure = Structure { mass_matrix: "dense", facts: &["autonomous"], skipped: &[] };
        assert_eq!(structure.to_string(), "mass matrix: dense\nfacts:\n  - autonomous");
    }
}
