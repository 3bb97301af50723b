//! Formulas as plain text.

use super::formula::{self, Application, COMMON, Formula, Page, Strength};
use super::symbols::{Symbol, greek};
use crate::number::Number;

/// Equations, a line each.
pub(super) fn page(page: &Page) -> String {
    let row = |[left, right]: &[Formula; 2]| format!("{} = {}", formula(left), formula(right));
    let mut lines: Vec<String> = page.rows.iter().map(row).collect();
    lines.extend(page.more.iter().map(|more| format!("… {more}")));
    if !page.definitions.is_empty() {
        lines.push("where".to_owned());
        let definition = |(name, right): &(Symbol, Formula)| format!("{} = {}", symbol(name), formula(right));
        lines.extend(page.definitions.iter().map(definition));
    }
    lines.join("\n")
}

/// A formula.
pub(super) fn formula(written: &Formula) -> String {
    match written {
        Formula::Symbol(name) => symbol(name),
        Formula::Number(value) => number(*value),
        Formula::Sum(terms) => formula::terms(terms, ["−", " + ", " − "], formula),
        Formula::Scaled(coefficient, factor) => format!("{} {}", number(*coefficient), formula(factor)),
        Formula::Product(factors) => formula::factors(factors, [" ", "·"], formula),
        Formula::Fraction(above, below) if below.strength() < Strength::Power => {
            format!("{}/({})", formula(above), formula(below))
        }
        Formula::Fraction(above, below) => format!("{}/{}", formula(above), formula(below)),
        Formula::Power(base, exponent) => format!("{}{}", formula(base), power(&formula(exponent))),
        Formula::Root(inner) if inner.strength() == Strength::Atom => format!("√{}", formula(inner)),
        Formula::Root(inner) => format!("√({})", formula(inner)),
        Formula::Group(inner) => format!("({})", formula(inner)),
        Formula::Absolute(inner) => format!("|{}|", formula(inner)),
        Formula::Application(Application { name, power: exponent, arguments, is_grouped }) => {
            let power = exponent.map_or_else(String::new, |exponent| power(&number(exponent)));
            let arguments = arguments.iter().map(formula).collect::<Vec<_>>().join(", ");
            if *is_grouped {
                format!("{name}{power}({arguments})")
            } else {
                format!("{name}{power} {arguments}")
            }
        }
    }
}

fn power(exponent: &str) -> String {
    let digit = |c: char| match c {
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => char::from_u32(0x2070 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
    };
    if exponent.chars().all(|c| c.is_ascii_digit()) {
        exponent.chars().map(digit).collect()
    } else {
        format!("^({exponent})")
    }
}

fn number(value: Number) -> String {
    let known = COMMON.iter().find(|&&(a, b, _)| value == Number::Ratio(a, b));
    known.map_or_else(|| value.to_string(), |(_, _, sign)| (*sign).to_owned())
}

/// A symbol.
pub(super) fn symbol(symbol: &Symbol) -> String {
    let (base, index, dots) = match symbol {
        Symbol::Multiplier { constraint, index } => {
            let index = if index.is_empty() { String::new() } else { format!("[{index}]") };
            return format!("λ({constraint}{index})");
        }
        Symbol::Name { base, index, dots } => (base, index, dots),
    };
    let mark = match (dots, symbol.is_word()) {
        (0, _) => "",
        (1, false) => "\u{307}",
        (_, false) => "\u{308}",
        (1, true) => "′",
        (_, true) => "″",
    };
    let digit = |c: char| match c.to_digit(10) {
        Some(digit) => char::from_u32(0x2080 + digit).unwrap_or(c),
        None => c,
    };
    // Letters of an index have no subscript of their own.
    let index = if index.chars().all(|c| c.is_ascii_digit() || c == ',') {
        index.chars().map(digit).collect()
    } else {
        format!("[{index}]")
    };
    format!("{}{mark}{index}", greek(base).unwrap_or(base))
}
