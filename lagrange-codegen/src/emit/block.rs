//! A program as statements: what is used once stands where it is used, the rest gets a name.
//!
//! The text is Rust; [`super::tokens`] parses it, which for large systems is many times
//! faster than building tokens one by one in an unoptimised macro.

use super::names::{Names, describe, variable_label};
use super::scalar;
use crate::expr::{Binary, Unary, Variable};
use crate::model::Model;
use crate::schedule::{Instruction, Program, Slot};
use crate::syntax::Scalar;

/// Longer right-hand sides are split by naming their parts.
const WIDEST: usize = 84;

/// Programs of more instructions spell out all types.
const UNTYPED: usize = 400;

/// Up to this many coordinates an array of them is taken apart by name.
pub(super) const NAMED: usize = 16;

/// Binding strength of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Sign,
    Atom,
}

#[derive(Clone, Debug)]
struct Text {
    text: String,
    strength: Strength,
}

/// The statements of one function body and the texts of its outputs.
pub(super) struct Block {
    /// `let` statements, a line each.
    pub statements: Vec<String>,
    /// Expressions for the outputs.
    pub outputs: Vec<String>,
    /// Which variables the body reads.
    pub reads: Reads,
}

impl Reads {
    /// Nothing is read.
    pub fn none(model: &Model) -> Reads {
        Reads {
            coordinates: vec![false; model.coordinates.len()],
            velocities: vec![false; model.coordinates.len()],
            accelerations: vec![false; model.coordinates.len()],
            inputs: vec![false; model.inputs.len()],
            entries: vec![false; 9 * model.orientations.len()],
            parameters: vec![false; model.parameters.len()],
            time: false,
        }
    }

    /// Reads what another body reads, too.
    pub fn join(&mut self, other: &Reads) {
        let join = |own: &mut Vec<bool>, other: &Vec<bool>| {
            own.iter_mut().zip(other).for_each(|(own, other)| *own |= other);
        };
        join(&mut self.coordinates, &other.coordinates);
        join(&mut self.velocities, &other.velocities);
        join(&mut self.accelerations, &other.accelerations);
        join(&mut self.inputs, &other.inputs);
        join(&mut self.entries, &other.entries);
        join(&mut self.parameters, &other.parameters);
        self.time |= other.time;
    }
}

/// The variables that a body reads.
#[derive(Clone, Debug, Default)]
pub(super) struct Reads {
    /// By coordinate.
    pub coordinates: Vec<bool>,
    /// By coordinate.
    pub velocities: Vec<bool>,
    /// By coordinate.
    pub accelerations: Vec<bool>,
    /// By input.
    pub inputs: Vec<bool>,
    /// By orientation and entry of its matrix.
    pub entries: Vec<bool>,
    /// By parameter.
    pub parameters: Vec<bool>,
    /// Time.
    pub time: bool,
}

/// Writes the part of a program that the outputs need. `given` names slots that are computed
/// elsewhere, `names` the bound results, so that no two are alike.
pub(super) fn write(
    model: &Model,
    scalar: &Scalar,
    program: &Program,
    outputs: &[Slot],
    given: &[(Slot, String)],
    names: &mut Names,
) -> Block {
    let mut writer = Writer::new(model, scalar, program, outputs, given);
    for &slot in &writer.needed.clone() {
        writer.visit(slot, names);
    }
    let outputs = outputs.iter().map(|&slot| writer.text(slot).text).collect();
    Block { statements: writer.statements, outputs, reads: writer.reads }
}

struct Writer<'a> {
    model: &'a Model,
    scalar: &'a Scalar,
    program: &'a Program,
    needed: Vec<Slot>,
    typed: bool,
    uses: Vec<u32>,
    is_output: Vec<bool>,
    texts: Vec<Option<Text>>,
    partner: Vec<Option<Slot>>,
    statements: Vec<String>,
    reads: Reads,
}

impl<'a> Writer<'a> {
    fn new(
        model: &'a Model,
        scalar: &'a Scalar,
        program: &'a Program,
        outputs: &[Slot],
        given: &[(Slot, String)],
    ) -> Self {
        let mut texts: Vec<Option<Text>> = vec![None; program.len()];
        for (slot, name) in given {
            texts[slot.index()] = Some(Text { text: name.clone(), strength: Strength::Atom });
        }
        // Walk from the outputs, but not into what is given.
        let mut member = vec![false; program.len()];
        let mut uses = vec![0; program.len()];
        let mut stack = Vec::new();
        let mut is_output = vec![false; program.len()];
        for &slot in outputs {
            is_output[slot.index()] = true;
            uses[slot.index()] += 1;
            stack.push(slot);
        }
        while let Some(slot) = stack.pop() {
            if texts[slot.index()].is_some() || std::mem::replace(&mut member[slot.index()], true) {
                continue;
            }
            program.instruction(slot).operands(|operand| {
                uses[operand.index()] += 1;
                stack.push(operand);
            });
        }
        let needed: Vec<Slot> =
            program.needed(outputs).into_iter().filter(|slot| member[slot.index()]).collect();
        let mut partner = vec![None; program.len()];
        let mut sines: Vec<(Slot, Slot, bool)> = Vec::new();
        for &slot in &needed {
            if let Instruction::Unary(function @ (Unary::Sin | Unary::Cos), argument) =
                program.instruction(slot)
            {
                let is_sine = function == Unary::Sin;
                match sines.iter().find(|&&(known, _, sine)| known == argument && sine != is_sine) {
                    Some(&(_, other, _)) => {
                        partner[slot.index()] = Some(other);
                        partner[other.index()] = Some(slot);
                    }
                    None => sines.push((argument, slot, is_sine)),
                }
            }
        }
        let reads = Reads::none(model);
        Writer {
            typed: needed.len() > UNTYPED,
            model,
            scalar,
            program,
            needed,
            uses,
            is_output,
            texts,
            partner,
            statements: Vec::new(),
            reads,
        }
    }

    fn text(&self, slot: Slot) -> Text {
        self.texts[slot.index()].clone().unwrap_or(Text { text: String::new(), strength: Strength::Atom })
    }

    fn visit(&mut self, slot: Slot, names: &mut Names) {
        if self.texts[slot.index()].is_some() {
            return;
        }
        let instruction = self.program.instruction(slot);
        if let Instruction::Unary(Unary::Sin | Unary::Cos, argument) = instruction
            && let Some(partner) = self.partner[slot.index()]
        {
            self.bind_sine_and_cosine(slot, partner, argument, names);
            return;
        }
        let mut text = self.compose(instruction);
        if !instruction.is_leaf() {
            let hinted = self.program.source(slot).is_some_and(|node| self.model.hints.name(node).is_some());
            let cheap = matches!(instruction, Instruction::Neg(a) if self.text(a).strength == Strength::Atom);
            let wide = text.text.len() > WIDEST && !self.is_output[slot.index()];
            if (self.uses[slot.index()] > 1 && !cheap) || hinted || wide {
                text = self.bind(slot, &text, names);
            }
        }
        self.texts[slot.index()] = Some(text);
    }

    fn bind(&mut self, slot: Slot, text: &Text, names: &mut Names) -> Text {
        let name = names.claim(describe(self.model, self.program, slot, 0));
        let ty = if self.typed { format!(": {}", self.scalar) } else { String::new() };
        self.statements.push(format!("let {name}{ty} = {};", text.text));
        Text { text: name, strength: Strength::Atom }
    }

    fn bind_sine_and_cosine(&mut self, slot: Slot, partner: Slot, argument: Slot, names: &mut Names) {
        let angle = self.text(argument).text;
        let (sine, cosine) = match self.program.instruction(slot) {
            Instruction::Unary(Unary::Sin, _) => (slot, partner),
            _ => (partner, slot),
        };
        let mut name = |slot: Slot| names.claim(describe(self.model, self.program, slot, 0));
        let (sine_name, cosine_name) = (name(sine), name(cosine));
        self.statements.push(format!("let ({sine_name}, {cosine_name}) = Real::sin_cos({angle});"));
        for (slot, name) in [(sine, sine_name), (cosine, cosine_name)] {
            self.texts[slot.index()] = Some(Text { text: name, strength: Strength::Atom });
        }
    }

    fn compose(&mut self, instruction: Instruction) -> Text {
        let infix = |left: Text, operator: &str, right: Text, strength: Strength| Text {
            text: format!("{} {operator} {}", within(left, strength), within_right(right, strength)),
            strength,
        };
        match instruction {
            Instruction::Variable(variable) => Text { text: self.read(variable), strength: Strength::Atom },
            Instruction::Literal(number) => {
                Text { text: scalar::literal(self.scalar, number, self.typed), strength: Strength::Atom }
            }
            Instruction::Add(a, b) => infix(self.text(a), "+", self.text(b), Strength::Sum),
            Instruction::Sub(a, b) => infix(self.text(a), "-", self.text(b), Strength::Sum),
            Instruction::Mul(a, b) => infix(self.text(a), "*", self.text(b), Strength::Product),
            Instruction::Div(a, b) => infix(self.text(a), "/", self.text(b), Strength::Product),
            Instruction::Neg(a) => {
                Text { text: format!("-{}", within(self.text(a), Strength::Atom)), strength: Strength::Sign }
            }
            Instruction::Sqrt(a) => self.call("sqrt", &[a]),
            Instruction::Unary(function, a) => self.call(function.name(), &[a]),
            Instruction::Binary(Binary::Pivot, a, b) => {
                let text = format!("lagrange::solve::pivot({}, {})", self.text(a).text, self.text(b).text);
                Text { text, strength: Strength::Atom }
            }
            Instruction::Binary(function, a, b) => self.call(function.name(), &[a, b]),
        }
    }

    fn call(&self, function: &str, arguments: &[Slot]) -> Text {
        let arguments: Vec<String> = arguments.iter().map(|&slot| self.text(slot).text).collect();
        Text { text: format!("Real::{function}({})", arguments.join(", ")), strength: Strength::Atom }
    }

    fn read(&mut self, variable: Variable) -> String {
        let many = self.model.coordinates.len() > NAMED;
        match variable {
            Variable::Coordinate(i) => {
                self.reads.coordinates[i as usize] = true;
                if many {
                    return format!("q[{i}]");
                }
            }
            Variable::Velocity(i) => {
                self.reads.velocities[i as usize] = true;
                if many {
                    return format!("v[{i}]");
                }
            }
            Variable::Acceleration(i) => {
                self.reads.accelerations[i as usize] = true;
                if many {
                    return format!("accelerations[{i}]");
                }
            }
            Variable::Time => self.reads.time = true,
            Variable::Input(i) => {
                self.reads.inputs[i as usize] = true;
                if self.model.inputs.len() > NAMED {
                    return format!("u[{i}]");
                }
            }
            Variable::Parameter(i) => self.reads.parameters[i as usize] = true,
            Variable::Entry(i) => self.reads.entries[i as usize] = true,
            Variable::Auxiliary(_) | Variable::Multiplier(_) | Variable::Position(_) | Variable::Spin(_) => {}
        }
        variable_label(self.model, variable)
    }
}

fn within(text: Text, strength: Strength) -> String {
    if text.strength < strength { format!("({})", text.text) } else { text.text }
}

/// The right operand keeps its parentheses at equal strength: `a − (b + c)`, `a * (b * c)`.
fn within_right(text: Text, strength: Strength) -> String {
    if text.strength <= strength { format!("({})", text.text) } else { text.text }
}
