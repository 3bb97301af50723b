//! Sums over vectors of fixed length, in an order that the processor need not wait for.

use crate::number::elements::Each;
use crate::number::real::Real;

/// aᵀ b in four partial sums.
#[inline(always)]
pub(in crate::linear) fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let mut sums = [R::zero(); 4];
    for i in 0..N {
        sums[i % 4] = if i < 4 { a[i] * b[i] } else { R::mul_add(a[i], b[i], sums[i % 4]) };
    }
    match N {
        0 | 1 => sums[0],
        2 => sums[0] + sums[1],
        3 => sums[0] + sums[1] + sums[2],
        _ => (sums[0] + sums[2]) + (sums[1] + sums[3]),
    }
}

/// Σ |aᵢ|.
#[inline(always)]
pub(in crate::linear) fn magnitude<R: Real, const N: usize>(a: &[R; N]) -> R {
    let mut sums = [R::zero(); 4];
    for i in 0..N {
        sums[i % 4] = if i < 4 { a[i].abs() } else { sums[i % 4] + a[i].abs() };
    }
    (sums[0] + sums[2]) + (sums[1] + sums[3])
}

/// sum ← sum + a · factor.
#[inline(always)]
pub(in crate::linear) fn add_scaled<R: Real, const N: usize>(sum: &mut [R; N], a: &[R; N], factor: R) {
    for i in 0..N {
        sum[i] = R::mul_add(a[i], factor, sum[i]);
    }
}

/// Multiplies component by component.
#[inline(always)]
pub(in crate::linear) fn multiply<R: Real, const N: usize>(vector: &mut [R; N], factors: &[R; N]) {
    for (x, &factor) in vector.iter_mut().zip(factors) {
        *x *= factor;
    }
}

/// Multiplies all components by the same.
#[inline(always)]
pub(in crate::linear) fn scale<R: Real, const N: usize>(vector: &mut [R; N], factor: R) {
    for x in vector {
        *x *= factor;
    }
}

/// Rows become columns.
#[inline(always)]
pub(in crate::linear) fn transposed<R: Real, const I: usize, const J: usize>(
    matrix: &[[R; J]; I],
) -> [[R; I]; J] {
    let mut transposed = [[R::zero(); I]; J];
    for i in 0..I {
        for j in 0..J {
            transposed[j][i] = matrix[i][j];
        }
    }
    transposed
}

/// A unit vector.
#[inline(always)]
pub(in crate::linear) fn unit<R: Real, const N: usize>(index: usize) -> [R; N] {
    let mut vector = [R::zero(); N];
    put(&mut vector, index, R::one());
    vector
}

/// start + Σ rows\[k] · factors\[k], in two sums, so that the additions of one need not wait for those of the
/// other.
#[inline(always)]
pub(in crate::linear) fn add_product<R: Real, const K: usize, const N: usize>(
    start: &[R; N],
    rows: &[[R; N]; K],
    factors: &[R; K],
) -> [R; N] {
    let (mut even, mut odd) = (*start, [R::zero(); N]);
    for k in 0..K / 2 {
        add_scaled(&mut even, &rows[2 * k], factors[2 * k]);
        add_scaled(&mut odd, &rows[2 * k + 1], factors[2 * k + 1]);
    }
    if K % 2 == 1 {
        add_scaled(&mut even, &rows[K - 1], factors[K - 1]);
    }
    if K > 1 {
        for i in 0..N {
            even[i] += odd[i];
        }
    }
    even
}

/// start − Σ rows\[k] · factors\[k], likewise.
#[inline(always)]
pub(in crate::linear) fn subtract_product<R: Real, const K: usize, const N: usize>(
    start: &[R; N],
    rows: &[[R; N]; K],
    factors: &[R; K],
) -> [R; N] {
    add_product(start, rows, &factors.each(|x| -x))
}

/// The smallest lane.
#[inline(always)]
pub(in crate::linear) fn smallest<R: Real>(x: R) -> R::Lane {
    -(-x).largest()
}

/// The index of the largest of some sizes: in its smallest lane if that is above `least`, so that all lanes
/// can use it, else in its largest lane.
#[inline(always)]
pub(in crate::linear) fn best<R: Real, const C: usize>(sizes: &[R; C], least: R) -> usize {
    let (mut common, mut any) = (0, 0);
    for (c, &size) in sizes.iter().enumerate() {
        if smallest(size) > smallest(sizes[common]) {
            common = c;
        }
        if size.largest() > sizes[any].largest() {
            any = c;
        }
    }
    let usable = sizes.get(common).is_some_and(|&size| (size - least).is_positive());
    if usable { common } else { any }
}

/// Makes all `numbers` NaN in the lanes where one of the `sources` is not finite.
pub(in crate::linear) fn poison<R: Real>(numbers: &mut [R], sources: &[R]) {
    // 0 · ∞ and 0 · NaN are NaN.
    let poison: R = sources.iter().map(|&x| R::zero() * x).sum();
    for x in numbers {
        *x += poison;
    }
}

/// `value` in the lanes where `excess` is positive, NaN in the others; `None` if it is positive nowhere.
#[cold]
#[inline(never)]
pub(in crate::linear) fn where_positive<R: Real>(value: R, excess: R) -> Option<R> {
    let excess = excess.max(R::zero());
    // 0 · ∞ is NaN.
    if excess.largest() > R::zero().largest() { Some(value + R::zero() * excess.recip()) } else { None }
}

/// The entry at an index known at run time only; zero outside.
///
/// A few entries are compared one by one, which keeps the array in registers.
#[inline(always)]
pub(in crate::linear) fn pick<R: Real, const N: usize>(row: &[R; N], index: usize) -> R {
    if N > 4 {
        return row.get(index).copied().unwrap_or(R::zero());
    }
    let mut entry = R::zero();
    for (i, &x) in row.iter().enumerate() {
        if i == index {
            entry = x;
        }
    }
    entry
}

/// Writes the entry at an index known at run time only.
#[inline(always)]
pub(in crate::linear) fn put<T: Copy, const N: usize>(row: &mut [T; N], index: usize, entry: T) {
    if N > 4 {
        if let Some(to) = row.get_mut(index) {
            *to = entry;
        }
        return;
    }
    for (i, to) in row.iter_mut().enumerate() {
        if i == index {
            *to = entry;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_is_found_above_the_least_and_below() {
        assert_eq!(best(&[1.0, 3.0, 2.0], 0.5), 1);
        assert_eq!(best(&[1.0, 3.0, 2.0], 5.0), 1);
        assert_eq!(best(&[3.0, 1.0, 2.0], 5.0), 0);
    }

    #[test]
    fn a_number_is_none_where_its_excess_is_not_positive() {
        assert_eq!(where_positive(3.0, 1e-300), Some(3.0));
        assert_eq!((where_positive(3.0, 0.0), where_positive(3.0, -1.0)), (None, None));
    }

    #[cfg(feature = "wide")]
    #[test]
    fn lanes_without_a_positive_excess_are_no_numbers() {
        use crate::number::real::Lanes;
        use wide::f64x4;

        let excess = Lanes::from([2.0, 0.0, -1.0, 1e-3]);
        let found: [f64; 4] = where_positive(Lanes::<f64x4>::splat(3.0), excess).unwrap().into();
        assert_eq!([found[0], found[3]], [3.0; 2]);
        assert!(found[1].is_nan() && found[2].is_nan(), "{found:?}");
    }
}
