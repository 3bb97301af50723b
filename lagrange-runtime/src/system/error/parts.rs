//! The parts of error messages: functions of a description, and sizes.

use core::fmt;

use crate::number::real::Ordered;

/// The name of a function of a description, and the message about it. Small, because errors are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Function(#[doc(hidden)] pub &'static [&'static str; 2]);

impl Function {
    /// The name, or that of an argument of its role: `gravity`, `mass of bob`.
    pub fn name(&self) -> &'static str {
        self.0[0]
    }
}

impl fmt::Display for Function {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.name())
    }
}

impl fmt::Debug for Function {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.name())
    }
}

/// How large a violation is, for a report: of two digits, because printing all of a float takes several
/// kilobytes of a firmware.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub struct Magnitude(pub f32);

impl fmt::Display for Magnitude {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (mut value, mut exponent) = (self.0, 0);
        if !value.is_finite() {
            return out.write_str("more than any number");
        }
        while value > 0.0 && value < 0.995 {
            (value, exponent) = (value * 10.0, exponent - 1);
        }
        while value >= 9.95 {
            (value, exponent) = (value / 10.0, exponent + 1);
        }
        let tenths = (10.0 * value + 0.5) as u32;
        write!(out, "{}.{}e{exponent}", tenths / 10, tenths % 10)
    }
}

impl fmt::Debug for Magnitude {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, out)
    }
}

/// The size of a violation.
#[cold]
pub(crate) fn magnitude<R: Ordered>(value: R) -> Magnitude {
    Magnitude(if value.is_finite() { value.to_single() } else { f32::NAN })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn magnitudes_are_those_of_single_precision() {
        for value in [0.0, 1.0, 0.1, 1e-30, 6.02e23, 1e-40] {
            assert!((f64::from(magnitude(value).0) - value).abs() <= 1.2e-7 * value + 1.5e-45, "{value}");
        }
        assert_eq!(magnitude(0.1_f32).0, 0.1);
        assert_eq!(magnitude(1e39).0, f32::INFINITY);
        assert!(magnitude(f64::NAN).0.is_nan());
    }
}
