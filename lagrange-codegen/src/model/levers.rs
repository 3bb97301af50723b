//! Places that rotations carry, as the description composed them.

use super::Rotation;
use crate::collections::Lookup;
use crate::expr::NodeId;

/// A place p = base + R arm.
#[derive(Clone, Debug)]
pub struct Lever {
    /// p, in space axes.
    pub place: [NodeId; 3],
    /// The base, in space axes. It is zero for a vector that is only turned.
    pub base: [NodeId; 3],
    /// R.
    pub rotation: Rotation,
    /// The arm, in the axes of R.
    pub arm: [NodeId; 3],
}

/// The levers of a description, at most one for a place.
#[derive(Clone, Debug, Default)]
pub struct Levers {
    levers: Vec<Lever>,
    known: Lookup<[NodeId; 3], usize>,
}

impl Levers {
    /// Adds a lever, unless its place is known, or stands before its base in the graph: a walk from place to
    /// base must come to an end.
    pub fn insert(&mut self, lever: Lever) {
        let follows = lever.place.iter().zip(&lever.base).all(|(place, base)| place >= base);
        if follows && lever.place != lever.base && !self.known.contains(&lever.place) {
            self.known.insert(lever.place, self.levers.len());
            self.levers.push(lever);
        }
    }

    /// The lever of a place.
    pub fn of(&self, place: &[NodeId; 3]) -> Option<&Lever> {
        self.known.get(place).map(|&index| &self.levers[index])
    }

    /// The lever that carries a particle.
    pub fn carrying(&self, position: &[NodeId]) -> Option<&Lever> {
        self.of(&position.try_into().ok()?)
    }

    /// All levers, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = &Lever> {
        self.levers.iter()
    }

    /// Takes all levers out, to be changed and added again.
    pub fn take(&mut self) -> Vec<Lever> {
        std::mem::take(self).levers
    }
}
