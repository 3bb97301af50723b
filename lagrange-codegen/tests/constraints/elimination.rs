//! Coordinates that constraints eliminate.

use lagrange_codegen::expr::Variable;
use lagrange_codegen::model::{Eliminated, Model};
use proc_macro2::TokenStream;
use quote::quote;

use super::accepted;

#[track_caller]
fn refused(constraints: TokenStream, start: &str) {
    super::refused(quote!(), constraints, start);
}

/// The names of the coordinates that remain, and of those that are eliminated, with their declared indices.
fn names(model: &Model) -> (Vec<String>, Vec<(String, usize)>) {
    let left = model.coordinates.iter().map(|quantity| quantity.written()).collect();
    let gone = |one: &Eliminated| (one.quantity.written(), one.declared_index);
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
            Variable::Coordinate(0) => 5.0,
            Variable::Velocity(0) => 3.0,
            Variable::Time => 7.0,
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
