//! The coefficient of one order as a chain of multiply–adds, earliest known terms first.

use super::bare;
use crate::jets::{Coefficient, Jets, Relation, Series};
use crate::number::Number;
use crate::schedule::{Instruction, Slot};

/// One summand of a coefficient.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub negative: bool,
    /// What the value is multiplied by; 1 if nothing.
    pub factor: Option<String>,
    pub value: Operand,
}

/// What stands in a summand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operand {
    /// The interior sum of a lane.
    Inner(usize),
    /// The same divided by the order.
    Share(usize),
    /// The coefficient of a slot.
    Slot(Slot),
}

/// What terms are made from: names of values, and which slots have names of their own.
pub(super) struct Context<'a> {
    pub jets: &'a Jets,
    /// Values at the point of expansion, by slot.
    pub start: &'a [String],
    /// Slots whose coefficients are bound to names; the others are taken apart into their operands.
    pub named: &'a [bool],
    /// Factors of power recurrences, by slot: dy/dx at the point of expansion and 1 / x.
    pub powers: &'a dyn Fn(Slot) -> PowerNames,
    /// A nonnegative number as a literal.
    pub literal: &'a dyn Fn(Number) -> String,
}

/// Local variables of a power.
#[derive(Clone, Debug, Default)]
pub(super) struct PowerNames {
    /// e y / x.
    pub slope: String,
    /// 1 / x.
    pub reciprocal: String,
}

impl Context<'_> {
    /// The terms of the coefficient of a slot, not looking at its own name.
    pub fn terms(&self, slot: Slot) -> Vec<Term> {
        let mut terms = Vec::new();
        match self.jets.auxiliary(slot) {
            Some(series) => self.relation(series, &mut terms),
            None => self.instruction(slot, false, &mut terms),
        }
        terms
    }

    /// The coefficient of a slot by its name, or by its terms where it has none.
    pub fn read(&self, slot: Slot) -> Vec<Term> {
        let mut terms = Vec::new();
        self.add(slot, false, &mut terms);
        terms
    }

    fn add(&self, slot: Slot, negative: bool, terms: &mut Vec<Term>) {
        if !self.jets.moves(slot) {
            return;
        }
        if self.named[slot.index()] {
            terms.push(Term { negative, factor: None, value: Operand::Slot(slot) });
        } else {
            self.instruction(slot, negative, terms);
        }
    }

    fn instruction(&self, slot: Slot, negative: bool, terms: &mut Vec<Term>) {
        match self.jets.program.instruction(slot) {
            Instruction::Add(a, b) => {
                self.add(a, negative, terms);
                self.add(b, negative, terms);
            }
            Instruction::Sub(a, b) => {
                self.add(a, negative, terms);
                self.add(b, !negative, terms);
            }
            Instruction::Neg(a) => self.add(a, !negative, terms),
            Instruction::Mul(a, b) => self.product(a, b, negative, terms),
            Instruction::Div(a, b) => {
                let factor = format!("Real::recip({})", self.start[b.index()]);
                terms.push(Term { negative, factor: Some(factor), value: Operand::Slot(a) });
            }
            other => unreachable!("jets: {other:?} has no series of its own"),
        }
    }

    fn product(&self, a: Slot, b: Slot, negative: bool, terms: &mut Vec<Term>) {
        let term = |factor: Slot, slot: Slot| {
            let text = (!self.jets.vanishes(factor)).then(|| self.start[factor.index()].clone())?;
            Some(Term { negative, factor: Some(text), value: Operand::Slot(slot) })
        };
        match (self.jets.moves(a), self.jets.moves(b)) {
            (true, true) => {
                let lane = self.jets.product_lane(a, b);
                terms.push(Term { negative, factor: None, value: Operand::Inner(lane) });
                if a == b {
                    let twice = format!("({0} + {0})", self.start[a.index()]);
                    terms.push(Term { negative, factor: Some(twice), value: Operand::Slot(a) });
                } else {
                    terms.extend(term(a, b));
                    terms.extend(term(b, a));
                }
            }
            (true, false) => terms.extend(term(b, a)),
            (false, true) => terms.extend(term(a, b)),
            (false, false) => {}
        }
    }

    fn relation(&self, series: &Series, terms: &mut Vec<Term>) {
        let lanes = self.jets.relation_lanes(series);
        match &series.relation {
            Relation::Flow(_) => {}
            Relation::Same(slot) => {
                terms.push(Term { negative: false, factor: None, value: Operand::Slot(*slot) });
            }
            Relation::Chain(arguments) => {
                for (&(slope, argument), lane) in arguments.iter().zip(lanes) {
                    if self.jets.moves(slope) {
                        terms.push(Term { negative: false, factor: None, value: Operand::Share(lane) });
                    }
                    let factor = Some(self.start[slope.index()].clone());
                    terms.push(Term { negative: false, factor, value: Operand::Slot(argument) });
                }
            }
            Relation::Power(base, exponent) => {
                let PowerNames { slope, reciprocal } = (self.powers)(series.slot);
                let inner = |negative, factor, lane| Term {
                    negative,
                    factor: Some(factor),
                    value: Operand::Inner(lane),
                };
                if *exponent == Number::HALF {
                    terms.push(inner(true, slope.clone(), lanes[0]));
                } else if *exponent == Number::MINUS_ONE {
                    terms.push(inner(true, reciprocal, lanes[0]));
                } else {
                    let above = *exponent + Number::ONE;
                    let scaled = |number: Number, what: &str| match number.abs() {
                        one if one.is_one() => what.to_owned(),
                        number => format!("{} * {what}", (self.literal)(number)),
                    };
                    let first = scaled(*exponent, &reciprocal);
                    terms.push(inner(exponent.is_negative(), format!("({first})"), lanes[0]));
                    let second = format!("({} / index)", scaled(above, &reciprocal));
                    terms.push(inner(!above.is_negative(), second, lanes[1]));
                }
                terms.push(Term { negative: false, factor: Some(slope), value: Operand::Slot(*base) });
            }
        }
    }

    /// When all of an operand is known.
    pub fn coefficient(&self, operand: Operand) -> Coefficient {
        match operand {
            Operand::Inner(_) | Operand::Share(_) => Coefficient::Constant,
            Operand::Slot(slot) => self.jets.coefficient(slot),
        }
    }
}

/// `start + Σ terms` as one chain, in the order of the terms; `None` for an empty sum. A term whose
/// operand has no text is 0.
pub(super) fn chain(
    start: Option<String>,
    terms: &[Term],
    text: impl Fn(Operand) -> Option<String>,
) -> Option<String> {
    let mut sum = start;
    for term in terms {
        let Some(value) = text(term.value) else { continue };
        sum = Some(match (sum, &term.factor, term.negative) {
            (None, None, false) => value,
            (None, None, true) => format!("(-{value})"),
            (None, Some(factor), false) => format!("({factor} * {value})"),
            (None, Some(factor), true) => format!("(-({factor} * {value}))"),
            (Some(sum), None, false) => format!("({sum} + {value})"),
            (Some(sum), None, true) => format!("({sum} - {value})"),
            (Some(sum), Some(factor), false) => format!("Real::mul_add({factor}, {value}, {})", bare(&sum)),
            (Some(sum), Some(factor), true) => format!("Real::mul_add(-{factor}, {value}, {})", bare(&sum)),
        });
    }
    sum
}
