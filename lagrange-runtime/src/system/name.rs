//! Names of coordinates and constraints in errors.

use core::fmt;

/// The name of a coordinate or constraint, as in `COORDINATES` and `CONSTRAINTS` of the system. One pointer
/// in size, so that errors stay small. Empty where the name is not known.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Name(&'static &'static str);

impl Name {
    /// No name.
    pub const NONE: Self = Self(&"");

    /// A name. A reference to a reference is half the size.
    #[must_use]
    pub const fn new(name: &'static &'static str) -> Self {
        Self(name)
    }

    /// The name as text.
    #[must_use]
    pub fn as_str(&self) -> &'static str {
        self.0
    }
}

impl fmt::Display for Name {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.0)
    }
}

impl fmt::Debug for Name {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.0)
    }
}

/// The names of a system.
#[derive(Clone, Copy, Debug)]
pub struct Names {
    /// Names of the coordinates, in their order.
    pub coordinates: &'static [&'static str],
    /// Names of the scalar constraints, in their order.
    pub constraints: &'static [&'static str],
}

impl Names {
    /// The names of a system written by hand, which has none.
    pub const NONE: Self = Self { coordinates: &[], constraints: &[] };

    pub(crate) fn coordinate(&self, index: usize) -> Name {
        self.coordinates.get(index).map_or(Name::NONE, Name)
    }

    pub(crate) fn constraint(&self, index: usize) -> Name {
        self.constraints.get(index).map_or(Name::NONE, Name)
    }
}

/// A part of a system in a message: by its name, or by its index where it has none.
pub(crate) struct Part(pub usize, pub Name);

impl fmt::Display for Part {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.1.as_str() {
            "" => fmt::Display::fmt(&self.0, out),
            name => write!(out, "`{name}`"),
        }
    }
}
