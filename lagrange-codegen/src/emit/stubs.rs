//! What stands for the generated items after a mistake, so that the rest of a program still
//! compiles and our messages are the only ones.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::records;
use crate::syntax::{Group, Item, Scalar};

/// All items that a program may use of a system, without content.
pub(crate) fn stubs(item: &Item) -> TokenStream {
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
    let given = (inputs > 0).then(|| quote!(, _: &[#scalar; #inputs]));
    let vectors = ["bias", "momenta"].map(|name| format_ident!("{name}"));
    let scalars = ["kinetic_energy", "potential_energy", "energy", "jacobi_integral"]
        .map(|name| format_ident!("{name}"));
    quote! {
        #records
        const _: () = {
            use #crate_path::__private as lagrange;

            #[allow(missing_docs, dead_code, clippy::all)]
            impl #impl_generics #self_ty #where_clause {
                pub const COST: lagrange::Costs = lagrange::Costs {
                    before: lagrange::Cost::new(0, 0, 0, 0, 0),
                    after: lagrange::Cost::new(0, 0, 0, 0, 0),
                };
                pub const STRUCTURE: lagrange::Structure =
                    lagrange::Structure { mass_matrix: "", facts: &[], skipped: &[] };
                pub fn accelerations(
                    &self, _: &lagrange::State<#scalar, #count> #given
                ) -> ::core::result::Result<[#scalar; #count], lagrange::MotionError<#scalar>> { loop {} }
                pub fn mass_matrix(
                    &self, _: &lagrange::State<#scalar, #count>
                ) -> lagrange::nalgebra::SMatrix<#scalar, #count, #count> { loop {} }
                pub fn applied_forces(
                    &self, _: &lagrange::State<#scalar, #count> #given
                ) -> [#scalar; #count] { loop {} }
                pub fn power(&self, _: &lagrange::State<#scalar, #count> #given) -> #scalar { loop {} }
                #(pub fn #vectors(&self, _: &lagrange::State<#scalar, #count>) -> [#scalar; #count] { loop {} })*
                #(pub fn #scalars(&self, _: &lagrange::State<#scalar, #count>) -> #scalar { loop {} })*
            }

            impl #impl_generics lagrange::System<#count, #inputs> for #self_ty #where_clause {
                type Scalar = #scalar;
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
    }
}
