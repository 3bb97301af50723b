//! The implementation of the runtime's `System`: what the integrators call.

use super::Emission;
use super::block;
use super::body::{self, Source};
use super::names::Names;
use super::parts::{Kind, Part};
use crate::expr::NodeId;
use crate::schedule::{Operations, Program, Slot, plan};
use crate::simplify::simplify;

/// The trait's items as text, and the operations of one evaluation of the accelerations.
pub(super) fn system(emission: &mut Emission<'_>) -> (String, Operations) {
    let parts = Part::all(emission);
    let mut nodes: Vec<NodeId> = Vec::new();
    parts.iter().cloned().for_each(|part| {
        part.map(|node| nodes.push(node));
    });
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let mut program = plan(&emission.model.graph, &nodes);
    let mut slots = program.outputs.clone().into_iter();
    let mut next = || slots.next().expect("emit: as many slots as nodes");
    let parts: Vec<Part<Slot>> = parts.into_iter().map(|part| part.map(|_| next())).collect();
    // Entries that are factored once per run are no outputs of a step.
    program.outputs = parts.iter().flat_map(per_step).collect();

    let mut names = Names::new(emission.model);
    let hoisted = program.hoisted();
    let (labels, constants) = constants(emission, &program, &hoisted, &parts, &mut names);
    let accelerations = accelerations(emission, &program, &hoisted, &labels, parts, &mut names);
    let energy = simplify(&mut emission.model.graph, &mut emission.model.hints, &[emission.equations.energy]);
    let energy = body::plain(emission.model, &emission.item.scalar, &energy, Source::Slices, |v| v.join(", "));

    let scalar = &emission.item.scalar;
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let named = |body: &str, name: &str| if mentions(body, name) { name.to_owned() } else { format!("_{name}") };
    let arguments = |body: &str| {
        format!(
            "&self, {}: &Self::Constants, {}: {scalar}, {}: &{vector}, {}: &{vector}",
            named(body, "constants"),
            named(body, "t"),
            named(body, "q"),
            named(body, "v"),
        )
    };
    let text = format!(
        "type Scalar = {scalar};\ntype Constants = {};\n\
         #[inline]\nfn constants(&self) -> Self::Constants {{\n{}\n}}\n\
         #[inline]\nfn accelerations_at({}, {}: &{inputs}) -> ::core::result::Result<{vector}, lagrange::Cause> \
         {{\n{accelerations}\n}}\n\
         #[inline]\nfn energy_at({}) -> {scalar} {{\n{energy}\n}}\n",
        constants.0,
        constants.1,
        arguments(&accelerations),
        named(&accelerations, "u"),
        arguments(&energy),
    );
    (text, program.operations(false))
}

fn per_step(part: &Part<Slot>) -> Vec<Slot> {
    let mut slots: Vec<Slot> = part.pivots.iter().flat_map(|&(_, value, scale)| [value, scale]).collect();
    if !part.factored_once() {
        slots.extend(&part.entries);
    }
    slots.extend(&part.results);
    slots
}

/// Names of the hoisted values, and the type and body of the constants: an array of scalars,
/// then the factorisations of constant blocks.
fn constants(
    emission: &Emission<'_>,
    program: &Program,
    hoisted: &[Slot],
    parts: &[Part<Slot>],
    names: &mut Names,
) -> (Vec<String>, (String, String)) {
    let (model, scalar) = (&*emission.model, &emission.item.scalar);
    let (labels, fixed) = body::constants(model, scalar, program, hoisted, names);
    let mut types = vec![format!("[{scalar}; {}]", hoisted.len())];
    let mut values = vec![format!("[{}]", fixed.outputs.join(", "))];
    for part in parts.iter().filter(|part| part.factored_once()) {
        let Kind::Runtime { factor, .. } = part.kind else { continue };
        let written = block::write(model, scalar, program, &part.entries, &[], &mut Names::new(model));
        let entries = Part { pivots: Vec::new(), entries: written.outputs.clone(), results: Vec::new(), ..part.clone().map(|_| String::new()) };
        types.push(format!(
            "::core::result::Result<lagrange::{factor}<{scalar}, {}>, lagrange::Cause>",
            part.coordinates.len()
        ));
        values.push(format!("{{\n{}{}\n}}", body::assemble(&written), factorisation(emission, &entries)));
    }
    let tuple = |items: &[String]| match items {
        [single] => single.clone(),
        _ => format!("({})", items.join(", ")),
    };
    let text = body::imported(format!("{}{}", body::assemble(&fixed), tuple(&values)));
    (labels, (tuple(&types), text))
}

fn accelerations(
    emission: &Emission<'_>,
    program: &Program,
    hoisted: &[Slot],
    labels: &[String],
    parts: Vec<Part<Slot>>,
    names: &mut Names,
) -> String {
    let (model, scalar) = (&*emission.model, &emission.item.scalar);
    let given: Vec<(Slot, String)> = hoisted.iter().copied().zip(labels.iter().cloned()).collect();
    let written = block::write(model, scalar, program, &program.outputs, &given, names);
    let once = parts.iter().any(Part::factored_once);
    let mut text = body::prologue(model, &written.reads, Source::Slices);
    if !labels.is_empty() {
        text.push_str(&format!("let [{}] = {};\n", labels.join(", "), if once { "constants.0" } else { "*constants" }));
    }
    text.push_str(&body::assemble(&written));

    let mut outputs = written.outputs.into_iter();
    let mut next = || outputs.next().expect("emit: as many texts as slots");
    let mut solution = vec![String::new(); emission.count()];
    let mut factored = 0;
    for mut part in parts {
        if part.factored_once() {
            factored += 1;
            part.entries.clear();
        }
        let once = part.factored_once();
        let part = part.map(|_| next());
        for (coordinate, value, scale) in &part.pivots {
            text.push_str(&format!("lagrange::solve::pivot({value}, {scale}, {coordinate})?;\n"));
        }
        let Kind::Runtime { .. } = part.kind else {
            for (&coordinate, value) in part.coordinates.iter().zip(part.results) {
                solution[coordinate] = value;
            }
            continue;
        };
        let factor = if once { format!("constants.{factored}?") } else { format!("{}?", factorisation(emission, &part)) };
        let results: Vec<String> =
            part.coordinates.iter().map(|&i| names.claim(Some(format!("{}_ddot", model.coordinates[i].label())))).collect();
        text.push_str(&format!(
            "let [{}] = {factor}.solve([{}]);\n",
            results.join(", "),
            part.results.join(", ")
        ));
        for (&coordinate, name) in part.coordinates.iter().zip(results) {
            solution[coordinate] = name;
        }
    }
    text.push_str(&format!("::core::result::Result::Ok([{}])", solution.join(", ")));
    body::imported(text)
}

/// The call that factors a block, with its entries filled in.
fn factorisation(emission: &Emission<'_>, part: &Part<String>) -> String {
    let Kind::Runtime { function, .. } = part.kind else { return String::new() };
    let zero = super::scalar::zero(&emission.item.scalar);
    let count = part.coordinates.len();
    let mut text = format!("{{\nlet mut mass = [[{zero}; {count}]; {count}];\n");
    let mut entries = part.entries.iter();
    for row in 0..count {
        for column in 0..=row {
            if let Some(entry) = entries.next()
                && *entry != zero
            {
                text.push_str(&format!("mass[{row}][{column}] = {entry};\n"));
            }
        }
    }
    let coordinates: Vec<String> = part.coordinates.iter().map(usize::to_string).collect();
    text.push_str(&format!("lagrange::solve::{function}(mass, &[{}])\n}}", coordinates.join(", ")));
    text
}

/// Whether a body mentions an identifier.
fn mentions(body: &str, name: &str) -> bool {
    body.split(|c: char| c != '_' && !c.is_alphanumeric()).any(|word| word == name)
}
