//! Functions of the impl block: parameters, return types, and what a role may depend on.

use proc_macro2::{Span, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{FnArg, ImplItemFn, ReceiverKind, ReturnType};

use super::body::{Name, PatternKind};
use super::item::{Argument, Function, Parameter, Record, Role, RoleKind};
use super::translate::{Translator, bare};
use super::types::TypeKind;
use super::{hygiene, role};
use crate::diagnostics::catalogue;

/// Reads a function.
pub fn parse(function: &ImplItemFn, translator: &mut Translator) -> Function {
    let (role, unread) = role::parse(&function.attrs, translator);
    let name = bare(&function.sig.ident);
    let origin = translator.origin(function.sig.ident.span());
    let generics = translator.hidden.len();
    let is_helper = role.is_none() && unread.is_none();
    let (lengths, unseen): (Vec<_>, Vec<_>) =
        own_generics(function).partition(|(_, counts)| *counts && is_helper);
    translator.hidden.extend(unseen.into_iter().map(|(name, _)| name));
    let mut parameters = Vec::new();
    for input in &function.sig.inputs {
        if let FnArg::Typed(typed) = input {
            let pattern = translator.pattern(&typed.pat);
            let ty = translator.ty(&typed.ty);
            let argument = argument(&pattern.kind, &ty.kind);
            parameters.push(Parameter { pattern, ty, references: references(&typed.ty), argument });
        }
    }
    let output = match &function.sig.output {
        ReturnType::Default => None,
        ReturnType::Type(_, ty) => Some(translator.ty(ty)),
    };
    // A `cfg` on a role is reported here.
    let on_role = role.is_some() && function.attrs.iter().any(|attribute| attribute.path().is_ident("cfg"));
    if let Some(role) = &role {
        check_form(function, translator);
        for attribute in function.attrs.iter().filter(|attribute| attribute.path().is_ident("cfg")) {
            let origin = translator.origin_of(attribute.path());
            translator.diagnostics.at(origin, catalogue::conditional_role(&name));
        }
        check_parameters(role, &parameters, translator);
        if output.as_ref().is_none_or(|ty| matches!(ty.kind, TypeKind::Unit)) {
            translator.diagnostics.at(origin, catalogue::missing_return_type(&name, returns(&role.kind)));
        }
    }
    let body = translator.block(&function.block);
    translator.hidden.truncate(generics);
    Function {
        name,
        origin,
        receiver: function.sig.receiver().is_some(),
        lengths: lengths.into_iter().map(|(name, _)| name).collect(),
        parameters,
        output,
        body,
        role,
        unread,
        conditional: if on_role { None } else { translator.conditional(function) },
    }
}

/// The number of references before a type.
fn references(ty: &syn::Type) -> usize {
    match ty {
        syn::Type::Reference(reference) => 1 + references(&reference.elem),
        syn::Type::Paren(paren) => references(&paren.elem),
        syn::Type::Group(group) => references(&group.elem),
        _ => 0,
    }
}

/// Generic parameters of a function, which mean nothing outside it, and whether each counts something.
fn own_generics(function: &ImplItemFn) -> impl Iterator<Item = (Name, bool)> {
    let counts = |ty: &syn::Type| matches!(ty, syn::Type::Path(path) if path.path.is_ident("usize"));
    function.sig.generics.params.iter().filter_map(move |parameter| match parameter {
        syn::GenericParam::Type(ty) => Some((bare(&ty.ident), false)),
        syn::GenericParam::Const(constant) => Some((bare(&constant.ident), counts(&constant.ty))),
        syn::GenericParam::Lifetime(_) => None,
    })
}

/// A struct is known by its type, time by its name.
fn argument(pattern: &PatternKind, ty: &TypeKind) -> Option<Argument> {
    match (ty, pattern) {
        (TypeKind::Record(record), _) => Some(Argument::Record(*record)),
        (TypeKind::Scalar, PatternKind::Name(name))
            if matches!(hygiene::written(name), "t" | "time" | "_t" | "_time") =>
        {
            Some(Argument::Time)
        }
        _ => None,
    }
}

fn check_form(function: &ImplItemFn, translator: &mut Translator) {
    let ident = &function.sig.ident;
    let name = bare(ident);
    match function.sig.receiver().map(|receiver| (receiver, &receiver.kind)) {
        Some((_, ReceiverKind::Reference(_, _, None))) => {}
        Some((receiver, _)) => {
            translator.diagnostics.error(receiver.self_token.span, catalogue::wrong_receiver(&name));
        }
        None => translator.diagnostics.error(ident.span(), catalogue::missing_receiver(&name)),
    }
    let generics = &function.sig.generics;
    let free = generics.params.iter().any(|param| !matches!(param, syn::GenericParam::Lifetime(_)));
    if free {
        let origin = translator.origin_of(generics);
        translator.diagnostics.at(origin, catalogue::generic_role(&name));
    }
    if let Some(token) = &function.sig.asyncness {
        translator.diagnostics.error(token.span, catalogue::asynchronous_role(&name));
    }
}

fn check_parameters(role: &Role, parameters: &[Parameter], translator: &mut Translator) {
    let mut seen = Vec::new();
    for parameter in parameters {
        let Some(argument) = parameter.argument else {
            let message = match (&parameter.ty.kind, &parameter.pattern.kind) {
                (TypeKind::Scalar, PatternKind::Name(name)) => {
                    catalogue::unnamed_time(hygiene::written(name))
                }
                (TypeKind::Other(name), _) if near_record(name).is_some() => {
                    catalogue::misspelt_record(name, near_record(name).unwrap_or_default())
                }
                _ => catalogue::unknown_parameter(),
            };
            translator.diagnostics.at(parameter.pattern.origin, message);
            continue;
        };
        if seen.contains(&argument) {
            translator.diagnostics.at(parameter.pattern.origin, catalogue::parameter_twice());
        }
        seen.push(argument);
        if let Some(message) = refused(&role.kind, argument) {
            translator.diagnostics.at(parameter.pattern.origin, message);
        }
    }
}

fn near_record(name: &str) -> Option<&'static str> {
    let name = name.split('<').next().unwrap_or(name);
    super::suggest::nearest(name, Record::ALL.map(Record::name)).or(match name {
        "Velocity" => Some("Velocities"),
        "Coordinate" | "Positions" => Some("Coordinates"),
        "Input" => Some("Inputs"),
        _ => None,
    })
}

/// Why a role may not depend on an argument; `None` if it may.
pub fn refused(role: &RoleKind, argument: Argument) -> Option<String> {
    match (role, argument) {
        (RoleKind::Force(_), _) => None,
        (
            RoleKind::Nonholonomic { .. } | RoleKind::Friction(_) | RoleKind::Event,
            Argument::Record(Record::Velocities),
        ) => None,
        (RoleKind::Unilateral { .. }, Argument::Record(Record::Velocities)) => {
            Some(catalogue::velocity_in_gap())
        }
        (RoleKind::Holonomic { .. }, Argument::Record(Record::Velocities)) => {
            Some(catalogue::velocity_in_holonomic())
        }
        (_, Argument::Record(Record::Coordinates) | Argument::Time) => None,
        (RoleKind::Kinetic | RoleKind::Lagrangian | RoleKind::Dissipation, Argument::Record(record)) => {
            (record == Record::Inputs).then(catalogue::input_outside_force)
        }
        (RoleKind::Potential, Argument::Record(Record::Velocities)) => {
            Some(catalogue::velocity_in_potential())
        }
        (RoleKind::Point { .. } | RoleKind::Body { .. }, Argument::Record(Record::Velocities)) => {
            Some(catalogue::velocity_in_position())
        }
        (
            RoleKind::Potential
            | RoleKind::Point { .. }
            | RoleKind::Body { .. }
            | RoleKind::Holonomic { .. }
            | RoleKind::Nonholonomic { .. }
            | RoleKind::Unilateral { .. }
            | RoleKind::Friction(_)
            | RoleKind::Event,
            Argument::Record(Record::Inputs),
        ) => Some(catalogue::input_outside_force()),
    }
}

/// The value that a role function returns, in words.
pub fn returns(role: &RoleKind) -> &'static str {
    match role {
        RoleKind::Point { .. } => "a position such as `Vector2<f64>`, or an array of them",
        RoleKind::Body { .. } => {
            "a pose such as `Isometry2<f64>`, `Isometry3<f64>` or `(Vector3<f64>, Rotation3<f64>)`, or an array of them"
        }
        RoleKind::Kinetic | RoleKind::Potential | RoleKind::Lagrangian | RoleKind::Dissipation => {
            "a scalar energy"
        }
        RoleKind::Force(_) => "a force",
        RoleKind::Holonomic { .. } | RoleKind::Nonholonomic { .. } => {
            "what is to stay zero, a scalar or an array of scalars"
        }
        RoleKind::Unilateral { .. } => "a gap, a scalar or an array of scalars",
        RoleKind::Friction(_) => "a slip velocity: a scalar, a `Vector2`, or an array of scalars",
        RoleKind::Event => "a scalar whose zeros are the events",
    }
}

/// The identifiers in the return type.
pub fn returned_names(function: &ImplItemFn) -> Vec<proc_macro2::Ident> {
    let mut names = Vec::new();
    let mut stack = vec![function.sig.output.to_token_stream()];
    while let Some(stream) = stack.pop() {
        for tree in stream {
            match tree {
                TokenTree::Group(group) => stack.push(group.stream()),
                TokenTree::Ident(ident) => names.push(ident),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }
    names
}

/// The float types in a signature, and whether each is `f32`.
pub fn float_types(function: &ImplItemFn) -> Vec<(Span, bool)> {
    let mut found = Vec::new();
    let mut stack: Vec<TokenStream> = Vec::new();
    for input in &function.sig.inputs {
        if let FnArg::Typed(typed) = input {
            stack.push(typed.ty.to_token_stream());
        }
    }
    stack.push(function.sig.output.to_token_stream());
    while let Some(stream) = stack.pop() {
        for tree in stream {
            match tree {
                TokenTree::Group(group) => stack.push(group.stream()),
                TokenTree::Ident(ident) if ident == "f32" => found.push((ident.span(), true)),
                TokenTree::Ident(ident) if ident == "f64" => found.push((ident.span(), false)),
                _ => {}
            }
        }
    }
    found
}
