//! Classes of alike instructions.

use super::{Place, Surroundings};
use crate::collections::{Lookup, WordHasher};
use crate::schedule::{Instruction, Program, Slot};
use std::hash::{Hash, Hasher};

/// An operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Reference {
    /// One value, for all members.
    Same(Slot),
    /// A member of a class, by its rank.
    Member(u32, i64),
    /// An element of an array that was filled before.
    Element(u32, i64),
    /// A constant, which may differ from member to member.
    Number,
}

/// The instructions by class. Instructions of a class agree in their operation and in those of their
/// operands. They may differ further down, as the first links of a chain do from the others. Instructions of
/// different roles in one class are told apart by the runs.
pub(super) struct Classes {
    /// All instructions, in ascending order. An instruction is known by its index here.
    pub part: Vec<Slot>,
    /// The index of each slot.
    position: Vec<u32>,
    /// The class of each instruction and its rank there.
    member: Vec<(u32, u32)>,
    /// The instructions, by class and rank.
    pub members: Vec<Vec<u32>>,
    /// The operands of each instruction.
    pub references: Vec<Vec<Reference>>,
}

const NOWHERE: u32 = u32::MAX;

impl Classes {
    pub fn of(program: &Program, part: &[Slot], around: &Surroundings<'_>) -> Classes {
        let mut position = vec![NOWHERE; program.len()];
        for (place, slot) in (0_u32..).zip(part) {
            position[slot.index()] = place;
        }
        let mut operands: Vec<Vec<Slot>> = Vec::with_capacity(part.len());
        for &slot in part {
            let mut own = Vec::with_capacity(3);
            program.instruction(slot).operands(|operand| own.push(operand));
            operands.push(own);
        }
        let operations: Vec<u64> = part.iter().map(|&slot| operation(program.instruction(slot))).collect();
        let outside = |slot: Slot| match ((around.place)(slot), program.instruction(slot)) {
            (Some(Place { array, kind, .. }), _) => hash(&(1_u32, array, kind)),
            (None, Instruction::Literal(_)) => hash(&2_u32),
            (None, _) => hash(&(3_u32, slot)),
        };
        let key = |(&operation, own): (&u64, &Vec<Slot>)| {
            own.iter().fold(operation, |key, &slot| match position[slot.index()] {
                NOWHERE => hash(&(key, outside(slot))),
                place => hash(&(key, operations[place as usize])),
            })
        };
        let keys = operations.iter().zip(&operands).map(key);
        let mut known: Lookup<u64, u32> = Lookup::default();
        let mut members: Vec<Vec<u32>> = Vec::new();
        let mut member = Vec::with_capacity(part.len());
        for (place, key) in (0_u32..).zip(keys) {
            let class = known.get(&key).copied().unwrap_or_else(|| {
                members.push(Vec::new());
                known.insert(key, members.len() as u32 - 1);
                members.len() as u32 - 1
            });
            member.push((class, members[class as usize].len() as u32));
            members[class as usize].push(place);
        }
        let reference = |&slot: &Slot| match position[slot.index()] {
            NOWHERE => match ((around.place)(slot), program.instruction(slot)) {
                (Some(Place { array, index, .. }), _) => Reference::Element(array, i64::from(index)),
                (None, Instruction::Literal(_)) => Reference::Number,
                (None, _) => Reference::Same(slot),
            },
            place => {
                let (class, rank) = member[place as usize];
                match members[class as usize].len() < around.least {
                    true => Reference::Same(slot),
                    false => Reference::Member(class, i64::from(rank)),
                }
            }
        };
        let references = operands.iter().map(|own| own.iter().map(reference).collect()).collect();
        Classes { part: part.to_vec(), position, member, members, references }
    }

    /// The index of a slot, if it is one of the instructions.
    pub fn place(&self, slot: Slot) -> Option<usize> {
        let place = self.position[slot.index()];
        (place != NOWHERE).then_some(place as usize)
    }

    /// The class of an instruction and its rank there.
    pub fn member(&self, place: usize) -> (usize, usize) {
        let (class, rank) = self.member[place];
        (class as usize, rank as usize)
    }
}

/// A number for the operation of an instruction.
fn operation(instruction: Instruction) -> u64 {
    match instruction {
        Instruction::Variable(variable) => hash(&(0_u32, variable)),
        Instruction::Literal(number) => hash(&(1_u32, number)),
        Instruction::Add(..) => 2,
        Instruction::Sub(..) => 3,
        Instruction::Mul(..) => 4,
        Instruction::Div(..) => 5,
        Instruction::Neg(_) => 6,
        Instruction::Sqrt(_) => 7,
        Instruction::Unary(function, _) => hash(&(8_u32, function)),
        Instruction::Binary(function, ..) => hash(&(9_u32, function)),
        Instruction::Recip(_) => 10,
        Instruction::MulAdd(..) => 11,
        Instruction::Given(given) => hash(&(12_u32, given)),
    }
}

fn hash(what: &impl Hash) -> u64 {
    let mut hasher = WordHasher::default();
    what.hash(&mut hasher);
    hasher.finish()
}
