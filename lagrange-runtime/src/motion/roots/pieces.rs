//! A step cut into pieces on which the signs at both ends tell everything.

use super::polynomial::{DEGREE, Polynomial, derivative};
use super::{Memory, Side};
use crate::number::elements::Each;
use crate::number::real::Ordered;

/// How often a step is halved at most. The noise ends it much earlier.
const LEVELS: usize = 60;

/// The part of the noise up to which a piece is constant: roundings of the sum of a polynomial are no larger.
pub(super) const FLAT: f64 = 0.125;

/// A part of the step where the polynomial is monotone, or within the noise, or certain.
pub(super) struct Piece<R> {
    pub(super) ends: [R; 2],
    /// The certain sides of the ends.
    pub(super) sides: [Option<Side>; 2],
    /// Whether the polynomial has this side everywhere on the piece.
    pub(super) certain: bool,
}

/// The pieces of [0, `until`] from left to right.
#[derive(Clone, Debug)]
pub(super) struct Pieces<R> {
    /// The polynomial; its value at θ = 0 is zero where that zero has been counted.
    pub(super) polynomial: Polynomial<R>,
    /// The noise before that.
    pub(super) noise: R,
    pub(super) until: R,
    /// The next piece to try: how often the step has been halved for it, and which of the parts it is. `None`
    /// at the end.
    place: Option<(usize, u64)>,
    /// The degrees of the halves that contain it, largest first.
    degrees: [u8; LEVELS + 1],
}

impl<R: Ordered> Pieces<R> {
    pub(super) fn new(polynomial: &Polynomial<R>, start: Memory, until: R) -> Self {
        // A zero at θ = 0 that has been counted is made exact.
        let counted = matches!(start, Memory::Zero(_));
        let noise = polynomial.noise();
        let polynomial = if counted { polynomial.deflated() } else { *polynomial };
        let place = (until > R::zero()).then_some((0, 0));
        Self { polynomial, noise, until, place, degrees: [DEGREE as u8; LEVELS + 1] }
    }

    /// The side of a point, if it is certain.
    pub(super) fn side(&self, theta: R) -> Option<Side> {
        self.sign(self.polynomial.value(theta), R::one())
    }

    /// The side of a value, if its size exceeds the noise by the factor `times`.
    pub(super) fn sign(&self, value: R, times: R) -> Option<Side> {
        let bound = self.polynomial.noise() * times;
        if value > bound {
            Some(Side::Above)
        } else if value < -bound {
            Some(Side::Below)
        } else {
            None
        }
    }

    /// The point with this number after halving so often.
    fn point(&self, level: usize, number: u64) -> R {
        self.until * (R::from_f64(number as f64) * R::from_f64(0.5).powi(level as i32))
    }

    /// The piece from `low` to `high`, unless it has to be halved, and the degree there.
    fn examine(&self, level: usize, low: R, high: R) -> (Option<Piece<R>>, u8) {
        let whole = level == 0 && self.until == R::one();
        let width = high - low;
        let (local, degree) = if whole {
            let mut all = [R::zero(); DEGREE + 1];
            for (to, &from) in all.iter_mut().zip(self.polynomial.coefficients()) {
                *to = from;
            }
            (all, self.polynomial.degree())
        } else {
            let above = level.checked_sub(1).and_then(|above| self.degrees.get(above));
            let above = above.map_or(DEGREE, |&degree| usize::from(degree));
            self.polynomial.on(low, width, above.min(self.polynomial.degree()))
        };
        let coefficients = local.get(..=degree).unwrap_or(&local);
        let (middle, reach) = extent(coefficients);
        let noise = self.polynomial.noise();
        let ends = [low, high];
        let piece = if middle.abs() > reach + noise {
            let side = self.sign(middle, R::one());
            Some(Piece { ends, sides: [side; 2], certain: true })
        } else if middle.abs() + reach <= noise {
            Some(Piece { ends, sides: [None; 2], certain: false })
        } else if reach <= noise * R::from_f64(FLAT) {
            // At the edge of the noise, halves of it would not tell more.
            let side = self.sign(middle, R::one());
            Some(Piece { ends, sides: [side; 2], certain: side.is_some() })
        } else {
            let (slopes, degree) = derivative(coefficients);
            let (slope, variation) = extent(&slopes[..=degree]);
            let between = low + width * R::from_f64(0.5);
            let smallest = level >= LEVELS || between <= low || between >= high;
            let monotone = slope.abs() >= variation || smallest;
            monotone.then(|| Piece { ends, sides: ends.each(|end| self.side(end)), certain: false })
        };
        (piece, degree as u8)
    }
}

impl<R: Ordered> Iterator for Pieces<R> {
    type Item = Piece<R>;

    fn next(&mut self) -> Option<Piece<R>> {
        loop {
            let (level, number) = self.place?;
            let (low, high) = (self.point(level, number), self.point(level, number + 1));
            let (piece, degree) = self.examine(level, low, high);
            match piece {
                Some(piece) => {
                    // Back to the largest part that starts where this one ends.
                    let next = number + 1;
                    let up = (next.trailing_zeros() as usize).min(level);
                    let end = next >> (level as u32) > 0;
                    self.place = (!end).then_some((level - up, next >> up));
                    return Some(piece);
                }
                None => {
                    if let Some(kept) = self.degrees.get_mut(level) {
                        *kept = degree;
                    }
                    self.place = Some((level + 1, number * 2));
                }
            }
        }
    }
}

/// The constant of a series, and the most that the others add to it.
fn extent<R: Ordered>(coefficients: &[R]) -> (R, R) {
    let Some((&constant, others)) = coefficients.split_first() else { return (R::zero(), R::zero()) };
    (constant, others.iter().fold(R::zero(), |sum, coefficient| sum + coefficient.abs()))
}
