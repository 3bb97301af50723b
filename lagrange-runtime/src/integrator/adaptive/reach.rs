//! Looks for a tolerance with which a motion goes on from a state where it ends with the given one.

use super::super::dop853::Dop853Memory;
use super::super::landing::Check;
use super::Driven;
use crate::number::real::{Ordered, Real, smaller};
use crate::system::System;
use crate::system::control::Control;
use crate::system::error::{Cause, MotionError, magnitude};
use crate::system::limits::Limits;

/// The number of lengths that are tried, each twice the one before.
const LENGTHS: i32 = 10;

impl<S, C, const N: usize, const K: usize> Driven<'_, S, C, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
{
    /// The cause of a motion's end by too small steps: the tolerance, if longer steps with a larger error end
    /// well, else the given error.
    #[cold]
    #[inline(never)]
    pub(super) fn named(
        &self,
        memory: &mut Dop853Memory<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        target: S::Scalar,
        natural: S::Scalar,
        error: MotionError<S::Scalar>,
    ) -> MotionError<S::Scalar> {
        if !matches!(error.cause, Cause::Undetermined { .. } | Cause::StepTooSmall) {
            return error;
        }
        let kept = *memory;
        let cause = match self.reachable(memory, limits, target, natural) {
            Some(reachable) => Cause::ToleranceTooFine { reachable: magnitude(reachable.largest()) },
            None => error.cause,
        };
        *memory = kept;
        MotionError { cause, ..error }
    }

    /// The finest tolerance at which some longer step ends where the state is determined, if there is one.
    fn reachable(
        &self,
        memory: &mut Dop853Memory<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        target: S::Scalar,
        natural: S::Scalar,
    ) -> Option<S::Scalar> {
        // A tolerance of half of all digits.
        let coarse = Limits { relative: S::Scalar::epsilon().sqrt(), ..*limits };
        let (start, kept) = (memory.end.state, *memory);
        let inputs = self.control.inputs(&start);
        let check = Check {
            system: self.system,
            constants: self.constants,
            inputs: &inputs,
            limits: &coarse,
            from: &start,
        };
        let left = target - start.t;
        let shortest = S::Scalar::from_f64(0.5).powi(LENGTHS) * left.abs();
        let mut length = if natural.is_positive() { natural } else { shortest };
        let mut finest: Option<S::Scalar> = None;
        for _ in 0..LENGTHS {
            *memory = kept;
            if let Some(error) = memory.stride(self, &coarse, left.signum() * length)
                && let Ok(landing) = check.land(&memory.end.state, None)
                && landing.is_right
                && landing.footing.independence.is_determined()
            {
                let reached = error * coarse.relative;
                finest = Some(finest.map_or(reached, |finest| smaller(finest, reached)));
            }
            length += length;
        }
        // If a longer step meets the given tolerance, the tolerance is not the cause.
        finest.filter(|&finest| finest > limits.relative)
    }
}
