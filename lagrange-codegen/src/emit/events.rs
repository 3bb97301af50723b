//! Functions whose zeros are events, by name.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::Emission;
use super::body::{self, Source};
use super::hidden;
use crate::syntax::Item;
use crate::syntax::item::{Function, RoleKind};

/// The emitted items.
pub(super) struct Items {
    /// Hidden methods of the system, as text.
    pub methods: String,
    /// The enum of all events.
    pub named: Option<TokenStream>,
    /// The implementations that make the enum a guard.
    pub guards: Option<TokenStream>,
}

/// All items; none for a system without events.
pub(super) fn events(emission: &Emission<'_>) -> Items {
    let events = &emission.model.events;
    if events.is_empty() {
        return Items { methods: String::new(), named: None, guards: None };
    }
    let (item, state) = (emission.item, emission.state_type());
    let mut methods = String::new();
    let (mut arms, mut narrow, mut kinked) = (Vec::new(), Vec::new(), Vec::new());
    let number = emission.scalar.to_string();
    let method = |name: &str, returned: &str, body: String| {
        format!(
            "#[doc(hidden)]\n#[inline]\n#[allow(unused_variables)]\n\
             pub fn {name}(&self, state: &{state}) -> {returned} {{\n{body}\n}}\n"
        )
    };
    for (event, watched) in events.iter().zip(emission.in_events) {
        let value = format_ident!("__event_{}", event.name);
        let body = body::plain(emission.model, &emission.scalar, &[event.value], Source::State, |values| {
            values.join(", ")
        });
        methods.push_str(&method(&value.to_string(), &number, body));
        let variant = format_ident!("{}", camel(&event.name));
        let visits = format!("{value}_hidden");
        if let Some(text) = hidden::in_event(emission, watched.hidden.as_ref(), &visits) {
            methods.push_str(&text);
            let visits = format_ident!("{visits}");
            narrow.push(quote!(Self::#variant => system.#visits(states, visit)));
        }
        if !watched.kinks.is_empty() {
            let (kinks, count) = (format_ident!("{value}_kinks"), watched.kinks.len());
            let body =
                body::plain(emission.model, &emission.scalar, &watched.kinks, Source::State, |values| {
                    values.list()
                });
            methods.push_str(&method(&kinks.to_string(), &format!("[{number}; {count}]"), body));
            kinked.push(quote!(Self::#variant => system.#kinks(state).get(kink).copied()));
        }
        arms.push(quote!(Self::#variant => system.#value(state)));
    }
    let names: Vec<&str> = events.iter().map(|event| event.name.as_str()).collect();
    let (scalar, count) = (scalar(item), emission.count());
    let self_ty = &item.self_ty;
    let narrow = (!narrow.is_empty()).then(|| {
        let rest = (narrow.len() < events.len()).then(|| quote!(_ => {}));
        quote! {
            const NARROW: bool = true;
            fn hidden_along<const PLACES: usize>(
                &self,
                system: &#self_ty,
                states: &[lagrange::State<#scalar, #count>; PLACES],
                visit: impl ::core::ops::FnMut(lagrange::Hidden, [#scalar; PLACES]),
            ) {
                match self { #(#narrow,)* #rest }
            }
        }
    });
    let kinked = (!kinked.is_empty()).then(|| {
        let rest = (kinked.len() < events.len()).then(|| quote!(_ => ::core::option::Option::None));
        quote! {
            fn kink(
                &self,
                system: &#self_ty,
                state: &lagrange::State<#scalar, #count>,
                kink: usize,
            ) -> ::core::option::Option<#scalar> {
                match self { #(#kinked,)* #rest }
            }
        }
    });
    let guards = guard(item, count, &quote!(match self { #(#arms),* }), quote!(#narrow #kinked));
    Items { methods, named: Some(named(item, &names)), guards: Some(guards) }
}

/// The same after a mistake.
pub(super) fn stubs(item: &Item, count: usize) -> (Option<TokenStream>, Option<TokenStream>) {
    let is_event = |function: &&Function| matches!(function.meant(), Some(RoleKind::Event));
    let names: Vec<&str> = item.functions.iter().filter(is_event).map(|function| &*function.name).collect();
    let any = !names.is_empty();
    (any.then(|| named(item, &names)), any.then(|| guard(item, count, &quote!(loop {}), TokenStream::new())))
}

/// The scalar of a system.
fn scalar(item: &Item) -> TokenStream {
    item.scalar.to_string().parse().unwrap_or_default()
}

/// The implementations that make the enum a guard. `watched` are the items about what
/// samples may miss.
fn guard(item: &Item, count: usize, body: &TokenStream, watched: TokenStream) -> TokenStream {
    let Item { self_ty, generics, .. } = item;
    let scalar = scalar(item);
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let ident = format_ident!("{}Event", item.name);
    quote! {
        #[automatically_derived]
        impl #impl_generics lagrange::Guard<#self_ty, #scalar, #count> for #ident #where_clause {
            #[inline]
            #[allow(unused_variables)]
            fn value(&self, system: &#self_ty, state: &lagrange::State<#scalar, #count>) -> #scalar {
                #body
            }
            #watched
        }
    }
}

/// The enum of the events of these names.
fn named(item: &Item, names: &[&str]) -> TokenStream {
    let ident = format_ident!("{}Event", item.name);
    let doc = format!("The events of [`{}`]: guards for `advance_to_event` and `events`.", item.title);
    let variants = names.iter().map(|name| {
        let (variant, doc) = (format_ident!("{}", camel(name)), format!("A zero of `{name}`."));
        quote!(#[doc = #doc] #variant)
    });
    quote! {
        #[doc = #doc]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq, ::core::cmp::Eq)]
        pub enum #ident { #(#variants),* }
    }
}

/// `lower_apex` as `LowerApex`.
fn camel(name: &str) -> String {
    let words = name.split('_').filter(|word| !word.is_empty());
    words
        .map(|word| {
            let mut letters = word.chars();
            let first = letters.next().map_or_else(String::new, |letter| letter.to_uppercase().to_string());
            first + letters.as_str()
        })
        .collect()
}
