//! Refusals of function bodies, each once, with the beginning of its message.

use proc_macro2::TokenStream;
use quote::quote;

use super::{lowered, refused};

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

#[test]
fn syntax() {
    body(quote!(while true {} q.x), "the macro cannot tell when this loop ends; ");
    body(quote!(loop {}), "the macro cannot tell when this loop ends; ");
    body(quote!(if let Some(x) = y { x } else { q.x }), "`if let` and `let … else` decide at run time; ");
    body(quote!(let Some(x) = y else { return 0.0 }; x), "`if let` and `let … else` decide at run time; ");
    body(
        quote!(let mut rest = q.theta.iter(); rest.by_ref().take(1).sum::<f64>()),
        "an iterator has no method `by_ref` that the macro knows; ",
    );
    body(quote!(f()?), "`?` cannot leave a role early; ");
    body(quote!(unsafe { 1.0 }), "an `unsafe` block cannot be turned into an equation; ");
    body(quote!(async { 1.0 }.await), "asynchronous code cannot be turned into an equation; ");
    body(quote!(debug_assert!(q.x > 0.0); q.x), "`debug_assert!` has no part in an equation; ");
    body(quote!("text"), "this literal is no number; ");
    body(quote!(Point { x: 1.0 }), "a struct cannot be built here; ");
    body(quote!(let f = move |x: f64| x; q.x), "a closure in a variable reads what is in sight ");
    body(quote!((0..3).map(q.x).sum()), "a closure is expected here; ");
    body(quote!((0..3).map(|a, b| q.x).sum()), "this closure is called with 1 argument but takes 2");
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
    body(quote!(x), "`x` is a coordinate; write `q.x`");
    body(quote!(q.x + u.x), "an input acts through a force; ");
    body(quote!(self.x), "`x` is a coordinate; write `q.x`");
    body(quote!(self.theta[1] * self.theta[1]), "`theta` is a coordinate; write `q.theta[1]`");
    body(quote!(cos(q.x)), "`cos` is a method of numbers; write `q.x.cos()`");
    body(quote!(atan2(q.x, v.x)), "`atan2` is a method of numbers; write `q.x.atan2(v.x)`");
    body(quote!(max(q.x, v.x)), "`max` is a method of numbers; write `q.x.max(v.x)`");
    body(quote!(floor(q.x)), "`floor` has no derivative everywhere; ");
    body(quote!(q.sin()), "`q` holds all coordinates; write the one that is meant, as in `q.x`");
    body(quote!(-v), "`v` holds all velocities; write the one that is meant, as in `v.x`");
    body(quote!(v.x = 1.0; v.x), "a description computes, it does not change `v`; ");
    body(quote!(y = q.x; y * y), "there is no variable `y` to assign to; ");
    body(quote!(q.x;), "the `;` throws away what `energy` should return; ");
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
    body(
        quote!(V::new(q.x, 0.0).x),
        "the macro does not know the type in `V::new`; give a type of nalgebra ",
    );
    body(
        quote!(Spring::force(q.x)),
        "only functions of this impl block can be inlined; move `Spring::force` ",
    );
    body(quote!(helper(q.x)), "`helper` is a function of this impl block; call it as ");
    body(quote!(self.spring.rate(q.x)), "`self.spring.rate(…)` cannot be seen by the macro; ");
    body(quote!(self.free(q.x)), "`free` does not take `self`; ");
    body(quote!(Self::helper(q.x)), "`helper` takes `self`; ");
    body(quote!(self.helper(q.x, 1.0)), "`helper` takes 1 argument, 2 are given");
    body(quote!(self.ping(q.x)), "these functions call each other: `ping` → `pong` → `ping`; ");
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
    body(
        quote!((Rotation3::identity() * Vector2::x()).x),
        "a rotation in space cannot be multiplied by a Vector2; ",
    );
    body(quote!((1.0 / Vector2::x()).x), "a scalar cannot be divided by a Vector2; ");
    body(
        quote!(if Vector2::x() == Vector2::y() { 1.0 } else { q.x }),
        "a Vector2 cannot be compared with a Vector2; ",
    );
    body(quote!(-true), "`-` cannot be applied to a `bool`; ");
    let taken_out = quote!(Rotation3::from_axis_angle(&Vector3::y_axis(), q.x).into_inner());
    let advised = "name its matrix, as in `rotation.matrix().";
    body(
        quote!(#taken_out.m31),
        &format!("a rotation in space counts as no matrix, also after `into_inner`; {advised}m31`"),
    );
    body(
        quote!(#taken_out.trace()),
        &format!("a rotation in space counts as no matrix, also after `into_inner`; {advised}trace()`"),
    );
    body(quote!((2.0 * #taken_out).m31), "a rotation in space counts as no matrix, also after ");
    body(quote!((#taken_out * 2.0).m31), "a rotation in space counts as no matrix, also after ");
    body(
        quote!((#taken_out + Matrix3::identity()).m31),
        "a rotation in space counts as no matrix, also after ",
    );
    body(
        quote!(Vector2::x().dot(&Vector3::x())),
        "`dot` needs equal lengths, but is called on a Vector2 with a Vector3",
    );
    body(quote!(Vector2::x().cross(&Vector2::x()).x), "`cross` does not exist for a Vector2; ");
    body(quote!(Vector2::from(q.x).x), "a Vector2 is expected here, not a scalar; ");
    body(quote!(Matrix2::from_element(true).m11), "a scalar is expected here, not a `bool`; ");
    body(quote!(Vector2::new(q.x).x), "`new` cannot be called with these arguments (a scalar); ");
    body(quote!(matrix![1.0, 2.0; 3.0].x), "the rows of this matrix differ in length; ");
    body(quote!(self.arm.norm()), "the shape of `self.arm` is not known to the macro; ");
    body(quote!((Matrix2::identity() * self.arm).x), "the shape of `self.arm` is not known to the macro; ");
    body(quote!(self * q.x), "`self` is no quantity; ");
    body(
        quote!((Rotation3::from_scaled_axis(Vector3::new(q.x, q.theta[0], 0.0)) * Vector3::x()).x),
        "the axis of this rotation vector moves, and a Taylor series of its rotation is not known near zero; ",
    );
    body(
        quote!((Rotation3::new(Vector3::new(q.x, t, 0.0)) * Vector3::x()).x),
        "the axis of this rotation vector moves, and a Taylor series of its rotation is not known near zero; ",
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
    body(quote!(q.x.clamp(2.0, 1.0)), "`clamp` panics where its first bound is larger than its second; ");
    body(quote!(q.x % 2.0), "`%` jumps, so it has no derivative; ");
    body(quote!(q.x.round()), "`round` has no derivative everywhere; use the unrounded value");
    body(quote!(q.x.powi(self.n)), "`powi` needs a constant integer between ");
    body(quote!(f64::from(q.x > 0.0)), "a condition known at run time does not convert to a number; write ");
    body(quote!((q.x > 0.0) as u8 as f64), "a condition known at run time does not convert to a number; ");
    body(
        quote!(if (q.x > 0.0) != (v.x > 0.0) { q.x } else { 0.0 }),
        "conditions known at run time cannot be compared; for `a != b` write `(a && !b) || (!a && b)`",
    );
    body(
        quote!(if (q.x > 0.0) == (v.x > 0.0) { q.x } else { 0.0 }),
        "conditions known at run time cannot be compared; for `a == b` write `(a && b) || (!a && !b)`",
    );
    body(quote!(if q.x == 0.0 { q.x } else { 0.0 }), "the branch depends on `q`: a Lagrangian is one ");
    body(
        quote!(match v.x * t > 0.0 {
            true => q.x,
            false => 0.0,
        }),
        "the branch depends on `v` and `t`: ",
    );
    body(
        quote!(if q.x > 0.0 { q.x } else { q.theta }),
        "the sides of this branch on the state are a scalar and ",
    );
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
    body(quote!(for i in 0..q.x {} q.x), "the bound of this range is a scalar, not a constant integer; ");
    body(quote!(for i in 0.. {} q.x), "this range has no end; ");
    body(
        quote!(for m in self.masses {} q.x),
        "the length of `self.masses` is not known to the macro; write `let masses: [f64; 3] = self.masses;`",
    );
    body(quote!(self.masses.iter().sum()), "the length of `self.masses` is not known to the macro; ");
    body(quote!(self.masses.len()), "the length of `self.masses` is not known to the macro; ");
    body(quote!(for m in q.x {} q.x), "cannot loop over a scalar; ");
    body(quote!(q.theta[3]), "the index 3 is out of range; valid are 0 to 2");
    body(quote!(self.m[0 - 1] * q.x), "the index -1 is negative; ");
    body(quote!(q.theta[2..5].iter().sum()), "this range does not lie within the array; it has 3 elements");
    body(quote!((2e38_f64 as u128) as f64 * q.x), "this integer is out of range; ");
    body(quote!((1e10_f64 as usize) as f64 * q.x), "this integer is out of range; ");
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
                #[kinetic] fn h(&self, v: &Velocities) -> f64 { let a = v.w; a * a + v.x.ceil() }
            }
        },
    );
    assert_eq!(messages.unwrap_err().len(), 6);
}
