//! Expressions as a textbook writes them.

use super::symbols::{self, Notation, Symbol};
use crate::collections::Lookup;
use crate::expr::{Binary, Exponent, Node, NodeId, Unary, Variable};
use crate::model::Model;
use crate::number::Number;

/// Writes expressions of a model; shared ones by the names they were given.
pub(super) struct Writer<'a> {
    pub model: &'a Model,
    pub notation: Notation,
    /// Names of intermediate results.
    pub names: Lookup<NodeId, String>,
}

/// Binding strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    /// `sin θ`: no power can follow.
    Application,
    Atom,
}

struct Text {
    text: String,
    strength: Strength,
    is_word: bool,
}

impl Text {
    fn atom(text: String) -> Text {
        Text { text, strength: Strength::Atom, is_word: false }
    }
}

impl From<Symbol> for Text {
    fn from(Symbol { text, is_word }: Symbol) -> Text {
        Text { text, strength: Strength::Atom, is_word }
    }
}

impl Writer<'_> {
    /// An expression.
    pub fn expression(&self, node: NodeId) -> String {
        join(self.terms(node, false))
    }

    /// An expression whose own name, if it has one, is not used: the right-hand side of its definition.
    pub fn definition(&self, node: NodeId) -> String {
        join(self.opened(node, false))
    }

    /// The summands of an expression with their signs: whether each is subtracted.
    pub fn terms(&self, node: NodeId, negated: bool) -> Vec<(bool, String)> {
        match self.names.get(&node) {
            Some(name) => vec![(negated, name.clone())],
            None => self.opened(node, negated),
        }
    }

    fn opened(&self, node: NodeId, negated: bool) -> Vec<(bool, String)> {
        let graph = &self.model.graph;
        match graph.node(node) {
            Node::Sum { offset, terms } => {
                let mut written = Vec::with_capacity(terms.len() + 1);
                for &(term, coefficient) in terms {
                    let negative = coefficient.is_negative() != negated;
                    let size = coefficient.abs();
                    let is_sum = matches!(graph.node(term), Node::Sum { .. });
                    if size.is_one() && is_sum {
                        written.extend(self.terms(term, negative));
                    } else {
                        written.push((negative, self.product(Some(size), term)));
                    }
                }
                if !offset.is_zero() {
                    written.push((offset.is_negative() != negated, self.number(offset.abs())));
                }
                written
            }
            Node::Constant(value) => vec![(value.is_negative() != negated, self.number(value.abs()))],
            Node::Variable(_) | Node::Product(_) | Node::Unary(..) | Node::Binary(..) => {
                vec![(negated, self.product(None, node))]
            }
        }
    }

    /// A coefficient before a product.
    fn product(&self, coefficient: Option<Number>, node: NodeId) -> String {
        let coefficient = coefficient.filter(|coefficient| !coefficient.is_one());
        let written = self.factor(node);
        let wrapped =
            if written.strength == Strength::Sum { self.grouped(&written.text) } else { written.text };
        match coefficient {
            Some(coefficient) => format!("{} {wrapped}", self.number(coefficient)),
            None => wrapped,
        }
    }

    fn factor(&self, node: NodeId) -> Text {
        if let Some(name) = self.names.get(&node) {
            return Text::atom(name.clone());
        }
        match self.model.graph.node(node) {
            Node::Constant(value) if value.is_negative() => {
                Text { strength: Strength::Sum, ..Text::atom(format!("−{}", self.number(value.abs()))) }
            }
            Node::Constant(value) => Text::atom(self.number(*value)),
            Node::Variable(variable) => self.variable(*variable),
            Node::Sum { .. } => {
                Text { text: join(self.opened(node, false)), strength: Strength::Sum, is_word: false }
            }
            Node::Product(factors) => self.fraction(factors),
            Node::Unary(function, argument) => self.application(*function, *argument, ""),
            Node::Binary(function, first, second) => {
                let (first, second) = (self.expression(*first), self.expression(*second));
                match function {
                    Binary::Powf => Text::atom(self.raised(&self.grouped(&first), &second)),
                    Binary::Atan2 => Text::atom(format!(
                        "{}{}",
                        self.word("atan2"),
                        self.grouped(&format!("{first}, {second}"))
                    )),
                    Binary::Pivot => Text::atom(first),
                    Binary::PowfLn => {
                        let base = self.grouped(&first);
                        let text = format!("{} {}{base}", self.raised(&base, &second), self.word("ln"));
                        Text { text, strength: Strength::Application, is_word: false }
                    }
                }
            }
        }
    }

    fn variable(&self, variable: Variable) -> Text {
        let (model, notation) = (self.model, self.notation);
        match variable {
            Variable::Coordinate(i) => symbols::coordinate(model, notation, i, 0).into(),
            Variable::Velocity(i) => symbols::coordinate(model, notation, i, 1).into(),
            Variable::Acceleration(i) => symbols::coordinate(model, notation, i, 2).into(),
            Variable::Input(i) => symbols::input(model, notation, i).into(),
            Variable::Multiplier(i) => symbols::multiplier(model, notation, i).into(),
            Variable::Parameter(i) => symbols::parameter(notation, &model.parameters[i as usize]).into(),
            Variable::Time => Text::atom("t".to_owned()),
            Variable::Auxiliary(i) => symbols::symbol(notation, "u", &i.to_string(), 0).into(),
            Variable::Entry(i) => symbols::symbol(notation, "R", &i.to_string(), 0).into(),
            Variable::Position(i) => symbols::symbol(notation, "r", &i.to_string(), 0).into(),
        }
    }

    /// The place of a factor: parameters, sums, coordinates, their derivatives, functions.
    fn rank(&self, node: NodeId) -> u32 {
        match self.model.graph.node(node) {
            Node::Constant(_) => 0,
            Node::Variable(Variable::Parameter(_)) => 1,
            Node::Sum { .. } | Node::Product(_) => 2,
            Node::Variable(
                Variable::Time | Variable::Coordinate(_) | Variable::Entry(_) | Variable::Position(_),
            ) => 3,
            Node::Variable(Variable::Input(_) | Variable::Auxiliary(_)) => 4,
            Node::Variable(Variable::Velocity(_)) => 5,
            Node::Variable(Variable::Acceleration(_) | Variable::Multiplier(_)) => 6,
            Node::Unary(..) | Node::Binary(..) => 7,
        }
    }

    fn fraction(&self, factors: &[(NodeId, Exponent)]) -> Text {
        let mut sorted = factors.to_vec();
        sorted.sort_by_key(|&(factor, _)| self.rank(factor));
        let side = |above: bool| -> Vec<Text> {
            let of_side = sorted.iter().filter(|(_, exponent)| (exponent.0 > 0) == above);
            of_side.map(|&(factor, exponent)| self.power(factor, Exponent(exponent.0.abs()))).collect()
        };
        let (above, below) = (side(true), side(false));
        let strength = if above.len() > 1 || !below.is_empty() { Strength::Product } else { Strength::Atom };
        let above = if above.is_empty() { Text::atom("1".to_owned()) } else { self.juxtaposed(above) };
        if below.is_empty() {
            return Text { strength: strength.min(above.strength), ..above };
        }
        let several = below.len() > 1;
        let below = self.juxtaposed(below);
        let text = match self.notation {
            Notation::Latex => format!("\\frac{{{}}}{{{}}}", above.text, below.text),
            Notation::Unicode if several || below.strength < Strength::Atom => {
                format!("{}/({})", above.text, below.text)
            }
            Notation::Unicode => format!("{}/{}", above.text, below.text),
        };
        Text { text, strength, is_word: false }
    }

    /// Factors side by side; words are kept apart by a sign.
    fn juxtaposed(&self, factors: Vec<Text>) -> Text {
        let alone = factors.len() == 1;
        let mut product: Option<Text> = None;
        for factor in factors {
            let grouped = factor.strength == Strength::Sum && !alone;
            let text = if grouped { self.grouped(&factor.text) } else { factor.text };
            product = Some(match product {
                None => Text { text, ..factor },
                Some(before) => {
                    let separator = match (before.is_word || factor.is_word, self.notation) {
                        (true, Notation::Unicode) => "·",
                        (true, Notation::Latex) => " \\, ",
                        (false, _) => " ",
                    };
                    let text = format!("{}{separator}{text}", before.text);
                    Text { text, strength: Strength::Product, is_word: factor.is_word }
                }
            });
        }
        product.unwrap_or_else(|| Text::atom("1".to_owned()))
    }

    /// A positive power.
    fn power(&self, base: NodeId, exponent: Exponent) -> Text {
        if exponent.0 == 2 {
            let written = self.factor(base);
            if written.strength == Strength::Sum {
                return Text::atom(self.grouped(&written.text));
            }
            return written;
        }
        if exponent.0 == 1 {
            let inner = self.expression(base);
            return Text::atom(match self.notation {
                Notation::Latex => format!("\\sqrt{{{inner}}}"),
                Notation::Unicode if self.factor(base).strength == Strength::Atom => format!("√{inner}"),
                Notation::Unicode => format!("√({inner})"),
            });
        }
        let power = match exponent.as_integer() {
            Some(power) => power.to_string(),
            None => format!("{}/2", exponent.0),
        };
        if let Node::Unary(function, argument) = self.model.graph.node(base)
            && self.names.get(&base).is_none()
            && exponent.as_integer().is_some()
            && is_trigonometric(*function)
        {
            return self.application(*function, *argument, &power);
        }
        let written = self.factor(base);
        let inner =
            if written.strength == Strength::Atom { written.text } else { self.grouped(&written.text) };
        Text { is_word: written.is_word, ..Text::atom(self.raised(&inner, &power)) }
    }

    fn raised(&self, base: &str, power: &str) -> String {
        match self.notation {
            Notation::Latex => format!("{{{base}}}^{{{power}}}"),
            Notation::Unicode if power.chars().all(|c| c.is_ascii_digit()) => {
                format!("{base}{}", superscript(power))
            }
            Notation::Unicode => format!("{base}^({power})"),
        }
    }

    /// `sin θ`, `sin²(θ − φ)`, `exp(x)`.
    fn application(&self, function: Unary, argument: NodeId, power: &str) -> Text {
        let inner = self.expression(argument);
        if function == Unary::Abs {
            return Text::atom(format!("|{inner}|"));
        }
        let inner = if function == Unary::PositivePart { format!("0, {inner}") } else { inner };
        let name = match function {
            Unary::PositivePart => "max",
            Unary::Asin => "arcsin",
            Unary::Acos => "arccos",
            Unary::Atan => "arctan",
            Unary::Asinh => "arsinh",
            Unary::Acosh => "arcosh",
            Unary::Atanh => "artanh",
            Unary::ExpM1 => "expm1",
            Unary::Ln1p => "ln1p",
            Unary::Signum => "sgn",
            Unary::Sin | Unary::Cos | Unary::Tan | Unary::Sinh | Unary::Cosh | Unary::Tanh => function.name(),
            Unary::Sech | Unary::Exp | Unary::Ln | Unary::Cbrt | Unary::Abs => function.name(),
        };
        let raised = match (power.is_empty(), self.notation) {
            (true, _) => String::new(),
            (false, Notation::Unicode) => superscript(power),
            (false, Notation::Latex) => format!("^{{{power}}}"),
        };
        let is_atom = self.factor(argument).strength == Strength::Atom;
        if is_trigonometric(function) && is_atom {
            let text = format!("{}{raised} {inner}", self.word(name));
            return Text { text, strength: Strength::Application, is_word: false };
        }
        Text::atom(format!("{}{raised}{}", self.word(name), self.grouped(&inner)))
    }

    fn word(&self, name: &str) -> String {
        const KNOWN: [&str; 12] =
            ["sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln", "max"];
        match self.notation {
            Notation::Unicode => name.to_owned(),
            Notation::Latex if KNOWN.contains(&name) => format!("\\{name}"),
            Notation::Latex => format!("\\operatorname{{{name}}}"),
        }
    }

    fn grouped(&self, text: &str) -> String {
        match self.notation {
            Notation::Unicode => format!("({text})"),
            Notation::Latex => format!("\\left({text}\\right)"),
        }
    }

    fn number(&self, value: Number) -> String {
        const FRACTIONS: [(i128, i128, &str); 7] =
            [(1, 2, "½"), (1, 3, "⅓"), (2, 3, "⅔"), (1, 4, "¼"), (3, 4, "¾"), (1, 8, "⅛"), (3, 8, "⅜")];
        let known = FRACTIONS.iter().find(|&&(a, b, _)| value == Number::Ratio(a, b));
        match (self.notation, known, value) {
            (Notation::Unicode, Some((_, _, sign)), _) => (*sign).to_owned(),
            (Notation::Latex, Some((a, b, _)), _) => format!("\\frac{{{a}}}{{{b}}}"),
            (Notation::Latex, None, Number::Ratio(a, b)) if value.to_string().contains('/') => {
                format!("\\frac{{{a}}}{{{b}}}")
            }
            _ => value.to_string(),
        }
    }
}

fn is_trigonometric(function: Unary) -> bool {
    use Unary::{Cos, Cosh, Sech, Sin, Sinh, Tan, Tanh};
    matches!(function, Sin | Cos | Tan | Sinh | Cosh | Tanh | Sech)
}

fn superscript(digits: &str) -> String {
    let digit = |c: char| match c {
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => char::from_u32(0x2070 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
    };
    digits.chars().map(digit).collect()
}

/// `a − b + c`, a summand that is added first where there is one.
pub(super) fn join(mut terms: Vec<(bool, String)>) -> String {
    if let Some(first) = terms.iter().position(|(negative, _)| !negative) {
        let term = terms.remove(first);
        terms.insert(0, term);
    }
    let mut text = String::new();
    for (negative, term) in terms {
        text.push_str(match (text.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        });
        text.push_str(&term);
    }
    if text.is_empty() { "0".to_owned() } else { text }
}
