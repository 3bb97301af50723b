//! Coefficients of restitution and friction: whether they have a meaning.

use super::guards::PLACES;
use super::place::Event;
use super::run::Run;
use super::scene::{Scene, Status, above, against, entry, most, rounding};
use super::way::is_beyond_rounding;
use super::{Coefficients, Laws, Row, Switching};
use crate::motion::roots::{Kind, Memory, Polynomial, Side, Unresolved};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The most halvings of a step, as part of it, on which a coefficient is no polynomial.
const HALVINGS: i32 = 24;

/// The event that ends a piece, if any.
pub(super) type Found<S, const N: usize, const K: usize, const C: usize, const W: usize> =
    Option<Event<<S as System<N, K>>::Scalar, N, W>>;

/// Refuses a restitution outside 0 … 1, a friction below zero, and one that holds less at rest than it gives
/// when it slips, in the rows that `acts` tells. `scales` are the largest coefficients of friction that the
/// motion has had: where one falls to zero, its rounding errors are those of its summands.
pub(super) fn valid<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    laws: &Laws<S::Scalar, C, W>,
    coefficients: &[Coefficients<S::Scalar, C>; 2],
    scales: &[S::Scalar; C],
    acts: impl Fn(usize) -> bool,
) -> Result<(), Cause>
where
    S: Switching<N, K, C, W>,
{
    let (zero, one): (S::Scalar, S::Scalar) = (num_traits::Zero::zero(), num_traits::One::one());
    for (row, kind) in S::ROWS.iter().enumerate().filter(|(row, _)| acts(*row)) {
        // Bounds are those of the coefficient itself. Its derivatives may have any value.
        let e = entry(&laws.restitution, row).part(0);
        // A friction that slips has one direction.
        let slip = entry(&laws.rows.rates, row);
        let is_one = above(slip.abs(), rounding::<S::Scalar>() * entry(&laws.rows.rate_sizes, row));
        let is_valid = |Coefficients { kinetic, fixed }: &Coefficients<S::Scalar, C>| {
            let (kinetic, fixed) = (entry(kinetic, row).part(0), entry(fixed, row).part(0));
            let lost = rounding::<S::Scalar>() * most(entry(scales, row), fixed);
            // Guards have the squares of coefficients.
            !above(-lost, kinetic) && !above(kinetic - lost, fixed) && (fixed * fixed + kinetic).is_finite()
        };
        let is_good = match kind {
            Row::Bilateral | Row::Load => true,
            Row::Unilateral => !above(zero, e) && !above(e, one) && e.is_finite(),
            Row::Friction { .. } if is_one => is_valid(against(coefficients, slip)),
            Row::Friction { .. } => coefficients.iter().all(is_valid),
        };
        if !is_good {
            return Err(invalid::<S, N, K, C, W>(row));
        }
    }
    Ok(())
}

/// The cause of the error of a row without a meaning.
fn invalid<S, const N: usize, const K: usize, const C: usize, const W: usize>(row: usize) -> Cause
where
    S: Switching<N, K, C, W>,
{
    Cause::InvalidContact { constraint: row, name: S::NAMES.constraint(row) }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// Refuses a state where a gap that is closed has no gradient.
    pub(super) fn has_gradients(&self) -> Result<(), Cause> {
        let known = self.gradients.iter().zip(&self.laws.rows.rates);
        let is_known =
            known.map(|(gradient, rate)| rate.is_finite() && gradient.iter().all(|x| x.is_finite()));
        match self.is_closed.iter().zip(is_known).position(|(&is_closed, is_known)| is_closed && !is_known) {
            Some(row) => Err(Cause::VanishingGradient { constraint: row, name: S::NAMES.constraint(row) }),
            None => Ok(()),
        }
    }

    /// Looks at the coefficients of contacts that are closed, where an impact needs them.
    pub(super) fn can_collide(&self, scales: &[S::Scalar; C]) -> Result<(), Cause> {
        let acts = |row: usize| self.status.get(row) != Some(&Status::Apart);
        valid::<S, N, K, C, W>(&self.laws, &self.coefficients, scales, acts)
    }
}

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// The event that ends the piece, or none; where the coefficients of a slip lose their meaning before,
    /// the end of the part on which they have one. A friction that sticks begins to slip before its limit is
    /// negative.
    ///
    /// # Errors
    /// [`Cause::InvalidContact`] where they have none from the start.
    pub(super) fn valid_until(&mut self, found: Found<S, N, K, C, W>) -> Result<Found<S, N, K, C, W>, Cause> {
        let none: S::Scalar = num_traits::Zero::zero();
        let (start, step) = (self.memory.start, self.memory.end);
        if !S::VARYING || self.memory.regime.slip.iter().all(|slip| *slip == none) || step.t == start.t {
            return Ok(found);
        }
        let end = found.as_ref().map_or(step.t, |event| event.state.t);
        let share = (end - start.t) / (step.t - start.t);
        let mut first = None;
        let slips = self.memory.regime.slip;
        for row in (0..C).filter(|&row| entry(&slips, row) != none) {
            let until = first.map_or(share, |(part, _)| part);
            let doubtful = self.doubtful(row, until)?;
            for (which, _) in doubtful.into_iter().enumerate().filter(|(_, is_doubtful)| *is_doubtful) {
                let until = first.map_or(share, |(part, _)| part);
                if let Some(part) = self.falls(row, which, until)? {
                    first = Some((part, row));
                }
            }
        }
        let Some((part, row)) = first else { return Ok(found) };
        let (cause, state) = (invalid::<S, N, K, C, W>(row), self.within(part)?);
        // Time does not resolve the end of a slip exactly, and beyond it the law may be above its value at
        // rest.
        if found.as_ref().is_some_and(|event| !is_beyond_rounding(event.state.t, state.t)) {
            return Ok(found);
        }
        if !is_beyond_rounding(start.t, state.t) {
            return Err(cause);
        }
        // The motion is known until there, and no further.
        self.memory.stuck = Some(cause);
        Ok(Some(Event::cut(state)))
    }

    /// Which bounds of a slip may be zero up to a part of the step: between two of a few places they change
    /// by as much as they are. A force that oscillates between these places makes steps shorter.
    fn doubtful(&mut self, row: usize, until: S::Scalar) -> Result<[bool; 2], Cause> {
        // Where they change by half of that at most, every second place is enough.
        let doubtful = self.doubtful_at(row, until, PLACES.iter().skip(1).step_by(2), 2.0)?;
        if doubtful == [false; 2] {
            return Ok(doubtful);
        }
        self.doubtful_at(row, until, PLACES.iter(), 1.0)
    }

    /// The same at these places, where a bound may be zero if it is `times` such a change at most.
    #[inline(never)]
    fn doubtful_at(
        &mut self,
        row: usize,
        until: S::Scalar,
        places: impl Iterator<Item = &'static f64>,
        times: f64,
    ) -> Result<[bool; 2], Cause> {
        let none: S::Scalar = num_traits::Zero::zero();
        let first = self.bounds_at(row, none)?;
        let (mut last, mut least, mut most) = (first, first, [none; 2]);
        for &place in places {
            let bounds = self.bounds_at(row, S::Scalar::from_f64(place) * until)?;
            let known = least.iter_mut().zip(&mut most).zip(last.iter().zip(&bounds));
            for ((least, most), (&last, &bound)) in known {
                if !bound.is_finite() {
                    return Err(Cause::NotFinite);
                }
                (*least, *most) = (smaller(*least, bound), larger(*most, (bound - last).abs()));
            }
            last = bounds;
        }
        // Where the coefficient at rest is that of the slip, the second bound is zero everywhere.
        let may_vanish = |least: S::Scalar, change: S::Scalar| {
            least < none || least <= S::Scalar::from_f64(times) * change && change > none
        };
        Ok(array(|which| may_vanish(least[which], most[which])))
    }

    /// The part of the step, up to `until`, after which a bound of a slip is below zero by more than its
    /// rounding errors.
    ///
    /// Rounding errors inside of a coefficient do not show in its size, as in 1 + cos t beside t = π. They
    /// show where no polynomial fits it, however short the part is: then they are what its values there
    /// differ by.
    #[inline(never)]
    fn falls(&mut self, row: usize, which: usize, until: S::Scalar) -> Result<Option<S::Scalar>, Cause> {
        let none: S::Scalar = num_traits::Zero::zero();
        let mut shortest = S::Scalar::from_f64(0.5).powi(HALVINGS) * until;
        let scale = entry(&self.memory.scales.coefficients, row);
        let mut lost = rounding::<S::Scalar>() * scale;
        let (mut from, mut width) = (none, until);
        while from < until {
            let here = entry(&self.bounds_at(row, from)?, which);
            if here + lost < none {
                return Ok(Some(from));
            }
            width = smaller(width, until - from);
            let nan = S::Scalar::from_f64(f64::NAN);
            let (mut least, mut largest) = (here, here);
            // Its noise is then a quarter of what is lost, if that of its slope is no more.
            let size = lost / (S::Scalar::from_f64(32.0) * S::Scalar::epsilon());
            let bound = Polynomial::interpolate(size, |place| {
                let bound = self.bounds_at(row, from + place * width);
                let bound = bound.map_or(nan, |bounds| entry(&bounds, which));
                (least, largest) = (smaller(least, bound), larger(largest, bound));
                bound + lost
            });
            match bound {
                Ok(bound) if bound.noise() + bound.noise() > lost => {
                    lost = S::Scalar::from_f64(4.0) * bound.noise();
                    continue;
                }
                Ok(bound) => {
                    if let Some(zero) = bound.first(Kind::Falling, Memory::Side(Side::Above)) {
                        return Ok(Some(from + zero.theta * width));
                    }
                }
                Err(_) if width > shortest => {
                    width *= S::Scalar::from_f64(0.5);
                    continue;
                }
                Err(Unresolved::Degree) => {
                    let more = larger(lost, largest - least);
                    if more < S::Scalar::epsilon().sqrt() * scale {
                        (lost, width) = (S::Scalar::from_f64(4.0) * more, until - from);
                        continue;
                    }
                    // A coefficient with a kink at the end of the slip has no polynomial there. One that
                    // consists of rounding errors, as of a time far from zero, has none anywhere: parts that
                    // grow pass over it.
                    shortest = shortest + shortest;
                }
                Err(why) => return Err(why.cause()),
            }
            (from, width) = (from + width, width + width);
        }
        Ok(None)
    }

    /// What must not be below zero in a slip after a part of the step: its coefficient, and the coefficient
    /// at rest less this.
    fn bounds_at(&mut self, row: usize, part: S::Scalar) -> Result<[S::Scalar; 2], Cause> {
        let State { t, q, v } = self.within(part)?;
        let (inputs, memory) = (&self.control.0, &mut *self.memory);
        let laws = self.system.laws_at(t, &q, &v, inputs);
        let coefficients = S::coefficients_in(&memory.in_regime, t, &q, &v, inputs, &laws);
        let own = against(&coefficients, entry(&memory.regime.slip, row));
        let [kinetic, fixed] = [&own.kinetic, &own.fixed].map(|numbers| entry(numbers, row).part(0));
        if let Some(seen) = memory.scales.coefficients.get_mut(row) {
            *seen = larger(*seen, smaller(kinetic, fixed));
        }
        Ok([kinetic, fixed - kinetic])
    }

    /// The state at a part of the step.
    fn within(&mut self, part: S::Scalar) -> Result<State<S::Scalar, N>, Cause> {
        let memory = &mut *self.memory;
        if part == num_traits::One::one() {
            return Ok(memory.end);
        }
        let (in_regime, constants) = (&memory.in_regime, &memory.constants);
        let state = M::within(&mut memory.inner, in_regime, constants, self.control, self.limits, part);
        state.map_err(|error| error.cause)
    }
}
