//! Function bodies: variables taken apart, statements, result.

use super::Emission;
use super::block::{self, Block, Element, Known, Reads, Values, are_named};
use super::names::{Names, variable_label};
use super::tokens::placeholder;
use crate::expr::{NodeId, Variable};
use crate::model::Model;
use crate::schedule::{Program, Slot, plan};
use crate::simplify::simplify;
use crate::syntax::Scalar;

/// The variables that a body is made of.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    /// `state`, and `inputs` if it has any.
    State,
    /// References `q`, `v`, `u` and the value `t`.
    Slices,
    /// `q`, `v`, `u` and `t` of numbers of another kind. `__number` turns the parameters in `__in_regime`
    /// into such numbers.
    Numbers,
}

/// A body that computes some nodes from scratch, parameters included.
pub(super) fn plain(
    model: &Model,
    scalar: &Scalar,
    roots: &[NodeId],
    source: Source,
    result: impl FnOnce(&Values) -> String,
) -> String {
    let program = plan(&model.graph, roots);
    let mut names = Names::new(model);
    let block = block::write(model, scalar, &program, &program.outputs, &[], &mut names);
    let mut text = prologue(model, scalar, &block.reads, source);
    text.push_str(&assemble(&block));
    text.push_str(&result(&block.outputs));
    imported(text)
}

/// A body that computes some nodes from a state. The nodes are simplified first.
pub(super) fn simplified(
    emission: &mut Emission<'_>,
    nodes: &[NodeId],
    result: impl FnOnce(&Values) -> String,
) -> String {
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, nodes);
    plain(emission.model, &emission.scalar, &nodes, Source::Slices, result)
}

/// The body that computes the part of a program that depends on parameters alone.
pub(super) fn constants(model: &Model, scalar: &Scalar, program: &Program, hoisted: &[Slot]) -> Block {
    block::write(model, scalar, program, hoisted, &[], &mut Names::new(model))
}

/// The most constants that get names. More of them stay in their array.
const MOST_LABELS: usize = 64;

/// The texts of the constants in a body, and the statement that takes them apart. `factored` tells whether
/// factorisations stand beside them.
pub(super) fn labels(
    model: &Model,
    program: &Program,
    hoisted: &[Slot],
    factored: bool,
    names: &mut Names,
) -> (String, Vec<Known>) {
    let (array, value) = if factored { ("constants.0", "constants.0") } else { ("constants", "*constants") };
    if hoisted.len() > MOST_LABELS {
        let element = |(index, &slot): (usize, &Slot)| {
            let (array, length) = (array.to_owned(), hoisted.len());
            Known::element(slot, Element { array, length, index: index as i64 }, 0)
        };
        return (String::new(), hoisted.iter().enumerate().map(element).collect());
    }
    let label =
        |&slot: &Slot| Known::named(slot, names.claim(super::names::describe(model, program, slot, 0)));
    let known: Vec<Known> = hoisted.iter().map(label).collect();
    let labels: Vec<&str> = known.iter().map(|known| known.text.as_str()).collect();
    let statement = format!("let [{}] = {value};\n", labels.join(", "));
    (if labels.is_empty() { String::new() } else { statement }, known)
}

/// Statements, a line each.
pub(super) fn assemble(block: &Block) -> String {
    block.statements.iter().map(|statement| format!("{statement}\n")).collect()
}

/// The most rows of a matrix that is filled in line. Larger ones are filled row by row, each by a function of
/// its own, since the compiler's vectoriser takes quadratic time for thousands of statements in a row.
const OUTLINED: usize = 32;

/// Statements that fill `mass` with a lower triangle, given row by row.
pub(super) fn lower_triangle(scalar: &Scalar, count: usize, entries: &[String]) -> String {
    let zero = super::scalar::zero(scalar);
    let mut text = format!("let mut mass = [[{zero}; {count}]; {count}];\n");
    let mut entries = entries.iter();
    for row in 0..count {
        let filled: Vec<(usize, &String)> =
            (0..=row).zip(entries.by_ref()).filter(|(_, entry)| **entry != zero).collect();
        if count <= OUTLINED {
            for (column, entry) in filled {
                text.push_str(&format!("mass[{row}][{column}] = {entry};\n"));
            }
            continue;
        }
        text.push_str(&format!(
            "mass[{row}] = lagrange::solve::outlined(move || {{\nlet mut row = [{zero}; {count}];\n"
        ));
        for (column, entry) in filled {
            text.push_str(&format!("row[{column}] = {entry};\n"));
        }
        text.push_str("row\n});\n");
    }
    text
}

/// A body with the import of the scalar's trait, if it calls functions of the scalar.
pub(super) fn imported(text: String) -> String {
    if text.contains("Real::") { format!("use lagrange::Real;\n{text}") } else { text }
}

/// The statements that take the variables apart. Variables that are not read get no name.
pub(super) fn prologue(model: &Model, scalar: &Scalar, reads: &Reads, source: Source) -> String {
    let (q, v, u) = match source {
        Source::State => ("state.q", "state.v", "*inputs"),
        Source::Slices | Source::Numbers => ("*q", "*v", "*u"),
    };
    let mut text = take_apart(model, &reads.coordinates, Variable::Coordinate, "q", q, source);
    text.push_str(&take_apart(model, &reads.velocities, Variable::Velocity, "v", v, source));
    let (a, place) = ("accelerations", "*accelerations");
    text.push_str(&take_apart(model, &reads.accelerations, Variable::Acceleration, a, place, source));
    text.push_str(&take_apart(model, &reads.inputs, Variable::Input, "u", u, source));
    for (place, read) in
        reads.entries.as_chunks::<9>().0.iter().enumerate().filter(|(_, read)| read.contains(&true))
    {
        let name = |i: usize| if read[i] { model.locals.entries[9 * place + i].as_str() } else { "_" };
        let rows = [0, 3, 6].map(|i| format!("[{}, {}, {}]", name(i), name(i + 1), name(i + 2)));
        let first = model.orientations[place];
        text.push_str(&format!("let [{}] = lagrange::attitude::axes(q, {first});\n", rows.join(", ")));
    }
    if reads.time && matches!(source, Source::State) {
        text.push_str("let t = state.t;\n");
    }
    text + &given(model, scalar, reads, source)
}

/// A local variable for each parameter that is read. So the user's expression, with its span, stands once in
/// a body, and a wrong type is one error on that expression.
pub(super) fn parameters(model: &Model, scalar: &Scalar, reads: &Reads) -> String {
    given(model, scalar, reads, Source::Slices)
}

fn given(model: &Model, scalar: &Scalar, reads: &Reads, source: Source) -> String {
    let read = reads.parameters.iter().enumerate().filter(|(_, read)| **read);
    read.map(|(i, _)| {
        let name = &model.locals.parameters[i];
        match source {
            Source::State | Source::Slices => format!("let {name}: {scalar} = {};\n", placeholder(i as u32)),
            Source::Numbers => format!("let {name}: {scalar} = __number(__in_regime.parameters[{i}]);\n"),
        }
    })
    .collect()
}

/// `let [x, _, z] = place;`, or a short name for a place with many components.
fn take_apart(
    model: &Model,
    read: &[bool],
    variable: fn(u32) -> Variable,
    short: &str,
    place: &str,
    source: Source,
) -> String {
    match (read.contains(&true), !are_named(model, read.len()), source) {
        (false, ..) | (true, true, Source::Slices | Source::Numbers) => String::new(),
        (true, true, Source::State) => format!("let {short} = &{place};\n"),
        (true, false, _) => {
            let name = |(i, &read): (usize, &bool)| {
                if read { variable_label(model, variable(i as u32)) } else { "_".to_owned() }
            };
            let names: Vec<String> = read.iter().enumerate().map(name).collect();
            format!("let [{}] = {place};\n", names.join(", "))
        }
    }
}
