//! The steps of an evaluation, with the arrays of their values and the sources of their operands.

use super::classes::{Classes, Reference};
use super::order::Turn;
use super::parts::Parts;
use super::runs::Run;
use super::tracks::Tracks;
use super::{Loop, Rolled, Row, Source, Step, Surroundings, Walk};
use crate::schedule::{Instruction, Program, Slot};

/// The turn, row and iteration of an instruction.
type Spot = (usize, usize, usize);

/// The parts that steps are made of.
struct Steps<'a> {
    program: &'a Program,
    classes: &'a Classes,
    turns: &'a [Turn<'a>],
    tracks: Tracks,
    /// Whether the values of a row stand in an array because more than their own iteration reads them, by
    /// turn and row.
    stored: Vec<Vec<bool>>,
    /// The array of each track, if it needs one.
    arrays: Vec<Option<usize>>,
}

/// Makes the steps of all turns.
pub(super) fn steps(
    program: &Program,
    classes: &Classes,
    parts: &Parts,
    turns: &[Turn<'_>],
    around: &Surroundings<'_>,
) -> Rolled {
    let rows = || turns.iter().flat_map(rows_of);
    let tracks = Tracks::of(classes.members.len(), rows().copied());
    let arrays = vec![None; tracks.count()];
    let stored = stored(classes, parts, turns, around);
    let mut steps = Steps { program, classes, turns, tracks, stored, arrays };
    let arrays = steps.arrays();
    Rolled { steps: turns.iter().enumerate().map(|(t, turn)| steps.step(t, turn)).collect(), arrays }
}

fn rows_of<'t, 'a>(turn: &'t Turn<'a>) -> &'t [&'a Run] {
    match turn {
        Turn::One(_) => &[],
        Turn::Loop(rows) => rows,
    }
}

/// Whether more than their own iteration reads the values of a row, by turn and row.
fn stored(classes: &Classes, parts: &Parts, turns: &[Turn<'_>], around: &Surroundings<'_>) -> Vec<Vec<bool>> {
    let mut spots: Vec<Option<Spot>> = vec![None; classes.part.len()];
    for (t, turn) in turns.iter().enumerate() {
        for (r, row) in rows_of(turn).iter().enumerate() {
            (0..row.count).for_each(|i| spots[row.place(classes, i)] = Some((t, r, i)));
        }
    }
    let mut stored: Vec<Vec<bool>> = turns.iter().map(|turn| vec![false; rows_of(turn).len()]).collect();
    for (place, own) in parts.operands.iter().enumerate() {
        let iteration = spots[place].map(|(t, _, i)| (t, i));
        for &operand in own {
            if let Some((t, r, i)) = spots[operand] {
                stored[t][r] |= iteration != Some((t, i));
            }
        }
        if let Some((t, r, _)) = spots[place] {
            stored[t][r] |= (around.is_kept)(classes.part[place]);
        }
    }
    stored
}

impl Steps<'_> {
    /// The elements of the arrays that are written or read.
    fn arrays(&mut self) -> Vec<Vec<Slot>> {
        let mut needed = vec![false; self.tracks.count()];
        for (turn, stored) in self.turns.iter().zip(&self.stored) {
            for (row, &stored) in rows_of(turn).iter().zip(stored) {
                if let (true, Some((track, _))) = (stored, self.tracks.place(row.class, row.first)) {
                    needed[track] = true;
                }
                for source in self.sources(row, rows_of(turn)) {
                    if let Source::Own(walk) = source {
                        needed[walk.array] = true;
                    }
                }
            }
        }
        let mut arrays = Vec::new();
        for (class, members) in self.classes.members.iter().enumerate() {
            for (track, ranks) in self.tracks.ranks(class).filter(|(track, _)| needed[*track]) {
                self.arrays[track] = Some(arrays.len());
                let slot = |rank: i64| self.classes.part[members[rank as usize] as usize];
                arrays.push(ranks.map(slot).collect());
            }
        }
        arrays
    }

    fn step(&self, t: usize, turn: &Turn<'_>) -> Step {
        match turn {
            Turn::One(place) => {
                let (class, rank) = self.classes.member(*place);
                let element = self.tracks.place(class, rank as i64);
                let element = element.and_then(|(track, index)| Some((self.arrays[track]?, index as usize)));
                Step::One(self.classes.part[*place], element)
            }
            Turn::Loop(rows) => {
                let row = |(r, row): (usize, &&Run)| {
                    let walk = self.tracks.walk(row.class, row.first, row.stride);
                    Row {
                        slots: (0..row.count).map(|i| self.slot(row, i)).collect(),
                        operands: self
                            .sources(row, rows)
                            .into_iter()
                            .map(|source| self.settled(source))
                            .collect(),
                        store: walk.filter(|_| self.stored[t][r]).and_then(|walk| self.in_array(walk)),
                    }
                };
                Step::Loop(Loop { count: rows[0].count, rows: rows.iter().enumerate().map(row).collect() })
            }
        }
    }

    fn slot(&self, row: &Run, iteration: usize) -> Slot {
        self.classes.part[row.place(self.classes, iteration)]
    }

    /// A walk along a track as a walk along the array of that track. `None` if the track has no array.
    fn in_array(&self, walk: Walk) -> Option<Walk> {
        Some(Walk { array: self.arrays[walk.array]?, ..walk })
    }

    fn settled(&self, source: Source) -> Source {
        match source {
            Source::Own(walk) => {
                Source::Own(self.in_array(walk).expect("rolling: what is read has an array"))
            }
            other => other,
        }
    }

    /// The sources of the operands of a row. Walks are along tracks still.
    fn sources(&self, row: &Run, rows: &[&Run]) -> Vec<Source> {
        let read = |operand: usize, iteration: usize| {
            let mut own = Vec::with_capacity(3);
            self.program.instruction(self.slot(row, iteration)).operands(|slot| own.push(slot));
            own[operand]
        };
        let source = |(operand, reference): (usize, &Reference)| {
            let (first, stride) = (read(operand, 0), row.steps[operand]);
            match *reference {
                Reference::Same(_) => Source::Same(first),
                Reference::Number if (1..row.count).all(|i| read(operand, i) == first) => Source::Same(first),
                Reference::Number => {
                    let number = |i: usize| match self.program.instruction(read(operand, i)) {
                        Instruction::Literal(number) => number,
                        other => unreachable!("rolling: {other:?} is no constant"),
                    };
                    Source::Numbers((0..row.count).map(number).collect())
                }
                _ if stride == 0 => Source::Same(first),
                Reference::Element(array, start) => {
                    Source::Given(Walk { array: array as usize, start, stride })
                }
                Reference::Member(class, start) => {
                    let class = class as usize;
                    let is_now = |read: &&Run| {
                        read.class == class && read.stride == stride && read.place_of(start) == Some(0)
                    };
                    match rows.iter().position(is_now) {
                        Some(row) => Source::Row(row),
                        None => {
                            let walk = self.tracks.walk(class, start, stride);
                            Source::Own(walk.expect("rolling: what a run reads is on a track"))
                        }
                    }
                }
            }
        };
        row.operands.iter().enumerate().map(source).collect()
    }
}
