//! Alike parts of a program as loops over arrays.

use super::{Strength, Text, Writer};
use crate::emit::names::{Names, describe, without_number};
use crate::emit::scalar;
use crate::expr::Unary;
use crate::schedule::{
    Instruction, Loop, Operations, Program, Rolled, Row, Slot, Source, Step, Surroundings, Walk, roll,
};

/// The loops of a body, for `STRUCTURE`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::emit) struct Loops {
    /// The number of loops.
    pub count: usize,
    /// The instructions that one iteration of each takes.
    pub rows: usize,
    /// The instructions that the loops stand for.
    pub instructions: usize,
}

/// One evaluation of the accelerations, as emitted.
#[derive(Clone, Copy, Debug)]
pub(in crate::emit) struct Evaluation {
    /// Its operations.
    pub operations: Operations,
    /// Its loops.
    pub loops: Loops,
}

impl Loops {
    /// A line for `STRUCTURE` that counts the loops. `None` without loops.
    pub fn describe(self) -> Option<String> {
        let Loops { count, rows, instructions } = self;
        let noun = if count == 1 { "loop" } else { "loops" };
        (count > 0).then(|| {
            format!(
                "alike parts: {count} {noun} of {rows} instructions stand for {instructions} \
                 in the accelerations"
            )
        })
    }
}

impl Writer<'_> {
    /// Writes instructions with loops for the alike ones. Returns `false` if there are no loops.
    pub(super) fn roll(&mut self, reached: &[Slot], names: &mut Names) -> bool {
        let least = self.model.locals.least;
        if reached.len() < 2 * least {
            return false;
        }
        let program = self.program;
        let (leaves, part): (Vec<Slot>, Vec<Slot>) =
            reached.iter().partition(|&&slot| program.instruction(slot).is_leaf());
        let mut within = vec![0_u32; program.len()];
        for &slot in &part {
            program.instruction(slot).operands(|operand| within[operand.index()] += 1);
        }
        let place = |slot: Slot| self.places.place(program, slot);
        let is_kept = |slot: Slot| self.uses[slot.index()] > within[slot.index()];
        let rolled = roll(program, &part, &Surroundings { place: &place, is_kept: &is_kept, least });
        if rolled.loops().next().is_none() {
            return false;
        }
        for Loop { count, rows } in rolled.loops() {
            self.loops.count += 1;
            self.loops.rows += rows.len();
            self.loops.instructions += count * rows.len();
        }
        for slot in leaves {
            self.visit(slot, names);
        }
        self.write_rolled(&rolled, names);
        true
    }

    fn write_rolled(&mut self, rolled: &Rolled, names: &mut Names) {
        let arrays: Vec<String> = rolled.arrays.iter().map(|members| self.array(members, names)).collect();
        // Values that every iteration reads are computed before the loop.
        for source in rolled.loops().flat_map(|of| &of.rows).flat_map(|row| &row.operands) {
            if let Source::Same(slot) = source {
                self.is_bound[slot.index()] |= !self.program.instruction(*slot).is_leaf();
            }
        }
        for step in &rolled.steps {
            match step {
                Step::One(slot, store) => {
                    self.visit(*slot, names);
                    if let Some((array, place)) = *store {
                        let element = format!("{}[{place}]", arrays[array]);
                        let text = self.text(*slot).text;
                        self.statements.push(format!("{element} = {text};"));
                        self.texts[slot.index()] = Some(Text::atom(element));
                    }
                }
                Step::Loop(of) => self.write_loop(of, &arrays, names),
            }
        }
    }

    /// Declares an array for alike values. Returns its name.
    fn array(&mut self, members: &[Slot], names: &mut Names) -> String {
        let name = names.claim(self.common_name(members));
        let (scalar, zero, count) = (self.scalar, scalar::zero(self.scalar), members.len());
        self.arrays.push(format!("let mut {name}: [{scalar}; {count}] = [{zero}; {count}];"));
        self.places.add(name.clone(), members);
        name
    }

    /// A name for an array of alike values: the name of one of them without its number.
    fn common_name(&mut self, members: &[Slot]) -> Option<String> {
        let slot = members[members.len() / 2];
        let name =
            self.wishes[slot.index()].clone().or_else(|| describe(self.model, self.program, slot, 0))?;
        Some(without_number(&name))
    }

    fn write_loop(&mut self, of: &Loop, arrays: &[String], names: &mut Names) {
        let Loop { count, rows } = of;
        // The index of the loop is that of an array that it fills in ascending order.
        let stores = || rows.iter().filter_map(|row| row.store);
        let first = stores().find(|walk| walk.stride == 1).map_or(0, |walk| walk.start);
        let element = |name: &str, Walk { start, stride, .. }: Walk| {
            Text::atom(format!("{name}[{}]", place(start, stride, first)))
        };
        let mut uses = vec![0; rows.len()];
        for source in rows.iter().flat_map(|row| &row.operands) {
            if let Source::Row(row) = source {
                uses[*row] += 1;
            }
        }
        let mut texts: Vec<Option<Text>> = vec![None; rows.len()];
        let mut body: Vec<String> = Vec::new();
        for (place, row) in rows.iter().enumerate() {
            if texts[place].is_none() {
                let instruction = self.program.instruction(row.slots[0]);
                let operands: Vec<Text> = row
                    .operands
                    .iter()
                    .map(|source| match source {
                        Source::Same(slot) => self.text(*slot),
                        Source::Row(row) => texts[*row].clone().unwrap_or_else(|| Text::atom(String::new())),
                        Source::Own(walk) => element(&arrays[walk.array], *walk),
                        Source::Given(walk) => {
                            let indices = (0..*count).map(|iteration| walk.at(iteration));
                            self.places.note(walk.array, indices, &mut self.reads);
                            element(self.places.name(walk.array), *walk)
                        }
                        Source::Numbers(numbers) => {
                            let name = names.claim(Some("numbers".to_owned()));
                            let values: Vec<String> = numbers
                                .iter()
                                .map(|&number| scalar::literal(self.scalar, number, false))
                                .collect();
                            self.statements.push(format!(
                                "let {name}: [{}; {count}] = [{}];",
                                self.scalar,
                                values.join(", ")
                            ));
                            element(&name, Walk { array: 0, start: 0, stride: 1 })
                        }
                    })
                    .collect();
                if let Some(partner) = partner(self.program, rows, place) {
                    let [sine, cosine] = match instruction {
                        Instruction::Unary(Unary::Sin, _) => [place, partner],
                        _ => [partner, place],
                    };
                    let pair = [sine, cosine].map(|row| names.claim(self.common_name(&rows[row].slots)));
                    body.push(format!(
                        "let ({}, {}) = Real::sin_cos({});",
                        pair[0], pair[1], operands[0].text
                    ));
                    for (row, name) in [sine, cosine].into_iter().zip(pair) {
                        texts[row] = Some(Text::atom(name));
                    }
                } else {
                    texts[place] = Some(self.compose(instruction, &operands));
                }
            }
            let Some(text) = texts[place].clone() else { continue };
            let mut text = text;
            let is_wide = text.text.len() > super::WIDEST;
            let is_name = text.strength == Strength::Atom && !text.text.contains(['(', '[']);
            let local = uses[place] > usize::from(row.store.is_none() && !is_wide);
            if local && !is_name {
                let name = names.claim(self.common_name(&row.slots));
                body.push(format!("let {name} = {};", text.text));
                text = Text::atom(name);
            }
            if let Some(walk) = row.store {
                body.push(format!("{} = {};", element(&arrays[walk.array], walk).text, text.text));
            }
            texts[place] = Some(text);
        }
        let last = first + *count as i64;
        self.statements.push(format!("for i in {first}..{last} {{\n{}\n}}", body.join("\n")));
        for row in rows {
            let Some(walk) = row.store else { continue };
            for (iteration, slot) in row.slots.iter().enumerate() {
                let element = format!("{}[{}]", arrays[walk.array], walk.at(iteration));
                self.texts[slot.index()] = Some(Text::atom(element));
            }
        }
    }
}

/// The index of an element as an expression of the loop's index `i`, which begins with `first`.
pub(super) fn place(start: i64, stride: i64, first: i64) -> String {
    let offset = start - stride * first;
    let way = match stride.unsigned_abs() {
        1 => "i".to_owned(),
        times => format!("{times} * i"),
    };
    match (stride, offset) {
        (..0, _) => format!("{offset} - {way}"),
        (_, 0) => way,
        (_, 1..) => format!("{way} + {offset}"),
        (_, ..0) => format!("{way} - {}", -offset),
    }
}

/// The row with the cosine of the angle of a sine, or with the sine of the angle of a cosine.
fn partner(program: &Program, rows: &[Row], place: usize) -> Option<usize> {
    let function = |row: &Row| match program.instruction(row.slots[0]) {
        Instruction::Unary(function, _) => Some(function),
        _ => None,
    };
    let other = match function(&rows[place])? {
        Unary::Sin => Unary::Cos,
        Unary::Cos => Unary::Sin,
        _ => return None,
    };
    rows.iter().position(|row| function(row) == Some(other) && row.operands == rows[place].operands)
}
