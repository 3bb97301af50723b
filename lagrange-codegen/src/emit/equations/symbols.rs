//! Names as symbols: Greek letters, indices, dots of time derivatives.

use crate::model::{Model, Parameter};

/// A symbol, before it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Symbol {
    Name {
        /// The name without its last digits.
        base: String,
        /// Digits and indices.
        index: String,
        /// The number of time derivatives.
        dots: usize,
    },
    /// The multiplier of a constraint.
    Multiplier { constraint: String, index: String },
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

/// The Greek letter of a spelled name.
pub(super) fn greek(name: &str) -> Option<&'static str> {
    GREEK.iter().find(|(spelled, _)| *spelled == name).map(|&(_, letter)| letter)
}

impl Symbol {
    /// Whether the symbol is a word, which needs a sign between it and its neighbours.
    pub fn is_word(&self) -> bool {
        match self {
            Symbol::Name { base, .. } => greek(base).is_none() && base.chars().nth(1).is_some(),
            Symbol::Multiplier { .. } => false,
        }
    }
}

/// A name where subscripts can hold words: `cart_mass` is a cart with the subscript mass.
pub(super) fn stem(base: &str) -> (&str, &str) {
    match base.split_once('_') {
        Some((stem, rest)) if !stem.is_empty() && greek(base).is_none() => (stem, rest),
        _ => (base, ""),
    }
}

/// A coordinate with a dot for each time derivative.
pub(super) fn coordinate(model: &Model, i: u32, dots: usize) -> Symbol {
    let quantity = &model.coordinates[i as usize];
    symbol(&quantity.name, &index(quantity.index), dots)
}

/// An input.
pub(super) fn input(model: &Model, i: u32) -> Symbol {
    let quantity = &model.inputs[i as usize];
    symbol(&quantity.name, &index(quantity.index), 0)
}

/// The multiplier of a constraint.
pub(super) fn multiplier(model: &Model, i: u32) -> Symbol {
    let constraint = &model.constraints[i as usize];
    Symbol::Multiplier { constraint: constraint.name.clone(), index: index(constraint.index) }
}

/// A parameter: `self.m[0]` is m₀.
pub(super) fn parameter(parameter: &Parameter) -> Symbol {
    let path = parameter.path.strip_prefix("self.").unwrap_or(&parameter.path);
    let is_plain = |c: char| c.is_alphanumeric() || "_.[]".contains(c);
    let path = if path.chars().all(is_plain) { path } else { parameter.label.as_str() };
    let (base, indices) = match path.find('[') {
        Some(place) => (&path[..place], path[place..].replace("][", ",").replace(['[', ']'], "")),
        None => (path, String::new()),
    };
    symbol(base, &indices, 0)
}

fn index(index: Option<usize>) -> String {
    index.map_or_else(String::new, |index| index.to_string())
}

/// `theta1` is θ₁, `x` with an index 2 is x₂.
pub(super) fn symbol(name: &str, index: &str, dots: usize) -> Symbol {
    let base = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let (base, digits) = if base.is_empty() { (name, "") } else { name.split_at(base.len()) };
    let base = if digits.is_empty() { base } else { base.trim_end_matches('_') };
    let index = [digits, index].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(",");
    Symbol::Name { base: base.to_owned(), index, dots }
}

#[cfg(test)]
mod tests {
    use super::super::{latex, mathml, unicode};
    use super::*;

    #[test]
    fn names_become_symbols() {
        let cases = [
            ("theta", "", 0, "θ", "\\theta", "<mi>θ</mi>"),
            (
                "theta",
                "0",
                2,
                "θ\u{308}₀",
                "\\ddot{\\theta}_{0}",
                "<msub><mover accent=\"true\"><mi>θ</mi><mo>¨</mo></mover><mn>0</mn></msub>",
            ),
            (
                "x1",
                "",
                1,
                "x\u{307}₁",
                "\\dot{x}_{1}",
                "<msub><mover accent=\"true\"><mi>x</mi><mo>˙</mo></mover><mn>1</mn></msub>",
            ),
            ("mass", "", 0, "mass", "\\mathrm{mass}", "<mi>mass</mi>"),
            (
                "precession",
                "",
                1,
                "precession′",
                "\\dot{\\mathrm{precession}}",
                "<mover accent=\"true\"><mi>precession</mi><mo>˙</mo></mover>",
            ),
            (
                "cart_mass",
                "",
                0,
                "cart_mass",
                "\\mathrm{cart}_{\\mathrm{mass}}",
                "<msub><mi>cart</mi><mi>mass</mi></msub>",
            ),
            (
                "m",
                "0,1",
                0,
                "m₀,₁",
                "m_{0,1}",
                "<msub><mi>m</mi><mrow><mn>0</mn><mo separator=\"true\">,</mo><mn>1</mn></mrow></msub>",
            ),
            ("omega_2", "", 0, "ω₂", "\\omega_{2}", "<msub><mi>ω</mi><mn>2</mn></msub>"),
        ];
        for (name, index, dots, plain, formula, element) in cases {
            let symbol = symbol(name, index, dots);
            assert_eq!(unicode::symbol(&symbol), plain);
            assert_eq!(latex::symbol(&symbol), formula);
            assert_eq!(mathml::symbol(&symbol), element);
        }
    }
}
