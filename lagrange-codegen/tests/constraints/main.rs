//! Constraints and eliminations that are refused, beside those that are accepted.

mod elimination;
mod mistakes;

use lagrange_codegen::diagnostics::Diagnostics;
use lagrange_codegen::model::Model;
use lagrange_codegen::{eliminate, lower, mechanics, syntax};
use proc_macro2::TokenStream;
use quote::quote;

/// The model of a description after its equations are derived, or the messages.
fn derived(args: TokenStream, item: TokenStream) -> Result<Model, Vec<String>> {
    let mut diagnostics = Diagnostics::new();
    let model = syntax::parse(args, item, "::lagrangian", &mut diagnostics).map(|item| {
        let mut model = lower::lower(&item, &mut diagnostics);
        if !diagnostics.has_errors() {
            eliminate::eliminate(&mut model, &mut diagnostics);
        }
        if !diagnostics.has_errors() {
            mechanics::derive(&mut model, true, &|lint| item.allows(lint), &mut diagnostics);
        }
        model
    });
    match (model, diagnostics.has_errors()) {
        (Some(model), false) => Ok(model),
        _ => Err(diagnostics.messages().map(String::from).collect()),
    }
}

/// A particle in space with some constraints.
fn particle(constraints: TokenStream) -> TokenStream {
    quote! {
        impl Particle {
            #[point(mass = self.mass)]
            fn bead(&self, q: &Coordinates) -> Vector3<f64> { Vector3::new(q.x, q.y, q.z) }
            #constraints
        }
    }
}

#[track_caller]
fn accepted(args: TokenStream, constraints: TokenStream) -> Model {
    match derived(quote!(coordinates = [x, y, z], #args), particle(constraints.clone())) {
        Ok(model) => model,
        Err(messages) => panic!("{constraints}\n{messages:#?}"),
    }
}

/// The one message about some constraints starts as given.
#[track_caller]
fn refused(args: TokenStream, constraints: TokenStream, start: &str) {
    let messages = match derived(quote!(coordinates = [x, y, z], #args), particle(constraints.clone())) {
        Ok(_) => panic!("accepted: {constraints}"),
        Err(messages) => messages,
    };
    assert!(
        messages.len() == 1 && messages[0].starts_with(start),
        "{constraints}\n{messages:#?}\ninstead of {start}"
    );
}
