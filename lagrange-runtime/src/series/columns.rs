//! The tables behind the recurrences of Taylor coefficients of systems with many products. Reached through
//! generated code only.
//!
//! As in [`crate::series::tables`], one sweep sums the interiors of all products at once. Here each factor is
//! stored once, as a column, and the sweep runs over rows from both ends at once: a\[j] b\[k − j] + a\[k − j]
//! b\[j] for all products of a tile. A tile is a set of instances of one pattern of products (the links of a
//! chain, the pairs of bodies), side by side: every vector of a column is loaded once for all products of the
//! pattern, and squares need one term for two. Where a number is a vector itself, the instances of a tile
//! come one after the other, each with all its rows: their sums stay in registers.

use crate::number::real::Real;

/// The products of a system: `C` columns, `L` sums.
pub trait Products<const C: usize, const L: usize> {
    /// The interior sums over rows that hold the coefficients of the orders below.
    fn sum<R: Real>(rows: &[[R; C]], sums: &mut [R; L]);
}

/// A pattern of `M` products over columns that are `width` apart.
pub trait Pattern<const C: usize, const M: usize> {
    /// Adds the terms of two rows at the same distance from the ends, for `W` instances whose first column
    /// starts at `base`.
    fn add<R: Real, const W: usize>(low: &[R; C], high: &[R; C], base: usize, sum: &mut [[R; W]; M]);
}

/// Factors of products, coefficients of the orders 1 to `P` (at the index before). Rows start on lines of the
/// cache: a vector that crosses one costs two.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Columns<R, const C: usize, const P: usize> {
    rows: [[R; C]; P],
}

impl<R: Real, const C: usize, const P: usize> Default for Columns<R, C, P> {
    #[inline]
    fn default() -> Self {
        Self { rows: [[R::zero(); C]; P] }
    }
}

impl<R: Real, const C: usize, const P: usize> Columns<R, C, P> {
    /// Where the factors of an order go.
    #[inline(always)]
    pub fn row(&mut self, order: usize) -> Option<&mut [R; C]> {
        self.rows.get_mut(order - 1)
    }

    /// Σ a\[j] b\[order − j] over 0 < j < order, for all products a b.
    #[inline(always)]
    pub fn interior<S: Products<C, L>, const L: usize>(&self, order: usize, sums: &mut [R; L]) {
        if let Some(rows) = self.rows.get(..order - 1) {
            outlined::<S, R, C, L>(rows, sums);
        }
    }
}

/// A function of its own: between scalar code the compiler would take its vectors apart.
#[inline(never)]
fn outlined<S: Products<C, L>, R: Real, const C: usize, const L: usize>(rows: &[[R; C]], sums: &mut [R; L]) {
    S::sum(rows, sums);
}

/// The sums of one tile, `used` of `W` instances of `M` products, to those from `first` on. Its columns
/// start at `base`.
#[inline(always)]
pub fn tile<T, R, const C: usize, const L: usize, const W: usize, const M: usize>(
    rows: &[[R; C]],
    sums: &mut [R; L],
    (base, first, used, stride): (usize, usize, usize, usize),
) where
    T: Pattern<C, M>,
    R: Real,
{
    let mut put = |place: usize, from: &[R]| {
        if let Some(to) = sums.get_mut(first + place..).and_then(|sums| sums.get_mut(..from.len())) {
            to.copy_from_slice(from);
        }
    };
    if size_of::<R>() == size_of::<R::Lane>() {
        for instance in (0..used).step_by(W) {
            let sum = part::<T, R, C, W, M>(rows, base + instance);
            for (product, sum) in sum.iter().enumerate() {
                put(product * stride + instance, sum);
            }
        }
    } else {
        for instance in 0..used {
            let sum = part::<T, R, C, 1, M>(rows, base + instance);
            for (product, sum) in sum.iter().enumerate() {
                put(product * stride + instance, sum);
            }
        }
    }
}

/// The sums of `W` instances whose first column starts at `base`.
#[inline(always)]
fn part<T, R, const C: usize, const W: usize, const M: usize>(rows: &[[R; C]], base: usize) -> [[R; W]; M]
where
    T: Pattern<C, M>,
    R: Real,
{
    let mut sum = [[R::zero(); W]; M];
    let half = rows.len() / 2;
    let (Some(low), Some(high)) = (rows.get(..half), rows.get(half..)) else { return sum };
    let mut high = high.iter();
    if rows.len() % 2 == 1
        && let Some(middle) = high.next()
    {
        // Both terms are the same one.
        T::add(middle, middle, base, &mut sum);
        for x in sum.as_flattened_mut() {
            *x *= R::from_f64(0.5);
        }
    }
    // From the middle outwards: the row that was just written comes last.
    for (low, high) in low.iter().rev().zip(high) {
        T::add(low, high, base, &mut sum);
    }
    sum
}

/// The `W` entries from `start` on of two rows.
#[inline(always)]
pub fn column<'a, R: Real, const C: usize, const W: usize>(
    low: &'a [R; C],
    high: &'a [R; C],
    start: usize,
) -> Option<(&'a [R; W], &'a [R; W])> {
    Some((low.get(start..)?.first_chunk()?, high.get(start..)?.first_chunk()?))
}

/// A column of both rows.
type Column<'a, R, const W: usize> = Option<(&'a [R; W], &'a [R; W])>;

/// Adds the terms of a product of two columns.
#[inline(always)]
pub fn product<R: Real, const W: usize>(sum: &mut [R; W], a: Column<'_, R, W>, b: Column<'_, R, W>) {
    let (Some((a_low, a_high)), Some((b_low, b_high))) = (a, b) else { return };
    for i in 0..W {
        sum[i] = Real::mul_add(a_low[i], b_high[i], Real::mul_add(a_high[i], b_low[i], sum[i]));
    }
}

/// Adds the terms of the square of a column.
#[inline(always)]
pub fn square<R: Real, const W: usize>(sum: &mut [R; W], a: Column<'_, R, W>) {
    let Some((low, high)) = a else { return };
    for i in 0..W {
        sum[i] = Real::mul_add(low[i] + low[i], high[i], sum[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two instances of the pattern a b, a a, b c in a row of three columns of two.
    struct Patterns;

    impl Products<6, 6> for Patterns {
        fn sum<R: Real>(rows: &[[R; 6]], sums: &mut [R; 6]) {
            tile::<Three, _, _, _, 2, 3>(rows, sums, (0, 0, 2, 2));
        }
    }

    struct Three;

    impl Pattern<6, 3> for Three {
        fn add<R: Real, const W: usize>(low: &[R; 6], high: &[R; 6], index: usize, sum: &mut [[R; W]; 3]) {
            let [a, b, c] = [0, 2, 4].map(|column| super::column::<_, _, W>(low, high, index + column));
            product(&mut sum[0], a, b);
            square(&mut sum[1], a);
            product(&mut sum[2], b, c);
        }
    }

    #[test]
    fn sums_are_the_interiors_of_convolutions() {
        const ORDERS: usize = 9;
        let coefficient = |order: usize, index: usize| ((7 * order + 3 * index) % 11) as f64 - 4.5;
        let mut columns = Columns::<f64, 6, ORDERS>::default();
        let mut sums = [f64::NAN; 6];
        for order in 1..=ORDERS {
            columns.interior::<Patterns, 6>(order, &mut sums);
            for instance in 0..2 {
                for (product, (a, b)) in [(0, 2), (0, 0), (2, 4)].into_iter().enumerate() {
                    let expected: f64 = (1..order)
                        .map(|j| coefficient(j, a + instance) * coefficient(order - j, b + instance))
                        .sum();
                    assert_eq!(sums[2 * product + instance], expected, "order {order}, product {product}");
                }
            }
            *columns.row(order).unwrap() = core::array::from_fn(|index| coefficient(order, index));
        }
        assert!(columns.row(ORDERS + 1).is_none());
    }

    #[test]
    fn rows_start_on_lines_of_the_cache() {
        assert_eq!(align_of::<Columns<f64, 8, 3>>(), 64);
    }
}
