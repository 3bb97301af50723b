//! A system with rows that can be switched off, before it is factored.

use super::scaled::units;
use crate::number::real::Real;

/// M, A, friction and forces at a state; `L` holds the factors of the sums that are loads.
#[derive(Clone, Copy, Debug)]
pub struct Parts<R, const N: usize, const C: usize, L = ()> {
    /// The lower triangle of M.
    pub mass: [[R; N]; N],
    /// A, of the active rows.
    pub gradients: [[R; N]; C],
    /// The change of the force of a row by a reaction.
    pub coupling: [[R; N]; C],
    /// One for a row that is active, else zero.
    pub active: [R; C],
    /// Factors of the sums.
    pub shares: L,
    /// All forces except those of constraints, minus the bias.
    pub forces: [R; N],
    /// γ: the value of A a for which d²f/dt², or dg/dt of a nonholonomic constraint, vanishes.
    pub gamma: [R; C],
}

/// The rows of a system without its factors.
#[derive(Clone, Copy, Debug)]
pub struct Rows<R, const N: usize, const C: usize> {
    /// A, of the active rows.
    pub gradients: [[R; N]; C],
    /// γ of these.
    pub gamma: [R; C],
    /// All forces except those of constraints, minus the bias.
    pub forces: [R; N],
    /// Units in which no coordinate is larger than another.
    pub units: [R; N],
}

impl<R: Real, const N: usize, const C: usize, L> Parts<R, N, C, L> {
    /// The part that needs no factors.
    #[inline]
    pub fn rows(&self) -> Rows<R, N, C> {
        let Self { gradients, gamma, forces, .. } = *self;
        Rows { gradients, gamma, forces, units: units(&self.mass, &self.gradients) }
    }
}
