//! Small oscillations: eigenvalues and shapes, on hosts with a standard library.
//!
//! Without damping, gyroscopic and circulatory forces, the stiffness is brought to the orthonormal
//! coordinates of the inertia, K̃ = L⁻¹ K L⁻ᵀ with M = L Lᵀ, and is a symmetric eigenproblem (Golub and Van
//! Loan, *Matrix Computations*, 4th ed., § 8.7). Otherwise the eigenvalues are those of the balanced state
//! matrix, and inverse iteration gives the shapes.

mod balance;
mod qr;
mod spectrum;
mod vectors;

use std::vec::Vec;

use nalgebra::{Cholesky, Complex, DMatrix, DVector, SMatrix, SVector, SymmetricEigen};

use super::{Basis, LinearModel};
use crate::number::real::{Ordered, Real};
use crate::system::error::Cause;
pub(super) use balance::balance;
use balance::moderated;
use spectrum::{Eigenvalue, eigenvalues, parts};
use vectors::{eigenvector, null_vectors};

/// Iterations for each eigenvalue of a symmetric matrix before the search is given up.
const ITERATIONS: usize = 100;

/// The smallest scale of an eigenvalue beside entries of size one. Pivots are rounding errors of the
/// eigenvalue, and their squares must not underflow.
const SOFTEST: f64 = 1e-120;

const ZERO: Complex<f64> = Complex::new(0.0, 0.0);

/// The share of the largest entry of a matrix below which an eigenvalue is rounding error, if the entries
/// have the relative error `unit`.
fn rounding(order: usize, unit: f64) -> f64 {
    16.0 * order as f64 * unit
}

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

    /// Damping ratio −Re λ / |λ|: 0 undamped, 1 from the critical damping on, negative where the mode grows;
    /// zero for λ = 0.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        // Subtracting from zero gives an undamped mode a positive zero.
        if self.frequency() > 0.0 { 0.0 - self.eigenvalue.re / self.frequency() } else { 0.0 }
    }
}

/// Eigenvalues and shapes, by frequency. The stiffness is uncertain by the `blur` of its entries beside the
/// rounding errors of these.
pub(super) fn modes<R, const N: usize, const K: usize>(
    model: &LinearModel<R, N, K>,
    blur: &DMatrix<f64>,
) -> Result<Vec<Mode<N>>, Cause>
where
    R: Ordered + Into<f64>,
{
    let (mass, unit) = (doubled(&model.mass), R::epsilon().into());
    let order = model.order();
    let matrix = DMatrix::from_fn(order, order, |i, j| model.entry(i, j).into());
    let second_order = [&model.mass, &model.damping, &model.gyroscopic, &model.stiffness];
    if !(second_order.into_iter().all(|of| of.iter().all(|x| x.is_finite()))
        && matrix.iter().all(|x| x.is_finite()))
    {
        return Err(Cause::NotFinite);
    }
    let equations = SecondOrder::new(model, &mass, &(blur / unit));
    // The state matrix has one error for all of its entries.
    let blurred = unit * equations.as_ref().map_or(1.0, |equations| equations.blurred);
    // The symmetry of equations of the first order, as about a spin, is not known. So an eigenvalue counts as
    // on an axis if rounding could have moved it off.
    let is_reversible = equations.as_ref().is_none_or(|equations| equations.is_reversible(unit));
    let mut modes = match equations.and_then(|equations| equations.modes(&mass, unit)) {
        Some(modes) => modes,
        None => general(model, matrix, &mass, blurred, is_reversible).ok_or(Cause::NoEigenvalues)?,
    };
    let is_number = |x: &Complex<f64>| x.re.is_finite() && x.im.is_finite();
    if !modes.iter().all(|mode| is_number(&mode.eigenvalue) && mode.shape.iter().all(is_number)) {
        return Err(Cause::NotFinite);
    }
    modes.sort_by(|a, b| {
        let (a, b) = ((a.frequency(), a.eigenvalue.re), (b.frequency(), b.eigenvalue.re));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    Ok(modes)
}

/// All eigenvalues of a matrix whose entries have a relative error of `unit`; `None` if the iteration fails.
pub(super) fn values(matrix: &DMatrix<f64>, unit: f64) -> Option<Vec<Complex<f64>>> {
    let found = eigenvalues(matrix, unit, false)?;
    Some(found.into_iter().map(|found| found.value).collect())
}

/// How many eigenvalues grow, and how many neither grow nor decay.
pub(super) struct Growth {
    pub growing: usize,
    pub still: usize,
}

/// Counts eigenvalues by the signs of their real parts; `None` where the iteration fails. The numbers have
/// the relative error `unit`.
pub(super) fn growth<const N: usize, const K: usize>(
    model: &LinearModel<f64, N, K>,
    blur: &DMatrix<f64>,
    unit: f64,
) -> Option<Growth> {
    let equations = SecondOrder::new(model, &doubled(&model.mass), &(blur / unit));
    let blurred = unit * equations.as_ref().map_or(1.0, |equations| equations.blurred);
    let is_reversible = equations.is_some_and(|equations| equations.is_reversible(unit));
    let order = model.order();
    let matrix = DMatrix::from_fn(order, order, |i, j| model.entry(i, j));
    let found = eigenvalues(&matrix, blurred, is_reversible)?;
    let share = rounding(order, blurred);
    let count = |is: fn(f64, f64) -> bool| {
        found.iter().filter(|found| is(found.value.re, share * found.scale)).count()
    };
    Some(Growth { growing: count(|re, error| re > error), still: count(|re, error| re.abs() <= error) })
}

/// A number as a double, by its binary digits, since a scalar of the user's own has no conversion.
pub(super) fn double<R: Ordered>(value: R) -> f64 {
    let (mut rest, mut power) = (value.abs(), 1.0_f64);
    if !rest.is_finite() || rest == R::zero() {
        return if rest == R::zero() { 0.0 } else { f64::NAN };
    }
    // Brings the number between one and two.
    for shift in (0..10).rev().map(|k| 2.0_f64.powi(1 << k)) {
        let (factor, inverse) = (R::from_f64(shift), R::from_f64(shift.recip()));
        if rest >= factor {
            (rest, power) = (rest * inverse, power * shift);
        } else if rest < inverse {
            (rest, power) = (rest * factor, power / shift);
        }
    }
    if rest < R::one() {
        (rest, power) = (rest + rest, 0.5 * power);
    }
    let (mut sum, mut digit) = (0.0, 1.0_f64);
    for _ in 0..f64::MANTISSA_DIGITS {
        let place = R::from_f64(digit);
        if rest >= place {
            rest -= place;
            sum += digit;
        }
        digit *= 0.5;
    }
    let size = sum * power;
    if value < R::zero() { -size } else { size }
}

fn doubled<R: Real + Into<f64>, const N: usize>(matrix: &SMatrix<R, N, N>) -> DMatrix<f64> {
    DMatrix::from_fn(N, N, |i, j| matrix[(i, j)].into())
}

/// The vectors of a basis as columns.
fn columns<R: Real + Into<f64>, const N: usize>(basis: &Basis<R, N>) -> DMatrix<f64> {
    DMatrix::from_fn(N, basis.len(), |i, k| basis.vectors()[(i, k)].into())
}

fn largest(matrix: &DMatrix<f64>) -> f64 {
    matrix.iter().fold(0.0, |most, x| x.abs().max(most))
}

/// ξ̈ + (C̃ + G̃) ξ̇ + K̃ ξ = 0 in coordinates that are orthonormal in the inertia.
struct SecondOrder<const N: usize> {
    /// The coordinates as columns.
    shapes: DMatrix<f64>,
    damping: DMatrix<f64>,
    gyroscopic: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    /// The sums of the magnitudes in K̃, with what the numbers of the state leave open: the scale of the
    /// errors of its entries.
    sizes: DMatrix<f64>,
    /// The factor by which the largest of them exceeds the largest magnitude.
    blurred: f64,
}

impl<const N: usize> SecondOrder<N> {
    /// `None` if velocities are not the rates of as many displacements, or have no positive inertia. `blur`
    /// is the uncertainty of the stiffness in rounding errors.
    fn new<R, const K: usize>(
        model: &LinearModel<R, N, K>,
        mass: &DMatrix<f64>,
        blur: &DMatrix<f64>,
    ) -> Option<Self>
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
        let lower = Cholesky::new(basis.transpose() * mass * &basis)?.l();
        let shapes = lower.solve_lower_triangular(&basis.transpose())?.transpose();
        let on = |matrix: &SMatrix<R, N, N>| shapes.transpose() * doubled(matrix) * &shapes;
        let stiffness = doubled(&model.stiffness);
        let sizes = |stiffness: DMatrix<f64>| shapes.abs().transpose() * stiffness * shapes.abs();
        let magnitudes = sizes(stiffness.abs());
        let (most, sizes) = (largest(&magnitudes), magnitudes + sizes(blur.clone()));
        Some(Self {
            damping: on(&model.damping),
            gyroscopic: on(&model.gyroscopic),
            stiffness: on(&model.stiffness),
            blurred: if most > 0.0 { largest(&sizes) / most } else { 1.0 },
            sizes,
            shapes,
        })
    }

    /// Whether the motion is the same backwards, up to a reflection: forces without power and a potential.
    fn is_reversible(&self, unit: f64) -> bool {
        let share = rounding(self.stiffness.nrows(), unit);
        let skew = &self.stiffness - self.stiffness.transpose();
        largest(&self.damping) <= share * largest(&self.gyroscopic)
            && skew.iter().zip(&self.sizes).all(|(x, size)| x.abs() <= share * size)
    }

    /// The modes of a system with inertia and a potential alone; `None` for others.
    fn modes(&self, mass: &DMatrix<f64>, unit: f64) -> Option<Vec<Mode<N>>> {
        let pattern = self.stiffness.abs() + self.damping.abs() + self.gyroscopic.abs();
        let mut modes = Vec::new();
        for members in parts(&(&pattern + pattern.transpose())) {
            let count = members.len();
            let part = |matrix: &DMatrix<f64>| matrix.select_rows(&members).select_columns(&members);
            let (stiffness, forces) = (part(&self.stiffness), part(&self.damping) + part(&self.gyroscopic));
            let size = largest(&part(&self.sizes));
            let share = rounding(count, unit);
            let skew = &stiffness - stiffness.transpose();
            if !(largest(&skew) <= share * size && largest(&forces) <= share * size.sqrt()) {
                return None;
            }
            let even = (&stiffness + stiffness.transpose()) * 0.5;
            let eigen = SymmetricEigen::try_new(even, f64::EPSILON, ITERATIONS * count)?;
            for (&square, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
                let shape = (self.shapes.select_columns(&members) * vector).map(|x| Complex::new(x, 0.0));
                let root = square.abs().sqrt();
                let eigenvalues: &[Complex<f64>] = match square {
                    square if square.abs() <= share * size => &[ZERO],
                    square if square > 0.0 => &[Complex::new(0.0, root)],
                    _ => &[Complex::new(-root, 0.0), Complex::new(root, 0.0)],
                };
                modes.extend(eigenvalues.iter().map(|&eigenvalue| mode(eigenvalue, &shape, mass)));
            }
        }
        Some(modes)
    }
}

/// The modes of the state matrix; `None` where the iteration fails.
fn general<R, const N: usize, const K: usize>(
    model: &LinearModel<R, N, K>,
    matrix: DMatrix<f64>,
    mass: &DMatrix<f64>,
    unit: f64,
    is_reversible: bool,
) -> Option<Vec<Mode<N>>>
where
    R: Ordered + Into<f64>,
{
    let found = eigenvalues(&matrix, unit, is_reversible)?;
    let mut balanced = matrix;
    let scales = balance(&mut balanced);
    let size = moderated(&mut balanced);
    // A part that is so much softer than others has no digits beside them.
    if size != 1.0 && found.iter().any(|found| found.scale > 0.0 && found.scale / size < SOFTEST) {
        return None;
    }
    let (zeros, others): (Vec<_>, Vec<_>) =
        found.into_iter().filter(|found| found.value.im >= 0.0).partition(|found| found.value == ZERO);
    let mut vectors: Vec<_> =
        null_vectors(&balanced, unit, zeros.len()).into_iter().map(|vector| (ZERO, vector)).collect();
    for (k, Eigenvalue { value, scale, members }) in others.into_iter().enumerate() {
        vectors.push((value, eigenvector(&balanced, value / size, scale / size, (&members, k))?));
    }
    let basis = columns(&model.displacements);
    let mode = |(value, vector): (Complex<f64>, DVector<Complex<f64>>)| {
        let shape = DVector::from_fn(N, |i, _| {
            (0..basis.ncols()).map(|l| vector[l] * (scales[l] * basis[(i, l)])).sum()
        });
        mode(value, &shape, mass)
    };
    Some(vectors.into_iter().map(mode).collect())
}

/// A mode of unit mass, with its largest component real and positive.
fn mode<const N: usize>(
    eigenvalue: Complex<f64>,
    shape: &DVector<Complex<f64>>,
    mass: &DMatrix<f64>,
) -> Mode<N> {
    let [re, im] = [shape.map(|x| x.re), shape.map(|x| x.im)];
    let modal = re.dot(&(mass * &re)) + im.dot(&(mass * &im));
    let shape = SVector::<Complex<f64>, N>::from_fn(|i, _| shape[i]);
    let size = |x: &Complex<f64>| x.re.hypot(x.im);
    let leading = shape.iter().fold(ZERO, |most, x| {
        // Among components of equal size the first one leads, whatever their rounding errors.
        if size(x) > size(&most) * (1.0 + 1e-9) { *x } else { most }
    });
    if size(&leading) == 0.0 {
        return Mode { eigenvalue, shape };
    }
    let unit = if modal > 0.0 { modal.sqrt() } else { size(&leading) };
    let turn = leading.conj() / (size(&leading) * unit);
    Mode { eigenvalue, shape: shape.map(|x| x * turn) }
}
