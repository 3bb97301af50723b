//! [`Vector`]: scalars whose lanes can be taken apart.

use super::{Ordered, Real};

/// Several numbers side by side, each of which can be read and replaced: the vectors of the `wide` crate as
/// `Lanes`, and `f64` and `f32` as vectors of one lane.
pub trait Vector: Real<Lane: Ordered> {
    /// The number of lanes.
    const COUNT: usize;

    /// The lanes.
    fn lanes(&self) -> &[Self::Lane];

    /// The lanes, to be changed.
    fn lanes_mut(&mut self) -> &mut [Self::Lane];

    /// A lane; zero beyond the last one.
    #[inline(always)]
    fn lane(&self, index: usize) -> Self::Lane {
        self.lanes().get(index).copied().unwrap_or_else(num_traits::Zero::zero)
    }

    /// Replaces a lane.
    #[inline(always)]
    fn set_lane(&mut self, index: usize, value: Self::Lane) {
        if let Some(lane) = self.lanes_mut().get_mut(index) {
            *lane = value;
        }
    }
}

macro_rules! one_lane {
    ($($scalar:ident),*) => {$(
        impl Vector for $scalar {
            const COUNT: usize = 1;

            #[inline]
            fn lanes(&self) -> &[Self] {
                core::slice::from_ref(self)
            }

            #[inline]
            fn lanes_mut(&mut self) -> &mut [Self] {
                core::slice::from_mut(self)
            }
        }
    )*};
}

one_lane!(f64, f32);
