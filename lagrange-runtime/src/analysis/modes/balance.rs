//! Balancing of a real matrix by a diagonal similarity in powers of two, which round nothing.
//!
//! Rows and columns come to similar norms (B. Parlett, C. Reinsch, Numer. Math. 13 (1969) 293), in the 2-norm
//! with the diagonal, so that it does no harm (R. James, J. Langou, B. Lowery, arXiv:1401.5766). Norms are
//! scaled, so that entries of any size count; that of nalgebra squares them, and beyond the root of the
//! largest number it never ends.

use nalgebra::{DMatrix, DVector};

use super::largest;

/// The most sweeps. Each that changes anything makes a row with its column smaller by a twentieth or more.
/// From the ends of the range of numbers it takes some ten sweeps, because a factor is found at once.
const SWEEPS: usize = 100;

/// A change is made if it multiplies a sum of squares by less than this.
const GAIN: f64 = 0.95;

/// The largest exponent of two in a factor, so that its products with entries stay numbers. The next sweep
/// does the rest.
const POWERS: f64 = 512.0;

/// Balances a matrix, and gives the diagonal D of D⁻¹ A D.
pub(in crate::analysis) fn balance(matrix: &mut DMatrix<f64>) -> DVector<f64> {
    let count = matrix.nrows();
    let mut scales = DVector::from_element(count, 1.0);
    for _ in 0..SWEEPS {
        let mut is_balanced = true;
        for i in 0..count {
            let (column, row) = (norm(matrix.column(i).iter()), norm(matrix.row(i).iter()));
            if column == 0.0 || row == 0.0 {
                continue;
            }
            // √(row / column), to the nearest power of two, without a quotient that overflows.
            let power = (0.5 * (row.log2() - column.log2())).round().clamp(-POWERS, POWERS);
            let factor = power.exp2();
            let most = row.max(column);
            let (c, r) = (column / most, row / most);
            let (after_c, after_r) = (column * factor / most, row / factor / most);
            let scale = scales[i] * factor;
            let gains = after_c * after_c + after_r * after_r < GAIN * (c * c + r * r);
            if gains && scale.is_normal() {
                is_balanced = false;
                scales[i] = scale;
                matrix.column_mut(i).iter_mut().for_each(|x| *x *= factor);
                matrix.row_mut(i).iter_mut().for_each(|x| *x /= factor);
            }
        }
        if is_balanced {
            break;
        }
    }
    scales
}

/// The 2-norm, whatever the size of the entries.
fn norm<'a>(entries: impl Iterator<Item = &'a f64> + Clone) -> f64 {
    let most = entries.clone().fold(0.0_f64, |most, x| most.max(x.abs()));
    if most == 0.0 { 0.0 } else { most * entries.map(|x| (x / most).powi(2)).sum::<f64>().sqrt() }
}

/// Sizes between which squares and products of entries neither overflow nor underflow.
const MODERATE: (f64, f64) = (1e-100, 1e100);

/// Divides a matrix by a power of two, which it returns, such that products of its entries stay numbers.
pub(super) fn moderated(matrix: &mut DMatrix<f64>) -> f64 {
    let most = largest(matrix);
    if most == 0.0 || (MODERATE.0..=MODERATE.1).contains(&most) {
        return 1.0;
    }
    let scale = most.log2().floor().exp2();
    matrix.iter_mut().for_each(|x| *x /= scale);
    scale
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_of_any_size_are_balanced() {
        for size in [1e-300, 1e-100, 1.0, 1e100, 1e160, 1e300] {
            let mut matrix = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -size, 0.0]);
            let scales = balance(&mut matrix);
            let root = size.sqrt();
            for x in [matrix[(0, 1)], -matrix[(1, 0)]] {
                assert!(x >= root / 2.0 && x <= root * 2.0, "{size:e}: {matrix}");
            }
            assert!((matrix[(0, 1)] * (-matrix[(1, 0)] / size) - 1.0).abs() < 1e-15);
            assert_eq!(matrix[(0, 1)], scales[1] / scales[0]);
        }
    }

    #[test]
    fn what_is_balanced_or_triangular_is_left_alone() {
        let even = DMatrix::from_row_slice(2, 2, &[3.0, 1.0, -1.0, 2.0]);
        let mut matrix = even.clone();
        assert_eq!(balance(&mut matrix), DVector::from_element(2, 1.0));
        assert_eq!(matrix, even);
        let mut matrix = DMatrix::from_row_slice(2, 2, &[0.0, 1e300, 0.0, 0.0]);
        assert_eq!(balance(&mut matrix), DVector::from_element(2, 1.0));
        let mut matrix = DMatrix::from_element(3, 3, f64::NAN);
        balance(&mut matrix);
    }

    #[test]
    fn moderate_matrices_keep_their_scale() {
        let mut matrix = DMatrix::from_element(2, 2, 7.0);
        assert_eq!(moderated(&mut matrix), 1.0);
        for size in [1e-310, 1e-200, 1e200, 1.7e308] {
            let mut matrix = DMatrix::from_element(2, 2, size);
            let scale = moderated(&mut matrix);
            assert!((1.0..2.0).contains(&matrix[(0, 0)]));
            assert_eq!(matrix[(0, 0)] * scale, size);
        }
    }
}
