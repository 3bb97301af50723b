//! The order of evaluation of loops and single instructions.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::align::{Distance, distances};
use super::classes::Classes;
use super::parts::Parts;
use super::runs::Run;

/// A step of the evaluation.
pub(super) enum Turn<'a> {
    /// A single instruction.
    One(usize),
    /// A loop with these rows, in the order of evaluation.
    Loop(Vec<&'a Run>),
}

/// A unit, that is a loop or a single instruction, whose operands are computed. Single instructions go first:
/// then more loops are ready at the same time and can be joined.
type Ready = Reverse<(bool, usize, u32)>;

/// The units that wait for operands, and those that are ready.
struct Queue<'a> {
    parts: &'a Parts,
    classes: &'a Classes,
    /// The units that read each unit.
    users: Vec<Vec<u32>>,
    /// The number of units that each unit waits for.
    waits: Vec<usize>,
    ready: BinaryHeap<Ready>,
}

/// All steps in an order in which operands come before their users.
pub(super) fn turns<'a>(parts: &'a Parts, classes: &'a Classes) -> Vec<Turn<'a>> {
    let mut queue = Queue::of(parts, classes);
    let mut turns = Vec::new();
    while let Some(Reverse((_, _, unit))) = queue.ready.pop() {
        turns.push(match (unit as usize).checked_sub(parts.groups.len()) {
            Some(place) => {
                queue.finish(unit);
                Turn::One(place)
            }
            None => Turn::Loop(queue.joined(unit)),
        });
    }
    turns
}

impl<'a> Queue<'a> {
    fn of(parts: &'a Parts, classes: &'a Classes) -> Self {
        let edges = parts.edges();
        let mut users: Vec<Vec<u32>> = vec![Vec::new(); edges.len()];
        let mut waits: Vec<usize> = vec![0; edges.len()];
        for (unit, needs) in edges.iter().enumerate() {
            for &need in needs.iter().filter(|&&need| need as usize != unit) {
                users[need as usize].push(unit as u32);
                waits[unit] += 1;
            }
        }
        let mut queue = Queue { parts, classes, users, waits, ready: BinaryHeap::new() };
        for unit in 0..edges.len() {
            let exists =
                unit.checked_sub(parts.groups.len()).is_none_or(|place| parts.group[place].is_none());
            if exists && queue.waits[unit] == 0 {
                queue.push(unit as u32);
            }
        }
        queue
    }

    fn push(&mut self, unit: u32) {
        let key = match self.parts.groups.get(unit as usize) {
            Some(group) => (true, group.rows[0].place(self.classes, 0)),
            None => (false, unit as usize - self.parts.groups.len()),
        };
        self.ready.push(Reverse((key.0, key.1, unit)));
    }

    /// Notes that a unit is computed.
    fn finish(&mut self, unit: u32) {
        for user in std::mem::take(&mut self.users[unit as usize]) {
            self.waits[user as usize] -= 1;
            if self.waits[user as usize] == 0 {
                self.push(user);
            }
        }
    }

    /// The rows of a loop and of all ready loops that can join it.
    fn joined(&mut self, first: u32) -> Vec<&'a Run> {
        let parts = self.parts;
        let mut rows: Vec<&Run> = Vec::new();
        let mut joining = vec![first];
        while !joining.is_empty() {
            for unit in std::mem::take(&mut joining) {
                rows.extend(&parts.groups[unit as usize].rows);
                self.finish(unit);
            }
            let waiting = std::mem::take(&mut self.ready).into_vec();
            for Reverse((is_group, place, unit)) in waiting {
                if is_group && joins(parts, unit, first, &rows) {
                    joining.push(unit);
                } else {
                    self.ready.push(Reverse((is_group, place, unit)));
                }
            }
            joining.sort_unstable();
        }
        rows.sort_by_key(|run| run.place(self.classes, 0));
        rows
    }
}

/// Whether a loop can join another one. Either the iterations of both depend on earlier ones, or those of
/// neither do, so that they run on vectors.
fn joins(parts: &Parts, other: u32, first: u32, rows: &[&Run]) -> bool {
    let (group, first) = (&parts.groups[other as usize], &parts.groups[first as usize]);
    let fits = |distance: Distance| match distance {
        Distance::Apart => true,
        Distance::Constant(distance) if group.is_recurrent => distance <= 0,
        Distance::Constant(distance) => distance == 0,
        Distance::Varying => false,
    };
    group.is_recurrent == first.is_recurrent
        && group.rows[0].count == first.rows[0].count
        && group.rows.iter().all(|row| rows.iter().all(|read| distances(row, read).all(fits)))
}
