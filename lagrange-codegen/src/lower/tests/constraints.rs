//! Constraints in the model.

use proc_macro2::TokenStream;
use quote::quote;

use super::{lowered, refused, value};
use crate::model::{ConstraintKind, Law, Model};

/// A system of three coordinates with some more functions.
fn sphere(functions: TokenStream) -> TokenStream {
    quote! {
        impl Sphere {
            #[point(mass = self.mass)]
            fn bead(&self, q: &Coordinates) -> Vector3<f64> { Vector3::new(q.x, q.y, q.z) }
            #functions
        }
    }
}

fn model(args: TokenStream, functions: TokenStream) -> Model {
    lowered(quote!(coordinates = [x, y, z], #args), sphere(functions)).expect("accepted")
}

#[test]
fn constraints_come_in_the_order_of_declaration() {
    let model = model(
        quote!(baumgarte = 2.0 * self.rate, allow(redundant, integrable)),
        quote! {
            #[nonholonomic]
            fn rolling(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] { [v.x - q.z, v.y * q.x] }
            #[holonomic]
            fn plane(&self, q: &Coordinates, t: f64) -> f64 { q.y - t * q.x }
            #[nonholonomic(chetaev)]
            fn speed(&self, v: &Velocities) -> f64 { v.x.powi(2) - 1.0 }
            #[holonomic]
            fn hinge(&self, q: &Coordinates) -> Vector2<f64> { self.bead(q).xy() - Vector2::new(1.0, 2.0) }
        },
    );
    let written: Vec<String> = model.constraints.iter().map(|constraint| constraint.written()).collect();
    assert_eq!(written, ["rolling[0]", "rolling[1]", "plane", "speed", "hinge[0]", "hinge[1]"]);
    assert_eq!(model.constraints[1].label(), "rolling_1");
    let affine = ConstraintKind::Nonholonomic { chetaev: false };
    let any = ConstraintKind::Nonholonomic { chetaev: true };
    let kinds: Vec<ConstraintKind> = model.constraints.iter().map(|constraint| constraint.kind).collect();
    let holonomic = ConstraintKind::Holonomic;
    assert_eq!(kinds, [affine, affine, holonomic, any, holonomic, holonomic]);
    let values = model.constraints.iter().map(|constraint| value(&model, constraint.value, |_| 0.0));
    let expected = [-0.4 - 1.1, 0.1 * 0.3, 0.7 - 0.9 * 0.3, 0.16 - 1.0, 0.3 - 1.0, 0.7 - 2.0];
    for (found, expected) in values.zip(expected) {
        assert!((found - expected).abs() < 1e-15, "{found} for {expected}");
    }
    let rate = model.baumgarte.expect("a rate");
    assert_eq!(value(&model, rate, |path| f64::from(u8::from(path == "self.rate"))), 2.0);
    assert_eq!(model.hints.name(model.constraints[1].value), Some("rolling_1"));
}

#[test]
fn eliminations_stand_apart() {
    let args = quote!(coordinates = [x, theta: [2]]);
    let model = lowered(
        args.clone(),
        quote! {
            impl Driven {
                #[kinetic]
                fn energy(&self, v: &Velocities) -> f64 { v.x.powi(2) }
                #[holonomic(eliminate)]
                fn any(&self, q: &Coordinates, t: f64) -> f64 { q.x - t }
                #[holonomic(eliminate = theta[1])]
                fn one(&self, q: &Coordinates, t: f64) -> f64 { q.theta[1] - t }
                #[holonomic(eliminate = theta)]
                fn both(&self, q: &Coordinates, t: f64) -> [f64; 2] { [q.theta[0] - t, q.theta[1]] }
            }
        },
    )
    .expect("accepted");
    let named: Vec<(String, Option<usize>)> = model
        .eliminations
        .iter()
        .map(|elimination| (elimination.constraint.written(), elimination.coordinate))
        .collect();
    let expected = [("any", None), ("one", Some(2)), ("both[0]", Some(1)), ("both[1]", Some(2))];
    assert_eq!(named, expected.map(|(name, coordinate)| (name.to_owned(), coordinate)));
    assert!(model.constraints.is_empty());
    refused(
        args,
        quote! {
            impl Driven {
                #[holonomic(eliminate = theta)]
                fn drive(&self, q: &Coordinates, t: f64) -> f64 { q.theta[0] - t }
            }
        },
        "`drive` is 1 constraint and cannot eliminate 2 coordinates; ",
    );
}

#[test]
fn the_form_is_checked() {
    let block = |functions: TokenStream, start: &str| {
        refused(quote!(coordinates = [x, y, z], inputs = [motor]), sphere(functions), start);
    };
    block(
        quote!(
            #[holonomic]
            fn f(&self, q: &Coordinates, v: &Velocities) -> f64 {
                q.x * v.x
            }
        ),
        "a holonomic constraint is a function of coordinates and time; write `#[nonholonomic]`",
    );
    block(
        quote!(
            #[nonholonomic]
            fn f(&self, v: &Velocities, u: &Inputs) -> f64 {
                v.x - u.motor
            }
        ),
        "an input acts through a force",
    );
    block(
        quote!(
            #[holonomic]
            fn f(&self, q: &Coordinates) -> Matrix2<f64> {
                Matrix2::zeros()
            }
        ),
        "`f` must return what is to stay zero, a scalar or an array of scalars, not a Matrix2",
    );
    block(
        quote!(
            #[holonomic]
            fn f(&self, q: &Coordinates) {}
        ),
        "`f` returns nothing; let it return what is to stay zero",
    );
    block(
        quote!(
            #[holonomic]
            fn f(&self) -> f64 {
                self.x - 1.0
            }
        ),
        "`x` is a coordinate; write `q.x`",
    );
    block(
        quote!(
            #[nonholonomic(chetaev = 1)]
            fn f(&self, v: &Velocities) -> f64 {
                v.x
            }
        ),
        "`chetaev` takes no value; ",
    );
    block(
        quote!(
            #[holonomic(eliminat)]
            fn f(&self, q: &Coordinates) -> f64 {
                q.x
            }
        ),
        "`holonomic` has no argument `eliminat`; did you mean `eliminate`?",
    );
    block(
        quote!(
            #[point(mass)]
            fn f(&self, q: &Coordinates) -> f64 {
                q.x
            }
        ),
        "cannot read the arguments of `point` (expected `=`); ",
    );
    block(
        quote!(
            #[nonholonomic(eliminate)]
            fn f(&self, v: &Velocities) -> f64 {
                v.x
            }
        ),
        "`nonholonomic` has no argument `eliminate`; known are `chetaev`",
    );
    block(
        quote!(
            #[holonomic(eliminate = w)]
            fn f(&self, q: &Coordinates) -> f64 {
                q.x
            }
        ),
        "there is no coordinate `w`; declared are ",
    );
    refused(
        quote!(coordinates = [x, y, z], baumgarte = q.x),
        sphere(quote!(
            #[holonomic]
            fn f(&self, q: &Coordinates) -> f64 {
                q.x
            }
        )),
        "`q` is not in sight here: ",
    );
}

#[test]
fn an_orientation_that_a_constraint_names_moves_what_it_carries() {
    let top = |lean: TokenStream| {
        quote! {
            impl Top {
                #[point(mass = 1.0)]
                fn tip(&self, q: &Coordinates) -> Vector3<f64> { q.attitude * Vector3::z() }
                #[holonomic]
                fn rest(&self, q: &Coordinates) -> f64 { self.tip(q).z - 0.5 }
                #[holonomic]
                fn lean(&self, q: &Coordinates) -> f64 { #lean }
                #[friction(coefficient = 0.3, normal = tip)]
                fn slip(&self, v: &Velocities) -> f64 { v.attitude.x }
            }
        }
    };
    let args = quote!(coordinates = [attitude: Rotation, beside: Rotation]);
    refused(
        args.clone(),
        top(quote!((q.attitude * Vector3::x()).y)),
        "`lean` names coordinates that move `tip`, so that its force there does not follow from its form; ",
    );
    let model = lowered(args, top(quote!((q.beside * Vector3::x()).y))).expect("accepted");
    assert_eq!(model.contacts.len(), 1);
}

#[test]
fn friction_by_all_forces_on_a_place_knows_of_eliminated_constraints() {
    let bead = |side: TokenStream| {
        quote! {
            impl Bead {
                #[point(mass = 1.0)]
                fn tip(&self, q: &Coordinates) -> Vector3<f64> { Vector3::new(q.x, q.y, q.z) }
                #[holonomic]
                fn bottom(&self, q: &Coordinates) -> f64 { self.tip(q).z }
                #[holonomic(eliminate)]
                fn side(&self, q: &Coordinates, t: f64) -> f64 { #side }
                #[friction(coefficient = 0.3, normal = tip)]
                fn slip(&self, v: &Velocities) -> f64 { v.x }
            }
        }
    };
    let args = quote!(coordinates = [x, y, z, motor]);
    for side in [quote!(self.tip(q).y), quote!(q.y - t)] {
        refused(args.clone(), bead(side), "`side` acts on `tip` as well; ");
    }
    lowered(args, bead(quote!(q.motor - t))).expect("accepted");
}

/// A cart with a pole, whose tip touches a wall: the message about friction there, if any.
fn touching(gap: TokenStream) -> Result<Model, Vec<String>> {
    lowered(
        quote!(coordinates = [x, theta]),
        quote! {
            impl Cart {
                #[point(mass = 1.0)] fn cart(&self, q: &Coordinates) -> Vector2<f64> { Vector2::new(q.x, 0.0) }
                #[point(mass = 1.0)] fn tip(&self, q: &Coordinates) -> Vector2<f64> {
                    Vector2::new(q.x + q.theta.sin(), -q.theta.cos()) }
                #[unilateral] fn wall(&self, q: &Coordinates) -> f64 { #gap }
                #[friction(coefficient = 0.5, normal = wall)] fn slip(&self, v: &Velocities) -> f64 { v.x }
            }
        },
    )
}

#[test]
fn friction_by_a_named_gap_needs_a_form_that_tells_its_force() {
    // λ is half of the force in the first, and the second shows a component of the force alone.
    for gap in
        [quote!(2.0 * (2.0 - q.theta.cos())), quote!(2.0 - 0.6 * (q.x + q.theta.sin()) + 0.8 * q.theta.cos())]
    {
        let messages = touching(gap).expect_err("refused");
        assert!(messages[0].starts_with("`wall` names coordinates that move `tip`, so that"), "{messages:?}");
    }
    let model = touching(quote!(2.0 * (2.0 + self.tip(q).y))).expect("accepted");
    let law = model.contacts.iter().find_map(|contact| match contact.law {
        Law::Friction { kinetic, .. } => Some(kinetic),
        Law::Unilateral { .. } => None,
    });
    assert_eq!(law.map(|kinetic| value(&model, kinetic, |_| f64::NAN)), Some(1.0));
}
