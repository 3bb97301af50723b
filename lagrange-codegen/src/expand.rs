//! The pipeline on one screen: tokens → Item → Model → Equations → Facts, Solution → tokens.

use std::panic::{AssertUnwindSafe, catch_unwind};

use proc_macro2::{Span, TokenStream};
use quote::quote;

use crate::diagnostics::{Diagnostics, catalogue, physics};
use crate::emit::{
    ANALYSIS_METHODS, COMPLETIONS, CONSTRAINT_METHODS, Emission, METHODS, STATE_METHOD, emit,
    is_force_on_place, stubs,
};
use crate::expr::NodeId;
use crate::mechanics::Equations;
use crate::model::Model;
use crate::orders::Expansions;
use crate::schedule::{Operations, plan};
use crate::structure::{Facts, Solution};
use crate::syntax::{Incomplete, Item};
use crate::{eliminate, jets, lower, mechanics, regimes, syntax};

/// Expands `#[lagrangian(args)] item`. Generated code names `default_crate` unless the user says `crate =
/// path`. If the description has mistakes, the expansion has the messages about them, and as much of the
/// user's item and of the generated ones that the compiler has nothing to add.
pub fn expand(args: TokenStream, item: TokenStream, default_crate: &str) -> TokenStream {
    expand_with(args, item, default_crate, Settings::default())
}

/// Settings of an expansion that tools and tests change.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settings {
    /// The constants `EQUATIONS_LATEX` and `EQUATIONS_MATHML`, which otherwise only `analysis` adds.
    pub formulas: bool,
    /// The fewest alike values that a loop computes, if other than usual.
    pub least_loop: Option<usize>,
}

/// Expands with settings.
pub fn expand_with(
    args: TokenStream,
    item: TokenStream,
    default_crate: &str,
    settings: Settings,
) -> TokenStream {
    let mut diagnostics = Diagnostics::new();
    // Tokens that are nested too deep must not reach code that recurses into expressions, not even to
    // recover.
    if let Some(span) = [&args, &item].into_iter().find_map(|tokens| syntax::too_deep(tokens.clone())) {
        diagnostics.error(span, catalogue::too_deep(syntax::DEEPEST));
        return diagnostics.to_tokens();
    }
    let mut parsed = None;
    let attempt = || {
        parsed = syntax::parse(args, item.clone(), default_crate, &mut diagnostics);
        let parsed = parsed.as_mut()?;
        parsed.formulas |= settings.formulas;
        parsed.least_loop = settings.least_loop.unwrap_or(parsed.least_loop);
        try_expand(parsed, &mut diagnostics)
    };
    // A panic is a bug of the macro. It becomes an error on the attribute that asks for a report.
    match catch_unwind(AssertUnwindSafe(attempt)) {
        Ok(Some(expansion)) => return expansion,
        Ok(None) => {}
        Err(_) => diagnostics.error(Span::call_site(), physics::internal_error()),
    }
    // The compiler has reported what does not parse. Other mistakes are reported once everything parses.
    let messages = match parsed.as_ref().and_then(|item| item.incomplete.as_ref()) {
        Some(Incomplete::Form(reason)) => syntax::refusal(reason),
        Some(Incomplete::Declarations) | None => diagnostics.to_tokens(),
    };
    // All items that a program may use of a system exist, as far as declarations can be read.
    let stubs = parsed.as_mut().map(stubs);
    // rust-analyzer compares the expansion of the text with that of the text with a word at the cursor,
    // position by position. So nothing that depends on the mistake stands before the user's block.
    let recovered = syntax::recover(item);
    quote!(#recovered #messages #stubs)
}

fn try_expand(item: &Item, diagnostics: &mut Diagnostics) -> Option<TokenStream> {
    if item.incomplete.is_some() {
        return None;
    }
    let mut model = lower::lower(item, diagnostics);
    if diagnostics.has_errors() {
        return None;
    }
    eliminate::eliminate(&mut model, diagnostics);
    if diagnostics.has_errors() {
        return None;
    }
    regimes::untie(&mut model);
    let described = (!model.turning.is_empty()).then(|| model.clone());
    let turning = mechanics::turning(&mut model);
    eliminate::in_parameters(&mut model);
    let allows = |lint: &str| item.allows(lint);
    // Whether anything beside the accelerations is made of the entries of the mass matrix.
    let asks_for_mass = item.jacobians || item.analysis;
    let mut equations = mechanics::derive(&mut model, asks_for_mass, &allows, diagnostics)?;
    let mut before = as_derived(&mut model, &equations, diagnostics);
    if before.is_none() {
        equations = mechanics::derive(&mut model, true, &allows, diagnostics)?;
        before = as_derived(&mut model, &equations, diagnostics);
    }
    names_are_free(item, &model, &equations, diagnostics);
    if diagnostics.has_errors() {
        return None;
    }
    let equations = equations.simplified(&mut model);
    let facts = Facts::of(&model, &equations);
    let turned = turning.map(|turning| equations.turned(&mut model, turning));
    let solved = turned.as_ref().unwrap_or(&equations);
    let of_solved = turned.as_ref().map_or_else(|| facts.clone(), |turned| Facts::of(&model, turned));
    let solution = Solution::plan(&mut model, (&equations, &facts), (solved, &of_solved), diagnostics)?;
    if diagnostics.has_errors() {
        return None;
    }
    let events: Vec<NodeId> = model.events.iter().map(|event| event.value).collect();
    let in_events: Vec<_> = events.iter().map(|&event| jets::Watched::of(&mut model.graph, event)).collect();
    let (hidden, jets) = jets::derive(&mut model, solved, &[]);
    let orders = jets.as_ref().map(|jets| Expansions::plan(&mut model, solved, &solution, jets));
    contacts_stand_alone(item, &model, diagnostics);
    let switching =
        regimes::derive(&model, described.as_ref(), equations.energy, jets.is_some(), diagnostics);
    if diagnostics.has_errors() {
        return None;
    }
    let emission = Emission {
        item,
        scalar: item.scalar.clone(),
        is_over: false,
        model: &mut model,
        equations: &equations,
        solved,
        facts: &facts,
        solution: &solution,
        hidden: hidden.as_ref(),
        in_events: &in_events,
        jets: jets.as_ref(),
        orders: orders.as_ref(),
        method: None,
    };
    Some(emit(emission, switching, before?, diagnostics))
}

/// Reports functions of the user that are named like generated methods.
fn names_are_free(item: &Item, model: &Model, equations: &Equations, diagnostics: &mut Diagnostics) {
    let places = || model.places.iter().map(|place| place.name.clone());
    for function in &item.functions {
        let generated = match &*function.name {
            "applied_forces" | "power" => equations.power.is_some(),
            "jacobi_integral" => equations.jacobi_integral.is_some(),
            name if equations.conditions.count() > 0 && CONSTRAINT_METHODS.contains(&name) => true,
            name if item.analysis && ANALYSIS_METHODS.contains(&name) => true,
            name if is_force_on_place(name, places()) => true,
            name if COMPLETIONS.contains(&name) => !model.eliminated.is_empty() || item.has_orientations(),
            name if item.has_orientations() && name == STATE_METHOD => true,
            name => METHODS.contains(&name),
        };
        if generated {
            diagnostics.at(function.origin, physics::name_of_generated(&function.name));
        }
    }
}

/// Reports arguments that contacts and dry friction exclude.
fn contacts_stand_alone(item: &Item, model: &Model, diagnostics: &mut Diagnostics) {
    let Some(contact) = model.contacts.first() else { return };
    let asked = [
        ("analysis", item.analysis),
        ("verify", item.verify.is_some()),
        ("baumgarte", item.baumgarte.is_some()),
    ];
    for (argument, _) in asked.into_iter().filter(|(_, asked)| *asked) {
        diagnostics.at(contact.constraint.origin, physics::beside_contacts(argument));
    }
}

/// Operations of the accelerations before anything is simplified, for `COST`. Those on parameters alone
/// count, too. `None` if they need a mass matrix that is not formed.
fn as_derived(model: &mut Model, equations: &Equations, diagnostics: &mut Diagnostics) -> Option<Operations> {
    let facts = Facts::of(model, equations);
    let told = (equations, &facts);
    let solution = Solution::plan(model, told, told, diagnostics)?;
    Some(plan(&model.graph, &solution.roots(equations)).operations(true))
}
