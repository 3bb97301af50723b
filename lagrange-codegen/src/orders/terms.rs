//! Sums of products as chains of multiply–adds.

use crate::number::Number;
use crate::schedule::{Instruction, Program, Slot};

/// One summand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term<T> {
    /// Whether it is subtracted.
    pub negative: bool,
    /// The factor of the value; `None` for 1.
    pub factor: Option<Slot>,
    /// The value.
    pub value: T,
}

impl<T> Term<T> {
    /// A value without a factor.
    pub fn plain(negative: bool, value: T) -> Term<T> {
        Term { negative, factor: None, value }
    }

    /// The product of a factor and a value.
    pub fn product(negative: bool, factor: Slot, value: T) -> Term<T> {
        Term { negative, factor: Some(factor), value }
    }
}

/// `start + Σ terms` as one chain, in the order of the terms; `None` for an empty sum.
pub(super) fn chain(
    program: &mut Program,
    start: Option<Slot>,
    terms: impl IntoIterator<Item = Term<Slot>>,
) -> Option<Slot> {
    terms.into_iter().fold(start, |sum, Term { negative, factor, value }| {
        Some(match (sum, factor) {
            (None, None) if negative => minus(program, value),
            (None, None) => value,
            (None, Some(factor)) => {
                let product = program.push(Instruction::Mul(factor, value));
                if negative { minus(program, product) } else { product }
            }
            (Some(sum), None) if negative => program.push(Instruction::Sub(sum, value)),
            (Some(sum), None) => program.push(Instruction::Add(sum, value)),
            (Some(sum), Some(factor)) => {
                let factor = if negative { minus(program, factor) } else { factor };
                program.push(Instruction::MulAdd(factor, value, sum))
            }
        })
    })
}

/// −a.
pub(super) fn minus(program: &mut Program, a: Slot) -> Slot {
    match program.instruction(a) {
        Instruction::Neg(positive) => positive,
        _ => program.push(Instruction::Neg(a)),
    }
}

/// A constant.
pub(super) fn literal(program: &mut Program, number: Number) -> Slot {
    let positive = program.push(Instruction::Literal(number.abs()));
    if number.is_negative() { minus(program, positive) } else { positive }
}

/// Whether a slot is this constant.
pub(super) fn is_literal(program: &Program, slot: Slot, number: Number) -> bool {
    program.instruction(slot) == Instruction::Literal(number)
}
