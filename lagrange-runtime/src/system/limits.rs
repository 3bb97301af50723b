//! [`Limits`]: the wishes of the caller of a motion for the control of steps.

use super::error::Cause;
use crate::number::real::{Ordered, larger, smaller};

/// The caller's wishes for the control of steps.
#[derive(Clone, Copy, Debug)]
pub struct Limits<R> {
    /// Tolerated error relative to a component's size.
    pub relative: R,
    /// Tolerated error of a component near zero, where the caller gave one.
    pub absolute: Option<R>,
    /// Longest step, if limited.
    pub step: Option<R>,
    /// Attempts that one call may make.
    pub attempts: u64,
}

impl<R: Ordered> Limits<R> {
    /// Tolerance 1e-10, or 100 ε where that is coarser.
    pub(crate) fn new() -> Self {
        let tolerance = larger(R::from_f64(1e-10), R::from_f64(100.0) * R::epsilon());
        Self { relative: tolerance, absolute: None, step: None, attempts: 10_000_000 }
    }

    /// Refuses limits that no step can meet.
    pub(crate) fn check(&self) -> Result<(), Cause> {
        let bad = |x: R| !x.is_finite() || !(x.is_positive() || x == R::zero());
        if bad(self.relative) || self.absolute.is_some_and(bad) {
            return Err(Cause::InvalidTolerance);
        }
        match self.step {
            Some(step) if !(step.is_finite() && step.is_positive()) => Err(Cause::InvalidStep),
            _ => Ok(()),
        }
    }

    /// `h` \[s] within the limit.
    #[inline]
    pub(crate) fn clip(&self, h: R) -> R {
        self.step.map_or(h, |limit| smaller(h, limit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_refuse_what_cannot_be_met() {
        let good = Limits::<f64>::new();
        assert_eq!(good.check(), Ok(()));
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Limits { relative: bad, ..good }.check(), Err(Cause::InvalidTolerance));
            assert_eq!(Limits { absolute: Some(bad), ..good }.check(), Err(Cause::InvalidTolerance));
            assert_eq!(Limits { step: Some(bad), ..good }.check(), Err(Cause::InvalidStep));
        }
        // Such a tolerance accepts every step and leaves the limit of the step in charge.
        assert_eq!(Limits { relative: 1e6, ..good }.check(), Ok(()));
        assert_eq!(Limits { absolute: Some(0.0), ..good }.check(), Ok(()));
        assert_eq!(Limits { step: Some(0.0), ..good }.check(), Err(Cause::InvalidStep));
    }
}
