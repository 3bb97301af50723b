//! Functions that can hide from a step of a motion, by what they depend on.

use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::state::State;

/// A function that can hide from a step, by what its narrow place depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hidden {
    /// The argument of a function such as tanh: one is its width.
    Argument,
    /// The base of this power or its inverse: the function is narrow where the base is smallest or largest.
    Base(u32),
    /// A function that others have a kink or a pole at the zeros of.
    Root,
    /// An angle \[rad] that such functions turn with.
    Angle,
}

impl Hidden {
    /// The power of a base; one for a root, and `None` for arguments and angles.
    pub(crate) fn power<R: Real>(self) -> Option<R> {
        match self {
            Self::Argument | Self::Angle => None,
            Self::Base(power) => Some(R::from_f64(f64::from(power))),
            Self::Root => Some(R::one()),
        }
    }
}

/// Visits functions that can hide. `at` gives what they depend on at a state: arguments, the bases of these
/// powers, and so many roots and angles.
#[inline]
pub fn hidden<R: Copy, const N: usize, const K: usize, const COUNT: usize, const PLACES: usize>(
    states: &[State<R, N>; PLACES],
    inputs: &[[R; K]; PLACES],
    (powers, roots, angles): (&[u32], usize, usize),
    at: impl Fn(R, &[R; N], &[R; N], &[R; K]) -> [R; COUNT],
    mut visit: impl FnMut(Hidden, [R; PLACES]),
) {
    let values: [_; PLACES] = array(|place| {
        let State { t, q, v } = &states[place];
        at(*t, q, v, &inputs[place])
    });
    (0..COUNT).for_each(|index| {
        let base = (index + powers.len() + roots + angles).checked_sub(COUNT);
        let kind = match base.map(|base| powers.get(base)) {
            None => Hidden::Argument,
            Some(Some(&power)) => Hidden::Base(power),
            Some(None) if index + angles < COUNT => Hidden::Root,
            Some(None) => Hidden::Angle,
        };
        visit(kind, array(|place| values[place][index]));
    });
}
