//! Stand-ins for the items of `analysis` after a mistake.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::syntax::Item;

/// The methods and constants of `analysis`, without those whose names the user has taken. The numbers of
/// conserved quantities and of lumped parameters are unknown, so arrays of them fit any length.
pub(in crate::emit) fn stubs(item: &Item, scalar: &TokenStream, count: usize, inputs: usize) -> TokenStream {
    if !item.analysis {
        return TokenStream::new();
    }
    let state = quote!(_: &lagrange::State<#scalar, #count>);
    let given = (inputs > 0).then(|| quote!(, _: &[#scalar; #inputs]));
    let vector = quote!([#scalar; #count]);
    let matrix = quote!(lagrange::nalgebra::SMatrix<#scalar, #count, #count>);
    let cube = quote!([[#vector; #count]; #count]);
    let place = quote!(_: #scalar, _: &#vector, _: &#vector);
    let result = |ty: &TokenStream| quote!(::core::result::Result<#ty, lagrange::MotionError<#scalar>>);
    let certificate = quote!(::core::result::Result<lagrange::Certificate, lagrange::Violation>);
    let energies = quote!((#scalar, #scalar, #scalar));
    let forces = quote!(lagrange::InertiaForces<#scalar, #count>);
    let phase = quote!((#vector, #vector));
    let states = quote!(_: &[lagrange::State<#scalar, #count>]);
    let methods = [
        ("kinetic_energy_parts", quote!(#state), energies),
        ("inertia_forces", quote!(#state, _: &#vector), forces),
        ("jacobi_rate", quote!(#state #given), scalar.clone()),
        ("christoffel_first", quote!(#state), cube.clone()),
        ("christoffel_second", quote!(#state), result(&cube)),
        ("coriolis_matrix", quote!(#state), matrix.clone()),
        ("gyroscopic_matrix", quote!(#state), matrix),
        ("velocities_from_momenta", place.clone(), result(&vector)),
        ("hamiltonian", place.clone(), result(scalar)),
        ("canonical_at", quote!(#place #given), result(&phase)),
        ("verify", TokenStream::new(), certificate.clone()),
        ("verify_at", states, certificate),
    ];
    let unconstrained = !item.functions.iter().any(|function| item.has_multiplier(function));
    let rate = unconstrained.then(|| ("energy_rate", quote!(#state #given), result(scalar)));
    let is_free = |name: &str| item.functions.iter().all(|function| *function.name != *name);
    let methods = methods.into_iter().chain(rate).filter(|(name, ..)| is_free(name)).map(
        |(name, arguments, output)| {
            let name = format_ident!("{name}");
            quote!(pub fn #name(&self, #arguments) -> #output { loop {} })
        },
    );
    let any = [
        ("cyclic_momenta", quote!(#state)),
        ("conserved", quote!(#state)),
        ("lumped_parameters", TokenStream::new()),
    ];
    let any = any.into_iter().filter(|(name, _)| is_free(name)).map(|(name, arguments)| {
        let name = format_ident!("{name}");
        quote!(pub fn #name<const LENGTH: usize>(&self, #arguments) -> [#scalar; LENGTH] { loop {} })
    });
    let regressor = is_free("regressor").then(|| {
        quote! {
            pub fn regressor<const LENGTH: usize>(&self, #state, _: &#vector)
                -> lagrange::nalgebra::SMatrix<#scalar, #count, LENGTH> { loop {} }
        }
    });
    quote! {
        pub const CYCLIC: &'static [&'static str] = &[];
        pub const CONSERVED: &'static [&'static str] = &[];
        pub const REGRESSOR: &'static [&'static str] = &[];
        pub const EQUATIONS_LATEX: &'static str = "";
        pub const EQUATIONS_MATHML: &'static str = "";
        #(#methods)*
        #(#any)*
        #regressor
    }
}

/// The implementation that certificates ask for.
pub(in crate::emit) fn certificate(
    item: &Item,
    scalar: &TokenStream,
    count: usize,
    inputs: usize,
) -> TokenStream {
    let Item { self_ty, generics, .. } = item;
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let state = quote!(&self, _: &lagrange::State<#scalar, #count>);
    let vector = quote!([#scalar; #count]);
    let functions = [
        ("nearest_at", quote!(), quote!(::core::option::Option<lagrange::State<#scalar, #count>>)),
        ("mass_at", quote!(), quote!([#vector; #count])),
        ("coriolis_at", quote!(), quote!(::core::option::Option<[#vector; #count]>)),
        ("momenta_at", quote!(), vector.clone()),
        ("integral_at", quote!(), scalar.clone()),
        ("integral_rate_at", quote!(_: &[#scalar; #inputs]), quote!(::core::option::Option<#scalar>)),
        (
            "driven_at",
            quote!(_: &[#scalar; #inputs]),
            quote!(::core::option::Option<lagrange::verify::Driven<#scalar, #count>>),
        ),
        ("conserved_at", quote!(_: usize), scalar.clone()),
        ("constraint_at", quote!(_: usize), scalar.clone()),
        ("gradient_at", quote!(_: usize), vector),
        ("energies_at", quote!(), quote!(::core::option::Option<[#scalar; 2]>)),
        ("described_at", quote!(_: #scalar), quote!(lagrange::verify::Described<#scalar>)),
    ];
    let functions = functions.into_iter().map(|(name, arguments, output)| {
        let name = format_ident!("{name}");
        quote!(fn #name(#state, #arguments) -> #output { loop {} })
    });
    quote! {
        impl #impl_generics lagrange::Verifiable<#count, #inputs> for #self_ty #where_clause {
            const CONSERVED: usize = 0;
            const CONSTRAINTS: usize = 0;
            const DEFINITE: bool = false;
            #(#functions)*
            fn is_holonomic(_: usize) -> bool { loop {} }
        }
    }
}
