//! Conserved quantities and their names.

use crate::emit::body::{self, Source};
use crate::emit::methods::{arguments, method};
use crate::emit::{Emission, docs};
use crate::expr::NodeId;
use crate::mechanics::analysis::{Generator, Integral, Turn, integrals};
use crate::model::{Model, Quantity};
use crate::number::Number;
use crate::simplify::simplify;

/// The constants `CYCLIC` and `CONSERVED` with their methods, and the number of conserved quantities.
pub(super) fn items(emission: &mut Emission<'_>) -> (String, usize) {
    let cyclic = emission.facts.cyclic.clone();
    let names: Vec<String> = cyclic.iter().map(|&i| emission.model.coordinates[i].written()).collect();
    let momenta: Vec<NodeId> = cyclic.iter().map(|&i| emission.equations.momenta[i]).collect();
    let mut text = constant(
        "CYCLIC",
        "Cyclic coordinates: L does not depend on them, and neither force nor constraint acts on them, so that the momentum of each is \
         conserved.",
        &names,
    );
    text.push_str(&vector(
        emission,
        "cyclic_momenta",
        "Momenta of the cyclic coordinates, in the order of `CYCLIC`: conserved.",
        &names,
        &momenta,
    ));

    let mut names = Vec::new();
    let mut values = Vec::new();
    if emission.facts.conserves() {
        let (name, value) = match emission.equations.jacobi_integral {
            Some(integral) => ("Jacobi integral", integral),
            None => ("energy", emission.equations.energy),
        };
        names.push(name.to_owned());
        values.push(value);
    }
    for Integral { generator, value } in integrals(emission.model, emission.equations) {
        names.push(describe(emission.model, &generator));
        values.push(value);
    }
    let turns = if emission.model.orientations.is_empty() { "" } else { " and for turns of orientations" };
    text.push_str(&constant(
        "CONSERVED",
        &format!("Conserved quantities that follow from the symmetries of the equations: the energy or Jacobi integral, and those of Noether's \
         theorem for shifts q → q + ε (S q + s) with constant S and s{turns}. There may be others."),
        &names,
    ));
    text.push_str(&vector(
        emission,
        "conserved",
        "Conserved quantities, in the order of `CONSERVED`.",
        &names,
        &values,
    ));
    (text, values.len())
}

/// A list of names.
pub(super) fn constant(name: &str, doc: &str, values: &[String]) -> String {
    format!("#[doc = {doc:?}]\npub const {name}: [&'static str; {}] = {values:?};\n", values.len())
}

fn vector(emission: &mut Emission<'_>, name: &str, doc: &str, names: &[String], nodes: &[NodeId]) -> String {
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, nodes);
    let shown = docs::named(emission.model, names.iter().cloned().zip(nodes.iter().copied()));
    let scalar = emission.scalar.clone();
    let signature = format!("{name}({}) -> [{scalar}; {}]", arguments(emission, &nodes), nodes.len());
    let body = body::plain(emission.model, &scalar, &nodes, Source::State, |values| {
        format!("[{}]", values.join(", "))
    });
    method(&format!("{doc}{shown}"), &signature, &body)
}

/// The usual name of a symmetry.
fn describe(model: &Model, generator: &Generator) -> String {
    let Generator { linear, shift, turns } = generator;
    if !turns.is_empty() {
        return turned(model, generator);
    }
    if linear.is_empty() {
        return match shift.as_slice() {
            [(i, _)] => format!("momentum of {}", model.coordinates[*i].written()),
            _ => format!("momentum along {}", combination(model, shift)),
        };
    }
    let mut planes: Vec<String> = Vec::new();
    let mut turns = shift.iter().all(|&(_, value)| value.abs().is_one());
    for &(i, j, value) in linear {
        let partner = (j, i, -value);
        turns &= value.abs().is_one() && linear.contains(&partner);
        if i < j {
            // The planes of (x[0], y[0]), (x[1], y[1]) and so on count as one.
            let name = |k: usize| &model.coordinates[k].name;
            let same_index = model.coordinates[i].index == model.coordinates[j].index;
            let label = |k: usize| if same_index { name(k).clone() } else { model.coordinates[k].written() };
            let plane = format!("{}–{}", label(i), label(j));
            if !planes.contains(&plane) {
                planes.push(plane);
            }
        }
    }
    if turns {
        let noun = if planes.len() == 1 { "plane" } else { "planes" };
        let mut text = format!("angular momentum in the {} {noun}", listed(&planes));
        if !shift.is_empty() {
            text.push_str(&format!(" with {}", combination(model, shift)));
        }
        return text;
    }
    let mut rows: Vec<String> = Vec::new();
    for (i, quantity) in model.coordinates.iter().enumerate() {
        let turned = linear.iter().filter(|&&(row, ..)| row == i).map(|&(_, j, value)| (Some(j), value));
        let moved = shift.iter().filter(|&&(row, _)| row == i).map(|&(_, value)| (None, value));
        let terms: Vec<(Option<usize>, Number)> = turned.chain(moved).collect();
        if !terms.is_empty() {
            rows.push(format!("δ{} = {}", quantity.written(), sum(model, &terms)));
        }
    }
    format!("momentum along {}", rows.join(", "))
}

/// The usual name of a symmetry with turns. Turns of all orientations about one axis of space turn the whole.
fn turned(model: &Model, generator: &Generator) -> String {
    let Generator { linear, shift, turns } = generator;
    let axis = |turn: &Turn| ["x", "y", "z"][turn.axis];
    let of = |turn: &Turn| {
        let name = &model.coordinates[turn.first].name;
        let alike = |first: &&usize| model.coordinates[**first].name == *name;
        let index = model.orientations.iter().filter(alike).position(|&first| first == turn.first);
        match model.orientations.iter().filter(alike).count() {
            1 => name.clone(),
            _ => format!("{name}[{}]", index.unwrap_or_default()),
        }
    };
    let (first, size) = turns[0];
    let alike = turns
        .iter()
        .all(|&(turn, value)| turn.axis == first.axis && turn.in_body == first.in_body && value == size);
    let is_turn = linear.iter().all(|&(i, j, value)| linear.contains(&(j, i, -value)));
    if alike && shift.is_empty() && is_turn {
        if !first.in_body && turns.len() == model.orientations.len() {
            return format!("angular momentum about {}", axis(&first));
        }
        if linear.is_empty() && turns.len() == 1 {
            let frame = if first.in_body { " in its own axes" } else { "" };
            return format!("angular momentum of {} about {}{frame}", of(&first), axis(&first));
        }
    }
    let mut parts: Vec<String> = turns
        .iter()
        .map(|(turn, value)| {
            let frame = if turn.in_body { " in its own axes" } else { "" };
            let share = if value.is_one() { String::new() } else { format!("{value} times ") };
            format!("{share}the turn of {} about {}{frame}", of(turn), axis(turn))
        })
        .collect();
    if !linear.is_empty() || !shift.is_empty() {
        parts.push(describe(model, &Generator { turns: Vec::new(), ..generator.clone() }));
    }
    format!("momentum along {}", listed(&parts))
}

fn listed(names: &[String]) -> String {
    match names {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

fn sum(model: &Model, terms: &[(Option<usize>, Number)]) -> String {
    let mut text = String::new();
    for &(coordinate, value) in terms {
        text.push_str(match (text.is_empty(), value.is_negative()) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        });
        let size = value.abs();
        match coordinate {
            Some(j) if size.is_one() => text.push_str(&model.coordinates[j].written()),
            Some(j) => text.push_str(&format!("{size} {}", model.coordinates[j].written())),
            None => text.push_str(&size.to_string()),
        }
    }
    text
}

/// `x[0] + … + x[6] − 2 y`: a run of elements is shortened by dots.
fn combination(model: &Model, terms: &[(usize, Number)]) -> String {
    let mut text = String::new();
    let mut rest = terms;
    while let Some(&(first, value)) = rest.first() {
        let follows = |quantity: &Quantity, number: usize| {
            let start = &model.coordinates[first];
            quantity.name == start.name
                && matches!((start.index, quantity.index), (Some(a), Some(b)) if b == a + number)
        };
        let run = rest
            .iter()
            .enumerate()
            .take_while(|&(number, &(i, other))| {
                number == 0 || (other == value && follows(&model.coordinates[i], number))
            })
            .count();
        let (taken, left) = rest.split_at(if run > 3 { run } else { 1 });
        rest = left;
        let mut part: Vec<(Option<usize>, Number)> = vec![(Some(first), value)];
        let dots = if taken.len() > 1 {
            part.push((Some(taken[taken.len() - 1].0), value));
            let sign = if value.is_negative() { " − … " } else { " + … " };
            Some((sum(model, &part[..1]), sign, sum(model, &part[1..])))
        } else {
            None
        };
        let written = match dots {
            Some((from, sign, to)) => {
                let to = to.trim_start_matches('−');
                format!("{from}{sign}{}{to}", if value.is_negative() { "− " } else { "+ " })
            }
            None => sum(model, &part),
        };
        if text.is_empty() {
            text = written;
        } else if let Some(positive) = written.strip_prefix('−') {
            text.push_str(&format!(" − {positive}"));
        } else {
            text.push_str(&format!(" + {written}"));
        }
    }
    text
}
