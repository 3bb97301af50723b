//! Constants through functions that jump, and integers through casts: the same tokens are compiled by rustc
//! and run by the interpreter.

use proc_macro2::TokenStream;
use quote::quote;

use super::{lowered, refused, value_at};

/// The description of a potential q.x times a constant.
fn described(scalar: TokenStream, constant: TokenStream) -> TokenStream {
    quote! {
        impl System {
            const BIG: u64 = 123_456_789_012_345_678;
            #[lagrangian]
            fn energy(&self, q: &Coordinates<#scalar>) -> #scalar { (#constant) * q.x }
            fn beyond(n: i64) -> #scalar { n as #scalar - 9007199254740992.0 }
        }
    }
}

/// The constant in the graph.
fn folded(scalar: TokenStream, constant: TokenStream) -> f64 {
    let item = described(scalar, constant);
    let model = lowered(quote!(coordinates = [x]), item).unwrap_or_else(|messages| panic!("{messages:?}"));
    value_at(&model, model.lagrangian[0].value, &[1.0])
}

/// Compares constants of a scalar with what rustc makes of them, up to rounding errors of a size.
macro_rules! agree {
    ($scalar:ty, $size:expr, [$($constant:expr),+ $(,)?]) => {{
        struct System;
        #[allow(unused)]
        impl System {
            const BIG: u64 = 123_456_789_012_345_678;
            fn beyond(n: i64) -> $scalar { n as $scalar - 9007199254740992.0 }
            #[allow(clippy::all)]
            fn expected() -> Vec<f64> { vec![$({ let value: $scalar = $constant; f64::from(value) }),+] }
        }
        let found = [$(folded(quote!($scalar), quote!($constant))),+];
        let names = [$(stringify!($constant)),+];
        for ((found, expected), name) in found.into_iter().zip(System::expected()).zip(names) {
            assert!((found - expected).abs() <= $size, "{name}: {found} instead of {expected}");
        }
    }};
}

#[test]
fn casts_of_integers_round_as_rust_does() {
    agree!(
        f64,
        0.0,
        [
            (2_u64.pow(53) + 1) as f64 - 9007199254740992.0,
            (2_u64.pow(53) + 3) as f64 - 9007199254740992.0,
            -(9007199254740993_i64) as f64 + 9007199254740992.0,
            (-9007199254740995_i64) as f64 + 9007199254740992.0,
            123456789012345678_u64 as f64 - 123456789012345680.0,
            System::BIG as f64 - 123456789012345680.0,
            (System::BIG + 9) as f64 - 123456789012345680.0,
            (System::BIG - System::BIG / 3 * 3 + 1) as f64,
            System::beyond(9007199254740993),
            System::beyond(-9007199254740993) + 18014398509481984.0,
            f64::from(4294967295_u32) - 4294967000.0,
            f64::from(-2147483648_i32) + 2147483000.0,
            (9007199254740993_u64 as f64) as u64 as f64 - 9007199254740992.0,
            170141183460469231731687303715884105727_i128 as f64 / 170141183460469231731687303715884105728.0,
        ]
    );
    agree!(
        f32,
        0.0,
        [
            16777217_u32 as f32 - 16777216.0,
            16777219_u32 as f32 - 16777216.0,
            (-16777217_i32) as f32 + 16777216.0,
            (2_u64.pow(60) + 2_u64.pow(36) + 1) as f32 / 1152921504606846976.0 - 1.0,
            f32::from(65535_u16) - 65000.0,
            System::BIG as f32 / 1152921504606846976.0,
        ]
    );
}

#[test]
fn remainders_of_constants_are_those_of_rust() {
    // What Rust rounds is exact here, so a rounding error of the largest number remains.
    agree!(
        f64,
        4e-15,
        [
            7.5 % 2.0,
            -7.5 % 2.0,
            7.5 % -2.0,
            -7.5 % -2.0,
            0.3 % 0.1,
            1.0 % 0.1,
            6.0 % 3.0,
            9.81 % 1.0,
            0.1 * 3.0 % 0.1,
            5.0 % f64::INFINITY,
            0.0 % 3.0,
            2.0_f64.sqrt() % 1.0,
            1e6 % 0.125,
            0.75_f64.fract(),
            (-0.75_f64).fract(),
            9.81_f64.fract(),
            3.0_f64.fract(),
            f64::fract(2.5),
            7.5_f64.rem_euclid(2.0),
            (-7.5_f64).rem_euclid(2.0),
            7.5_f64.rem_euclid(-2.0),
            (-7.5_f64).rem_euclid(-2.0),
            (-0.3_f64).rem_euclid(0.1),
            (-1e-20_f64).rem_euclid(7.0),
            7.5_f64.div_euclid(2.0),
            (-7.5_f64).div_euclid(2.0),
            7.5_f64.div_euclid(-2.0),
            (-7.5_f64).div_euclid(-2.0),
            1.0_f64.div_euclid(0.1),
            (0.1_f64 * 3.0).div_euclid(0.3),
            3.0_f64.copysign(-1.0),
            (-3.0_f64).copysign(2.5),
            (-3.0_f64).copysign(-0.0),
            0.1_f64.copysign(-2.0),
            3.0_f64.signum(),
            (-0.5_f64).signum(),
            0.0_f64.signum(),
            (-0.0_f64).signum(),
            (0.3_f64 - 0.1 * 3.0).signum(),
            (0.1_f64 * 3.0 - 0.3).signum(),
            {
                let mut angle = 400.0;
                angle %= 360.0;
                angle
            },
            if 0.3 % 0.1 == 0.3 - 2.0 * 0.1 { 1.0 } else { 2.0 },
            if (0.1_f64 * 3.0).fract() > 0.3 { 1.0 } else { 2.0 },
            if (-7.5_f64).rem_euclid(2.0) == 0.5 { 1.0 } else { 2.0 },
        ]
    );
    agree!(
        f32,
        2e-6,
        [
            7.5 % 2.0,
            0.3 % 0.1,
            1.0 % 0.1,
            9.81_f32.fract(),
            (-0.3_f32).rem_euclid(0.1),
            1e6 % 0.125,
            7.5_f32.div_euclid(-2.0),
            1.0_f32.div_euclid(0.1),
            3.0_f32.copysign(-1.0),
            (0.3_f32 - 0.1 * 3.0).signum(),
            (0.7_f32 - 0.1 * 7.0).signum(),
        ]
    );
}

#[test]
fn exact_constants_stay_exact() {
    let exact = [(quote!(9.81_f64.fract()), 0.81), (quote!(0.3 % 0.1), 0.1), (quote!(1.0 % 0.1), 0.1)];
    for (constant, expected) in exact {
        assert_eq!(folded(quote!(f64), constant), expected);
    }
}

#[test]
fn what_rounding_decides_unseen_is_refused() {
    let about = |scalar, constant, start: &str| {
        refused(quote!(coordinates = [x]), described(scalar, constant), start);
    };
    about(quote!(f64), quote!(1.0_f64.sin() % 0.1), "`%` of this constant is not known to the macro, ");
    about(quote!(f64), quote!(2.0_f64.ln().floor()), "`floor` of this constant is not known to the macro, ");
    about(quote!(f64), quote!(1e300 % 7.0), "`%` of this constant is not known to the macro, ");
    about(quote!(f32), quote!(1e9 % 7.0), "`%` of this constant is not known to the macro, ");
    about(quote!(f64), quote!(f64::INFINITY.fract()), "`fract` of this constant is not known to the macro, ");
    about(quote!(f64), quote!(7.5 % 0.0), "this divides by zero; ");
    about(quote!(f64), quote!(7.5_f64.rem_euclid(0.1 + 0.2 - 0.3)), "this divides by zero; ");
    about(quote!(f64), quote!(7.5 % 2), "this is an integer where a number of the scalar type is needed; ");
    about(quote!(f64), quote!(q.x.rem_euclid(2.0)), "`rem_euclid` has no derivative everywhere; ");
    about(quote!(f64), quote!(2.0_f64.copysign(q.x)), "`copysign` has no derivative everywhere; ");
}

#[test]
fn a_generic_scalar_has_the_constants_that_both_precisions_agree_on() {
    let item = |constant: TokenStream| {
        quote!(impl<R: Real> S<R> {
            #[lagrangian]
            fn energy(&self, q: &Coordinates<R>) -> R { R::from_f64(#constant) * q.x }
        })
    };
    let agreed = [
        (quote!(9.81_f64.fract()), 0.81),
        (quote!(7.5 % 2.0), 1.5),
        (quote!((2_u64.pow(53) + 1) as f64 - 9007199254740992.0), 0.0),
    ];
    for (constant, expected) in agreed {
        let model = lowered(quote!(coordinates = [x]), item(constant));
        let model = model.unwrap_or_else(|messages| panic!("{messages:?}"));
        assert_eq!(value_at(&model, model.lagrangian[0].value, &[1.0]), expected);
    }
    let start = "`signum` of this constant is not known to the macro, ";
    let constant = quote!((0.7_f64 - 0.1 * 7.0).copysign(0.7 - 0.1 * 7.0));
    refused(quote!(coordinates = [x]), item(constant), &start.replace("signum", "copysign"));
}
