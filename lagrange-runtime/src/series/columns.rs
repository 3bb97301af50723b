//! The tables behind the recurrences of Taylor coefficients of systems with many products. Reached through
//! generated code only.
//!
//! As in [`crate::series::tables`], one sweep sums the interiors of all products at once. Here each factor is
//! stored once, as a column, and the sweep runs over rows from both ends at once: a\[j] b\[k − j] + a\[k − j]
//! b\[j] for all products of a tile. A tile is a set of instances of one pattern of products (the links of a
//! chain, the pairs of bodies), side by side: every vector of a column is loaded once for all products of the
//! pattern, and squares need one term for two. Where a number is a vector itself, the instances of a tile
//! come one after the other, each with all its rows: their sums stay in registers.
//!
//! Rows of numbers have room that fills up vectors. Rows of vectors are packed: room that is not used would
//! leave a part of the cache unused.

use core::marker::PhantomData;
use core::ops::{Index, IndexMut, Range};

use super::tables::is_wide;
use crate::number::real::Real;

/// The products of a system: `C` columns, `L` sums.
pub trait Products<const C: usize, const L: usize> {
    /// The interior sums over rows that hold the coefficients of the orders below.
    fn sum<R: Real>(rows: &[[R; C]], sums: &mut [R; L]);

    /// The index of each column in a packed row. Unoptimised code would have a copy of an array on the stack
    /// for each use of it.
    const PACKED: &'static [usize; C];
}

/// A pattern of `M` products over the columns of a tile.
pub trait Pattern<const C: usize, const M: usize> {
    /// Adds the terms of two rows at the same distance from the ends, for `W` instances. Their first column
    /// starts at the first number of `place`, and columns are as far apart as the second says.
    fn add<R: Real, const W: usize>(low: &[R; C], high: &[R; C], place: [usize; 2], sum: &mut [[R; W]; M]);
}

/// The index of each column in a packed row. Each set of columns has a number of columns, their distance, and
/// the number of instances in each.
pub const fn packed<const C: usize>(sets: &[[usize; 3]]) -> [usize; C] {
    let mut packed = [0; C];
    let (mut column, mut index) = (0, 0);
    let mut set = 0;
    while set < sets.len() {
        let [columns, apart, used] = sets[set];
        let mut place = 0;
        while place < columns * apart {
            packed[column + place] = index + place / apart * used + place % apart;
            place += 1;
        }
        column += columns * apart;
        index += columns * used;
        set += 1;
    }
    packed
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
    pub fn row<S: Products<C, L>, const L: usize>(&mut self, order: usize) -> Option<Row<'_, S, R, C, L>> {
        self.rows.get_mut(order - 1).map(|row| Row { row, products: PhantomData })
    }

    /// Σ a\[j] b\[order − j] over 0 < j < order, for all products a b.
    #[inline(always)]
    pub fn interior<S: Products<C, L>, const L: usize>(&self, order: usize, sums: &mut [R; L]) {
        // Called without a condition, so that what follows reads the sums where they are.
        outlined::<S, R, C, L>(self.rows.get(..order - 1).unwrap_or_default(), sums);
    }
}

/// A row of [`Columns`], by the columns of numbers.
#[derive(Debug)]
pub struct Row<'a, S, R, const C: usize, const L: usize> {
    row: &'a mut [R; C],
    products: PhantomData<S>,
}

impl<S: Products<C, L>, R: Real, const C: usize, const L: usize> Row<'_, S, R, C, L> {
    #[inline(always)]
    fn index(column: usize) -> usize {
        if is_wide::<R>() { S::PACKED[column] } else { column }
    }
}

impl<S: Products<C, L>, R: Real, const C: usize, const L: usize> Index<usize> for Row<'_, S, R, C, L> {
    type Output = R;

    #[inline(always)]
    fn index(&self, column: usize) -> &R {
        &self.row[Self::index(column)]
    }
}

impl<S: Products<C, L>, R: Real, const C: usize, const L: usize> IndexMut<usize> for Row<'_, S, R, C, L> {
    #[inline(always)]
    fn index_mut(&mut self, column: usize) -> &mut R {
        &mut self.row[Self::index(column)]
    }
}

/// Columns that all hold factors are neighbours in a packed row, too.
impl<S: Products<C, L>, R: Real, const C: usize, const L: usize> Index<Range<usize>> for Row<'_, S, R, C, L> {
    type Output = [R];

    #[inline(always)]
    fn index(&self, columns: Range<usize>) -> &[R] {
        let first = Self::index(columns.start);
        &self.row[first..first + columns.len()]
    }
}

impl<S: Products<C, L>, R: Real, const C: usize, const L: usize> IndexMut<Range<usize>>
    for Row<'_, S, R, C, L>
{
    #[inline(always)]
    fn index_mut(&mut self, columns: Range<usize>) -> &mut [R] {
        let first = Self::index(columns.start);
        &mut self.row[first..first + columns.len()]
    }
}

/// A function of its own: between scalar code the compiler would take its vectors apart.
#[inline(never)]
fn outlined<S: Products<C, L>, R: Real, const C: usize, const L: usize>(rows: &[[R; C]], sums: &mut [R; L]) {
    S::sum(rows, sums);
}

/// The sums of one tile, `used` instances of `M` products, to those from `first` on, where those of a product
/// are `stride` apart from those of the next one. The columns start at `base`, and packed ones at `packed`.
#[inline(always)]
pub fn tile<T, R, const C: usize, const L: usize, const W: usize, const M: usize>(
    rows: &[[R; C]],
    sums: &mut [R; L],
    [base, packed, first, used, stride]: [usize; 5],
) where
    T: Pattern<C, M>,
    R: Real,
{
    let mut put = |place: usize, from: &[R]| {
        if let Some(to) = sums.get_mut(first + place..).and_then(|sums| sums.get_mut(..from.len())) {
            to.copy_from_slice(from);
        }
    };
    if is_wide::<R>() {
        for instance in 0..used {
            let sum = part::<T, R, C, 1, M>(rows, [packed + instance, used]);
            for (product, sum) in sum.iter().enumerate() {
                put(product * stride + instance, sum);
            }
        }
    } else {
        for instance in (0..used).step_by(W) {
            let sum = part::<T, R, C, W, M>(rows, [base + instance, stride]);
            for (product, sum) in sum.iter().enumerate() {
                put(product * stride + instance, sum);
            }
        }
    }
}

/// The sums of `W` instances, at the start and the distance of their columns.
#[inline(always)]
fn part<T, R, const C: usize, const W: usize, const M: usize>(
    rows: &[[R; C]],
    place: [usize; 2],
) -> [[R; W]; M]
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
        T::add(middle, middle, place, &mut sum);
        for x in sum.as_flattened_mut() {
            *x *= R::from_f64(0.5);
        }
    }
    // From the middle outwards: the row that was just written comes last.
    for (low, high) in low.iter().rev().zip(high) {
        T::add(low, high, place, &mut sum);
    }
    sum
}

/// The `W` entries of a column in two rows.
#[inline(always)]
pub fn column<'a, R: Real, const C: usize, const W: usize>(
    low: &'a [R; C],
    high: &'a [R; C],
    [first, apart]: [usize; 2],
    column: usize,
) -> Option<(&'a [R; W], &'a [R; W])> {
    let start = first + column * apart;
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
    use crate::number::real::Dual;

    /// Three instances of the pattern a b, a a, b c in room for four, and one product in room for two.
    struct Patterns;

    impl Products<16, 14> for Patterns {
        fn sum<R: Real>(rows: &[[R; 16]], sums: &mut [R; 14]) {
            tile::<Three, _, _, _, 4, 3>(rows, sums, [0, 0, 0, 3, 4]);
            tile::<One, _, _, _, 2, 1>(rows, sums, [12, 9, 12, 1, 2]);
        }

        const PACKED: &'static [usize; 16] = &packed(&[[3, 4, 3], [2, 2, 1]]);
    }

    struct Three;

    impl Pattern<16, 3> for Three {
        fn add<R: Real, const W: usize>(
            low: &[R; 16],
            high: &[R; 16],
            place: [usize; 2],
            sum: &mut [[R; W]; 3],
        ) {
            let [a, b, c] = [0, 1, 2].map(|column| super::column::<_, _, W>(low, high, place, column));
            product(&mut sum[0], a, b);
            square(&mut sum[1], a);
            product(&mut sum[2], b, c);
        }
    }

    struct One;

    impl Pattern<16, 1> for One {
        fn add<R: Real, const W: usize>(
            low: &[R; 16],
            high: &[R; 16],
            place: [usize; 2],
            sum: &mut [[R; W]; 1],
        ) {
            let [a, b] = [0, 1].map(|column| super::column::<_, _, W>(low, high, place, column));
            product(&mut sum[0], a, b);
        }
    }

    /// The columns that hold factors, and the products of them, with the index of the sum of each.
    const FACTORS: [usize; 11] = [0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 14];
    const ALL: [[usize; 3]; 10] = [
        [0, 4, 0],
        [1, 5, 1],
        [2, 6, 2],
        [0, 0, 4],
        [1, 1, 5],
        [2, 2, 6],
        [4, 8, 8],
        [5, 9, 9],
        [6, 10, 10],
        [12, 14, 12],
    ];

    fn sums_are_interiors<R: Real>(of: impl Fn(f64) -> R) {
        const ORDERS: usize = 9;
        let coefficient = |order: usize, column: usize| of(((7 * order + 3 * column) % 11) as f64 - 4.5);
        let mut columns = Columns::<R, 16, ORDERS>::default();
        let mut sums = [of(f64::NAN); 14];
        for order in 1..=ORDERS {
            columns.interior::<Patterns, 14>(order, &mut sums);
            for [a, b, index] in ALL {
                let expected: R = (1..order).map(|j| coefficient(j, a) * coefficient(order - j, b)).sum();
                assert_eq!(sums[index], expected, "order {order}, columns {a} and {b}");
            }
            let mut row = columns.row::<Patterns, 14>(order).unwrap();
            FACTORS.into_iter().for_each(|column| row[column] = coefficient(order, column));
        }
        assert!(columns.row::<Patterns, 14>(ORDERS + 1).is_none());
    }

    #[test]
    fn sums_are_the_interiors_of_convolutions() {
        sums_are_interiors(|x| x);
        sums_are_interiors(|x| Dual { value: x, slopes: [2.0 * x - 1.0] });
    }

    #[test]
    fn packed_rows_have_no_room() {
        let packed: [usize; 11] = FACTORS.map(|column| Patterns::PACKED[column]);
        assert_eq!(packed, core::array::from_fn(|i| i));
        let mut columns = Columns::<Dual<f64, 1>, 16, 1>::default();
        let numbers: [Dual<f64, 1>; 3] = [1.0, 2.0, 3.0].map(Dual::from_f64);
        columns.row::<Patterns, 14>(1).unwrap()[8..11].copy_from_slice(&numbers);
        assert_eq!(columns.rows[0][6..9], numbers);
    }

    #[test]
    fn rows_start_on_lines_of_the_cache() {
        assert_eq!(align_of::<Columns<f64, 8, 3>>(), 64);
    }
}
