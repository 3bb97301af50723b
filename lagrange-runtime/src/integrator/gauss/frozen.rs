//! Newton's method with one matrix for all stages and corrections.
//!
//! With g = M⁻¹ f − a at each stage, a correction Δ of the accelerations solves
//! M Δᵢ − h Σ aᵢⱼ ∂r/∂v Δⱼ − h² Σ (A²)ᵢⱼ ∂r/∂q Δⱼ = M gᵢ, with M and the derivatives of r = f − M a at one
//! state for all stages. (With rᵢ on the right instead of M gᵢ, the change of M over a step would slow the
//! iteration down.) In the eigenvectors of A that is one complex system of size N for each pair of conjugate
//! eigenvalues λ, and for a real one: (M − hλ ∂r/∂v − (hλ)² ∂r/∂q) w = M g. The matrix is made anew where
//! corrections shrink too slowly.

use num_traits::Zero;

use super::stages::{Places, Stages, Verdict};
use crate::linear::complex::{Complex, ComplexLu};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, extent, larger};
use crate::system::linearized::{Linearization, Linearized};
use crate::system::state::State;

/// The most corrections of a solution.
const CORRECTIONS: usize = 40;

/// The most matrices of a solution.
const MATRICES: usize = 4;

/// The most modes of a method, each of a real eigenvalue or of a pair of conjugate ones.
const MODES: usize = 2;

/// The factored matrices, one for each mode.
struct Factors<R, const N: usize> {
    mass: [[R; N]; N],
    modes: [Option<ComplexLu<R, N>>; MODES],
}

impl<S, const N: usize, const K: usize, const STAGES: usize> Stages<'_, S, N, K, STAGES>
where
    S: Linearized<N, K>,
    S::Scalar: Ordered,
{
    /// Accelerations at the stages, from a guess; `None` if corrections do not shrink to rounding errors.
    pub(super) fn solve(&self, guess: [[S::Scalar; N]; STAGES]) -> Option<[[S::Scalar; N]; STAGES]> {
        let mut a = guess;
        let mut factors = self.factored(&a);
        let mut matrices = 1;
        let mut before = None;
        for _ in 0..CORRECTIONS {
            let change = self.corrected(&mut a, &factors);
            match self.verdict(&a, change, &mut before) {
                Verdict::Solved => return Some(a),
                Verdict::Going => {}
                Verdict::Slow if matrices < MATRICES => {
                    factors = self.factored(&a);
                    matrices += 1;
                    before = None;
                }
                Verdict::Slow | Verdict::Lost => return None,
            }
        }
        None
    }

    /// One correction; returns the largest change of a velocity by it.
    fn corrected(&self, a: &mut [[S::Scalar; N]; STAGES], factors: &Factors<S::Scalar, N>) -> S::Scalar {
        let mut residuals = [[S::Scalar::zero(); N]; STAGES];
        let Places { q, v } = self.places(a);
        for (i, residual) in residuals.iter_mut().enumerate() {
            let found = self.system.accelerations_at(self.constants, self.time(i), &q[i], &v[i], self.u);
            let defect: [_; N] = array(|n| found[n] - a[i][n]);
            for (residual, mass) in residual.iter_mut().zip(&factors.mass) {
                for (&mass, &defect) in mass.iter().zip(&defect) {
                    *residual += mass * defect;
                }
            }
        }
        let mut change = S::Scalar::zero();
        let mut finite = true;
        let mut total = [[S::Scalar::zero(); N]; STAGES];
        for (mode, factors) in self.table.modes.iter().zip(&factors.modes) {
            let Some(factors) = factors else { continue };
            let mut right = [Complex { re: S::Scalar::zero(), im: S::Scalar::zero() }; N];
            for (weight, residual) in mode.row.iter().zip(&residuals) {
                let weight = Complex::<S::Scalar>::from_f64(*weight);
                for (right, &r) in right.iter_mut().zip(residual) {
                    *right = *right + weight.scaled(r);
                }
            }
            let solution = factors.solve(&right);
            for (weight, total) in mode.column.iter().zip(&mut total) {
                let weight = Complex::<S::Scalar>::from_f64(*weight);
                for (total, &w) in total.iter_mut().zip(&solution) {
                    *total += weight.re * w.re - weight.im * w.im;
                }
            }
        }
        for (a, total) in a.iter_mut().flatten().zip(total.iter().flatten()) {
            *a += *total;
            finite &= a.is_finite();
            change = larger(change, extent(self.h * *total));
        }
        if finite { change } else { S::Scalar::from_f64(f64::NAN) }
    }

    /// The matrices of all modes in the middle of the step, factored.
    fn factored(&self, a: &[[S::Scalar; N]; STAGES]) -> Factors<S::Scalar, N> {
        let (State { t, q, v }, a) = self.middle(a);
        let Linearization { mass, by_q, by_v } =
            self.system.linearization_at(self.constants, t, &q, &v, &a, self.u);
        let mut modes = [None; MODES];
        for (factors, mode) in modes.iter_mut().zip(self.table.modes) {
            let once = Complex::from_f64(mode.value).scaled(self.h);
            let twice = once * once;
            *factors = Some(ComplexLu::factor(array(|i| {
                array(|j| {
                    let mass = Complex { re: mass[i][j], im: S::Scalar::zero() };
                    mass - (once.scaled(by_v[i][j]) + twice.scaled(by_q[i][j]))
                })
            })));
        }
        Factors { mass, modes }
    }
}
