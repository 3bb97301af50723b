//! The bits of the elementary functions, over arguments of every size that they take.

use core::fmt::{self, Write};

use lagrangian::prelude::*;

use crate::bits::{Bits, Hash};

/// Arguments of each function.
const ARGUMENTS: u32 = 256;

/// Writes a line with the hash of the values of each function.
///
/// # Errors
/// Where the text cannot be written.
pub fn report<R: Bits>(out: &mut dyn Write) -> fmt::Result {
    macro_rules! lines {
        ($($name:ident on $spread:ident;)*) => {$(
            line::<R>(out, stringify!($name), $spread, |x| Real::$name(x))?;
        )*};
    }
    lines! {
        sin on wide; cos on wide; tan on wide; asin on unit; acos on unit; atan on wide;
        sinh on medium; cosh on medium; tanh on medium; asinh on wide; acosh on positive; atanh on unit;
        exp on medium; exp_m1 on medium; ln on positive; ln_1p on positive; sqrt on positive; cbrt on wide;
    }
    line::<R>(out, "atan2", wide, |x| x.atan2(R::from_f64(0.3)))?;
    line::<R>(out, "hypot", wide, |x| x.hypot(R::from_f64(0.3)))?;
    line::<R>(out, "powf", positive, |x| x.powf(R::from_f64(0.3)))
}

/// From −1 to 1.
fn unit(x: f64) -> f64 {
    x
}

/// From −16 to 16.
fn medium(x: f64) -> f64 {
    16.0 * x
}

/// Arguments of either sign, from 1e-10 to 1e10 or so.
fn wide(x: f64) -> f64 {
    let square = x * x;
    x * square * square * square * square * square * 1e10 + x
}

/// The same above 1.
fn positive(x: f64) -> f64 {
    let wide = wide(x);
    1.0 + if wide < 0.0 { -wide } else { wide }
}

fn line<R: Bits>(
    out: &mut dyn Write,
    name: &str,
    spread: fn(f64) -> f64,
    function: fn(R) -> R,
) -> fmt::Result {
    let mut hash = Hash::default();
    let mut noise = 1_u32;
    for _ in 0..ARGUMENTS {
        // A linear congruence; its upper bits are good enough to choose arguments.
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let x = f64::from(noise as i32) * (1.0 / 2_147_483_648.0);
        hash.add(function(R::from_f64(spread(x))));
    }
    writeln!(out, "{name} {}: {hash}", R::NAME)
}
