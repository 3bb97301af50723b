//! Functions that jump, of constants: a constant has no derivative to lose.
//!
//! Each is decided by a whole number: `floor` is that number, and `a % b` is a − w b. The whole number is the
//! one that Rust's arithmetic gives, where 0.1 · 3.0 exceeds 0.3. What is made of it is exact, as sums and
//! products of constants are: `9.81.fract()` is 81 hundredths.

use super::interpreter::Interpreter;
use super::rounded::Rounded;
use super::value::Value;
use crate::diagnostics::{Origin, catalogue};
use crate::expr::{Dependence, NodeId, Unary};
use crate::number::Number;

/// Up to here doubles hold all whole numbers.
const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;

/// Up to here the whole number of times that a divisor fits is found from a quotient of doubles.
const LARGEST_QUOTIENT: f64 = LARGEST_EXACT / 16.0;

impl Interpreter<'_> {
    /// A function that jumps, of constants; `%` is one. `None` for other functions, and for numbers that are
    /// no constants.
    pub fn jump(
        &mut self,
        name: &str,
        (node, rounded): (NodeId, Rounded),
        others: &[Value],
        origin: Origin,
    ) -> Option<Value> {
        let other = match (name, others) {
            ("floor" | "ceil" | "round" | "trunc" | "fract" | "signum", []) => None,
            ("%" | "rem_euclid" | "div_euclid" | "copysign", [Value::Scalar(node, rounded)]) => {
                Some((*node, *rounded))
            }
            ("%" | "rem_euclid" | "div_euclid" | "copysign", [Value::Integer(value, _)])
                if self.model.graph.dependence(node) == Dependence::NONE =>
            {
                return Some(self.refuse(origin, catalogue::integer_for_scalar(value)));
            }
            _ => return None,
        };
        let of_other = other.map(|(node, _)| node);
        let is_constant = |node: NodeId| self.model.graph.dependence(node) == Dependence::NONE;
        if !is_constant(node) || !of_other.is_none_or(is_constant) {
            return None;
        }
        let divides = matches!(name, "%" | "rem_euclid" | "div_euclid");
        if divides && of_other.is_some_and(|divisor| self.graph().is_zero(divisor)) {
            return Some(self.refuse(origin, catalogue::division_by_zero()));
        }
        let others: Vec<Rounded> = other.into_iter().map(|(_, rounded)| rounded).collect();
        let largest = if matches!(name, "%" | "rem_euclid") { LARGEST_QUOTIENT } else { LARGEST_EXACT };
        let whole = rounded.whole(name, &others).value(&self.item.scalar);
        let Some(whole) = whole.filter(|whole| whole.abs() <= largest) else {
            // The sign of what is computed exactly has a meaning of its own.
            return (name != "signum").then(|| self.refuse(origin, catalogue::rounding_jumps(name)));
        };
        let whole = Number::integer(whole as i128);
        let graph = self.graph();
        let value = match (name, of_other) {
            // An infinite divisor fits in not once, and zero times infinity is no number.
            ("fract" | "%" | "rem_euclid", _) if whole.is_zero() => node,
            ("fract", _) => {
                let below = graph.constant(whole);
                graph.sub(node, below)
            }
            ("%" | "rem_euclid", Some(divisor)) => {
                let multiple = graph.scale(divisor, whole);
                graph.sub(node, multiple)
            }
            ("copysign", _) => {
                let size = graph.unary(Unary::Abs, node);
                graph.scale(size, whole)
            }
            _ => graph.constant(whole),
        };
        Some(Value::Scalar(value, rounded.function(name, &others)))
    }
}
