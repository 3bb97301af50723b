//! The arguments of a friction.

use super::body::{Expr, Word};
use crate::diagnostics::Origin;

/// The limit of a friction.
#[derive(Clone, Debug)]
pub struct Friction {
    /// The coefficient, or the largest force where that is given.
    pub kinetic: Expr,
    /// The same while the friction sticks, if it differs.
    pub fixed: Option<Expr>,
    /// The reactions that limit it.
    pub normal: Option<Normal>,
}

/// The reactions that limit a friction: those of constraints, or of a particle or body.
#[derive(Clone, Debug)]
pub enum Normal {
    /// `normal = floor`, `normal = gap[1]`.
    One(Word, Option<Expr>),
    /// `normal = [across, along]`: the common size of their forces.
    Together(Vec<(Word, Option<Expr>)>, Origin),
}
