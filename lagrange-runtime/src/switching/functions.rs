//! The functions whose zeros end a regime, one by one and as plain numbers.

use super::Functions;
use super::guards::Guard;
use crate::number::real::Ordered;
use crate::series::taylor::Taylor;

impl<T, const C: usize, const W: usize> Functions<T, C, W> {
    /// One of them.
    pub(super) fn get(&self, guard: Guard) -> &T {
        let found = match guard {
            Guard::Row(row) => self.rows.get(row),
            Guard::Kink(kink) => self.kinks.get(kink),
        };
        // The index of a guard is within its array; the alternatives tell the compiler so.
        match found.or(self.rows.first()).or(self.kinks.first()) {
            Some(function) => function,
            None => unreachable!("a system that switches has rows or kinks"),
        }
    }
}

impl<R: Ordered, const T: usize, const C: usize, const W: usize> Functions<Taylor<R, T>, C, W> {
    /// The same without derivatives: values alone tell where they are zero.
    pub(super) fn plain(self) -> Self {
        if R::PARTS == 1 {
            return self;
        }
        let plain = |x: &Taylor<R, T>| x.plain();
        Self {
            rows: self.rows.each_ref().map(plain),
            fixed: self.fixed.each_ref().map(plain),
            kinks: self.kinks.each_ref().map(plain),
        }
    }
}
