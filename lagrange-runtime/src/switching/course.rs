//! A step that is a polynomial.

use super::Along;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, larger};
use crate::series::taylor::{Taylor, powers};
use crate::system::method::Terms;
use crate::system::state::State;

/// The truncation error that a guard's series may have, relative to that of the motion. The last terms of two
/// series that converge alike differ by a factor.
const MARGIN: f64 = 16.0;

/// A step that is a polynomial.
pub(super) struct Course<'a, R, const N: usize> {
    pub(super) terms: Terms<'a, R, N>,
    /// The relative truncation error of the motion.
    pub(super) left: R,
    /// Whether the caller chose the length of the step, and no error bounds it.
    pub(super) is_paced: bool,
    /// The terms of coordinates and velocities, without those at the end that are zero.
    rows: [&'a [[R; N]]; 2],
}

/// Terms in rows of this width, without the rows at the end that are zero. The first row stays.
fn known<T>(terms: &[T], width: usize, is_zero: impl Fn(&T) -> bool) -> &[T] {
    let count = terms.iter().rposition(|term| !is_zero(term)).map_or(1, |last| last + 1);
    terms.get(..count.next_multiple_of(width.max(1))).unwrap_or(terms)
}

/// The gain of a polynomial after its start.
pub(super) struct Gain<R> {
    /// A bound of its magnitude on the step.
    pub(super) most: R,
    /// The gain at the end.
    pub(super) whole: R,
    /// The sum of the magnitudes of the last two terms.
    pub(super) last: R,
}

impl<R: Ordered> Gain<R> {
    /// The gain of a polynomial whose coefficients are so far apart in `terms`, that of order one first.
    #[inline]
    fn of(terms: &[R], stride: usize, length: R) -> Self {
        let [mut most, mut whole] = [[R::zero(); 2]; 2];
        let mut last = [R::zero(); 2];
        // Odd and even orders have sums of their own, which do not wait for each other.
        let mut powers = powers(length);
        powers.next();
        let mut place = 0;
        while let (Some(&coefficient), Some(power)) = (terms.get(place), powers.next()) {
            let term = (coefficient * power).part(0);
            most = [most[1], most[0] + term.abs()];
            whole = [whole[1], whole[0] + term];
            last = [last[1], term.abs()];
            place += stride;
        }
        Self { most: most[0] + most[1], whole: whole[0] + whole[1], last: last[0] + last[1] }
    }
}

impl<'a, R: Ordered, const N: usize> Course<'a, R, N> {
    /// The step with these terms, of a motion with this tolerance, whose series follows so many functions.
    /// Terms that are zero from some order on, as in a free flight, are left out.
    pub(super) fn new(terms: Terms<'a, R, N>, relative: R, followed: usize, is_paced: bool) -> Self {
        let rows =
            [terms.q, terms.v].each(|rows| known(rows, 1, |row| row.iter().all(|term| term.is_zero())));
        let functions = terms.functions.get(..followed * terms.v.len()).unwrap_or(terms.functions);
        let functions = known(functions, followed, |term| term.is_zero());
        let left = larger(relative, terms.left).part(0);
        Self { terms: Terms { functions, ..terms }, rows, left, is_paced }
    }

    /// Whether nothing moves on the step.
    pub(super) fn rests(&self) -> bool {
        self.rows.iter().all(|rows| rows.iter().all(|row| row.iter().all(|term| term.is_zero())))
    }

    /// The duration of the step \[s], without direction.
    pub(super) fn time(&self) -> R {
        (self.terms.length * self.terms.unit).abs()
    }

    /// The state after a part of the step, and Σ |summands| of its numbers.
    pub(super) fn at(&self, start: &State<R, N>, place: R) -> [State<R, N>; 2] {
        let theta = place * self.terms.length;
        let size = theta.abs();
        let rows = if theta.is_zero() { [&[][..]; 2] } else { self.rows };
        let sums = |numbers: &[R; N], rows: &[[R; N]]| {
            let mut gains = [[R::zero(); N]; 2];
            for row in rows.iter().rev() {
                for (i, &term) in row.iter().enumerate() {
                    gains[0][i] = R::mul_add(gains[0][i], theta, term);
                    gains[1][i] = R::mul_add(gains[1][i], size, term.abs());
                }
            }
            [
                array(|i| R::mul_add(gains[0][i], theta, numbers[i])),
                array(|i| R::mul_add(gains[1][i], size, numbers[i].abs())),
            ]
        };
        let ([q, of_q], [v, of_v]) = (sums(&start.q, rows[0]), sums(&start.v, rows[1]));
        let passed = theta * self.terms.unit;
        let t = start.t.abs() + passed.abs();
        [State { t: start.t + passed, q, v }, State { t, q: of_q, v: of_v }]
    }

    /// One of `stride` reactions after a part of the step; zero if they are not known.
    pub(super) fn reaction_at(&self, row: usize, stride: usize, place: R) -> R {
        let theta = place * self.terms.length;
        let rows = self.series(self.terms.reactions, row, stride).into_iter().flatten();
        rows.rev().fold(R::zero(), |sum, &term| R::mul_add(sum, theta, term)).part(0)
    }

    /// The gain of one of `stride` functions after a part of the step.
    pub(super) fn gain_of_function_at(&self, index: usize, stride: usize, place: R) -> R {
        let theta = place * self.terms.length;
        let rows = self.series(self.terms.functions, index, stride).into_iter().flatten();
        theta * rows.rev().fold(R::zero(), |sum, &term| R::mul_add(sum, theta, term)).part(0)
    }

    /// The terms of one of `stride` series that lie beside each other, with those of others between them;
    /// `None` where the step has no series.
    #[inline]
    fn own(&self, terms: &'a [R], index: usize, stride: usize) -> Option<&'a [R]> {
        let terms = terms.get(..stride * self.order()).unwrap_or(terms);
        terms.get(index..).filter(|own| !own.is_empty())
    }

    /// The same terms without others.
    fn series(
        &self,
        terms: &'a [R],
        index: usize,
        stride: usize,
    ) -> Option<impl DoubleEndedIterator<Item = &'a R> + ExactSizeIterator> {
        Some(self.own(terms, index, stride)?.iter().step_by(stride.max(1)))
    }

    /// The powers of the length, from that of order zero on.
    pub(super) fn powers(&self) -> impl Iterator<Item = R> {
        powers(self.terms.length)
    }

    /// The order of the series.
    pub(super) fn order(&self) -> usize {
        self.terms.v.len()
    }

    /// The relative truncation error that a guard may have.
    pub(super) fn allowed(&self) -> R {
        R::from_f64(MARGIN) * larger(self.left, R::epsilon())
    }

    /// The gain of one of `stride` functions that the series follows.
    pub(super) fn gain_of_function(&self, index: usize, stride: usize) -> Option<Gain<R>> {
        let terms = self.own(self.terms.functions, index, stride)?;
        Some(Gain::of(terms, stride, self.terms.length))
    }

    /// The value of one of `stride` reactions at the start, and its gain.
    pub(super) fn gain_of_reaction(&self, row: usize, stride: usize) -> Option<(R, Gain<R>)> {
        let terms = self.own(self.terms.reactions, row, stride)?;
        let later = terms.get(stride..).unwrap_or_default();
        Some((terms.first()?.part(0), Gain::of(later, stride, self.terms.length)))
    }

    /// The polynomial of one of `stride` functions, from its value at the start; `None` without a series.
    pub(super) fn curve_of_function(&self, along: Along, stride: usize, start: R) -> Option<Taylor<R>> {
        let index = match along {
            Along::Constant => return Some(Taylor::constant(start.part(0))),
            Along::Series(index) => index,
            Along::Unknown => return None,
        };
        let rows = self.series(self.terms.functions, index, stride)?;
        let terms = rows.zip(self.powers().skip(1)).map(|(&term, power)| (term * power).part(0));
        Some(Taylor::of(core::iter::once(start.part(0)).chain(terms)))
    }

    /// The polynomial of one of `stride` reactions, which is one order shorter.
    pub(super) fn curve_of_reaction(&self, row: usize, stride: usize) -> Option<Taylor<R>> {
        let rows = self.series(self.terms.reactions, row, stride)?;
        Some(Taylor::of(rows.zip(self.powers()).map(|(&term, power)| (term * power).part(0))))
    }

    /// The sum of the magnitudes of the last two terms of a function of reactions.
    pub(super) fn last_of_reactions(&self, curve: &Taylor<R>) -> R {
        let order = self.order();
        let term = |order| curve.coefficients.get(order).copied().unwrap_or(R::zero()).abs();
        term(order.saturating_sub(1)) + term(order.saturating_sub(2))
    }
}
