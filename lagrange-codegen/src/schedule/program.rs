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

    /// The index in the program, for side tables.
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
    /// 1 / a.
    Recip(Slot),
    /// a · b + c, rounded once.
    MulAdd(Slot, Slot, Slot),
    /// A number given to one order of a Taylor series.
    Given(Given),
}

/// The numbers given to one order of a Taylor series.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Given {
    /// The unit of time divided by the order.
    Rate,
    /// The order.
    Index,
    /// The coefficient of time.
    Time,
    /// A convolution of coefficients of lower orders, by its index.
    Convolution(u32),
    /// A number that the order before has left.
    Carried(u32),
    /// The coefficient of a velocity, from the solution of the order.
    Velocity(u32),
    /// The rate times a multiplier, from the same solution.
    Impulse(u32),
    /// The multiplier.
    Multiplier(u32),
}

/// When a result is known. Each phase knows all results of those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Phase {
    /// From parameters and constants alone, once per run.
    Run,
    /// From the state.
    State,
    /// From lower orders of a series.
    Order,
    /// From the solution of an order.
    Solution,
}

impl Given {
    /// When it is given.
    fn phase(self) -> Phase {
        match self {
            Given::Rate | Given::Index | Given::Time | Given::Convolution(_) | Given::Carried(_) => {
                Phase::Order
            }
            Given::Velocity(_) | Given::Impulse(_) | Given::Multiplier(_) => Phase::Solution,
        }
    }
}

impl Instruction {
    /// Calls `visit` with every operand.
    pub fn operands(self, mut visit: impl FnMut(Slot)) {
        match self {
            Instruction::Variable(_) | Instruction::Literal(_) | Instruction::Given(_) => {}
            Instruction::Neg(a) | Instruction::Sqrt(a) | Instruction::Unary(_, a) | Instruction::Recip(a) => {
                visit(a)
            }
            Instruction::Add(a, b)
            | Instruction::Sub(a, b)
            | Instruction::Mul(a, b)
            | Instruction::Div(a, b)
            | Instruction::Binary(_, a, b) => {
                visit(a);
                visit(b);
            }
            Instruction::MulAdd(a, b, c) => {
                visit(a);
                visit(b);
                visit(c);
            }
        }
    }

    /// The same operation on other operands.
    pub fn map(self, mut of: impl FnMut(Slot) -> Slot) -> Instruction {
        match self {
            Instruction::Variable(_) | Instruction::Literal(_) | Instruction::Given(_) => self,
            Instruction::Add(a, b) => Instruction::Add(of(a), of(b)),
            Instruction::Sub(a, b) => Instruction::Sub(of(a), of(b)),
            Instruction::Mul(a, b) => Instruction::Mul(of(a), of(b)),
            Instruction::Div(a, b) => Instruction::Div(of(a), of(b)),
            Instruction::Neg(a) => Instruction::Neg(of(a)),
            Instruction::Sqrt(a) => Instruction::Sqrt(of(a)),
            Instruction::Unary(function, a) => Instruction::Unary(function, of(a)),
            Instruction::Binary(function, a, b) => Instruction::Binary(function, of(a), of(b)),
            Instruction::Recip(a) => Instruction::Recip(of(a)),
            Instruction::MulAdd(a, b, c) => Instruction::MulAdd(of(a), of(b), of(c)),
        }
    }

    /// Whether this costs no operation.
    pub fn is_leaf(self) -> bool {
        matches!(self, Instruction::Variable(_) | Instruction::Literal(_) | Instruction::Given(_))
    }
}

/// Instructions in evaluation order; operands stand before their users.
#[derive(Clone, Debug, Default)]
pub struct Program {
    instructions: Vec<Instruction>,
    phases: Vec<Phase>,
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

    /// All results, in evaluation order.
    pub fn slots(&self) -> impl Iterator<Item = Slot> + use<> {
        (0..self.len() as u32).map(Slot)
    }

    /// The results from a place on.
    pub fn slots_from(&self, place: usize) -> impl Iterator<Item = Slot> + use<> {
        (place as u32..self.len() as u32).map(Slot)
    }

    /// Whether a result depends on parameters and constants alone.
    pub fn is_fixed(&self, slot: Slot) -> bool {
        self.phase(slot) == Phase::Run
    }

    /// When a result is known.
    pub fn phase(&self, slot: Slot) -> Phase {
        self.phases[slot.index()]
    }

    /// The graph node whose value a slot holds, if there is one.
    pub fn source(&self, slot: Slot) -> Option<NodeId> {
        self.source[slot.index()]
    }

    /// Appends an instruction unless the program has an equal one, and returns its slot.
    pub fn push(&mut self, instruction: Instruction) -> Slot {
        if let Some(&slot) = self.known.get(&instruction) {
            return slot;
        }
        let mut phase = match instruction {
            Instruction::Variable(Variable::Parameter(_)) => Phase::Run,
            Instruction::Variable(_) => Phase::State,
            Instruction::Given(given) => given.phase(),
            _ => Phase::Run,
        };
        instruction.operands(|operand| phase = phase.max(self.phase(operand)));
        let slot = Slot(self.instructions.len() as u32);
        self.instructions.push(instruction);
        self.phases.push(phase);
        self.source.push(None);
        self.known.insert(instruction, slot);
        slot
    }

    /// Notes that a slot holds the value of a graph node.
    pub fn set_source(&mut self, slot: Slot, node: NodeId) {
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

    /// Fixed results that cost an operation and that moving instructions or outputs use. They are worth
    /// computing once per run.
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

    /// Results of a phase that cost an operation and that later phases or outputs use. A change of sign costs
    /// nothing.
    pub fn settled(&self, phase: Phase, outputs: &[Slot]) -> Vec<Slot> {
        let mut member = vec![false; self.len()];
        let mut note = |slot: Slot| {
            let mut slot = slot;
            while let Instruction::Neg(a) = self.instruction(slot) {
                slot = a;
            }
            member[slot.index()] |= self.phase(slot) == phase && !self.instruction(slot).is_leaf();
        };
        outputs.iter().copied().for_each(&mut note);
        for slot in self.needed(outputs) {
            if self.phase(slot) > phase {
                self.instruction(slot).operands(&mut note);
            }
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
                Instruction::Variable(_) | Instruction::Literal(_) | Instruction::Given(_) => {}
                Instruction::MulAdd(..) => {
                    operations.additions += 1;
                    operations.multiplications += 1;
                }
                Instruction::Add(..) | Instruction::Sub(..) | Instruction::Neg(_) => {
                    operations.additions += 1
                }
                Instruction::Mul(..) => operations.multiplications += 1,
                Instruction::Div(..) | Instruction::Recip(_) => operations.divisions += 1,
                Instruction::Sqrt(_) => operations.square_roots += 1,
                Instruction::Unary(Unary::Cos, a) => {
                    // One call gives the sine and the cosine of an argument.
                    let paired = self.known.contains(&Instruction::Unary(Unary::Sin, a));
                    operations.functions += u32::from(!paired);
                }
                // A comparison, which is no arithmetic of the user's equations.
                Instruction::Binary(Binary::Pivot, ..) => {}
                Instruction::Unary(..) | Instruction::Binary(..) => operations.functions += 1,
            }
        }
        operations
    }

    /// The values of the outputs in doubles.
    pub fn evaluate(&self, variable: impl Fn(Variable) -> f64) -> Vec<f64> {
        let values = self.values(variable, |_| f64::NAN);
        self.outputs.iter().map(|slot| values[slot.index()]).collect()
    }

    /// All values in doubles, by slot.
    pub fn values(&self, variable: impl Fn(Variable) -> f64, given: impl Fn(Given) -> f64) -> Vec<f64> {
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
                Instruction::Recip(a) => 1.0 / value(a),
                Instruction::MulAdd(a, b, c) => value(a).mul_add(value(b), value(c)),
                Instruction::Given(what) => given(what),
            };
            values.push(result);
        }
        values
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
