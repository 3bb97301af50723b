//! The comparison of values that the interpreter found with those that the user's functions return, in builds
//! with `debug_assertions`.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::body::{self, Source};
use super::{COMPLETIONS, Emission};
use crate::expr::NodeId;
use crate::model::Reading;
use crate::syntax::item::{Argument, Function};
use crate::syntax::{Record, rewritten};

/// The items of the runtime's `System` as text; empty if nothing is compared.
pub(super) fn implementation(emission: &mut Emission<'_>) -> String {
    let readings = emission.model.readings.clone();
    if readings.is_empty() {
        return String::new();
    }
    let mut nodes: Vec<NodeId> = readings.iter().flat_map(|reading| reading.nodes.iter().copied()).collect();
    let count = nodes.len();
    nodes.extend(readings.iter().flat_map(|reading| reading.sizes.iter().copied()));
    let (state, inputs) = (emission.state_type(), emission.input_type());
    let body = body::plain(emission.model, &emission.item.scalar, &nodes, Source::State, |values| {
        let mut next = 0;
        let mut text = format!("use lagrange::reading::Numbers;\n{}", records(emission, &readings));
        for reading in &readings {
            let range = next..next + reading.nodes.len();
            next = range.end;
            let function = &emission.item.functions[reading.function];
            let (name, found) = match reading.argument {
                Some(argument) => {
                    (format!("{argument} of {}", function.name), format!("self.{}()", getter(reading)))
                }
                None => (function.name.to_string(), call(function)),
            };
            text.push_str(&format!(
                "lagrange::reading::compare(lagrange::Function(&[{name:?}, lagrange::reading::MISREAD]), |take| {found}.each_number(take), &{}, &{})?;\n",
                values.part(range.clone()).list(),
                values.part(count + range.start..count + range.end).list(),
            ));
        }
        text + "::core::result::Result::Ok(())"
    });
    format!(
        "#[cfg(debug_assertions)]\nconst READ: bool = true;\n#[cfg(debug_assertions)]\n#[allow(unused_variables)]\n\
         fn check_reading_at(&self, state: &{state}, inputs: &{inputs}) -> ::core::result::Result<(), lagrange::Cause> {{\n{body}\n}}\n"
    )
}

/// Functions that return the arguments of roles as Rust evaluates them.
pub(super) fn getters(emission: &Emission<'_>) -> TokenStream {
    let item = emission.item;
    let scalar: syn::Type = match syn::parse_str(&item.scalar.to_string()) {
        Ok(scalar) => scalar,
        Err(_) => return TokenStream::new(),
    };
    let getters = emission.model.readings.iter().filter_map(|reading| {
        let argument = reading.argument?;
        let role = item.functions[reading.function].role.as_ref()?;
        let (_, expr) = role.written.iter().find(|(name, _)| name == argument)?;
        let (name, expr) =
            (format_ident!("{}", getter(reading)), rewritten(expr, &item.scalar, &item.crate_path));
        Some(quote! {
            #[cfg(debug_assertions)]
            #[doc(hidden)]
            fn #name(&self) -> impl lagrange::reading::Numbers<#scalar> { #expr }
        })
    });
    getters.collect()
}

fn getter(reading: &Reading) -> String {
    format!("__{}_{}", reading.argument.unwrap_or_default(), reading.function)
}

/// The records that functions take, each once.
fn records(emission: &Emission<'_>, readings: &[Reading]) -> String {
    let item = emission.item;
    let whole = emission.is_state_complete();
    let mut text = String::new();
    for record in Record::ALL {
        let takes = |reading: &&Reading| {
            let function = &item.functions[reading.function];
            reading.argument.is_none()
                && function
                    .parameters
                    .iter()
                    .any(|parameter| parameter.argument == Some(Argument::Record(record)))
        };
        if !readings.iter().any(|reading| takes(&reading)) {
            continue;
        }
        let (place, completion) = match record {
            Record::Coordinates => ("state.q", COMPLETIONS.first().filter(|_| !whole)),
            Record::Velocities => ("state.v", COMPLETIONS.get(1).filter(|_| !whole)),
            Record::Inputs => ("*inputs", None),
        };
        let value = match completion {
            Some(completion) => format!("self.{completion}(state)"),
            None => {
                let (ident, scalar) = (item.record_ident(record), &item.scalar);
                format!("<{ident}<{scalar}> as ::core::convert::From<_>>::from({place})")
            }
        };
        text.push_str(&format!("let {} = {value};\n", local(record)));
    }
    text
}

/// The name of a local variable, one that no variable of generated code has.
fn local(record: Record) -> &'static str {
    match record {
        Record::Coordinates => "__coordinates",
        Record::Velocities => "__velocities",
        Record::Inputs => "__inputs",
    }
}

/// A call of a function of the user.
fn call(function: &Function) -> String {
    let arguments = function.parameters.iter().filter_map(|parameter| {
        let value = match parameter.argument? {
            Argument::Time => "state.t",
            Argument::Record(record) => local(record),
        };
        Some("&".repeat(parameter.references) + value)
    });
    let name = &function.name;
    let raw = if syn::parse_str::<Ident>(name).is_ok() { "" } else { "r#" };
    let owner = if function.receiver { "self." } else { "Self::" };
    format!("{owner}{raw}{name}({})", arguments.collect::<Vec<_>>().join(", "))
}
