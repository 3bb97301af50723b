//! The kinetic energy taken apart, the inertia forces, and balances of energy.

use super::{along_motion, with_accelerations};
use crate::emit::body::{self, Source};
use crate::emit::methods::{arguments, method, scalar};
use crate::emit::names::name_accelerations;
use crate::emit::{Emission, docs};
use crate::mechanics::analysis::{Balance, Covariant, Inertia};
use crate::simplify::simplify;

/// All methods.
pub(super) fn methods(emission: &mut Emission<'_>, covariant: Option<&Covariant>) -> String {
    let mut text = String::new();
    if let Some(covariant) = covariant {
        let inertia = Inertia::of(emission.model, emission.equations, covariant);
        text.push_str(&parts(emission, &inertia));
        text.push_str(&forces(emission, &inertia));
    }
    text + &rates(emission)
}

fn parts(emission: &mut Emission<'_>, inertia: &Inertia) -> String {
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &inertia.parts);
    let named = ["T2", "T1", "T0"].map(str::to_owned).into_iter().zip(nodes.iter().copied());
    let doc = format!(
        "Parts (T₂, T₁, T₀) of L = T₂ + T₁ + T₀ − V of degrees two, one and zero in the velocities \\[J\\]; of a Lagrangian given as \
         a whole the part without velocities is −V. The Jacobi integral is T₂ − T₀ + V.{}",
        docs::named(emission.model, named)
    );
    let scalar = emission.scalar.clone();
    let signature =
        format!("kinetic_energy_parts({}) -> ({scalar}, {scalar}, {scalar})", arguments(emission, &nodes));
    let body = body::plain(emission.model, &scalar, &nodes, Source::State, |values| {
        format!("({})", values.join(", "))
    });
    method(&doc, &signature, &body)
}

fn forces(emission: &mut Emission<'_>, inertia: &Inertia) -> String {
    name_accelerations(emission.model);
    let count = emission.count();
    let kinds = [
        ("relative", &inertia.relative),
        ("coriolis", &inertia.coriolis),
        ("gyroscopic", &inertia.gyroscopic),
        ("transport", &inertia.transport),
    ];
    let nodes: Vec<_> = kinds.iter().flat_map(|(_, nodes)| nodes.iter().copied()).collect();
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let scalar = emission.scalar.clone();
    let signature = format!(
        "inertia_forces({}) -> lagrange::InertiaForces<{scalar}, {count}>",
        with_accelerations(emission, &nodes)
    );
    let body = body::plain(emission.model, &scalar, &nodes, Source::State, |values| {
        let fields: Vec<String> = kinds
            .iter()
            .zip(values.chunks(count))
            .map(|((name, _), values)| format!("{name}: [{}]", values.join(", ")))
            .collect();
        format!("lagrange::InertiaForces {{ {} }}", fields.join(", "))
    });
    method(
        "Generalized inertia forces −(d/dt ∂T/∂v − ∂T/∂q) at given accelerations, apart by their origin.",
        &signature,
        &body,
    )
}

fn rates(emission: &mut Emission<'_>) -> String {
    let Balance { energy_rate, jacobi_rate } = Balance::of(emission.model, emission.equations);
    let mut text = String::new();
    // With constraints the rate of the energy is emitted elsewhere.
    if emission.equations.conditions.count() == 0 {
        let doc = "d(T + V)/dt along the motion \\[W\\]: the power of the applied forces, and the explicit change of V and T.";
        text.push_str(&along_motion(emission, "energy_rate", doc, energy_rate));
    }
    if emission.equations.jacobi_integral.is_some() {
        let doc = "Rate of the Jacobi integral along the motion \\[W\\]: the power of applied forces and of moving constraints, \
                   less ∂L/∂t.";
        text.push_str(&if emission.equations.conditions.count() == 0 {
            scalar(emission, "jacobi_rate", doc, "h′", jacobi_rate)
        } else {
            along_motion(emission, "jacobi_rate", doc, jacobi_rate)
        });
    }
    text
}
