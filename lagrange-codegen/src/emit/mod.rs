//! The tokens of the expansion, in their order.

mod analysis;
mod block;
mod body;
mod companion;
mod constraints;
mod docs;
mod eliminated;
mod equations;
mod events;
mod gather;
mod hidden;
mod jets;
mod linearization;
mod meanings;
mod methods;
mod names;
mod oriented;
mod over;
mod parts;
mod proofs;
mod readings;
mod records;
mod regimes;
mod report;
mod scalar;
mod screws;
mod steps;
mod stubs;
mod system;
mod tokens;
mod turning;
mod velocities;

use proc_macro2::TokenStream;
use quote::quote;

use crate::diagnostics::Diagnostics;
use crate::jets::{Hidden, Jets, Watched};
use crate::mechanics::Equations;
use crate::model::{Constraint, Model};
use crate::orders::Expansions;
use crate::regimes::{LOAD, Regimes};
use crate::schedule::Operations;
use crate::structure::{Facts, Solution};
use crate::syntax::{Item, Scalar};

pub(crate) use analysis::METHODS as ANALYSIS_METHODS;
pub(crate) use constraints::{METHODS as CONSTRAINT_METHODS, is_force_on_place};
pub(crate) use eliminated::METHODS as COMPLETIONS;
pub(crate) use methods::METHODS;
pub(crate) use oriented::METHOD as STATE_METHOD;
pub(crate) use stubs::stubs;

/// The input of emission. The graph grows while expressions are simplified.
pub(crate) struct Emission<'a> {
    pub item: &'a Item,
    /// The scalar of the emitted code.
    pub scalar: Scalar,
    /// Whether the code is that of the equations over any scalar. Motions with derivatives and lanes of an
    /// ensemble run on it.
    pub is_over: bool,
    pub model: &'a mut Model,
    pub equations: &'a Equations,
    /// The equations that a motion solves: with orientations, those for angular velocities.
    pub solved: &'a Equations,
    pub facts: &'a Facts,
    pub solution: &'a Solution,
    /// What functions depend on that can hide from a step; `None` without such functions.
    pub hidden: Option<&'a Hidden>,
    /// What a search for each event has to know.
    pub in_events: &'a [Watched],
    /// The recurrences of a smooth system.
    pub jets: Option<&'a Jets>,
    /// The operations of an order.
    pub orders: Option<&'a Expansions>,
    /// The integrator, if neither that of smooth systems nor that of others.
    pub method: Option<String>,
}

impl Emission<'_> {
    fn count(&self) -> usize {
        self.model.coordinates.len()
    }

    /// Whether the numbers of a state are the declared coordinates and velocities.
    fn is_state_complete(&self) -> bool {
        self.model.eliminated.is_empty() && !self.item.has_orientations()
    }

    /// The integrator of the system.
    fn method(&self) -> String {
        let usual = if self.jets.is_some() { "lagrange::Jets" } else { "lagrange::Dop853" };
        self.method.clone().unwrap_or_else(|| usual.to_owned())
    }

    fn state_type(&self) -> String {
        format!("lagrange::State<{}, {}>", self.scalar, self.count())
    }

    fn vector_type(&self) -> String {
        format!("[{}; {}]", self.scalar, self.count())
    }

    fn input_type(&self) -> String {
        format!("[{}; {}]", self.scalar, self.model.inputs.len())
    }
}

/// The whole expansion.
pub(crate) fn emit(
    mut emission: Emission<'_>,
    mut switching: Option<Regimes>,
    before: Operations,
    diagnostics: &Diagnostics,
) -> TokenStream {
    emission.model.locals = names::locals(emission.model, emission.item.least_loop);
    emission.method = switching.as_ref().map(regimes::method);
    let has_contacts = switching.as_ref().is_some_and(Regimes::has_contacts);
    // Where kinks stand outside the equations of motion, an energy jumps there: no series may pass them.
    emission.jets = emission.jets.filter(|_| has_contacts || switching.is_none());
    let (system, constants, surface, after) = match emission.solution.saddle {
        Some(method) => {
            let all = constraints::system(&mut emission, method);
            (all.system, all.constants, Some(all.surface), all.evaluation)
        }
        None => {
            let (system, after) = system::system(&mut emission);
            (system, system::NO_CONSTANTS.to_owned(), None, after)
        }
    };
    let system = match &switching {
        Some(switching) if has_contacts => regimes::system(&emission, switching, &constants),
        Some(switching) => system + &regimes::passed(&emission, switching),
        None => system,
    };
    let system = system + &readings::implementation(&mut emission);
    let (mut methods, sides) = methods::methods(&mut emission);
    if surface.is_some() {
        methods.push_str(&match has_contacts {
            // The other methods of constraints depend on the contacts.
            true => constraints::consistent(&emission),
            false => constraints::methods(&mut emission),
        });
    }
    let events = events::events(&emission);
    methods.push_str(&events.methods);
    let regimes = switching.as_mut().map(|switching| regimes::regimes(&emission, switching));
    let report = report::report(&emission, switching.as_ref(), before, after);
    let smooth = emission.jets.zip(emission.orders);
    let smooth = smooth.map(|(jets, orders)| jets::jets(&mut emission, jets, orders));
    let steps = switching.as_ref().and_then(|switching| steps::steps(&emission, switching));
    let asked = emission.item.jacobians;
    let linearization = (asked && !has_contacts).then(|| linearization::linearization(&mut emission));
    let sensitive = asked.then(|| over::sensitive(&emission));
    let over = asked.then(|| over::over(&mut emission, switching.as_mut()));
    let certificate = emission.item.analysis.then(|| {
        let analysis = analysis::analysis(&mut emission);
        methods.push_str(&analysis.methods);
        analysis.certificate
    });
    let written = equations::Equations::of(&mut emission, &sides);
    methods.push_str(&written.constant(emission.model, emission.item.analysis));
    if emission.item.formulas {
        methods.push_str(&written.formulas(emission.model));
    }
    let page = emission.item.analysis.then(|| {
        let page = equations::page(&mut emission, &written, after.operations);
        quote!(#[doc = #page])
    });
    let parameters = tokens::Parameters::new(emission.model, diagnostics);
    let (system, methods) = (parameters.parse(&system), parameters.parse(&methods));
    let linearization =
        linearization.map(|linearization::Items { linearized, carried, tangent, parametric }| {
            let carried =
                carried.map(|carried| [carried.path, carried.items].map(|text| parameters.parse(&text)));
            ([linearized, tangent, parametric].map(|text| parameters.parse(&text)), carried)
        });

    let Item { self_ty, generics, crate_path, cleaned, .. } = emission.item;
    let smooth = smooth.map(|text| parameters.parse(&text));
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let (count, inputs) = (emission.count(), emission.model.inputs.len());
    let records = records::records(emission.item);
    let proved = if has_contacts { Vec::new() } else { proofs::proved(emission.facts) };
    let proofs = proofs::proofs(emission.item, &proved, count, inputs);
    let surface = surface.map(|items| {
        let (items, held) = (parameters.parse(&items), emission.equations.conditions.count());
        let constrained = (!has_contacts).then(|| {
            let items = parameters.parse(&constraints::implementations(&emission));
            quote! {
                #[automatically_derived]
                #[allow(clippy::all)]
                impl #impl_generics lagrange::Constrained<#count, #inputs> for #self_ty #where_clause {
                    #items
                }
            }
        });
        quote! {
            #[automatically_derived]
            #[allow(clippy::all)]
            impl #impl_generics lagrange::Surface<#count, #inputs, #held> for #self_ty #where_clause {
                #items
            }

            #constrained
        }
    });
    let rows =
        switching.as_ref().map_or(&emission.model.constraints, |switching| &switching.rows.constraints);
    let reactions = (!rows.is_empty()).then(|| constraints::record(emission.item, &constraints::held(rows)));
    let regimes = regimes.map(|regimes::Items { companion, switching, constrained, rows, kinks }| {
        let record = constraints::record_ident(emission.item);
        let type_of_rows = if rows > 0 { quote!(#record<__Row>) } else { quote!([__Row; 0]) };
        let named = quote! {
            impl #impl_generics lagrange::NamedRows<#rows> for #self_ty #where_clause {
                type Rows<__Row> = #type_of_rows;
            }
        };
        let switching = parameters.parse(&switching);
        let constrained = constrained.map(|items| {
            let items = parameters.parse(&items);
            quote! {
                #[automatically_derived]
                #[allow(clippy::all)]
                impl #impl_generics lagrange::Constrained<#count, #inputs> for #self_ty #where_clause {
                    #items
                }
            }
        });
        quote! {
            #companion

            #[automatically_derived]
            #[allow(clippy::all, unused_variables)]
            impl #impl_generics lagrange::Switching<#count, #inputs, #rows, #kinks> for #self_ty #where_clause {
                #switching
            }

            #constrained
            #named
            #steps
        }
    });
    let by = emission.model.sensitivities.len();
    let sensitive = sensitive.map(|items| {
        let (items, held) = (parameters.parse(&items), rows.len());
        let directions = over::directions(count, by);
        quote! {
            #[automatically_derived]
            #[allow(clippy::all, unused_variables)]
            impl #impl_generics lagrange::Sensitive<#count, #inputs, #held, #by, #directions> for #self_ty #where_clause {
                #items
            }
        }
    });
    let linearization = linearization.map(|([linearized, tangent, parametric], carried)| {
        let held = emission.equations.conditions.count();
        let carried = carried.map(|[path, items]| {
            quote! {
                #[automatically_derived]
                #[allow(clippy::all, unused_variables)]
                impl #impl_generics #path for #self_ty #where_clause {
                    #items
                }
            }
        });
        quote! {
            #carried

            #[automatically_derived]
            #[allow(clippy::all, unused_variables)]
            impl #impl_generics lagrange::Linearized<#count, #inputs> for #self_ty #where_clause {
                #linearized
            }

            #[automatically_derived]
            #[allow(clippy::all, unused_variables)]
            impl #impl_generics lagrange::Tangent<#count, #inputs, #held> for #self_ty #where_clause {
                #tangent
            }

            #[automatically_derived]
            #[allow(clippy::all, unused_variables)]
            impl #impl_generics lagrange::Parametric<#count, #inputs, #held, #by> for #self_ty #where_clause {
                #parametric
            }
        }
    });
    let lengths = tokens::length_checks(emission.model, diagnostics);
    let lengths = (!lengths.is_empty()).then(|| {
        quote! {
            #[doc(hidden)]
            #[allow(dead_code)]
            fn __lengths(&self) { #lengths }
        }
    });
    let velocities = velocities::velocities(&mut emission, diagnostics);
    let getters = readings::getters(&emission);
    let meanings = meanings::meanings(emission.item, emission.model, diagnostics);
    let test = analysis::test(&emission);
    let certificate = certificate.map(|items| {
        let items = parameters.parse(&items);
        quote! {
            #[automatically_derived]
            #[allow(clippy::all, unused_variables)]
            impl #impl_generics lagrange::Verifiable<#count, #inputs> for #self_ty #where_clause {
                #items
            }
        }
    });
    let events::Items { named: named_events, guards, .. } = events;
    let smooth = smooth.filter(|_| !has_contacts).map(|items| {
        quote! {
            #[automatically_derived]
            #[allow(clippy::all)]
            impl #impl_generics lagrange::Smooth<#count, #inputs> for #self_ty #where_clause {
                #items
            }
        }
    });
    quote! {
        #cleaned
        #records
        #reactions
        #named_events
        const _: () = {
            use #crate_path::__private as lagrange;

            #page
            #[automatically_derived]
            #[allow(clippy::all)]
            impl #impl_generics #self_ty #where_clause {
                #report
                #lengths
                #meanings
                #getters
                #methods
                #velocities
            }

            #[automatically_derived]
            #[allow(clippy::all)]
            impl #impl_generics lagrange::System<#count, #inputs> for #self_ty #where_clause {
                #system
            }

            #surface
            #proofs
            #smooth
            #linearization
            #sensitive
            #over
            #regimes
            #guards
            #certificate
        };
        #test
    }
}

/// The constants `NAMES` and, if there are orientations, `ORIENTATIONS` as text.
fn names_of_parts(model: &Model) -> String {
    let coordinates: Vec<String> = model.coordinates.iter().map(|quantity| quantity.written()).collect();
    // The load of a friction has no name of the user's; the friction has.
    let name = |constraint: &Constraint| match constraint.name.strip_prefix(LOAD) {
        Some(friction) => friction.to_owned(),
        None => constraint.written(),
    };
    let constraints: Vec<String> = model.constraints.iter().map(name).collect();
    let mut text = format!(
        "const NAMES: lagrange::Names = lagrange::Names {{ coordinates: &{coordinates:?}, constraints: &{constraints:?} }};\n"
    );
    let orientations = &model.orientations;
    if !orientations.is_empty() {
        text.push_str(&format!("const ORIENTATIONS: &'static [usize] = &{orientations:?};\n"));
    }
    text
}
