//! The functions whose zeros end a regime, one by one.

use super::Functions;
use super::guards::Guard;

impl<T, const C: usize, const W: usize> Functions<T, C, W> {
    /// One of them.
    pub(super) fn get(&self, guard: Guard) -> &T {
        let found = match guard {
            Guard::Row(row) => self.rows.get(row),
            Guard::Kink(kink) => self.kinks.get(kink),
        };
        // The index of a guard is within its array. With these alternatives the compiler, too, sees that no
        // system with rows or kinks panics here.
        match found.or(self.rows.first()).or(self.kinks.first()) {
            Some(function) => function,
            None => unreachable!("a system that switches has rows or kinks"),
        }
    }
}
