//! The implementation of the runtime's `System`, which the integrators call.

use super::Emission;
use super::block::{self, Evaluation, Known, Loops, Values};
use super::body::{self, Source};
use super::hidden::hidden;
use super::names::Names;
use super::parts::{Kind, Part};
use super::turning;
use crate::expr::NodeId;
use crate::schedule::{Program, Slot, plan};
use crate::simplify::simplify;
use crate::structure::{Method, Pivot};

/// A state from the arguments of the trait's functions, for the inherent methods.
const STATE: &str = "lagrange::State { t, q: *q, v: *v }";

/// The items of a system that has nothing to compute once per run.
pub(super) const NO_CONSTANTS: &str = "type Constants = ();\nfn constants(&self) {}\n";

/// The trait's items as text, and the evaluation of the accelerations.
pub(super) fn system(emission: &mut Emission<'_>) -> (String, Evaluation) {
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
    let once = parts.iter().any(Part::factored_once);
    let (labels, given) = body::labels(emission.model, &program, &hoisted, once, &mut names);
    let constants = constants(emission, &program, &hoisted, &parts);
    let (accelerations, loops) = accelerations(emission, &program, (labels, given), parts, &mut names);
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
    text.push_str(&hidden(emission));
    text.push_str(&format!(
        "#[inline]\nfn energy_at(&self, _constants: &Self::Constants, t: {scalar}, q: &{vector}, v: &{vector}) -> {scalar} \
         {{\nself.energy(&{STATE})\n}}\n"
    ));
    (text, Evaluation { operations: program.operations(false), loops })
}

/// The type of the constants and the body that computes them: an array of scalars, then the factorisations of
/// constant blocks.
fn constants(
    emission: &Emission<'_>,
    program: &Program,
    hoisted: &[Slot],
    parts: &[Part<Slot>],
) -> (String, String) {
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let fixed = body::constants(model, scalar, program, hoisted);
    let mut types = vec![format!("[{scalar}; {}]", hoisted.len())];
    let mut values = vec![fixed.outputs.list()];
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
    (tuple(&types), text)
}

fn accelerations(
    emission: &Emission<'_>,
    program: &Program,
    (labels, given): (String, Vec<Known>),
    parts: Vec<Part<Slot>>,
    names: &mut Names,
) -> (String, Loops) {
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let written = block::write(model, scalar, program, &program.outputs, &given, names);
    let (entry, door) = turning::accelerations(emission);
    let mut text = entry + &body::prologue(model, scalar, &written.reads, Source::Slices);
    text.push_str(&labels);
    text.push_str(&body::assemble(&written));

    let mut outputs = written.outputs;
    let mut solution = Values::none(model, scalar);
    let mut places = Vec::with_capacity(emission.count());
    let mut factored = 0;
    for part in parts {
        let entries = outputs.take(if part.factored_once() { 0 } else { part.entries.len() });
        let results = outputs.take(part.results.len());
        places.extend(&part.coordinates);
        let Kind::Runtime { factor, constant } = part.kind else {
            solution.append(results);
            continue;
        };
        let count = part.coordinates.len();
        let factorisation = if constant {
            factored += 1;
            format!("constants.{factored}")
        } else {
            text.push_str(&body::lower_triangle(scalar, count, &entries));
            format!("lagrange::solve::factor::<lagrange::{factor}<{scalar}, {count}>, _, _>(mass)")
        };
        let wish = |&i: &usize| Some(format!("{}_ddot", model.coordinates[i].label()));
        let (solved, values) =
            Values::none(model, scalar).bound(names, part.coordinates.iter().map(wish).collect());
        text.push_str(&format!(
            "let {solved} = lagrange::solve::solve(&{factorisation}, {});\n",
            results.list()
        ));
        solution.append(values);
    }
    text.push_str(&door(solution.placed(&places).list()));
    (body::imported(text), written.loops)
}

/// The body that finds the singular block, if any block can be singular.
fn check(emission: &mut Emission<'_>) -> Option<String> {
    let mut pivots: Vec<Pivot> = Vec::new();
    let mut factored = String::new();
    let count = emission.count();
    for block in &emission.solution.blocks {
        let factor = match &block.method {
            Method::WrittenOut { pivots: own, .. } | Method::Recursive { pivots: own, .. } => {
                pivots.extend(own);
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
    if pivots.is_empty() && factored.is_empty() {
        return None;
    }
    if !factored.is_empty() {
        factored.insert_str(0, &format!("let mass = self.mass_matrix(&{STATE});\n"));
    }
    let nodes: Vec<NodeId> =
        pivots.iter().map(|pivot| pivot.value).chain(pivots.iter().map(|pivot| pivot.scale)).collect();
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let is_long = pivots.len() >= emission.model.locals.least;
    let checked = body::plain(emission.model, &emission.scalar, &nodes, Source::Slices, |values| {
        let (all, count) = (pivots.iter().map(|pivot| pivot.coordinate), pivots.len());
        if is_long {
            let (own, scales) = (values.part(0..count).list(), values.part(count..2 * count).list());
            let coordinates: Vec<usize> = all.collect();
            return format!("lagrange::solve::check_all(&{own}, &{scales}, &{coordinates:?})");
        }
        let check = |(i, coordinate): (usize, usize)| {
            format!("lagrange::solve::check({}, {}, {coordinate})?;\n", values[i], values[count + i])
        };
        all.enumerate().map(check).collect::<String>() + "::core::result::Result::Ok(())"
    });
    Some(factored + &turning::entry(emission) + &checked)
}

/// Whether a body mentions an identifier.
fn mentions(body: &str, name: &str) -> bool {
    body.split(|c: char| c != '_' && !c.is_alphanumeric()).any(|word| word == name)
}
