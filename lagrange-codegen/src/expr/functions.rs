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
                Unary::Signum if !value.is_zero() => {
                    return self.integer(if value.is_negative() { -1 } else { 1 });
                }
                _ => {}
            }
        }
        let (coefficient, _) = self.scaled(argument);
        if coefficient.is_negative() && function.parity() != Parity::Neither {
            let positive = self.neg(argument);
            let value = self.unary(function, positive);
            return if function.parity() == Parity::Odd { self.neg(value) } else { value };
        }
        self.intern(Node::Unary(function, argument))
    }

    /// The larger of two numbers, b + (a − b)⁺. If b is the larger, the result is b to the last bit.
    pub fn max(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let difference = self.sub(a, b);
        let excess = self.unary(Unary::PositivePart, difference);
        self.add(b, excess)
    }

    /// The smaller of two numbers, b − (b − a)⁺.
    pub fn min(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let difference = self.sub(b, a);
        let excess = self.unary(Unary::PositivePart, difference);
        self.sub(b, excess)
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

    /// A pivot that is NaN unless it stands above the rounding errors of `scale`.
    pub fn pivot(&mut self, value: NodeId, scale: NodeId) -> NodeId {
        match self.as_constant(value) {
            Some(number) if !number.is_negative() => value,
            _ => self.intern(Node::Binary(Binary::Pivot, value, scale)),
        }
    }

    /// `base` to any power, as a product if the exponent is a constant half-integer.
    pub fn powf(&mut self, base: NodeId, exponent: NodeId) -> NodeId {
        /// The largest power that is a product. For larger ones the library's function is cheaper.
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
}
