//! Products: flat lists of factors with whole or half exponents.
//!
//! Flattening is harmless (relative errors of products add up in any order) and lets equal
//! factors meet: `r³ = s^(3/2)` for `r = √s`, `x/x = 1`. Of numbers only irrational roots such as `√2` stand
//! in a product. Others move to the sum that holds it, so `2x` and `3x` share `x`.

use super::graph::{Exponent, Graph, Node, NodeId};
use super::op::Unary;
use crate::number::Number;

/// The most factors of a flat product. Longer ones are nested, since the gradient of a flat product of n
/// factors costs n² and that of nested ones n.
const LONGEST_FLAT: usize = 12;

impl Graph {
    /// `a · b`.
    pub fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.product(&[(a, Exponent(2)), (b, Exponent(2))])
    }

    /// `a / b`. A zero constant divisor gives the quotient of doubles, ±∞ or NaN.
    pub fn div(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.product(&[(a, Exponent(2)), (b, Exponent(-2))])
    }

    /// `base` to a whole power.
    pub fn powi(&mut self, base: NodeId, power: i32) -> NodeId {
        self.product(&[(base, Exponent::whole(power))])
    }

    /// The square root.
    pub fn sqrt(&mut self, base: NodeId) -> NodeId {
        self.product(&[(base, Exponent(1))])
    }

    /// `Π factor ^ exponent` in normal form.
    pub fn product(&mut self, factors: &[(NodeId, Exponent)]) -> NodeId {
        let mut flat = Flat { coefficient: Number::ONE, factors: Vec::with_capacity(factors.len() + 2) };
        for &(factor, exponent) in factors {
            self.absorb(&mut flat, factor, exponent);
        }
        self.collect(&mut flat);
        self.swap(&mut flat, Form::Bounded);
        self.divide_exponentials(&mut flat);
        if flat.coefficient.is_zero() {
            return self.zero();
        }
        if flat.factors.len() > LONGEST_FLAT {
            return self.nested(factors);
        }
        let product = match flat.factors.as_slice() {
            [] => return self.constant(flat.coefficient),
            [(factor, Exponent(2))] => *factor,
            _ => self.intern(Node::Product(flat.factors)),
        };
        self.scale(product, flat.coefficient)
    }

    /// The factors of a node as a product. Any other node is its own single factor.
    pub fn factors(&self, id: NodeId) -> Vec<(NodeId, Exponent)> {
        match self.node(id) {
            Node::Product(factors) => factors.clone(),
            _ => vec![(id, Exponent(2))],
        }
    }

    /// A node with the exponents of some factors lowered. A product with their reciprocals would not do: it
    /// opens factors that are products themselves, and it leaves a quotient of equals, which is no number
    /// where they vanish.
    pub fn without(&mut self, id: NodeId, taken: &[(NodeId, Exponent)]) -> NodeId {
        let mut factors = self.factors(id);
        for &(factor, power) in taken {
            let own = factors.iter_mut().find(|(own, _)| *own == factor);
            if let Some((_, exponent)) = own {
                exponent.0 -= power.0;
            }
        }
        self.product(&factors)
    }

    fn absorb(&mut self, flat: &mut Flat, factor: NodeId, exponent: Exponent) {
        if exponent.0 == 0 {
            return;
        }
        match self.node(factor) {
            Node::Constant(value) => {
                let value = *value;
                let power = match exponent.as_integer() {
                    Some(power) => value.powi(power),
                    None => value.exact_sqrt().and_then(|root| root.powi(exponent.0)),
                };
                match (power, exponent.as_integer()) {
                    (Some(power), _) => flat.coefficient = flat.coefficient * power,
                    (None, Some(_)) => {
                        // A negative power of zero is what doubles make of it.
                        flat.coefficient = flat.coefficient * Number::Float(f64::INFINITY, 0.0);
                    }
                    (None, None) => flat.factors.push((factor, exponent)),
                }
            }
            Node::Sum { offset, terms } if offset.is_zero() && terms.len() == 1 => {
                let (inner, coefficient) = terms[0];
                match exponent.as_integer().and_then(|power| coefficient.powi(power)) {
                    Some(power) => {
                        flat.coefficient = flat.coefficient * power;
                        self.absorb(flat, inner, exponent);
                    }
                    None => flat.factors.push((factor, exponent)),
                }
            }
            Node::Product(inner) => match exponent.as_integer() {
                // (x²)^½ is |x|, so only whole powers move inside.
                Some(power) => {
                    flat.factors.extend(inner.iter().map(|&(f, e)| (f, Exponent(e.0 * power))));
                }
                None => flat.factors.push((factor, exponent)),
            },
            Node::Variable(_) | Node::Sum { .. } | Node::Unary(..) | Node::Binary(..) => {
                flat.factors.push((factor, exponent));
            }
        }
    }

    /// Replaces powers of functions that grow by powers of their reciprocals, or the other way round. While
    /// factors are collected, all are powers of those that grow, so that equal ones meet. Afterwards negative
    /// ones become powers of the reciprocal, which does not overflow, and whose derivatives do not either.
    fn swap(&mut self, flat: &mut Flat, to: Form) {
        let mut swapped = false;
        for (factor, exponent) in &mut flat.factors {
            if (to == Form::Growing || exponent.0 < 0)
                && let Some(reciprocal) = self.reciprocal(*factor, to)
            {
                (*factor, exponent.0) = (reciprocal, -exponent.0);
                swapped = true;
            }
        }
        if swapped {
            flat.collect();
        }
    }

    /// The reciprocal of a function that grows like eˣ, or of one that it is the reciprocal of.
    fn reciprocal(&mut self, factor: NodeId, to: Form) -> Option<NodeId> {
        match (to, self.node(factor)) {
            (Form::Bounded, &Node::Unary(Unary::Cosh, x)) => Some(self.unary(Unary::Sech, x)),
            (Form::Growing, &Node::Unary(Unary::Sech, x)) => Some(self.unary(Unary::Cosh, x)),
            (Form::Bounded, Node::Sum { offset, terms }) => match terms[..] {
                [(term, coefficient)] if offset.is_one() && coefficient.is_one() => {
                    let Node::Unary(Unary::Exp, x) = *self.node(term) else { return None };
                    let opposite = self.neg(x);
                    Some(self.unary(Unary::Logistic, opposite))
                }
                _ => None,
            },
            (Form::Growing, &Node::Unary(Unary::Logistic, x)) => {
                let opposite = self.neg(x);
                let exponential = self.unary(Unary::Exp, opposite);
                Some(self.sum(Number::ONE, &[(exponential, Number::ONE)]))
            }
            _ => None,
        }
    }

    /// eˣ/(1 + eˣ) is the logistic function of x, where the product of eˣ with that of −x may be ∞ · 0.
    fn divide_exponentials(&mut self, flat: &mut Flat) {
        let mut divided = false;
        for index in 0..flat.factors.len() {
            let (factor, own) = flat.factors[index];
            let Node::Unary(Unary::Logistic, opposite) = *self.node(factor) else { continue };
            let x = self.neg(opposite);
            let exponential = self.unary(Unary::Exp, x);
            let numerator =
                flat.factors.iter().position(|&(other, power)| other == exponential && power.0 > 0);
            if let Some(numerator) = numerator {
                let shared = own.0.min(flat.factors[numerator].1.0);
                let logistic = self.unary(Unary::Logistic, x);
                flat.factors[index].1.0 -= shared;
                flat.factors[numerator].1.0 -= shared;
                flat.factors.push((logistic, Exponent(shared)));
                divided = true;
            }
        }
        if divided {
            flat.collect();
        }
    }

    /// Collects equal factors, and opens those whose half powers have met: √(x y) · √(x y) is x y.
    fn collect(&mut self, flat: &mut Flat) {
        let mut halves: Vec<NodeId> = Vec::new();
        loop {
            self.swap(flat, Form::Growing);
            let odd = flat.factors.iter().filter(|(_, exponent)| exponent.as_integer().is_none());
            halves.extend(odd.map(|&(factor, _)| factor));
            flat.collect();
            let met = |&(factor, exponent): &(NodeId, Exponent)| {
                exponent.as_integer().is_some() && halves.contains(&factor)
            };
            let Some(index) = flat.factors.iter().position(met) else { return };
            let (factor, exponent) = flat.factors.remove(index);
            halves.retain(|&half| half != factor);
            self.absorb(flat, factor, exponent);
        }
    }

    /// The product of many factors as a product of two halves.
    fn nested(&mut self, factors: &[(NodeId, Exponent)]) -> NodeId {
        let powers: Vec<NodeId> = factors.iter().map(|&(f, e)| self.product(&[(f, e)])).collect();
        let (first, second) = powers.split_at(powers.len().div_ceil(2));
        let half = |graph: &mut Graph, half: &[NodeId]| {
            let mut product = half[0];
            for &factor in &half[1..] {
                product = graph.mul(product, factor);
            }
            product
        };
        let first = half(self, first);
        if second.is_empty() {
            return first;
        }
        let second = half(self, second);
        let mut pair = [(first, Exponent(2)), (second, Exponent(2))];
        pair.sort_unstable();
        self.intern(Node::Product(pair.to_vec()))
    }
}

/// The two forms of functions that grow like eˣ.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    /// Hyperbolic cosines, and 1 + eˣ.
    Growing,
    /// Their reciprocals, sech x and the logistic function of −x.
    Bounded,
}

struct Flat {
    coefficient: Number,
    factors: Vec<(NodeId, Exponent)>,
}

impl Flat {
    /// Sorts the factors and adds the exponents of equal ones.
    fn collect(&mut self) {
        self.factors.sort_unstable_by_key(|&(factor, _)| factor);
        self.factors.dedup_by(|later, earlier| {
            let equal = later.0 == earlier.0;
            if equal {
                earlier.1.0 += later.1.0;
            }
            equal
        });
        self.factors.retain(|(_, exponent)| exponent.0 != 0);
    }
}

#[cfg(test)]
mod tests {
    use super::super::graph::Variable;
    use super::*;

    #[test]
    fn equal_factors_meet() {
        let mut g = Graph::new();
        let x = g.variable(Variable::Coordinate(0));
        let root = g.sqrt(x);
        let cube = g.powi(root, 3);
        assert_eq!(g.node(cube), &Node::Product(vec![(x, Exponent(3))]));
        let back = g.mul(root, root);
        assert_eq!(back, x);
        let one = g.div(x, x);
        assert_eq!(g.as_constant(one), Some(Number::ONE));
    }

    #[test]
    fn reciprocals_of_hyperbolic_cosines_do_not_overflow() {
        let mut g = Graph::new();
        let x = g.variable(Variable::Coordinate(0));
        let [cosine, secant] = [Unary::Cosh, Unary::Sech].map(|function| g.unary(function, x));
        assert_eq!(g.powi(cosine, -2), g.powi(secant, 2));
        assert_eq!(g.powi(secant, -1), cosine);
        let [wide, narrow] = [g.powi(cosine, 3), g.powi(secant, 2)];
        assert_eq!(g.mul(wide, narrow), cosine);
        let product = g.mul(cosine, secant);
        assert_eq!(g.as_constant(product), Some(Number::ONE));
        let (root, half) = (g.sqrt(secant), g.product(&[(cosine, Exponent(-1))]));
        assert_eq!(root, half);
    }

    #[test]
    fn reciprocals_of_one_and_an_exponential_do_not_overflow() {
        let mut g = Graph::new();
        let x = g.variable(Variable::Coordinate(0));
        let (exponential, opposite) = (g.unary(Unary::Exp, x), g.neg(x));
        let sum = g.sum(Number::ONE, &[(exponential, Number::ONE)]);
        let logistic = g.unary(Unary::Logistic, opposite);
        assert_eq!(g.powi(sum, -2), g.powi(logistic, 2));
        assert_eq!(g.powi(logistic, -1), sum);
        let [wide, narrow] = [g.powi(sum, 3), g.powi(logistic, 2)];
        assert_eq!(g.mul(wide, narrow), sum);
        // The slope of ln(1 + eˣ).
        let [quotient, rising] = [g.div(exponential, sum), g.unary(Unary::Logistic, x)];
        assert_eq!(quotient, rising);
        // Beyond 709 the exponential is infinite, and its slope by the rule of quotients no number.
        let slope = crate::calculus::derivative(&mut g, Unary::Logistic, opposite, logistic);
        for x in [-800.0, -3.0, 0.0, 2.0, 800.0_f64] {
            let (low, high) = ((1.0 + x.exp()).recip(), (1.0 + (-x).exp()).recip());
            assert_eq!(g.evaluate(&[logistic, slope], |_| x), [low, low * high], "{x}");
        }
    }

    #[test]
    fn half_powers_of_a_product_open_where_they_meet() {
        let mut g = Graph::new();
        let (x, y) = (g.variable(Variable::Coordinate(0)), g.variable(Variable::Coordinate(1)));
        let (xy, two) = (g.mul(x, y), g.integer(2));
        let two_x = g.scale(x, Number::integer(2));
        for base in [xy, two_x, two] {
            let root = g.sqrt(base);
            let (a, b) = (g.mul(root, x), g.mul(root, y));
            let product = g.mul(a, b);
            assert_eq!(product, g.product(&[(base, Exponent(2)), (xy, Exponent(2))]));
        }
    }

    #[test]
    fn the_root_of_a_square_is_not_the_base() {
        let mut g = Graph::new();
        let x = g.variable(Variable::Coordinate(0));
        let square = g.powi(x, 2);
        let root = g.sqrt(square);
        assert_ne!(root, x);
    }

    #[test]
    fn coefficients_leave_products() {
        let mut g = Graph::new();
        let (x, y) = (g.variable(Variable::Coordinate(0)), g.variable(Variable::Coordinate(1)));
        let two_x = g.scale(x, Number::integer(2));
        let three_y = g.scale(y, Number::integer(3));
        let left = g.mul(two_x, three_y);
        let right = g.mul(x, y);
        let right = g.scale(right, Number::integer(6));
        assert_eq!(left, right);
    }

    #[test]
    fn long_products_nest() {
        let mut g = Graph::new();
        let mut product = g.one();
        for i in 0..60 {
            let x = g.variable(Variable::Coordinate(i));
            product = g.mul(product, x);
        }
        assert!(g.cone([product]).len() < 60 + 60);
    }
}
