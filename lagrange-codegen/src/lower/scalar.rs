//! Methods of numbers.

use super::interpreter::Interpreter;
use super::rounded::Rounded;
use super::value::Value;
use crate::diagnostics::{Origin, catalogue};
use crate::expr::{Dependence, NodeId, Unary};
use crate::number::Number;
use crate::syntax::body::Word;

/// The methods of a number.
pub const METHODS: [&str; 40] = [
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "sinh",
    "cosh",
    "tanh",
    "asinh",
    "acosh",
    "atanh",
    "exp",
    "exp_m1",
    "ln",
    "ln_1p",
    "cbrt",
    "abs",
    "signum",
    "positive_part",
    "min",
    "max",
    "clamp",
    "sqrt",
    "powi",
    "powf",
    "exp2",
    "log",
    "log2",
    "log10",
    "sin_cos",
    "sinh_cosh",
    "atan2",
    "hypot",
    "recip",
    "mul_add",
    "to_radians",
    "to_degrees",
    "square",
    "modulus",
];

/// Methods of floats that the language does not have.
pub const REFUSED: [&str; 11] = [
    "floor",
    "ceil",
    "round",
    "trunc",
    "fract",
    "rem_euclid",
    "div_euclid",
    "copysign",
    "is_nan",
    "is_finite",
    "total_cmp",
];

/// Larger whole powers are hardly meant, and exact constants would take forever.
pub const LARGEST_POWER: u128 = 1024;

impl Interpreter<'_> {
    /// `x.method(arguments)` for a number.
    pub fn scalar_method(
        &mut self,
        (node, rounded): (NodeId, Rounded),
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Value {
        let name = &*word.name;
        if let Some(value) = self.jump(name, (node, rounded), &arguments, word.origin) {
            return value;
        }
        if REFUSED.contains(&name) {
            return self.refuse(word.origin, catalogue::not_smooth(name, alternative(name)));
        }
        let constants: Option<Vec<Rounded>> = arguments
            .iter()
            .map(|argument| match argument {
                Value::Scalar(_, rounded) => Some(*rounded),
                _ => None,
            })
            .collect();
        let of_constants = constants.map_or(Rounded::UNKNOWN, |others| rounded.function(name, &others));
        let value = match name {
            "powi" => self.whole_power(node, word, arguments, origin),
            "sin_cos" | "sinh_cosh" => {
                let (first, second) = match name {
                    "sin_cos" => (Unary::Sin, Unary::Cos),
                    _ => (Unary::Sinh, Unary::Cosh),
                };
                if self.exactly::<0>(word, arguments, origin).is_none() {
                    return Value::Unknown;
                }
                let pair = [first, second].map(|function| self.graph().unary(function, node));
                return Value::tuple(pair.map(Value::scalar).to_vec());
            }
            "clamp" => {
                let Some(bounds) = self.exactly::<2>(word, arguments, origin) else { return Value::Unknown };
                let [Some(low), Some(high)] = bounds.map(|bound| self.scalar(bound, origin)) else {
                    return Value::Unknown;
                };
                let [known_low, known_high] = [low, high].map(|bound| self.graph().as_constant(bound));
                if let (Some(low), Some(high)) = (known_low, known_high)
                    && (high - low).is_negative()
                {
                    return self.refuse(origin, catalogue::clamp_reversed());
                }
                Some(self.graph().clamp(node, [low, high]))
            }
            "log" if arguments.is_empty() => {
                return self.refuse(word.origin, catalogue::logarithm_without_base());
            }
            "powf" | "log" | "atan2" | "hypot" | "min" | "max" => {
                let Some([other]) = self.exactly(word, arguments, origin) else { return Value::Unknown };
                let Some(other) = self.scalar(other, origin) else { return Value::Unknown };
                Some(self.two_argument_function(name, node, other))
            }
            "mul_add" => {
                let Some([factor, summand]) = self.exactly(word, arguments, origin) else {
                    return Value::Unknown;
                };
                let (factor, summand) = (self.scalar(factor, origin), self.scalar(summand, origin));
                let (Some(factor), Some(summand)) = (factor, summand) else { return Value::Unknown };
                let product = self.graph().mul(node, factor);
                Some(self.graph().add(product, summand))
            }
            _ => {
                if !METHODS.contains(&name) {
                    return self.unknown_method(&Value::scalar(node), word);
                }
                if self.exactly::<0>(word, arguments, origin).is_none() {
                    return Value::Unknown;
                }
                Some(match Unary::ALL.into_iter().find(|function| function.name() == name) {
                    Some(function) => self.graph().unary(function, node),
                    None => self.one_argument_function(name, node),
                })
            }
        };
        match value {
            Some(node) if self.model.graph.dependence(node) == Dependence::NONE => {
                Value::Scalar(node, of_constants)
            }
            Some(node) => Value::scalar(node),
            None => Value::Unknown,
        }
    }

    fn whole_power(
        &mut self,
        node: NodeId,
        word: &Word,
        arguments: Vec<Value>,
        origin: Origin,
    ) -> Option<NodeId> {
        let [power] = self.exactly(word, arguments, origin)?;
        match power {
            Value::Integer(power, ..) if power.unsigned_abs() <= LARGEST_POWER => {
                Some(self.graph().powi(node, power as i32))
            }
            Value::Unknown => None,
            _ => {
                self.report(origin, catalogue::bad_power(LARGEST_POWER));
                None
            }
        }
    }

    fn two_argument_function(&mut self, name: &str, node: NodeId, other: NodeId) -> NodeId {
        let graph = self.graph();
        match name {
            "powf" => graph.powf(node, other),
            "atan2" => graph.atan2(node, other),
            "min" => graph.min(node, other),
            "max" => graph.max(node, other),
            "hypot" => {
                let squares = [node, other].map(|node| (graph.powi(node, 2), Number::ONE));
                let sum = graph.sum(Number::ZERO, &squares);
                graph.sqrt(sum)
            }
            _ => {
                let (numerator, denominator) = (graph.unary(Unary::Ln, node), graph.unary(Unary::Ln, other));
                graph.div(numerator, denominator)
            }
        }
    }

    fn one_argument_function(&mut self, name: &str, node: NodeId) -> NodeId {
        let graph = self.graph();
        match name {
            "sqrt" => graph.sqrt(node),
            "recip" => graph.powi(node, -1),
            "square" => graph.powi(node, 2),
            "modulus" => graph.unary(Unary::Abs, node),
            "exp2" => {
                let two = graph.integer(2);
                graph.powf(two, node)
            }
            "log2" | "log10" => {
                let base = if name == "log2" { Number::LN_2 } else { Number::LN_10 };
                let logarithm = graph.unary(Unary::Ln, node);
                let base = graph.constant(base);
                graph.div(logarithm, base)
            }
            "to_radians" => graph.scale(node, Number::DEGREE),
            _ => graph.scale(node, Number::RADIAN),
        }
    }
}

/// A smooth alternative to a function that is not smooth.
pub fn alternative(name: &str) -> &'static str {
    match name {
        "is_nan" | "is_finite" | "total_cmp" => "the generated solver checks its numbers itself",
        "rem_euclid" | "div_euclid" | "fract" => {
            "it jumps: use a trigonometric function for what repeats itself, or for parameters a field with the result"
        }
        "copysign" => "write `x.abs() * y.signum()`",
        _ => "use the unrounded value",
    }
}
