//! [`Footing`]: how well a state on the constraints is known.

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
    /// The kinetic metric.
    pub metric: Metric<R, N>,
}
