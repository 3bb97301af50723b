//! [`Ordered`]: scalars that can be compared, and comparisons of scalars.

use super::Real;

/// A scalar with an order, and so with one lane. Motions under error control need it. It is implemented for
/// every [`Real`] that can be compared.
pub trait Ordered: Real + PartialOrd {}

impl<R: Real + PartialOrd> Ordered for R {}

/// Whether a number is positive in any lane.
#[inline]
pub(crate) fn any<R: Real>(number: R) -> bool {
    number.largest() > num_traits::Zero::zero()
}

/// The larger of two ordered scalars; the second if they cannot be compared.
#[inline]
pub(crate) fn larger<R: PartialOrd>(a: R, b: R) -> R {
    if a > b { a } else { b }
}

/// The smaller of two ordered scalars; the second if they cannot be compared.
#[inline]
pub(crate) fn smaller<R: PartialOrd>(a: R, b: R) -> R {
    if a < b { a } else { b }
}

/// The largest of a number and its derivatives, without signs.
#[inline]
pub(crate) fn extent<R: Ordered>(x: R) -> R {
    (0..R::PARTS).fold(R::zero(), |most, part| larger(most, x.part(part).abs()))
}
