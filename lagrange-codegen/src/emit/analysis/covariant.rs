//! The mass matrix as a metric.

use crate::emit::body::{self, Source};
use crate::emit::constraints::rows;
use crate::emit::methods::{arguments, method};
use crate::emit::{Emission, docs, scalar};
use crate::expr::NodeId;
use crate::mechanics::analysis::{Covariant, christoffel};
use crate::simplify::simplify;

/// The most coordinates for which Christoffel symbols, a cube of numbers, are emitted.
const MOST: usize = 16;

/// All methods.
pub(super) fn methods(emission: &mut Emission<'_>, covariant: &Covariant) -> String {
    let mut text = matrix(
        emission,
        "coriolis_matrix",
        "Coriolis matrix C(q, v, t) with C_kj = Σᵢ \\[ij, k] vᵢ + ½ ∂M_kj/∂t: Ṁ − 2C is skew, so that v·(M a + C v) is the rate of \
         ½ vᵀM v. Where M does not depend on time, C v are the Coriolis and centrifugal terms of the bias (Siciliano et al., \
         *Robotics*, section 7.2.1).",
        &covariant.coriolis,
    );
    let graph = &emission.model.graph;
    if covariant.gyroscopic.iter().flatten().any(|&entry| !graph.is_zero(entry)) {
        text.push_str(&matrix(
            emission,
            "gyroscopic_matrix",
            "Gyroscopic matrix G(q, t) = ∂g/∂q − (∂g/∂q)ᵀ of the part g·v of L that is linear in the velocities: skew; G v are \
             Coriolis forces of a moving frame, and magnetic ones.",
            &covariant.gyroscopic,
        ));
    }
    if emission.count() <= MOST {
        text.push_str(&symbols(emission));
    }
    text
}

fn matrix(emission: &mut Emission<'_>, name: &str, doc: &str, entries: &[Vec<NodeId>]) -> String {
    let count = emission.count();
    let entries: Vec<NodeId> = entries.iter().flatten().copied().collect();
    let entries = simplify(&mut emission.model.graph, &mut emission.model.hints, &entries);
    let scalar = emission.scalar.clone();
    let signature = format!(
        "{name}({}) -> lagrange::nalgebra::SMatrix<{scalar}, {count}, {count}>",
        arguments(emission, &entries)
    );
    let body = body::plain(emission.model, &scalar, &entries, Source::State, |values| {
        let filled: Vec<Vec<String>> = values.chunks(count).map(<[String]>::to_vec).collect();
        rows(&scalar, "matrices", count, &filled) + "lagrange::constraints::matrix(&matrices)"
    });
    method(doc, &signature, &body)
}

fn symbols(emission: &mut Emission<'_>) -> String {
    let count = emission.count();
    let symbols = christoffel(emission.model, emission.equations.mass.rows());
    let indices: Vec<[usize; 3]> =
        (0..count).flat_map(|k| (0..count).flat_map(move |i| (0..=i).map(move |j| [k, i, j]))).collect();
    let nodes: Vec<NodeId> = symbols.into_iter().flatten().flatten().collect();
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let name = |i: usize| emission.model.coordinates[i].written();
    let named = indices
        .iter()
        .zip(&nodes)
        .filter(|&(_, &node)| !emission.model.graph.is_zero(node))
        .map(|(&[k, i, j], &node)| (format!("[{} {}, {}]", name(j), name(i), name(k)), node));
    let shown = docs::named(emission.model, named);
    let scalar = emission.scalar.clone();
    let cube = format!("[[[{scalar}; {count}]; {count}]; {count}]");
    let zero = scalar::zero(&scalar);
    let body = body::plain(emission.model, &scalar, &nodes, Source::State, |values| {
        let mut text = format!("let mut matrices = [[[{zero}; {count}]; {count}]; {count}];\n");
        for ([k, i, j], value) in indices.iter().zip(&values[..]).filter(|&(_, value)| *value != zero) {
            text.push_str(&format!("matrices[{k}][{i}][{j}] = {value};\n"));
        }
        text + "lagrange::analysis::symmetric(matrices)"
    });
    let first = method(
        &format!(
            "Christoffel symbols of the first kind \\[ij, k] = ½ (∂M_ik/∂q_j + ∂M_jk/∂q_i − ∂M_ij/∂q_k) as `[k][i][j]`: \
             Σ \\[ij, k] vᵢ vⱼ is the part of the bias quadratic in the velocities (Lurie, *Analytical Mechanics*, chapter \
             4).{shown}"
        ),
        &format!("christoffel_first({}) -> {cube}", arguments(emission, &nodes)),
        &body,
    );
    let second = method(
        "Christoffel symbols of the second kind Γᵏ_ij = Σ (M⁻¹)_kl \\[ij, l] as `[k][i][j]`: aₖ + Σ Γᵏ_ij vᵢ vⱼ is the \
         contravariant acceleration.\n\n# Errors\n\nA singular mass matrix, with the coordinate and the time.",
        &format!(
            "christoffel_second(&self, state: &{}) -> ::core::result::Result<{cube}, lagrange::MotionError<{scalar}>>",
            emission.state_type()
        ),
        &format!(
            "lagrange::analysis::second_kind(&self.mass_matrix(state), &self.christoffel_first(state), state.t)\
             .map_err(|error| error.named(&<Self as lagrange::System<{}, {}>>::NAMES))",
            emission.count(),
            emission.model.inputs.len()
        ),
    );
    first + &second
}
