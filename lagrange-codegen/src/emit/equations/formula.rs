//! Formulas before they are written: the same tree for text, LaTeX and MathML.

use super::symbols::Symbol;
use crate::number::Number;

/// A formula.
#[derive(Clone, Debug)]
pub(super) enum Formula {
    Symbol(Symbol),
    /// A number that is not negative.
    Number(Number),
    /// Terms, and whether each is subtracted.
    Sum(Vec<(bool, Formula)>),
    /// A coefficient before a product.
    Scaled(Number, Box<Formula>),
    /// Two factors or more, side by side.
    Product(Vec<Formula>),
    Fraction(Box<Formula>, Box<Formula>),
    Power(Box<Formula>, Box<Formula>),
    Root(Box<Formula>),
    /// In parentheses.
    Group(Box<Formula>),
    /// Between bars.
    Absolute(Box<Formula>),
    Application(Application),
}

/// `sin θ`, `sin²(θ − φ)`, `atan2(y, x)`.
#[derive(Clone, Debug)]
pub(super) struct Application {
    pub name: &'static str,
    /// A power, written at the function's name.
    pub power: Option<Number>,
    pub arguments: Vec<Formula>,
    /// Whether the arguments stand in parentheses.
    pub is_grouped: bool,
}

/// Binding strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Strength {
    Sum,
    Product,
    /// `sin θ`: no power can follow.
    Application,
    /// `x²` or `√x`: no further power can follow.
    Power,
    Atom,
}

impl Formula {
    /// How strongly the formula binds.
    pub fn strength(&self) -> Strength {
        match self {
            Formula::Sum(_) => Strength::Sum,
            Formula::Scaled(..) | Formula::Product(_) | Formula::Fraction(..) => Strength::Product,
            Formula::Application(Application { is_grouped: false, .. }) => Strength::Application,
            Formula::Power(..) | Formula::Root(_) => Strength::Power,
            Formula::Symbol(_) | Formula::Number(_) | Formula::Group(_) => Strength::Atom,
            Formula::Absolute(_) | Formula::Application(_) => Strength::Atom,
        }
    }

    /// The formula as a factor: sums get parentheses.
    pub fn into_factor(self) -> Formula {
        if self.strength() == Strength::Sum { self.grouped() } else { self }
    }

    /// The formula as the base of a power: all but symbols, numbers and what has parentheses or bars get
    /// them.
    pub fn into_atom(self) -> Formula {
        if self.strength() == Strength::Atom { self } else { self.grouped() }
    }

    /// In parentheses.
    pub fn grouped(self) -> Formula {
        Formula::Group(Box::new(self))
    }

    /// To a power.
    pub fn raised(self, power: Formula) -> Formula {
        Formula::Power(Box::new(self), Box::new(power))
    }

    /// A product of factors side by side; 1 if there is none.
    pub fn product(mut factors: Vec<Formula>) -> Formula {
        match factors.len() {
            0 => Formula::Number(Number::ONE),
            1 => factors.remove(0),
            _ => Formula::Product(factors),
        }
    }

    /// A sum that begins with an added term, if it has one.
    pub fn sum(mut terms: Vec<(bool, Formula)>) -> Formula {
        if let Some(first) = terms.iter().position(|(negative, _)| !negative) {
            let term = terms.remove(first);
            terms.insert(0, term);
        }
        if terms.is_empty() { Formula::Number(Number::ZERO) } else { Formula::Sum(terms) }
    }

    /// Whether the formula begins with a word, which needs a sign before it.
    pub fn begins_with_word(&self) -> bool {
        match self {
            Formula::Symbol(symbol) => symbol.is_word(),
            Formula::Power(base, _) => base.begins_with_word(),
            _ => false,
        }
    }

    /// Whether the formula ends with a word or with a power of one.
    pub fn ends_with_word(&self) -> bool {
        match self {
            Formula::Product(factors) => factors.last().is_some_and(Formula::ends_with_word),
            _ => self.begins_with_word(),
        }
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        matches!(self, Formula::Number(value) if value.is_zero())
    }
}

/// The written terms of a sum. `signs` are those of a subtracted first term, of an added and of a subtracted
/// later one.
pub(super) fn terms(
    terms: &[(bool, Formula)],
    signs: [&str; 3],
    written: impl Fn(&Formula) -> String,
) -> String {
    let mut text = String::new();
    for (is_negative, term) in terms {
        text.push_str(match (text.is_empty(), is_negative) {
            (true, false) => "",
            (true, true) => signs[0],
            (false, false) => signs[1],
            (false, true) => signs[2],
        });
        text.push_str(&written(term));
    }
    text
}

/// The written factors of a product. Words need a sign `between` them and their neighbours; other factors
/// stand `beside` each other.
pub(super) fn factors(
    factors: &[Formula],
    [beside, between]: [&str; 2],
    written: impl Fn(&Formula) -> String,
) -> String {
    let mut text = String::new();
    let mut after_word = None;
    for factor in factors {
        text.push_str(match after_word {
            None => "",
            Some(false) if !factor.begins_with_word() => beside,
            Some(_) => between,
        });
        text.push_str(&written(factor));
        after_word = Some(factor.ends_with_word());
    }
    text
}

/// Fractions with a character of their own.
pub(super) const COMMON: [(i128, i128, &str); 7] =
    [(1, 2, "½"), (1, 3, "⅓"), (2, 3, "⅔"), (1, 4, "¼"), (3, 4, "¾"), (1, 8, "⅛"), (3, 8, "⅜")];

/// Numerator and denominator of a number that is written as a fraction: of the common ones, and of those
/// without a short decimal.
pub(super) fn fraction(value: Number) -> Option<[i128; 2]> {
    let Number::Ratio(numerator, denominator) = value else { return None };
    let is_common = COMMON.iter().any(|&(a, b, _)| (a, b) == (numerator, denominator));
    (is_common || value.to_string().contains('/')).then_some([numerator, denominator])
}

/// The equations of motion, before they are written.
pub(super) struct Page {
    /// Both sides of each equation.
    pub rows: Vec<[Formula; 2]>,
    /// A remark about rows that are left out.
    pub more: Option<String>,
    /// Names of intermediate results, and their meanings.
    pub definitions: Vec<(Symbol, Formula)>,
}
