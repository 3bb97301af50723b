//! The numbers of a state along a step.

use super::{LEAST, TERMS, Taylor, sum};
use crate::number::real::Ordered;

impl<R: Ordered, const T: usize> Taylor<R, T> {
    /// The numbers of a state along a step, from rows of their terms, order by order; those that are not
    /// `read` are zero.
    #[inline(always)]
    pub(crate) fn all_along<const N: usize>(
        values: &[R; N],
        rows: &[[R; N]],
        powers: &[R; TERMS],
        read: &[bool; N],
    ) -> [Self; N] {
        let mut all = [Self::constant(R::zero()); N];
        for (i, number) in all.iter_mut().enumerate().filter(|(i, _)| read[*i]) {
            // The very first look is what most steps take.
            if T <= LEAST {
                number.grow(values[i], rows, i, powers);
            } else {
                number.grow_apart(values[i], rows, i, powers);
            }
        }
        all
    }

    /// Makes one of them of a number that is zero, for all coordinates by the same code.
    #[inline(never)]
    fn grow_apart<const N: usize>(&mut self, value: R, rows: &[[R; N]], i: usize, powers: &[R; TERMS]) {
        self.grow(value, rows, i, powers);
    }

    /// The same, in line.
    #[inline(always)]
    fn grow<const N: usize>(&mut self, value: R, rows: &[[R; N]], i: usize, powers: &[R; TERMS]) {
        let term = |(row, &power): (&[R; N], &R)| row.get(i).copied().unwrap_or(R::zero()) * power;
        let (kept, rest) = rows.split_at_checked(T - 1).unwrap_or((rows, &[]));
        let (own, others) = powers.split_at_checked(T).unwrap_or((powers, &[]));
        if let Some(first) = self.coefficients.first_mut() {
            *first = value;
        }
        let places = self.coefficients.iter_mut().zip(own).skip(1);
        for (order, ((to, power), row)) in (1..).zip(places.zip(kept)) {
            *to = term((row, power));
            if !to.is_zero() {
                self.degree = order;
            }
        }
        // Four sums, of which none waits for another.
        let ((groups, few), (by_groups, _)) = (rest.as_chunks::<4>(), others.as_chunks::<4>());
        let mut sums = [R::zero(); 4];
        for (rows, powers) in groups.iter().zip(by_groups) {
            sums = core::array::from_fn(|k| sums[k] + term((&rows[k], &powers[k])).abs());
        }
        let by_few = others.get(4 * groups.len()..).unwrap_or_default();
        let few = few.iter().zip(by_few).map(|pair| term(pair).abs());
        let beyond = few.fold(sum(&sums, |sum| sum), |beyond, term| beyond + term);
        self.error = R::epsilon() * (self.extent() + beyond) + beyond;
    }
}
