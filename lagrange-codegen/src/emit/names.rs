//! Names for intermediate results, made from the user's own.

use std::collections::BTreeSet;

use crate::expr::{Unary, Variable};
use crate::model::{Constraint, Locals, Model, Parameter, Quantity};
use crate::schedule::{Instruction, Program, Slot};

/// The most characters of a name that describes an expression. Longer ones are numbered instead.
const LONGEST: usize = 26;

/// The most characters of a suffix of such a name, as in `theta_partial`.
const SUFFIX: usize = 16;

/// Names that generated bodies use otherwise, beside those that begin with two underscores. `tests/names.rs`
/// finds those that are missing.
const RESERVED: &[&str] = &[
    "state",
    "inputs",
    "constants",
    "accelerations",
    "matrices",
    "screws",
    "residual",
    "place",
    "multipliers",
    "linearization",
    "mass",
    "gradients",
    "saddle",
    "balance",
    "row",
    "factor",
    "force",
    "q",
    "v",
    "t",
    "u",
    "h",
    "rate",
    "index",
    "i",
    "list",
    "order",
    "orders",
    "inner",
    "products",
    "reactions",
    "tables",
    "series",
    "left",
    "right",
    "coupling",
    "active",
    "shares",
    "forces",
    "gamma",
    "functions",
    "low",
    "high",
    "sum",
    "sums",
    "rows",
    "take",
    "named",
    "p",
    "rates",
    "coordinates",
    "velocities",
    "described",
    "weights",
    "path",
    "shift",
    "time",
    "energy",
    "doubt",
    "error",
    "f64",
    "f32",
    "self",
    "Self",
];

/// Gives each name once.
pub(super) struct Names {
    taken: BTreeSet<String>,
    anonymous: usize,
}

impl Names {
    /// All names are free but the reserved ones and those of coordinates, velocities, accelerations, inputs,
    /// parameters and multipliers.
    pub fn new(model: &Model) -> Names {
        let mut names = Names { taken: RESERVED.iter().map(|&name| name.to_owned()).collect(), anonymous: 0 };
        let Locals { coordinates, velocities, accelerations, inputs, parameters, multipliers, .. } =
            &model.locals;
        let states = coordinates.iter().chain(velocities).chain(accelerations);
        names.taken.extend(states.chain(inputs).chain(parameters).chain(multipliers).cloned());
        names
    }

    /// A free name, as close to the wish as possible.
    pub fn claim(&mut self, wish: Option<String>) -> String {
        let wish = wish
            .map(|wish| identifier(&wish))
            .filter(|wish| !wish.is_empty() && wish.len() <= LONGEST + SUFFIX);
        let base = match wish {
            Some(wish) => {
                if !self.taken.contains(&wish) && !is_keyword(&wish) {
                    self.taken.insert(wish.clone());
                    return wish;
                }
                wish
            }
            None => {
                self.anonymous += 1;
                let name = format!("w{}", self.anonymous);
                if self.taken.insert(name.clone()) {
                    return name;
                }
                name
            }
        };
        let free = (2..).map(|n| format!("{base}_{n}")).find(|name| !self.taken.contains(name));
        let name = free.unwrap_or(base);
        self.taken.insert(name.clone());
        name
    }
}

/// The local names of all variables: the user's own if possible, no two alike, and none that a body uses
/// otherwise.
pub(super) fn locals(model: &Model, least: usize) -> Locals {
    let mut taken: BTreeSet<String> = RESERVED.iter().map(|&name| name.to_owned()).collect();
    let mut claim = |label: String| {
        let label = label.trim_start_matches("__").to_owned();
        // In a pattern, a constant's name would be compared with instead of bound.
        let label = if label.chars().any(char::is_lowercase) { label } else { label.to_lowercase() };
        let free = |name: &String| !taken.contains(name) && !is_keyword(name);
        let numbered = (2..).map(|n| format!("{label}_{n}"));
        let name = std::iter::once(label.clone()).chain(numbered).find(free).unwrap_or(label);
        taken.insert(name.clone());
        name
    };
    let coordinates: Vec<String> = model.coordinates.iter().map(|quantity| claim(quantity.label())).collect();
    let velocities =
        model.coordinates.iter().map(|quantity| claim(format!("{}_dot", quantity.label()))).collect();
    let inputs = model.inputs.iter().map(|quantity| claim(quantity.label())).collect();
    let entries = model.orientations.iter().flat_map(|&first| {
        let label = model.coordinates[first].label();
        (0..9).map(move |place| format!("{label}_axes_{}{}", place / 3, place % 3))
    });
    let entries = entries.collect::<Vec<_>>().into_iter().map(&mut claim).collect();
    let label = |parameter: &Parameter| claim(identifier(&parameter.label));
    let parameters = model.parameters.iter().map(label).collect();
    let accelerations = Vec::new();
    let multiplier = |constraint: &Constraint| claim(format!("{}_multiplier", constraint.label()));
    let multipliers = model.constraints.iter().map(multiplier).collect();
    Locals {
        coordinates,
        velocities,
        accelerations,
        inputs,
        parameters,
        entries,
        auxiliaries: Vec::new(),
        multipliers,
        least,
    }
}

/// Gives names to the accelerations, too, for bodies that take them.
pub(super) fn name_accelerations(model: &mut Model) {
    let mut names = Names::new(model);
    let claim = |quantity: &Quantity| names.claim(Some(format!("{}_ddot", quantity.label())));
    model.locals.accelerations = model.coordinates.iter().map(claim).collect();
}

/// The local name of a variable.
pub(super) fn variable_label(model: &Model, variable: Variable) -> String {
    match variable {
        Variable::Coordinate(i) => model.locals.coordinates[i as usize].clone(),
        Variable::Velocity(i) => model.locals.velocities[i as usize].clone(),
        Variable::Acceleration(i) => model.locals.accelerations[i as usize].clone(),
        Variable::Time => "t".to_owned(),
        Variable::Input(i) => model.locals.inputs[i as usize].clone(),
        Variable::Parameter(i) => model.locals.parameters[i as usize].clone(),
        Variable::Auxiliary(i) => model.locals.auxiliaries[i as usize].clone(),
        Variable::Entry(i) => model.locals.entries[i as usize].clone(),
        Variable::Position(i) => format!("r{i}"),
        Variable::Multiplier(i) => model.locals.multipliers[i as usize].clone(),
    }
}

/// The name of what an instruction computes. `None` where nothing names it, or the name would be too long.
pub(super) fn describe(model: &Model, program: &Program, slot: Slot, depth: u32) -> Option<String> {
    // A sine or cosine is named by its angle.
    let is_trigonometric = matches!(program.instruction(slot), Instruction::Unary(Unary::Sin | Unary::Cos, a) if program.instruction(a).is_leaf());
    if let Some(node) = program.source(slot)
        && !is_trigonometric
        && let Some(hint) = model.hints.name(node)
    {
        return Some(hint.to_owned());
    }
    let of = |slot: Slot| if depth > 3 { None } else { describe(model, program, slot, depth + 1) };
    let name = match program.instruction(slot) {
        Instruction::Variable(variable) => variable_label(model, variable),
        Instruction::Literal(number) => number.as_integer().filter(|&n| (0..1000).contains(&n))?.to_string(),
        Instruction::Add(a, b) => format!("{}_plus_{}", of(a)?, of(b)?),
        Instruction::Sub(a, b) => format!("{}_minus_{}", of(a)?, of(b)?),
        Instruction::Mul(a, b) if a == b => format!("{}_squared", of(a)?),
        Instruction::Mul(a, b) => format!("{}_{}", of(a)?, of(b)?),
        Instruction::Div(a, b) => match program.instruction(a) {
            Instruction::Literal(one) if one.is_one() => format!("inverse_{}", of(b)?),
            _ => format!("{}_over_{}", of(a)?, of(b)?),
        },
        Instruction::Recip(a) => format!("inverse_{}", of(a)?),
        Instruction::MulAdd(..) | Instruction::Given(_) => return None,
        Instruction::Neg(a) => format!("minus_{}", of(a)?),
        Instruction::Sqrt(a) => format!("root_{}", of(a)?),
        Instruction::Unary(function, a) => format!("{}_{}", function.name(), of(a)?),
        Instruction::Binary(function, a, b) => format!("{}_{}_{}", function.name(), of(a)?, of(b)?),
    };
    (name.len() <= LONGEST).then_some(name)
}

/// A name for an array, from the name of one of its elements.
pub(super) fn without_number(name: &str) -> String {
    let is_number = |word: &&str| !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_digit());
    name.split('_').filter(|word| !is_number(word)).collect::<Vec<_>>().join("_")
}

/// The wish, with each character replaced that an identifier cannot have.
fn identifier(wish: &str) -> String {
    let mut name = String::with_capacity(wish.len());
    for c in wish.chars() {
        if c == '_' || c.is_alphanumeric() {
            name.push(c);
        } else if !name.ends_with('_') {
            name.push('_');
        }
    }
    let name = name.trim_matches('_');
    if name.starts_with(|c: char| c.is_numeric()) { format!("n{name}") } else { name.to_owned() }
}

fn is_keyword(name: &str) -> bool {
    syn::parse_str::<syn::Ident>(name).is_err()
}
