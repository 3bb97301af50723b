//! The same equations over any scalar, with numbers of it for the user's parameters: what a motion with
//! derivatives runs on.
//!
//! The code is that of the system, with a type parameter for the scalar. The user's expressions are evaluated
//! once, where such a system is made.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::body::{self, Source};
use super::tokens::{Parameters, placeholder};
use super::{Emission, constraints, jets, methods, proofs, regimes, system};
use crate::regimes::Regimes;
use crate::syntax::Scalar;

/// The struct, which no one names.
pub(super) const NAME: &str = "__Over";

/// The type parameter of the conversion: no user's generics have its name.
const OTHER: &str = "__Other";

/// Directions that a motion carries at once, at most: more of them share less of the work on the values,
/// since one value serves eight already, and the tables of their series leave the caches.
const AT_ONCE: usize = 8;

/// In how many directions at once a system is differentiated, so that all passes are alike.
pub(super) fn directions(count: usize, parameters: usize) -> usize {
    let all = 2 * count + parameters;
    all.div_ceil(all.div_ceil(AT_ONCE).max(1))
}

/// The type parameter of systems that are emitted once more over any scalar.
pub(super) fn any(own: &Scalar) -> Scalar {
    Scalar::Generic(match own {
        Scalar::Generic(ident) => ident.clone(),
        Scalar::F64 | Scalar::F32 => format_ident!("R"),
    })
}

/// The struct with its implementations.
pub(super) fn over(emission: &mut Emission<'_>, switching: Option<&mut Regimes>) -> TokenStream {
    let own = emission.scalar.clone();
    emission.scalar = any(&own);
    let items = match switching {
        Some(switching) => switched(emission, switching),
        None => numbers(emission, NAME, None, constraints::implementations),
    };
    emission.scalar = own;
    items
}

/// The same of a system whose equations switch.
fn switched(emission: &mut Emission<'_>, switching: &mut Regimes) -> TokenStream {
    let constrained = |emission: &Emission<'_>| constraints::implementations(emission);
    let none = |_: &Emission<'_>| String::new();
    let system = match switching.has_contacts() {
        true => numbers(emission, NAME, Some(&*switching), none),
        false => numbers(emission, NAME, None, constrained),
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

/// A struct of numbers for all parameters, with the implementations of the system. `constrained` gives the
/// items of `Constrained`, none if that is not implemented. Of a system with contacts accelerations are those of its regime.
pub(super) fn numbers(
    emission: &mut Emission<'_>,
    name: &str,
    contacts: Option<&Regimes>,
    constrained: impl Fn(&Emission<'_>) -> String,
) -> TokenStream {
    let (system, constants, surface) = match emission.solution.saddle {
        Some(method) => {
            let all = constraints::system(emission, method);
            (all.system, all.constants, Some((all.surface, constrained(emission))))
        }
        None => (system::system(emission).0, system::NO_CONSTANTS.to_owned(), None),
    };
    let system = contacts.map_or(system, |switching| regimes::system(emission, switching, &constants));
    let smooth = emission.jets.zip(emission.orders).filter(|_| contacts.is_none());
    let smooth = smooth.map(|(jets, orders)| jets::jets(emission, jets, orders));
    let mut methods = energy(emission);
    if system.contains("self.mass_matrix(") {
        methods.push_str(&methods::mass_matrix(emission));
    }

    let kept = Parameters::kept(emission.model);
    let (count, inputs) = (emission.count(), emission.model.inputs.len());
    let (held, parameters) = (emission.equations.conditions.count(), emission.model.parameters.len());
    let name = format_ident!("{name}");
    let (generics, short, scalar) = match &emission.scalar {
        Scalar::Generic(scalar) => (quote!(<#scalar: lagrange::Real>), quote!(<#scalar>), scalar.clone()),
        Scalar::F64 => (quote!(), quote!(), format_ident!("f64")),
        Scalar::F32 => (quote!(), quote!(), format_ident!("f32")),
    };
    let itself = quote!(#name #short);
    let implementation = |name: TokenStream, items: &str| {
        let items = kept.parse(items);
        quote! {
            #[automatically_derived]
            #[allow(clippy::all)]
            impl #generics #name #itself {
                #items
            }
        }
    };
    let methods = implementation(TokenStream::new(), &methods);
    let system = implementation(quote!(lagrange::System<#count, #inputs> for), &system);
    let surface = surface.map(|(surface, constrained)| {
        let surface = implementation(quote!(lagrange::Surface<#count, #inputs, #held> for), &surface);
        let constrained = (!constrained.is_empty())
            .then(|| implementation(quote!(lagrange::Constrained<#count, #inputs> for), &constrained));
        quote!(#surface #constrained)
    });
    let smooth = smooth.map(|items| implementation(quote!(lagrange::Smooth<#count, #inputs> for), &items));
    let proved = if contacts.is_some() { Vec::new() } else { proofs::proved(emission.facts) };
    let proofs = proved.into_iter().map(|name| {
        let name = format_ident!("{name}");
        quote!(impl #generics lagrange::#name<#count, #inputs> for #itself {})
    });
    quote! {
        #[doc(hidden)]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        pub struct #name #short {
            parameters: [#scalar; #parameters],
        }

        #methods
        #system
        #surface
        #smooth
        #(#proofs)*
    }
}

/// The items of `Sensitive`: the parameters, and what makes such a system from the user's.
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

/// What `energy_at` calls.
fn energy(emission: &Emission<'_>) -> String {
    let equations = emission.equations;
    let nodes = if emission.model.lagrangian.is_empty() {
        vec![equations.kinetic_energy, equations.potential_energy]
    } else {
        vec![equations.energy]
    };
    let body =
        body::plain(emission.model, &emission.scalar, &nodes, Source::State, |values| values.join(" + "));
    let (state, scalar) = (emission.state_type(), &emission.scalar);
    format!("#[inline]\nfn energy(&self, state: &{state}) -> {scalar} {{\n{body}\n}}\n")
}
