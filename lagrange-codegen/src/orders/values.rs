//! Values at the point of expansion.

use crate::collections::Lookup;
use crate::expr::{Exponent, NodeId, Variable};
use crate::jets::{Jets, Value};
use crate::number::Number;
use crate::schedule::{Instruction, Program, Slot, plan};

use super::terms::{literal, minus};

/// The values of order zero, by slot of the recurrences.
pub(super) fn values(jets: &Jets, program: &mut Program) -> Vec<Slot> {
    // A slot without a value is no operand.
    let nothing = literal(program, Number::ZERO);
    let mut values = vec![nothing; jets.program.len()];
    for &slot in &jets.order {
        let of = |slot: Slot| values[slot.index()];
        let value = match jets.auxiliary(slot) {
            Some(series) => match series.value {
                Value::Unary(function, x) => program.push(Instruction::Unary(function, of(x))),
                Value::Binary(function, x, y) => program.push(Instruction::Binary(function, of(x), of(y))),
                Value::Power(x, exponent) => power(program, of(x), exponent),
                Value::Same(x) => of(x),
            },
            None => match jets.program.instruction(slot) {
                // Multipliers have no value before an order gives them.
                Instruction::Variable(Variable::Multiplier(_)) => nothing,
                instruction => program.push(instruction.map(of)),
            },
        };
        let source = jets.auxiliary(slot).map(|series| series.origin).or(jets.program.source(slot));
        if let Some(node) = source {
            program.set_source(value, node);
        }
        values[slot.index()] = value;
    }
    values
}

/// A power, counted in halves: a negative one, or one half.
fn power(program: &mut Program, x: Slot, exponent: Exponent) -> Slot {
    let halves = exponent.0.unsigned_abs();
    let mut power: Option<Slot> = None;
    let (mut square, mut left) = (x, halves / 2);
    while left > 0 {
        if left & 1 == 1 {
            power = Some(power.map_or(square, |power| program.push(Instruction::Mul(power, square))));
        }
        left >>= 1;
        if left > 0 {
            square = program.push(Instruction::Mul(square, square));
        }
    }
    if halves % 2 == 1 {
        let root = program.push(Instruction::Sqrt(x));
        power = Some(power.map_or(root, |power| program.push(Instruction::Mul(power, root))));
    }
    match power {
        Some(power) if exponent.0 < 0 => program.push(Instruction::Recip(power)),
        Some(power) => power,
        None => literal(program, Number::ONE),
    }
}

/// dy/dx of a power y and 1 / x, in the form that its recurrence uses. That of a root needs no 1 / x and gets
/// y instead.
pub(super) fn slope(program: &mut Program, exponent: Number, x: Slot, y: Slot) -> (Slot, Slot) {
    if exponent == Number::HALF {
        let half = literal(program, Number::HALF);
        (program.push(Instruction::Div(half, y)), y)
    } else if exponent == Number::MINUS_ONE {
        let square = program.push(Instruction::Mul(y, y));
        (minus(program, square), y)
    } else {
        let reciprocal = program.push(Instruction::Recip(x));
        let exponent = literal(program, exponent);
        let scaled = program.push(Instruction::Mul(exponent, y));
        (program.push(Instruction::Mul(scaled, reciprocal)), reciprocal)
    }
}

/// The values of some nodes. Functions with a series are taken from there.
pub(super) fn nodes(
    graph: &crate::expr::Graph,
    nodes: &[NodeId],
    jets: &Jets,
    values: &[Slot],
    program: &mut Program,
) -> Vec<Slot> {
    let own = plan(graph, nodes);
    let mut slots: Vec<Option<Slot>> = vec![None; own.len()];
    let mut series: Lookup<NodeId, Slot> = Lookup::default();
    jets.auxiliaries.iter().rev().for_each(|known| _ = series.insert(known.origin, known.slot));
    for slot in own.needed(&own.outputs) {
        let instruction = own.instruction(slot);
        let known = match (instruction, own.source(slot)) {
            (Instruction::Unary(..), Some(node)) => series.get(&node),
            _ => None,
        };
        let value = match known {
            Some(slot) => values[slot.index()],
            None => program.push(instruction.map(|operand| slots[operand.index()].unwrap_or(operand))),
        };
        if let Some(node) = own.source(slot) {
            program.set_source(value, node);
        }
        slots[slot.index()] = Some(value);
    }
    own.outputs.iter().filter_map(|slot| slots[slot.index()]).collect()
}
