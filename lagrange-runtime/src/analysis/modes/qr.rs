//! Eigenvalues by the QR iteration with double shifts, as EISPACK's `hqr` (Golub and Van Loan, *Matrix
//! Computations*, 4th ed., § 7.5; Wilkinson and Reinsch, *Handbook for Automatic Computation* II/14).
//!
//! That of nalgebra has no exceptional shifts and does not look for two small entries in succession: where
//! eigenvalues of equal modulus surround zero (a cyclic permutation, the quadruples of gyroscopic systems) or
//! are nearly equal, it can go on for ever, also on matrices that are similar or moved by a multiple of the
//! unit matrix.

use std::vec::Vec;

use nalgebra::{Complex, DMatrix, Hessenberg};

use super::largest;
use crate::number::elements::{Each, array};

/// Iterations for one eigenvalue or pair: two or three are usual.
const ITERATIONS: usize = 100;

/// Iterations before a shift is exceptional, and between two such shifts.
const PATIENCE: usize = 10;

/// All eigenvalues; `None` where the iteration fails.
pub(super) fn iterated(matrix: DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    if matrix.nrows() < 2 {
        return Some(matrix.iter().map(|&x| Complex::new(x, 0.0)).collect());
    }
    let norm = largest(&matrix);
    let mut h = if matrix.nrows() > 2 { Hessenberg::new(matrix).unpack_h() } else { matrix };
    let (mut values, mut end, mut moved, mut count) = (Vec::new(), h.nrows(), 0.0, 0);
    while end > 0 {
        let last = end - 1;
        // Beside a small diagonal, or equal eigenvalues, an entry may keep the size of some rounding errors
        // of the matrix.
        let floor = if count < PATIENCE { 0.0 } else { norm * 2.0_f64.powi((count / PATIENCE) as i32 - 1) };
        let is_small = |&l: &usize| {
            let beside = h[(l, l)].abs() + h[(l - 1, l - 1)].abs();
            h[(l, l - 1)].abs() <= f64::EPSILON * beside.max(floor)
        };
        let start = (1..end).rev().find(is_small).unwrap_or(0);
        if last - start < 2 {
            if start == last {
                values.push(Complex::new(h[(last, last)] + moved, 0.0));
            } else {
                let row = |i: usize| [h[(i, start)], h[(i, last)]];
                values.extend(of_two([row(start), row(last)]).each(|value| value + moved));
            }
            (end, count) = (start, 0);
            continue;
        }
        if count == ITERATIONS {
            return None;
        }
        count += 1;
        // Both shifts by their sum and product.
        let corner = |i: usize, j: usize| h[(last - 1 + i, last - 1 + j)];
        let mut shifts = [corner(0, 0), corner(1, 1), corner(0, 1) * corner(1, 0)];
        if count % PATIENCE == 0 {
            let by = h[(last, last)];
            moved += by;
            for i in 0..end {
                h[(i, i)] -= by;
            }
            let size = h[(last, last - 1)].abs() + h[(last - 1, last - 2)].abs();
            shifts = [0.75 * size, 0.75 * size, -0.4375 * size * size];
        }
        sweep(&mut h, start, end, shifts);
    }
    Some(values)
}

/// One step with both shifts on the rows and columns from `start` to `end`: `shifts` are the diagonal of the
/// 2 × 2 matrix whose eigenvalues they are, and the product of its other entries.
fn sweep(h: &mut DMatrix<f64>, start: usize, end: usize, [x, y, w]: [f64; 3]) {
    let last = end - 1;
    // The first column of (H − s₁)(H − s₂). The step begins at two small entries in succession, if there are
    // any.
    let first = |m: usize| {
        let z = h[(m, m)];
        let (r, s) = (x - z, y - z);
        let column =
            [(r * s - w) / h[(m + 1, m)] + h[(m, m + 1)], h[(m + 1, m + 1)] - z - r - s, h[(m + 2, m + 1)]];
        let size: f64 = column.iter().map(|x| x.abs()).sum();
        if size > 0.0 { column.each(|x| x / size) } else { column }
    };
    let begins = |&m: &usize| {
        let [p, q, r] = first(m);
        let around = h[(m - 1, m - 1)].abs() + h[(m, m)].abs() + h[(m + 1, m + 1)].abs();
        h[(m, m - 1)].abs() * (q.abs() + r.abs()) <= f64::EPSILON * p.abs() * around
    };
    let begin = (start + 1..last - 1).rev().find(begins).unwrap_or(start);
    let mut column = first(begin);
    for i in begin + 2..end {
        for j in begin.max(i.saturating_sub(3))..i - 1 {
            h[(i, j)] = 0.0;
        }
    }
    for k in begin..last {
        let rows = (end - k).min(3);
        if k > begin {
            column = array(|i| if i < rows { h[(k + i, k - 1)] } else { 0.0 });
        }
        let size: f64 = column.iter().map(|x| x.abs()).sum();
        if size == 0.0 {
            continue;
        }
        let [p, q, r] = column.each(|x| x / size);
        let s = (p * p + q * q + r * r).sqrt().copysign(p);
        if k > begin {
            h[(k, k - 1)] = -s * size;
            for i in 1..rows {
                h[(k + i, k - 1)] = 0.0;
            }
        } else if begin > start {
            h[(k, k - 1)] = -h[(k, k - 1)];
        }
        // The reflection 1 − a bᵀ.
        let (a, b) = ([(p + s) / s, q / s, r / s], [1.0, q / (p + s), r / (p + s)]);
        for j in k..end {
            let sum: f64 = (0..rows).map(|i| b[i] * h[(k + i, j)]).sum();
            for i in 0..rows {
                h[(k + i, j)] -= a[i] * sum;
            }
        }
        for i in start..end.min(k + 4) {
            let sum: f64 = (0..rows).map(|j| a[j] * h[(i, k + j)]).sum();
            for j in 0..rows {
                h[(i, k + j)] -= b[j] * sum;
            }
        }
    }
}

/// The eigenvalues of [[a, b], [c, d]].
pub(super) fn of_two([[a, b], [c, d]]: [[f64; 2]; 2]) -> [Complex<f64>; 2] {
    let (mean, half) = (0.5 * (a + d), 0.5 * (a - d));
    let discriminant = half * half + b * c;
    let root = discriminant.abs().sqrt();
    if discriminant < 0.0 {
        return [Complex::new(mean, root), Complex::new(mean, -root)];
    }
    let real = |x: f64| Complex::new(x, 0.0);
    if mean == 0.0 || root == 0.0 {
        return [real(mean + root), real(mean - root)];
    }
    // As a difference, the smaller one would be a rounding error of the larger one. Kahan's ad − bc errs by
    // two ulps.
    let large = mean + root.copysign(mean);
    let product = b * c;
    let determinant = a.mul_add(d, -product) - b.mul_add(c, -product);
    [real(large), real(determinant / large)]
}
