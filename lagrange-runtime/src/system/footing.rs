//! [`Footing`]: how well a state on the constraints is known; [`Apart`]: the same of lanes that decide
//! nothing together.

use super::metric::Metric;
use crate::linear::Independence;

/// How well a state on the constraints is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footing<R, const N: usize> {
    /// How well the constraints determine it.
    pub independence: Independence<R>,
    /// The accelerations at the state that was reached, before it was moved onto the constraints. Present if
    /// they were asked for and the constraints are clearly independent there.
    pub accelerations: Option<[R; N]>,
    /// An ulp of the largest coordinate in the kinetic metric, in the unit of each: constraints couple them,
    /// so no coordinate is known better than that.
    pub ulps_q: [R; N],
    /// The same of the velocities.
    pub ulps_v: [R; N],
    /// An ulp of the forces at each coordinate, those of constraints included, as an acceleration. Where
    /// forces balance each other, their sum is not known better than that. Zero if no accelerations were
    /// asked for.
    pub ulps_a: [R; N],
    /// The kinetic metric.
    pub metric: Metric<R, N>,
}

/// The landing of a state on the constraints in each lane, as a function of the numbers of that lane.
#[derive(Clone, Copy, Debug)]
pub struct Apart<R, const N: usize> {
    /// The accelerations at the state that was reached, before it was moved onto the constraints.
    pub accelerations: [R; N],
    /// The kinetic metric there.
    pub metric: Metric<R, N>,
    /// Positive in lanes that are not on the constraints yet.
    pub left: R,
    /// Positive in lanes that are close to a state which the constraints do not determine well.
    pub close: R,
}
