//! The implementation of the runtime's `System`, on which the integrators call.

use super::Emission;
use super::block;
use super::body::{self, Source};
use super::names::Names;
use super::parts::{Kind, Part};
use super::turning;
use crate::expr::NodeId;
use crate::schedule::{Operations, Program, Slot, plan};
use crate::simplify::simplify;
use crate::structure::Method;

/// A state from the arguments of the trait's functions, for the inherent methods.
const STATE: &str = "lagrange::State { t, q: *q, v: *v }";

/// The items of a system that has nothing to compute once per run.
pub(super) const NO_CONSTANTS: &str = "type Constants = ();\nfn constants(&self) {}\n";

/// The trait's items as text, and the operations of one evaluation of the accelerations.
pub(super) fn system(emission: &mut Emission<'_>) -> (String, Operations) {
    let parts = Part::all(emission);
    let mut nodes: Vec<NodeId> = Vec::new();
    for part in parts.iter().cloned() {
        part.map(|node| nodes.push(node));
    }
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let mut program = plan(&emission.model.graph, &nodes);
    let mut slots = program.outputs.clone().into_iter();
    let mut next = || slots.next().expect("emit: as many slots as nodes");
    let parts: Vec<Part<Slot>> = parts.into_iter().map(|part| part.map(|_| next())).collect();
    // A step does not compute the entries of blocks that are factored once per run.
    program.outputs = parts
        .iter()
        .flat_map(|part| part.entries.iter().filter(|_| !part.factored_once()).chain(&part.results))
        .copied()
        .collect();

    let mut names = Names::new(emission.model);
    let hoisted = program.hoisted();
    let (labels, constants) = constants(emission, &program, &hoisted, &parts, &mut names);
    let accelerations = accelerations(emission, &program, &hoisted, &labels, parts, &mut names);
    let check = check(emission);

    let scalar = &emission.scalar;
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let named =
        |body: &str, name: &str| if mentions(body, name) { name.to_owned() } else { format!("_{name}") };
    let arguments = |body: &str| {
        format!(
            "&self, {}: &Self::Constants, {}: {scalar}, {}: &{vector}, {}: &{vector}",
            named(body, "constants"),
            named(body, "t"),
            named(body, "q"),
            named(body, "v"),
        )
    };
    let method = emission.method();
    let names = super::names_of_parts(emission.model);
    let mut text = format!(
        "type Scalar = {scalar};\ntype Method = {method};\ntype Constants = {};\n\
         {names}\
         #[inline]\nfn constants(&self) -> Self::Constants {{\n{}\n}}\n\
         #[inline]\nfn accelerations_at({}, {}: &{inputs}) -> {vector} {{\n{accelerations}\n}}\n",
        constants.0,
        constants.1,
        arguments(&accelerations),
        named(&accelerations, "u"),
    );
    if let Some(check) = check {
        text.push_str(&format!(
            "fn check_at({}) -> ::core::result::Result<(), lagrange::Cause> {{\n{check}\n}}\n",
            arguments(&check)
        ));
    }
    text.push_str(&format!(
        "#[inline]\nfn energy_at(&self, _constants: &Self::Constants, t: {scalar}, q: &{vector}, v: &{vector}) -> {scalar} \
         {{\nself.energy(&{STATE})\n}}\n"
    ));
    (text, program.operations(false))
}

/// Names of the values that are computed once per run, and the type and body of the constants: an array of
/// scalars, then the factorisations of constant blocks.
fn constants(
    emission: &Emission<'_>,
    program: &Program,
    hoisted: &[Slot],
    parts: &[Part<Slot>],
    names: &mut Names,
) -> (Vec<String>, (String, String)) {
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let (labels, fixed) = body::constants(model, scalar, program, hoisted, names);
    let mut types = vec![format!("[{scalar}; {}]", hoisted.len())];
    let mut values = vec![format!("[{}]", fixed.outputs.join(", "))];
    for part in parts.iter().filter(|part| part.factored_once()) {
        let Kind::Runtime { factor, .. } = part.kind else { continue };
        let written = block::write(model, scalar, program, &part.entries, &[], &mut Names::new(model));
        types.push(format!(
            "::core::option::Option<lagrange::{factor}<{scalar}, {}>>",
            part.coordinates.len()
        ));
        let lower = body::lower_triangle(&emission.scalar, part.coordinates.len(), &written.outputs);
        let parameters = body::parameters(model, scalar, &written.reads);
        let statements = body::assemble(&written);
        values.push(format!("{{\n{parameters}{statements}{lower}lagrange::solve::factor(mass)\n}}"));
    }
    let tuple = |items: &[String]| match items {
        [single] => single.clone(),
        _ => format!("({})", items.join(", ")),
    };
    let parameters = body::parameters(model, scalar, &fixed.reads);
    let text = body::imported(format!("{parameters}{}{}", body::assemble(&fixed), tuple(&values)));
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
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let given: Vec<(Slot, String)> = hoisted.iter().copied().zip(labels.iter().cloned()).collect();
    let written = block::write(model, scalar, program, &program.outputs, &given, names);
    let once = parts.iter().any(Part::factored_once);
    let (entry, door) = turning::accelerations(emission);
    let mut text = entry + &body::prologue(model, scalar, &written.reads, Source::Slices);
    if !labels.is_empty() {
        let place = if once { "constants.0" } else { "*constants" };
        text.push_str(&format!("let [{}] = {place};\n", labels.join(", ")));
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
        let part = part.map(|_| next());
        let results = match part.kind {
            Kind::WrittenOut => part.results,
            Kind::Runtime { factor, constant } => {
                let count = part.coordinates.len();
                let factorisation = if constant {
                    format!("constants.{factored}")
                } else {
                    text.push_str(&body::lower_triangle(scalar, count, &part.entries));
                    format!("lagrange::solve::factor::<lagrange::{factor}<{scalar}, {count}>, _, _>(mass)")
                };
                let claim = |&i: &usize| names.claim(Some(format!("{}_ddot", model.coordinates[i].label())));
                let results: Vec<String> = part.coordinates.iter().map(claim).collect();
                text.push_str(&format!(
                    "let [{}] = lagrange::solve::solve(&{factorisation}, [{}]);\n",
                    results.join(", "),
                    part.results.join(", ")
                ));
                results
            }
        };
        for (&coordinate, result) in part.coordinates.iter().zip(results) {
            solution[coordinate] = result;
        }
    }
    text.push_str(&door(format!("[{}]", solution.join(", "))));
    body::imported(text)
}

/// The body that finds the singular block, if any block can be singular.
fn check(emission: &mut Emission<'_>) -> Option<String> {
    let mut nodes = Vec::new();
    let mut factored = String::new();
    let count = emission.count();
    for block in &emission.solution.blocks {
        let factor = match &block.method {
            Method::WrittenOut { pivots, .. } | Method::Recursive { pivots, .. } => {
                nodes.extend(pivots.iter().flat_map(|pivot| [pivot.value, pivot.scale]));
                continue;
            }
            Method::Ldlt => "Ldlt",
            Method::Lu => "Lu",
        };
        let (scalar, size) = (&emission.scalar, block.coordinates.len());
        let coordinates: Vec<String> = block.coordinates.iter().map(usize::to_string).collect();
        factored.push_str(&format!(
            "lagrange::solve::check_block::<lagrange::{factor}<{scalar}, {size}>, _, {count}, {size}>(&mass, &[{}])?;\n",
            coordinates.join(", ")
        ));
    }
    if nodes.is_empty() && factored.is_empty() {
        return None;
    }
    if !factored.is_empty() {
        factored.insert_str(0, &format!("let mass = self.mass_matrix(&{STATE});\n"));
    }
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let coordinates: Vec<usize> = emission
        .solution
        .blocks
        .iter()
        .filter_map(|block| match &block.method {
            Method::WrittenOut { pivots, .. } | Method::Recursive { pivots, .. } => {
                Some(pivots.iter().map(|pivot| pivot.coordinate))
            }
            Method::Ldlt | Method::Lu => None,
        })
        .flatten()
        .collect();
    let pivots = body::plain(emission.model, &emission.scalar, &nodes, Source::Slices, |values| {
        let pivots = values.chunks(2).zip(coordinates).map(|(pair, coordinate)| {
            format!("lagrange::solve::check({}, {coordinate})?;\n", pair.join(", "))
        });
        pivots.collect::<String>() + "::core::result::Result::Ok(())"
    });
    Some(factored + &turning::entry(emission) + &pivots)
}

/// Whether a body mentions an identifier.
fn mentions(body: &str, name: &str) -> bool {
    body.split(|c: char| c != '_' && !c.is_alphanumeric()).any(|word| word == name)
}
