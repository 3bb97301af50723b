//! Tokens to [`Item`]: own types with spans, and every rule of form checked.
//!
//! Mistakes go into [`Diagnostics`]. Meaning (names, shapes, loops) is the business of the next stage,
//! lowering.

pub mod body;
pub mod constant;
pub mod friction;
pub mod hygiene;
pub mod integers;
pub mod item;
pub mod suggest;
pub mod types;
pub mod velocity;

mod args;
mod conditional;
mod depth;
mod path;
mod pieces;
mod recover;
mod rewrite;
mod role;
mod signature;
mod spans;
mod statements;
#[cfg(test)]
mod tests;
mod translate;
mod unfinished;

use proc_macro2::{Ident, Span, TokenStream};
use quote::format_ident;
use syn::{GenericParam, ImplItem, ItemImpl, TypeParamBound};

pub use args::LINTS;
pub use depth::{DEEPEST, too_deep};
use item::Argument;
pub use item::Function;
pub use item::{Group, Incomplete, Item, Record, Scalar, Velocity};
pub use recover::{recover, refusal};
pub use rewrite::expression as rewritten;
pub use signature::{refused, returns};

use crate::diagnostics::{Diagnostics, catalogue};
use body::Constant;
use translate::{Translator, bare};

/// The fewest alike instructions that a loop computes. Compilers keep the results of fewer ones in registers,
/// where a loop would store them. The number is a choice: systems of some ten links keep straight lines.
const LEAST_LOOP: usize = 24;

/// Parses `#[lagrangian(args)] item`. `default_crate` is the crate that generated code names unless the user
/// says `crate = path`. `None` if too little can be read to look for more mistakes.
pub fn parse(
    args: TokenStream,
    item: TokenStream,
    default_crate: &str,
    diagnostics: &mut Diagnostics,
) -> Option<Item> {
    let (mut block, unfinished) = impl_block(item, diagnostics)?;
    let (title, name) = match self_type(&block.self_ty) {
        Some(segment) if block.trait_.is_none() => (segment.ident.clone(), name_of(segment)),
        Some(_) | None => {
            diagnostics.error(block.impl_token.span, catalogue::not_inherent());
            return None;
        }
    };
    let args = args::parse(args, diagnostics);
    let (scalar, mixed) = scalar(&block, diagnostics);
    let crate_path = match args.crate_path.clone() {
        Some(path) => path,
        None => syn::parse_str(default_crate).ok()?,
    };
    if let (Scalar::Generic(ident), None) = (&scalar, generic_scalar(&block.generics)) {
        // The missing bound is reported. What follows assumes it.
        for parameter in block.generics.type_params_mut().filter(|parameter| parameter.ident == *ident) {
            parameter.bounds.push(syn::parse_quote!(#crate_path::Real));
        }
    }
    let cleaned = rewrite::clean(&block, &name, &scalar, &crate_path, args.baumgarte.as_ref());
    let mut translator = Translator::new(diagnostics, scalar, title.to_string(), block.impl_token.span);
    translator.mixed = mixed;
    let mut constants = Vec::new();
    let mut functions = Vec::new();
    for item in &block.items {
        match item {
            ImplItem::Const(constant) => constants.push(Constant {
                name: bare(&constant.ident),
                ty: translator.ty(&constant.ty),
                value: translator.expression(&constant.expr),
                conditional: translator.conditional(constant),
            }),
            ImplItem::Fn(function) => functions.push(signature::parse(function, &mut translator)),
            _ => {}
        }
        role::refuse_on_item(item, &mut translator);
    }
    let declared = functions.len();
    let functions = distinct(functions);
    let sensitivities: Vec<_> =
        args.sensitivities.iter().map(|parameter| translator.expression(parameter)).collect();
    let baumgarte = args.baumgarte.map(|rate| translator.expression(&rate));
    let coordinates = args::groups(&args.coordinates, &constants, &mut translator);
    let inputs = args::groups(&args.inputs, &constants, &mut translator);
    if args.inputs.is_empty() {
        for parameter in functions.iter().flat_map(|function| &function.parameters) {
            if parameter.argument == Some(Argument::Record(Record::Inputs)) {
                translator.diagnostics.at(parameter.pattern.origin, catalogue::no_inputs());
            }
        }
    }
    let velocities = velocities(&block, unfinished.is_some(), &functions, &mut translator);
    let origin = translator.origin(name.span());
    let scalar = translator.scalar;
    if functions.iter().all(|function| function.role.is_none()) && !diagnostics.has_errors() {
        diagnostics.error(name.span(), catalogue::no_roles(&name));
    }
    let unread = args.unread
        || functions.len() < declared
        || coordinates.is_empty()
        || coordinates.len() < args.coordinates.len()
        || inputs.len() < args.inputs.len();
    let incomplete = unfinished.map(Incomplete::Form).or(unread.then_some(Incomplete::Declarations));
    Some(Item {
        title,
        name,
        self_ty: (*block.self_ty).clone(),
        generics: block.generics.clone(),
        scalar,
        coordinates,
        inputs,
        crate_path,
        jacobians: args.jacobians || !sensitivities.is_empty(),
        sensitivities,
        analysis: args.analysis || args.verify.is_some(),
        formulas: args.analysis || args.verify.is_some(),
        least_loop: LEAST_LOOP,
        verify: args.verify,
        baumgarte,
        allowed: args.allowed,
        cleaned,
        functions,
        velocities,
        constants,
        origin,
        incomplete,
    })
}

/// The functions without those that have the name of an earlier one. The compiler reports these with both
/// places. Which of them is meant is unknown, so nothing is derived, and no generated item has a name twice.
fn distinct(functions: Vec<Function>) -> Vec<Function> {
    let mut kept: Vec<Function> = Vec::new();
    for function in functions {
        // Functions under `cfg` may have one name, and only one of them is there.
        let is_same = |other: &Function| {
            other.name == function.name && other.conditional.is_none() && function.conditional.is_none()
        };
        if !kept.iter().any(is_same) {
            kept.push(function);
        }
    }
    kept
}

/// The velocities that a block uses and the user has not written.
fn velocities(
    block: &ItemImpl,
    is_unfinished: bool,
    functions: &[Function],
    translator: &mut Translator,
) -> Vec<Velocity> {
    let find = |name: &str| functions.iter().position(|function| *function.name == *name);
    let mentioned = velocity::mentioned(block, is_unfinished).into_iter();
    let missing = mentioned.filter(|(name, _)| find(name).is_none());
    missing
        .filter_map(|(name, span)| {
            let function = find(name.strip_suffix(velocity::SUFFIX)?)?;
            Some(Velocity { function, name, origin: translator.origin(span) })
        })
        .collect()
}

fn impl_block(item: TokenStream, diagnostics: &mut Diagnostics) -> Option<(ItemImpl, Option<String>)> {
    match unfinished::read(item) {
        Ok((syn::Item::Impl(block), unfinished)) => Some((block, unfinished)),
        Ok((other, _)) => {
            diagnostics.error(spans::span(&other), catalogue::not_an_impl());
            None
        }
        Err(error) => {
            diagnostics.error(error.span(), error.to_string());
            None
        }
    }
}

/// The last segment of a type's path.
fn self_type(ty: &syn::Type) -> Option<&syn::PathSegment> {
    match ty {
        syn::Type::Path(path) => path.path.segments.last(),
        syn::Type::Group(group) => self_type(&group.elem),
        syn::Type::Paren(paren) => self_type(&paren.elem),
        _ => None,
    }
}

/// The name from which those of generated types are made: `Chain`, `Chain3` for `Chain<3>` and `ChainMinus3`
/// for `Chain<-3>`, so that each of several numbers may have a description.
fn name_of(segment: &syn::PathSegment) -> Ident {
    let mut name = segment.ident.clone();
    if let syn::PathArguments::AngleBracketed(arguments) = &segment.arguments {
        for argument in &arguments.args {
            if let syn::GenericArgument::Const(syn::Expr::Lit(literal)) = argument
                && let syn::Lit::Int(number) = &literal.lit
            {
                let digits = number.base10_digits().replace('-', "Minus");
                name = format_ident!("{name}{digits}", span = name.span());
            }
        }
    }
    name
}

/// The type parameter with the bound `Real`.
fn generic_scalar(generics: &syn::Generics) -> Option<Ident> {
    let real = |bound: &TypeParamBound| match bound {
        TypeParamBound::Trait(bound) => {
            bound.path.segments.last().is_some_and(|segment| segment.ident == "Real")
        }
        _ => false,
    };
    let clauses = generics.where_clause.iter().flat_map(|clause| &clause.predicates);
    let bound_below = |ident: &Ident| {
        clauses.clone().any(|predicate| match predicate {
            syn::WherePredicate::Type(predicate) => {
                matches!(&predicate.bounded_ty, syn::Type::Path(path) if path.path.is_ident(ident))
                    && predicate.bounds.iter().any(real)
            }
            _ => false,
        })
    };
    generics.params.iter().find_map(|param| match param {
        GenericParam::Type(ty) => {
            (ty.bounds.iter().any(real) || bound_below(&ty.ident)).then(|| ty.ident.clone())
        }
        GenericParam::Lifetime(_) | GenericParam::Const(_) => None,
    })
}

/// A type parameter that a role returns without a bound `Real`.
fn unbound_scalar(block: &ItemImpl) -> Option<Ident> {
    let roles = block.items.iter().filter_map(|item| match item {
        ImplItem::Fn(function) if function.attrs.iter().any(role::is_role) => Some(function),
        _ => None,
    });
    let returned: Vec<Ident> = roles.flat_map(signature::returned_names).collect();
    block
        .generics
        .type_params()
        .map(|parameter| &parameter.ident)
        .find(|ident| returned.contains(ident))
        .cloned()
}

/// The scalar of a description, which is the parameter bound by `Real` or else the float of the roles, and
/// whether roles mix floats. Mixing is reported.
fn scalar(block: &ItemImpl, diagnostics: &mut Diagnostics) -> (Scalar, bool) {
    if let Some(ident) = generic_scalar(&block.generics) {
        return (Scalar::Generic(ident), false);
    }
    if let Some(ident) = unbound_scalar(block) {
        diagnostics.error(ident.span(), catalogue::missing_bound(&ident));
        return (Scalar::Generic(ident), false);
    }
    let mut first: Option<bool> = None;
    let mut mixed: Option<Span> = None;
    for item in &block.items {
        let ImplItem::Fn(function) = item else { continue };
        if !function.attrs.iter().any(role::is_role) {
            continue;
        }
        for (span, single) in signature::float_types(function) {
            if *first.get_or_insert(single) != single {
                mixed.get_or_insert(span);
            }
        }
    }
    if let Some(span) = mixed {
        diagnostics.error(span, catalogue::mixed_precision());
    }
    (if first == Some(true) { Scalar::F32 } else { Scalar::F64 }, mixed.is_some())
}
