//! The inherent methods of a constrained system.

use super::record_ident;
use crate::emit::body::{self, Source};
use crate::emit::methods::{arguments, method};
use crate::emit::names::{Names, name_accelerations};
use crate::emit::{Emission, block, docs, scalar as number};
use crate::expr::NodeId;
use crate::schedule::plan;
use crate::simplify::simplify;

/// Names of the methods. No function of the user may have one of them.
pub(crate) const METHODS: [&str; 8] = [
    "reactions",
    "reaction_forces",
    "reaction_power",
    "energy_rate",
    "constraint_residuals",
    "constraint_rates",
    "constraint_jacobian",
    "consistent",
];

/// All of them as text.
pub(in crate::emit) fn methods(emission: &mut Emission<'_>) -> String {
    let held = emission.equations.conditions.count();
    let (count, given) = (emission.count(), emission.model.inputs.len());
    let (scalar, state) = (emission.scalar.to_string(), emission.state_type());
    let record = record_ident(emission.item).to_string();
    let (parameter, _) = given_inputs(emission);
    let error = format!("lagrange::MotionError<{scalar}>");
    let balance = balance_at(emission);
    let result = |ty: &str| format!("::core::result::Result<{ty}, {error}>");
    let mut text = method(
        "Multipliers λ of the constraints, by name: the generalized force of a constraint f is λ ∂f/∂q, of a constraint g on \
         velocities λ ∂g/∂v, each as it is written. Where the gradient is a unit vector, λ is the force itself. `are_unique()` \
         is false where redundant constraints leave them undetermined; they are then those of least Σ λ².\n\n\
         # Errors\n\nA singular system, with its cause and the time.",
        &format!(
            "reactions(&self, state: &{state}{parameter}) -> {}",
            result(&format!("lagrange::Reactions<{record}<{scalar}>>"))
        ),
        &format!(
            "{balance}::core::result::Result::Ok(lagrange::Reactions::new(balance.multipliers.into(), balance.independence.rank == {held}))"
        ),
    );
    text.push_str(&method(
        "Generalized forces λ ∂f/∂q of the constraints, by name, components in the order of the coordinates.\n\n\
         # Errors\n\nA singular system, with its cause and the time.",
        &format!(
            "reaction_forces(&self, state: &{state}{parameter}) -> {}",
            result(&format!("{record}<[{scalar}; {count}]>"))
        ),
        &format!(
            "{balance}::core::result::Result::Ok({record}::from(lagrange::constraints::forces::<Self, {count}, {given}, {held}>\
             (self, state, &balance.multipliers)))"
        ),
    ));
    let power = emission.equations.conditions.power(&mut emission.model.graph);
    let rate = emission.equations.energy_rate.unwrap_or(power);
    for (name, doc, node) in [
        (
            "reaction_power",
            "Power v·Aᵀλ of the reactions \\[W\\]: zero unless a constraint moves.\n\n# Errors\n\n\
             A singular system, with its cause and the time.",
            power,
        ),
        (
            "energy_rate",
            "d(T + V)/dt along the motion \\[W\\]: the power of applied forces and of moving constraints, and the explicit \
             change of V and T.\n\n# Errors\n\nA singular system, with its cause and the time.",
            rate,
        ),
    ] {
        let body = of_balance(emission, &balance, &[node], |values| values.join(", "));
        let signature = format!("{name}(&self, state: &{state}{parameter}) -> {}", result(&scalar));
        text.push_str("#[allow(unused_variables)]\n");
        text.push_str(&method(doc, &signature, &body));
    }
    text.push_str(&super::places::methods(emission, &balance, &parameter));
    text.push_str(&residuals(emission));
    text.push_str(&consistent(emission));
    text
}

/// The method that finds states on the constraints.
pub(in crate::emit) fn consistent(emission: &Emission<'_>) -> String {
    let held = emission.equations.conditions.count();
    let (count, given) = (emission.count(), emission.model.inputs.len());
    let (state, scalar) = (emission.state_type(), &emission.scalar);
    method(
        "The nearest state on the constraints in the metric of the mass matrix: coordinates, then velocities.\n\n\
         # Errors\n\nConstraints that contradict each other, that have no gradient, or that Newton's method cannot satisfy \
         from here: the constraint, and how far off it is.",
        &format!(
            "consistent(&self, state: {state}) -> ::core::result::Result<{state}, lagrange::MotionError<{scalar}>>"
        ),
        &format!(
            "lagrange::reading::checked::<Self, {count}, {given}>(self, &state, &[{}; {given}])?;\n\
             lagrange::constraints::consistent::<Self, {count}, {given}, {held}>(self, state)",
            number::zero(&emission.item.scalar)
        ),
    )
}

/// Statements that bind `balance`, the accelerations and multipliers at `state`, or return an error.
pub(in crate::emit) fn balance_at(emission: &Emission<'_>) -> String {
    let held = emission.equations.conditions.count();
    let (count, given) = (emission.count(), emission.model.inputs.len());
    let (_, argument) = given_inputs(emission);
    let surface = format!("<Self as lagrange::Surface<{count}, {given}, {held}>>");
    let system = format!("<Self as lagrange::System<{count}, {given}>>");
    format!(
        "let balance = {surface}::balance_at(self, &{system}::constants(self), state.t, &state.q, &state.v, {argument});\n\
         lagrange::constraints::finite::<Self, {count}, {given}, {held}>(self, state, &balance)?;\n"
    )
}

fn given_inputs(emission: &Emission<'_>) -> (String, &'static str) {
    if emission.model.inputs.is_empty() {
        (String::new(), "&[]")
    } else {
        (format!(", inputs: &{}", emission.input_type()), "inputs")
    }
}

/// A body that computes nodes from a state with its accelerations and multipliers.
pub(in crate::emit) fn of_balance(
    emission: &mut Emission<'_>,
    balance: &str,
    nodes: &[NodeId],
    result: impl FnOnce(&[String]) -> String,
) -> String {
    name_accelerations(emission.model);
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, nodes);
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let program = plan(&model.graph, &nodes);
    let written = block::write(model, scalar, &program, &program.outputs, &[], &mut Names::new(model));
    let mut text = balance.to_owned();
    text.push_str(&format!(
        "let ([{}], accelerations) = (balance.multipliers, &balance.accelerations);\n",
        model.locals.multipliers.join(", ")
    ));
    text.push_str(&body::prologue(model, scalar, &written.reads, Source::State));
    text.push_str(&body::assemble(&written));
    text.push_str(&format!("::core::result::Result::Ok({})", result(&written.outputs)));
    body::imported(text)
}

/// Residuals, their rates, and the gradients.
fn residuals(emission: &mut Emission<'_>) -> String {
    let conditions = emission.equations.conditions.clone();
    let (held, count) = (conditions.count(), emission.count());
    let values: Vec<NodeId> = emission.model.constraints.iter().map(|constraint| constraint.value).collect();
    let scalar = emission.scalar.to_string();
    let mut text = String::new();
    for (name, doc, symbol, nodes) in [
        (
            "constraint_residuals",
            "How far a state is off the constraints: f of the holonomic ones, g of the nonholonomic ones, in the order of \
             `CONSTRAINTS`.",
            "f",
            &values,
        ),
        (
            "constraint_rates",
            "The constraints at the level of velocities: df/dt of the holonomic ones, g of the nonholonomic ones.",
            "w",
            &conditions.rates,
        ),
    ] {
        let doc = format!("{doc}{}", docs::constraints(emission.model, symbol, nodes));
        let signature = format!("{name}({}) -> [{scalar}; {held}]", arguments(emission, nodes));
        let body = body::plain(emission.model, &emission.scalar, nodes, Source::State, |values| {
            format!("[{}]", values.join(", "))
        });
        text.push_str(&method(&doc, &signature, &body));
    }
    let nodes: Vec<NodeId> = conditions.jacobian.iter().flatten().copied().collect();
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let signature = format!(
        "constraint_jacobian({}) -> lagrange::nalgebra::SMatrix<{scalar}, {held}, {count}>",
        arguments(emission, &nodes)
    );
    let body = body::plain(emission.model, &emission.scalar, &nodes, Source::State, |values| {
        let gradients: Vec<Vec<String>> = values.chunks(count).map(<[String]>::to_vec).collect();
        let filled = super::rows(&emission.scalar, "gradients", count, &gradients);
        format!("{filled}lagrange::constraints::matrix(&gradients)")
    });
    text.push_str(&method(
        "Gradients A of the constraints: ∂f/∂q of the holonomic ones, ∂g/∂v of the nonholonomic ones, a row each.",
        &signature,
        &body,
    ));
    text
}
