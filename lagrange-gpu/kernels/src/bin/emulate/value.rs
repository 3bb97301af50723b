//! Operations on the bits of operands: the rules of PTX, by IEEE 754.

use crate::text::size_of;

/// A float of either size, by its bits.
fn float(bits: u64, kind: &str) -> f64 {
    if kind == "f32" { f64::from(f32::from_bits(bits as u32)) } else { f64::from_bits(bits) }
}

/// The bits of a result in single or double precision. Sums, products, quotients and roots of singles,
/// computed in double precision and rounded once more, are those of singles (Figueroa 1995).
fn bits(value: f64, kind: &str) -> u64 {
    if kind == "f32" { u64::from((value as f32).to_bits()) } else { value.to_bits() }
}

/// The integer that bits mean.
fn integer(bits: u64, kind: &str) -> Result<i128, String> {
    let unused = 64 - 8 * size_of(kind)? as u32;
    let bits = bits << unused;
    Ok(if kind.starts_with('s') {
        i128::from(bits.cast_signed() >> unused)
    } else {
        i128::from(bits >> unused)
    })
}

/// Bits of a type and no others.
pub fn masked(bits: u64, kind: &str) -> Result<u64, String> {
    if kind == "pred" { Ok(bits & 1) } else { Ok(bits & (u64::MAX >> (64 - 8 * size_of(kind)?))) }
}

/// The result of an operation on values, if it is one.
pub fn operation(parts: &[&str], x: &[u64]) -> Result<u64, String> {
    let unknown = || format!("no such operation: {}", parts.join("."));
    let (name, kind) = (*parts.first().ok_or_else(unknown)?, *parts.last().ok_or_else(unknown)?);
    let arity = |count: usize| if x.len() == count { Ok(()) } else { Err(unknown()) };
    match name {
        "cvt" => {
            arity(1)?;
            return convert(parts, x[0]);
        }
        "setp" => return compare(parts, x),
        "selp" => {
            arity(3)?;
            return Ok(if x[2] != 0 { x[0] } else { x[1] });
        }
        "mov" | "cvta" => {
            arity(1)?;
            return Ok(x[0]);
        }
        _ => {}
    }
    if kind == "f64" || kind == "f32" {
        return floating(parts, kind, x);
    }
    let width = if kind == "pred" { 1 } else { 8 * size_of(kind)? as u32 };
    let value = |place: usize| -> Result<i128, String> {
        let bits = *x.get(place).ok_or_else(unknown)?;
        if kind == "pred" { Ok(i128::from(bits & 1)) } else { integer(bits, kind) }
    };
    // A shift by more than the width leaves zeros, or copies of the sign.
    let shift = || {
        Ok::<_, String>(
            u32::try_from(*x.get(1).ok_or_else(unknown)? & 0xffff_ffff).unwrap_or(u32::MAX).min(width),
        )
    };
    let result = match (name, parts.get(1).copied().unwrap_or_default()) {
        ("mul", "wide") => return Ok((value(0)? * value(1)?) as u64 & (u64::MAX >> (64 - 2 * width))),
        ("mul", "hi") => value(0)?.wrapping_mul(value(1)?) >> width,
        ("mul", "lo") => value(0)?.wrapping_mul(value(1)?),
        ("mad", "lo") => value(0)?.wrapping_mul(value(1)?).wrapping_add(value(2)?),
        ("bfe", _) => {
            // A field of bits: from where, how many.
            let (from, bits) = (value(1)? & 0xff, value(2)? & 0xff);
            if kind.starts_with('s') {
                return Err(unknown());
            }
            value(0)? >> from & ((1 << bits) - 1)
        }
        ("add", _) => value(0)? + value(1)?,
        ("sub", _) => value(0)? - value(1)?,
        ("div", _) => value(0)?.checked_div(value(1)?).ok_or("a division by zero")?,
        ("rem", _) => value(0)?.checked_rem(value(1)?).ok_or("a division by zero")?,
        ("min", _) => value(0)?.min(value(1)?),
        ("max", _) => value(0)?.max(value(1)?),
        ("neg", _) => -value(0)?,
        ("abs", _) => value(0)?.abs(),
        ("and", _) => value(0)? & value(1)?,
        ("or", _) => value(0)? | value(1)?,
        ("xor", _) => value(0)? ^ value(1)?,
        ("not", _) => !value(0)?,
        ("shl", _) => value(0)? << shift()?,
        ("shr", _) => value(0)? >> shift()?,
        ("clz", _) => return Ok(u64::from(x[0].leading_zeros() - (64 - width))),
        ("popc", _) => return Ok(u64::from(x[0].count_ones())),
        ("brev", _) => return Ok(x[0].reverse_bits() >> (64 - width)),
        ("shf", direction) => funnel(direction, parts, x)?.into(),
        ("prmt", "b32") => permuted(x)?.into(),
        _ => return Err(unknown()),
    };
    masked(result as u64, kind)
}

/// A shift of two words as one.
fn funnel(direction: &str, parts: &[&str], x: &[u64]) -> Result<u64, String> {
    let &[low, high, by] = x else { return Err("a shift of two words needs three values".to_owned()) };
    let both = high << 32 | low;
    let by = if parts.contains(&"wrap") { by & 31 } else { by.min(32) };
    Ok(if direction == "l" { both << by >> 32 } else { both >> by } & 0xffff_ffff)
}

/// Four bytes out of those of two words, each by its number; with 8 more, copies of its sign.
fn permuted(x: &[u64]) -> Result<u64, String> {
    let &[low, high, chosen] = x else { return Err("a permutation needs three values".to_owned()) };
    let both = high << 32 | low;
    Ok((0..4).fold(0, |word, place| {
        let number = chosen >> (4 * place);
        let byte = both >> (8 * (number & 7)) & 0xff;
        let byte = if number & 8 == 0 { byte } else { 0xff * (byte >> 7) };
        word | byte << (8 * place)
    }))
}

fn floating(parts: &[&str], kind: &str, x: &[u64]) -> Result<u64, String> {
    let unknown = || format!("no such operation: {}", parts.join("."));
    if parts.iter().any(|part| ["approx", "ftz", "rz", "rm", "rp"].contains(part)) {
        return Err(unknown());
    }
    let value = |place: usize| x.get(place).map(|bits| float(*bits, kind)).ok_or_else(unknown);
    let result = match parts[0] {
        "add" => value(0)? + value(1)?,
        "sub" => value(0)? - value(1)?,
        "mul" => value(0)? * value(1)?,
        "div" => value(0)? / value(1)?,
        "rcp" => 1.0 / value(0)?,
        "sqrt" => value(0)?.sqrt(),
        "fma" if kind == "f64" => value(0)?.mul_add(value(1)?, value(2)?),
        "neg" => -value(0)?,
        "abs" => value(0)?.abs(),
        // The sign of the first on the second.
        "copysign" => value(1)?.copysign(value(0)?),
        // A number takes precedence over NaN; −0 is less than +0.
        "min" | "max" => {
            let (a, b) = (value(0)?, value(1)?);
            let least = parts[0] == "min";
            let first = if a == b { a.is_sign_negative() == least } else { (a < b) == least };
            match (a.is_nan(), b.is_nan()) {
                (true, _) => b,
                (_, true) => a,
                _ if first => a,
                _ => b,
            }
        }
        _ => return Err(unknown()),
    };
    Ok(bits(result, kind))
}

fn compare(parts: &[&str], x: &[u64]) -> Result<u64, String> {
    let &[_, how, .., kind] = parts else { return Err("no comparison".to_owned()) };
    let &[a, b, ref with @ ..] = x else { return Err("a comparison needs two values".to_owned()) };
    use std::cmp::Ordering::{Equal, Greater, Less};
    let order = if kind.starts_with('f') {
        float(a, kind).partial_cmp(&float(b, kind))
    } else {
        Some(integer(a, kind)?.cmp(&integer(b, kind)?))
    };
    // Comparisons that end in `u` hold where an operand is NaN.
    let (how, unordered) = match how.strip_suffix('u') {
        Some(how) if kind.starts_with('f') => (how, true),
        _ => (how, false),
    };
    let holds = match (how, order) {
        ("num", _) => order.is_some(),
        ("nan", _) => order.is_none(),
        ("eq" | "ne" | "lt" | "lo" | "le" | "ls" | "gt" | "hi" | "ge" | "hs", None) => unordered,
        ("eq", Some(order)) => order == Equal,
        ("ne", Some(order)) => order != Equal,
        ("lt" | "lo", Some(order)) => order == Less,
        ("le" | "ls", Some(order)) => order != Greater,
        ("gt" | "hi", Some(order)) => order == Greater,
        ("ge" | "hs", Some(order)) => order != Less,
        _ => return Err(format!("no such comparison: {}", parts.join("."))),
    };
    let holds = u64::from(holds);
    match (parts.get(2), with) {
        (Some(&"and"), &[other]) => Ok(holds & other),
        (Some(&"or"), &[other]) => Ok(holds | other),
        (Some(&"xor"), &[other]) => Ok(holds ^ other),
        (_, []) => Ok(holds),
        _ => Err(format!("no such comparison: {}", parts.join("."))),
    }
}

fn convert(parts: &[&str], x: u64) -> Result<u64, String> {
    let &[.., to, from] = parts else { return Err("no conversion".to_owned()) };
    let rounding = parts.get(1).copied().unwrap_or_default();
    if from.starts_with('f') {
        let value = float(x, from);
        let whole = match rounding {
            "rzi" => value.trunc(),
            "rni" => value.round_ties_even(),
            "rmi" => value.floor(),
            "rpi" => value.ceil(),
            // Between floats.
            _ => value,
        };
        if to.starts_with('f') {
            return Ok(bits(whole, to));
        }
        // A value outside the range becomes the nearest number, and NaN becomes zero.
        let size = 8 * size_of(to)? as u32;
        let clamped = if to.starts_with('s') {
            (whole as i128).clamp(-(1 << (size - 1)), (1 << (size - 1)) - 1)
        } else {
            (whole as i128).clamp(0, (1 << size) - 1)
        };
        return masked(clamped as u64, to);
    }
    let value = integer(x, from)?;
    match to {
        "f64" => Ok((value as f64).to_bits()),
        "f32" => Ok(u64::from((value as f32).to_bits())),
        _ => masked(value as u64, to),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, x: &[u64]) -> u64 {
        operation(&name.split('.').collect::<Vec<_>>(), x).expect(name)
    }

    #[test]
    fn operations_are_those_of_the_manual() {
        let [one, two, nan] = [1.0_f64, 2.0, f64::NAN].map(f64::to_bits);
        assert_eq!(of("add.rn.f64", &[one, one]), two);
        assert_eq!(of("min.f64", &[nan, two]), two);
        assert_eq!(of("max.f64", &[(-0.0_f64).to_bits(), 0]), 0);
        assert_eq!(of("copysign.f64", &[(-2.0_f64).to_bits(), one]), (-1.0_f64).to_bits());
        assert_eq!(of("sub.s32", &[0, 1]), 0xffff_ffff);
        assert_eq!(of("mul.hi.u64", &[u64::MAX, 2]), 1);
        assert_eq!(of("mul.wide.s32", &[0xffff_ffff, 2]), (-2_i64).cast_unsigned());
        assert_eq!(of("shr.s32", &[0x8000_0000, 99]), 0xffff_ffff);
        assert_eq!(of("shl.b64", &[1, 64]), 0);
        assert_eq!(of("shf.l.wrap.b32", &[0x8000_0000, 1, 1]), 3);
        assert_eq!(of("prmt.b32", &[0x8070_6050, 0x0403_0201, 0xb340]), 0xff80_0150);
        assert_eq!(of("not.pred", &[1]), 0);
        assert_eq!(of("setp.ltu.f64", &[nan, two]), 1);
        assert_eq!(of("setp.lt.f64", &[nan, two]), 0);
        assert_eq!(of("setp.lt.s32", &[0xffff_ffff, 0]), 1);
        assert_eq!(of("setp.lt.u32", &[0xffff_ffff, 0]), 0);
        assert_eq!(of("setp.eq.and.s64", &[1, 1, 0]), 0);
        assert_eq!(of("cvt.rzi.s32.f64", &[(-1.9_f64).to_bits()]), 0xffff_ffff);
        assert_eq!(of("cvt.rzi.s32.f64", &[1e30_f64.to_bits()]), 0x7fff_ffff);
        assert_eq!(of("cvt.s64.s32", &[0xffff_ffff]), u64::MAX);
        assert_eq!(of("cvt.u64.u32", &[0xffff_ffff]), 0xffff_ffff);
        assert!(operation(&["add", "rz", "f64"], &[one, one]).is_err());
    }
}
