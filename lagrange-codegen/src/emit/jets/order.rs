//! The loop over the orders.
//!
//! An order starts with what lower orders determine (coordinates, then functions of them), evaluates the
//! momenta with the new velocity coefficients at zero, solves for these, and completes what depends on them.

use super::inertia::AtStart;
use super::start::Start;
use super::terms::{Context, Operand, PowerNames, Term, chain};
use super::wide::Wide;
use super::{bare, binding};
use crate::collections::Lookup;
use crate::emit::Emission;
use crate::emit::names::Names;
use crate::emit::scalar;
use crate::emit::turning;
use crate::expr::Variable;
use crate::jets::{Coefficient, Jets, Relation};
use crate::number::Number;
use crate::schedule::{Instruction, Slot};

/// Statements before the loop and the loop itself.
pub(super) fn pass(
    emission: &Emission<'_>,
    jets: &Jets,
    start: &Start<'_>,
    mass: &AtStart,
    wide: Option<&Wide>,
    names: &mut Names,
) -> String {
    let scalar = &emission.scalar;
    let literal = |number: Number| scalar::literal(scalar, number, false);
    let mut before = String::new();

    let mut powers: Lookup<Slot, PowerNames> = Lookup::default();
    for series in &jets.auxiliaries {
        let (Relation::Power(base, exponent), true) = (&series.relation, jets.moves(series.slot)) else {
            continue;
        };
        let (y, x) = (start.text(series.slot), start.text(*base));
        let label = &start.labels[series.slot.index()];
        let slope = names.claim(Some(format!("{label}_slope")));
        let mut reciprocal = String::new();
        if *exponent == Number::HALF {
            before.push_str(&binding(scalar, &slope, &format!("{} / {y}", literal(Number::HALF))));
        } else if *exponent == Number::MINUS_ONE {
            reciprocal = y.to_owned();
            before.push_str(&binding(scalar, &slope, &format!("-({y} * {y})")));
        } else {
            reciprocal = names.claim(Some(format!("{label}_divisor")));
            before.push_str(&binding(scalar, &reciprocal, &format!("Real::recip({x})")));
            let exponent = super::number(scalar, *exponent);
            before.push_str(&binding(scalar, &slope, &format!("{exponent} * {y} * {reciprocal}")));
        }
        powers.insert(series.slot, PowerNames { slope, reciprocal });
    }

    let named = named(jets);
    let power_names = |slot: Slot| powers.get(&slot).cloned().unwrap_or_default();
    let context =
        Context { jets, start: &start.texts, named: &named, powers: &power_names, literal: &literal };
    let writer = Writer {
        emission,
        jets,
        start,
        wide,
        context,
        names,
        coefficients: vec![String::new(); jets.program.len()],
        partial: vec![None; jets.program.len()],
        inner: Vec::new(),
        edges: Vec::new(),
        forces: Vec::new(),
        before,
        body: String::new(),
        after: String::new(),
    };
    writer.write(mass)
}

/// Slots whose coefficients are bound to names.
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
    for lane in &jets.lanes {
        named[lane.left.slot.index()] = true;
        named[lane.right.slot.index()] = true;
    }
    for slot in jets.carried().chain(jets.balances()) {
        uses[slot.index()] += 1;
    }
    for (named, uses) in named.iter_mut().zip(uses) {
        *named |= uses > 1;
    }
    named
}

/// The statements as they grow.
pub(super) struct Writer<'a, 'b> {
    pub(super) emission: &'a Emission<'a>,
    pub(super) jets: &'a Jets,
    pub(super) start: &'a Start<'a>,
    /// The tables, where there are many lanes.
    pub(super) wide: Option<&'a Wide>,
    pub(super) context: Context<'a>,
    pub(super) names: &'b mut Names,
    /// Names of the coefficients of the order, by slot.
    pub(super) coefficients: Vec<String>,
    /// The same with the velocities' coefficients at zero; `None` for zero.
    pub(super) partial: Vec<Option<String>>,
    /// The interior sums, by lane.
    pub(super) inner: Vec<String>,
    /// Every factor of a lane with the variables of its coefficients of the first and of the last order.
    pub(super) edges: Vec<(crate::jets::Operand, String, String)>,
    /// Variables that carry the momentum rates of the last order, by coordinate, then relaxed constraints.
    pub(super) forces: Vec<String>,
    pub(super) before: String,
    pub(super) body: String,
    /// Statements at the end of the loop.
    pub(super) after: String,
}

impl Writer<'_, '_> {
    fn write(mut self, mass: &AtStart) -> String {
        let scalar = &self.emission.scalar;
        let (count, model) = (self.emission.count(), &*self.emission.model);
        let under = self.jets.under_balances();

        let mut velocities = Vec::with_capacity(count);
        for i in 0..count {
            let (q, v) = (&model.locals.coordinates[i], &model.locals.velocities[i]);
            let coordinate = self.names.claim(Some(format!("{q}_k")));
            let velocity = self.names.claim(Some(format!("{v}_k")));
            let last = self.names.claim(Some(format!("{v}_last")));
            let value = if count > crate::emit::block::NAMED { format!("v[{i}]") } else { v.clone() };
            self.before.push_str(&format!("let mut {last}: {scalar} = {value};\n"));
            self.after.push_str(&format!("{last} = {velocity};\n"));
            self.body.push_str(&binding(scalar, &coordinate, &format!("rate * {last}")));
            let force = self.carry(self.jets.rates[i], &format!("{q}_force"));
            self.forces.push(force);
            velocities.push((coordinate, velocity));
        }
        let multipliers = self.multipliers();
        for &slot in &self.jets.order {
            if let Instruction::Variable(variable) = self.jets.program.instruction(slot) {
                match variable {
                    Variable::Coordinate(i) => {
                        self.coefficients[slot.index()] = velocities[i as usize].0.clone();
                    }
                    Variable::Velocity(i) => {
                        self.coefficients[slot.index()] = velocities[i as usize].1.clone();
                    }
                    Variable::Multiplier(i) => {
                        self.coefficients[slot.index()] = multipliers[i as usize].clone();
                    }
                    _ => {}
                }
            }
        }
        self.interiors();
        self.early();
        self.partially(&under);
        match &mass.saddle {
            Some(saddle) => self.solve_saddle(saddle, &velocities, &multipliers),
            None => self.solve(mass, &velocities),
        }
        let join = |pick: fn(&(String, String)) -> &String| {
            velocities.iter().map(|pair| pick(pair).clone()).collect::<Vec<_>>().join(", ")
        };
        self.body.push_str(&format!("series.set(order, [{}], [{}]);\n", join(|p| &p.0), join(|p| &p.1)));
        self.body.push_str("if order == orders {\nreturn false;\n}\n");
        self.late(&under);
        self.store();
        let mut fraction = format!("let rate: {scalar} = lagrange::jets::rate(h, order);\n");
        if self.body.contains("/ index)") {
            fraction.push_str(&format!("let index: {scalar} = lagrange::jets::index(order);\n"));
        }
        let inner = self.sweep();
        let walk = if self.wide.is_some() { "in_turn" } else { "in_line::<ORDERS>" };
        let last = turning::series(self.emission);
        let Self { before, body, after, .. } = self;
        format!(
            "{before}lagrange::jets::{walk}(orders, #[inline(always)] |order| {{\n{fraction}{inner}{body}{after}true\n}});\n{last}true"
        )
    }

    /// A variable that carries the coefficient of a slot to the next order.
    pub(super) fn carry(&mut self, slot: Slot, wish: &str) -> String {
        let scalar = &self.emission.scalar;
        let name = self.names.claim(Some(wish.to_owned()));
        self.before.push_str(&format!("let mut {name}: {scalar} = {};\n", self.start.text(slot)));
        name
    }

    pub(super) fn bind(&mut self, name: &str, text: &str) {
        self.body.push_str(&binding(&self.emission.scalar, name, text));
    }

    pub(super) fn zero(&self) -> String {
        scalar::zero(&self.emission.scalar)
    }

    pub(super) fn claim(&mut self, slot: Slot, suffix: &str) -> String {
        let label = &self.start.labels[slot.index()];
        let wish = if label.is_empty() { None } else { Some(format!("{label}_{suffix}")) };
        self.names.claim(wish)
    }

    /// Whether the solution of an order gives the coefficient.
    fn is_unknown(&self, slot: Slot) -> bool {
        let unknown = |variable| matches!(variable, Variable::Velocity(_) | Variable::Multiplier(_));
        matches!(self.jets.program.instruction(slot), Instruction::Variable(variable) if unknown(variable))
    }

    fn text(&self, operand: Operand) -> Option<String> {
        match operand {
            Operand::Inner(lane) => Some(self.inner[lane].clone()),
            Operand::Share(lane) => Some(format!("({} / index)", self.inner[lane])),
            Operand::Slot(slot) => Some(self.coefficients[slot.index()].clone()),
        }
    }

    pub(super) fn partial_text(&self, operand: Operand) -> Option<String> {
        match operand {
            Operand::Slot(slot) if self.jets.coefficient(slot) == Coefficient::Late => {
                self.partial[slot.index()].clone()
            }
            operand => self.text(operand),
        }
    }

    /// Terms in the order in which their operands are known.
    pub(super) fn sorted(&self, mut terms: Vec<Term>) -> Vec<Term> {
        terms.sort_by_key(|term| (self.context.coefficient(term.value), term.factor.is_some()));
        // A chain starts with a positive term where it can, which saves the change of sign.
        let earliest = terms.first().map(|term| self.context.coefficient(term.value));
        if let Some(place) = terms.iter().position(|term| !term.negative)
            && Some(self.context.coefficient(terms[place].value)) == earliest
        {
            let term = terms.remove(place);
            terms.insert(0, term);
        }
        terms
    }

    /// Everything that lower orders determine.
    fn early(&mut self) {
        let zero = self.zero();
        for slot in self.jets.order.clone() {
            if self.jets.coefficient(slot) != Coefficient::Early || !self.context.named[slot.index()] {
                continue;
            }
            let instruction = self.jets.program.instruction(slot);
            if let Instruction::Variable(Variable::Coordinate(_)) = instruction {
                continue;
            }
            let text = if let Instruction::Variable(Variable::Time) = instruction {
                format!("if order == 1 {{ h }} else {{ {zero} }}")
            } else if let Some(Relation::Flow(rate)) =
                self.jets.auxiliary(slot).map(|series| series.relation.clone())
            {
                let label = self.start.labels[slot.index()].clone();
                let flow = self.carry(rate, &format!("{label}_flow"));
                let next = self.full(rate);
                self.after.push_str(&format!("{flow} = {};\n", bare(&next)));
                format!("rate * {flow}")
            } else {
                let terms = self.sorted(self.context.terms(slot));
                chain(None, &terms, |operand| self.text(operand)).unwrap_or_else(|| zero.clone())
            };
            let name = self.claim(slot, "k");
            self.bind(&name, &text);
            self.coefficients[slot.index()] = name;
        }
    }

    /// A name for the coefficient of a late slot that is known later than where it is asked for.
    fn full(&mut self, slot: Slot) -> String {
        if !self.jets.moves(slot) {
            return self.zero();
        }
        // Resolved when the loop is complete: see `late`.
        format!("\u{1}{}\u{1}", slot.index())
    }

    /// The momenta's operands with the velocities' coefficients at zero.
    fn partially(&mut self, under: &[bool]) {
        for slot in self.jets.order.clone() {
            let late = self.jets.coefficient(slot) == Coefficient::Late;
            if !late || self.is_unknown(slot) || !under[slot.index()] || !self.context.named[slot.index()] {
                continue;
            }
            let (known, unknown) = self.split(slot);
            let mut base = chain(None, &known, |operand| self.text(operand));
            if let Some(text) = &base {
                let name = self.claim(slot, "known");
                self.bind(&name, text);
                base = Some(name);
            }
            // What the full coefficient starts from.
            self.coefficients[slot.index()] = base.clone().unwrap_or_default();
            let partial = chain(base.clone(), &unknown, |operand| self.partial_text(operand));
            self.partial[slot.index()] = match partial {
                Some(text) if Some(&text) != base.as_ref() => {
                    let name = self.claim(slot, "partial");
                    self.bind(&name, &text);
                    Some(name)
                }
                partial => partial,
            };
        }
    }

    /// The terms of a late slot that are known before the solution, and the others.
    fn split(&self, slot: Slot) -> (Vec<Term>, Vec<Term>) {
        let terms = self.sorted(self.context.terms(slot));
        terms.into_iter().partition(|term| self.context.coefficient(term.value) != Coefficient::Late)
    }

    /// What depends on the new velocity coefficients.
    fn late(&mut self, under: &[bool]) {
        for slot in self.jets.order.clone() {
            let late = self.jets.coefficient(slot) == Coefficient::Late && self.context.named[slot.index()];
            if !late || self.is_unknown(slot) {
                continue;
            }
            let (known, unknown) = self.split(slot);
            let base = if under[slot.index()] {
                Some(std::mem::take(&mut self.coefficients[slot.index()])).filter(|base| !base.is_empty())
            } else {
                chain(None, &known, |operand| self.text(operand))
            };
            let text = chain(base, &unknown, |operand| self.text(operand)).unwrap_or_else(|| self.zero());
            let name = self.claim(slot, "k");
            self.bind(&name, &text);
            self.coefficients[slot.index()] = name;
        }
        for (force, slot) in self.forces.iter().zip(self.jets.carried()) {
            let text = self.value(slot);
            self.after.push_str(&format!("{force} = {};\n", bare(&text)));
        }
        let mut after = std::mem::take(&mut self.after);
        for slot in &self.jets.order {
            let mark = format!("\u{1}{}\u{1}", slot.index());
            if after.contains(&mark) {
                after = after.replace(&mark, bare(&self.value(*slot)));
            }
        }
        self.after = after;
    }

    /// The coefficient of a slot that may have no name.
    fn value(&self, slot: Slot) -> String {
        let terms = self.sorted(self.context.read(slot));
        chain(None, &terms, |operand| self.text(operand)).unwrap_or_else(|| self.zero())
    }
}
