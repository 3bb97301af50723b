//! How many operations the runtime's loops over bodies take.
//!
//! The numbers are those of `system/screws.rs` of the runtime, whose tests count them.

use super::Screws;

/// Inertia, momentum and force of what a group moves.
const BODIES: usize = 266;
/// Those of a group added to what carries it.
const CARRIED: usize = 194;
/// The rates of a coordinate along the motion, where they are given, and where they are not.
const GIVEN: usize = 72;
const RATES: usize = 132;
/// What a coordinate does to the bodies that it moves.
const COORDINATE: usize = 318;
/// A coordinate with another one of its group.
const WITHIN: usize = 33;
/// What a coordinate does about the common point, and what it does with [`LANES`] of those that move more
/// bodies in operations on vectors.
const ABOVE: usize = 48;
const BLOCK: usize = 73;
const LANES: usize = 8;
/// A change of a screw within its group.
const CHANGE: usize = 24;

impl Screws {
    /// Operations of M and the derivatives, once a state is turned into screws.
    pub fn operations(&self) -> usize {
        let mut ends = Vec::with_capacity(self.groups.len());
        let mut operations = CHANGE * self.changes.len();
        for group in &self.groups {
            let (own, above) = (group.coordinates.len(), group.parent.map_or(0, |parent| ends[parent]));
            ends.push(above + own);
            let pairs = if above > 0 { ABOVE + BLOCK * above.div_ceil(LANES) } else { 0 };
            let rates = if group.given.is_some() { GIVEN } else { RATES };
            let carried = if group.parent.is_some() { CARRIED } else { 0 };
            operations += BODIES + carried + own * (rates + COORDINATE + WITHIN * own + pairs);
        }
        operations
    }
}
