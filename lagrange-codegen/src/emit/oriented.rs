//! Records and methods of systems with orientations. A state holds three numbers of each; the records have a
//! quaternion and the angular velocity.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::Emission;
use crate::syntax::item::Kind;
use crate::syntax::{Group, Item, Record};

/// The method that builds a state from named quantities.
pub(crate) const METHOD: &str = "state";

/// One element of a group: its numbers in a state, and the Rust text of its field.
struct Element {
    kind: Kind,
    numbers: Vec<Ident>,
    place: TokenStream,
}

fn elements(groups: &[Group]) -> Vec<Element> {
    let mut next = 0;
    let mut elements = Vec::new();
    for group in groups {
        let ident = &group.ident;
        for index in 0..group.length.unwrap_or(1) {
            let place = match group.length {
                Some(_) => quote!(#ident[#index]),
                None => quote!(#ident),
            };
            let numbers = (next..next + group.kind.width()).map(|i| format_ident!("x{i}")).collect();
            next += group.kind.width();
            elements.push(Element { kind: group.kind, numbers, place });
        }
    }
    elements
}

/// The conversions of a record to and from numbers.
pub(super) fn conversions(item: &Item, record: Record) -> TokenStream {
    let (name, path) = (item.record_ident(record), &item.crate_path);
    let attitude = quote!(#path::__private::attitude);
    let elements = elements(&item.coordinates);
    let count: usize = item.coordinates.iter().map(Group::size).sum();
    let all: Vec<&Ident> = elements.iter().flat_map(|element| &element.numbers).collect();
    let made: Vec<TokenStream> = elements
        .iter()
        .map(|Element { kind, numbers, .. }| match (kind, record) {
            (Kind::Scalar, _) => quote!(#(#numbers)*),
            (Kind::Rotation, Record::Velocities) => {
                quote!(#path::__private::nalgebra::Vector3::new(#(#numbers),*))
            }
            (Kind::Pose, Record::Velocities) => quote!(#attitude::pose_velocity([#(#numbers),*])),
            (Kind::Rotation, _) => quote!(#attitude::rotation([#(#numbers),*])),
            (Kind::Pose, _) => quote!(#attitude::pose([#(#numbers),*])),
        })
        .collect();
    let mut made = made.into_iter();
    let fields = item.coordinates.iter().map(|group| {
        let ident = &group.ident;
        let parts: Vec<TokenStream> = made.by_ref().take(group.length.unwrap_or(1)).collect();
        match group.length {
            Some(_) => quote!(#ident: [#(#parts),*]),
            None => quote!(#ident: #(#parts)*),
        }
    });
    let bound = quote!(impl<R: #path::__private::Real>);
    let (source, numbers_of) = match record {
        // The rates in a state depend on the coordinates, too.
        Record::Velocities => {
            let rates = elements.iter().map(|Element { kind, numbers, place }| {
                let rates = match kind {
                    Kind::Scalar => quote!([self.#place]),
                    Kind::Rotation => quote!(#attitude::rates([#(#numbers),*], &self.#place)),
                    Kind::Pose => quote!(#attitude::pose_rates([#(#numbers),*], &self.#place)),
                };
                quote!(let [#(#numbers),*] = #rates;)
            });
            let numbers_of = quote! {
                #bound #name<R> {
                    /// The rates in a state that these velocities mean, at the coordinates of the state.
                    #[doc(hidden)]
                    #[allow(unused_variables)]
                    pub fn __rates(&self, [#(#all),*]: [R; #count]) -> [R; #count] {
                        #(#rates)*
                        [#(#all),*]
                    }
                }
            };
            (quote!(#attitude::ByName([#(#all),*]): #attitude::ByName<R, #count>), numbers_of)
        }
        Record::Coordinates | Record::Inputs => {
            let numbers = elements.iter().map(|Element { kind, numbers, place }| {
                let found = match kind {
                    Kind::Scalar => quote!([named.#place]),
                    Kind::Rotation => quote!(#attitude::parameters(&named.#place)),
                    Kind::Pose => quote!(#attitude::pose_parameters(&named.#place)),
                };
                quote!(let [#(#numbers),*] = #found;)
            });
            let numbers_of = quote! {
                #bound ::core::convert::From<#name<R>> for [R; #count] {
                    fn from(named: #name<R>) -> Self {
                        #(#numbers)*
                        [#(#all),*]
                    }
                }
            };
            (quote!([#(#all),*]: [R; #count]), numbers_of)
        }
    };
    let source_type = match record {
        Record::Velocities => quote!(#attitude::ByName<R, #count>),
        Record::Coordinates | Record::Inputs => quote!([R; #count]),
    };
    quote! {
        #bound ::core::convert::From<#source_type> for #name<R> {
            fn from(#source) -> Self {
                Self { #(#fields),* }
            }
        }

        #numbers_of
    }
}

/// `state`, as text. A state holds nothing of coordinates that constraints eliminate.
pub(super) fn state(emission: &Emission<'_>) -> String {
    let item = emission.item;
    if !item.has_orientations() {
        return String::new();
    }
    let (scalar, state) = (&emission.scalar, emission.state_type());
    let [coordinates, velocities] =
        [Record::Coordinates, Record::Velocities].map(|record| item.record_ident(record));
    let eliminated = &emission.model.eliminated;
    let declared = emission.count() + eliminated.len();
    let (mut q, mut v, mut note) = ("q".to_owned(), "velocities.__rates(q)".to_owned(), "");
    if !eliminated.is_empty() {
        let is_left = |index: &usize| eliminated.iter().all(|eliminated| eliminated.declared_index != *index);
        let left = |of: &str| {
            let numbers = (0..declared).filter(is_left).map(|i| format!("{of}[{i}]"));
            format!("[{}]", numbers.collect::<Vec<_>>().join(", "))
        };
        v = format!("{{ let v = {v};\n{} }}", left("v"));
        q = left("q");
        note = " What constraints have eliminated follows from the rest and is not read here.";
    }
    format!(
        "/// The state at time zero with these coordinates and velocities: angular velocities in body axes [rad/s].{note}\n\
         #[inline]\npub fn {METHOD}(&self, coordinates: {coordinates}<{scalar}>, velocities: {velocities}<{scalar}>) -> {state} {{\n\
         let q: [{scalar}; {declared}] = ::core::convert::Into::into(coordinates);\n\
         lagrange::State::new({q}, {v})\n}}\n"
    )
}

/// The same without content.
pub(super) fn stub(item: &Item, scalar: &TokenStream, count: usize) -> TokenStream {
    let [coordinates, velocities] =
        [Record::Coordinates, Record::Velocities].map(|record| item.record_ident(record));
    let name = format_ident!("{METHOD}");
    quote! {
        pub fn #name(&self, _: #coordinates<#scalar>, _: #velocities<#scalar>) -> lagrange::State<#scalar, #count> {
            loop {}
        }
    }
}
