//! Small oscillations: eigenvalues and shapes, on hosts with a standard library.
//!
//! Without damping, gyroscopic and circulatory forces, the stiffness is brought to the orthonormal coordinates of the
//! inertia, K̃ = L⁻¹ K L⁻ᵀ with M = L Lᵀ, and is a symmetric eigenproblem (Golub and Van Loan, *Matrix Computations*, 4th
//! ed., § 8.7). Otherwise the eigenvalues are those of the balanced state matrix, and inverse iteration gives the shapes.

use std::vec::Vec;

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Cholesky, Complex, DMatrix, DVector, SMatrix, SVector, Schur, SymmetricEigen};

use super::{Basis, LinearModel};
use crate::error::Cause;
use crate::real::{Ordered, Real};

/// Entries below this share of their scale are rounding.
const ROUNDING: f64 = 1e-13;

/// Iterations for each eigenvalue before the search is given up.
const ITERATIONS: usize = 400;

/// One way to oscillate, or to grow or decay: δq = Re(shape · e^{λt}).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode<const N: usize> {
    /// λ \[1/s]; of a conjugate pair the one with positive imaginary part.
    pub eigenvalue: Complex<f64>,
    /// In all coordinates: of unit φᴴ M φ where that is positive, its largest component real and positive.
    pub shape: SVector<Complex<f64>, N>,
}

impl<const N: usize> Mode<N> {
    /// Natural frequency |λ| \[rad/s], which of an undamped mode is the frequency.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.eigenvalue.re.hypot(self.eigenvalue.im)
    }

    /// Damping ratio −Re λ / |λ|: 0 undamped, 1 from the critical damping on, negative where the mode grows; zero for λ = 0.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        if self.frequency() > 0.0 { -self.eigenvalue.re / self.frequency() } else { 0.0 }
    }
}

/// Eigenvalues and shapes, by frequency.
pub(super) fn modes<R, const N: usize, const K: usize>(
    model: &LinearModel<R, N, K>,
) -> Result<Vec<Mode<N>>, Cause>
where
    R: Ordered + Into<f64>,
{
    let mass = doubled(&model.mass);
    let mut modes = match symmetric(model, &mass) {
        Some(modes) => modes,
        None => general(model, &mass)?,
    };
    modes.sort_by(|a, b| {
        let (a, b) = ((a.frequency(), a.eigenvalue.re), (b.frequency(), b.eigenvalue.re));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    Ok(modes)
}

fn doubled<R: Real + Into<f64>, const A: usize, const B: usize>(
    matrix: &SMatrix<R, A, B>,
) -> SMatrix<f64, A, B> {
    matrix.map(Into::into)
}

/// The vectors of a basis as columns.
fn columns<R: Real + Into<f64>, const N: usize>(basis: &Basis<R, N>) -> DMatrix<f64> {
    DMatrix::from_fn(N, basis.len(), |i, k| basis.vectors()[(i, k)].into())
}

fn largest(matrix: &DMatrix<f64>) -> f64 {
    matrix.iter().fold(0.0, |most, x| x.abs().max(most))
}

/// Small oscillations of a system whose linear equations are M ξ̈ + K ξ = 0 with symmetric matrices; `None` for others.
fn symmetric<R, const N: usize, const K: usize>(
    model: &LinearModel<R, N, K>,
    mass: &SMatrix<f64, N, N>,
) -> Option<Vec<Mode<N>>>
where
    R: Ordered + Into<f64>,
{
    let count = model.velocities.len();
    let is_second_order = count == model.displacements.len()
        && (0..count).all(|i| (0..count).all(|j| model.entry(i, j) == R::zero()));
    if !is_second_order {
        return None;
    }
    let basis = columns(&model.velocities);
    let on = |matrix: &SMatrix<f64, N, N>| basis.transpose() * matrix * &basis;
    let lower = Cholesky::new(on(mass))?.l();
    let transformed = |matrix: DMatrix<f64>| {
        let half = lower.solve_lower_triangular(&matrix)?;
        lower.solve_lower_triangular(&half.transpose())
    };
    let stiffness = transformed(on(&doubled(&model.stiffness)))?;
    let forces = transformed(on(&(doubled(&model.damping) + doubled(&model.gyroscopic))))?;
    let skew = &stiffness - stiffness.transpose();
    let size = largest(&stiffness);
    if !(largest(&skew) <= ROUNDING * size && largest(&forces) <= ROUNDING * size.sqrt()) {
        return None;
    }
    let eigen = SymmetricEigen::new((&stiffness + stiffness.transpose()) * 0.5);
    let mut modes = Vec::new();
    for (k, &square) in eigen.eigenvalues.iter().enumerate() {
        let shape = lower.tr_solve_lower_triangular(&eigen.eigenvectors.column(k).into_owned())?;
        let shape = (&basis * shape).map(|x| Complex::new(x, 0.0));
        let root = square.abs().sqrt();
        let zero = square.abs() <= ROUNDING * size;
        let eigenvalues: &[Complex<f64>] = match square {
            _ if zero => &[Complex::new(0.0, 0.0)],
            square if square > 0.0 => &[Complex::new(0.0, root)],
            _ => &[Complex::new(-root, 0.0), Complex::new(root, 0.0)],
        };
        modes.extend(eigenvalues.iter().map(|&eigenvalue| mode(eigenvalue, &shape, mass)));
    }
    Some(modes)
}

/// Eigenvalues of the state matrix.
fn general<R, const N: usize, const K: usize>(
    model: &LinearModel<R, N, K>,
    mass: &SMatrix<f64, N, N>,
) -> Result<Vec<Mode<N>>, Cause>
where
    R: Ordered + Into<f64>,
{
    let order = model.order();
    if order == 0 {
        return Ok(Vec::new());
    }
    let mut balanced = DMatrix::from_fn(order, order, |i, j| model.entry(i, j).into());
    let scales = balance_parlett_reinsch(&mut balanced);
    let limit = ITERATIONS * order;
    let schur = Schur::try_new(balanced.clone(), f64::EPSILON, limit).ok_or(Cause::NotConverged)?;
    let basis = columns(&model.displacements);
    let mut modes = Vec::new();
    for (k, &eigenvalue) in
        schur.complex_eigenvalues().iter().enumerate().filter(|(_, value)| value.im >= 0.0)
    {
        let vector = eigenvector(&balanced, eigenvalue, k).ok_or(Cause::NotConverged)?;
        let shape: DVector<Complex<f64>> = DVector::from_fn(N, |i, _| {
            (0..basis.ncols()).map(|l| vector[l] * (scales[l] * basis[(i, l)])).sum()
        });
        modes.push(mode(eigenvalue, &shape, mass));
    }
    Ok(modes)
}

/// By inverse iteration from a start of its own, so that equal eigenvalues get different vectors where they have some.
fn eigenvector(
    matrix: &DMatrix<f64>,
    eigenvalue: Complex<f64>,
    start: usize,
) -> Option<DVector<Complex<f64>>> {
    let order = matrix.nrows();
    // Off the eigenvalue by some roundings, so that the matrix is regular.
    let shift = eigenvalue + Complex::new(largest(matrix), 0.0) * (8.0 * f64::EPSILON);
    let mut shifted = matrix.map(|x| Complex::new(x, 0.0));
    for i in 0..order {
        shifted[(i, i)] -= shift;
    }
    let factors = shifted.lu();
    let mut vector =
        DVector::from_fn(order, |i, _| Complex::new(((1 + i) as f64 * (1.3 + start as f64)).cos(), 0.5));
    for _ in 0..3 {
        vector = factors.solve(&vector)?;
        let size = vector.iter().fold(0.0, |most: f64, x| most.max(x.re.hypot(x.im)));
        if !(size.is_finite() && size > 0.0) {
            return None;
        }
        vector /= Complex::new(size, 0.0);
    }
    Some(vector)
}

/// A mode of unit mass, with its largest component real and positive.
fn mode<const N: usize>(
    eigenvalue: Complex<f64>,
    shape: &DVector<Complex<f64>>,
    mass: &SMatrix<f64, N, N>,
) -> Mode<N> {
    let shape = SVector::<Complex<f64>, N>::from_fn(|i, _| shape[i]);
    let modal = shape.dotc(&(mass.map(|x| Complex::new(x, 0.0)) * shape)).re;
    let size = |x: &Complex<f64>| x.re.hypot(x.im);
    let leading = shape.iter().fold(Complex::new(0.0, 0.0), |most, x| {
        // Of components of equal size the first leads, whatever their roundings.
        if size(x) > size(&most) * (1.0 + 1e-9) { *x } else { most }
    });
    if size(&leading) == 0.0 {
        return Mode { eigenvalue, shape };
    }
    let unit = if modal > 0.0 { modal.sqrt() } else { size(&leading) };
    let turn = leading.conj() / (size(&leading) * unit);
    Mode { eigenvalue, shape: shape.map(|x| x * turn) }
}
