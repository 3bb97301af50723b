//! Every refusal of the front end, once, with the beginning of its message.

use proc_macro2::TokenStream;
use quote::quote;

use super::lowered;

/// The one message about a description starts as given.
fn refused(args: TokenStream, item: TokenStream, start: &str) {
    let messages = match lowered(args, item.clone()) {
        Ok(_) => panic!("accepted: {item}"),
        Err(messages) => messages,
    };
    assert!(
        messages.len() == 1 && messages[0].starts_with(start),
        "{item}\n{messages:#?}\ninstead of {start}"
    );
}

/// The one message about the body of a `#[lagrangian]` function.
fn body(body: TokenStream, start: &str) {
    let item = quote! {
        impl System {
            const N: usize = 3;
            #[lagrangian]
            fn energy(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 { #body }
            fn helper(&self, x: f64) -> f64 { 2.0 * x }
            fn free(x: f64) -> f64 { x }
            fn ping(&self, x: f64) -> f64 { self.pong(x) }
            fn pong(&self, x: f64) -> f64 { self.ping(x) }
            fn flat(&self, v: Vector2<f64>) -> f64 { v.x }
        }
    };
    refused(quote!(coordinates = [x, theta: [3]]), item, start);
}

/// The one message about an impl block with these items and the coordinate x.
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
    block(energy(quote!(#[holonomic])), "the role `holonomic` is not supported yet; ");
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
    block(energy(quote!(#[force(on = self.x)])), "`on` names one place; ");
    block(energy(quote!(#[force(on = y)])), "there is no coordinate `y`; declared are `x`, `a`");
    block(energy(quote!(#[force(on = a[2])])), "the index 2 is out of range; there are 2");
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
        "1 values of mass are given for 2 elements; ",
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
        "the index 2 is out of range; there are 2",
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

#[test]
fn syntax() {
    body(quote!(while true {} q.x), "the macro cannot tell when this loop ends; ");
    body(quote!(loop {}), "the macro cannot tell when this loop ends; ");
    body(quote!(if let Some(x) = y { x } else { q.x }), "`if let` and `let … else` decide at run time; ");
    body(quote!(let Some(x) = y else { return 0.0 }; x), "`if let` and `let … else` decide at run time; ");
    body(quote!(f()?), "`?` cannot leave a role early; ");
    body(quote!(unsafe { 1.0 }), "an `unsafe` block cannot be turned into an equation; ");
    body(quote!(async { 1.0 }.await), "asynchronous code cannot be turned into an equation; ");
    body(quote!(debug_assert!(q.x > 0.0); q.x), "`debug_assert!` cannot be turned into an equation; ");
    body(quote!("text"), "this literal is no number; ");
    body(quote!(Point { x: 1.0 }), "a struct cannot be built here; ");
    body(quote!(let f = |x: f64| x; q.x), "a closure can only be an argument, ");
    body(quote!((0..3).map(q.x).sum()), "a closure is expected here; ");
    body(quote!((0..3).map(|a, b| q.x).sum()), "this closure is called with 1 arguments but takes 2");
    body(quote!(self.table[0](q.x)), "only functions can be called; ");
    body(quote!(let x = &mut q; 1.0), "`&mut` cannot be followed here; ");
    body(quote!(for i in 0..3 { break 1.0; } q.x), "a loop has no value here; ");
    body(quote!(1.0_f32 * q.x), "the suffix `f32` does not fit the scalar `f64`; write `1.0`");
    body(quote!(let x @ y = q.x; x), "this pattern is not supported; ");
    body(quote!(let 1 = 2; q.x), "this pattern does not match every value; ");
    body(
        quote!(let mut s = q.x; for i in 0..2000 { for j in 0..2000 { s = q.x; } } s),
        "this description takes more than 1000000 steps",
    );
}

#[test]
fn names() {
    body(quote!(let end = q.x; edn), "there is no variable `edn` here; did you mean `end`?");
    body(quote!(thing::other), "`thing::other` is neither a constant nor a function that the macro knows; ");
    body(quote!(q.thta[0]), "there is no coordinate `thta`; did you mean `theta`?");
    body(quote!(v.y), "there is no coordinate `y`; declared are `x`, `theta`");
    body(quote!(Vector2::x().z), "a Vector2 has no field `z`; ");
    body(quote!(q.x.sine()), "a scalar has no method `sine` that the macro knows; did you mean `sin`?");
    body(
        quote!(Vector2::x().nrom()),
        "a Vector2 has no method `nrom` that the macro knows; did you mean `norm`?",
    );
    body(
        quote!(Vector2::zeroes()),
        "there is no function `zeroes` that the macro knows; did you mean `zeros`?",
    );
    body(quote!(self.helpr(q.x)), "there is no function `helpr` in this impl block; did you mean `helper`?");
    body(quote!(foo(q.x)), "only functions of this impl block can be inlined; move `foo` in ");
    body(quote!(helper(q.x)), "`helper` is a function of this impl block; call it as ");
    body(quote!(self.spring.rate(q.x)), "`self.spring.rate(…)` cannot be seen by the macro; ");
    body(quote!(self.free(q.x)), "`free` does not take `self`; ");
    body(quote!(Self::helper(q.x)), "`helper` takes `self`; ");
    body(quote!(self.helper(q.x, 1.0)), "`helper` takes 1 arguments, 2 are given");
    body(quote!(self.ping(q.x)), "these functions call each other without end: `ping` → `pong` → `ping`; ");
    body(quote!(y = q.x; q.x), "there is no variable `y` to assign to; ");
    body(quote!(self.m = q.x; q.x), "parameters cannot be changed; ");
    body(quote!(q.x.sin() += 1.0; q.x), "cannot assign here; ");
}

#[test]
fn shapes() {
    body(quote!(Vector2::x()), "a scalar is expected here, not a Vector2; ");
    body(quote!((Vector2::x() + Vector3::x()).x), "a Vector3 cannot be added to a Vector2; ");
    body(quote!((Vector2::x() - Vector3::x()).x), "a Vector3 cannot be subtracted from a Vector2; ");
    body(quote!((Vector2::x() * Vector2::x()).x), "a Vector2 cannot be multiplied by a Vector2; ");
    body(quote!((Matrix3::identity() * Vector2::x()).x), "a Matrix3 cannot be multiplied by a Vector2; ");
    body(quote!((Rotation3::identity() * Vector2::x()).x), "a Rotation3 cannot be multiplied by a Vector2; ");
    body(quote!((1.0 / Vector2::x()).x), "a scalar cannot be divided by a Vector2; ");
    body(quote!(if Vector2::x() == Vector2::y() { 1.0 } else { q.x }), "a Vector2 cannot be compared with a Vector2; ");
    body(quote!(-true), "`-` cannot be applied to a `bool`; ");
    body(
        quote!(Vector2::x().dot(&Vector3::x())),
        "`dot` needs equal lengths, but is called on a Vector2 with a Vector3",
    );
    body(quote!(Vector2::x().cross(&Vector2::x()).x), "`cross` does not exist for a Vector2; ");
    body(quote!(Vector2::new(q.x).x), "`new` cannot be called with these arguments (a scalar); ");
    body(quote!(matrix![1.0, 2.0; 3.0].x), "the rows of this matrix differ in length; ");
    body(quote!(self.arm.norm()), "the shape of `self.arm` is not known to the macro; ");
    body(quote!((Matrix2::identity() * self.arm).x), "the shape of `self.arm` is not known to the macro; ");
    body(quote!(self * q.x), "`self` is no quantity; ");
    body(
        quote!((Rotation3::from_axis_angle(&Vector3::new(q.x, q.x, 0.0), 1.0) * Vector3::x()).x),
        "the axis of this rotation moves; ",
    );
    body(
        quote!((Rotation3::new(Vector3::new(q.x, t, 0.0)) * Vector3::x()).x),
        "the axis of this rotation moves; ",
    );
    body(quote!(let (a, b) = q.x; a), "this pattern does not fit a scalar; ");
    body(quote!(let [a, b] = q.theta; a), "this pattern has 2 names for 3 elements; ");
    body(
        quote!(let w = core::array::from_fn(|i| q.x); w[0]),
        "the length of this array is not known to the macro; ",
    );
    body(quote!(q.x as usize as f64), "a scalar cannot be cast like this; ");
    body(quote!(q.x[0]), "a scalar cannot be indexed like this; ");
    body(
        quote!(let mut p = Vector2::zeros(); p.x = Vector2::x(); p.x),
        "a scalar is expected here, not a Vector2; ",
    );
    body(quote!(q.theta.iter().step_by(0).sum()), "`step_by` cannot be called with these arguments; ");
}

#[test]
fn constants_and_branches() {
    body(quote!(2 * q.x), "this is an integer where a number of the scalar type is needed; write `2.0`");
    body(quote!(q.x.powf(2)), "this is an integer where a number of the scalar type is needed; write `2.0`");
    body(quote!(q.theta[q.x]), "a constant integer is needed here, not a scalar");
    body(quote!(q.theta[self.i]), "the value of `self.i` is not known to the macro; ");
    body(quote!(q.theta[1 / 0]), "this divides an integer by zero; ");
    body(quote!(q.theta[170141183460469231731687303715884105727 + 1]), "this integer is out of range; ");
    body(quote!(q.x / 0.0), "this divides by zero; ");
    body(quote!(q.x % 2.0), "`%` jumps, so it has no derivative; ");
    body(
        quote!(q.x.max(0.0)),
        "`max` has no derivative everywhere; describe the limit by a smooth potential",
    );
    body(quote!(q.x.powi(self.n)), "`powi` needs a constant integer between ");
    body(
        quote!(if q.x > 0.0 { q.x } else { 0.0 }),
        "the branch depends on `q`: a Lagrangian must be one smooth expression; ",
    );
    body(quote!(if v.x * t > 0.0 { q.x } else { 0.0 }), "the branch depends on `v` and `t`: ");
    body(quote!(if self.flag { q.x } else { 0.0 }), "the branch depends on the parameter `self.flag`: ");
    body(
        quote!(match self.kind {
            0 => q.x,
            _ => 0.0,
        }),
        "the branch depends on the parameter `self.kind`: ",
    );
    body(
        quote!(match 3 {
            0 => q.x,
            1 => 0.0,
        }),
        "no arm matches this constant; ",
    );
    body(quote!(for i in 0..self.n {} q.x), "the bound `self.n` is not known to the macro; ");
    body(quote!(for i in 0..N {} q.x), "the bound `N` is not known to the macro; ");
    body(quote!(for i in 0..q.x {} q.x), "the bound of this loop is a scalar, not a constant integer; ");
    body(quote!(for i in 0.. {} q.x), "this range has no end; ");
    body(
        quote!(for m in self.masses {} q.x),
        "the length of `self.masses` is not known to the macro; write `let masses: [f64; 3] = self.masses;`",
    );
    body(quote!(self.masses.iter().sum()), "the length of `self.masses` is not known to the macro; ");
    body(quote!(self.masses.len() as f64), "the length of `self.masses` is not known to the macro; ");
    body(quote!(for m in q.x {} q.x), "cannot loop over a scalar; ");
    body(quote!(q.theta[3]), "the index 3 is out of range; there are 3");
    body(quote!(self.m[0 - 1] * q.x), "the index -1 is negative; ");
    body(quote!(q.theta[2..5].iter().sum()), "this range does not lie within the array; it has 3 elements");
}

#[test]
fn conversions_in_generic_blocks() {
    let item = |body: TokenStream| quote!(impl<R: Real> S<R> { #[potential] fn f(&self, q: &Coordinates<R>) -> R { #body } });
    let args = || quote!(coordinates = [x]);
    refused(args(), item(quote!(R::from_f64(q.x))), "`from_f64` converts constants only; ");
    refused(args(), item(quote!(R::from_f64(2.0 * crate::G))), "`from_f64` converts one constant or field; ");
}

#[test]
fn all_mistakes_are_reported_at_once() {
    let messages = lowered(
        quote!(coordinates = [x]),
        quote! {
            impl S {
                #[potential] fn f(&self, q: &Coordinates) -> f64 { q.y + q.z * foo(q.x) }
                #[potental] fn g(&self, q: &Coordinates) -> f64 { q.x }
                #[kinetic] fn h(&self, v: &Velocities) -> f64 { let a = v.w; a * a + v.x.max(0.0) }
            }
        },
    );
    assert_eq!(messages.unwrap_err().len(), 6);
}
