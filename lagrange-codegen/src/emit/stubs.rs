//! What stands for the generated items after a mistake, so that the rest of a program still
//! compiles and our messages are the only ones.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::records;
use crate::syntax::{Group, Item, Scalar};

/// All items that a program may use of a system, without content. `None` where the declarations
/// themselves are broken.
pub(crate) fn stubs(item: &Item) -> Option<TokenStream> {
    if !sound(&item.coordinates) || !sound(&item.inputs) {
        return None;
    }
    let records = records::records(item);
    let Item { self_ty, generics, crate_path, .. } = item;
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let scalar = match &item.scalar {
        Scalar::F64 => format_ident!("f64"),
        Scalar::F32 => format_ident!("f32"),
        Scalar::Generic(parameter) => parameter.clone(),
    };
    let total = |groups: &[Group]| groups.iter().map(|group| group.length.unwrap_or(1)).sum::<usize>();
    let (count, inputs) = (total(&item.coordinates), total(&item.inputs));
    let methods = methods(item, &quote!(#scalar), count, inputs);
    Some(quote! {
        #records
        const _: () = {
            use #crate_path::__private as lagrange;

            #[allow(missing_docs, dead_code, clippy::all)]
            impl #impl_generics #self_ty #where_clause {
                pub const COORDINATES: [&'static str; #count] = [""; #count];
                pub const COST: lagrange::Costs = lagrange::Costs {
                    before: lagrange::Cost::new(0, 0, 0, 0, 0),
                    after: lagrange::Cost::new(0, 0, 0, 0, 0),
                };
                pub const STRUCTURE: lagrange::Structure =
                    lagrange::Structure { mass_matrix: "", facts: &[], skipped: &[] };
                #methods
            }

            impl #impl_generics lagrange::System<#count, #inputs> for #self_ty #where_clause {
                type Scalar = #scalar;
                type Method = lagrange::Dop853;
                type Constants = ();
                fn constants(&self) {}
                fn accelerations_at(
                    &self, _: &(), _: #scalar, _: &[#scalar; #count], _: &[#scalar; #count], _: &[#scalar; #inputs]
                ) -> [#scalar; #count] { loop {} }
                fn energy_at(
                    &self, _: &(), _: #scalar, _: &[#scalar; #count], _: &[#scalar; #count]
                ) -> #scalar { loop {} }
            }
        };
    })
}

/// Whether the names can be fields of a struct.
fn sound(groups: &[Group]) -> bool {
    let names: Vec<String> = groups.iter().map(|group| group.ident.to_string()).collect();
    let valid = |name: &String| syn::parse_str::<syn::Ident>(name).is_ok();
    names.iter().enumerate().all(|(place, name)| valid(name) && !names[..place].contains(name))
}

/// The inherent methods, but for those whose name the user has taken.
fn methods(item: &Item, scalar: &TokenStream, count: usize, inputs: usize) -> TokenStream {
    let given = (inputs > 0).then(|| quote!(, _: &[#scalar; #inputs]));
    let none = None;
    let vector = quote!([#scalar; #count]);
    let matrix = quote!(lagrange::nalgebra::SMatrix<#scalar, #count, #count>);
    let result = quote!(::core::result::Result<#vector, lagrange::MotionError<#scalar>>);
    [
        ("accelerations", &given, &result),
        ("applied_forces", &given, &vector),
        ("power", &given, scalar),
        ("mass_matrix", &none, &matrix),
        ("bias", &none, &vector),
        ("momenta", &none, &vector),
        ("kinetic_energy", &none, scalar),
        ("potential_energy", &none, scalar),
        ("energy", &none, scalar),
        ("jacobi_integral", &none, scalar),
    ]
    .into_iter()
    .filter(|(name, ..)| item.functions.iter().all(|function| *function.name != **name))
    .map(|(name, inputs, output)| {
        let name = format_ident!("{name}");
        quote!(pub fn #name(&self, _: &lagrange::State<#scalar, #count> #inputs) -> #output { loop {} })
    })
    .collect()
}
