//! Zeros of a guard on one step: none missed, none found twice.
//!
//! A guard is a function of θ in \[0, 1], the part of a step that has passed. It is interpolated once by a
//! [`Polynomial`] in the basis of Chebyshev, with the bound of its rounding errors, the *noise*. All
//! decisions are made on this polynomial:
//!
//! * A point is *certain* where the guard exceeds the noise; its side is then [`Side::Above`] or
//!   [`Side::Below`]. A *zero* is a connected set of points that are not certain. If it has different sides
//!   at its ends, it is a crossing, else a grazing; so a root of odd order is one crossing, a root of even
//!   order one grazing, and two roots are two crossings where the guard exceeds the noise between them.
//! * [`Zeros`] walks over a step from left to right and keeps the last certain side. What it knows at the
//!   end, a [`Memory`], is where the next step starts from. So crossings alternate over all steps, however
//!   a motion is cut into steps, and a zero at the seam of two steps counts once.
//! * A guard that stays within the noise has no zeros. A zero at the end of a step counts there if the
//!   polynomial, extended a little, tells where it leads; else the next step counts it where it starts.
//!
//! [`Zero::polish`] then takes the guard itself to find the crossing to the last bit.
//!
//! Chebyshev instead of Bernstein: the change of basis costs a factor 2ⁿ in accuracy, and on parts of a step
//! the polynomial of degree 64 is one of low degree anyway. The tests on the coefficients of a part, and the
//! bisection, follow J. P. Boyd, "Solving Transcendental Equations" (SIAM 2014), on Chebyshev proxies.
//!
//! Guards whose Taylor series is known need no interpolation: `falling` finds where they first fall, with
//! coefficients of Bernstein, which lose nothing there.

mod bracket;
mod falling;
mod pieces;
mod polynomial;
mod zeros;

pub(crate) use falling::{Before, Fall, clear, falls, reach, rises, starts_above, stays_above, touches};
pub(crate) use polynomial::{Polynomial, Unresolved};
pub(crate) use zeros::Zeros;

use crate::number::real::Ordered;

/// The sign of a guard beyond its noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// Below zero.
    Below,
    /// Above zero.
    Above,
}

impl Side {
    /// `x` if this is above, −`x` if it is below: positive where `x` is on this side.
    fn towards<R: Ordered>(self, x: R) -> R {
        match self {
            Self::Below => -x,
            Self::Above => x,
        }
    }
}

/// The way of a guard through a zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// From below to above.
    Rising,
    /// From above to below.
    Falling,
    /// Touches zero within the noise and returns.
    Grazing,
}

/// The knowledge of a guard where a step starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Memory {
    /// Nothing. A zero at θ = 0 counts; the polynomial tells from where it was reached.
    Unknown,
    /// The last certain side; the guard has not been zero since.
    Side(Side),
    /// The guard came from this side to zero, or did not leave it, and that has not been counted yet.
    Touching(Side),
    /// The guard is zero and that has been counted. If a side is given, the guard leaves zero to this side;
    /// its arrival at the other one is then a crossing. After an impact it is the side that the motion is now
    /// bound to.
    Zero(Option<Side>),
}

impl Memory {
    /// The knowledge of the guard with the other sign.
    pub fn opposite(self) -> Self {
        let other = |side| match side {
            Side::Above => Side::Below,
            Side::Below => Side::Above,
        };
        match self {
            Self::Unknown => Self::Unknown,
            Self::Side(side) => Self::Side(other(side)),
            Self::Touching(side) => Self::Touching(other(side)),
            Self::Zero(side) => Self::Zero(side.map(other)),
        }
    }
}

/// A zero of a guard.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Zero<R> {
    /// The zero, as a part of the step.
    pub(crate) theta: R,
    /// The way of the guard through the zero.
    pub(crate) kind: Kind,
    /// The side of the guard after the zero.
    pub(crate) side: Side,
    /// Points before and after the zero where the guard is certain, or the ends of the step.
    pub(crate) bracket: [R; 2],
}

impl<R: Ordered> Zero<R> {
    /// The knowledge at this zero, for a step that starts here.
    pub(crate) fn memory(&self) -> Memory {
        Memory::Zero(Some(self.side))
    }

    /// A crossing to the last bit, by the guard itself instead of its polynomial. A grazing stays where it
    /// is, and so does a crossing whose guard does not change its sign.
    pub(crate) fn polish(&self, mut guard: impl FnMut(R) -> R) -> R {
        if self.kind == Kind::Grazing {
            return self.theta;
        }
        let [low, high] = self.bracket;
        let value = self.side.towards(guard(self.theta));
        let (ahead, end) = if value < R::zero() { (R::one(), high) } else { (-R::one(), low) };
        let changes = |other: R| (other < R::zero()) != (value < R::zero());
        let mut step = R::epsilon() + R::epsilon();
        let mut near = (self.theta, value);
        while near.0 != end && near.1 != R::zero() && near.1.is_finite() {
            let beyond = self.theta + ahead * step;
            let inside = (end - beyond) * ahead > R::zero();
            let beyond = if inside { beyond } else { end };
            let far = (beyond, self.side.towards(guard(beyond)));
            if changes(far.1) {
                return bracket::solve(|theta| self.side.towards(guard(theta)), near, far);
            }
            near = far;
            step *= R::from_f64(8.0);
        }
        if near.1 == R::zero() { near.0 } else { self.theta }
    }
}

#[cfg(test)]
mod tests;
