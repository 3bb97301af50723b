//! When each coefficient of an order is known, and which convolutions there are.

use super::Counts;
use super::auxiliary::{Auxiliary, Relation, Value};
use super::followed::Along;
use crate::collections::Lookup;
use crate::expr::{NodeId, Variable};
use crate::schedule::{Instruction, Program, Slot};

/// When the coefficient of order k of a slot is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Coefficient {
    /// There is none: the value is constant during a step, or no recurrence uses it.
    Constant,
    /// From coefficients of lower orders alone.
    Early,
    /// With the velocities and multipliers of order k.
    Late,
}

/// One factor of a convolution: the coefficients x\[j], or with `ramp` j x\[j].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Operand {
    /// The slot with the coefficients.
    pub slot: Slot,
    /// Whether each is multiplied by its order.
    pub ramp: bool,
}

/// A convolution Σ left\[j] right\[k − j]. Its terms with 0 < j < k are summed for all convolutions at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Convolution {
    /// First factor.
    pub left: Operand,
    /// Second factor.
    pub right: Operand,
}

impl Convolution {
    fn of(a: Slot, b: Slot) -> Convolution {
        Convolution { left: Operand { slot: a, ramp: false }, right: Operand { slot: b, ramp: false } }
    }

    fn ramped(a: Slot, b: Slot) -> Convolution {
        Convolution { left: Operand { slot: a, ramp: true }, right: Operand { slot: b, ramp: false } }
    }
}

/// An auxiliary in the program.
#[derive(Clone, Debug)]
pub struct Series {
    /// The node that it stands for.
    pub origin: NodeId,
    /// Its slot.
    pub slot: Slot,
    /// Its value at the point of expansion.
    pub value: Value<Slot>,
    /// Its recurrence.
    pub relation: Relation<Slot>,
}

/// The recurrences of a system.
#[derive(Clone, Debug)]
pub struct Jets {
    /// The polynomial part; auxiliaries are variables of it.
    pub program: Program,
    /// Momenta.
    pub momenta: Vec<Slot>,
    /// The rates of the momenta.
    pub rates: Vec<Slot>,
    /// Reactions Aᵀμ, one for each coordinate of a constrained system.
    pub reactions: Vec<Slot>,
    /// The constraints at the level of velocities.
    pub conditions: Vec<Slot>,
    /// The gradients of `conditions` by the velocities at the point of expansion, a row each.
    pub gradients: Vec<Vec<NodeId>>,
    /// The rates that Baumgarte's stabilisation gives `conditions`; empty without it.
    pub relaxation: Vec<Slot>,
    /// The functions of the state that are followed along the motion.
    pub followed: Vec<Slot>,
    /// How each function that may be followed is known along the motion.
    pub along: Vec<Along>,
    /// Auxiliaries that the program reads.
    pub auxiliaries: Vec<Series>,
    /// The auxiliary that a slot reads.
    auxiliary_at: Lookup<Slot, usize>,
    /// All convolutions.
    pub convolutions: Vec<Convolution>,
    index_of: Lookup<Convolution, usize>,
    coefficients: Vec<Coefficient>,
    /// Whether each slot is zero at every point of expansion, as multipliers and products with them are.
    vanishing: Vec<bool>,
    /// All slots, operands first.
    pub order: Vec<Slot>,
}

impl Jets {
    /// Sorts a program. Its outputs are momenta and their rates, what constraints add, the functions that are
    /// followed, and the operands of the auxiliaries.
    pub(super) fn of(program: Program, auxiliaries: Vec<Auxiliary>, counts: Counts) -> Jets {
        let mut outputs = program.outputs.clone().into_iter();
        let mut next = || outputs.next().expect("jets: as many slots as nodes");
        let mut take = |count: usize| -> Vec<Slot> { (0..count).map(|_| next()).collect() };
        let Counts { coordinates, constraints, relaxed, followed } = counts;
        let (momenta, rates) = (take(coordinates), take(coordinates));
        let reactions = take(if constraints > 0 { coordinates } else { 0 });
        let conditions = take(constraints);
        let relaxation = take(if relaxed { constraints } else { 0 });
        let followed = take(followed);
        let mut variables: Vec<Option<Slot>> = vec![None; auxiliaries.len()];
        for slot in program.needed(&program.outputs) {
            if let Instruction::Variable(Variable::Auxiliary(index)) = program.instruction(slot) {
                variables[index as usize] = Some(slot);
            }
        }
        let mut series = Vec::with_capacity(auxiliaries.len());
        let mut auxiliary_at = Lookup::default();
        for (auxiliary, slot) in auxiliaries.into_iter().zip(variables) {
            let relation = match auxiliary.relation {
                Relation::Flow(_) => Relation::Flow(next()),
                Relation::Chain(terms) => Relation::Chain(terms.iter().map(|_| (next(), next())).collect()),
                Relation::Power(_, exponent) => Relation::Power(next(), exponent),
                Relation::Same(_) => Relation::Same(next()),
            };
            let value = match auxiliary.value {
                Value::Unary(function, _) => Value::Unary(function, next()),
                Value::Binary(function, ..) => Value::Binary(function, next(), next()),
                Value::Power(_, exponent) => Value::Power(next(), exponent),
                Value::Same(_) => Value::Same(next()),
            };
            if let Some(slot) = slot {
                auxiliary_at.insert(slot, series.len());
                series.push(Series { origin: auxiliary.origin, slot, value, relation });
            }
        }
        let mut jets = Jets {
            coefficients: vec![Coefficient::Constant; program.len()],
            vanishing: vec![false; program.len()],
            order: Vec::new(),
            program,
            momenta,
            rates,
            reactions,
            conditions,
            gradients: Vec::new(),
            relaxation,
            followed,
            along: Vec::new(),
            auxiliaries: series,
            auxiliary_at,
            convolutions: Vec::new(),
            index_of: Lookup::default(),
        };
        jets.sort();
        jets.classify();
        jets.find_vanishing();
        jets.find_lanes();
        jets
    }

    /// When the coefficients of a slot are known.
    pub fn coefficient(&self, slot: Slot) -> Coefficient {
        self.coefficients[slot.index()]
    }

    /// Whether a slot changes during a step and a recurrence uses it.
    pub fn moves(&self, slot: Slot) -> bool {
        self.coefficient(slot) != Coefficient::Constant
    }

    /// Whether the value of a slot is zero at every point of expansion.
    pub fn vanishes(&self, slot: Slot) -> bool {
        self.vanishing[slot.index()]
    }

    /// The slots that are evaluated before the velocities of an order are known.
    pub fn balances(&self) -> impl Iterator<Item = Slot> + '_ {
        self.momenta.iter().chain(&self.reactions).chain(&self.conditions).copied()
    }

    /// The slots whose coefficients the next order starts from, and those that are followed.
    pub fn asked(&self) -> impl Iterator<Item = Slot> + '_ {
        self.rates.iter().chain(&self.relaxation).chain(&self.followed).copied()
    }

    /// The auxiliary at a slot.
    pub fn auxiliary(&self, slot: Slot) -> Option<&Series> {
        self.auxiliary_at.get(&slot).map(|&index| &self.auxiliaries[index])
    }

    /// The index of the convolution of two moving slots.
    pub fn product_convolution(&self, a: Slot, b: Slot) -> usize {
        self.index(Convolution::of(a, b))
    }

    /// The indices of a relation's convolutions, in the order of its recurrence.
    pub fn relation_convolutions(&self, series: &Series) -> Vec<usize> {
        relation_convolutions(series).into_iter().map(|product| self.index(product)).collect()
    }

    fn index(&self, product: Convolution) -> usize {
        self.index_of.get(&product).copied().expect("jets: every product of a recurrence is listed")
    }

    /// A line for the report.
    pub fn describe(&self) -> String {
        let named = |series: &&Series| !matches!(series.relation, Relation::Same(_));
        let functions =
            self.auxiliaries.iter().filter(named).filter(|series| self.moves(series.slot)).count();
        let count = |count: usize, what: &str| match count {
            0 => format!("no {what}s"),
            1 => format!("1 {what}"),
            count => format!("{count} {what}s"),
        };
        let (products, functions) =
            (count(self.convolutions.len(), "convolution"), count(functions, "function"));
        format!(
            "smooth: a Taylor series of the motion takes {products} and the recurrences of {functions} an order"
        )
    }

    /// Whether the velocities alone give every momentum.
    pub fn is_momentum_linear(&self) -> bool {
        let mut linear = true;
        let mut stack = self.momenta.clone();
        while let Some(slot) = stack.pop() {
            if !self.moves(slot) {
                continue;
            }
            match self.program.instruction(slot) {
                Instruction::Variable(Variable::Velocity(_)) => {}
                Instruction::Add(a, b) | Instruction::Sub(a, b) => stack.extend([a, b]),
                Instruction::Neg(a) => stack.push(a),
                Instruction::Mul(a, b) if !(self.moves(a) && self.moves(b)) => stack.extend([a, b]),
                _ => linear = false,
            }
        }
        linear
    }

    /// A measure of the work of one order.
    pub(super) fn cost(&self) -> usize {
        /// That of a convolution: a share of the sweep, two terms outside it, and two stores of operands.
        const CONVOLUTION: usize = 6;
        let is_name = |slot: Slot| {
            matches!(self.auxiliary(slot).map(|series| &series.relation), Some(Relation::Same(_)))
        };
        let moving = self.order.iter().filter(|&&slot| self.moves(slot) && !is_name(slot)).count();
        CONVOLUTION * self.convolutions.len() + moving
    }

    /// Late slots that momenta, reactions and conditions need. All but unknowns are evaluated twice an order.
    pub fn under_balances(&self) -> Vec<bool> {
        let mut under = vec![false; self.program.len()];
        let mut stack: Vec<Slot> = self.balances().collect();
        while let Some(slot) = stack.pop() {
            if self.coefficient(slot) == Coefficient::Late
                && !std::mem::replace(&mut under[slot.index()], true)
            {
                self.series_operands(slot, |operand| stack.push(operand));
            }
        }
        under
    }

    /// Calls `visit` with the slots whose coefficients of the same order a slot is made from.
    pub fn series_operands(&self, slot: Slot, mut visit: impl FnMut(Slot)) {
        match self.auxiliary(slot).map(|series| &series.relation) {
            None => self.program.instruction(slot).operands(visit),
            Some(Relation::Flow(_)) => {}
            Some(Relation::Chain(terms)) => terms.iter().for_each(|&(_, argument)| visit(argument)),
            Some(Relation::Power(base, _) | Relation::Same(base)) => visit(*base),
        }
    }

    /// Sorts the slots so that each comes after those that it needs, at order zero and at any other.
    fn sort(&mut self) {
        let mut placed = vec![false; self.program.len()];
        let mut order = Vec::with_capacity(self.program.len());
        let roots = self.program.needed(&self.program.outputs);
        for root in roots {
            let mut stack = vec![(root, false)];
            while let Some((slot, ready)) = stack.pop() {
                if placed[slot.index()] {
                    continue;
                }
                if ready {
                    placed[slot.index()] = true;
                    order.push(slot);
                    continue;
                }
                stack.push((slot, true));
                let mut operands = Vec::new();
                self.series_operands(slot, |operand| operands.push(operand));
                if let Some(series) = self.auxiliary(slot) {
                    match series.value {
                        Value::Unary(_, x) | Value::Power(x, _) | Value::Same(x) => operands.push(x),
                        Value::Binary(_, x, y) => operands.extend([x, y]),
                    }
                }
                stack.extend(operands.into_iter().rev().map(|operand| (operand, false)));
            }
        }
        self.order = order;
    }

    fn classify(&mut self) {
        let mut classes = vec![Coefficient::Constant; self.program.len()];
        for &slot in &self.order {
            let mut class = match self.program.instruction(slot) {
                Instruction::Variable(Variable::Velocity(_) | Variable::Multiplier(_)) => Coefficient::Late,
                Instruction::Variable(Variable::Coordinate(_) | Variable::Time | Variable::Auxiliary(_)) => {
                    Coefficient::Early
                }
                _ => Coefficient::Constant,
            };
            self.series_operands(slot, |operand| class = class.max(classes[operand.index()]));
            classes[slot.index()] = class;
        }
        // A slot that no recurrence uses has a value but no series.
        let mut asked = vec![false; self.program.len()];
        let mut stack: Vec<Slot> = self.balances().chain(self.asked()).collect();
        while let Some(slot) = stack.pop() {
            if classes[slot.index()] == Coefficient::Constant
                || std::mem::replace(&mut asked[slot.index()], true)
            {
                continue;
            }
            self.series_operands(slot, |operand| stack.push(operand));
            match self.auxiliary(slot).map(|series| &series.relation) {
                Some(Relation::Flow(rate)) => stack.push(*rate),
                Some(Relation::Chain(terms)) => stack.extend(terms.iter().map(|&(slope, _)| slope)),
                Some(Relation::Power(..) | Relation::Same(_)) | None => {}
            }
        }
        for (class, asked) in classes.iter_mut().zip(asked) {
            if !asked {
                *class = Coefficient::Constant;
            }
        }
        self.coefficients = classes;
    }

    fn find_vanishing(&mut self) {
        for &slot in &self.order {
            let zero = |slot: Slot| self.vanishing[slot.index()];
            self.vanishing[slot.index()] = match self.auxiliary(slot).map(|series| &series.relation) {
                Some(Relation::Same(same)) => zero(*same),
                Some(_) => false,
                None => match self.program.instruction(slot) {
                    Instruction::Variable(Variable::Multiplier(_)) => true,
                    Instruction::Mul(a, b) => zero(a) || zero(b),
                    Instruction::Add(a, b) | Instruction::Sub(a, b) => zero(a) && zero(b),
                    Instruction::Neg(a) | Instruction::Div(a, _) => zero(a),
                    _ => false,
                },
            };
        }
    }

    fn find_lanes(&mut self) {
        for slot in self.order.clone() {
            if !self.moves(slot) {
                continue;
            }
            let convolutions = match (self.program.instruction(slot), self.auxiliary(slot)) {
                (_, Some(series)) => relation_convolutions(series),
                (Instruction::Mul(a, b), None) if self.moves(a) && self.moves(b) => {
                    vec![Convolution::of(a, b)]
                }
                _ => Vec::new(),
            };
            for convolution in convolutions {
                if self.index_of.get(&convolution).is_none() {
                    self.index_of.insert(convolution, self.convolutions.len());
                    self.convolutions.push(convolution);
                }
            }
        }
    }
}

/// A power y = x^e has x y and, unless e = −1, x · j y\[j]; a root has y y; a chain has one an argument.
fn relation_convolutions(series: &Series) -> Vec<Convolution> {
    let y = series.slot;
    match &series.relation {
        Relation::Flow(_) | Relation::Same(_) => Vec::new(),
        Relation::Chain(terms) => terms.iter().map(|&(slope, x)| Convolution::ramped(x, slope)).collect(),
        Relation::Power(_, exponent) if *exponent == crate::number::Number::HALF => {
            vec![Convolution::of(y, y)]
        }
        Relation::Power(x, exponent) if *exponent == crate::number::Number::MINUS_ONE => {
            vec![Convolution::of(y, *x)]
        }
        Relation::Power(x, _) => vec![Convolution::of(y, *x), Convolution::ramped(y, *x)],
    }
}
