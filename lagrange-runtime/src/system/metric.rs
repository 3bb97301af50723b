//! The kinetic metric: units in which no coordinate is larger than another.
//!
//! Where the summands of a constraint are no measure, its rounding errors are relative to this metric. In a
//! constraint such as z = 0 rounding leaves a part of the other coordinates in the kinetic metric, not of z.
//! So the largest coordinate in units of 1/√M\[i]\[i], times the gradient in these units, is a size as well,
//! the same in all units of the user.

use crate::linear::{Gradients, SaddlePoint};
use crate::number::elements::{Each, array};
use crate::number::real::Real;

/// Units of the coordinates at a state, those of the kinetic metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metric<R, const N: usize> {
    /// 1/√M\[i]\[i], or a unit from what ties the coordinate to others; zero for a coordinate that nothing
    /// moves.
    units: [R; N],
    /// Their reciprocals; zero for zero.
    weights: [R; N],
}

impl<R: Real, const N: usize> Metric<R, N> {
    /// The metric of a mass matrix and constraints that have been factored.
    #[inline(always)]
    pub(crate) fn of<const C: usize>(saddle: &impl SaddlePoint<R, N, C>) -> Self {
        let units = saddle.units();
        let reciprocal = |unit: R| if unit.is_positive() { unit.recip() } else { R::zero() };
        Self { units, weights: units.each(reciprocal) }
    }

    /// A metric in which nothing has a size.
    #[inline(always)]
    pub(crate) fn none() -> Self {
        Self { units: [R::zero(); N], weights: [R::zero(); N] }
    }

    /// The largest of some coordinates, or velocities, in these units.
    #[inline(always)]
    pub(crate) fn extent(&self, x: &[R; N]) -> R {
        x.iter().zip(&self.weights).fold(R::zero(), |most, (x, &weight)| most.max(x.abs() * weight))
    }

    /// The largest of some coordinates, or velocities, in these units and as a number.
    #[inline(always)]
    pub(crate) fn sizes(&self, x: &[R; N]) -> [R; 2] {
        [self.extent(x), largest(x)]
    }

    /// The most that changes of these sizes make of constraints with these gradients, by the less of both: in
    /// these units alone, heavy bodies would hide that a light one is off.
    pub(crate) fn changes<const C: usize>(
        &self,
        gradients: &impl Gradients<R, N, C>,
        [extent, number]: [R; 2],
    ) -> [R; C] {
        let (by_extent, by_number) = (self.slopes(gradients), gradients.slopes(&[R::one(); N]));
        array(|c| (by_extent[c] * extent).min(by_number[c] * number))
    }

    /// How fast constraints with these gradients change along all coordinates together, each in its unit.
    #[inline(always)]
    pub(crate) fn slopes<const C: usize>(&self, gradients: &impl Gradients<R, N, C>) -> [R; C] {
        gradients.slopes(&self.units)
    }

    /// An ulp of something of this extent, in the unit of each coordinate.
    #[inline(always)]
    pub(crate) fn ulps(&self, extent: R) -> [R; N] {
        self.at_extent(R::epsilon() * extent)
    }

    /// The accelerations that forces of these sizes make of the coordinates alone.
    #[inline(always)]
    pub(crate) fn accelerated(&self, forces: &[R; N]) -> [R; N] {
        array(|i| forces[i] * self.units[i] * self.units[i])
    }

    /// A number of this extent, in the unit of each coordinate.
    #[inline(always)]
    pub(crate) fn at_extent(&self, extent: R) -> [R; N] {
        self.units.each(|unit| extent * unit)
    }
}

/// The largest number, without signs.
pub(crate) fn largest<R: Real, const N: usize>(numbers: &[R; N]) -> R {
    numbers.iter().fold(R::zero(), |largest, number| largest.max(number.abs()))
}
