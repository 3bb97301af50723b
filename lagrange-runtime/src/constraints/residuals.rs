//! How far a state is off its constraints, and when that is nothing but rounding.

use super::worst;
use crate::number::real::Real;
use crate::system::error::magnitude;
use crate::system::error::{Cause, Magnitude};
use crate::system::name::Name;

/// Residuals up to this many ulps of the magnitudes of their summands count as zero. There are a few
/// summands, and each is rounded once or twice.
pub(super) const ULPS: f64 = 4.0;

/// The distance of a state from its constraints, as residuals and the sizes of their summands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residuals<R, const C: usize> {
    /// f; zero for nonholonomic constraints.
    pub positions: [R; C],
    /// Σ |summands of f|: what rounding errors are relative to.
    pub position_sizes: [R; C],
    /// df/dt, or g.
    pub rates: [R; C],
    /// Σ |summands of df/dt or g|.
    pub rate_sizes: [R; C],
}

/// The level of a constraint: coordinates with f = 0 come first, then velocities with df/dt = 0 and g = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    Positions,
    Velocities,
}

impl<R: Real, const C: usize> Residuals<R, C> {
    /// The residuals of one level.
    #[inline(always)]
    pub(crate) fn values(&self, level: Level) -> &[R; C] {
        match level {
            Level::Positions => &self.positions,
            Level::Velocities => &self.rates,
        }
    }

    /// The magnitudes of their summands.
    #[inline(always)]
    pub(crate) fn sizes(&self, level: Level) -> &[R; C] {
        match level {
            Level::Positions => &self.position_sizes,
            Level::Velocities => &self.rate_sizes,
        }
    }

    /// Whether all residuals are nothing but rounding errors.
    #[inline(always)]
    pub(super) fn are_roundings(&self) -> bool {
        self.level_is_roundings(Level::Positions) && self.level_is_roundings(Level::Velocities)
    }

    /// Whether the residuals of one level are nothing but rounding errors of their summands.
    #[inline(always)]
    pub(crate) fn level_is_roundings(&self, level: Level) -> bool {
        self.is_within(level, R::from_f64(ULPS) * R::epsilon(), &[R::zero(); C])
    }

    /// Whether all residuals of one level are below a part of their sizes, in every lane. `more` are sizes
    /// beside those of the summands.
    #[inline(always)]
    pub(crate) fn is_within(&self, level: Level, part: R, more: &[R; C]) -> bool {
        // Iterated by pairs: an index would be tested against its bounds, and a firmware link the panic.
        let sizes = self.sizes(level).iter().zip(more);
        self.values(level).iter().zip(sizes).all(|(&value, (&own, &more))| {
            let excess = value.abs() - part * (own + more);
            excess.is_finite() && excess.largest() <= num_traits::Zero::zero()
        })
    }

    /// The same as a call of its own, which is smaller: for checks that are made once a motion.
    #[cold]
    #[inline(never)]
    pub(super) fn is_within_apart(&self, level: Level, part: R, more: &[R; C]) -> bool {
        self.is_within(level, part, more)
    }

    /// The largest residual of one level in units of the `slopes`: about how far the state is off, in the
    /// kinetic metric.
    pub(crate) fn distance(&self, level: Level, slopes: &[R; C]) -> R::Lane {
        worst::<R, C>(|c| relative(self.values(level)[c], slopes[c])).1
    }

    /// The cause of an error where a search has led to a place at which a constraint has no gradient. If the
    /// constraint is violated there, it cannot be met nearby.
    #[cold]
    pub(crate) fn unmet(&self, level: Level, cause: Cause) -> Cause {
        let Cause::VanishingGradient { constraint, name } = cause else { return cause };
        let values = self.values(level).iter().zip(self.sizes(level));
        let ulps = R::from_f64(ULPS) * R::epsilon();
        match values.skip(constraint).map(|(value, &size)| (value.abs(), ulps * size)).next() {
            Some((by, rounding)) if (by - rounding).largest().is_positive() => {
                Cause::NoConsistentState { constraint, name, by: magnitude(by.largest()) }
            }
            _ => cause,
        }
    }

    /// The constraint that the state is furthest from. [`Cause::NotFinite`] where a residual is no number,
    /// since the constraint cannot be told then.
    #[cold]
    pub(crate) fn cause(&self, level: Level, slopes: &[R; C]) -> Cause {
        if !self.values(level).iter().all(|value| value.is_finite()) {
            return Cause::NotFinite;
        }
        let (constraint, _) = worst::<R, C>(|c| relative(self.values(level)[c], slopes[c]));
        let value = self.values(level).get(constraint);
        let by = value.map_or(Magnitude(0.0), |value| magnitude(value.abs().largest()));
        match level {
            Level::Positions => Cause::PositionViolated { constraint, name: Name::NONE, by },
            Level::Velocities => Cause::VelocityViolated { constraint, name: Name::NONE, by },
        }
    }
}

/// |value| / size. Zero over zero is zero.
fn relative<R: Real>(value: R, size: R) -> R::Lane {
    // A number that single precision has as well keeps a size of zero from being a divisor.
    let instead = R::zero().where_positive(size, R::from_f64(f64::from(f32::MIN_POSITIVE)));
    (value.abs() / (size + instead)).largest()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_over_nothing_is_nothing() {
        assert_eq!(relative(0.0_f64, 0.0), 0.0);
        assert_eq!(relative(0.0_f32, 0.0), 0.0);
        assert!(relative(1.0_f32, 0.0) > 1e37 && relative(1.0_f64, 0.0) > 1e37);
        assert_eq!((relative(-3e-300_f64, 1e-300), relative(-3.0_f32, 1.0)), (3.0, 3.0));
        assert!(relative(0.0, f64::NAN).is_nan());
    }
}
