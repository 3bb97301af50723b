//! Maximum matchings of rows to columns by augmenting paths.
//!
//! A square matrix whose pattern of nonzero entries has no complete matching is singular whatever the
//! entries.

/// A matching that grows row by row.
pub(super) struct Matching<F> {
    nonzero: F,
    /// The row of each column.
    partner: Vec<Option<usize>>,
}

impl<F: Fn(usize, usize) -> bool> Matching<F> {
    /// A matching without rows.
    pub fn new(columns: usize, nonzero: F) -> Matching<F> {
        Matching { nonzero, partner: vec![None; columns] }
    }

    /// Matches one more row, or returns false if that is impossible. Rows matched before stay matched.
    pub fn add(&mut self, row: usize) -> bool {
        let mut seen = vec![false; self.partner.len()];
        self.augment(row, &mut seen)
    }

    fn augment(&mut self, row: usize, seen: &mut [bool]) -> bool {
        for column in 0..self.partner.len() {
            if (self.nonzero)(row, column) && !std::mem::replace(&mut seen[column], true) {
                let free = match self.partner[column] {
                    None => true,
                    Some(other) => self.augment(other, seen),
                };
                if free {
                    self.partner[column] = Some(row);
                    return true;
                }
            }
        }
        false
    }
}
