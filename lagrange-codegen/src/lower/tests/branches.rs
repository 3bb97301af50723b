//! Branches on the state: the same tokens are compiled by rustc and run by the interpreter, at many states.

use proc_macro2::TokenStream;
use quote::quote;

use super::{lowered, value_at};

/// Runs a function of three coordinates both ways at states on all sides of its branches.
macro_rules! same {
    (|$x:ident, $y:ident, $z:ident| $($body:tt)*) => {{
        #[allow(unused, clippy::all)]
        fn energy([$x, $y, $z]: [f64; 3]) -> f64 { $($body)* }
        let model = lowered(
            quote!(coordinates = [a: [3]]),
            quote! {
                impl System {
                    #[lagrangian]
                    fn energy(&self, q: &Coordinates) -> f64 { Self::of(q.a) }
                    fn of([$x, $y, $z]: [f64; 3]) -> f64 { $($body)* }
                }
            },
        );
        let model = model.unwrap_or_else(|messages| panic!("{messages:?}"));
        // Multiples of an eighth, so that some are equal and none is rounded.
        let mut random = 1_u64;
        let mut next = || {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (random >> 59) as f64 * 0.125 - 2.0
        };
        for _ in 0..400 {
            let q = [next(), next(), next()];
            let expected = energy(q);
            let found = value_at(&model, model.lagrangian[0].value, &q);
            let is_close = (found - expected).abs() <= 1e-12 * expected.abs().max(1.0);
            assert!(is_close, "{found} instead of {expected} at {q:?}");
        }
    }};
}

#[test]
fn sides_that_are_numbers_where_they_are_taken() {
    same!(|x, y, z| if x > 0.0 { x.sqrt() } else { (-y).exp() });
    same!(|x, y, z| if x > 0.0 { if y > 0.0 { (x * y).ln() } else { 1.0 / x } } else { z });
    same!(|x, y, z| if x > 0.0 && x.ln() < y { x.ln() * z } else { y });
    same!(|x, y, z| if x <= 0.0 || x.sqrt() > 1.0 || z / x > 1.0 { y } else { z / x.sqrt() });
    same!(|x, y, z| if !(x > 0.0) {
        0.0
    } else if x < 1.0 {
        x.acos()
    } else {
        (x * x - 1.0).sqrt()
    });
    same!(|x, y, z| let s = x * x + y * y; if s > 0.0 { z / s.sqrt() } else { y.atan2(x) });
    same!(|x, y, z| let mut s = 0.0; for a in [x, y, z] { if a > 0.0 { s += a.sqrt(); } else { s *= 2.0; } } s);
}

#[test]
fn second_conditions_assign_where_they_are_asked_for() {
    same!(|x, y, z| let mut n = z; if x > 0.0 && { n += 1.0; y > 0.0 } { n * 2.0 } else { n * y });
    same!(|x, y, z| let mut n = z; if x > 0.0 || { n += 1.0; y > 0.0 } { n * 2.0 } else { n * y });
    same!(|x, y, z| let mut n = z; if !(x > 0.0 && { n = x * y; y > n }) { n } else { n - 3.0 });
    same!(|x, y, z| let mut n = z;
        if (x > 0.0 && { n += x; y > n }) || { n -= y; n > 0.5 } { n } else { n * x });
    same!(|x, y, z| let mut n = 1.0; let mut hit = |a: f64| { n *= 2.0; a > 0.5 };
        let is_hit = hit(x) || hit(y) || hit(z); if is_hit { n } else { -n });
    same!(|x, y, z| let mut n = [z, y];
        let c = x < y && { n[0] = 2.0; if z < 0.0 { n[1] += x; } n[0] > n[1] };
        if c { n[0] } else { n[1] + n[0] });
    same!(|x, y, z| let mut s = 0.0;
        for a in [x, y, z] { if a > 0.0 && { s += a; s > 1.0 } { break; } s += 0.5; } s);
    same!(|x, y, z| let mut s = z;
        if x < 0.0 && { s += 1.0; if y < 0.0 { return s; } s < 1.0 } { return 5.0; } s);
}

#[test]
fn functions_return_early() {
    same!(|x, y, z| if x < 0.0 { return y; } x.sqrt() + z);
    same!(|x, y, z| if x < 0.0 {
        y
    } else {
        return z;
    });
    same!(|x, y, z| if x < 0.0 {
        return y;
    } else {
        return z;
    });
    same!(|x, y, z| if x <= 0.0 { return 0.0; } if x.ln() > y { return x.ln(); } (y - x.ln()).sqrt());
    same!(|x, y, z| if x < 0.0 { if y < 0.0 { return 1.0; } if z < 0.0 { return 2.0; } } x + y);
    same!(|x, y, z| if x < 0.0 { if y < 0.0 { return 1.0; } return 2.0; } x + y);
    same!(|x, y, z| let mut s = z; if x < 0.0 { s += 1.0; if y < 0.0 { return s; } s += x; } s * y);
    same!(|x, y, z| let r = if x < 0.0 { return z; } else if y < 0.0 { x } else { return 3.0; }; r * r);
    same!(|x, y, z| let f = |a: f64| { if a < 0.0 { return 0.0; } a.sqrt() }; f(x) + f(y) * f(z));
    same!(|x, y, z| if x < 0.0 && { if y < 0.0 { return z; } z < 1.0 } { return 5.0; } x);
}

#[test]
fn loops_end_early() {
    same!(|x, y, z| let mut s = 0.0; for a in [x, y, z] { if a < 0.0 { continue; } s += a.sqrt(); } s);
    same!(|x, y, z| let mut s = 0.0; for a in [x, y, z] { if a < 0.0 { break; } s += a.sqrt(); } s);
    same!(|x, y, z| let mut s = 0.0; for a in [x, y, z] { s += 1.0; if a < 0.0 { continue; } if a > 1.0 { break; } s *= a; } s);
    same!(|x, y, z| for (i, a) in [x, y, z].into_iter().enumerate() { if a < 0.0 { return i as f64; } } x);
    same!(|x, y, z| let mut s = z; for a in [x, y] { if a < 0.0 { continue; } if a > z { return a + s; } s += a; } s);
    same!(|x, y, z| let mut s = 0.0; for a in [x, y, z] { if a < 0.0 { s += 1.0; continue; } return s + a; } s);
    same!(|x, y, z| let mut s = 0.0; for a in [x, y, z] { if a < 0.0 { s += 1.0; continue; } break; } s);
    same!(|x, y, z| let mut s = 0.0; for a in [x, y, z] { if a < 0.0 { break; } return s + a; } s - 1.0);
    same!(|x, y, z| let mut s = 0.0;
        'outer: for i in 0..3 {
            for a in [x, y, z] {
                if a < -1.0 { continue 'outer; }
                if a > 1.0 { break 'outer; }
                if a > 0.5 { continue; }
                if a < -0.5 { break; }
                s += a * f64::from(i);
            }
            s += 10.0;
        }
        s);
}

/// The sizes of the graph of a body over 8 and over 16 coordinates.
fn sizes(body: &TokenStream) -> [usize; 2] {
    [8_usize, 16].map(|count| {
        let model = lowered(
            quote!(coordinates = [a: [#count]]),
            quote!(impl System { #[lagrangian] fn energy(&self, q: &Coordinates) -> f64 { #body } }),
        );
        model.unwrap_or_else(|messages| panic!("{messages:?}")).graph.size()
    })
}

#[test]
fn the_size_grows_with_the_number_of_turns() {
    for body in [
        quote!(let mut s = 0.0; for a in q.a { if a >= 0.0 { s += a.sqrt(); } } s),
        quote!(let mut s = 0.0; for a in q.a { if a < 0.0 { continue; } s += a.sqrt(); } s),
        quote!(let mut s = 0.0; for a in q.a { if a < 0.0 { s += 1.0; continue; } s += a.sqrt(); } s),
    ] {
        let [size, twice] = sizes(&body);
        assert!(twice < 3 * size, "{size}, {twice}: {body}");
    }
    // Each turn is guarded against all ways out before it.
    for body in [
        quote!(let mut s = 0.0; for a in q.a { if a < 0.0 { break; } s += a.sqrt(); } s),
        quote!(let mut s = 0.0; for a in q.a { if a < 0.0 { return s; } s += a.sqrt(); } s),
        quote!(let mut s = 0.0; for a in q.a { if a < 0.0 { continue; } if a > 1.0 { return s; } s += a; } s),
    ] {
        let [size, twice] = sizes(&body);
        assert!(twice < 5 * size, "{size}, {twice}: {body}");
    }
}
