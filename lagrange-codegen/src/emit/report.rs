//! The constants that describe a system: `COORDINATES`, `CONSTRAINTS`, `COST` and `STRUCTURE`.

use proc_macro2::TokenStream;
use quote::quote;

use super::block::Evaluation;
use super::{Emission, regimes, turning};
use crate::jets::Hidden;
use crate::regimes::LOAD;
use crate::regimes::Regimes;
use crate::schedule::Operations;
use crate::structure::Facts;

/// The constants.
pub(super) fn report(
    emission: &Emission<'_>,
    switching: Option<&Regimes>,
    before: Operations,
    after: Evaluation,
) -> TokenStream {
    let cost = |operations: Operations| {
        let Operations { additions, multiplications, divisions, square_roots, functions } = operations;
        quote!(lagrange::Cost::new(#additions, #multiplications, #divisions, #square_roots, #functions))
    };
    let (before, emitted) = (cost(before), cost(after.operations));
    let mass_matrix = match switching.filter(|switching| switching.has_contacts()) {
        Some(switching) => switching.solution.describe(),
        None => emission.solution.describe(),
    };
    let has_contacts = switching.is_some_and(Regimes::has_contacts);
    let (mut facts, mut skipped) =
        (emission.facts.found(emission.model), emission.facts.skipped(emission.model));
    if has_contacts {
        // Energy and momenta are not constant with contacts, and any reaction may change with any quantity.
        let held =
            Facts { separable: false, conservative: false, cyclic: Vec::new(), ..emission.facts.clone() };
        (facts, skipped) = (held.found(emission.model), held.skipped(emission.model));
        let needed = ["constraints", "dissipation", "the solution of a linear system"];
        skipped.retain(|line| !needed.iter().any(|start| line.starts_with(start)));
    }
    match emission.jets.filter(|_| !has_contacts) {
        Some(jets) => {
            let kinematics = turning::described(emission);
            facts.push(jets.describe() + kinematics);
            if jets.is_momentum_linear() {
                let line = "in Taylor series: momenta, which are the velocities times constants";
                skipped.push(line.to_owned());
            }
        }
        None if switching.is_some() => {}
        None => {
            facts.push("not smooth: a function has a kink or a jump, so there is no Taylor series".to_owned())
        }
    }
    facts.extend(after.loops.describe());
    facts.extend(switching.into_iter().flat_map(regimes::facts));
    let hidden = switching.map_or(emission.hidden, |switching| switching.hidden[0].as_ref());
    facts.extend(hidden.map(Hidden::describe));
    let coordinates: Vec<String> =
        emission.model.coordinates.iter().map(|quantity| quantity.written()).collect();
    let count = coordinates.len();
    let rows = switching.map_or(&emission.model.constraints, |switching| &switching.rows.constraints);
    let named = rows.iter().filter(|constraint| !constraint.name.starts_with(LOAD));
    let constraints: Vec<String> = named.map(|constraint| constraint.written()).collect();
    let constraints = (!constraints.is_empty()).then(|| {
        let count = constraints.len();
        quote! {
            /// The constraints in the order of all vectors of them, to name the one that an error speaks of.
            pub const CONSTRAINTS: [&'static str; #count] = [#(#constraints),*];
        }
    });
    quote! {
        /// The coordinates in the order of all vectors, to name the one that an error speaks of.
        pub const COORDINATES: [&'static str; #count] = [#(#coordinates),*];

        #constraints

        /// Operations of one evaluation of the accelerations: all of them as derived, and as emitted without
        /// those done once per run. A factorisation in the runtime is in neither.
        pub const COST: lagrange::Costs = lagrange::Costs { before: #before, after: #emitted };

        /// What was found in this system, and what its code therefore leaves out.
        pub const STRUCTURE: lagrange::Structure = lagrange::Structure {
            mass_matrix: #mass_matrix,
            facts: &[#(#facts),*],
            skipped: &[#(#skipped),*],
        };
    }
}
