//! Formulas in MathML Core, for browsers, books and screen readers.

use super::formula::{self, Application, Formula, Page, fraction};
use super::symbols::{Symbol, greek, stem};
use crate::number::Number;

/// The invisible sign of multiplication, which screen readers speak.
const TIMES: &str = "<mo>\u{2062}</mo>";
/// The invisible sign of a function of its argument.
const OF: &str = "<mo>\u{2061}</mo>";
/// The space around a function and a bare argument, as in sin θ. Browsers leave none.
const THIN: &str = "<mspace width=\"0.17em\"/>";

/// Equations, a row of a table each.
pub(super) fn page(page: &Page) -> String {
    let mut rows: Vec<String> =
        page.rows.iter().map(|[left, right]| row(&formula(left), &formula(right))).collect();
    rows.extend(page.more.iter().map(|more| remark(more)));
    if !page.definitions.is_empty() {
        rows.push(remark("where"));
        rows.extend(page.definitions.iter().map(|(name, right)| row(&symbol(name), &formula(right))));
    }
    format!(
        "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\">\
         <mtable displaystyle=\"true\">\n{}\n</mtable></math>",
        rows.join("\n")
    )
}

/// Both sides meet at the sign between them.
fn row(left: &str, right: &str) -> String {
    format!(
        "<mtr><mtd style=\"text-align: right\">{left}</mtd>\
         <mtd style=\"text-align: left\"><mo>=</mo>{right}</mtd></mtr>"
    )
}

fn remark(text: &str) -> String {
    format!("<mtr><mtd></mtd><mtd style=\"text-align: left\"><mtext>{text}</mtext></mtd></mtr>")
}

fn formula(written: &Formula) -> String {
    match written {
        Formula::Symbol(name) => symbol(name),
        Formula::Number(value) => number(*value),
        Formula::Sum(terms) => sum(terms),
        Formula::Scaled(coefficient, factor) => {
            format!("<mrow>{}{TIMES}{}</mrow>", number(*coefficient), formula(factor))
        }
        Formula::Product(factors) => product(factors),
        Formula::Fraction(above, below) => format!("<mfrac>{}{}</mfrac>", side(above), side(below)),
        Formula::Power(base, power) => format!("<msup>{}{}</msup>", formula(base), formula(power)),
        Formula::Root(inner) => format!("<msqrt>{}</msqrt>", formula(inner)),
        Formula::Group(inner) => fenced("(", &formula(inner), ")"),
        Formula::Absolute(inner) => fenced("|", &formula(inner), "|"),
        Formula::Application(Application { name, power, arguments, is_grouped }) => {
            let name = match power {
                None => format!("<mi>{name}</mi>"),
                Some(power) => format!("<msup><mi>{name}</mi>{}</msup>", number(*power)),
            };
            let arguments = listed(arguments.iter().map(formula));
            let arguments =
                if *is_grouped { fenced("(", &arguments, ")") } else { format!("{THIN}{arguments}") };
            format!("<mrow>{name}{OF}{arguments}</mrow>")
        }
    }
}

/// A side of a fraction. The line groups it, so it needs no parentheses.
fn side(written: &Formula) -> String {
    match written {
        Formula::Group(inner) => formula(inner),
        _ => formula(written),
    }
}

fn fenced(open: &str, inner: &str, close: &str) -> String {
    format!("<mrow><mo>{open}</mo>{inner}<mo>{close}</mo></mrow>")
}

fn listed(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join("<mo separator=\"true\">,</mo>")
}

fn sum(terms: &[(bool, Formula)]) -> String {
    format!("<mrow>{}</mrow>", formula::terms(terms, ["<mo>−</mo>", "<mo>+</mo>", "<mo>−</mo>"], formula))
}

fn product(factors: &[Formula]) -> String {
    let written = |factor: &Formula| match factor {
        Formula::Application(_) if !std::ptr::eq(factor, &factors[0]) => format!("{THIN}{}", formula(factor)),
        _ => formula(factor),
    };
    format!("<mrow>{}</mrow>", formula::factors(factors, [TIMES, "<mo>⋅</mo>"], written))
}

fn number(value: Number) -> String {
    match fraction(value) {
        Some([above, below]) => format!("<mfrac><mn>{above}</mn><mn>{below}</mn></mfrac>"),
        None => format!("<mn>{value}</mn>"),
    }
}

/// A symbol.
pub(super) fn symbol(symbol: &Symbol) -> String {
    let (letter, word, index) = match symbol {
        Symbol::Multiplier { constraint, index } => ("<mi>λ</mi>".to_owned(), constraint.as_str(), index),
        Symbol::Name { base, index, dots } => {
            let (stem, rest) = stem(base);
            let letter = identifier(greek(stem).unwrap_or(stem));
            let letter = match dots {
                0 => letter,
                1 => format!("<mover accent=\"true\">{letter}<mo>˙</mo></mover>"),
                _ => format!("<mover accent=\"true\">{letter}<mo>¨</mo></mover>"),
            };
            (letter, rest, index)
        }
    };
    let is_number = |part: &str| part.chars().all(|c| c.is_ascii_digit());
    let part = |part: &str| if is_number(part) { format!("<mn>{part}</mn>") } else { identifier(part) };
    let parts: Vec<String> =
        [word].into_iter().chain(index.split(',')).filter(|part| !part.is_empty()).map(part).collect();
    match &parts[..] {
        [] => letter,
        [one] => format!("<msub>{letter}{one}</msub>"),
        _ => format!("<msub>{letter}<mrow>{}</mrow></msub>", listed(parts.into_iter())),
    }
}

/// A name with characters of markup escaped.
fn identifier(name: &str) -> String {
    let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    format!("<mi>{name}</mi>")
}
