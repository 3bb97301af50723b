//! The straight-line program.

use crate::collections::Lookup;
use crate::expr::{Binary, NodeId, Unary, Variable};
use crate::number::Number;

/// The result of one instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Slot(u32);

impl Slot {
    /// The slot at a position.
    #[cfg(test)]
    pub fn of(index: usize) -> Slot {
        Slot(index as u32)
    }

    /// The position in the program, for side tables.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Instruction {
    /// Reads a variable.
    Variable(Variable),
    /// A constant.
    Literal(Number),
    /// a + b.
    Add(Slot, Slot),
    /// a − b.
    Sub(Slot, Slot),
    /// a · b.
    Mul(Slot, Slot),
    /// a / b.
    Div(Slot, Slot),
    /// −a.
    Neg(Slot),
    /// √a.
    Sqrt(Slot),
    /// A function of one argument.
    Unary(Unary, Slot),
    /// A function of two arguments.
    Binary(Binary, Slot, Slot),
}

impl Instruction {
    /// Calls `visit` with every operand.
    pub fn operands(self, mut visit: impl FnMut(Slot)) {
        match self {
            Instruction::Variable(_) | Instruction::Literal(_) => {}
            Instruction::Neg(a) | Instruction::Sqrt(a) | Instruction::Unary(_, a) => visit(a),
            Instruction::Add(a, b)
            | Instruction::Sub(a, b)
            | Instruction::Mul(a, b)
            | Instruction::Div(a, b)
            | Instruction::Binary(_, a, b) => {
                visit(a);
                visit(b);
            }
        }
    }

    /// Whether this is a variable or a constant.
    pub fn is_leaf(self) -> bool {
        matches!(self, Instruction::Variable(_) | Instruction::Literal(_))
    }
}

/// Instructions in evaluation order; operands stand before their users.
#[derive(Clone, Debug, Default)]
pub struct Program {
    instructions: Vec<Instruction>,
    fixed: Vec<bool>,
    source: Vec<Option<NodeId>>,
    known: Lookup<Instruction, Slot>,
    /// The results, in the order of the roots.
    pub outputs: Vec<Slot>,
}

impl Program {
    /// An instruction.
    pub fn instruction(&self, slot: Slot) -> Instruction {
        self.instructions[slot.index()]
    }

    /// The number of instructions.
    pub fn len(&self) -> usize {
        self.instructions.len()
    }

    /// Whether there are no instructions.
    pub fn is_empty(&self) -> bool {
        self.instructions.is_empty()
    }

    /// Whether a result depends on parameters and constants alone.
    pub fn is_fixed(&self, slot: Slot) -> bool {
        self.fixed[slot.index()]
    }

    /// The graph node whose value a slot holds, if it holds that of one.
    pub fn source(&self, slot: Slot) -> Option<NodeId> {
        self.source[slot.index()]
    }

    /// Appends an instruction, or finds the equal one.
    pub(super) fn push(&mut self, instruction: Instruction) -> Slot {
        if let Some(&slot) = self.known.get(&instruction) {
            return slot;
        }
        let mut fixed = match instruction {
            Instruction::Variable(Variable::Parameter(_)) | Instruction::Literal(_) => true,
            Instruction::Variable(_) => false,
            _ => true,
        };
        instruction.operands(|operand| fixed &= self.fixed[operand.index()]);
        let slot = Slot(self.instructions.len() as u32);
        self.instructions.push(instruction);
        self.fixed.push(fixed);
        self.source.push(None);
        self.known.insert(instruction, slot);
        slot
    }

    /// Notes that a slot holds the value of a graph node.
    pub(super) fn set_source(&mut self, slot: Slot, node: NodeId) {
        self.source[slot.index()].get_or_insert(node);
    }

    /// All slots the outputs need, ascending.
    pub fn needed(&self, outputs: &[Slot]) -> Vec<Slot> {
        let mut member = vec![false; self.len()];
        let mut stack = outputs.to_vec();
        while let Some(slot) = stack.pop() {
            if !std::mem::replace(&mut member[slot.index()], true) {
                self.instruction(slot).operands(|operand| stack.push(operand));
            }
        }
        (0..self.len() as u32).map(Slot).filter(|slot| member[slot.index()]).collect()
    }

    /// Fixed results that moving instructions or outputs use and that cost an operation:
    /// what is worth computing once per run.
    pub fn hoisted(&self) -> Vec<Slot> {
        let worthwhile = |slot: Slot| self.is_fixed(slot) && !self.instruction(slot).is_leaf();
        let mut member = vec![false; self.len()];
        for slot in self.needed(&self.outputs) {
            if !self.is_fixed(slot) {
                self.instruction(slot).operands(|operand| member[operand.index()] |= worthwhile(operand));
            }
        }
        for &slot in &self.outputs {
            member[slot.index()] |= worthwhile(slot);
        }
        (0..self.len() as u32).map(Slot).filter(|slot| member[slot.index()]).collect()
    }

    /// Operations of one evaluation; fixed ones count only if `with_fixed`.
    pub fn operations(&self, with_fixed: bool) -> Operations {
        let mut operations = Operations::default();
        for slot in self.needed(&self.outputs) {
            if self.is_fixed(slot) && !with_fixed {
                continue;
            }
            match self.instruction(slot) {
                Instruction::Variable(_) | Instruction::Literal(_) => {}
                Instruction::Add(..) | Instruction::Sub(..) | Instruction::Neg(_) => {
                    operations.additions += 1
                }
                Instruction::Mul(..) => operations.multiplications += 1,
                Instruction::Div(..) => operations.divisions += 1,
                Instruction::Sqrt(_) => operations.square_roots += 1,
                Instruction::Unary(Unary::Cos, a) => {
                    // One call gives the sine and the cosine of an argument.
                    let paired = self.known.contains(&Instruction::Unary(Unary::Sin, a));
                    operations.functions += u32::from(!paired);
                }
                // A comparison: no arithmetic of the user's.
                Instruction::Binary(Binary::Pivot, ..) => {}
                Instruction::Unary(..) | Instruction::Binary(..) => operations.functions += 1,
            }
        }
        operations
    }

    /// The values of the outputs in doubles.
    pub fn evaluate(&self, variable: impl Fn(Variable) -> f64) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::with_capacity(self.len());
        for &instruction in &self.instructions {
            let value = |slot: Slot| values[slot.index()];
            let result = match instruction {
                Instruction::Variable(v) => variable(v),
                Instruction::Literal(number) => number.value(),
                Instruction::Add(a, b) => value(a) + value(b),
                Instruction::Sub(a, b) => value(a) - value(b),
                Instruction::Mul(a, b) => value(a) * value(b),
                Instruction::Div(a, b) => value(a) / value(b),
                Instruction::Neg(a) => -value(a),
                Instruction::Sqrt(a) => value(a).sqrt(),
                Instruction::Unary(function, a) => function.evaluate(value(a)),
                Instruction::Binary(function, a, b) => function.evaluate(value(a), value(b)),
            };
            values.push(result);
        }
        self.outputs.iter().map(|slot| values[slot.index()]).collect()
    }
}

/// Operation counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Additions, subtractions and changes of sign.
    pub additions: u32,
    /// Multiplications.
    pub multiplications: u32,
    /// Divisions.
    pub divisions: u32,
    /// Square roots.
    pub square_roots: u32,
    /// Calls of elementary functions, a sine with its cosine as one.
    pub functions: u32,
}
