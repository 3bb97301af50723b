//! What errors speak of: functions of a description, and sizes.

use core::fmt;

/// The name of a function of a description, and what is to be said of it. Small, because errors are.
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
