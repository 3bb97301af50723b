//! Formulas in LaTeX.

use super::formula::{self, Application, Formula, Page, fraction};
use super::symbols::{Symbol, greek, stem};
use crate::number::Number;

/// Equations, an `aligned` environment.
pub(super) fn page(page: &Page) -> String {
    let row = |[left, right]: &[Formula; 2]| format!("{} &= {}", formula(left), formula(right));
    let definition = |(name, right): &(Symbol, Formula)| format!("{} &= {}", symbol(name), formula(right));
    let lines: Vec<String> = page
        .rows
        .iter()
        .map(row)
        .chain(page.definitions.iter().map(definition))
        .chain(page.more.iter().map(|more| format!("&\\text{{{more}}}")))
        .collect();
    format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", lines.join(" \\\\\n"))
}

fn formula(written: &Formula) -> String {
    match written {
        Formula::Symbol(name) => symbol(name),
        Formula::Number(value) => number(*value),
        Formula::Sum(terms) => formula::terms(terms, ["-", " + ", " - "], formula),
        Formula::Scaled(coefficient, factor) => format!("{} {}", number(*coefficient), formula(factor)),
        Formula::Product(factors) => formula::factors(factors, [" ", " \\, "], formula),
        Formula::Fraction(above, below) => format!("\\frac{{{}}}{{{}}}", formula(above), formula(below)),
        Formula::Power(base, power) => format!("{{{}}}^{{{}}}", formula(base), formula(power)),
        Formula::Root(inner) => format!("\\sqrt{{{}}}", formula(inner)),
        Formula::Group(inner) => format!("\\left({}\\right)", formula(inner)),
        Formula::Absolute(inner) => format!("|{}|", formula(inner)),
        Formula::Application(Application { name, power, arguments, is_grouped }) => {
            let name = function(name);
            let power = power.map_or_else(String::new, |power| format!("^{{{}}}", number(power)));
            let arguments = arguments.iter().map(formula).collect::<Vec<_>>().join(", ");
            if *is_grouped {
                format!("{name}{power}\\left({arguments}\\right)")
            } else {
                format!("{name}{power} {arguments}")
            }
        }
    }
}

fn function(name: &str) -> String {
    const KNOWN: [&str; 12] =
        ["sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln", "max"];
    if KNOWN.contains(&name) { format!("\\{name}") } else { format!("\\operatorname{{{name}}}") }
}

fn number(value: Number) -> String {
    match fraction(value) {
        Some([above, below]) => format!("\\frac{{{above}}}{{{below}}}"),
        None => value.to_string(),
    }
}

/// A symbol.
pub(super) fn symbol(symbol: &Symbol) -> String {
    let underscored = |name: &str| name.replace('_', "\\_");
    let (base, index, dots) = match symbol {
        Symbol::Multiplier { constraint, index } => {
            let comma = if index.is_empty() { "" } else { "," };
            return format!("\\lambda_{{\\mathrm{{{}}}{comma}{index}}}", underscored(constraint));
        }
        Symbol::Name { base, index, dots } => (base, index, dots),
    };
    let (stem, rest) = stem(base);
    let letter = match stem {
        "eps" => "\\epsilon".to_owned(),
        _ if greek(stem).is_some() => format!("\\{stem}"),
        _ if stem.chars().nth(1).is_some() => format!("\\mathrm{{{}}}", underscored(stem)),
        _ => stem.to_owned(),
    };
    let letter = match dots {
        0 => letter,
        1 => format!("\\dot{{{letter}}}"),
        _ => format!("\\ddot{{{letter}}}"),
    };
    let word = (!rest.is_empty()).then(|| format!("\\mathrm{{{}}}", underscored(rest)));
    let index = (!index.is_empty()).then(|| index.to_owned());
    let lower: Vec<String> = word.into_iter().chain(index).collect();
    if lower.is_empty() { letter } else { format!("{letter}_{{{}}}", lower.join(",")) }
}
