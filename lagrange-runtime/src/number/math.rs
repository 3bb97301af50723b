//! The elementary functions of `f32` and `f64`, from one of two backends.
//!
//! Feature `libm` wins over `std`, because its results are the same bits on every target; `std` calls the
//! platform's library. Each function is a plain wrapper without any correction of its own; [`single`] has
//! those of `f32` that the `libm` crate computes in double precision, and [`threads`] those of graphics
//! processors.

#[cfg(any(feature = "libm", test))]
mod single;

#[cfg(any(all(feature = "libm", target_arch = "nvptx64"), test))]
mod uniform;

/// The functions of `f64` for graphics processors, with the bits of the `libm` crate.
#[cfg(all(feature = "libm", target_arch = "nvptx64"))]
mod threads {
    pub(crate) use super::uniform::sin_cos as sincos;
    /// A processor has an instruction for the root, which rounds correctly as `libm` does.
    pub(crate) use core::f64::math::sqrt;
    pub(crate) use libm::{
        acos, acosh, asin, asinh, atan, atan2, atanh, cbrt, cosh, exp, expm1, hypot, log, log1p, pow, sinh,
        tan, tanh,
    };

    #[inline]
    pub(crate) fn sin(x: f64) -> f64 {
        sincos(x).0
    }

    #[inline]
    pub(crate) fn cos(x: f64) -> f64 {
        sincos(x).1
    }
}

#[cfg(all(feature = "libm", not(target_arch = "nvptx64")))]
use libm as doubles;
#[cfg(all(feature = "libm", target_arch = "nvptx64"))]
use threads as doubles;

/// One wrapper per function: `name(arguments) = libm function`, or the method of the standard library.
macro_rules! backend {
    ($scalar:ident from $($library:ident)::+: $($name:ident($($arg:ident),+) -> $out:ty = $libm:ident;)*) => {
        pub(crate) mod $scalar {
            #[cfg(feature = "libm")]
            use $($library)::+ as functions;
            $(
                #[cfg_attr(not(all(feature = "libm", target_os = "none")), inline)]
                #[cfg_attr(all(feature = "libm", target_os = "none"), inline(never))]
                pub(crate) fn $name($($arg: $scalar),+) -> $out {
                    #[cfg(feature = "libm")]
                    return functions::$libm($($arg),+);
                    #[cfg(all(feature = "std", not(feature = "libm")))]
                    return $scalar::$name($($arg),+);
                    // Unreachable: the crate root refuses this choice of features with one clear message.
                    #[cfg(not(any(feature = "std", feature = "libm")))]
                    return { $(let _ = $arg;)+ Default::default() };
                }
            )*
        }
    };
}

backend! { f64 from super::doubles:
    sin_cos(x) -> (f64, f64) = sincos;
    sin(x) -> f64 = sin;
    cos(x) -> f64 = cos;
    tan(x) -> f64 = tan;
    asin(x) -> f64 = asin;
    acos(x) -> f64 = acos;
    atan(x) -> f64 = atan;
    atan2(y, x) -> f64 = atan2;
    sinh(x) -> f64 = sinh;
    cosh(x) -> f64 = cosh;
    tanh(x) -> f64 = tanh;
    asinh(x) -> f64 = asinh;
    acosh(x) -> f64 = acosh;
    atanh(x) -> f64 = atanh;
    exp(x) -> f64 = exp;
    exp_m1(x) -> f64 = expm1;
    ln(x) -> f64 = log;
    ln_1p(x) -> f64 = log1p;
    sqrt(x) -> f64 = sqrt;
    cbrt(x) -> f64 = cbrt;
    powf(x, y) -> f64 = pow;
    hypot(x, y) -> f64 = hypot;
}

backend! { f32 from super::single:
    sin_cos(x) -> (f32, f32) = sincosf;
    sin(x) -> f32 = sinf;
    cos(x) -> f32 = cosf;
    tan(x) -> f32 = tanf;
    asin(x) -> f32 = asinf;
    acos(x) -> f32 = acosf;
    atan(x) -> f32 = atanf;
    atan2(y, x) -> f32 = atan2f;
    sinh(x) -> f32 = sinhf;
    cosh(x) -> f32 = coshf;
    tanh(x) -> f32 = tanhf;
    asinh(x) -> f32 = asinhf;
    acosh(x) -> f32 = acoshf;
    atanh(x) -> f32 = atanhf;
    exp(x) -> f32 = expf;
    exp_m1(x) -> f32 = expm1f;
    ln(x) -> f32 = logf;
    ln_1p(x) -> f32 = log1pf;
    sqrt(x) -> f32 = sqrtf;
    cbrt(x) -> f32 = cbrtf;
    powf(x, y) -> f32 = powf;
    hypot(x, y) -> f32 = hypotf;
}

/// Multiply–add in one instruction where the target has it, else a product and a sum. Never a call, and never
/// fused with `libm` math, which promises the same bits everywhere.
macro_rules! mul_add {
    ($($scalar:ident)*) => {
        $(pub(crate) mod $scalar {
            #[inline(always)]
            pub(crate) fn mul_add(a: $scalar, b: $scalar, c: $scalar) -> $scalar {
                #[cfg(all(
                    feature = "std",
                    not(feature = "libm"),
                    any(target_feature = "fma", target_arch = "aarch64")
                ))]
                return a.mul_add(b, c);
                #[cfg(not(all(
                    feature = "std",
                    not(feature = "libm"),
                    any(target_feature = "fma", target_arch = "aarch64")
                )))]
                return a * b + c;
            }
        })*
    };
}

/// See [`crate::number::real::Real::mul_add`].
pub(crate) mod fused {
    mul_add! { f32 f64 }
}
