//! The implementation of the runtime's `Smooth`: Taylor coefficients of the motion.
//!
//! | function | what it computes |
//! | --- | --- |
//! | `jet_constants` | parameters alone, once per run: hoisted values, inverses and factorisations of constant blocks |
//! | `jet_at` | values and the factorisation at the point of expansion, then one pass of a loop for each order |

mod convolutions;
mod inertia;
mod order;
mod saddle;
mod solution;
mod start;
mod terms;
mod wide;

use super::Emission;
use super::body;
use super::gather::gather;
use super::names::{Names, describe};
use super::scalar;
use super::turning;
use crate::expr::Variable;
use crate::jets::{Jets, Value};
use crate::schedule::{Instruction, Slot};
use inertia::Inertia;
use start::Start;
use wide::Wide;

/// Rows of the tables are padded to a multiple of this many lanes.
const WIDTH: usize = 4;

/// The items of the trait, as text.
pub(super) fn jets(emission: &mut Emission<'_>, jets: &Jets) -> String {
    label_auxiliaries(emission, jets);
    let inertia = Inertia::plan(emission, jets);
    let mut names = Names::new(emission.model);
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let hoisted = jets.program.hoisted();
    let (labels, fixed) = body::constants(model, scalar, &jets.program, &hoisted, &mut names);
    let mut start = Start::new(model, scalar, jets, &hoisted, &labels);
    let values = start.values(&mut names);
    let mass = inertia.at_start(model, scalar, jets, &start, &mut names);
    let mut reads = start.reads.clone();
    reads.join(&mass.reads);
    let wide = (jets.lanes.len() > convolutions::EDGED).then(|| Wide::of(emission.model, jets, &start));
    let pass = order::pass(emission, jets, &start, &mass, wide.as_ref(), &mut names);

    let mut text =
        turning::entry(emission) + &body::prologue(model, scalar, &reads, super::body::Source::Slices);
    let all: Vec<String> = labels.iter().chain(&mass.labels).cloned().collect();
    let (constants_type, constants_body) = inertia.constants(model, scalar, &fixed);
    if !all.is_empty() {
        let place = if inertia.factored() > 0 { "constants.0" } else { "*constants" };
        text.push_str(&format!("let [{}] = {place};\n", all.join(", ")));
    }
    text.push_str(&values);
    text.push_str(&mass.statements);
    text.push_str(&pass);

    let tables = match &wide {
        Some(wide) => format!("Columns<{scalar}, {}, ORDERS>", wide.columns),
        None => format!("Tables<{scalar}, {}, ORDERS>", jets.lanes.len().next_multiple_of(WIDTH)),
    };
    let items = wide.as_ref().map(Wide::items).unwrap_or_default();
    let (vector, inputs, count) = (emission.vector_type(), emission.input_type(), emission.count());
    let words: std::collections::BTreeSet<&str> =
        text.split(|c: char| c != '_' && !c.is_alphanumeric()).collect();
    let named = |name: &str| if words.contains(name) { name.to_owned() } else { format!("_{name}") };
    // Types are spelled out: where the trait cannot be found, `Self::Tables` would be a second error.
    format!(
        "{}type JetConstants = {constants_type};\n\
         type Tables<const ORDERS: usize> = lagrange::{tables};\n\
         #[inline]\nfn jet_constants(&self) -> {constants_type} {{\n{constants_body}\n}}\n\
         #[inline]\nfn jet_at<const ORDERS: usize>(\n&self, {}: &{constants_type}, {}: {scalar}, {}: &{vector}, {}: &{vector}, \
         {}: &{inputs}, h: {scalar}, orders: usize, {}: &mut lagrange::{tables}, \
         series: &mut lagrange::Series<{scalar}, {count}, ORDERS>,\n) -> bool {{\n{items}{}\n}}\n",
        if jets.is_steep { "const STEEP: bool = true;\n" } else { "" },
        named("constants"),
        named("t"),
        named("q"),
        named("v"),
        named("u"),
        named("tables"),
        body::imported(gather(&text)),
    )
}

/// Gives the auxiliaries names from what they are functions of.
fn label_auxiliaries(emission: &mut Emission<'_>, jets: &Jets) {
    let index = |slot: Slot| match jets.program.instruction(slot) {
        Instruction::Variable(Variable::Auxiliary(index)) => index as usize,
        _ => 0,
    };
    let count = jets.auxiliaries.iter().map(|series| index(series.slot) + 1).max().unwrap_or(0);
    emission.model.locals.auxiliaries = (0..count).map(|index| format!("y{index}")).collect();
    for &slot in &jets.order {
        let Some(series) = jets.auxiliary(slot) else { continue };
        let of = |x: Slot| describe(emission.model, &jets.program, x, 0).unwrap_or_else(|| "x".to_owned());
        let label = match series.value {
            Value::Unary(function, x) => format!("{}_{}", function.name(), of(x)),
            Value::Binary(function, x, y) => format!("{}_{}_{}", function.name(), of(x), of(y)),
            Value::Same(x) => of(x),
            Value::Power(x, exponent) => match exponent.0 {
                1 => format!("root_{}", of(x)),
                -2 => format!("inverse_{}", of(x)),
                _ => format!("power_{}", of(x)),
            },
        };
        emission.model.locals.auxiliaries[index(slot)] = label;
    }
}

/// `let name: type = value;`
fn binding(scalar: &crate::syntax::Scalar, name: &str, value: &str) -> String {
    format!("let {name}: {scalar} = {};\n", bare(value))
}

/// A text without the parentheses around the whole of it.
fn bare(value: &str) -> &str {
    let Some(inner) = value.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) else { return value };
    let mut depth = 0_i32;
    for c in inner.chars() {
        depth += i32::from(c == '(') - i32::from(c == ')');
        if depth < 0 {
            return value;
        }
    }
    inner
}

/// A number of either sign as an expression of the scalar type.
fn number(scalar: &crate::syntax::Scalar, value: crate::number::Number) -> String {
    let text = scalar::literal(scalar, value.abs(), false);
    if value.is_negative() { format!("(-{text})") } else { text }
}
