//! The types that a constant integer may have, so that it overflows where Rust's does.
//!
//! A literal without suffix may have any type. The result of an operation may have the types that both
//! operands may have and that can hold it. If none is left, Rust would overflow.

use std::ops::BitAnd;

/// A set of integer types.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Integers(u16);

/// The types by name, with their width and whether they are signed. Integers of the size of a pointer count
/// as 32 bits wide, which is what microcontrollers have.
const TYPES: [(&str, u32, bool); 12] = [
    ("i8", 8, true),
    ("i16", 16, true),
    ("i32", 32, true),
    ("i64", 64, true),
    ("i128", 128, true),
    ("isize", 32, true),
    ("u8", 8, false),
    ("u16", 16, false),
    ("u32", 32, false),
    ("u64", 64, false),
    ("u128", 128, false),
    ("usize", 32, false),
];

impl Integers {
    /// All types: a literal without suffix.
    pub const ANY: Integers = Integers((1 << TYPES.len()) - 1);
    /// Lengths and indices.
    pub const USIZE: Integers = Integers(1 << 11);
    /// Exponents.
    pub const I32: Integers = Integers(1 << 2);

    /// The type of a name.
    pub fn named(name: &str) -> Option<Integers> {
        TYPES.iter().position(|(known, ..)| *known == name).map(|index| Integers(1 << index))
    }

    /// A number for this set.
    pub fn bits(self) -> u16 {
        self.0
    }

    /// The types among these that can hold a value; `None` where none can.
    pub fn holding(self, value: i128) -> Option<Integers> {
        let holds = |&(_, width, signed): &(&str, u32, bool)| match (width, signed) {
            (128, true) => true,
            (128, false) => value >= 0,
            (width, true) => (-(1_i128 << (width - 1))..1_i128 << (width - 1)).contains(&value),
            (width, false) => (0..1_i128 << width).contains(&value),
        };
        let fit = TYPES.iter().enumerate().filter(|(_, ty)| holds(ty));
        let left = self.0 & fit.fold(0, |set, (index, _)| set | 1 << index);
        (left != 0).then_some(Integers(left))
    }

    /// `value as type`: bits beyond the width are cut off. `None` if the width of a pointer decides, or if a
    /// negative number becomes a `u128`.
    pub fn cast(self, value: i128) -> Option<i128> {
        let &(name, width, signed) = TYPES.get(self.0.trailing_zeros() as usize)?;
        if width == 128 {
            return (signed || value >= 0).then_some(value);
        }
        let modulus = 1_i128 << width;
        let low = value.rem_euclid(modulus);
        let cut = if signed && low >= modulus / 2 { low - modulus } else { low };
        (!name.ends_with("size") || cut == value).then_some(cut)
    }

    /// `value as type` for a number: rounded towards zero and limited to the range of the type. `None` if it
    /// is not finite, if an `i128` does not hold the result, or if the width of a pointer decides.
    pub fn saturated(self, value: f64) -> Option<i128> {
        let &(name, width, signed) = TYPES.get(self.0.trailing_zeros() as usize)?;
        let (low, high) = match (width, signed) {
            (128, true) => (i128::MIN, i128::MAX),
            (128, false) => (0, i128::MAX),
            (width, true) => (-(1_i128 << (width - 1)), (1_i128 << (width - 1)) - 1),
            (width, false) => (0, (1_i128 << width) - 1),
        };
        // 2¹²⁷ and more become the largest `i128`, or what only a `u128` holds.
        let is_held = signed || width < 128 || value < -(i128::MIN as f64);
        let whole = value as i128;
        let is_cut_by_width = name.ends_with("size") && (whole > high || signed && whole < low);
        (value.is_finite() && is_held && !is_cut_by_width).then(|| whole.clamp(low, high))
    }
}

impl BitAnd for Integers {
    type Output = Integers;

    /// The types in both sets. If there is none, rustc refuses the operands, and the first one counts.
    fn bitand(self, other: Integers) -> Integers {
        let both = self.0 & other.0;
        if both == 0 { self } else { Integers(both) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_are_those_of_rust() {
        let named = |name| Integers::named(name).expect("a type");
        assert_eq!(named("u8").cast(300), Some(i128::from(300_i32 as u8)));
        assert_eq!(named("i8").cast(200), Some(i128::from(200_i32 as i8)));
        assert_eq!(named("i32").cast(-1), Some(-1));
        assert_eq!(named("u32").cast(-1), Some(i128::from(-1_i32 as u32)));
        assert_eq!(named("usize").cast(-1), None);
        assert_eq!(named("usize").cast(7), Some(7));
        assert_eq!(named("i32").saturated(2.6), Some(i128::from(2.6_f64 as i32)));
        assert_eq!(named("i32").saturated(-2.6), Some(i128::from(-2.6_f64 as i32)));
        assert_eq!(named("u8").saturated(-2.6), Some(i128::from(-2.6_f64 as u8)));
        assert_eq!(named("u8").saturated(1e9), Some(i128::from(1e9_f64 as u8)));
        assert_eq!(named("u8").saturated(f64::NAN), None);
        assert_eq!(named("u128").saturated(1e38), Some((1e38_f64 as u128) as i128));
        assert_eq!(named("u128").saturated(-1e38), Some(0));
        assert_eq!(named("u128").saturated(2e38), None);
        assert_eq!(named("u128").saturated(2_f64.powi(127)), None);
        assert_eq!(named("i128").saturated(2e38), Some(i128::MAX));
        assert_eq!(named("usize").saturated(1e10), None);
        assert_eq!(named("usize").saturated(-1e10), Some(0));
        assert_eq!(named("isize").saturated(-1e10), None);
        assert_eq!(named("isize").saturated(-2.6), Some(-2));
    }

    #[test]
    fn what_no_type_holds_overflows() {
        assert_eq!(Integers::USIZE.holding(-1), None);
        assert_eq!(Integers::named("u8").and_then(|ty| ty.holding(256)), None);
        assert!(Integers::ANY.holding(-1).is_some_and(|types| types.holding(1) == Some(types)));
        assert_eq!(Integers::ANY & Integers::USIZE, Integers::USIZE);
    }
}
