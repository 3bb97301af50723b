//! The solution of an order: factors made at the point of expansion and used in every order.

use super::names::Of;
use crate::emit::block::Writer;
use crate::emit::constraints;
use crate::emit::names::Names;
use crate::emit::{Emission, body};
use crate::orders::{By, Expansion, SaddlePoint, Solver};
use crate::schedule::Slot;
use crate::structure::Saddle;
use crate::syntax::Scalar;

/// The factors of a saddle-point system in the generated code.
const SADDLE: &str = "saddle";

/// The type of a factorisation.
pub(super) fn factor_type(indefinite: bool, scalar: &Scalar, size: usize) -> String {
    format!("lagrange::{}<{scalar}, {size}>", if indefinite { "Lu" } else { "Ldlt" })
}

/// The slots that the statements at the start read.
pub(super) fn at_start(expansion: &Expansion) -> Vec<Slot> {
    let mut slots = expansion.pivots.clone();
    for solver in &expansion.solvers {
        match &solver.by {
            By::Factors { constant: false, entries, .. } => slots.extend(entries),
            By::Factors { .. } => {}
            By::Inverse { factors, .. } => slots.extend(factors),
        }
    }
    if let Some(SaddlePoint { gradients, mass, schur, switches, .. }) = &expansion.saddle {
        slots.extend(mass.iter().chain(gradients.iter().flatten()).chain(schur).chain(switches));
    }
    slots
}

/// The slots that the statements of an order read.
pub(super) fn in_order(expansion: &Expansion) -> Vec<Slot> {
    let mut slots: Vec<Slot> = expansion.solvers.iter().flat_map(|solver| &solver.right).copied().collect();
    if let Some(saddle) = &expansion.saddle {
        slots.extend(saddle.momenta.iter().chain(&saddle.conditions));
    }
    slots
}

/// The statements at the start, and a name for the factors of each block.
pub(super) fn start(
    emission: &Emission<'_>,
    expansion: &Expansion,
    writer: &Writer<'_>,
    names: &mut Names,
) -> (String, Vec<String>) {
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let mut text = String::new();
    if !expansion.pivots.is_empty() {
        text.push_str(&format!(
            "if !lagrange::solve::are_finite(&{}) {{ return false; }}\n",
            writer.list(&expansion.pivots)
        ));
    }
    let mut solvers = Vec::with_capacity(expansion.solvers.len());
    let mut factored = 0;
    for Solver { coordinates, by, .. } in &expansion.solvers {
        let size = coordinates.len();
        let label = |what: &str| Some(format!("{}_{what}", model.coordinates[coordinates[0]].label()));
        let name = match by {
            By::Factors { constant: true, .. } => {
                factored += 1;
                let name = names.claim(label("factors"));
                text.push_str(&format!(
                    "let ::core::option::Option::Some({name}) = &constants.{factored} else {{ return false; }};\n"
                ));
                name
            }
            By::Factors { indefinite, entries, .. } => {
                let name = names.claim(label("factors"));
                text.push_str(&body::lower_triangle(scalar, size, &writer.outputs(entries)));
                text.push_str(&format!(
                    "let ::core::option::Option::Some({name}) = \
                     lagrange::solve::factor::<{}, _, _>(mass) else {{ return false; }};\n",
                    factor_type(*indefinite, scalar, size)
                ));
                name
            }
            By::Inverse { steps, between, factors } => {
                let name = names.claim(label("inverse"));
                let steps: Vec<String> = steps
                    .iter()
                    .map(|(place, others)| {
                        format!("lagrange::RecursionStep {{ place: {place}, others: &{others:?} }}")
                    })
                    .collect();
                text.push_str(&format!(
                    "let {name} = lagrange::Inverse::<{scalar}, {size}>::of::<{between}>(&[{}], &{});\n\
                     if !{name}.is_finite() {{ return false; }}\n",
                    steps.join(", "),
                    writer.list(factors)
                ));
                name
            }
        };
        solvers.push(name);
    }
    if let Some(saddle) = &expansion.saddle {
        text.push_str(&saddle_start(emission, saddle, writer));
    }
    (text, solvers)
}

fn saddle_start(emission: &Emission<'_>, saddle: &SaddlePoint, writer: &Writer<'_>) -> String {
    let (scalar, count, held) = (&emission.scalar, emission.count(), saddle.gradients.len());
    let mass = writer.values(&saddle.mass);
    let rows: Vec<Vec<String>> = saddle.gradients.iter().map(|row| writer.outputs(row)).collect();
    // A single row cannot depend on others.
    let noted = |independence: String| match held {
        0 | 1 => String::new(),
        _ => format!("series.independence = {independence};\n"),
    };
    if saddle.method == Saddle::Sparse {
        return format!(
            "let mass = {};\n{}let {SADDLE} = {};\n\
             if lagrange::constraints::is_singular(&{SADDLE}) {{ return false; }}\n{}",
            mass.list(),
            constraints::gradients(emission, saddle.method, &rows),
            constraints::factored(emission, saddle.method),
            noted(format!("lagrange::constraints::independence(&{SADDLE})"))
        );
    }
    let rows: Vec<String> = rows.iter().map(|row| format!("[{}]", row.join(", "))).collect();
    let gradients = format!("[{}]", rows.join(", "));
    if saddle.method == Saddle::Diagonal {
        return format!(
            "{}let {SADDLE} = lagrange::saddle::Schur::<{scalar}, {held}>::factor::<{count}>(mass, || ({}, {gradients}));\n\
             if !{SADDLE}.is_finite() || {SADDLE}.vanishing().is_some() {{ return false; }}\n{}",
            body::lower_triangle(scalar, held, &writer.outputs(&saddle.schur)),
            mass.list(),
            noted(format!("{SADDLE}.independence()"))
        );
    }
    format!(
        "{}let gradients = {gradients};\n{}let {SADDLE} = {};\n\
         if lagrange::constraints::is_singular(&{SADDLE}) {{ return false; }}\n{}",
        body::lower_triangle(scalar, count, &mass),
        constraints::filled_switches(emission, &writer.outputs(&saddle.switches)),
        constraints::factored(emission, saddle.method),
        noted(format!("lagrange::constraints::independence(&{SADDLE})"))
    )
}

/// The statements that solve an order.
pub(super) fn order(
    emission: &Emission<'_>,
    expansion: &Expansion,
    solvers: &[String],
    writer: &Writer<'_>,
    of: &Of,
) -> String {
    let mut text = String::new();
    for ((solver, name), (velocities, _)) in expansion.solvers.iter().zip(solvers).zip(&of.velocities) {
        text.push_str(&format!("let {velocities} = {name}.solve({});\n", writer.list(&solver.right)));
    }
    let Some(saddle) = &expansion.saddle else { return text };
    let ((impulses, _), conditions) = (&of.impulses, writer.list(&saddle.conditions));
    let velocities = of.velocities.first().map_or("", |(pattern, _)| pattern);
    text.push_str(&match saddle.method {
        Saddle::Diagonal => {
            format!("let {impulses} = {SADDLE}.solve_order(order, &mass, {conditions});\n")
        }
        Saddle::Sparse => format!("let {impulses} = {SADDLE}.solve_order(order, {conditions});\n"),
        Saddle::Switched { .. } if emission.solved.conditions.has_loads() => format!(
            "let ({velocities}, {impulses}) = {SADDLE}.solve_order(order, rate, reactions.rows(), &{}, &{conditions});\n",
            writer.list(&saddle.momenta)
        ),
        Saddle::Whole { .. } | Saddle::Switched { .. } => format!(
            "let ({velocities}, {impulses}) = lagrange::saddle::SaddlePoint::{}(&{SADDLE}, &{}, &{conditions});\n",
            if saddle.switches.is_empty() { "solve" } else { "solve_motion" },
            writer.list(&saddle.momenta)
        ),
    });
    if let Some(Some(_)) = of.multipliers.1.elements.first() {
        let multipliers = &of.multipliers.0;
        text.push_str(&format!(
            "let {multipliers} = {impulses}.map(|impulse| lagrange::jets::multiplier(impulse, rate));\n"
        ));
    } else {
        for (multiplier, impulse) in of.multipliers.1.iter().zip(&of.impulses.1[..]) {
            text.push_str(&format!("let {multiplier} = lagrange::jets::multiplier({impulse}, rate);\n"));
        }
    }
    text
}
