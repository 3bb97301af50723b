//! What a model tells about itself, where the attribute asks for `analysis`.
//!
//! | file | what it emits |
//! | --- | --- |
//! | `covariant` | Christoffel symbols, the Coriolis matrix, gyroscopic matrix |
//! | `inertia` | T2, T1, T0, the inertia forces, rates of the energy and of the Jacobi integral |
//! | `hamilton` | the Hamiltonian form: velocities from momenta, H, canonical equations |
//! | `conserved` | cyclic coordinates and the integrals of Noether's theorem |
//! | `regressor` | the equations as a linear function of lumped parameters |
//! | `stubs` | what stands for all that after a mistake |
//! | `verify` | the certificate, and the test that asks for it |

mod conserved;
mod covariant;
mod hamilton;
mod inertia;
mod regressor;
mod stubs;
mod verify;

use super::Emission;
use super::constraints::{balance_at, of_balance};
use super::methods::{arguments, method};
use crate::expr::NodeId;
use crate::mechanics::analysis::Covariant;
pub(super) use stubs::{certificate, stubs};
pub(super) use verify::test;

/// The items that the attribute's `analysis` adds.
pub(super) struct Analysis {
    /// Constants and methods as text.
    pub methods: String,
    /// The items of `Verifiable` as text.
    pub certificate: String,
}

/// Names of the methods. No function of the user may have one of them.
pub(crate) const METHODS: [&str; 17] = [
    "kinetic_energy_parts",
    "inertia_forces",
    "energy_rate",
    "jacobi_rate",
    "christoffel_first",
    "christoffel_second",
    "coriolis_matrix",
    "gyroscopic_matrix",
    "velocities_from_momenta",
    "hamiltonian",
    "canonical_at",
    "cyclic_momenta",
    "conserved",
    "regressor",
    "lumped_parameters",
    "verify",
    "verify_at",
];

/// All items but the test.
pub(super) fn analysis(emission: &mut Emission<'_>) -> Analysis {
    let covariant = Covariant::of(emission.model, emission.equations);
    let mut text = inertia::methods(emission, covariant.as_ref());
    if let Some(covariant) = &covariant {
        text.push_str(&covariant::methods(emission, covariant));
    }
    text.push_str(&hamilton::methods(emission, covariant.is_some()));
    let (items, conserved) = conserved::items(emission);
    text.push_str(&items);
    text.push_str(&regressor::items(emission));
    text.push_str(&verify::methods(emission));
    let certificate = verify::implementation(emission, covariant.is_some(), conserved);
    Analysis { methods: text, certificate }
}

/// A method that solves for the accelerations and multipliers of a motion and evaluates a node with them.
fn along_motion(emission: &mut Emission<'_>, name: &str, doc: &str, node: NodeId) -> String {
    let (scalar, state) = (emission.scalar.to_string(), emission.state_type());
    let (parameter, argument) = if emission.model.inputs.is_empty() {
        (String::new(), "")
    } else {
        (format!(", inputs: &{}", emission.input_type()), ", inputs")
    };
    let solved = if emission.equations.conditions.count() > 0 {
        balance_at(emission)
    } else {
        format!(
            "let balance = lagrange::Balance::<_, {}, 0> {{ \
             accelerations: self.accelerations(state{argument})?, multipliers: [], independence: lagrange::Independence::clear(0) }};\n",
            emission.count()
        )
    };
    let body = of_balance(emission, &solved, &[node], |values| values.join(", "));
    let doc = format!("{doc}\n\n# Errors\n\nA singular system, with its cause and the time.");
    let result = format!("::core::result::Result<{scalar}, lagrange::MotionError<{scalar}>>");
    let signature = format!("{name}(&self, state: &{state}{parameter}) -> {result}");
    format!("#[allow(unused_variables)]\n{}", method(&doc, &signature, &body))
}

/// The parameters of a method on a state and given accelerations.
fn with_accelerations(emission: &Emission<'_>, nodes: &[NodeId]) -> String {
    format!("{}, accelerations: &{}", arguments(emission, nodes), emission.vector_type())
}
