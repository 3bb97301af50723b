//! The lowering of sums and products to instructions.

use super::divisors::Divisor;
use super::pairs::Item;
use super::program::{Instruction, Program, Slot};
use super::sharing::{Factor, Sharing};
use crate::collections::Lookup;
use crate::expr::{Exponent, Graph, Node, NodeId};
use crate::number::Number;

/// The program that computes the roots.
pub fn plan(graph: &Graph, roots: &[NodeId]) -> Program {
    let cone = graph.cone(roots.iter().copied());
    let mut lowering = Lowering::new(graph, &cone);
    for &id in &cone {
        // Constants, scaled nodes and products become part of what uses them. All others are values.
        if !lowering.joins_its_users(id) {
            lowering.value(id);
        }
    }
    let outputs = roots.iter().map(|&root| lowering.value(root)).collect();
    lowering.program.outputs = outputs;
    lowering.program
}

/// A summand: whether it is subtracted, and its slot.
type Signed = (bool, Slot);

struct Lowering<'g> {
    graph: &'g Graph,
    program: Program,
    values: Vec<Option<Slot>>,
    sharing: Sharing,
    item_slots: Lookup<Item, Slot>,
}

impl<'g> Lowering<'g> {
    fn new(graph: &'g Graph, cone: &[NodeId]) -> Self {
        Lowering {
            graph,
            program: Program::default(),
            values: vec![None; graph.len()],
            sharing: Sharing::of(graph, cone),
            item_slots: Lookup::default(),
        }
    }

    fn joins_its_users(&self, id: NodeId) -> bool {
        match self.graph.node(id) {
            Node::Product(_) => true,
            Node::Sum { offset, terms } => offset.is_zero() && terms.len() == 1,
            Node::Constant(_) => true,
            Node::Variable(_) | Node::Unary(..) | Node::Binary(..) => false,
        }
    }

    /// The slot that holds the value of a node.
    fn value(&mut self, id: NodeId) -> Slot {
        if let Some(slot) = self.values[id.index()] {
            return slot;
        }
        let slot = match self.graph.node(id) {
            Node::Constant(number) => self.literal(*number),
            Node::Variable(variable) => self.program.push(Instruction::Variable(*variable)),
            Node::Sum { offset, terms } => self.sum(*offset, terms),
            Node::Product(_) => self.term(id, Number::ONE),
            Node::Unary(function, argument) => {
                let argument = self.value(*argument);
                self.program.push(Instruction::Unary(*function, argument))
            }
            Node::Binary(function, first, second) => {
                let (first, second) = (self.value(*first), self.value(*second));
                self.program.push(Instruction::Binary(*function, first, second))
            }
        };
        self.values[id.index()] = Some(slot);
        self.program.set_source(slot, id);
        slot
    }

    fn literal(&mut self, number: Number) -> Slot {
        if number.is_negative() {
            let positive = self.program.push(Instruction::Literal(-number));
            return self.program.push(Instruction::Neg(positive));
        }
        self.program.push(Instruction::Literal(number))
    }

    fn sum(&mut self, offset: Number, terms: &[(NodeId, Number)]) -> Slot {
        let graph = self.graph;
        let (fixed, moving): (Vec<_>, Vec<_>) =
            terms.iter().copied().partition(|&(term, _)| graph.dependence(term).is_fixed());
        // Terms with the same multiplier share the multiplication.
        let mut groups: Vec<(Option<Slot>, Vec<Signed>)> = Vec::new();
        for (term, coefficient) in moving {
            let (multiplier, body) = self.split(term, coefficient.abs());
            let signed = (coefficient.is_negative(), body);
            match groups.iter_mut().find(|(known, _)| multiplier.is_some() && *known == multiplier) {
                Some((_, group)) => group.push(signed),
                None => groups.push((multiplier, vec![signed])),
            }
        }
        let mut summands: Vec<Signed> = Vec::with_capacity(groups.len() + 1);
        for (multiplier, group) in groups {
            match multiplier {
                None => summands.extend(group),
                Some(multiplier) => {
                    let (negative, inner) = self.accumulate(&group);
                    summands.push((negative, self.multiply(multiplier, inner)));
                }
            }
        }
        let mut constants: Vec<Signed> = Vec::new();
        for (term, coefficient) in fixed {
            constants.push((coefficient.is_negative(), self.term(term, coefficient.abs())));
        }
        if !offset.is_zero() {
            let slot = self.program.push(Instruction::Literal(offset.abs()));
            constants.push((offset.is_negative(), slot));
        }
        if !constants.is_empty() {
            summands.push(self.accumulate(&constants));
        }
        match self.accumulate(&summands) {
            (false, slot) => slot,
            (true, slot) => self.program.push(Instruction::Neg(slot)),
        }
    }

    /// The sum of signed slots as a sign and a slot. A positive one leads, if there is one.
    fn accumulate(&mut self, summands: &[Signed]) -> (bool, Slot) {
        let lead = summands.iter().position(|&(negative, _)| !negative).unwrap_or(0);
        let (flipped, mut sum) = summands[lead];
        for (index, &(negative, slot)) in summands.iter().enumerate() {
            if index != lead {
                sum = self.program.push(if negative == flipped {
                    Instruction::Add(sum, slot)
                } else {
                    Instruction::Sub(sum, slot)
                });
            }
        }
        (flipped, sum)
    }

    /// A scaled term as multiplier and body, if it has both and no divisor.
    fn split(&mut self, term: NodeId, coefficient: Number) -> (Option<Slot>, Slot) {
        if self.sharing.moving[term.index()].as_ref().is_some_and(|moving| !moving.divisor.is_empty()) {
            return (None, self.term(term, coefficient));
        }
        if self.sharing.moving[term.index()].is_some() {
            let multiplier = self.multiplier(term, coefficient);
            let body = self.numerator(term);
            return match (multiplier, body) {
                (multiplier, Some(body)) => (multiplier, body),
                (_, None) => (None, self.term(term, coefficient)),
            };
        }
        let body = self.value(term);
        if coefficient.is_one() {
            return (None, body);
        }
        (Some(self.program.push(Instruction::Literal(coefficient))), body)
    }

    /// `coefficient · term` for a coefficient above 0.
    fn term(&mut self, term: NodeId, coefficient: Number) -> Slot {
        let Node::Product(factors) = self.graph.node(term) else {
            let value = self.value(term);
            let slot = if coefficient.is_one() {
                value
            } else {
                let literal = self.program.push(Instruction::Literal(coefficient));
                self.multiply(literal, value)
            };
            return slot;
        };
        if self.graph.dependence(term).is_fixed() {
            let factors = factors.clone();
            return self.fixed_product(&factors, coefficient);
        }
        let multiplier = self.multiplier(term, coefficient);
        let numerator = self.numerator(term);
        let divisor = self.sharing.moving[term.index()]
            .as_ref()
            .map(|moving| moving.divisor.clone())
            .unwrap_or_default();
        let above = match (multiplier, numerator) {
            (Some(multiplier), Some(numerator)) => Some(self.multiply(multiplier, numerator)),
            (above, None) | (None, above) => above,
        };
        match (above, divisor.is_empty()) {
            (Some(above), true) => above,
            (above, _) => {
                let below = self.divisor(&divisor);
                let above = above.unwrap_or_else(|| self.program.push(Instruction::Literal(Number::ONE)));
                self.program.push(Instruction::Div(above, below))
            }
        }
    }

    fn multiply(&mut self, a: Slot, b: Slot) -> Slot {
        self.program.push(Instruction::Mul(a, b))
    }

    /// The fixed factors of a moving product, with its coefficient.
    fn multiplier(&mut self, product: NodeId, coefficient: Number) -> Option<Slot> {
        let graph = self.graph;
        let Node::Product(factors) = graph.node(product) else { return None };
        let fixed: Vec<_> =
            factors.iter().copied().filter(|&(f, _)| graph.dependence(f).is_fixed()).collect();
        (!fixed.is_empty() || !coefficient.is_one()).then(|| self.fixed_product(&fixed, coefficient))
    }

    fn fixed_product(&mut self, factors: &[(NodeId, Exponent)], coefficient: Number) -> Slot {
        let mut above = (!coefficient.is_one()).then(|| self.program.push(Instruction::Literal(coefficient)));
        for &(factor, exponent) in factors.iter().filter(|(_, e)| e.0 > 0) {
            let power = self.power(factor, exponent.0 as u32);
            above = Some(above.map_or(power, |above| self.multiply(above, power)));
        }
        let divisor: Divisor = factors.iter().copied().filter(|(_, e)| e.0 < 0).collect();
        if divisor.is_empty() {
            return above.unwrap_or_else(|| self.program.push(Instruction::Literal(Number::ONE)));
        }
        let below = self.divisor(&divisor);
        let above = above.unwrap_or_else(|| self.program.push(Instruction::Literal(Number::ONE)));
        self.program.push(Instruction::Div(above, below))
    }

    /// The moving factors of the numerator, if there are any.
    fn numerator(&mut self, product: NodeId) -> Option<Slot> {
        let items = self.sharing.moving[product.index()].as_ref()?.items.clone();
        (!items.is_empty()).then(|| self.multiplied(&items))
    }

    /// The product of items. A reciprocal with one use becomes a division.
    fn multiplied(&mut self, items: &[Item]) -> Slot {
        let mut product: Option<Slot> = None;
        let mut divisors: Vec<Divisor> = Vec::new();
        for &item in items {
            match self.sharing.factors.get(item as usize) {
                Some(Factor::Reciprocal(divisor)) if self.sharing.item_uses[item as usize] == 1 => {
                    divisors.push(divisor.clone());
                }
                _ => {
                    let slot = self.item(item);
                    product = Some(product.map_or(slot, |product| self.multiply(product, slot)));
                }
            }
        }
        let mut product = product.unwrap_or_else(|| self.program.push(Instruction::Literal(Number::ONE)));
        for divisor in divisors {
            let below = self.divisor(&divisor);
            product = self.program.push(Instruction::Div(product, below));
        }
        product
    }

    fn item(&mut self, item: Item) -> Slot {
        if let Some(&slot) = self.item_slots.get(&item) {
            return slot;
        }
        let count = self.sharing.factors.len();
        let slot = if item as usize >= count {
            let (a, b) = self.sharing.pairs[item as usize - count];
            self.multiplied(&[a, b])
        } else {
            match self.sharing.factors[item as usize].clone() {
                Factor::Power(node, exponent) => self.power(node, exponent.0 as u32),
                Factor::Reciprocal(divisor) => self.reciprocal(&divisor),
                Factor::BaseReciprocal(base, unit, count) => {
                    let unit = self.reciprocal(&vec![(base, Exponent(-(unit as i32)))]);
                    self.repeated(unit, count)
                }
            }
        };
        self.item_slots.insert(item, slot);
        slot
    }

    fn reciprocal(&mut self, divisor: &Divisor) -> Slot {
        let below = self.divisor(divisor);
        let one = self.program.push(Instruction::Literal(Number::ONE));
        self.program.push(Instruction::Div(one, below))
    }

    fn divisor(&mut self, divisor: &Divisor) -> Slot {
        let mut below: Option<Slot> = None;
        for &(base, exponent) in divisor {
            let power = self.power(base, exponent.0.unsigned_abs());
            below = Some(below.map_or(power, |below| self.multiply(below, power)));
        }
        below.unwrap_or_else(|| self.program.push(Instruction::Literal(Number::ONE)))
    }

    /// A positive power, counted in halves.
    fn power(&mut self, base: NodeId, halves: u32) -> Slot {
        let value = self.value(base);
        let root = (halves % 2 == 1).then(|| self.program.push(Instruction::Sqrt(value)));
        match (root, halves / 2) {
            (Some(root), 0) => root,
            (Some(root), whole) => {
                let power = self.repeated(value, whole);
                self.multiply(power, root)
            }
            (None, whole) => self.repeated(value, whole),
        }
    }

    /// `base^count` by squaring.
    fn repeated(&mut self, base: Slot, count: u32) -> Slot {
        match count {
            0 => self.program.push(Instruction::Literal(Number::ONE)),
            1 => base,
            _ => {
                let half = self.repeated(base, count / 2);
                let square = self.multiply(half, half);
                if count % 2 == 1 { self.multiply(square, base) } else { square }
            }
        }
    }
}
