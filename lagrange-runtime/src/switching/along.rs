//! Guards along the polynomial of a step: polynomials themselves.
//!
//! In one regime guards are smooth, so each has a Taylor series along the motion. A guard that is affine in
//! the state is as exact as the polynomial of the step. The series of other guards reach only as far as they
//! converge to rounding, and are taken anew from there.

use super::guards::{Guard, Guards};
use super::reactions::Borne;
use super::scene::above;
use super::{Functions, Switching};
use crate::motion::roots::{
    Before, Fall, Kind, Side, Unresolved, Zero, clear, falls, reach, rises, stays_above,
};
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::series::taylor::{FEW, LEAST, Rounded, TERMS, Taylor, powers};
use crate::system::error::Cause;
use crate::system::method::Terms;
use crate::system::state::State;

/// The most halvings of a part of the step on which a guard has no series.
const HALVINGS: i32 = 40;

/// The most halvings of a part of the step for the sake of rounding errors alone. A guard that starts near
/// zero and changes slowly has small ones where it starts.
const CLEAREST: i32 = 20;

/// A part on which a series does not converge becomes shorter by factors between these.
const NEARER: f64 = 0.9;
const FURTHER: f64 = 1.0 / 16.0;

/// State, reactions and time along a part of a step.
#[derive(Clone, Copy)]
struct Path<R, const N: usize, const C: usize, const T: usize = TERMS> {
    t: Taylor<R, T>,
    q: [Taylor<R, T>; N],
    v: [Taylor<R, T>; N],
    reactions: [Taylor<R, T>; C],
    /// The effect of rounding errors on velocities until the end of the step, and the time of the step.
    roundings: [R; N],
    time: R,
}

/// The first guard to fall, and where.
type First<R> = (Fall<R>, Guard);

impl<R: Ordered, const N: usize, const C: usize, const T: usize> Path<R, N, C, T> {
    /// The path along the whole step, whose length has these powers, with the coordinates and velocities that
    /// are read.
    fn new(
        start: &State<R, N>,
        terms: &Terms<'_, R, N>,
        powers: &[R; TERMS],
        borne: &Borne<R, N, C>,
        [q, v]: &[[bool; N]; 2],
    ) -> Self {
        let mut whole = Self {
            t: Taylor::along(start.t, core::iter::once(terms.unit), powers),
            q: Taylor::all_along(&start.q, terms.q, powers, q),
            v: Taylor::all_along(&start.v, terms.v, powers, v),
            reactions: borne.reactions.each_ref().map(Taylor::shortened),
            roundings: borne.roundings,
            time: (terms.length * terms.unit).abs(),
        };
        whole.round(R::one());
        whole
    }

    /// The path along the part of this width from `from` on.
    fn on(&self, from: R, width: R) -> Self {
        let on = |x: &Taylor<R, T>| x.on(from, width);
        let mut part = Self {
            t: on(&self.t),
            q: self.q.each_ref().map(on),
            v: self.v.each_ref().map(on),
            reactions: self.reactions.each_ref().map(on),
            ..*self
        };
        part.round(from + width);
        part
    }

    /// Adds the effect of rounding errors of the forces on the state until this part of the step has passed.
    fn round(&mut self, reach: R) {
        let half = R::from_f64(0.5);
        for (i, &rounding) in self.roundings.iter().enumerate() {
            self.v[i].error += rounding * reach;
            self.q[i].error += half * self.time * rounding * reach * reach;
        }
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The first guard that falls through zero along a step, and the part of the step that has passed then,
    /// to the rounding errors of its polynomial. The guard `fired` is zero where the step starts. Each part
    /// that is examined by itself is one of the `attempts`.
    pub(super) fn first_along(
        &mut self,
        [start, end]: [&State<S::Scalar, N>; 2],
        terms: &Terms<'_, S::Scalar, N>,
        fired: Option<Guard>,
        relative: S::Scalar,
        attempts: &mut u64,
    ) -> Result<Option<First<S::Scalar>>, Cause> {
        let powers = powers(terms.length);
        let mut borne = self.borne(start, terms, &powers, relative);
        self.reacts_along = borne.is_known;
        if self.along().next().is_none() {
            return Ok(None);
        }
        let (zero, one): (S::Scalar, S::Scalar) = (num_traits::Zero::zero(), num_traits::One::one());
        let fallen = self.fallen(end);
        // The shortest polynomials can only show that a guard keeps away from zero.
        if fired.is_none() && fallen == 0 {
            self.glance(&Path::<_, N, C, LEAST>::new(start, terms, &powers, &borne, &S::GUARDED), fired);
        }
        // A guard that has fallen at the end of the step needs the time of its fall.
        if self.along().nth(fallen).is_some() {
            self.glance(&Path::<_, N, C, FEW>::new(start, terms, &powers, &borne, &S::GUARDED), fired);
        }
        if self.along().next().is_none() {
            return Ok(None);
        }
        if !self.has_reactions() {
            borne.reactions = [Taylor::constant(zero); C];
        }
        let half = S::Scalar::from_f64(0.5);
        let shortest = half.powi(HALVINGS);
        let clearest = half.powi(CLEAREST);
        let path = Path::new(start, terms, &powers, &borne, &S::GUARDED);
        let (mut from, mut width) = (zero, one);
        loop {
            let cut;
            let part = if width == one {
                &path
            } else {
                *attempts = attempts.checked_sub(1).ok_or(Cause::TooManySteps)?;
                cut = path.on(from, width);
                &cut
            };
            let guarded = self.along_part(part);
            let mut converged = one;
            for guard in self.along() {
                let series = guarded.get(guard);
                let is_finite = series.is_finite() && series.error.is_finite();
                converged = smaller(converged, if is_finite { reach(series) } else { zero });
            }
            if converged >= one && !self.agrees(part, &guarded) {
                converged = zero;
            }
            if converged < one {
                if width > shortest {
                    // It is shorter than necessary, so that the rounding errors of the next series ask for no
                    // more.
                    width *= larger(converged * S::Scalar::from_f64(NEARER), S::Scalar::from_f64(FURTHER));
                    continue;
                }
                from = self.beyond(&path, from, shortest).ok_or(Unresolved::NotFinite.cause())?;
                width = one - from;
                if from >= one {
                    return Ok(None);
                }
                continue;
            }
            if self.along().all(|guard| stays_above(guarded.get(guard))) {
                from += width;
                if one - from <= S::Scalar::epsilon() {
                    return Ok(None);
                }
                width = smaller(width + width, one - from);
                continue;
            }
            if width > clearest {
                let starts = self.at_place(part, Taylor::start);
                let parts = self.along().map(|guard| clear(guarded.get(guard), starts.get(guard).error));
                let part = parts.fold(one, smaller);
                if part < one {
                    width *= part;
                    continue;
                }
            }
            let mut earliest: Option<First<S::Scalar>> = None;
            for guard in self.along() {
                let series = guarded.get(guard);
                let begins = from == zero && self.begins_at_zero(guard, series, fired);
                let before = if begins { Before::Zero } else { Before::Unknown };
                if let Some(fall) = falls(series, before)
                    && earliest.is_none_or(|(other, _)| fall.place < other.place)
                {
                    earliest = Some((fall, guard));
                }
            }
            if let Some((Fall { place, fallen }, guard)) = earliest {
                let [place, fallen] = [place, fallen].map(|place| from + place * width);
                return Ok(Some((Fall { place, fallen }, guard)));
            }
            from += width;
            // A remainder that is a rounding error is no part of a step.
            if one - from <= S::Scalar::epsilon() {
                return Ok(None);
            }
            width = smaller(width + width, one - from);
        }
    }

    /// The part of the step where a guard itself is zero beside a fall of its polynomial. The polynomial has
    /// the rounding errors of the whole part of the step that it is taken on. The place stays as it is where
    /// the guard is within the rounding errors of its own value, or does not change its sign as the
    /// polynomial does. `sizes` bound the summands of the state there.
    pub(super) fn at_zero(
        &self,
        guard: Guard,
        fall: Fall<S::Scalar>,
        sizes: &State<S::Scalar, N>,
        mut at: impl FnMut(S::Scalar) -> Option<State<S::Scalar, N>>,
    ) -> S::Scalar {
        let half = S::Scalar::from_f64(0.5);
        let Fall { place, fallen } = fall;
        let mut value = |place: S::Scalar| {
            let nothing = Rounded::value(S::Scalar::from_f64(f64::NAN));
            at(place).map_or(nothing, |state| self.value(guard, &state, sizes))
        };
        let there = value(place);
        // No place is before a start, and a guard that is NaN has no better place.
        if place == num_traits::Zero::zero() || !above(there.start().abs(), there.error) {
            return place;
        }
        // The start is excluded: a guard that was zero there is zero there again.
        let bracket = [half * place, larger(place, fallen)];
        let zero = Zero { theta: place, kind: Kind::Falling, side: Side::Below, bracket };
        zero.polish(|place| value(place).start())
    }

    /// Stops watching guards that do not come near zero on the whole of the step, as far as polynomials of
    /// low order bound them. The guard `fired` is zero where the step starts.
    fn glance<const T: usize>(&mut self, path: &Path<S::Scalar, N, C, T>, fired: Option<Guard>) {
        let functions = self.along_part(path);
        for guard in (0..C).map(Guard::Row).chain((0..W).map(Guard::Kink)) {
            if !self.along().any(|other| other == guard) {
                continue;
            }
            let bound = functions.get(guard);
            let begins = self.begins_at_zero(guard, bound, fired);
            let before = if begins { Before::Zero } else { Before::Unknown };
            if bound.is_whole && (stays_above(bound) || rises(bound, before)) {
                self.pass(guard);
            }
        }
    }

    /// The number of gaps, slips and kinks that are below zero at the end of the step.
    fn fallen(&self, end: &State<S::Scalar, N>) -> usize {
        let zero: S::Scalar = num_traits::Zero::zero();
        let guarded = self.guarded(|x| x, end.t, [&end.q, &end.v], &[zero; C]);
        let is_reaction = |guard| matches!(guard, Guard::Row(row) if self.is_reaction(row));
        self.along().filter(|&guard| !is_reaction(guard) && *guarded.get(guard) < zero).count()
    }

    /// The guards along a part of the step.
    fn along_part<const T: usize>(
        &self,
        part: &Path<S::Scalar, N, C, T>,
    ) -> Functions<Taylor<S::Scalar, T>, C, W> {
        self.guarded(Taylor::constant, part.t, [&part.q, &part.v], &part.reactions).plain()
    }

    /// The guards at one end of it, with the rounding errors of the whole.
    fn at_place(
        &self,
        part: &Path<S::Scalar, N, C>,
        place: impl Fn(&Taylor<S::Scalar>) -> S::Scalar,
    ) -> Functions<Rounded<S::Scalar>, C, W> {
        let known = |x: &Taylor<S::Scalar>| {
            let mut known = Rounded::constant(place(x));
            known.error = x.error;
            known
        };
        let (q, v) = (part.q.each_ref().map(known), part.v.each_ref().map(known));
        let reactions = part.reactions.each_ref().map(known);
        self.guarded(Taylor::constant, known(&part.t), [&q, &v], &reactions).plain()
    }

    /// Whether the series of all guards have the right values at the end: the series of the root of a square
    /// does not show the kink at its zero.
    fn agrees(&self, part: &Path<S::Scalar, N, C>, guarded: &Functions<Taylor<S::Scalar>, C, W>) -> bool {
        if self.along().all(|guard| guarded.get(guard).is_whole) {
            return true;
        }
        let values = self.at_place(part, Taylor::end);
        self.along().all(|guard| {
            let (series, value) = (guarded.get(guard), values.get(guard));
            let summed = S::Scalar::from_f64(2.0 * series.degree as f64) * S::Scalar::epsilon();
            let bound = series.error + value.error + summed * series.extent();
            // A guard that is NaN at the end is no reason to try a shorter part.
            let difference = (series.end() - value.start()).abs();
            difference <= bound || !difference.is_finite()
        })
    }

    /// The end of a part too short to matter, on which a guard has no series. The distance from a centre has
    /// none there, for example. `None` where a guard may be zero in it.
    fn beyond(&self, path: &Path<S::Scalar, N, C>, from: S::Scalar, length: S::Scalar) -> Option<S::Scalar> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let mut to = from;
        for _ in 0..HALVINGS {
            to = to + length + (to - from);
            let sides = [from - length, to].map(|place| self.along_part(&path.on(place, length)));
            let are_known = |guarded: &Functions<Taylor<S::Scalar>, C, W>| {
                self.along().all(|guard| {
                    let series = guarded.get(guard);
                    series.is_finite() && reach(series) == num_traits::One::one()
                })
            };
            if !sides.iter().all(are_known) {
                continue;
            }
            // Each guard is so far from zero that many such parts would not bring it there.
            let is_clear = self.along().all(|guard| {
                sides.iter().all(|guarded| {
                    let series = guarded.get(guard);
                    let change = (series.extent() - series.start().abs()) * ((to - from) / length);
                    series.start() > zero && series.start() > S::Scalar::from_f64(64.0) * change
                })
            });
            return is_clear.then_some(to);
        }
        None
    }

    /// Whether a guard is zero where the step starts, whatever its series says: the guard that has fired, and
    /// a gap or a reaction with which a regime begins. It has been decided that these are not below zero.
    fn begins_at_zero<const T: usize>(
        &self,
        guard: Guard,
        series: &Taylor<S::Scalar, T>,
        fired: Option<Guard>,
    ) -> bool {
        let is_held = matches!(guard, Guard::Row(row)
            if S::ROWS[row] == super::Row::Unilateral || self.is_reaction(row));
        fired == Some(guard) || is_held && series.start() < num_traits::Zero::zero()
    }
}
