//! The inherent methods. Each is usable on its own, and those that a program does not call are not linked.

use super::block::Values;
use super::body::{self, Source};
use super::equations::Sides;
use super::{Emission, docs, eliminated, oriented};
use crate::expr::{Dependence, NodeId};
use crate::mechanics::MassMatrix;
use crate::simplify::simplify;

/// The methods that every expansion has.
pub(crate) const METHODS: [&str; 7] =
    ["accelerations", "mass_matrix", "bias", "momenta", "kinetic_energy", "potential_energy", "energy"];

/// One method as text.
pub(super) fn method(doc: &str, signature: &str, body: &str) -> String {
    format!("#[doc = {doc:?}]\n#[inline]\npub fn {signature} {{\n{body}\n}}\n")
}

/// The inherent methods that need no constraints and no `analysis`, and the vectors of the equations.
pub(super) fn methods(emission: &mut Emission<'_>) -> (String, Sides) {
    let mut text = accelerations(emission);
    text.push_str(&mass_matrix(emission));
    let equations = emission.equations.clone();
    let (bias, simple_bias) = vector(
        emission,
        "bias",
        "Bias b(q, v, t) = d/dt(∂L/∂v) − ∂L/∂q at zero accelerations: inertia forces that depend on velocity, \
         and ∂V/∂q. The equations of motion are M a + b = Q − ∂D/∂v.",
        "b",
        &equations.bias,
    );
    text.push_str(&bias);
    let mut sides = Sides { bias: simple_bias, applied: equations.applied.clone() };
    if equations.power.is_some() {
        let doc = "Generalized applied forces Q − ∂D/∂v.";
        let (applied, simple) = vector(emission, "applied_forces", doc, "Q", &equations.applied);
        text.push_str(&applied);
        sides.applied = simple;
    }
    let (momenta, _) = vector(emission, "momenta", "Generalized momenta p = ∂L/∂v.", "p", &equations.momenta);
    text.push_str(&momenta);
    // Without a Lagrangian the energy is the sum of T and V, whose common parts the compiler shares.
    let whole = (!emission.model.lagrangian.is_empty()).then_some(equations.energy);
    for (name, doc, symbol, node) in [
        ("kinetic_energy", "Kinetic energy T \\[J\\].", "T", Some(equations.kinetic_energy)),
        ("potential_energy", "Potential energy V \\[J\\].", "V", Some(equations.potential_energy)),
        ("energy", "Energy: the integral v·∂L/∂v − L of a given Lagrangian \\[J\\].", "E", whole),
        (
            "jacobi_integral",
            "Jacobi integral v·∂L/∂v − L \\[J\\]: conserved where neither L depends on time nor forces do work, \
             while T + V is not.",
            "h",
            equations.jacobi_integral,
        ),
        ("power", "Power v·(Q − ∂D/∂v) of the applied forces \\[W\\].", "P", equations.power),
    ] {
        if let Some(node) = node {
            text.push_str(&scalar(emission, name, doc, symbol, node));
        }
    }
    if whole.is_none() {
        let scalar = &emission.scalar;
        let signature = format!("energy(&self, state: &{}) -> {scalar}", emission.state_type());
        let body = "self.kinetic_energy(state) + self.potential_energy(state)";
        text.push_str(&method("Energy T + V \\[J\\].", &signature, body));
    }
    text.push_str(&eliminated::completions(emission));
    text.push_str(&oriented::state(emission));
    (text, sides)
}

/// The parameters of a method on a state, with the inputs if the nodes need them.
pub(super) fn arguments(emission: &Emission<'_>, nodes: &[NodeId]) -> String {
    let graph = &emission.model.graph;
    let uses = |kind| nodes.iter().any(|&node| graph.dependence(node).meets(kind));
    let state = Dependence::COORDINATES.union(Dependence::VELOCITIES).union(Dependence::TIME);
    let name = if uses(state) { "state" } else { "_state" };
    let mut text = format!("&self, {name}: &{}", emission.state_type());
    if uses(Dependence::INPUTS) {
        text.push_str(&format!(", inputs: &{}", emission.input_type()));
    }
    text
}

fn accelerations(emission: &Emission<'_>) -> String {
    let inputs = !emission.model.inputs.is_empty();
    let (parameter, argument) = if inputs {
        (format!(", inputs: &{}", emission.input_type()), "inputs")
    } else {
        (String::new(), "&[]")
    };
    let (reactions, singular) = if emission.equations.conditions.count() > 0 {
        (" + Aᵀλ, with the multipliers λ of the constraints solved for", "system, with its cause")
    } else {
        ("", "mass matrix, with the coordinate")
    };
    let doc = format!(
        "Accelerations a that solve M(q, v, t) a = Q − ∂D/∂v − b(q, v, t){reactions}.\n\n\
         The mass matrix is {}.\n\n# Errors\n\nA singular {singular} and the time.",
        emission.solution.describe()
    );
    let signature = format!(
        "accelerations(&self, state: &{}{parameter}) -> ::core::result::Result<{}, lagrange::MotionError<{}>>",
        emission.state_type(),
        emission.vector_type(),
        emission.scalar,
    );
    let held = emission.equations.conditions.count();
    let (count, given) = (emission.count(), emission.model.inputs.len());
    let sound = if held > 0 {
        format!("lagrange::constraints::sound::<Self, {count}, {given}, {held}>(self, state)?;\n")
    } else {
        String::new()
    };
    let body = format!(
        "lagrange::reading::checked(self, state, {argument})?;\n\
         {sound}\
         let constants = lagrange::System::constants(self);\n\
         let accelerations = lagrange::System::accelerations_at(\
             self, &constants, state.t, &state.q, &state.v, {argument});\n\
         lagrange::solve::finite(self, &constants, state, accelerations)"
    );
    method(&doc, &signature, &body)
}

pub(super) fn mass_matrix(emission: &mut Emission<'_>) -> String {
    let doc = "Mass matrix M = ∂²L/∂v∂v, symmetric, rows and columns in the order of the coordinates.";
    let (count, scalar) = (emission.count(), emission.scalar.clone());
    let signature = |arguments: String| {
        format!("mass_matrix({arguments}) -> lagrange::nalgebra::SMatrix<{scalar}, {count}, {count}>")
    };
    let MassMatrix::Formed(rows) = &emission.equations.mass else {
        // Its columns are the momenta of unit velocities: code for each entry would grow with their number.
        let body = "lagrange::solve::mass_of(|&v| self.momenta(&lagrange::State { v, ..*state }))";
        return method(doc, &signature(arguments(emission, &emission.equations.momenta.clone())), body);
    };
    let entries: Vec<NodeId> = rows.iter().flatten().copied().collect();
    let entries = simplify(&mut emission.model.graph, &mut emission.model.hints, &entries);
    let body = body::plain(emission.model, &scalar, &entries, Source::State, |values| {
        if let [single] = &values[..] {
            return format!("lagrange::solve::symmetric([[{single}]])");
        }
        body::lower_triangle(&scalar, count, values) + "lagrange::solve::symmetric(mass)"
    });
    method(doc, &signature(arguments(emission, &entries)), &body)
}

fn vector(
    emission: &mut Emission<'_>,
    name: &str,
    doc: &str,
    symbol: &str,
    nodes: &[NodeId],
) -> (String, Vec<NodeId>) {
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, nodes);
    let doc = format!("{doc}{}", docs::equations(emission.model, symbol, &nodes));
    let signature = format!("{name}({}) -> {}", arguments(emission, &nodes), emission.vector_type());
    let body = body::plain(emission.model, &emission.scalar, &nodes, Source::State, Values::list);
    (method(&doc, &signature, &body), nodes)
}

/// A method on a state that returns a number.
pub(super) fn scalar(
    emission: &mut Emission<'_>,
    name: &str,
    doc: &str,
    symbol: &str,
    node: NodeId,
) -> String {
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &[node]);
    let doc = format!("{doc}{}", docs::equation(emission.model, symbol, nodes[0]));
    let signature = format!("{name}({}) -> {}", arguments(emission, &nodes), emission.scalar);
    let body =
        body::plain(emission.model, &emission.scalar, &nodes, Source::State, |values| values.join(", "));
    method(&doc, &signature, &body)
}
