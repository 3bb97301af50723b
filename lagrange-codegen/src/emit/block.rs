//! A program as statements. A result with one use stands where it is used, and others get names.
//!
//! The text is Rust. [`super::tokens`] parses it, which for large systems is many times faster than building
//! tokens one by one in an unoptimised macro.

mod elements;
mod places;
mod reads;
mod rolled;

use super::names::{Names, describe, variable_label};
use super::scalar;
use crate::expr::{Binary, Unary, Variable};
use crate::model::Model;
use crate::schedule::{Instruction, Program, Slot};
use crate::syntax::Scalar;
pub(super) use elements::{Element, Known, Values};
use places::Places;
pub(super) use reads::Reads;
pub(super) use rolled::{Evaluation, Loops};

/// The most characters of a right-hand side. Parts of longer ones get names.
const WIDEST: usize = 84;

/// The most instructions of a program in which types are left to inference.
const UNTYPED: usize = 400;

/// The most coordinates of an array that is taken apart into named variables.
const NAMED: usize = 16;

/// Whether an array of so many coordinates is taken apart into named variables. An array that loops may run
/// over stays whole.
pub(super) fn are_named(model: &Model, count: usize) -> bool {
    count <= NAMED && count < model.locals.least
}

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

impl Text {
    fn atom(text: String) -> Text {
        Text { text, strength: Strength::Atom }
    }
}

/// The statements of one function body and the texts of its outputs.
pub(super) struct Block {
    /// `let` statements, a line each.
    pub statements: Vec<String>,
    /// Expressions for the outputs.
    pub outputs: Values,
    /// The variables that the body reads.
    pub reads: Reads,
    /// The loops of the body.
    pub loops: Loops,
}

/// Writes the part of a program that the outputs need. `given` has names for slots that are computed
/// elsewhere. New names come from `names`, so that no two are alike.
pub(super) fn write(
    model: &Model,
    scalar: &Scalar,
    program: &Program,
    outputs: &[Slot],
    given: &[Known],
    names: &mut Names,
) -> Block {
    let mut writer = Writer::new(model, scalar, program, outputs, given);
    let statements = writer.part(outputs, names);
    Block { statements, outputs: writer.values(outputs), reads: writer.reads, loops: writer.loops }
}

/// Writes a program part by part. Later parts use the names that earlier parts have bound.
pub(super) struct Writer<'a> {
    model: &'a Model,
    scalar: &'a Scalar,
    program: &'a Program,
    typed: bool,
    uses: Vec<u32>,
    is_output: Vec<bool>,
    is_bound: Vec<bool>,
    wishes: Vec<Option<String>>,
    texts: Vec<Option<Text>>,
    partner: Vec<Option<Slot>>,
    statements: Vec<String>,
    /// Declarations of arrays.
    arrays: Vec<String>,
    /// The places of values that loops may read.
    places: Places,
    /// The names that the present part assigns, if they are declared elsewhere.
    declared: Option<Vec<String>>,
    /// The variables that all parts so far read.
    pub reads: Reads,
    /// The loops of all parts so far.
    loops: Loops,
}

impl<'a> Writer<'a> {
    /// A writer for the outputs of all parts.
    pub fn new(
        model: &'a Model,
        scalar: &'a Scalar,
        program: &'a Program,
        outputs: &[Slot],
        given: &[Known],
    ) -> Self {
        let mut texts: Vec<Option<Text>> = vec![None; program.len()];
        let mut places = Places::of(model, program.len());
        for Known { slot, text, place } in given {
            texts[slot.index()] = Some(Text::atom(text.clone()));
            if let Some((element, kind)) = place {
                places.set(*slot, element, *kind);
            }
        }
        // The walk from the outputs ends at what is given.
        let mut uses = vec![0; program.len()];
        let mut is_output = vec![false; program.len()];
        for &slot in outputs {
            is_output[slot.index()] = true;
            uses[slot.index()] += 1;
        }
        let needed = reached(program, outputs, &texts);
        for &slot in &needed {
            program.instruction(slot).operands(|operand| uses[operand.index()] += 1);
        }
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
            uses,
            is_output,
            is_bound: vec![false; program.len()],
            wishes: vec![None; program.len()],
            texts,
            partner,
            statements: Vec::new(),
            arrays: Vec::new(),
            places,
            declared: None,
            reads,
            loops: Loops::default(),
        }
    }

    /// Gives each of these results a name, unless it is a variable or a constant.
    pub fn bind_always(&mut self, slots: &[Slot]) {
        slots.iter().for_each(|slot| self.is_bound[slot.index()] = true);
    }

    /// Prefers a name to the one made from the instruction.
    pub fn wish(&mut self, slot: Slot, name: impl FnOnce() -> String) {
        self.wishes[slot.index()].get_or_insert_with(name);
    }

    /// The statements that some of the outputs need and no earlier part has.
    pub fn part(&mut self, outputs: &[Slot], names: &mut Names) -> Vec<String> {
        let reached = reached(self.program, outputs, &self.texts);
        // Names that are declared elsewhere are no arrays.
        if self.declared.is_some() || !self.roll(&reached, names) {
            reached.into_iter().for_each(|slot| self.visit(slot, names));
        }
        let mut statements = std::mem::take(&mut self.arrays);
        statements.append(&mut self.statements);
        statements
    }

    /// The same as assignments, with the names that they assign.
    pub fn assigned(&mut self, outputs: &[Slot], names: &mut Names) -> (Vec<String>, Vec<String>) {
        self.declared = Some(Vec::new());
        let statements = self.part(outputs, names);
        (self.declared.take().unwrap_or_default(), statements)
    }

    /// Begins a statement that gives values to names.
    fn binding(&mut self, names: &[&str], pattern: String) -> String {
        match &mut self.declared {
            Some(declared) => {
                declared.extend(names.iter().map(|&name| name.to_owned()));
                pattern
            }
            None => format!("let {pattern}"),
        }
    }

    /// The expression of a result.
    pub fn output(&self, slot: Slot) -> String {
        self.text(slot).text
    }

    /// The expressions of results.
    pub fn outputs(&self, slots: &[Slot]) -> Vec<String> {
        slots.iter().map(|&slot| self.output(slot)).collect()
    }

    /// Results with their places.
    pub fn values(&self, slots: &[Slot]) -> Values {
        let mut values = Values::none(self.model, self.scalar);
        values.texts = self.outputs(slots);
        values.elements = slots.iter().map(|&slot| self.places.element(self.program, slot)).collect();
        values
    }

    /// Results as one array.
    pub fn list(&self, slots: &[Slot]) -> String {
        self.values(slots).list()
    }

    /// Whether a part needs a result.
    pub fn needs(&self, slot: Slot) -> bool {
        self.uses[slot.index()] > 0
    }

    /// `: type`, if types are spelled out.
    pub fn annotation(&self) -> String {
        if self.typed { format!(": {}", self.scalar) } else { String::new() }
    }

    fn text(&self, slot: Slot) -> Text {
        self.texts[slot.index()].clone().unwrap_or_else(|| Text::atom(String::new()))
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
        let mut text = self.compose(instruction, &self.operands(instruction));
        if !instruction.is_leaf() {
            let hinted = self.program.source(slot).is_some_and(|node| self.model.hints.name(node).is_some());
            let cheap = matches!(instruction, Instruction::Neg(a) if self.text(a).strength == Strength::Atom);
            let wide = text.text.len() > WIDEST && !self.is_output[slot.index()];
            if (self.uses[slot.index()] > 1 && !cheap) || hinted || wide || self.is_bound[slot.index()] {
                text = self.bind(slot, &text, names);
            }
        }
        self.texts[slot.index()] = Some(text);
    }

    fn bind(&mut self, slot: Slot, text: &Text, names: &mut Names) -> Text {
        let wish = self.wishes[slot.index()].take();
        let name = names.claim(wish.or_else(|| describe(self.model, self.program, slot, 0)));
        let annotation = if self.declared.is_some() { String::new() } else { self.annotation() };
        let to = self.binding(&[&name], format!("{name}{annotation}"));
        self.statements.push(format!("{to} = {};", text.text));
        Text::atom(name)
    }

    fn bind_sine_and_cosine(&mut self, slot: Slot, partner: Slot, argument: Slot, names: &mut Names) {
        let angle = self.text(argument).text;
        let (sine, cosine) = match self.program.instruction(slot) {
            Instruction::Unary(Unary::Sin, _) => (slot, partner),
            _ => (partner, slot),
        };
        let mut name = |slot: Slot| names.claim(describe(self.model, self.program, slot, 0));
        let (sine_name, cosine_name) = (name(sine), name(cosine));
        let to = self.binding(&[&sine_name, &cosine_name], format!("({sine_name}, {cosine_name})"));
        self.statements.push(format!("{to} = Real::sin_cos({angle});"));
        for (slot, name) in [(sine, sine_name), (cosine, cosine_name)] {
            self.texts[slot.index()] = Some(Text::atom(name));
        }
    }

    fn operands(&self, instruction: Instruction) -> Vec<Text> {
        let mut operands = Vec::new();
        instruction.operands(|slot| operands.push(self.text(slot)));
        operands
    }

    fn compose(&mut self, instruction: Instruction, operands: &[Text]) -> Text {
        let infix = |operator: &str, strength: Strength| {
            let [left, right] = [&operands[0], &operands[1]].map(Text::clone);
            let text = format!("{} {operator} {}", within(left, strength), within_right(right, strength));
            Text { text, strength }
        };
        match instruction {
            Instruction::Variable(variable) => Text::atom(self.read(variable)),
            Instruction::Literal(number) => Text::atom(scalar::literal(self.scalar, number, self.typed)),
            Instruction::Add(..) => infix("+", Strength::Sum),
            Instruction::Sub(..) => infix("-", Strength::Sum),
            Instruction::Mul(..) => infix("*", Strength::Product),
            Instruction::Div(..) => infix("/", Strength::Product),
            Instruction::Neg(_) => {
                let text = format!("-{}", within(operands[0].clone(), Strength::Atom));
                Text { text, strength: Strength::Sign }
            }
            Instruction::Sqrt(_) => call("sqrt", operands),
            Instruction::Recip(_) => call("recip", operands),
            Instruction::MulAdd(..) => call("mul_add", operands),
            // The writer has the name that was given for it.
            Instruction::Given(_) => Text::atom(String::new()),
            Instruction::Unary(function, _) => call(function.name(), operands),
            Instruction::Binary(Binary::Pivot, ..) => {
                Text::atom(format!("lagrange::solve::pivot({}, {})", operands[0].text, operands[1].text))
            }
            Instruction::Binary(function, ..) => call(function.name(), operands),
        }
    }

    fn read(&mut self, variable: Variable) -> String {
        let many = !are_named(self.model, self.model.coordinates.len());
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
                if !are_named(self.model, self.model.inputs.len()) {
                    return format!("u[{i}]");
                }
            }
            Variable::Parameter(i) => self.reads.parameters[i as usize] = true,
            Variable::Entry(i) => self.reads.entries[i as usize] = true,
            Variable::Auxiliary(_) | Variable::Multiplier(_) | Variable::Position(_) => {}
        }
        variable_label(self.model, variable)
    }
}

/// The slots that some outputs need, ascending. The walk ends at slots with a text.
fn reached(program: &Program, outputs: &[Slot], texts: &[Option<Text>]) -> Vec<Slot> {
    let mut member = vec![false; program.len()];
    let mut stack = outputs.to_vec();
    let mut needed = Vec::new();
    while let Some(slot) = stack.pop() {
        if texts[slot.index()].is_some() || std::mem::replace(&mut member[slot.index()], true) {
            continue;
        }
        needed.push(slot);
        program.instruction(slot).operands(|operand| stack.push(operand));
    }
    needed.sort_unstable();
    needed
}

fn call(function: &str, operands: &[Text]) -> Text {
    let operands: Vec<&str> = operands.iter().map(|operand| operand.text.as_str()).collect();
    Text::atom(format!("Real::{function}({})", operands.join(", ")))
}

fn within(text: Text, strength: Strength) -> String {
    if text.strength < strength { format!("({})", text.text) } else { text.text }
}

/// The right operand keeps its parentheses at equal strength: `a − (b + c)`, `a * (b * c)`.
fn within_right(text: Text, strength: Strength) -> String {
    if text.strength <= strength { format!("({})", text.text) } else { text.text }
}
