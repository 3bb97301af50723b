//! Eigenvectors of a real matrix: by inverse iteration, and of zero by elimination.

use std::vec::Vec;

use nalgebra::{ColPivQR, Complex, DMatrix, DVector};

use super::spectrum::parts;
use super::{largest, rounding};

/// The eigenvector of an eigenvalue, from the start with that number, so that equal eigenvalues get different
/// vectors where they have some; `None` if it is not finite. `scale` is that of the eigenvalue, and only
/// components of its `members` are not zero in the start: what does not act on them has no part in the
/// vector, not even a rounding, which the scales of a soft part might make large.
///
/// The shift is the eigenvalue itself, and pivots below the rounding errors of its scale are put there: no
/// other shift will do for a defective eigenvalue, whose pivot is the square of a distance from it and so
/// rounds to zero (Wilkinson, *The Algebraic Eigenvalue Problem*, chapter 9).
pub(super) fn eigenvector(
    matrix: &DMatrix<f64>,
    eigenvalue: Complex<f64>,
    scale: f64,
    (members, start): (&[usize], usize),
) -> Option<DVector<Complex<f64>>> {
    let order = matrix.nrows();
    let mut shifted = matrix.map(|x| Complex::new(x, 0.0));
    for i in 0..order {
        shifted[(i, i)] -= eigenvalue;
    }
    let (permutation, lower, mut upper) = shifted.lu().unpack();
    // Complex division squares a pivot, which must not underflow.
    let least = (f64::EPSILON * if scale > 0.0 { scale } else { largest(matrix) }).max(1e-150);
    for i in 0..order {
        let pivot = upper[(i, i)];
        if pivot.re.hypot(pivot.im) < least {
            upper[(i, i)] = Complex::new(least, 0.0);
        }
    }
    // The vector of a real eigenvalue stays real.
    let imaginary = if eigenvalue.im == 0.0 { 0.0 } else { 0.5 };
    let mut vector = DVector::from_element(order, Complex::new(0.0, 0.0));
    for &i in members {
        vector[i] = Complex::new(((1 + i) as f64 * (1.3 + start as f64)).cos(), imaginary);
    }
    // A step's growth is the inverse of the residual. Near a defective eigenvalue a later step may be worse.
    let (mut best, mut growth) = (None, 0.0);
    for _ in 0..3 {
        permutation.permute_rows(&mut vector);
        vector = upper.solve_upper_triangular(&lower.solve_lower_triangular(&vector)?)?;
        let size = vector.iter().fold(0.0, |most: f64, x| most.max(x.re.hypot(x.im)));
        if !size.is_finite() {
            break;
        }
        vector /= Complex::new(size, 0.0);
        if size > growth {
            (best, growth) = (Some(vector.clone()), size);
        }
    }
    best
}

/// Orthonormal vectors of the null space of a matrix whose entries err by `unit`, in which zero is `zeros`
/// times an eigenvalue: that many, or fewer where it is defective.
///
/// Inverse iteration would find the defective ones only, which it magnifies by the square of what it does to
/// others.
pub(super) fn null_vectors(matrix: &DMatrix<f64>, unit: f64, zeros: usize) -> Vec<DVector<Complex<f64>>> {
    let order = matrix.nrows();
    if zeros == 0 {
        return Vec::new();
    }
    // Rows are divided by the scales of their parts, so that a soft part does not vanish beside a stiff one.
    let mut rows = matrix.transpose();
    for members in parts(matrix) {
        let scale = largest(&matrix.select_rows(&members).select_columns(&members));
        for i in members {
            let size = rows.column(i).amax().max(scale);
            if size > 0.0 {
                rows.column_mut(i).unscale_mut(size);
            }
        }
    }
    let factors = ColPivQR::new(rows);
    let rank = factors.r().diagonal().iter().take_while(|x| x.abs() > rounding(order, unit)).count();
    let count = (order - rank).clamp(1, zeros);
    let vectors = factors.q().columns(order - count, count).map(|x| Complex::new(x, 0.0));
    vectors.column_iter().map(|vector| vector.into_owned()).collect()
}
