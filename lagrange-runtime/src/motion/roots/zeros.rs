//! The walk over the pieces of a step that counts each zero once.

use super::pieces::{FLAT, Piece, Pieces};
use super::{Kind, Memory, Polynomial, Side, Zero, bracket};
use crate::number::real::Ordered;

/// Parts of a bracket at whose ends the lowest value of a grazing guard is looked for first.
const SCAN: u8 = 8;

/// How the walk has entered the set of points within the noise that it is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Entry {
    /// From a certain point of this step.
    Inside,
    /// At θ = 0, with this memory.
    Start(Memory),
}

/// The zeros of a polynomial from left to right.
///
/// Once it has returned `None`, [`Zeros::memory`] is what is known at the end.
#[derive(Clone, Debug)]
pub(crate) struct Zeros<R> {
    pieces: Pieces<R>,
    /// The last certain side, if there was one.
    before: Option<Side>,
    /// The last certain point.
    certain: R,
    /// If the walk is within the noise: how it came there.
    entry: Option<Entry>,
    queued: Option<Zero<R>>,
    memory: Option<Memory>,
}

impl<R: Ordered> Zeros<R> {
    pub(super) fn new(polynomial: &Polynomial<R>, start: Memory, until: R) -> Self {
        let (before, inside) = match start {
            Memory::Unknown => (None, true),
            Memory::Side(side) => (Some(side), false),
            Memory::Touching(side) => (Some(side), true),
            Memory::Zero(side) => (side, true),
        };
        let mut zeros = Self {
            pieces: Pieces::new(polynomial, start, until),
            before,
            certain: R::zero(),
            entry: inside.then_some(Entry::Start(start)),
            queued: None,
            memory: None,
        };
        if let Memory::Side(_) = start
            && zeros.pieces.side(R::zero()).is_none()
        {
            zeros.entry = Some(Entry::Start(start));
        }
        zeros
    }

    /// The knowledge at the end of the walk, for the next step if it starts there.
    pub(crate) fn memory(&self) -> Memory {
        self.memory.unwrap_or(Memory::Unknown)
    }

    fn value(&self, theta: R) -> R {
        self.pieces.polynomial.value(theta)
    }

    /// The next point of the walk, with its side.
    fn meet(&mut self, point: R, side: Option<Side>) -> Option<Zero<R>> {
        let Some(side) = side else {
            self.entry = self.entry.or(Some(Entry::Inside));
            return None;
        };
        let entry = self.entry.take();
        let low = self.certain;
        self.certain = point;
        let before = match entry {
            Some(Entry::Start(Memory::Unknown)) if point > R::zero() => self.beyond(R::zero(), -R::one()),
            _ => self.before,
        };
        self.before = Some(side);
        let counts = match (entry, before) {
            (None, before) => before.is_some_and(|before| before != side),
            (Some(Entry::Inside), _) => true,
            // Certain again at once, and on the way to zero: it was the noise of the step before that ended.
            (Some(Entry::Start(Memory::Touching(_))), before) => {
                point > R::zero() || before != Some(side) || !self.approaches(side)
            }
            (Some(Entry::Start(Memory::Unknown)), _) => point > R::zero(),
            (Some(Entry::Start(Memory::Zero(_))), before) => before.is_some_and(|before| before != side),
            // A guard that moves away from zero has not touched it here.
            (Some(Entry::Start(Memory::Side(_))), before) => before != Some(side) || self.approaches(side),
        };
        let counted = matches!(entry, Some(Entry::Start(Memory::Zero(_))));
        let zero = counts.then(|| self.zero([low, point], before.unwrap_or(side), side, counted))?;
        // A guard that crosses zero as flatly as the cube of another one does hovers about the edge of the
        // noise. What does not come in further has touched nothing.
        let hovers = entry == Some(Entry::Inside)
            && zero.kind == Kind::Grazing
            && side.towards(self.value(zero.theta)) > self.pieces.noise * R::from_f64(1.0 - 2.0 * FLAT);
        (!hovers).then_some(zero)
    }

    /// Whether the guard, on this side, goes towards zero at the start.
    fn approaches(&self, side: Side) -> bool {
        side.towards(self.pieces.polynomial.slope().value(R::zero())) < R::zero()
    }

    /// The zero between two points, from one side to another; behind θ = 0 where that has been counted.
    fn zero(&self, bracket: [R; 2], before: Side, side: Side, counted: bool) -> Zero<R> {
        let [low, high] = bracket;
        let (kind, theta) = if before == side {
            (Kind::Grazing, self.nearest(side, low, high))
        } else {
            let kind = match side {
                Side::Below => Kind::Falling,
                Side::Above => Kind::Rising,
            };
            let theta = if counted {
                let rest = self.pieces.polynomial.divided();
                root(|theta| side.towards(rest.value(theta)), low, high)
            } else {
                root(|theta| side.towards(self.value(theta)), low, high)
            };
            (kind, theta)
        };
        Zero { theta, kind, side, bracket }
    }

    /// Where the guard, on this side of zero at two points, is lowest between them.
    fn nearest(&self, side: Side, low: R, high: R) -> R {
        let width = (high - low) / R::from_f64(f64::from(SCAN));
        let point = |i: u8| if i < SCAN { low + width * R::from_f64(f64::from(i)) } else { high };
        let mut lowest = (0, side.towards(self.value(low)));
        for i in 1..=SCAN {
            let value = side.towards(self.value(point(i)));
            if value < lowest.1 {
                lowest = (i, value);
            }
        }
        let (left, right) = (point(lowest.0.saturating_sub(1)), point(SCAN.min(lowest.0 + 1)));
        let slope = self.pieces.polynomial.slope();
        let theta = root(|theta| side.towards(slope.value(theta)), left, right);
        // The zero of the slope is the better place where the values do not decide.
        let bound = lowest.1 + self.pieces.polynomial.noise() * R::from_f64(0.25);
        if side.towards(self.value(theta)) <= bound { theta } else { point(lowest.0) }
    }

    /// The side of the polynomial shortly before (−1) or after (+1) a point, as far as it may be extended.
    fn beyond(&self, point: R, ahead: R) -> Option<Side> {
        let two = R::from_f64(2.0);
        let degree = R::from_f64(self.pieces.polynomial.degree().max(1) as f64);
        // Chebyshev polynomials of degree n grow to cosh 2 at 1/n² outside, and so do the neglected terms.
        let most = (degree * degree).recip();
        let mut distance = R::epsilon() * two;
        while distance < most {
            let side = self.pieces.sign(self.value(point + ahead * distance), two * two);
            if side.is_some() {
                return side;
            }
            distance *= two;
        }
        None
    }

    /// The end of the walk.
    fn finish(&mut self) -> Option<Zero<R>> {
        let until = self.pieces.until;
        let side = self.before;
        let (memory, zero) = match (self.entry, side) {
            (None, None) => (Memory::Unknown, None),
            (None, Some(side)) => (Memory::Side(side), None),
            (Some(Entry::Inside), Some(before)) => match self.beyond(until, R::one()) {
                // A crossing a little behind the end is found more exactly by the next step.
                Some(side)
                    if side == before
                        || before.towards(self.value(until)) <= self.pieces.noise * R::from_f64(0.5) =>
                {
                    let zero = self.zero([self.certain, until], before, side, false);
                    (zero.memory(), Some(zero))
                }
                _ => (Memory::Touching(before), None),
            },
            (Some(Entry::Inside), None) => (Memory::Unknown, None),
            (Some(Entry::Start(Memory::Side(side))), _) if self.approaches(side) => {
                (Memory::Touching(side), None)
            }
            (Some(Entry::Start(memory)), _) => (memory, None),
        };
        self.memory = Some(memory);
        zero
    }
}

impl<R: Ordered> Iterator for Zeros<R> {
    type Item = Zero<R>;

    fn next(&mut self) -> Option<Zero<R>> {
        loop {
            if self.memory.is_some() {
                return None;
            }
            if self.queued.is_some() {
                return self.queued.take();
            }
            let Some(Piece { ends: [low, high], sides: [at_low, at_high], certain }) = self.pieces.next()
            else {
                return self.finish();
            };
            let first = self.meet(low, at_low);
            if certain {
                self.certain = high;
            }
            let second = self.meet(high, at_high);
            if first.is_some() {
                self.queued = second;
                return first;
            }
            if second.is_some() {
                return second;
            }
        }
    }
}

/// The root of a function that goes from negative to positive between two points; otherwise the nearer end.
fn root<R: Ordered>(f: impl Fn(R) -> R, low: R, high: R) -> R {
    let (below, above) = (f(low), f(high));
    if below >= R::zero() {
        low
    } else if above <= R::zero() {
        high
    } else {
        bracket::solve(f, (low, below), (high, above))
    }
}
