//! Names as symbols: Greek letters, indices, dots of time derivatives.

use crate::model::{Model, Parameter};

/// How formulas are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Notation {
    /// Plain text.
    Unicode,
    /// For `$…$`.
    Latex,
}

/// A symbol, and whether it is a word that needs a sign between it and its neighbours.
#[derive(Clone, Debug)]
pub(super) struct Symbol {
    pub text: String,
    pub is_word: bool,
}

const GREEK: [(&str, &str); 30] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ε"),
    ("eps", "ε"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("pi", "π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("phi", "φ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Theta", "Θ"),
    ("Lambda", "Λ"),
    ("Sigma", "Σ"),
    ("Phi", "Φ"),
    ("Psi", "Ψ"),
    ("Omega", "Ω"),
];

/// A coordinate with as many dots as it is differentiated by time.
pub(super) fn coordinate(model: &Model, notation: Notation, i: u32, dots: usize) -> Symbol {
    let quantity = &model.coordinates[i as usize];
    symbol(notation, &quantity.name, &index(quantity.index), dots)
}

/// An input.
pub(super) fn input(model: &Model, notation: Notation, i: u32) -> Symbol {
    let quantity = &model.inputs[i as usize];
    symbol(notation, &quantity.name, &index(quantity.index), 0)
}

/// The multiplier of a constraint.
pub(super) fn multiplier(model: &Model, notation: Notation, i: u32) -> Symbol {
    let constraint = &model.constraints[i as usize];
    let text = match notation {
        Notation::Unicode => format!("λ({})", constraint.written()),
        Notation::Latex => {
            let (name, index) = (constraint.name.replace('_', "\\_"), index(constraint.index));
            let comma = if index.is_empty() { "" } else { "," };
            format!("\\lambda_{{\\mathrm{{{name}}}{comma}{index}}}")
        }
    };
    Symbol { text, is_word: false }
}

/// A parameter: `self.m[0]` is m₀.
pub(super) fn parameter(notation: Notation, parameter: &Parameter) -> Symbol {
    let path = parameter.path.strip_prefix("self.").unwrap_or(&parameter.path);
    let is_plain = |c: char| c.is_alphanumeric() || "_.[]".contains(c);
    let path = if path.chars().all(is_plain) { path } else { parameter.label.as_str() };
    let (base, indices) = match path.find('[') {
        Some(place) => (&path[..place], path[place..].replace("][", ",").replace(['[', ']'], "")),
        None => (path, String::new()),
    };
    symbol(notation, base, &indices, 0)
}

fn index(index: Option<usize>) -> String {
    index.map_or_else(String::new, |index| index.to_string())
}

/// `theta1` is θ₁, `x` with an index 2 is x₂.
pub(super) fn symbol(notation: Notation, name: &str, index: &str, dots: usize) -> Symbol {
    let base = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let (base, mut lower) = if base.is_empty() { (name, "") } else { name.split_at(base.len()) };
    let base = if lower.is_empty() { base } else { base.trim_end_matches('_') };
    let joined = format!("{lower},{index}");
    if !index.is_empty() {
        lower = if lower.is_empty() { index } else { &joined };
    }
    let greek = GREEK.iter().find(|(spelled, _)| *spelled == base).map(|&(_, letter)| letter);
    match notation {
        Notation::Unicode => unicode(greek.unwrap_or(base), lower, dots),
        Notation::Latex => latex(base, greek.is_some(), lower, dots),
    }
}

fn unicode(base: &str, lower: &str, dots: usize) -> Symbol {
    let is_word = base.chars().nth(1).is_some();
    let mark = match (dots, is_word) {
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
    let lower = if lower.chars().all(|c| c.is_ascii_digit() || c == ',') {
        lower.chars().map(digit).collect()
    } else {
        format!("[{lower}]")
    };
    Symbol { text: format!("{base}{mark}{lower}"), is_word }
}

fn latex(base: &str, is_greek: bool, lower: &str, dots: usize) -> Symbol {
    let is_word = !is_greek && base.chars().nth(1).is_some();
    let (stem, rest) = match base.split_once('_') {
        Some((stem, rest)) if !stem.is_empty() && is_word => (stem, rest.replace('_', "\\_")),
        _ => (base, String::new()),
    };
    let stem = match (is_greek || GREEK.iter().any(|(spelled, _)| *spelled == stem), stem.len() > 1) {
        (true, _) => latex_letter(stem),
        (false, true) => format!("\\mathrm{{{}}}", stem.replace('_', "\\_")),
        (false, false) => stem.to_owned(),
    };
    let stem = match dots {
        0 => stem,
        1 => format!("\\dot{{{stem}}}"),
        _ => format!("\\ddot{{{stem}}}"),
    };
    let lower = match (rest.is_empty(), lower.is_empty()) {
        (true, true) => return Symbol { text: stem, is_word },
        (true, false) => lower.to_owned(),
        (false, true) => format!("\\mathrm{{{rest}}}"),
        (false, false) => format!("\\mathrm{{{rest}}},{lower}"),
    };
    Symbol { text: format!("{stem}_{{{lower}}}"), is_word }
}

fn latex_letter(spelled: &str) -> String {
    format!("\\{}", if spelled == "eps" { "epsilon" } else { spelled })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_symbols() {
        let cases = [
            ("theta", "", 0, "θ", "\\theta"),
            ("theta", "0", 2, "θ\u{308}₀", "\\ddot{\\theta}_{0}"),
            ("x1", "", 1, "x\u{307}₁", "\\dot{x}_{1}"),
            ("mass", "", 0, "mass", "\\mathrm{mass}"),
            ("precession", "", 1, "precession′", "\\dot{\\mathrm{precession}}"),
            ("cart_mass", "", 0, "cart_mass", "\\mathrm{cart}_{\\mathrm{mass}}"),
            ("m", "0,1", 0, "m₀,₁", "m_{0,1}"),
            ("omega_2", "", 0, "ω₂", "\\omega_{2}"),
        ];
        for (name, index, dots, plain, formula) in cases {
            assert_eq!(symbol(Notation::Unicode, name, index, dots).text, plain);
            assert_eq!(symbol(Notation::Latex, name, index, dots).text, formula);
        }
    }
}
