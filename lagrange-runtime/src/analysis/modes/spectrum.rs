//! Eigenvalues of a real matrix: of its strongly connected parts, without their zeros, by the QR iteration.
//!
//! A matrix whose pattern splits is block triangular, so that the eigenvalues are those of its parts, each
//! with a scale of its own: what is stiff in one part does not round what is soft in another. A null space
//! takes no iteration, and without it zeros that depend on each other (a free motion has two) would come out
//! as the root of a rounding.

use std::rc::Rc;
use std::vec::Vec;

use nalgebra::{ColPivQR, Complex, DMatrix};

use super::balance::{balance, moderated};
use super::qr::{iterated, of_two};
use super::vectors::eigenvector;
use super::{largest, rounding};

/// One eigenvalue.
pub(super) struct Eigenvalue {
    /// λ.
    pub value: Complex<f64>,
    /// The largest entry of its balanced part, by which its error is measured.
    pub scale: f64,
    /// The rows of that part.
    pub members: Rc<[usize]>,
}

/// All eigenvalues of a matrix whose entries have a relative error of `unit`; `None` where the iteration
/// fails. With `is_reversible` they lie symmetrically about both axes.
pub(super) fn eigenvalues(matrix: &DMatrix<f64>, unit: f64, is_reversible: bool) -> Option<Vec<Eigenvalue>> {
    let mut found = Vec::new();
    for members in parts(matrix) {
        let members: Rc<[usize]> = members.into();
        let mut part = matrix.select_rows(&*members).select_columns(&*members);
        balance(&mut part);
        let size = moderated(&mut part);
        let (scale, share) = (largest(&part), rounding(members.len(), unit));
        for value in of_part(&part, share * scale)? {
            let value = if is_reversible { settled(&part, value, scale, share) } else { value };
            found.push(Eigenvalue { value: value * size, scale: scale * size, members: members.clone() });
        }
    }
    Some(found)
}

/// The strongly connected parts of the graph whose edges are the entries other than zero.
pub(super) fn parts(matrix: &DMatrix<f64>) -> Vec<Vec<usize>> {
    let count = matrix.nrows();
    let mut reaches = matrix.map(|x| x != 0.0);
    reaches.fill_diagonal(true);
    for (by, from) in (0..count).flat_map(|by| (0..count).map(move |from| (by, from))) {
        if reaches[(from, by)] {
            for to in 0..count {
                reaches[(from, to)] |= reaches[(by, to)];
            }
        }
    }
    let together = |i: usize, j: usize| reaches[(i, j)] && reaches[(j, i)];
    let leads = |&i: &usize| !(0..i).any(|j| together(i, j));
    (0..count).filter(leads).map(|i| (i..count).filter(|&j| together(i, j)).collect()).collect()
}

/// The eigenvalues of a balanced part that does not split.
fn of_part(part: &DMatrix<f64>, tolerance: f64) -> Option<Vec<Complex<f64>>> {
    if part.nrows() == 2 {
        // The closed form resolves eigenvalues that elimination and iteration would take for zero.
        return Some(of_two([[part[(0, 0)], part[(0, 1)]], [part[(1, 0)], part[(1, 1)]]]).to_vec());
    }
    // A single entry is exact.
    let rest = if part.nrows() > 1 { deflated(part, tolerance) } else { part.clone() };
    let mut values = std::vec![Complex::new(0.0, 0.0); part.nrows() - rest.nrows()];
    values.extend(iterated(rest)?);
    Some(values)
}

/// The matrix on the orthogonal complement of its null space, again and again until that is regular.
fn deflated(part: &DMatrix<f64>, tolerance: f64) -> DMatrix<f64> {
    let mut rest = part.clone();
    loop {
        let factors = ColPivQR::new(rest.transpose());
        let upper = factors.r();
        // The pivot is the largest entry left, so that behind a small one everything is small.
        let rank = upper.diagonal().iter().take_while(|x| x.abs() > tolerance).count();
        if rank == rest.nrows() {
            return rest;
        }
        let images = factors.q().columns(0, rank).into_owned();
        rest = images.transpose() * rest * images;
    }
}

/// The eigenvalue, with an exact zero for a real or an imaginary part that is smaller than its error.
///
/// To first order an eigenvalue is as uncertain as the matrix times |x| |y| / |yᵀx|, where x and y are its
/// eigenvectors of the matrix and of the transpose. Where two eigenvalues meet, yᵀx is zero: their relative
/// error is then the root of that of the matrix, and no error is larger (Golub and Van Loan, § 7.2.2).
fn settled(part: &DMatrix<f64>, value: Complex<f64>, scale: f64, share: f64) -> Complex<f64> {
    // Both of a conjugate pair get the same treatment.
    let above = Complex::new(value.re, value.im.abs());
    let all: Vec<usize> = (0..part.nrows()).collect();
    let vector = |matrix: &DMatrix<f64>| eigenvector(matrix, above, scale, (&all, 0));
    let (Some(x), Some(y)) = (vector(part), vector(&part.transpose())) else { return value };
    let overlap = x.dot(&y);
    let condition = x.norm() * y.norm() / overlap.re.hypot(overlap.im);
    let bound = scale * (share * condition).min(share.sqrt());
    let part = |x: f64| if x.abs() <= bound { 0.0 } else { x };
    Complex::new(part(value.re), part(value.im))
}

#[cfg(test)]
mod tests;
