//! [`Stored`]: large tables on the heap where there is one, so that they do not fill the stack of a thread.

use core::fmt;
use core::ops::{Deref, DerefMut};

use crate::number::real::Real;

#[cfg(feature = "std")]
type Place<T> = std::boxed::Box<T>;
#[cfg(not(feature = "std"))]
type Place<T> = [T; 1];

/// A value that stands on the heap with feature `std`, and in place without it.
#[derive(Clone, PartialEq)]
pub struct Stored<T>(Place<T>);

impl<T> Stored<T> {
    /// Stores a value.
    #[inline]
    #[must_use]
    pub fn new(value: T) -> Self {
        #[cfg(feature = "std")]
        return Self(std::boxed::Box::new(value));
        #[cfg(not(feature = "std"))]
        return Self([value]);
    }
}

impl<R: Real, const A: usize, const B: usize> Stored<[[R; B]; A]> {
    /// A table of zeros, which with feature `std` is not on the stack first.
    #[must_use]
    pub fn zeros() -> Self {
        #[cfg(feature = "std")]
        {
            let rows = std::vec![[R::zero(); B]; A].into_boxed_slice();
            // There are as many rows as the array has.
            Self(rows.try_into().unwrap_or_else(|_| std::boxed::Box::new([[R::zero(); B]; A])))
        }
        #[cfg(not(feature = "std"))]
        Self::new([[R::zero(); B]; A])
    }
}

impl<T> Deref for Stored<T> {
    type Target = T;

    #[inline]
    fn deref(&self) -> &T {
        #[cfg(feature = "std")]
        return &self.0;
        #[cfg(not(feature = "std"))]
        return &self.0[0];
    }
}

impl<T> DerefMut for Stored<T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut T {
        #[cfg(feature = "std")]
        return &mut self.0;
        #[cfg(not(feature = "std"))]
        return &mut self.0[0];
    }
}

impl<T: fmt::Debug> fmt::Debug for Stored<T> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(out)
    }
}
