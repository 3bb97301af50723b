//! Refusals of the attribute, of roles, of signatures, of masses and of forces, each once.

use proc_macro2::TokenStream;
use quote::quote;

use super::refused;

/// The one message about an impl block with these items, the coordinates `x` and `a`, and the input `u`.
fn block(items: TokenStream, start: &str) {
    refused(quote!(coordinates = [x, a: [2]], inputs = [u]), quote!(impl System { #items }), start);
}

/// The one message about the arguments of the attribute.
fn attribute(args: TokenStream, start: &str) {
    let item = quote! {
        impl System {
            const N: usize = 3;
            #[kinetic]
            fn energy(&self, v: &Velocities) -> f64 { 0.5 * v.x * v.x }
        }
    };
    refused(args, item, start);
}

#[test]
fn attributes() {
    attribute(quote!(), "no coordinates are declared; add `coordinates = ");
    attribute(quote!(coordinates = []), "the list of coordinates is empty; name ");
    attribute(quote!(coordinates = [x, x]), "the coordinate `x` is declared twice; ");
    attribute(quote!(coordinates = [x], inputs = [x]), "`x` is declared as a coordinate and as an input; ");
    attribute(quote!(coordinates = [x, y: [0]]), "the array `y` has no elements; ");
    attribute(quote!(coordinates = [x, y: [999999999]]), "the array `y` is longer than ");
    attribute(quote!(coordinates = [x, y: [M]]), "the length of `y` is not known to the macro; ");
    attribute(quote!(coordinates = [x, type]), "`type` is a keyword; ");
    attribute(quote!(coordinate = [x]), "unknown argument `coordinate`; did you mean `coordinates`?");
    attribute(quote!(coordinates = [x], coordinates = [y]), "`coordinates` is given twice; ");
    attribute(
        quote!(coordinates = [x], allow(unused_inputs)),
        "there is no lint `unused_inputs`; did you mean",
    );
    attribute(quote!(coordinates = x), "cannot read these arguments (expected square brackets); ");
}

#[test]
fn blocks() {
    let args = || quote!(coordinates = [x]);
    refused(
        args(),
        quote!(
            struct S;
        ),
        "`#[lagrangian]` belongs on an `impl` block; ",
    );
    refused(args(), quote!(impl Drop for S {}), "`#[lagrangian]` belongs on an inherent `impl` block");
    refused(args(), quote!(impl S { fn new() -> S { S } }), "`S` has no function with a role; ");
    refused(args(), quote!(impl S), "unexpected end of input, expected curly braces");
    let mixed = quote! {
        #[kinetic] fn energy(&self, v: &Velocities) -> f64 { v.x * v.x }
        #[potential] fn height(&self, q: &Coordinates) -> f32 { q.x }
    };
    block(mixed, "the roles mix `f32` and `f64`; ");
}

#[test]
fn roles() {
    let energy = |role: TokenStream| quote!(#role fn energy(&self, q: &Coordinates) -> f64 { q.x });
    block(energy(quote!(#[potental])), "there is no role `potental`; did you mean `potential`?");
    block(energy(quote!(#[Potential])), "there is no role `Potential`; did you mean `potential`?");
    block(
        energy(quote!(#[unilateral(restitutoin = 0.5)])),
        "`unilateral` has no argument `restitutoin`; did",
    );
    block(energy(quote!(#[friction])), "nothing limits this friction; ");
    block(energy(quote!(#[friction(static_limit = 0.5)])), "nothing limits this friction; ");
    block(energy(quote!(#[friction(coefficient = 0.5)])), "a coefficient of friction needs the constraint");
    block(
        energy(quote!(#[friction(limit = 0.5, coefficient = 0.5)])),
        "a friction is limited by a reaction or by a given force; ",
    );
    block(
        energy(quote!(#[friction(coefficient = 0.5, normal = floor)])),
        "`floor` is no constraint with a reaction",
    );
    block(energy(quote!(#[potential] #[kinetic])), "this function has the role `potential` already; ");
    block(energy(quote!(#[potential(mass = 1.0)])), "`potential` takes no arguments; ");
    block(energy(quote!(#[potential = 1.0])), "`potential` takes no value; ");
    block(energy(quote!(#[point])), "`#[point]` needs `mass`; ");
    block(energy(quote!(#[point(mas = 1.0)])), "`point` has no argument `mas`; did you mean `mass`?");
    block(energy(quote!(#[point(inertia = 1.0)])), "`point` has no argument `inertia`; known are `mass`");
    block(energy(quote!(#[point(mass = 1.0, mass = 2.0)])), "`mass` is given twice; ");
    block(energy(quote!(#[point(mass 1.0)])), "cannot read the arguments of `point` (expected `=`); ");
    block(
        energy(quote!(#[force(at = x, on = x)])),
        "a force acts either `at` a point or `on` a coordinate; ",
    );
    block(energy(quote!(#[force(on = self.x)])), "`on` takes a name; ");
    block(energy(quote!(#[force(on = y)])), "there is no coordinate `y`; declared are `x`, `a`");
    block(energy(quote!(#[force(on = a[2])])), "the index 2 is out of range; valid are 0 to 1");
    block(energy(quote!(#[force(on = x[0])])), "`x` is no array; ");
    block(
        energy(quote!(#[force(at = energi)])),
        "there is no function `energi` for the force to act at; did",
    );
    block(energy(quote!(#[force(at = energy)])), "`energy` is no place; ");
    block(
        energy(quote!(#[force])),
        "`energy` must return one generalized force for each coordinate it acts on",
    );
    block(energy(quote!(#[body(mass = 1.0, inertia = 1.0)])), "`energy` must return a pose such as ");
}

#[test]
fn signatures() {
    block(
        quote!(
            #[cfg(test)]
            #[potential]
            fn f(&self, q: &Coordinates) -> f64 {
                q.x
            }
        ),
        "`f` has a role and cannot depend on `cfg`; ",
    );
    refused(
        quote!(coordinates = [x]),
        quote!(impl S { #[force] fn f(&self, u: &Inputs) -> f64 { 1.0 } }),
        "no inputs are declared; ",
    );
    block(
        quote!(
            #[potential]
            fn f(q: &Coordinates) -> f64 {
                q.x
            }
        ),
        "`f` has a role but no `&self`; ",
    );
    block(
        quote!(
            #[potential]
            fn f(&mut self, q: &Coordinates) -> f64 {
                q.x
            }
        ),
        "`f` has a role and must take `&self`; ",
    );
    block(
        quote!(
            #[potential]
            fn f<T>(&self, q: &Coordinates) -> f64 {
                q.x
            }
        ),
        "`f` has a role and cannot be generic; ",
    );
    block(
        quote!(
            #[potential]
            async fn f(&self, q: &Coordinates) -> f64 {
                q.x
            }
        ),
        "`f` has a role and cannot be `async`; ",
    );
    block(
        quote!(
            #[potential]
            fn f(&self, q: &Coordinates) {}
        ),
        "`f` returns nothing; let it return a scalar energy",
    );
    block(
        quote!(
            #[potential]
            fn f(&self, q: &Coordinates) -> bool {
                true
            }
        ),
        "`f` must return a scalar energy, not a `bool`",
    );
    block(
        quote!(
            #[potential]
            fn f(&self, q: &Coordinates) -> Energy {
                q.x
            }
        ),
        "`f` must return a scalar energy, not a type that",
    );
    block(
        quote!(
            #[potential]
            fn f(&self, q: &Coordinates, mass: f64) -> f64 {
                q.x
            }
        ),
        "a role takes no number but the time; rename `mass`",
    );
    block(
        quote!(
            #[potential]
            fn f(&self, q: &Coordinate) -> f64 {
                q.x
            }
        ),
        "a role takes no `Coordinate`; did you mean `Coordinates`?",
    );
    block(
        quote!(
            #[potential]
            fn f(&self, q: &[f64]) -> f64 {
                q[0]
            }
        ),
        "a role takes `q: &Coordinates`, `v: &Velocities`, ",
    );
    block(
        quote!(
            #[potential]
            fn f(&self, q: &Coordinates, p: &Coordinates) -> f64 {
                q.x
            }
        ),
        "this parameter is there already; ",
    );
    block(
        quote!(
            #[potential]
            fn f(&self, v: &Velocities) -> f64 {
                v.x
            }
        ),
        "a potential is a function of position and time; ",
    );
    block(
        quote!(
            #[point(mass = 1.0)]
            fn f(&self, v: &Velocities) -> f64 {
                v.x
            }
        ),
        "a position is a function of coordinates and time; ",
    );
    block(
        quote!(
            #[kinetic]
            fn f(&self, u: &Inputs) -> f64 {
                u.u
            }
        ),
        "an input acts through a force; ",
    );
}

#[test]
fn masses() {
    let point = |mass: TokenStream| {
        quote! {
            #[point(mass = #mass)] fn bob(&self, q: &Coordinates) -> f64 { q.x }
            fn at(&self, q: &Coordinates) -> f64 { q.x }
        }
    };
    block(point(quote!(q.x)), "`q` is not in sight here: ");
    block(point(quote!(self.m[..])), "several values of mass are given for one element; ");
    block(point(quote!([1.0, 2.0])), "several values of mass are given for one element; ");
    block(point(quote!(Vector2::zeros())), "a scalar is expected here, not a Vector2; ");
    block(
        quote!(
            #[point(mass = [1.0])]
            fn bob(&self, q: &Coordinates) -> [f64; 2] {
                q.a
            }
        ),
        "`mass` has 1 value for 2 elements; ",
    );
    let body = quote! {
        #[body(mass = 1.0, inertia = 2.0)]
        fn top(&self, q: &Coordinates) -> Isometry3<f64> { Isometry3::translation(q.x, 0.0, 0.0) }
    };
    block(body, "the inertia of a body in space is three principal moments or a `Matrix3`, not a scalar");
}

#[test]
fn forces() {
    let force = |attribute: TokenStream, output: TokenStream, value: TokenStream| {
        quote! {
            #[point(mass = 1.0)]
            fn bobs(&self, q: &Coordinates) -> [Vector2<f64>; 2] { [Vector2::new(q.x, 0.0); 2] }
            #attribute
            fn push(&self, u: &Inputs) -> #output { #value }
        }
    };
    let at = quote!(#[force(at = bobs[0])]);
    block(
        force(at.clone(), quote!(Vector3<f64>), quote!(Vector3::x())),
        "`push` must return a Cartesian force, `Vector2<f64>`, not a Vector3",
    );
    block(
        force(quote!(#[force(at = bobs)]), quote!(Vector2<f64>), quote!(Vector2::x())),
        "`push` must return an array of 2 forces, each ",
    );
    block(
        force(quote!(#[force(at = bobs[2])]), quote!(Vector2<f64>), quote!(Vector2::x())),
        "the index 2 is out of range; valid are 0 to 1",
    );
    block(
        force(quote!(#[force(on = x)]), quote!([f64; 2]), quote!([1.0; 2])),
        "`push` must return one generalized force, `f64`, not an array of 2",
    );
    block(
        force(at, quote!(Vector2<f64>), quote!(Vector2::new(u.w, 0.0))),
        "there is no input `w`; declared are `u`",
    );
}
