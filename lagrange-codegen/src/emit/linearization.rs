//! The implementations of the runtime's `Linearized`, `Tangent` and `Parametric`, which the attribute's
//! `jacobians` adds.

use super::block::Values;
use super::body::{self, Source};
use super::constraints::kinds;
use super::names::{Names, name_accelerations};
use super::{Emission, block, scalar, screws};
use crate::expr::{NodeId, Variable};
use crate::mechanics::{Linearization, Sensitivities};
use crate::schedule::plan;
use crate::simplify::simplify;

/// The most columns of a matrix that is filled in line. Matrices with more are filled row by row, each row by
/// a function of its own.
const OUTLINED: usize = 32;

/// The items of the traits as text.
pub(super) struct Items {
    /// The items of `Linearized`.
    pub linearized: String,
    /// The implementation of `Carried`, if the bodies of the system carry each other.
    pub carried: Option<screws::Carried>,
    /// The items of `Tangent`.
    pub tangent: String,
    /// The items of `Parametric`.
    pub parametric: String,
}

/// All implementations.
pub(super) fn linearization(emission: &mut Emission<'_>) -> Items {
    name_accelerations(emission.model);
    let derived = Linearization::of(emission.model, emission.equations);
    let parametric = parametric(emission, &derived.by_p);
    let place = Signature::of(emission).place;
    let carried = derived.screws.as_ref().map(|screws| screws::carried(emission, screws, &place));
    let (linearized, tangent) = if emission.equations.conditions.count() == 0 {
        free(emission, derived, carried.as_ref())
    } else {
        constrained(emission, derived)
    };
    Items { linearized, carried, tangent, parametric }
}

/// Argument lists that several functions share.
struct Signature {
    place: String,
    given: String,
    inputs: String,
}

impl Signature {
    fn of(emission: &Emission<'_>) -> Signature {
        let (scalar, vector) = (&emission.scalar, emission.vector_type());
        let inputs = emission.input_type();
        Signature {
            place: format!("&self, _constants: &Self::Constants, t: {scalar}, q: &{vector}, v: &{vector}"),
            given: format!("accelerations: &{vector}, u: &{inputs}"),
            inputs: format!("u: &{inputs}"),
        }
    }
}

/// The items of a system without constraints.
fn free(
    emission: &mut Emission<'_>,
    derived: Linearization,
    carried: Option<&screws::Carried>,
) -> (String, String) {
    let Linearization { forces, by_u, .. } = derived;
    let (count, inputs) = (emission.count(), emission.model.inputs.len());
    let scalar = &emission.scalar.to_string();
    let vector = emission.vector_type();
    let Signature { place, given, inputs: inputs_only } = Signature::of(emission);

    let zero = scalar::zero(&emission.scalar);
    let derivatives: Vec<NodeId> = flat(forces.by_q).into_iter().chain(flat(forces.by_v)).collect();
    let (residual, matrices, factored) = match carried {
        Some(carried) => {
            let bodies = screws::bodies(emission, carried, &forces.values, &derivatives);
            (bodies.residual_at, bodies.linearization_at, Some(bodies.factored_at))
        }
        None => {
            let residual = body::simplified(emission, &forces.values, Values::list);
            let roots = [mass(emission), derivatives].concat();
            (residual, body::simplified(emission, &roots, |values| dense(&zero, count, values)), None)
        }
    };
    let by_u: Vec<NodeId> = by_u.into_iter().flatten().collect();
    let by_inputs = body::simplified(emission, &by_u, |values| {
        let rows = values.chunks(inputs.max(1)).map(|row| format!("[{}]", row.join(", ")));
        let rows: Vec<String> = rows.collect();
        if inputs == 0 { format!("[[]; {count}]") } else { format!("[{}]", rows.join(", ")) }
    });
    let factored = factored.map_or(String::new(), |body| {
        format!(
            "#[inline]\nfn factored_at({place}, {inputs_only}, \
             matrices: &mut lagrange::Factored<{scalar}, {count}>) {{\n{body}}}\n"
        )
    });
    let linearized = format!(
        "{factored}#[inline]\nfn residual_at({place}, {given}) -> {vector} {{\n{residual}\n}}\n\
         #[inline]\nfn linearization_at({place}, {given}) -> lagrange::Linearization<{scalar}, {count}> \
         {{\n{matrices}\n}}\n\
         #[inline]\nfn by_inputs_at({place}, {inputs_only}) -> [[{scalar}; {inputs}]; {count}] {{\n{by_inputs}\n}}\n"
    );

    let itself = format!("<Self as lagrange::Linearized<{count}, {inputs}>>");
    let from_place = "place.t, place.q, place.v";
    let by_t = at_place(emission, &forces.by_t, |values| {
        let mut text = format!(
            "let mut matrices = lagrange::Variation::zero();\n\
             let linearization = {itself}::linearization_at(self, constants, {from_place}, place.a, place.u);\n\
             *matrices.mass = linearization.mass;\n*matrices.by_q = linearization.by_q;\n\
             *matrices.by_v = linearization.by_v;\n\
             *matrices.by_u = {itself}::by_inputs_at(self, constants, {from_place}, place.u);\n"
        );
        text.push_str(&column("by_t", &zero, values));
        text + "matrices"
    });
    let imbalance = format!(
        "lagrange::Imbalance {{ forces: {itself}::residual_at(self, constants, {from_place}, place.a, place.u), \
         conditions: [] }}"
    );
    let balance = format!(
        "lagrange::Balance {{ accelerations: \
         <Self as lagrange::System<{count}, {inputs}>>::accelerations_at(self, constants, t, q, v, u), \
         multipliers: [], independence: lagrange::Independence::clear(0) }}"
    );
    let deviations =
        "lagrange::Residuals { positions: [], position_sizes: [], rates: [], rate_sizes: [] }".to_owned();
    let tangent = tangent(emission, &[], [&balance, &deviations, &imbalance, &by_t]);
    (linearized, tangent)
}

/// M and the derivatives, entry by entry.
fn dense(zero: &str, count: usize, values: &[String]) -> String {
    let empty = format!("[[{zero}; {count}]; {count}]");
    let mut text = format!(
        "let mut matrices = lagrange::Linearization {{ mass: {empty}, by_q: {empty}, by_v: {empty} }};\n"
    );
    for (name, entries) in ["mass", "by_q", "by_v"].into_iter().zip(values.chunks(count * count)) {
        text.push_str(&matrix(name, zero, count, entries));
    }
    text + "matrices"
}

/// The items of a system with constraints. Its `Linearized` is that of the accelerations, with the
/// multipliers solved for.
fn constrained(emission: &mut Emission<'_>, derived: Linearization) -> (String, String) {
    let Linearization { forces, by_u, conditions, rates_by_q, .. } = derived;
    let (count, inputs, held) =
        (emission.count(), emission.model.inputs.len(), emission.equations.conditions.count());
    let scalar = &emission.scalar.to_string();
    let vector = emission.vector_type();
    let Signature { place, given, inputs: inputs_only } = Signature::of(emission);
    let reduced = |name: &str, more: &str| {
        format!(
            "lagrange::tangent::{name}::<Self, {count}, {inputs}, {held}>(self, _constants, \
             &lagrange::State {{ t, q: *q, v: *v }}, {more}u)"
        )
    };
    let linearized = format!(
        "#[inline]\nfn residual_at({place}, {given}) -> {vector} {{\n{}\n}}\n\
         #[inline]\nfn linearization_at({place}, {given}) -> lagrange::Linearization<{scalar}, {count}> \
         {{\n{}\n}}\n\
         #[inline]\nfn by_inputs_at({place}, {inputs_only}) -> [[{scalar}; {inputs}]; {count}] {{\n{}\n}}\n",
        reduced("reduced_residual", "accelerations, "),
        reduced("reduced", ""),
        reduced("reduced_by_inputs", ""),
    );

    let graph = &emission.model.graph;
    let rows = emission.equations.conditions.jacobian.iter().zip(&rates_by_q);
    let turns: Vec<bool> = rows
        .map(|(row, rates)| graph.any_depends_on(row.iter().chain(rates).copied(), Variable::Time))
        .collect();
    let zero = scalar::zero(&emission.scalar);
    let matrices = [
        ("mass", count, mass(emission)),
        ("by_q", count, flat(forces.by_q)),
        ("by_v", count, flat(forces.by_v)),
        ("by_u", inputs, flat(by_u)),
        ("gradients", count, flat(emission.equations.conditions.jacobian.clone())),
        ("rates_by_q", count, flat(rates_by_q)),
        ("conditions_by_q", count, flat(conditions.by_q)),
        ("conditions_by_v", count, flat(conditions.by_v)),
    ];
    let vectors = [("by_t", forces.by_t), ("conditions_by_t", conditions.by_t)];
    let all = matrices.iter().map(|(.., nodes)| nodes).chain(vectors.iter().map(|(_, nodes)| nodes));
    let roots: Vec<NodeId> = all.flatten().copied().collect();
    let variation = at_place(emission, &roots, |values| {
        let mut text = "let mut matrices = lagrange::Variation::zero();\n".to_owned();
        let mut rest = values;
        for (name, width, nodes) in &matrices {
            let (entries, others) = rest.split_at(nodes.len());
            if *width > 0 {
                text.push_str(&matrix(name, &zero, *width, entries));
            }
            rest = others;
        }
        for (name, nodes) in &vectors {
            let (entries, others) = rest.split_at(nodes.len());
            text.push_str(&column(name, &zero, entries));
            rest = others;
        }
        text + "matrices"
    });
    let roots: Vec<NodeId> = forces.values.into_iter().chain(conditions.values).collect();
    let imbalance = at_place(emission, &roots, |values| {
        let (forces, conditions) = values.split_at(count);
        format!(
            "lagrange::Imbalance {{ forces: [{}], conditions: [{}] }}",
            forces.join(", "),
            conditions.join(", ")
        )
    });
    let surface = format!("<Self as lagrange::Surface<{count}, {inputs}, {held}>>");
    let balance = format!("{surface}::balance_at(self, constants, t, q, v, u)");
    let deviations = format!("{surface}::residuals_at(self, t, q, v)");
    let tangent = tangent(emission, &turns, [&balance, &deviations, &imbalance, &variation]);
    (linearized, tangent)
}

/// The items of `Tangent` from the constraints whose gradients depend on time and the bodies of its
/// functions.
fn tangent(
    emission: &Emission<'_>,
    turns: &[bool],
    [balance, deviations, imbalance, variation]: [&str; 4],
) -> String {
    let (count, inputs, held) =
        (emission.count(), emission.model.inputs.len(), emission.equations.conditions.count());
    let (scalar, vector) = (&emission.scalar, emission.vector_type());
    let given = emission.input_type();
    let kinds = kinds(emission.model);
    let state = format!("t: {scalar}, q: &{vector}, v: &{vector}");
    let place = format!(
        "&self, constants: &Self::Constants, place: &lagrange::Place<'_, {scalar}, {count}, {inputs}, {held}>"
    );
    format!(
        "const HOLONOMIC: [bool; {held}] = {kinds:?};\n\
         const TURNS: [bool; {held}] = {turns:?};\n\
         #[inline]\nfn balanced_at(&self, constants: &Self::Constants, {state}, u: &{given}) \
         -> lagrange::Balance<{scalar}, {count}, {held}> {{\n{balance}\n}}\n\
         #[inline]\nfn deviations_at(&self, {state}) -> lagrange::Residuals<{scalar}, {held}> {{\n{deviations}\n}}\n\
         #[inline]\nfn imbalance_at({place}) -> lagrange::Imbalance<{scalar}, {count}, {held}> {{\n{imbalance}\n}}\n\
         #[inline]\nfn variation_at({place}) -> lagrange::Variation<{scalar}, {count}, {inputs}, {held}> \
         {{\n{variation}\n}}\n"
    )
}

/// The items of `Parametric`.
fn parametric(emission: &mut Emission<'_>, by_p: &Sensitivities) -> String {
    let (count, inputs, held, parameters) = (
        emission.count(),
        emission.model.inputs.len(),
        emission.equations.conditions.count(),
        emission.model.sensitivities.len(),
    );
    let zero = scalar::zero(&emission.scalar);
    let matrices = [
        ("forces", flat(by_p.forces.clone())),
        ("conditions", flat(by_p.conditions.clone())),
        ("positions", flat(by_p.positions.clone())),
        ("rates", flat(by_p.rates.clone())),
    ];
    let roots: Vec<NodeId> = matrices.iter().flat_map(|(_, nodes)| nodes).copied().collect();
    let body = if parameters == 0 {
        "lagrange::ByParameters::zero()".to_owned()
    } else {
        at_place(emission, &roots, |values| {
            let mut text = "let mut matrices = lagrange::ByParameters::zero();\n".to_owned();
            let mut rest = values;
            for (name, nodes) in &matrices {
                let (entries, others) = rest.split_at(nodes.len());
                text.push_str(&matrix(name, &zero, parameters, entries));
                rest = others;
            }
            text + "matrices"
        })
    };
    let scalar = &emission.scalar;
    format!(
        "#[inline]\nfn by_parameters_at(&self, constants: &Self::Constants, \
         place: &lagrange::Place<'_, {scalar}, {count}, {inputs}, {held}>) \
         -> lagrange::ByParameters<{scalar}, {count}, {held}, {parameters}> {{\n{body}\n}}\n"
    )
}

fn flat(rows: Vec<Vec<NodeId>>) -> Vec<NodeId> {
    rows.into_iter().flatten().collect()
}

/// The whole mass matrix, row by row.
fn mass(emission: &Emission<'_>) -> Vec<NodeId> {
    let count = emission.count();
    let full = |i: usize| (0..count).map(move |j| (i.max(j), i.min(j)));
    (0..count).flat_map(full).map(|(i, j)| emission.equations.mass.rows()[i][j]).collect()
}

/// A body that computes some nodes at a `Place`.
fn at_place(
    emission: &mut Emission<'_>,
    nodes: &[NodeId],
    result: impl FnOnce(&[String]) -> String,
) -> String {
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, nodes);
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let program = plan(&model.graph, &nodes);
    let written = block::write(model, scalar, &program, &program.outputs, &[], &mut Names::new(model));
    let mut text = "let lagrange::Place { t, q, v, a: accelerations, multipliers, u } = *place;\n".to_owned();
    if !model.locals.multipliers.is_empty() {
        text.push_str(&format!("let [{}] = *multipliers;\n", model.locals.multipliers.join(", ")));
    }
    text.push_str(&body::prologue(model, scalar, &written.reads, Source::Slices));
    text.push_str(&body::assemble(&written));
    text.push_str(&result(&written.outputs));
    body::imported(text)
}

/// Statements that fill one of the vectors. Zeros are left as they are.
fn column(name: &str, zero: &str, entries: &[String]) -> String {
    let filled = entries.iter().enumerate().filter(|(_, entry)| *entry != zero);
    filled.map(|(i, entry)| format!("matrices.{name}[{i}] = {entry};\n")).collect()
}

/// Statements that fill one of the matrices. Zeros are left as they are.
fn matrix(name: &str, zero: &str, count: usize, entries: &[String]) -> String {
    let mut text = String::new();
    for (i, row) in entries.chunks(count).enumerate() {
        let filled: Vec<(usize, &String)> =
            row.iter().enumerate().filter(|(_, entry)| *entry != zero).collect();
        if count <= OUTLINED {
            for (j, entry) in filled {
                text.push_str(&format!("matrices.{name}[{i}][{j}] = {entry};\n"));
            }
            continue;
        }
        text.push_str(&format!(
            "matrices.{name}[{i}] = lagrange::solve::outlined(move || {{\nlet mut row = [{zero}; {count}];\n"
        ));
        for (j, entry) in filled {
            text.push_str(&format!("row[{j}] = {entry};\n"));
        }
        text.push_str("row\n});\n");
    }
    text
}
