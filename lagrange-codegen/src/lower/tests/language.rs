//! The language itself: the same tokens are compiled by rustc and run by the interpreter.

use quote::quote;

use super::{lowered, value};

/// Runs a body both ways and compares the values, up to the rounding of reordered sums.
/// The names of the parameters come from outside because of the macro's hygiene.
macro_rules! agrees {
    (|$this:ident, $q:ident, $v:ident, $t:ident| $($body:tt)*) => {{
        struct System { m: [f64; 3], k: f64, pair: (f64, [f64; 2]) }
        struct Coordinates { x: f64, y: f64, a: [f64; 3] }
        struct Velocities { x: f64, a: [f64; 3] }
        #[allow(unused, clippy::all)]
        impl System {
            const N: usize = 3;
            const SHIFT: f64 = 0.25;
            fn energy(&$this, $q: &Coordinates, $v: &Velocities, $t: f64) -> f64 { $($body)* }
            fn weighted(&self, w: [f64; 3], f: f64) -> f64 { f * (w[0] + 2.0 * w[1] + 3.0 * w[2]) }
            fn swap(pair: (f64, f64)) -> (f64, f64) { let (a, b) = pair; (b, a) }
            fn early(&self, i: usize, x: f64) -> f64 { if i == 0 { return x; } x * x }
            fn scaled<const M: usize, const K: usize>(w: [[f64; K]; M], by: &[f64; K]) -> [f64; M] { w.map(|row| { let mut sum = M as f64; for i in 0..K { sum += row[i] * by[i]; } sum }) }
        }
        let system = System { m: [2.0, 3.0, 5.0], k: 7.0, pair: (11.0, [13.0, 17.0]) };
        let q = Coordinates { x: 0.3, y: 0.7, a: [1.1, 1.5, 1.9] };
        let v = Velocities { x: -0.4, a: [0.6, 1.1, 1.6] };
        let expected = system.energy(&q, &v, 0.9);
        let _ = (v.x, v.a, q.x, q.y, q.a, system.m, system.k, system.pair, System::SHIFT, System::N);
        let model = lowered(
            quote!(coordinates = [x, y, a: [3]]),
            quote! {
                impl System {
                    const N: usize = 3;
                    const SHIFT: f64 = 0.25;
                    #[lagrangian]
                    fn energy(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 { $($body)* }
                    fn weighted(&self, w: [f64; 3], f: f64) -> f64 { f * (w[0] + 2.0 * w[1] + 3.0 * w[2]) }
                    fn swap(pair: (f64, f64)) -> (f64, f64) { let (a, b) = pair; (b, a) }
                    fn early(&self, i: usize, x: f64) -> f64 { if i == 0 { return x; } x * x }
                    fn scaled<const M: usize, const K: usize>(w: [[f64; K]; M], by: &[f64; K]) -> [f64; M] { w.map(|row| { let mut sum = M as f64; for i in 0..K { sum += row[i] * by[i]; } sum }) }
                }
            },
        );
        let model = model.unwrap_or_else(|messages| panic!("{messages:?}"));
        let found = value(&model, model.lagrangian[0].value, |path| match path {
            "self.m[0]" => 2.0,
            "self.m[1]" => 3.0,
            "self.m[2]" => 5.0,
            "self.k" => 7.0,
            "self.pair.0" => 11.0,
            "self.pair.1[0]" => 13.0,
            "self.pair.1[1]" => 17.0,
            other => panic!("the parameter {other}"),
        });
        assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} instead of {expected}");
    }};
}

#[test]
fn arithmetic() {
    agrees!(|self, q, v, t| q.x + 2.0 * q.y - -q.x / 3.0 * (q.y - 1.5));
    agrees!(|self, q, v, t| let z = &q.x; -(*z) + (q.y as f64) * f64::from(2) + 3 as f64);
    agrees!(|self, q, v, t| self.k * q.x + self.pair.0 * self.pair.1[1] - self.pair.1[0] + Self::SHIFT);
    agrees!(|self, q, v, t| 1e-3 * q.x + 1_000.5 * q.y + 2f64);
}

#[test]
fn functions_of_numbers() {
    agrees!(|self, q, v, t| q.x.sin() + q.y.cos() * q.x.tan() + q.x.asin() + q.y.acos() + q.a[0].atan());
    agrees!(|self, q, v, t| q.x.sinh()
        + q.y.cosh() * q.x.tanh()
        + q.x.asinh()
        + q.a[0].acosh()
        + q.x.atanh());
    agrees!(|self, q, v, t| q.x.exp()
        + q.y.exp_m1()
        + q.x.ln()
        + q.y.ln_1p()
        + q.x.log10()
        + q.x.log2()
        + q.x.log(3.0));
    agrees!(|self, q, v, t| q.x.sqrt()
        + q.y.powi(3)
        + q.y.powi(-2)
        + q.x.powf(1.5)
        + q.x.powf(q.y)
        + q.x.exp2());
    agrees!(|self, q, v, t| q.x.hypot(q.y)
        + q.x.recip()
        + q.x.cbrt()
        + (q.x - q.y).abs()
        + (q.x - q.y).signum());
    agrees!(|self, q, v, t| q.x.atan2(q.y) + q.x.mul_add(q.y, 2.0) + q.x.to_radians() + q.x.to_degrees());
    agrees!(|self, q, v, t| let (s, c) = q.x.sin_cos(); s * 2.0 + c);
    agrees!(|self, q, v, t| f64::sin(q.x) + f64::powi(q.y, 2) + f64::sqrt(q.x) + f64::hypot(3.0, q.x));
    agrees!(|self, q, v, t| std::f64::consts::PI * q.x
        + core::f64::consts::FRAC_PI_2
        + std::f64::consts::SQRT_2);
}

#[test]
fn bindings_and_blocks() {
    agrees!(|self, q, v, t| let a = q.x; let a = a * 2.0; { let a = 5.0; let _ = a; } a);
    agrees!(|self, q, v, t| let mut s = 0.0; s += q.x; s *= 3.0; s -= 1.0; s /= q.y; s);
    agrees!(|self, q, v, t| let (a, [b, c]) = (q.x, [q.y, 3.0]); a * b - c);
    agrees!(|self, q, v, t| let [first, .., last] = q.a; first * last);
    agrees!(|self, q, v, t| let (a, ..) = (q.x, 1.0, 2.0); a);
    agrees!(|self, q, v, t| let Coordinates { x, a: [b, ..], .. } = q; x * b);
    agrees!(|self, q, v, t| let z; z = q.x; z);
    agrees!(|self, q, v, t| let m: [f64; 3] = self.m; m.iter().map(|m| m * q.x).sum());
    agrees!(|self, q, v, t| let [a, b, c] = self.m; a * b - c * q.x);
    agrees!(|self, q, v, t| const FACTOR: f64 = 2.0 * 3.0; use std::f64::consts::{PI, TAU as TURN}; FACTOR * q.x + PI - TURN);
    agrees!(|self, q, v, t| let value = { let inner = q.x * 2.0; inner + 1.0 }; return value * 2.0;);
    agrees!(|self, q, v, t| let mut w = [q.x; 3]; w[1] = q.y; w[2] += 1.0; w[0] *= w[1]; w[0] + w[1] * w[2]);
    agrees!(|self, q, v, t| let mut w = [[q.x; 2]; 2]; w[1][0] = q.y; w[0][0] + 2.0 * w[1][0] + w[1][1]);
    agrees!(|self, q, v, t| let mut w = (q.x, 1.0); w.1 = q.y; w.0 += 2.0; w.0 * w.1);
    agrees!(|self, q, v, t| let (mut a, mut b) = (q.x, q.y); (a, b) = (b, a * b); a * a + b);
    agrees!(|self, q, v, t| let mut w = [0.0; 2]; let a; ([w[1], a], _) = ([q.x, q.y], 1.0); a + 2.0 * w[1]);
}

#[test]
fn loops_and_branches() {
    agrees!(|self, q, v, t| let mut s = 0.0; for i in 0..Self::N { s += q.a[i] * (i as f64 + 1.0); } s);
    agrees!(|self, q, v, t| let mut s = 0.0; for i in (1..=2).rev() { s = s * 2.0 + q.a[i] - q.a[i - 1]; } s);
    agrees!(|self, q, v, t| let mut s = 0.0; for (i, a) in q.a.iter().enumerate() { s += a * (2 * i + 1) as f64; } s);
    agrees!(|self, q, v, t| let mut s = 0.0; for i in (0..10).step_by(4) { s += q.a[i % 3] * (i / 3) as f64; } s);
    agrees!(|self, q, v, t| let mut s = q.x; for i in 0..5 { if i == 1 { continue; } if i > 3 { break; } s = s * q.a[i % 3]; } s);
    agrees!(|self, q, v, t| let mut s = 0.0;
        'outer: for i in 0..3 { for j in 0..3 { if j > i { continue 'outer; } if i == 2 { break 'outer; } s += q.a[j]; } }
        s);
    agrees!(|self, q, v, t| let mut s = 0.0; for i in 0..3 { s += if i < 1 && i != 5 || false { q.x } else if i == 1 { q.y } else { 1.0 }; } s);
    agrees!(|self, q, v, t| let mut s = 0.0; for i in 0..4 { s += match i { 0 => q.x, 1 | 2 => q.y, n if n > 100 => 1.0, _ => 2.0 * q.x }; } s);
    agrees!(|self, q, v, t| let mut s = 0.0; for i in 0..6_usize { s += match (i, i % 2) { (0..=2, 0) => q.x, (Self::N, _) => q.y, _ => 1.0 }; } s);
    agrees!(|self, q, v, t| if Self::SHIFT > 0.2 { q.x } else { q.y });
    agrees!(|self, q, v, t| let mut s = 0.0; for (a, m) in q.a.iter().zip(self.m.iter()) { s += a * m; } s);
    agrees!(|self, q, v, t| let mut s = 0.0; for window in q.a.windows(2) { s += window[0] * window[1]; } s);
    agrees!(|self, q, v, t| let n = 2_usize.pow(2).clamp(1, 3); let mut s = 0.0; for i in 0..n.min(2) { s += q.a[i]; } s);
}

#[test]
fn iterators() {
    agrees!(|self, q, v, t| q.a.iter().map(|a| a * a).sum::<f64>() + q.a.iter().copied().product::<f64>());
    agrees!(|self, q, v, t| q
        .a
        .iter()
        .skip(1)
        .chain(q.a.iter().take(1))
        .enumerate()
        .map(|(i, a)| a * i as f64)
        .sum());
    agrees!(|self, q, v, t| q.a.iter().zip(v.a.iter()).map(|(a, v)| a * v).sum());
    agrees!(|self, q, v, t| q.a.iter().rev().fold(q.x, |total, a| total * 0.5 + a));
    agrees!(|self, q, v, t| (0..3).filter(|i| i % 2 == 0).map(|i| q.a[i]).sum());
    agrees!(|self, q, v, t| (0..2)
        .flat_map(|i| (0..=i).map(move |j| (i, j)))
        .map(|(i, j)| q.a[i] * q.a[j])
        .sum());
    agrees!(|self, q, v, t| let squares = q.a.map(|a| a * a); squares[0] + squares[2]);
    agrees!(|self, q, v, t| let w: [f64; 3] = core::array::from_fn(|i| q.a[i] * i as f64); w[1] + w[2]);
    agrees!(|self, q, v, t| self.weighted(std::array::from_fn(|i| q.a[i]), 2.0));
    agrees!(|self, q, v, t| q.a.iter().copied().map(f64::sin).sum());
    agrees!(|self, q, v, t| q.a[1..].iter().sum::<f64>() + q.a.len() as f64);
    agrees!(|self, q, v, t| [[q.x, q.y], [1.0, 2.0]].iter().flatten().sum());
    agrees!(|self, q, v, t| (1..).zip(q.a).map(|(i, a)| f64::from(i) * a).sum());
}

#[test]
fn helpers() {
    agrees!(|self, q, v, t| self.weighted(q.a, q.x)
        + Self::weighted(self, [1.0, q.x, q.y], 2.0)
        + self.weighted(self.m, 1.0));
    agrees!(|self, q, v, t| let (a, b) = Self::swap((q.x, q.y)); a - b);
    agrees!(|self, q, v, t| self.early(0, q.x) + self.early(1, q.x) * t + v.x);
    agrees!(|self, q, v, t| q.a.iter().enumerate().map(|(i, &a)| self.early(i, a)).sum());
    agrees!(
        |self, q, v, t| Self::scaled([q.a, [q.x; 3]], &[1.0, 2.0, q.y])[1] + Self::scaled([[q.x]], &[q.y])[0]
    );
    agrees!(|self, q, v, t| let f: fn(f64) -> f64 = f64::cos; let g = Self::swap; f(q.x) + g((q.x, q.y)).0 + q.a.map(f)[1]);
}

#[test]
fn foreign_constants_become_parameters() {
    let model = lowered(
        quote!(coordinates = [x]),
        quote! {
            impl S {
                #[potential]
                fn energy(&self, q: &Coordinates) -> f64 {
                    (G + crate::GRAVITY + Self::ELSEWHERE + self.count as f64 + f64::from(self.n)) * q.x
                }
            }
        },
    );
    let model = model.unwrap();
    let paths: Vec<&str> = model.parameters.iter().map(|parameter| &*parameter.path).collect();
    let expected = ["G", "crate::GRAVITY", "Self::ELSEWHERE", "(self.count as f64)", "f64::from(self.n)"];
    assert_eq!(paths, expected);
    assert_eq!(model.parameters[1].label, "gravity");
}

#[test]
fn generic_constants_are_converted() {
    let model = lowered(
        quote!(coordinates = [x]),
        quote! {
            impl<R: Real> S<R> {
                const K: f64 = 3.0;
                #[potential]
                fn energy(&self, q: &Coordinates<R>) -> R {
                    R::from_f64(Self::K) * R::pi() * R::from_f64(crate::G) * Real::sin(q.x) + R::one()
                }
            }
        },
    );
    let model = model.unwrap();
    assert_eq!(model.parameters[0].path, "<R as ::lagrange_runtime::Real>::from_f64(crate::G)");
    let expected = 3.0 * std::f64::consts::PI * 2.0 * 0.3_f64.sin() + 1.0;
    assert!((value(&model, model.potential[0].value, |_| 2.0) - expected).abs() < 1e-12);
}

#[test]
fn names_of_the_user_become_hints() {
    let model = lowered(
        quote!(coordinates = [x]),
        quote! {
            impl S {
                #[potential]
                fn energy(&self, q: &Coordinates) -> f64 {
                    let height = q.x.sin();
                    let tip = Vector2::new(q.x, q.x.cos());
                    height * tip.y
                }
            }
        },
    );
    let model = model.unwrap();
    let energy = model.potential[0].value;
    assert_eq!(model.hints.name(energy), Some("energy"));
    let mut names = Vec::new();
    for node in model.graph.cone([energy]) {
        names.extend(model.hints.name(node).map(String::from));
        assert!(model.origins.contains(&node));
    }
    assert_eq!(names, ["height", "tip_y", "energy"]);
}

#[test]
fn constants_are_those_of_rust() {
    agrees!(|self, q, v, t| (300_i32 as u8) as f64 * q.x + (-1_i32 as u32) as f64 + (200_i32 as i8) as f64);
    agrees!(|self, q, v, t| (2.6 as i32) as f64 * q.x
        + (-2.6 as i32) as f64
        + (-2.6 as u8) as f64
        + (1e9 as i16) as f64);
    agrees!(|self, q, v, t| (true as i32) as f64 * q.x + (7 / 2 % 2) as f64 + (-7 / 2) as f64);
    agrees!(|self, q, v, t| if 0.1 + 0.2 == 0.3 { q.x } else { q.y });
    agrees!(|self, q, v, t| if (1e20 + 1.0) - 1e20 > 0.5 { q.x } else { q.y });
    agrees!(|self, q, v, t| let k = 0.1 * 3.0; if k <= 0.3 { q.x } else { q.y });
    agrees!(|self, q, v, t| if 2.0_f64.sqrt() * 2.0_f64.sqrt() == 2.0 { q.x } else { q.y });
    agrees!(|self, q, v, t| if ((0.1 + 0.7) * 10.0) as i32 == 8 { q.x } else { q.y });
    agrees!(|self, q, v, t| static G: f64 = 3.0; const N: u8 = 2; match 2 { N => G * q.x, _ => q.y });
    agrees!(|self, q, v, t| {
        #![allow(unused_imports)]
        use std::f64::consts;
        consts::PI * q.x
    });
    agrees!(|self, q, v, t| let n = 3; match n { k if k > 2 => k as f64 * q.x, _ => q.y });
}
