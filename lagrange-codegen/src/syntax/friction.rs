//! The arguments of a friction.

use super::body::{Expr, Word};
use crate::diagnostics::Origin;

/// What limits a friction.
#[derive(Clone, Debug)]
pub struct Friction {
    /// The coefficient, or the force where its size is given.
    pub kinetic: Expr,
    /// The same while it sticks, where that differs.
    pub fixed: Option<Expr>,
    /// What limits it.
    pub normal: Option<Normal>,
}

/// What limits a friction: constraints, or a particle or body.
#[derive(Clone, Debug)]
pub enum Normal {
    /// `normal = floor`, `normal = gap[1]`.
    One(Word, Option<Expr>),
    /// `normal = [across, along]`: the common size of their forces.
    Together(Vec<(Word, Option<Expr>)>, Origin),
}
