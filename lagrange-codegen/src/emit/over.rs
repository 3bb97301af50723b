//! The same equations over any scalar, with numbers in place of the user's parameters. Motions with
//! derivatives run on them.
//!
//! The code is that of the system, with a type parameter for the scalar. The user's expressions are evaluated
//! once, when such a system is made.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::companion::{any, companion};
use super::tokens::{Parameters, placeholder};
use super::{Emission, constraints, regimes};
use crate::regimes::Regimes;

/// The name of the struct, which no user writes.
pub(super) const NAME: &str = "__Over";

/// The type parameter of the conversion, a name that no user's generics have.
const OTHER: &str = "__Other";

/// The most directions that a motion carries at once. Eight share the work on the values well enough, and
/// with more the tables of their series leave the caches.
const AT_ONCE: usize = 8;

/// The directions of one pass, such that all passes have about as many.
pub(super) fn directions(count: usize, parameters: usize) -> usize {
    let all = 2 * count + parameters;
    all.div_ceil(all.div_ceil(AT_ONCE).max(1))
}

/// The struct with its implementations.
pub(super) fn over(emission: &mut Emission<'_>, switching: Option<&mut Regimes>) -> TokenStream {
    let own = emission.scalar.clone();
    (emission.scalar, emission.is_over) = (any(&own), true);
    let items = match switching {
        Some(switching) => switched(emission, switching),
        None => companion(emission, NAME, None, constraints::implementations),
    };
    (emission.scalar, emission.is_over) = (own, false);
    items
}

/// The struct of a system whose equations switch.
fn switched(emission: &mut Emission<'_>, switching: &mut Regimes) -> TokenStream {
    let constrained = |emission: &Emission<'_>| constraints::implementations(emission);
    let none = |_: &Emission<'_>| String::new();
    let system = match switching.has_contacts() {
        true => {
            let system =
                |emission: &Emission<'_>, constants: &str| regimes::system(emission, switching, constants);
            companion(emission, NAME, Some(&system), none)
        }
        false => companion(emission, NAME, None, constrained),
    };
    let items = Parameters::kept(emission.model).parse(&regimes::switching(emission, switching));
    let (rows, kinks) = (switching.rows(), switching.kinks.len());
    let (count, inputs) = (emission.count(), emission.model.inputs.len());
    let (name, scalar) = (format_ident!("{NAME}"), emission.scalar.to_string());
    let scalar = format_ident!("{scalar}");
    quote! {
        #system

        #[automatically_derived]
        #[allow(clippy::all, unused_variables)]
        impl<#scalar: lagrange::Real> lagrange::Switching<#count, #inputs, #rows, #kinks> for #name<#scalar> {
            #items
        }
    }
}

/// The items of `Sensitive`: the parameters, and the conversion of the user's system into the struct.
pub(super) fn sensitive(emission: &Emission<'_>) -> String {
    let model = &*emission.model;
    let (mut values, mut numbers) = (String::new(), Vec::new());
    for (index, name) in (0_u32..).zip(&model.locals.parameters) {
        values.push_str(&format!("let {name}: {} = {};\n", emission.scalar, placeholder(index)));
        let listed = match model.sensitivities.iter().position(|&listed| listed == index) {
            Some(place) => format!("::core::option::Option::Some({place})"),
            None => "::core::option::Option::None".to_owned(),
        };
        numbers.push(format!("__parameter({name}, {listed})"));
    }
    let path = |&parameter: &u32| format!("{:?}", model.parameters[parameter as usize].path);
    let paths: Vec<String> = model.sensitivities.iter().map(path).collect();
    format!(
        "const PARAMETERS: [&'static str; {}] = [{}];\n\
         type Over<{OTHER}: lagrange::Real> = {NAME}<{OTHER}>;\n\
         fn over<{OTHER}: lagrange::Real>(&self, mut __parameter: impl ::core::ops::FnMut({}, ::core::option::Option<usize>) -> {OTHER}) \
         -> {NAME}<{OTHER}> {{\n{values}{NAME} {{ parameters: [{}] }}\n}}\n",
        paths.len(),
        paths.join(", "),
        emission.scalar,
        numbers.join(", ")
    )
}
