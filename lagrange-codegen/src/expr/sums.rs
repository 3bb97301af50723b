//! Sums: linear combinations with exact coefficients.
//!
//! The nesting that the user wrote is kept: flattening would lose shared partial sums (the
//! joints of a chain) and the accuracy of `(a − b) − (c − d)`. A nested sum is opened only
//! where one of its terms then cancels or merges. Factors common to all terms are taken out,
//! and sin² + cos² of one argument is recognised wherever the two meet.

use super::graph::{Exponent, Graph, Node, NodeId};
use super::op::Unary;
use crate::number::Number;

impl Graph {
    /// `a + b`.
    pub fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.sum(Number::ZERO, &[(a, Number::ONE), (b, Number::ONE)])
    }

    /// `a − b`.
    pub fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.sum(Number::ZERO, &[(a, Number::ONE), (b, Number::MINUS_ONE)])
    }

    /// `−a`.
    pub fn neg(&mut self, a: NodeId) -> NodeId {
        self.scale(a, Number::MINUS_ONE)
    }

    /// `coefficient · a`.
    pub fn scale(&mut self, a: NodeId, coefficient: Number) -> NodeId {
        if coefficient.is_one() {
            return a;
        }
        self.sum(Number::ZERO, &[(a, coefficient)])
    }

    /// `offset + Σ coefficient · term` in normal form.
    pub fn sum(&mut self, offset: Number, terms: &[(NodeId, Number)]) -> NodeId {
        let mut combination = Combination { offset, terms: Vec::with_capacity(terms.len()) };
        for &(term, coefficient) in terms {
            self.gather(&mut combination, term, coefficient);
        }
        combination.collect();
        self.open_where_terms_meet(&mut combination);
        self.apply_pythagoras(&mut combination);
        self.finish(combination)
    }

    /// The coefficient and the node of a scaled node: `(2, x)` for `2x`, `(1, x)` for `x`.
    pub fn scaled(&self, id: NodeId) -> (Number, NodeId) {
        match self.node(id) {
            Node::Sum { offset, terms } if offset.is_zero() && terms.len() == 1 => (terms[0].1, terms[0].0),
            _ => (Number::ONE, id),
        }
    }

    fn gather(&self, combination: &mut Combination, term: NodeId, coefficient: Number) {
        match self.node(term) {
            Node::Constant(value) => combination.offset = combination.offset + coefficient * *value,
            _ => {
                let (inner, node) = self.scaled(term);
                combination.terms.push((node, coefficient * inner));
            }
        }
    }

    /// Replaces a nested sum by its terms where one of them equals another term.
    fn open_where_terms_meet(&self, combination: &mut Combination) {
        if combination.terms.len() < 2 {
            return;
        }
        let mut position = 0;
        while position < combination.terms.len() {
            let (nested, coefficient) = combination.terms[position];
            let opened = match self.node(nested) {
                Node::Sum { offset, terms } => {
                    let meets = |&(term, _): &(NodeId, Number)| {
                        combination.terms.binary_search_by_key(&term, |&(other, _)| other).is_ok()
                    };
                    terms.iter().any(meets).then(|| (*offset, terms.clone()))
                }
                _ => None,
            };
            match opened {
                Some((offset, terms)) => {
                    combination.terms.remove(position);
                    combination.offset = combination.offset + coefficient * offset;
                    combination.terms.extend(terms.iter().map(|&(term, c)| (term, c * coefficient)));
                    combination.collect();
                    position = 0;
                }
                None => position += 1,
            }
        }
    }

    /// `c P sin²x + c P cos²x → c P`, and `c P − c P sin²x → c P cos²x` with its mirror.
    fn apply_pythagoras(&mut self, combination: &mut Combination) {
        let mut position = 0;
        while position < combination.terms.len() {
            match self.pythagorean_step(combination, position) {
                Some(()) => {
                    combination.collect();
                    position = 0;
                }
                None => position += 1,
            }
        }
    }

    fn pythagorean_step(&mut self, combination: &mut Combination, position: usize) -> Option<()> {
        let (term, coefficient) = combination.terms[position];
        let factors = match self.node(term) {
            Node::Product(factors) => factors.clone(),
            _ => return None,
        };
        for (index, &(factor, exponent)) in factors.iter().enumerate() {
            let Node::Unary(function @ (Unary::Sin | Unary::Cos), argument) = *self.node(factor) else {
                continue;
            };
            if exponent.0 < 4 {
                continue;
            }
            let mut rest = factors.clone();
            rest[index].1 = Exponent(exponent.0 - 4);
            let rest = self.product(&rest);
            let other = if function == Unary::Sin { Unary::Cos } else { Unary::Sin };
            let partner = self.unary(other, argument);
            let partner = self.product(&[(rest, Exponent(2)), (partner, Exponent(4))]);
            let find = |node: NodeId| combination.terms.iter().position(|&(t, _)| t == node);
            if let Some(found) = find(partner)
                && combination.terms[found].1 == coefficient
            {
                combination.terms[position] = (rest, coefficient);
                combination.terms.remove(found);
                self.regather(combination);
                return Some(());
            }
            let whole = match self.as_constant(rest) {
                Some(value) => combination.offset == -coefficient * value,
                None => {
                    let (inner, node) = self.scaled(rest);
                    find(node).is_some_and(|found| combination.terms[found].1 == -coefficient * inner)
                }
            };
            if whole {
                combination.terms[position] = (partner, -coefficient);
                match self.as_constant(rest) {
                    Some(_) => combination.offset = Number::ZERO,
                    None => combination.terms.push((rest, coefficient)),
                }
                self.regather(combination);
                return Some(());
            }
        }
        None
    }

    /// Brings terms that are constants or scaled nodes back to the normal form.
    fn regather(&self, combination: &mut Combination) {
        let mut clean = Combination { offset: combination.offset, terms: Vec::new() };
        for &(term, coefficient) in &combination.terms {
            self.gather(&mut clean, term, coefficient);
        }
        *combination = clean;
    }

    fn finish(&mut self, mut combination: Combination) -> NodeId {
        if combination.terms.is_empty() {
            return self.constant(combination.offset);
        }
        if combination.terms.len() == 1 && combination.offset.is_zero() {
            let (term, coefficient) = combination.terms[0];
            if coefficient.is_one() {
                return term;
            }
            return self.intern(Node::Sum { offset: Number::ZERO, terms: combination.terms });
        }
        if let Some(common) = self.common_factors(&combination) {
            let mut inner = Vec::with_capacity(combination.terms.len());
            for &(term, coefficient) in &combination.terms {
                inner.push((self.without(term, &common), coefficient));
            }
            let inner = self.sum(Number::ZERO, &inner);
            let mut factors = common;
            factors.push((inner, Exponent(2)));
            return self.product(&factors);
        }
        // The leading sign becomes positive, and coefficients of one magnitude become ±1. So a − b, b − a and
        // any multiple of them share one node.
        let leading = if combination.offset.is_zero() { combination.terms[0].1 } else { combination.offset };
        let magnitude = leading.abs();
        let uniform = combination.terms.iter().all(|&(_, c)| c.abs() == magnitude);
        let content = match (uniform, leading.is_negative()) {
            (true, _) => leading,
            (false, true) => Number::MINUS_ONE,
            (false, false) => Number::ONE,
        };
        if !content.is_one()
            && let Some(inverse) = content.recip()
        {
            combination.offset = combination.offset * inverse;
            for (_, coefficient) in &mut combination.terms {
                *coefficient = *coefficient * inverse;
            }
        }
        let sum = self.intern(Node::Sum { offset: combination.offset, terms: combination.terms });
        if content.is_one() {
            return sum;
        }
        self.intern(Node::Sum { offset: Number::ZERO, terms: vec![(sum, content)] })
    }

    /// The factors that all terms share, if there is no constant part.
    fn common_factors(&self, combination: &Combination) -> Option<Vec<(NodeId, Exponent)>> {
        if !combination.offset.is_zero() || combination.terms.len() < 2 {
            return None;
        }
        let mut common = self.factors(combination.terms[0].0);
        for &(term, _) in &combination.terms[1..] {
            let shared = |factor: NodeId| match self.node(term) {
                Node::Product(factors) => {
                    factors.iter().find(|&&(f, _)| f == factor).map_or(Exponent(0), |&(_, e)| e)
                }
                _ => Exponent(if factor == term { 2 } else { 0 }),
            };
            common.retain_mut(|(factor, exponent)| {
                let other = shared(*factor);
                *exponent = match (exponent.0 > 0, other.0 > 0) {
                    (true, true) => Exponent(exponent.0.min(other.0)),
                    (false, false) if other.0 < 0 => Exponent(exponent.0.max(other.0)),
                    _ => Exponent(0),
                };
                exponent.0 != 0
            });
            if common.is_empty() {
                return None;
            }
        }
        Some(common)
    }
}

struct Combination {
    offset: Number,
    terms: Vec<(NodeId, Number)>,
}

impl Combination {
    /// Sorts the terms and adds the coefficients of equal ones.
    fn collect(&mut self) {
        self.terms.sort_unstable_by_key(|&(term, _)| term);
        self.terms.dedup_by(|later, earlier| {
            let equal = later.0 == earlier.0;
            if equal {
                earlier.1 = earlier.1 + later.1;
            }
            equal
        });
        self.terms.retain(|(_, coefficient)| !coefficient.is_zero());
    }
}

#[cfg(test)]
mod tests {
    use super::super::graph::Variable;
    use super::*;

    fn variables() -> (Graph, NodeId, NodeId, NodeId) {
        let mut g = Graph::new();
        let x = g.variable(Variable::Coordinate(0));
        let y = g.variable(Variable::Coordinate(1));
        let z = g.variable(Variable::Coordinate(2));
        (g, x, y, z)
    }

    #[test]
    fn differences_share_a_node_with_their_negative() {
        let (mut g, x, y, _) = variables();
        let d = g.sub(x, y);
        let e = g.sub(y, x);
        assert_eq!(g.scaled(e), (Number::MINUS_ONE, d));
    }

    #[test]
    fn nested_sums_stay_nested_unless_something_cancels() {
        let (mut g, x, y, z) = variables();
        let partial = g.add(x, y);
        let total = g.add(partial, z);
        assert!(matches!(g.node(total), Node::Sum { terms, .. } if terms.len() == 2));
        let back = g.sub(partial, y);
        assert_eq!(back, x);
    }

    #[test]
    fn sine_and_cosine_squares_add_to_one() {
        let (mut g, x, y, _) = variables();
        let (s, c) = (g.unary(Unary::Sin, x), g.unary(Unary::Cos, x));
        let (s2, c2) = (g.powi(s, 2), g.powi(c, 2));
        let one = g.add(s2, c2);
        assert_eq!(g.as_constant(one), Some(Number::ONE));
        let (a, b) = (g.mul(s2, y), g.mul(c2, y));
        assert_eq!(g.add(a, b), y);
        let unit = g.one();
        assert_eq!(g.sub(unit, c2), s2);
        assert_eq!(g.sub(y, a), b);
    }

    #[test]
    fn common_factors_are_taken_out() {
        let (mut g, x, y, z) = variables();
        let (xy, xz) = (g.mul(x, y), g.mul(x, z));
        let sum = g.add(xy, xz);
        let inner = g.add(y, z);
        assert_eq!(sum, g.mul(x, inner));
        let (a, b) = (g.div(y, x), g.div(z, x));
        let quotient = g.add(a, b);
        assert_eq!(quotient, g.div(inner, x));
    }

    #[test]
    fn common_factors_of_nested_products_are_taken_out() {
        let mut g = Graph::new();
        let mut product = g.one();
        for i in 0..30 {
            let x = g.variable(Variable::Coordinate(i));
            product = g.mul(product, x);
        }
        let (y, z) = (g.variable(Variable::Velocity(0)), g.variable(Variable::Velocity(1)));
        let (a, b) = (g.mul(product, y), g.mul(product, z));
        let (sum, value) = (g.add(a, b), |_| 2.0);
        assert_eq!(g.evaluate(&[sum], value), [f64::from(2_u32.pow(31)) * 2.0]);
    }

    #[test]
    fn numeric_factors_are_not_distributed() {
        let (mut g, x, _, _) = variables();
        let one = g.one();
        let shifted = g.add(x, one);
        let scaled = g.scale(shifted, Number::integer(20));
        assert_eq!(g.scaled(scaled), (Number::integer(20), shifted));
    }
}
