//! The coefficients of one order.
//!
//! An order starts with what lower orders determine: coordinates, then functions of them. It evaluates the
//! momenta with the new velocity coefficients at zero, solves for these coefficients, and completes what
//! depends on them.

use super::terms::{Term, chain, literal};
use super::values::slope;
use super::{Carried, Coefficient as Named, Keeps, Part};
use crate::collections::Lookup;
use crate::expr::Variable;
use crate::jets::{Coefficient, Jets, Relation};
use crate::number::Number;
use crate::schedule::{Given, Instruction, Program, Slot};

/// A number in a summand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operand {
    /// A convolution, whole or divided by the order.
    Known(Slot),
    /// The coefficient of a slot.
    Coefficient(Slot),
}

/// The source of a number that goes on to the next order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Source {
    /// A velocity, which may be in no recurrence.
    Velocity(u32),
    /// A slot.
    Slot(Slot),
}

/// The coefficients of an order, while they are planned.
pub(super) struct Order<'a> {
    pub jets: &'a Jets,
    pub program: Program,
    /// Values at the point of expansion, by slot of the recurrences.
    pub values: Vec<Slot>,
    /// Slots with a coefficient of their own. The coefficients of other slots are written in terms of those
    /// of their operands.
    pub named: Vec<bool>,
    /// Factors of power recurrences, by slot: dy/dx at the point of expansion and, except for roots, 1 / x.
    pub powers: Lookup<Slot, (Slot, Slot)>,
    coefficients: Vec<Option<Slot>>,
    /// The coefficients with the unknowns at zero; `None` for zero.
    partial: Vec<Option<Slot>>,
    /// The numbers that go on to the next order, with their sources.
    carried: Vec<(Keeps, Source)>,
    /// The index of each in that list.
    carried_at: Lookup<Source, usize>,
    /// The slots of the recurrences that read a variable.
    variables: Lookup<Variable, Slot>,
    /// The coefficients found so far, for names.
    pub found: Vec<Named>,
}

impl<'a> Order<'a> {
    pub fn new(jets: &'a Jets, mut program: Program, values: Vec<Slot>) -> Order<'a> {
        let mut powers: Lookup<Slot, (Slot, Slot)> = Lookup::default();
        for series in &jets.auxiliaries {
            if let (Relation::Power(base, exponent), true) = (&series.relation, jets.moves(series.slot)) {
                let (y, x) = (values[series.slot.index()], values[base.index()]);
                powers.insert(series.slot, slope(&mut program, *exponent, x, y));
            }
        }
        Order {
            jets,
            values,
            named: named(jets),
            powers,
            coefficients: vec![None; jets.program.len()],
            partial: vec![None; jets.program.len()],
            carried: Vec::new(),
            carried_at: Lookup::default(),
            variables: variables(jets),
            found: Vec::new(),
            program,
        }
    }

    pub fn given(&mut self, given: Given) -> Slot {
        self.program.push(Instruction::Given(given))
    }

    /// A number that the last order has left.
    pub fn carry(&mut self, keeps: Keeps, slot: Slot) -> Slot {
        let source = match self.jets.program.instruction(slot) {
            Instruction::Variable(Variable::Velocity(i)) => Source::Velocity(i),
            _ => Source::Slot(slot),
        };
        self.carry_source(keeps, source)
    }

    fn carry_source(&mut self, keeps: Keeps, source: Source) -> Slot {
        let index = self.carried_at.get(&source).copied().unwrap_or_else(|| {
            self.carried.push((keeps, source));
            self.carried_at.insert(source, self.carried.len() - 1);
            self.carried.len() - 1
        });
        self.given(Given::Carried(index as u32))
    }

    /// The coefficient of a coordinate, from that of its velocity one order below.
    pub fn coordinate(&mut self, i: usize) -> Slot {
        let last = self.carry_source(Keeps::Velocity(i), Source::Velocity(i as u32));
        let rate = self.given(Given::Rate);
        let coefficient = self.program.push(Instruction::Mul(rate, last));
        self.set(Variable::Coordinate(i as u32), coefficient);
        coefficient
    }

    /// Gives a variable its coefficient.
    pub fn set(&mut self, variable: Variable, coefficient: Slot) {
        if let Some(&slot) = self.variables.get(&variable) {
            self.coefficients[slot.index()] = Some(coefficient);
        }
    }

    /// Whether the solution of an order gives the coefficient.
    fn is_unknown(&self, slot: Slot) -> bool {
        let unknown = |variable| matches!(variable, Variable::Velocity(_) | Variable::Multiplier(_));
        matches!(self.jets.program.instruction(slot), Instruction::Variable(variable) if unknown(variable))
    }

    fn find(&mut self, slot: Slot, part: Part, of: Slot) {
        self.found.push(Named { slot, part, of });
    }

    /// Plans everything that lower orders determine.
    pub fn early(&mut self) {
        for slot in self.jets.order.clone() {
            if self.jets.coefficient(slot) != Coefficient::Early || !self.named[slot.index()] {
                continue;
            }
            let coefficient = match self.jets.program.instruction(slot) {
                Instruction::Variable(Variable::Coordinate(_)) => continue,
                Instruction::Variable(Variable::Time) => self.given(Given::Time),
                _ => match self.jets.auxiliary(slot).map(|series| series.relation.clone()) {
                    Some(Relation::Flow(rate)) => {
                        let flow = self.carry(Keeps::Flow(slot), rate);
                        let rate = self.given(Given::Rate);
                        self.program.push(Instruction::Mul(rate, flow))
                    }
                    _ => {
                        let terms = self.terms(slot);
                        self.sum(slot, None, &terms, false).unwrap_or_else(|| self.zero())
                    }
                },
            };
            self.find(coefficient, Part::Whole, slot);
            self.coefficients[slot.index()] = Some(coefficient);
        }
    }

    /// Plans the operands of momenta, reactions and conditions with the unknowns at zero.
    pub fn partially(&mut self) {
        let under = self.jets.under_balances();
        for slot in self.late().filter(|slot| under[slot.index()]).collect::<Vec<_>>() {
            let (known, unknown) = self.split(slot);
            let base = self.sum(slot, None, &known, false);
            let partial = self.sum(slot, base, &unknown, true);
            for (part, found) in [(Part::Known, base), (Part::Partial, partial)] {
                found.into_iter().for_each(|found| self.find(found, part, slot));
            }
            self.partial[slot.index()] = partial;
        }
    }

    /// Plans what depends on the unknowns.
    pub fn complete(&mut self) {
        for slot in self.late().collect::<Vec<_>>() {
            let (known, unknown) = self.split(slot);
            let base = self.sum(slot, None, &known, false);
            let coefficient = self.sum(slot, base, &unknown, false).unwrap_or_else(|| self.zero());
            self.find(coefficient, Part::Whole, slot);
            self.coefficients[slot.index()] = Some(coefficient);
        }
    }

    /// The numbers that go on to the next order, from the coefficients of all velocities.
    pub fn carried(&mut self, velocities: &[Slot]) -> Vec<Carried> {
        let all = std::mem::take(&mut self.carried);
        all.into_iter()
            .map(|(keeps, source)| {
                let (start, next) = match source {
                    Source::Slot(slot) => (self.values[slot.index()], self.coefficient(slot)),
                    Source::Velocity(i) => {
                        let velocity = Instruction::Variable(Variable::Velocity(i));
                        (self.program.push(velocity), velocities[i as usize])
                    }
                };
                Carried { keeps, start, next }
            })
            .collect()
    }

    /// The coefficient of a slot, which is made from its operands if the slot has none of its own.
    pub fn coefficient(&mut self, slot: Slot) -> Slot {
        let terms = self.read(slot);
        self.sum(slot, None, &terms, false).unwrap_or_else(|| self.zero())
    }

    /// `start` plus the coefficient of a slot with the unknowns at zero, or minus it if `negative`; `None`
    /// for zero.
    pub fn balance(&mut self, start: Option<Slot>, slot: Slot, negative: bool) -> Option<Slot> {
        let mut terms = self.read(slot);
        if negative {
            terms.iter_mut().for_each(|term| term.negative = !term.negative);
        }
        let balance = self.sum(slot, start, &terms, true);
        balance.into_iter().for_each(|balance| self.find(balance, Part::Partial, slot));
        balance
    }

    pub fn zero(&mut self) -> Slot {
        literal(&mut self.program, Number::ZERO)
    }

    /// Late slots with coefficients of their own that are not unknowns.
    fn late(&self) -> impl Iterator<Item = Slot> + '_ {
        self.jets.order.iter().copied().filter(|&slot| {
            self.jets.coefficient(slot) == Coefficient::Late
                && self.named[slot.index()]
                && !self.is_unknown(slot)
        })
    }

    fn sum(
        &mut self,
        of: Slot,
        start: Option<Slot>,
        terms: &[Term<Operand>],
        partially: bool,
    ) -> Option<Slot> {
        let value_of = |operand: Operand| match operand {
            Operand::Known(slot) => Some(slot),
            Operand::Coefficient(slot) if partially && self.jets.coefficient(slot) == Coefficient::Late => {
                self.partial[slot.index()]
            }
            Operand::Coefficient(slot) => self.coefficients[slot.index()],
        };
        let terms: Vec<Term<Slot>> = terms
            .iter()
            .filter_map(|&Term { negative, factor, value }| {
                Some(Term { negative, factor, value: value_of(value)? })
            })
            .collect();
        let known = self.program.len();
        let sum = chain(&mut self.program, start, terms);
        // Partial sums are parts of this coefficient, too.
        for slot in self.program.slots_from(known).filter(|&slot| Some(slot) != sum) {
            self.found.push(Named { slot, part: Part::Known, of });
        }
        sum
    }

    /// The terms of a late slot: those known before the solution, and the others.
    fn split(&mut self, slot: Slot) -> (Vec<Term<Operand>>, Vec<Term<Operand>>) {
        let terms = self.terms(slot);
        terms.into_iter().partition(|term| self.when(term.value) != Coefficient::Late)
    }

    /// When an operand is known.
    pub fn when(&self, operand: Operand) -> Coefficient {
        match operand {
            Operand::Known(_) => Coefficient::Constant,
            Operand::Coefficient(slot) => self.jets.coefficient(slot),
        }
    }
}

/// The slots at which recurrences read variables.
fn variables(jets: &Jets) -> Lookup<Variable, Slot> {
    let mut variables = Lookup::default();
    for &slot in &jets.order {
        if let Instruction::Variable(variable) = jets.program.instruction(slot)
            && !variables.contains(&variable)
        {
            variables.insert(variable, slot);
        }
    }
    variables
}

/// Slots with coefficients of their own.
fn named(jets: &Jets) -> Vec<bool> {
    let mut uses = vec![0_u32; jets.program.len()];
    let mut named = vec![false; jets.program.len()];
    for &slot in &jets.order {
        if !jets.moves(slot) {
            continue;
        }
        let instruction = jets.program.instruction(slot);
        if instruction.is_leaf() {
            named[slot.index()] = true;
        }
        jets.series_operands(slot, |operand| {
            uses[operand.index()] += 1;
            let multiplied = matches!(instruction, Instruction::Mul(..) | Instruction::Div(..));
            named[operand.index()] |= multiplied || jets.auxiliary(slot).is_some();
        });
    }
    for product in &jets.convolutions {
        named[product.left.slot.index()] = true;
        named[product.right.slot.index()] = true;
    }
    for slot in jets.asked().chain(jets.balances()) {
        uses[slot.index()] += 1;
    }
    for (named, uses) in named.iter_mut().zip(uses) {
        *named |= uses > 1;
    }
    named
}
