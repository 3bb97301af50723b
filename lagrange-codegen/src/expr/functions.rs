//! Elementary functions: values at 0, parity, and powers that are really products.

use super::graph::{Exponent, Graph, Node, NodeId};
use super::op::{Binary, Parity, Unary};
use crate::number::Number;

impl Graph {
    /// A function of one argument, in normal form.
    pub fn unary(&mut self, function: Unary, argument: NodeId) -> NodeId {
        if let Some(value) = self.as_constant(argument) {
            if value.is_zero()
                && let Some(exact) = function.at_zero()
            {
                return self.integer(exact);
            }
            match function {
                Unary::Ln if value.is_one() => return self.zero(),
                Unary::Abs => return self.constant(value.abs()),
                Unary::PositivePart if value.is_negative() => return self.zero(),
                Unary::PositivePart => return argument,
                // That of zero stands above.
                Unary::Step | Unary::Below => {
                    return self.integer(i128::from(value.is_negative() == (function == Unary::Below)));
                }
                Unary::Signum if !value.is_zero() => {
                    return self.integer(if value.is_negative() { -1 } else { 1 });
                }
                _ => {}
            }
        }
        let (coefficient, inner) = self.scaled(argument);
        // A sum with an infinite number has its sign.
        if let (Unary::Step | Unary::Below, Node::Sum { offset, .. }) = (function, self.node(inner))
            && offset.is_infinite()
        {
            let is_below = offset.is_negative() != coefficient.is_negative();
            return self.integer(i128::from(is_below == (function == Unary::Below)));
        }
        if coefficient.is_negative() && function.parity() != Parity::Neither {
            let positive = self.neg(argument);
            let value = self.unary(function, positive);
            return if function.parity() == Parity::Odd { self.neg(value) } else { value };
        }
        self.intern(Node::Unary(function, argument))
    }

    /// One where a number is not negative and zero elsewhere, and the opposite. Each is a node of its own:
    /// 1 − w as a sum would be multiplied out, and b + w (a − b) loses what is small beside b.
    pub fn sides(&mut self, argument: NodeId) -> [NodeId; 2] {
        [Unary::Step, Unary::Below].map(|side| self.unary(side, argument))
    }

    /// The larger of two numbers, to the last bit.
    pub fn max(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match [a, b].map(|x| self.is_zero(x)) {
            [true, _] => self.unary(Unary::PositivePart, b),
            [_, true] => self.unary(Unary::PositivePart, a),
            _ => self.chosen_by_order(a, b, [a, b]),
        }
    }

    /// The smaller of two numbers, to the last bit.
    pub fn min(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if self.is_zero(a) || self.is_zero(b) {
            let [a, b] = [a, b].map(|x| self.neg(x));
            let larger = self.max(a, b);
            return self.neg(larger);
        }
        self.chosen_by_order(a, b, [b, a])
    }

    /// A number between two bounds, of which the first is not above the second: Rust panics for others.
    pub fn clamp(&mut self, value: NodeId, [low, high]: [NodeId; 2]) -> NodeId {
        let at_least = self.chosen_by_order(value, low, [value, low]);
        self.chosen_by_order(high, value, [at_least, high])
    }

    /// The first of two values where a ≥ b, else the second.
    fn chosen_by_order(&mut self, a: NodeId, b: NodeId, values: [NodeId; 2]) -> NodeId {
        let difference = self.sub(a, b);
        let [first, second] = self.sides(difference);
        // Zero times the other may be no number: a bound may be infinite.
        match [first, second].map(|side| self.is_zero(side)) {
            [true, _] => return values[1],
            [_, true] => return values[0],
            [false, false] => {}
        }
        let [first, second] = [(first, values[0]), (second, values[1])].map(|(side, x)| self.mul(side, x));
        self.add(first, second)
    }

    /// `y.atan2(x)`.
    pub fn atan2(&mut self, y: NodeId, x: NodeId) -> NodeId {
        self.intern(Node::Binary(Binary::Atan2, y, x))
    }

    /// A function of two arguments, in normal form.
    pub fn binary(&mut self, function: Binary, first: NodeId, second: NodeId) -> NodeId {
        match function {
            Binary::Atan2 => self.atan2(first, second),
            Binary::Powf => self.powf(first, second),
            Binary::PowfLn => self.powf_ln(first, second),
            Binary::Pivot => self.pivot(first, second),
        }
    }

    /// A pivot that is NaN unless it stands above the rounding errors of `scale`. A constant that
    /// is not negative stays as it is: it has none.
    pub fn pivot(&mut self, value: NodeId, scale: NodeId) -> NodeId {
        match self.as_constant(value) {
            Some(number) if !number.is_negative() => value,
            _ => self.intern(Node::Binary(Binary::Pivot, value, scale)),
        }
    }

    /// `base` to any power, as a product if the exponent is a constant half-integer up to 32.
    pub fn powf(&mut self, base: NodeId, exponent: NodeId) -> NodeId {
        /// The largest power that is a product, in halves. For larger ones the library's function is cheaper.
        const LARGEST: i128 = 64;
        if let Some(value) = self.as_constant(exponent) {
            let halves = (value * Number::integer(2)).as_integer();
            if let Some(halves) = halves
                && halves.abs() <= LARGEST
            {
                return self.product(&[(base, Exponent(halves as i32))]);
            }
        }
        self.intern(Node::Binary(Binary::Powf, base, exponent))
    }

    /// `base` to a power, times the logarithm of `base`.
    pub fn powf_ln(&mut self, base: NodeId, exponent: NodeId) -> NodeId {
        self.intern(Node::Binary(Binary::PowfLn, base, exponent))
    }
}

#[cfg(test)]
mod tests {
    use super::super::graph::Variable;
    use super::*;

    #[test]
    fn parity_moves_signs_outwards() {
        let mut g = Graph::new();
        let (x, y) = (g.variable(Variable::Coordinate(0)), g.variable(Variable::Coordinate(1)));
        let (d, e) = (g.sub(x, y), g.sub(y, x));
        let (sin_d, sin_e) = (g.unary(Unary::Sin, d), g.unary(Unary::Sin, e));
        assert_eq!(g.scaled(sin_e), (Number::MINUS_ONE, sin_d));
        assert_eq!(g.unary(Unary::Cos, d), g.unary(Unary::Cos, e));
        let negative = g.neg(x);
        let exp = g.unary(Unary::Exp, negative);
        assert_eq!(g.node(exp), &Node::Unary(Unary::Exp, negative));
    }

    #[test]
    fn half_integer_powers_are_products() {
        let mut g = Graph::new();
        let x = g.variable(Variable::Coordinate(0));
        let exponent = g.constant(Number::ratio(-3, 2).unwrap());
        let power = g.powf(x, exponent);
        assert_eq!(g.node(power), &Node::Product(vec![(x, Exponent(-3))]));
        let exponent = g.constant(Number::ratio(1, 3).unwrap());
        let power = g.powf(x, exponent);
        assert!(matches!(g.node(power), Node::Binary(Binary::Powf, ..)));
    }

    #[test]
    fn the_larger_the_smaller_and_the_bounded_number_are_one_of_them_to_the_last_bit() {
        let mut g = Graph::new();
        let [x, low, high] = [0, 1, 2].map(|i| g.variable(Variable::Coordinate(i)));
        let roots = [g.max(x, low), g.min(x, high), g.clamp(x, [low, high])];
        for (x, low, high) in
            [(0.3, -1e20, 1e20), (0.3, 0.1, 1e30), (0.3, -1e30, 0.1), (0.3, 0.5, 0.7), (0.3, 0.3, 0.3)]
        {
            let values = [x, low, high];
            let found = g.evaluate(&roots, |variable| match variable {
                Variable::Coordinate(i) => values[i as usize],
                _ => f64::NAN,
            });
            assert_eq!(found, [x.max(low), x.min(high), x.clamp(low, high)], "{values:?}");
        }
    }

    #[test]
    fn the_positive_part_of_a_number_is_a_single_function() {
        let mut g = Graph::new();
        let (x, zero) = (g.variable(Variable::Coordinate(0)), g.zero());
        let part = g.unary(Unary::PositivePart, x);
        assert_eq!([g.max(x, zero), g.max(zero, x)], [part; 2]);
        let (smaller, opposite) = (g.min(x, zero), g.neg(x));
        let part = g.unary(Unary::PositivePart, opposite);
        assert_eq!(smaller, g.neg(part));
    }

    #[test]
    fn an_infinite_bound_bounds_nothing() {
        let mut g = Graph::new();
        let x = g.variable(Variable::Coordinate(0));
        let [low, high] =
            [f64::NEG_INFINITY, f64::INFINITY].map(|bound| g.constant(Number::Float(bound, 0.0)));
        assert_eq!([g.max(low, x), g.max(x, low), g.min(high, x), g.min(x, high)], [x; 4]);
        assert_eq!([g.max(high, x), g.min(x, low)], [high, low]);
        assert_eq!(g.clamp(x, [low, high]), x);
        assert_eq!(g.max(low, high), high);
    }

    #[test]
    fn a_number_is_on_one_side_and_not_on_the_other() {
        let mut g = Graph::new();
        let x = g.variable(Variable::Coordinate(0));
        let sides = g.sides(x);
        for (x, expected) in [(2.0, [1.0, 0.0]), (-3.0, [0.0, 1.0])] {
            assert_eq!(g.evaluate(&sides, |_| x), expected);
            // Continued from the other side, both exchange their values. A zero has no rounding errors.
            let [a, b] = g.evaluate_on_sides(&sides, |_| x, |_| x < 0.0)[..] else { panic!() };
            assert_eq!([a.value, b.value], [expected[1], expected[0]]);
            assert!([a, b].iter().all(|side| side.error <= 4.0 * f64::EPSILON * side.value));
        }
    }
}
