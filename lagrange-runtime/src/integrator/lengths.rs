//! The lengths of a step, in the order in which they are tried.

use super::landing::{Check, Determined, Landing};
use crate::linear::{Independence, determined};
use crate::number::elements::Each;
use crate::number::real::{Ordered, Real, larger};
use crate::system::System;
use crate::system::error::Cause;

/// The parts of a length that are tried if it ends where the state is not determined well. Nearby lengths
/// come first, so that the cost is small.
pub(crate) const PARTS: [f64; 8] = [0.9, 1.05, 0.8, 0.7, 0.6, 0.5, 0.35, 0.25];

/// The factor on a length whose error is bounded instead of measured, if the bound does not hold.
const SHORTER: f64 = 0.9;

/// The factor on a measured length whose end is wrong.
const HALF: f64 = 0.5;

/// The verdict about a step that has landed.
pub(crate) enum Verdict<R, const N: usize> {
    /// It ends here. The motion keeps how well the constraints have determined it.
    Take(Landing<R, N>, Determined<R>),
    /// It is tried with another length. The cause is that of the error if time does not resolve that length.
    Try { length: R, cause: Cause },
    /// No length ends where the state is determined.
    GiveUp(Cause),
}

/// The outcome of trying a length.
enum Outcome<R> {
    /// The end is not right.
    Wrong,
    /// The end is right, with constraints of this independence.
    Right(Independence<R>),
}

/// The next action.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Next<R> {
    /// Try this length.
    Try(R),
    /// Take this length, which is right.
    Take(R),
    /// No length ends where the state is determined.
    GiveUp,
}

/// The lengths that are tried for one step, in any unit of time.
pub(crate) struct Lengths<R> {
    determined: Determined<R>,
    /// The independence of the constraints where the step begins, and the tolerance. From them follows which
    /// end is good enough.
    begun: R,
    tolerance: R,
    /// The longest step whose error is measured.
    measured: R,
    /// The longest step that error control allows, if a limit makes the step shorter than that; `None` once
    /// it has been tried.
    natural: Option<R>,
    /// The time to go, until it has been tried.
    left: Option<R>,
    /// The length that [`PARTS`] refers to.
    base: R,
    /// The number of parts that have been tried.
    tried: usize,
    best: Option<(R, R)>,
}

/// The independence σ of constraints that is enough at the end of a step. At its start it was `begun`.
///
/// Roundings move a velocity by ε/σ². So an end is good enough where that is the tolerance, or where half is
/// left of what the step started with.
#[inline]
pub(crate) fn enough<R: Real>(begun: R, tolerance: R) -> R {
    (R::from_f64(0.5) * begun).min(wanted(tolerance))
}

/// The independence of constraints at which roundings of a state are within a tolerance.
#[inline]
pub(crate) fn wanted<R: Real>(tolerance: R) -> R {
    (R::epsilon() / tolerance.max(R::epsilon())).sqrt().min(R::one()).max(determined())
}

impl<R: Ordered> Lengths<R> {
    /// The lengths for a step that begins with independence `here`, at a tolerance. `measured` and `natural`
    /// are those of the fields. `base` is tried first.
    ///
    /// An end is good enough where [`enough`] says so; and one that leaves the configuration in which
    /// constraints depend on each other is better than any before it. Where no length ends so well, the best
    /// is taken.
    pub(crate) fn new(
        determined: Determined<R>,
        here: &Independence<R>,
        tolerance: R,
        [measured, natural, base]: [R; 3],
    ) -> Self {
        Self {
            determined,
            begun: here.least,
            tolerance,
            measured,
            natural: Some(natural),
            left: None,
            base,
            tried: 0,
            best: None,
        }
    }

    /// The same with another base, which is tried next.
    pub(crate) fn based_on(mut self, base: R) -> Self {
        (self.base, self.tried) = (base, 0);
        self
    }

    /// The same, with the time to go as a further length. The error of a polynomial in time bounds no step,
    /// and at the end of a vast step numbers are so large that constraints seem to depend on each other.
    pub(crate) fn on_the_way(mut self, left: R) -> Self {
        self.left = Some(left);
        self
    }

    /// Whether constraints are independent enough at an end.
    fn is_enough(&self, there: &Independence<R>) -> bool {
        there.least >= enough(self.begun, self.tolerance)
    }

    /// The verdict on a step of this length that has `landed`.
    pub(crate) fn judge<S, const N: usize, const K: usize>(
        &mut self,
        check: &Check<'_, S, N, K>,
        length: R,
        landed: Result<Landing<R, N>, Cause>,
    ) -> Verdict<R, N>
    where
        S: System<N, K, Scalar = R>,
    {
        let (outcome, cause) = match &landed {
            Ok(landing) if landing.is_right => {
                let there = landing.footing.independence;
                (
                    Outcome::Right(there),
                    Cause::Undetermined {
                        constraint: there.weakest,
                        name: S::NAMES.constraint(there.weakest),
                    },
                )
            }
            Ok(_) => (Outcome::Wrong, Cause::StepTooSmall),
            Err(cause) => (Outcome::Wrong, *cause),
        };
        let leaves = || landed.as_ref().is_ok_and(|landing| check.leaves(landing));
        match (self.next(length, outcome, leaves), landed) {
            (Next::Take(taken), Ok(landing)) if taken == length => {
                self.determined.learn(&landing.footing.independence);
                Verdict::Take(landing, self.determined)
            }
            (Next::Try(length) | Next::Take(length), _) => Verdict::Try { length, cause },
            (Next::GiveUp, _) => Verdict::GiveUp(cause),
        }
    }

    /// The next length after one was tried. `leaves` tells whether constraints become more independent beyond
    /// its end.
    fn next(&mut self, length: R, outcome: Outcome<R>, leaves: impl FnOnce() -> bool) -> Next<R> {
        match outcome {
            Outcome::Right(there) => {
                if self.determined.accepts(&there) {
                    if self.is_enough(&there) || leaves() {
                        return Next::Take(length);
                    }
                    if self.best.is_none_or(|(_, least)| there.least > least) {
                        self.best = Some((length, there.least));
                    }
                }
            }
            Outcome::Wrong if self.tried == 0 => {
                self.base = if self.base > self.measured {
                    larger(R::from_f64(SHORTER) * self.base, self.measured)
                } else {
                    R::from_f64(HALF) * self.base
                };
                return Next::Try(self.base);
            }
            Outcome::Wrong => {}
        }
        // A table of scalars, so that none is converted at run time.
        let parts = PARTS.each(R::from_f64);
        if let Some(&part) = parts.get(self.tried) {
            self.tried += 1;
            return Next::Try(part * self.base);
        }
        if let Some((length, _)) = self.best {
            return Next::Take(length);
        }
        if let Some(left) = self.left.take()
            && left < self.base
        {
            (self.base, self.tried) = (left, 0);
            return Next::Try(left);
        }
        // A limit of the step must not keep it where it cannot end. This length is tried once, since a length
        // that was shortened because it was wrong is below it as well.
        if let Some(natural) = self.natural.take()
            && self.base < natural
        {
            (self.base, self.tried) = (natural, 0);
            return Next::Try(natural);
        }
        Next::GiveUp
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn here(least: f64) -> Independence<f64> {
        Independence { least, ..Independence::clear(2) }
    }

    fn lengths(start: f64, [measured, natural, base]: [f64; 3]) -> Lengths<f64> {
        Lengths::new(Determined::at_start(&here(1.0)), &here(start), 1e-10, [measured, natural, base])
    }

    #[test]
    fn an_end_that_is_determined_is_taken_at_once() {
        let mut lengths = lengths(1.0, [1.0; 3]);
        assert_eq!(lengths.next(1.0, Outcome::Right(here(0.6)), || panic!("not asked")), Next::Take(1.0));
    }

    #[test]
    fn an_end_that_leaves_is_taken_and_one_that_comes_closer_is_not() {
        let mut lengths = lengths(1.0, [1.0; 3]);
        // √(ε / 1e-10) is 1.5e-3.
        assert_eq!(lengths.next(1.0, Outcome::Right(here(1e-3)), || false), Next::Try(0.9));
        assert_eq!(lengths.next(0.9, Outcome::Right(here(1e-3)), || true), Next::Take(0.9));
    }

    #[test]
    fn where_none_ends_well_the_best_is_taken() {
        let mut lengths = lengths(1.0, [1.0; 3]);
        let mut length = 1.0;
        for tried in 0..=PARTS.len() {
            let least = if tried == 3 { 1e-3 } else { 5e-4 };
            match lengths.next(length, Outcome::Right(here(least)), || false) {
                Next::Try(next) => length = next,
                taken => assert_eq!((tried, taken), (PARTS.len(), Next::Take(PARTS[2]))),
            }
        }
    }

    #[test]
    fn an_end_below_the_fourth_root_of_rounding_is_none() {
        let mut lengths = lengths(1.0, [1.0; 3]);
        let mut length = 1.0;
        for _ in 0..PARTS.len() {
            let Next::Try(next) = lengths.next(length, Outcome::Right(here(1e-5)), || true) else { panic!() };
            length = next;
        }
        assert_eq!(lengths.next(length, Outcome::Right(here(1e-5)), || true), Next::GiveUp);
    }

    #[test]
    fn what_is_wrong_is_shortened_to_what_is_measured_and_then_halved() {
        let mut lengths = lengths(1.0, [1.0, 1.0, 1.1]);
        assert_eq!(lengths.next(1.1, Outcome::Wrong, || false), Next::Try(1.0));
        assert_eq!(lengths.next(1.0, Outcome::Wrong, || false), Next::Try(0.5));
        assert_eq!(lengths.next(0.5, Outcome::Right(here(0.9)), || false), Next::Take(0.5));
    }

    #[test]
    fn a_limit_does_not_keep_a_step_where_it_cannot_end() {
        let mut lengths = lengths(1.0, [0.1, 1.0, 0.1]);
        let mut length = 0.1;
        for _ in 0..PARTS.len() {
            let Next::Try(next) = lengths.next(length, Outcome::Right(here(1e-6)), || false) else {
                panic!()
            };
            length = next;
        }
        assert_eq!(lengths.next(length, Outcome::Right(here(1e-6)), || false), Next::Try(1.0));
    }

    #[test]
    fn what_nothing_bounds_is_tried_for_the_way_to_go() {
        let unknown = Independence { rank: 1, ..here(1.0) };
        let mut lengths = lengths(1.0, [1e15; 3]).on_the_way(0.25);
        let mut length = 1e15;
        for _ in 0..PARTS.len() {
            let Next::Try(next) = lengths.next(length, Outcome::Right(unknown), || false) else { panic!() };
            length = next;
        }
        assert_eq!(lengths.next(length, Outcome::Right(unknown), || false), Next::Try(0.25));
        assert_eq!(lengths.next(0.25, Outcome::Right(here(1.0)), || false), Next::Take(0.25));
    }

    #[test]
    fn parts_of_the_way_and_of_the_natural_length_are_tried_as_well() {
        let nowhere = || Outcome::Right(here(1e-6));
        let mut lengths = lengths(1.0, [8.0, 8.0, 2.0]).on_the_way(0.5);
        // Each base with its parts, and then the next base.
        for base in [2.0, 0.5, 8.0] {
            let mut length = base;
            for part in PARTS {
                let next = lengths.next(length, nowhere(), || false);
                assert_eq!(next, Next::Try(part * base), "{base}");
                length = part * base;
            }
            let next = match base {
                2.0 => Next::Try(0.5),
                0.5 => Next::Try(8.0),
                _ => Next::GiveUp,
            };
            assert_eq!(lengths.next(length, nowhere(), || false), next);
        }
    }

    #[test]
    fn an_end_is_good_enough_by_what_the_step_began_with_or_by_the_tolerance() {
        // Roundings move a velocity by ε/σ²; at 1e-10 that is the tolerance for σ = 1.5e-3.
        let of = |begun, tolerance| {
            Lengths::<f64>::new(Determined::at_start(&here(1.0)), &here(begun), tolerance, [1.0; 3])
        };
        let enough = |begun, tolerance, least| of(begun, tolerance).is_enough(&here(least));
        assert!(enough(2e-4, 1e-10, 1.1e-4) && !enough(2e-4, 1e-10, 0.9e-4));
        assert!(enough(1.0, 1e-10, 1.6e-3) && !enough(1.0, 1e-10, 1.4e-3));
        // Never below the fourth root of rounding, and never more than 1.
        assert!(enough(1.0, 1e-2, 1.3e-4) && !enough(1.0, 1e-2, 1.1e-4));
        assert!(enough(4.0, 0.0, 1.0) && !enough(4.0, 0.0, 0.99));
    }

    #[test]
    fn lengths_come_to_an_end_whatever_comes_of_them() {
        // Long steps are wrong, and short ones end where nothing is determined.
        for wrong in [0.06, 0.2, 0.6, 2.0] {
            let mut lengths = lengths(1.0, [0.1, 1.0, 0.1]);
            let (mut length, mut tried) = (0.1, 0);
            loop {
                let outcome = if length > wrong { Outcome::Wrong } else { Outcome::Right(here(1e-6)) };
                match lengths.next(length, outcome, || false) {
                    Next::Try(next) => length = next,
                    end => break assert_eq!(end, Next::GiveUp),
                }
                tried += 1;
                assert!(tried < 100, "{wrong}");
            }
        }
    }
}
