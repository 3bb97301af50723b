//! [`Row`]: a source of the rows of a study.

use std::cell::Cell;

use crate::failure::Failure;

/// A source of rows: a function of the index, or motions in the lanes of vectors.
pub trait Row<T>: Sync {
    /// The row of an index.
    ///
    /// # Errors
    /// Why the motion has no row.
    fn row(&self, index: u64) -> Result<T, Failure>;

    /// The rows of `count` indices from `first` on, each handed to `put` once, in any order. Each has the
    /// bits that [`Row::row`] gives it. `at` is the index that a function of the user works on, for the
    /// message of a panic.
    fn rows(&self, first: u64, count: u64, at: &Cell<u64>, put: &mut dyn FnMut(u64, Result<T, Failure>)) {
        for index in first..first + count {
            at.set(index);
            put(index, self.row(index));
        }
    }

    /// The least number of indices that [`Row::rows`] should get: lanes stand idle while the last motions
    /// end.
    fn at_once(&self) -> u64 {
        1
    }

    /// Why no row can be made.
    fn refusal(&self) -> Option<&'static str> {
        None
    }
}

impl<T, F: Fn(u64) -> Result<T, Failure> + Sync> Row<T> for F {
    fn row(&self, index: u64) -> Result<T, Failure> {
        self(index)
    }
}
