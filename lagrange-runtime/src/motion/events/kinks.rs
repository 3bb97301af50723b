//! Kinks and jumps of a guard.
//!
//! A guard such as min(f, c) may be constant at all places at which it is sampled, and pass zero twice
//! between two of them. What it has its kinks at the zeros of is smooth: an interval is cut at the first of
//! these.

use super::Guard;
use super::interval::{Interval, POINTS, Watched};
use super::track::{Refused, begin};
use crate::motion::roots::{Kind, Polynomial};
use crate::number::real::{Ordered, Real, smaller};
use crate::system::System;
use crate::system::control::Control;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// A function that has a zero where a guard has a kink.
struct KinkOf<'a, G> {
    guard: &'a G,
    kink: usize,
}

impl<S, G: Guard<S, R, N>, R: Real, const N: usize> Guard<S, R, N> for KinkOf<'_, G> {
    fn value(&self, system: &S, state: &State<R, N>) -> R {
        self.guard.kink(system, state, self.kink).unwrap_or(R::from_f64(f64::NAN))
    }
}

impl<S, C, M, G, const N: usize, const K: usize> Watched<'_, '_, S, C, M, G, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
    G: Guard<S, S::Scalar, N>,
{
    /// Refuses an interval that has a kink or a jump of the guard inside, further than a `resolution` of time
    /// from its ends.
    pub fn has_no_kinks(
        &mut self,
        interval: Interval<S::Scalar>,
        states: &[State<S::Scalar, N>; POINTS],
        resolution: S::Scalar,
    ) -> Result<(), Refused<S::Scalar>> {
        let one: S::Scalar = num_traits::One::one();
        let mut first = one;
        let mut unresolved = None;
        let mut kink = 0;
        while self.guard.kink(self.motion.system, &states[0], kink).is_some() {
            let guard = &KinkOf { guard: self.guard, kink };
            let mut watched = Watched { motion: &mut *self.motion, guard };
            let mut error = None;
            let mut at = |watched: &mut Watched<'_, '_, S, C, M, _, N, K>, theta| {
                watched.at_time(interval.time(theta), &mut error)
            };
            let far = watched.sizes(states).far;
            match Polynomial::interpolate(far, |theta| at(&mut watched, theta)) {
                Ok(polynomial) => {
                    let length = (interval.to - interval.from).abs();
                    let memory = begin(polynomial.value(num_traits::Zero::zero()), polynomial.noise());
                    let crossings = polynomial.zeros(memory, one).filter(|zero| zero.kind != Kind::Grazing);
                    let mut inside = crossings
                        .map(|zero| zero.polish(|theta| at(&mut watched, theta)))
                        .filter(|&theta| theta * length > resolution && (one - theta) * length > resolution);
                    first = inside.next().map_or(first, |theta| smaller(first, theta));
                }
                Err(cause) => unresolved = Some(cause),
            }
            if let Some(error) = error {
                return Err(Refused::Failed(error));
            }
            kink += 1;
        }
        match unresolved {
            _ if first < one => Err(Refused::Beyond(first)),
            Some(cause) => Err(Refused::TooLong(cause)),
            None => Ok(()),
        }
    }
}
