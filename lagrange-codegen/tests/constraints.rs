//! What is wrong with a constraint, or with its elimination, and what is not.

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
            mechanics::derive(&mut model, &|lint| item.allows(lint), &mut diagnostics);
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

mod elimination {
    use super::*;

    #[track_caller]
    fn refused(constraints: TokenStream, start: &str) {
        super::refused(quote!(), constraints, start);
    }

    /// What is left, and what is not.
    fn names(model: &Model) -> (Vec<String>, Vec<(String, usize)>) {
        let left = model.coordinates.iter().map(|quantity| quantity.written()).collect();
        let gone = |one: &lagrange_codegen::model::Eliminated| (one.quantity.written(), one.declared_index);
        (left, model.eliminated.iter().map(gone).collect())
    }

    #[test]
    fn the_last_free_coordinate_is_chosen_unless_one_is_named() {
        let model = accepted(
            quote!(),
            quote! {
                #[holonomic(eliminate)]
                fn any(&self, q: &Coordinates, t: f64) -> f64 { q.x + 2.0 * q.y + self.c * q.z - t }
                #[holonomic(eliminate = z)]
                fn named(&self, q: &Coordinates) -> f64 { q.z - q.y }
            },
        );
        let (left, gone) = names(&model);
        assert_eq!(left, ["x"]);
        assert_eq!(gone, [("y".to_owned(), 1), ("z".to_owned(), 2)]);
        // y = z, so that x + (2 + c) y = t.
        let values = model.graph.evaluate(
            &[model.eliminated[0].position, model.eliminated[1].position, model.eliminated[1].velocity],
            |variable| match variable {
                lagrange_codegen::expr::Variable::Coordinate(0) => 5.0,
                lagrange_codegen::expr::Variable::Velocity(0) => 3.0,
                lagrange_codegen::expr::Variable::Time => 7.0,
                _ => 2.0,
            },
        );
        assert_eq!(values, [0.5, 0.5, -0.5]);
    }

    #[test]
    fn other_coordinates_may_enter_in_any_way() {
        let model = accepted(
            quote!(),
            quote! {
                #[holonomic(eliminate)]
                fn bowl(&self, q: &Coordinates) -> f64 { self.k * q.y - q.x.powi(2) * q.z.sin() }
            },
        );
        assert_eq!(names(&model).0, ["x", "z"]);
    }

    #[test]
    fn a_coefficient_must_stay_the_same() {
        let start = "`f` cannot be solved for `x`, whose coefficient is not the same all through a run; ";
        for value in
            [quote!(q.x * q.y - 1.0), quote!(q.x * t - q.y), quote!(q.x.sin()), quote!(q.x.powi(3) - q.x)]
        {
            refused(
                quote!(#[holonomic(eliminate = x)] fn f(&self, q: &Coordinates, t: f64) -> f64 { #value }),
                start,
            );
        }
        refused(
            quote!(
                #[holonomic(eliminate)]
                fn f(&self, q: &Coordinates) -> f64 {
                    q.x.powi(2) + q.y.powi(2) - 1.0
                }
            ),
            "`f` cannot be solved for `y`, ",
        );
    }

    #[test]
    fn what_is_to_be_eliminated_must_be_there() {
        refused(
            quote!(
                #[holonomic(eliminate = x)]
                fn f(&self, q: &Coordinates) -> f64 {
                    q.y + q.x - q.z - q.x
                }
            ),
            "the coordinate `x` does not occur in `f` or cancels out; what can be eliminated here is `y`, `z`",
        );
        for eliminate in [quote!(eliminate), quote!(eliminate = x)] {
            refused(
                quote!(
                    #[holonomic(#eliminate)]
                    fn f(&self, t: f64) -> f64 {
                        t - 1.0
                    }
                ),
                "`f` determines no coordinate: ",
            );
        }
        refused(
            quote! {
                #[holonomic(eliminate = x)] fn f(&self, q: &Coordinates, t: f64) -> f64 { q.x - t }
                #[holonomic(eliminate)] fn g(&self, q: &Coordinates, t: f64) -> f64 { q.x - 2.0 * t }
            },
            "`g` determines no coordinate: ",
        );
    }

    #[test]
    fn a_coordinate_is_eliminated_once_and_one_must_be_left() {
        refused(
            quote! {
                #[holonomic(eliminate = x)] fn f(&self, q: &Coordinates) -> f64 { q.x - q.y }
                #[holonomic(eliminate = x)] fn g(&self, q: &Coordinates) -> f64 { q.x - q.z }
            },
            "the coordinate `x` is eliminated by another constraint already; ",
        );
        refused(
            quote! {
                #[holonomic(eliminate)]
                fn f(&self, q: &Coordinates, t: f64) -> Vector3<f64> { self.bead(q) - Vector3::new(t, t, t) }
            },
            "all coordinates are eliminated, ",
        );
    }
}
