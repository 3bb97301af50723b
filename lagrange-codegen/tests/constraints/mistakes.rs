//! Constraints that restrain nothing, too much, or something else than they say.

use proc_macro2::TokenStream;
use quote::quote;

use super::{derived, particle};

#[track_caller]
fn refused(constraints: TokenStream, start: &str) {
    super::refused(quote!(), constraints, start);
}

#[track_caller]
fn accepted(constraints: TokenStream) {
    super::accepted(quote!(), constraints);
}

/// A constraint of three coordinates with a value.
fn holonomic(value: TokenStream) -> TokenStream {
    quote!(#[holonomic] fn f(&self, q: &Coordinates, t: f64) -> f64 { #value })
}

fn nonholonomic(value: TokenStream) -> TokenStream {
    quote!(#[nonholonomic] fn g(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 { #value })
}

/// Two constraints, the second one named `h`.
fn pair(first: TokenStream, second: TokenStream) -> TokenStream {
    let first = holonomic(first);
    quote!(#first #[holonomic] fn h(&self, q: &Coordinates, t: f64) -> f64 { #second })
}

#[test]
fn a_constraint_contains_what_it_constrains() {
    for value in [quote!(t - 1.0), quote!(q.x - (q.x + self.a)), quote!(q.x.signum() - t)] {
        refused(
            holonomic(value),
            "`f` restrains nothing: its value changes with no coordinate and no velocity; ",
        );
    }
    refused(nonholonomic(quote!(v.x - v.x + t)), "`g` restrains nothing: ");
    refused(nonholonomic(quote!(q.x - q.y)), "`g` depends on no velocity, so it is holonomic; ");
    refused(
        quote! {
            #[holonomic(eliminate = x)] fn drive(&self, q: &Coordinates, t: f64) -> f64 { q.x - t }
            #[holonomic] fn stop(&self, q: &Coordinates) -> f64 { q.x.sin() }
        },
        "`stop` restrains nothing: its value changes with no coordinate and no velocity that is not eliminated; ",
    );
}

#[test]
fn a_nonholonomic_constraint_is_affine_unless_chetaev_is_named() {
    let start = "the constraint `g` is not affine in the velocities here; ";
    for value in [quote!(v.x.powi(2) + v.y.powi(2) - 1.0), quote!(q.x * v.x * v.y), quote!(v.x.sin() - q.y)] {
        refused(nonholonomic(value.clone()), start);
        accepted(quote! {
            #[nonholonomic(chetaev)] fn g(&self, q: &Coordinates, v: &Velocities) -> f64 { #value }
        });
    }
    // The squares cancel.
    accepted(nonholonomic(quote!(
        (v.x + v.y).powi(2) - (v.x - v.y).powi(2) - 4.0 * v.x * v.y + q.y * v.z - v.x
    )));
}

#[test]
fn repetitions_are_found_in_any_multiple() {
    let sphere = || quote!(q.x.powi(2) + q.y.powi(2) + q.z.powi(2) - self.r.powi(2));
    for again in [
        sphere(),
        quote!(2.0 * self.r.powi(2) - 2.0 * (q.z.powi(2) + q.x.powi(2)) - 2.0 * q.y.powi(2)),
        quote!(self.bead(q).norm() - self.r),
        quote!(self.k * self.bead(q).norm_squared() - self.k * self.r.powi(2)),
        quote!(self.bead(q).norm() - self.other),
    ] {
        let both = pair(sphere(), again);
        refused(both.clone(), "`h` restrains the same motion as `f`, ");
        super::accepted(quote!(allow(redundant)), both);
    }
    accepted(pair(sphere(), quote!(q.x.powi(2) + q.y.powi(2) + 2.0 * q.z.powi(2) - self.r.powi(2))));
    // The condition on velocities that a holonomic constraint implies.
    let both = quote! {
        #[holonomic] fn f(&self, q: &Coordinates) -> f64 { q.x * q.y }
        #[nonholonomic] fn g(&self, q: &Coordinates, v: &Velocities) -> f64 { q.x * v.y + q.y * v.x }
    };
    super::refused(quote!(allow(integrable)), both.clone(), "`g` restrains the same motion as `f`, ");
    super::accepted(quote!(allow(integrable, redundant)), both);
}

#[test]
fn contradictions_are_never_allowed() {
    let start = "`h` contradicts `f`: ";
    let both = pair(quote!(q.x - q.y), quote!(2.0 * q.y - 2.0 * q.x + 1.0));
    refused(both.clone(), start);
    super::refused(quote!(allow(redundant)), both, start);
    let both = quote! {
        #[nonholonomic] fn f(&self, q: &Coordinates, v: &Velocities) -> f64 { q.y * v.x - v.z }
        #[nonholonomic] fn h(&self, q: &Coordinates, v: &Velocities) -> f64 { q.y * v.x - v.z - 3.0 }
    };
    super::refused(quote!(allow(redundant)), both, start);
}

#[test]
fn more_constraints_than_coordinates_are_too_many() {
    let three = quote! {
        #[holonomic] fn f(&self, q: &Coordinates) -> [f64; 2] { [q.x + q.y - 1.0, q.x * q.y + self.a] }
        #[holonomic] fn g(&self, q: &Coordinates) -> f64 { q.x.sin() - q.y.cos() }
    };
    refused(three.clone(), "`g` is one constraint too many: ");
    super::accepted(quote!(allow(redundant)), three);
    accepted(holonomic(quote!(q.x - t)));
    // As many constraints as coordinates prescribe everything. The reactions are still a result.
    accepted(quote! {
        #[holonomic]
        fn f(&self, q: &Coordinates, t: f64) -> [f64; 3] { [q.x - t, q.y * q.x, q.z - q.x * t] }
    });
}

#[test]
fn a_gradient_must_not_vanish_with_the_constraint() {
    let start = "wherever `f` is zero its gradient is zero too, or has no value, ";
    for (value, advice) in [
        (quote!((q.x - q.y).powi(2)), "the power"),
        (quote!(-3.0 * self.k * (q.x - q.y.sin()).powi(3)), "the power"),
        (quote!((q.x * q.y - 1.0).sqrt()), "the power"),
        (quote!(self.bead(q).norm()), "components"),
        (quote!(q.x.powi(2) + 2.0 * (q.y - self.a).powi(2)), "components"),
        (quote!((q.x.sin() - t).abs()), "`abs`"),
    ] {
        let value = holonomic(value);
        refused(value.clone(), start);
        let messages = derived(quote!(coordinates = [x, y, z]), particle(value)).unwrap_err();
        assert!(messages[0].contains(advice), "{messages:?}");
    }
    for value in [
        quote!(q.x * q.y),
        quote!(q.x.powi(2) * q.y),
        quote!(q.x.powi(2) - q.y.powi(2)),
        quote!(q.x.powi(2) + self.k * q.y.powi(2)),
        quote!(self.bead(q).norm() - self.r),
        quote!(q.x.abs() - q.y),
    ] {
        accepted(holonomic(value));
    }
    refused(
        quote! {
            #[nonholonomic(chetaev)] fn f(&self, v: &Velocities) -> f64 { (v.x.powi(2) + v.y.powi(2) - 1.0).powi(2) }
        },
        start,
    );
}

#[test]
fn time_derivatives_are_holonomic() {
    for value in [
        quote!(v.x - self.r * v.y),
        quote!(q.x * v.y + q.y * v.x),
        quote!(v.x * q.y.cos() - q.x * q.y.sin() * v.y + 2.0 * t),
        quote!(t * v.x + q.x),
        quote!(v.x - self.speed),
    ] {
        refused(
            nonholonomic(value.clone()),
            "`g` is the time derivative of a function of coordinates and time; ",
        );
        super::accepted(quote!(allow(integrable)), nonholonomic(value));
    }
    for value in [
        quote!(v.x - self.r * v.z * q.y.cos()),
        quote!(q.y.sin() * v.x - q.y.cos() * v.z),
        quote!(q.x * v.y - q.y * v.x),
        quote!(t * v.x - q.x),
    ] {
        accepted(nonholonomic(value));
    }
}

#[test]
fn constraints_determine_massless_coordinates() {
    let item = |constraints: TokenStream| {
        quote! {
            impl Steered {
                #[point(mass = self.mass)]
                fn wheel(&self, q: &Coordinates) -> Vector2<f64> { Vector2::new(q.x, q.y) }
                #constraints
            }
        }
    };
    let check = |constraints: TokenStream| derived(quote!(coordinates = [x, y, a, b]), item(constraints));
    let one = quote!(
        #[holonomic]
        fn f(&self, q: &Coordinates) -> f64 {
            q.a * q.b - q.x
        }
    );
    let messages = check(one.clone()).unwrap_err();
    assert!(
        messages.len() == 1 && messages[0].starts_with("the coordinate `b` has no inertia"),
        "{messages:?}"
    );
    // The first constraint alone contains b, so the second one determines a.
    check(quote!(#one #[holonomic] fn g(&self, q: &Coordinates) -> f64 { q.a - q.y.sin() }))
        .expect("determined");
    let messages =
        check(quote!(#one #[holonomic] fn g(&self, q: &Coordinates) -> f64 { q.x - q.y })).unwrap_err();
    assert!(
        messages.len() == 1 && messages[0].starts_with("the coordinate `b` has no inertia"),
        "{messages:?}"
    );
}

#[test]
fn the_whole_saddle_point_system_is_judged() {
    // M has entries at (x, z) and (y, z) alone: x and y share one inertia.
    let check = |constraints: TokenStream| {
        let item = quote! {
            impl Shared {
                #[kinetic]
                fn energy(&self, v: &Velocities) -> f64 { v.z * (v.x + v.y) }
                #constraints
            }
        };
        derived(quote!(coordinates = [x, y, z]), item).err()
    };
    let of = |value: TokenStream| check(holonomic(value));
    let start = "the mass matrix is singular whatever the parameters: the inertia of the coordinate `";
    for messages in [check(quote!()), of(quote!(q.z.sin() - t))] {
        let messages = messages.expect("singular");
        assert!(messages.len() == 1 && messages[0].starts_with(start), "{messages:?}");
    }
    assert_eq!(of(quote!(q.x.sin() - q.y)), None);
}

#[test]
fn stabilisation_needs_something_to_stabilise() {
    let rate = quote!(baumgarte = 5.0);
    super::refused(rate.clone(), quote!(), "there is no constraint to stabilise; ");
    super::accepted(quote!(baumgarte = 5.0, allow(no_effect)), quote!());
    super::accepted(rate, holonomic(quote!(q.x - t)));
    super::refused(
        quote!(baumgarte = -5.0),
        holonomic(quote!(q.x - t)),
        "the rate of Baumgarte's stabilisation must be positive; ",
    );
}

#[test]
fn constants_without_a_value_are_reported() {
    refused(holonomic(quote!(q.x - (-2.0_f64).sqrt())), "this constant is not a finite number");
}
