//! The coefficient of a slot as a sum of products with values at the point of expansion.

use super::order::{Operand, Order};
use super::terms::{Term, chain, literal};
use crate::jets::{Relation, Series};
use crate::number::Number;
use crate::schedule::{Given, Instruction, Program, Slot};

impl Order<'_> {
    /// The terms in the order in which their operands are known.
    fn sorted(&self, mut terms: Vec<Term<Operand>>) -> Vec<Term<Operand>> {
        terms.sort_by_key(|term| (self.when(term.value), term.factor.is_some()));
        // A chain starts with a positive term if one of the earliest is positive, which saves a change of
        // sign.
        let earliest = terms.first().map(|term| self.when(term.value));
        if let Some(index) = terms.iter().position(|term| !term.negative)
            && Some(self.when(terms[index].value)) == earliest
        {
            let term = terms.remove(index);
            terms.insert(0, term);
        }
        terms
    }

    /// The terms of a slot's coefficient, whether or not it has one of its own.
    pub(super) fn terms(&mut self, slot: Slot) -> Vec<Term<Operand>> {
        let mut terms = Vec::new();
        match self.jets.auxiliary(slot) {
            Some(series) => self.relation(series, &mut terms),
            None => self.instruction(slot, false, &mut terms),
        }
        self.sorted(terms)
    }

    /// The coefficient of a slot: one term if the slot has one of its own, else the terms of its instruction.
    pub(super) fn read(&mut self, slot: Slot) -> Vec<Term<Operand>> {
        let mut terms = Vec::new();
        self.add(slot, false, &mut terms);
        self.sorted(terms)
    }

    fn add(&mut self, slot: Slot, negative: bool, terms: &mut Vec<Term<Operand>>) {
        if !self.jets.moves(slot) {
            return;
        }
        if self.named[slot.index()] {
            terms.push(Term::plain(negative, Operand::Coefficient(slot)));
        } else {
            self.instruction(slot, negative, terms);
        }
    }

    fn instruction(&mut self, slot: Slot, negative: bool, terms: &mut Vec<Term<Operand>>) {
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
                let factor = self.program.push(Instruction::Recip(self.values[b.index()]));
                terms.push(Term::product(negative, factor, Operand::Coefficient(a)));
            }
            other => unreachable!("orders: {other:?} has no series of its own"),
        }
    }

    fn product(&mut self, a: Slot, b: Slot, negative: bool, terms: &mut Vec<Term<Operand>>) {
        let value = |slot: Slot| self.values[slot.index()];
        let term = |factor: Slot, slot: Slot| {
            (!self.jets.vanishes(factor))
                .then(|| Term::product(negative, value(factor), Operand::Coefficient(slot)))
        };
        match (self.jets.moves(a), self.jets.moves(b)) {
            (true, true) => {
                let (first, second) = (term(a, b), term(b, a));
                let value = value(a);
                terms.push(Term::plain(negative, self.convolution(self.jets.product_convolution(a, b))));
                if a == b {
                    let twice = self.program.push(Instruction::Add(value, value));
                    terms.push(Term::product(negative, twice, Operand::Coefficient(a)));
                } else {
                    terms.extend(first.into_iter().chain(second));
                }
            }
            (true, false) => terms.extend(term(b, a)),
            (false, true) => terms.extend(term(a, b)),
            (false, false) => {}
        }
    }

    fn convolution(&mut self, index: usize) -> Operand {
        Operand::Known(self.given(Given::Convolution(index as u32)))
    }

    fn relation(&mut self, series: &Series, terms: &mut Vec<Term<Operand>>) {
        let convolutions = self.jets.relation_convolutions(series);
        match &series.relation {
            Relation::Flow(_) => {}
            Relation::Same(slot) => terms.push(Term::plain(false, Operand::Coefficient(*slot))),
            Relation::Chain(arguments) => {
                let mut sum = None;
                for (&(slope, argument), index) in arguments.iter().zip(convolutions) {
                    if self.jets.moves(slope) {
                        let product = self.given(Given::Convolution(index as u32));
                        sum = chain(&mut self.program, sum, [Term::plain(false, product)]);
                    }
                    let slope = self.values[slope.index()];
                    terms.push(Term::product(false, slope, Operand::Coefficient(argument)));
                }
                if let Some(sum) = sum {
                    let index = self.given(Given::Index);
                    let share = self.program.push(Instruction::Div(sum, index));
                    terms.push(Term::plain(false, Operand::Known(share)));
                }
            }
            Relation::Power(base, exponent) => {
                let Some(&(slope, reciprocal)) = self.powers.get(&series.slot) else { return };
                if *exponent == Number::HALF {
                    terms.push(Term::product(true, slope, self.convolution(convolutions[0])));
                } else if *exponent == Number::MINUS_ONE {
                    terms.push(Term::product(true, reciprocal, self.convolution(convolutions[0])));
                } else {
                    let above = *exponent + Number::ONE;
                    let scaled = |program: &mut Program, number: Number| {
                        if number.abs().is_one() {
                            return reciprocal;
                        }
                        let number = literal(program, number.abs());
                        program.push(Instruction::Mul(number, reciprocal))
                    };
                    let first = scaled(&mut self.program, *exponent);
                    terms.push(Term::product(
                        exponent.is_negative(),
                        first,
                        self.convolution(convolutions[0]),
                    ));
                    let (second, index) = (scaled(&mut self.program, above), self.given(Given::Index));
                    let second = self.program.push(Instruction::Div(second, index));
                    terms.push(Term::product(
                        !above.is_negative(),
                        second,
                        self.convolution(convolutions[1]),
                    ));
                }
                terms.push(Term::product(false, slope, Operand::Coefficient(*base)));
            }
        }
    }
}
