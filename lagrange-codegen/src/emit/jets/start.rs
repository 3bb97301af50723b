//! Values at the point of expansion.

use super::binding;
use crate::emit::block::{NAMED, Reads};
use crate::emit::names::{Names, describe, variable_label};
use crate::emit::scalar;
use crate::expr::{Exponent, Unary, Variable};
use crate::jets::{Jets, Relation, Value};
use crate::model::Model;
use crate::schedule::{Instruction, Slot};
use crate::syntax::Scalar;

/// The texts of all values of order zero.
pub(super) struct Start<'a> {
    model: &'a Model,
    scalar: &'a Scalar,
    jets: &'a Jets,
    /// By slot; empty where no order needs the value.
    pub texts: Vec<String>,
    /// Names without the indices of arrays, for the coefficients, by slot.
    pub labels: Vec<String>,
    /// Which variables are read.
    pub reads: Reads,
    needed: Vec<bool>,
}

impl<'a> Start<'a> {
    /// With the hoisted values known by their labels.
    pub fn new(
        model: &'a Model,
        scalar: &'a Scalar,
        jets: &'a Jets,
        hoisted: &[Slot],
        labels: &[String],
    ) -> Self {
        let size = jets.program.len();
        let mut texts = vec![String::new(); size];
        for (slot, label) in hoisted.iter().zip(labels) {
            texts[slot.index()] = label.clone();
        }
        let needed = needed(jets, &texts);
        let labels = texts.clone();
        Start { model, scalar, jets, texts, labels, reads: Reads::none(model), needed }
    }

    /// The text of a value.
    pub fn text(&self, slot: Slot) -> &str {
        &self.texts[slot.index()]
    }

    /// The statements that compute all values.
    pub fn values(&mut self, names: &mut Names) -> String {
        let mut statements = String::new();
        for &slot in &self.jets.order {
            if !self.texts[slot.index()].is_empty() {
                continue;
            }
            let instruction = self.jets.program.instruction(slot);
            if instruction.is_leaf() && self.jets.auxiliary(slot).is_none() {
                if self.needed[slot.index()] || self.jets.moves(slot) {
                    self.leaf(slot, instruction);
                }
                continue;
            }
            let wish = describe(self.model, &self.jets.program, slot, 0);
            if !self.needed[slot.index()] {
                // The value is not needed, but coefficients may be.
                if self.jets.moves(slot) {
                    self.labels[slot.index()] = names.claim(wish);
                }
                continue;
            }
            let (text, partner) = self.compose(slot, instruction);
            let name = names.claim(wish);
            match partner {
                Some(partner) => {
                    let wish = describe(self.model, &self.jets.program, partner, 0);
                    let other = names.claim(wish);
                    statements.push_str(&format!("let ({name}, {other}) = {text};\n"));
                    self.texts[partner.index()] = other.clone();
                    self.labels[partner.index()] = other;
                }
                None => statements.push_str(&binding(self.scalar, &name, &text)),
            }
            self.texts[slot.index()] = name.clone();
            self.labels[slot.index()] = name;
        }
        statements
    }

    fn leaf(&mut self, slot: Slot, instruction: Instruction) {
        let (text, label) = match instruction {
            Instruction::Literal(number) => {
                (scalar::literal(self.scalar, number, false), "literal".to_owned())
            }
            Instruction::Variable(variable) => {
                let label = variable_label(self.model, variable);
                let needed = self.needed[slot.index()];
                let many = |length: usize, place: &str, i: u32| {
                    if length > NAMED { format!("{place}[{i}]") } else { label.clone() }
                };
                let text = match variable {
                    Variable::Coordinate(i) => {
                        self.reads.coordinates[i as usize] |= needed;
                        many(self.reads.coordinates.len(), "q", i)
                    }
                    Variable::Velocity(i) => {
                        self.reads.velocities[i as usize] = true;
                        many(self.reads.velocities.len(), "v", i)
                    }
                    Variable::Input(i) => {
                        self.reads.inputs[i as usize] = true;
                        many(self.reads.inputs.len(), "u", i)
                    }
                    Variable::Time => {
                        self.reads.time = true;
                        label.clone()
                    }
                    Variable::Entry(i) => {
                        self.reads.entries[i as usize] |= needed;
                        label.clone()
                    }
                    Variable::Parameter(i) => {
                        self.reads.parameters[i as usize] = true;
                        label.clone()
                    }
                    Variable::Auxiliary(_)
                    | Variable::Acceleration(_)
                    | Variable::Multiplier(_)
                    | Variable::Spin(_)
                    | Variable::Position(_) => label.clone(),
                };
                (text, label)
            }
            _ => return,
        };
        self.texts[slot.index()] = text;
        self.labels[slot.index()] = label;
    }

    /// The value of a slot, and the cosine that comes with a sine.
    fn compose(&self, slot: Slot, instruction: Instruction) -> (String, Option<Slot>) {
        if let Some(series) = self.jets.auxiliary(slot) {
            return match series.value {
                Value::Unary(function @ (Unary::Sin | Unary::Cos), x) => {
                    let partner = self.jets.auxiliaries.iter().find(|other| {
                        other.slot != slot
                            && matches!(other.value, Value::Unary(Unary::Sin | Unary::Cos, y) if y == x)
                    });
                    match partner {
                        Some(partner) if self.needed[partner.slot.index()] => {
                            let pair = format!("Real::sin_cos({})", self.text(x));
                            if function == Unary::Sin {
                                (pair, Some(partner.slot))
                            } else {
                                let pair = format!("{{ let (s, c) = {pair}; (c, s) }}");
                                (pair, Some(partner.slot))
                            }
                        }
                        _ => (format!("Real::{}({})", function.name(), self.text(x)), None),
                    }
                }
                Value::Unary(function, x) => (format!("Real::{}({})", function.name(), self.text(x)), None),
                Value::Binary(function, x, y) => {
                    (format!("Real::{}({}, {})", function.name(), self.text(x), self.text(y)), None)
                }
                Value::Power(x, exponent) => (power(self.text(x), exponent), None),
                Value::Same(x) => (self.text(x).to_owned(), None),
            };
        }
        let text = |slot: Slot| self.text(slot);
        let text = match instruction {
            Instruction::Add(a, b) => format!("{} + {}", text(a), text(b)),
            Instruction::Sub(a, b) => format!("{} - {}", text(a), text(b)),
            Instruction::Mul(a, b) => format!("{} * {}", text(a), text(b)),
            Instruction::Div(a, b) => format!("{} / {}", text(a), text(b)),
            Instruction::Neg(a) => format!("-{}", text(a)),
            Instruction::Sqrt(a) => format!("Real::sqrt({})", text(a)),
            Instruction::Unary(function, a) => format!("Real::{}({})", function.name(), text(a)),
            Instruction::Binary(function, a, b) => {
                format!("Real::{}({}, {})", function.name(), text(a), text(b))
            }
            Instruction::Variable(_) | Instruction::Literal(_) => String::new(),
        };
        (text, None)
    }
}

/// A power in halves, below zero or one half.
fn power(x: &str, exponent: Exponent) -> String {
    let halves = exponent.0.unsigned_abs();
    let whole = match halves / 2 {
        0 => None,
        1 => Some(x.to_owned()),
        count => Some(format!("Real::powi({x}, {count})")),
    };
    let root = (halves % 2 == 1).then(|| format!("Real::sqrt({x})"));
    let power = match (whole, root) {
        (Some(whole), Some(root)) => format!("{whole} * {root}"),
        (Some(one), None) | (None, Some(one)) => one,
        (None, None) => return "Real::one()".to_owned(),
    };
    if exponent.0 < 0 { format!("Real::recip({power})") } else { power }
}

/// The slots whose values the recurrences use.
fn needed(jets: &Jets, known: &[String]) -> Vec<bool> {
    let mut stack: Vec<Slot> = jets.carried().collect();
    for &slot in &jets.order {
        if !jets.moves(slot) {
            continue;
        }
        match (jets.program.instruction(slot), jets.auxiliary(slot)) {
            (_, Some(series)) => match &series.relation {
                Relation::Flow(rate) => stack.push(*rate),
                Relation::Chain(terms) => stack.extend(terms.iter().map(|&(slope, _)| slope)),
                Relation::Power(base, _) => stack.extend([slot, *base]),
                Relation::Same(_) => {}
            },
            (Instruction::Mul(a, b), None) => match (jets.moves(a), jets.moves(b)) {
                (true, true) => stack.extend([a, b].into_iter().filter(|&factor| !jets.vanishes(factor))),
                (true, false) => stack.push(b),
                (false, _) => stack.push(a),
            },
            (Instruction::Div(_, b), None) => stack.push(b),
            _ => {}
        }
    }
    let mut needed = vec![false; jets.program.len()];
    while let Some(slot) = stack.pop() {
        if std::mem::replace(&mut needed[slot.index()], true) || !known[slot.index()].is_empty() {
            continue;
        }
        match jets.auxiliary(slot).map(|series| series.value) {
            Some(Value::Unary(_, x) | Value::Power(x, _) | Value::Same(x)) => stack.push(x),
            Some(Value::Binary(_, x, y)) => stack.extend([x, y]),
            None => jets.program.instruction(slot).operands(|operand| stack.push(operand)),
        }
    }
    needed
}
