//! How many operations the runtime's loops over bodies take.
//!
//! The numbers are those of `system/screws.rs` of the runtime, whose tests count them.

use super::Screws;

/// Inertia, momentum and force of what a group moves.
const BODIES: usize = 197;
/// Those of a group added to what carries it.
const CARRIED: usize = 155;
/// The rates of a coordinate along the motion, where they are given, and where they are not.
const GIVEN: usize = 72;
const RATES: usize = 132;
/// What a coordinate does to the bodies that it moves.
const COORDINATE: usize = 354;
/// A coordinate with others, [`LANES`] of them in one operation on vectors.
const BLOCK: usize = 72;
const LANES: usize = 4;
/// A change of a screw within its group.
const CHANGE: usize = 12;

impl Screws {
    /// Operations of M and the derivatives, once a state is turned into screws.
    pub fn operations(&self) -> usize {
        let mut ends = Vec::with_capacity(self.groups.len());
        let mut operations = CHANGE * self.changes.len();
        for group in &self.groups {
            let (own, above) = (group.coordinates.len(), group.parent.map_or(0, |parent| ends[parent]));
            ends.push(above + own);
            let blocks = own.div_ceil(LANES) + above.div_ceil(LANES);
            let rates = if group.given.is_some() { GIVEN } else { RATES };
            let carried = if group.parent.is_some() { CARRIED } else { 0 };
            operations += BODIES + carried + own * (rates + COORDINATE + BLOCK * blocks);
        }
        operations
    }
}
