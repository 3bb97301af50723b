//! [`Hybrid`]: motions whose equations switch, by a method for smooth ones.

use core::marker::PhantomData;

/// A motion whose equations switch: between switches by the method `M`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hybrid<M, const C: usize, const W: usize>(PhantomData<M>);
