//! Alike parts of a program as loops.
//!
//! A chain of a hundred links is derived to one straight line of instructions, in which one block occurs a
//! hundred times. This stage finds such blocks by the instructions alone and makes loops of them. Code size
//! and compile time then do not grow with the number of blocks, and vectors run across them.
//!
//! | file | what it does |
//! | --- | --- |
//! | `classes` | classes: instructions with the same operation and alike operands |
//! | `runs` | runs: members of a class whose operands move on by equal steps |
//! | `units` | strongly connected parts of the dependences: the runs of one part must be one loop |
//! | `align` | the iteration that each member of such runs belongs to |
//! | `parts` | loops made of runs, and single instructions |
//! | `order` | an order of evaluation |
//! | `tracks` | arrays: members that are written or read in turn |
//! | `steps` | the rows of each loop, with the sources of their operands |
//!
//! Where a loop cannot be formed, its instructions stay single. The result computes the same in any case.

mod align;
mod classes;
mod order;
mod parts;
mod runs;
mod steps;
mod tracks;
mod units;

use super::{Program, Slot};
use crate::number::Number;
use classes::Classes;
use parts::Parts;

/// The place of a value that was computed before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The array.
    pub array: u32,
    /// The kind of the value. Loops walk over elements of one kind.
    pub kind: u32,
    /// The index in the array.
    pub index: u32,
}

/// The surroundings of the instructions that are to be rolled.
pub struct Surroundings<'a> {
    /// The place of a value that was computed before, if it stands in an array.
    pub place: &'a dyn Fn(Slot) -> Option<Place>,
    /// Whether a value is read by more than these instructions.
    pub is_kept: &'a dyn Fn(Slot) -> bool,
    /// The fewest iterations of a loop.
    pub least: usize,
}

/// A program of loops and single instructions.
#[derive(Clone, Debug, Default)]
pub struct Rolled {
    /// The steps, in the order of evaluation.
    pub steps: Vec<Step>,
    /// The elements of each array that loops fill and read.
    pub arrays: Vec<Vec<Slot>>,
}

impl Rolled {
    /// All loops.
    pub fn loops(&self) -> impl Iterator<Item = &Loop> {
        self.steps.iter().filter_map(|step| match step {
            Step::Loop(of) => Some(of),
            Step::One(..) => None,
        })
    }
}

/// One step of an evaluation.
#[derive(Clone, Debug)]
pub enum Step {
    /// A single instruction, with the array and the index of its value if it belongs to one.
    One(Slot, Option<(usize, usize)>),
    /// A loop.
    Loop(Loop),
}

/// A loop.
#[derive(Clone, Debug)]
pub struct Loop {
    /// The number of iterations.
    pub count: usize,
    /// The instructions of an iteration, in the order of evaluation.
    pub rows: Vec<Row>,
}

/// One instruction of a loop.
#[derive(Clone, Debug)]
pub struct Row {
    /// The results, by iteration.
    pub slots: Vec<Slot>,
    /// The sources of its operands.
    pub operands: Vec<Source>,
    /// The elements that its values go to. `None` if only their own iteration reads them.
    pub store: Option<Walk>,
}

/// The source of an operand.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// The same value in all iterations.
    Same(Slot),
    /// The value of an earlier row of the same iteration.
    Row(usize),
    /// An element of an array that loops fill.
    Own(Walk),
    /// An element of an array that was filled before.
    Given(Walk),
    /// A constant for each iteration.
    Numbers(Vec<Number>),
}

/// Elements of an array by iteration: `start + iteration · stride`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Walk {
    /// The array.
    pub array: usize,
    /// The index in the first iteration.
    pub start: i64,
    /// The difference of the indices of two successive iterations.
    pub stride: i64,
}

impl Walk {
    /// The index in an iteration.
    pub fn at(self, iteration: usize) -> i64 {
        self.start + iteration as i64 * self.stride
    }
}

/// Rolls some instructions of a program, in ascending order, none of which was computed before.
pub fn roll(program: &Program, part: &[Slot], around: &Surroundings<'_>) -> Rolled {
    let classes = Classes::of(program, part, around);
    let runs = runs::find(&classes, around.least);
    let parts = Parts::of(program, &classes, runs, around);
    let turns = order::turns(&parts, &classes);
    steps::steps(program, &classes, &parts, &turns, around)
}

#[cfg(test)]
mod tests;
