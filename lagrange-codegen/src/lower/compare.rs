//! Comparisons. One of constants decides which branch is taken. One that depends on the state is a number
//! itself, [`Value::Choice`].

use super::advice::dependence_words;
use super::interpreter::Interpreter;
use super::rounded::holds;
use super::value::Value;
use crate::diagnostics::{Origin, catalogue};
use crate::expr::Dependence;
use crate::syntax::body::BinaryOperator;

impl Interpreter<'_> {
    /// A comparison of two values. That of constants is decided as Rust decides it.
    pub fn compare(&mut self, operator: BinaryOperator, left: Value, right: Value, origin: Origin) -> Value {
        for value in [&left, &right] {
            if let Value::Parameter(id) = value
                && self.parameters.is_integer(*id)
            {
                let text = self.parameters.text(*id).to_string();
                return self.refuse(origin, catalogue::branch_on_count(text));
            }
        }
        let verdict = match (&left, &right) {
            (Value::Integer(a, ..), Value::Integer(b, ..)) => holds(operator, a, b),
            (Value::Boolean(a), Value::Boolean(b)) => holds(operator, a, b),
            (Value::Scalar(..) | Value::Parameter(_), Value::Scalar(..) | Value::Parameter(_)) => {
                let rounded = match (&left, &right) {
                    (Value::Scalar(_, a), Value::Scalar(_, b)) => a.compare(operator, *b, &self.item.scalar),
                    _ => None,
                };
                let (a, b) = (self.scalar(left, origin), self.scalar(right, origin));
                let (Some(a), Some(b)) = (a, b) else { return Value::Unknown };
                let graph = self.graph();
                let dependence = graph.dependence(a).union(graph.dependence(b));
                match rounded {
                    Some(verdict) => verdict,
                    None if dependence == Dependence::NONE => {
                        return self.refuse(origin, catalogue::rounding_decides());
                    }
                    None => {
                        return match self.choice(operator, a, b) {
                            Some(weight) => Value::Choice(weight),
                            None => {
                                let on = dependence_words(dependence);
                                self.refuse(origin, catalogue::branch_on_variable(on, self.smooth_thing()))
                            }
                        };
                    }
                }
            }
            (Value::Integer(..), Value::Parameter(id)) | (Value::Parameter(id), Value::Integer(..)) => {
                let text = self.parameters.text(*id).to_string();
                return self.refuse(origin, catalogue::branch_on_count(text));
            }
            (Value::Boolean(_), Value::Parameter(id)) | (Value::Parameter(id), Value::Boolean(_)) => {
                let text = self.parameters.text(*id).to_string();
                let on = format!("the parameter `{text}`");
                return self.refuse(origin, catalogue::branch_on_variable(on, self.smooth_thing()));
            }
            (Value::Choice(_), Value::Choice(_) | Value::Boolean(_))
            | (Value::Boolean(_), Value::Choice(_))
                if matches!(operator, BinaryOperator::Equal | BinaryOperator::NotEqual) =>
            {
                let (sign, joined) = match operator {
                    BinaryOperator::Equal => ("==", "(a && b) || (!a && !b)"),
                    _ => ("!=", "(a && !b) || (!a && b)"),
                };
                return self.refuse(origin, catalogue::conditions_compared(sign, joined));
            }
            _ => return self.mismatch(operator, &left, &right, origin),
        };
        Value::Boolean(verdict)
    }
}

/// Whether an operator compares two values. `&&` and `||` do not: they join truth values.
pub fn is_comparison(operator: BinaryOperator) -> bool {
    match operator {
        BinaryOperator::Equal
        | BinaryOperator::NotEqual
        | BinaryOperator::Less
        | BinaryOperator::LessEqual
        | BinaryOperator::Greater
        | BinaryOperator::GreaterEqual => true,
        BinaryOperator::Add
        | BinaryOperator::Subtract
        | BinaryOperator::Multiply
        | BinaryOperator::Divide
        | BinaryOperator::Remainder
        | BinaryOperator::And
        | BinaryOperator::Or => false,
    }
}
