//! The curvature of the potential energy, and the quadratic model that it makes.
//!
//! On the constraints the energy is, to second order in the components y of a motion, V − g·y + ½ yᵀ H y.
//! Here g are the forces that are left beside the multipliers of least squares. H = −Zᵀ (∂r/∂q) Z contains
//! the curvature of the constraints with their multipliers. The eigenvalues of H give the least value of this
//! model in a ball, also where H is not positive (J. Nocedal, S. Wright, *Numerical Optimization*, 2nd ed., §
//! 4.3): forces and negative curvature lead down alike.

use super::statics::{Rest, Statics, dot};
use crate::analysis::Tangent;
use crate::linear::diagonalise;
use crate::linear::stored::Stored;
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, smaller};

/// Halvings of the interval of the trust region's multiplier. The radius is arbitrary, so a few digits of it
/// suffice.
const HALVINGS: usize = 40;

/// The second derivatives of the energy, by eigenvalues and eigenvectors.
pub(super) struct Curvature<R, const N: usize> {
    pub values: [R; N],
    pub vectors: Stored<[[R; N]; N]>,
    /// Eigenvalues up to this size are rounding errors.
    pub rounding: R,
}

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// The curvature of the energy; `None` if forces have no potential.
    ///
    /// An entry errs by 16 N ε times the magnitudes of its summands at most, as in the modes.
    pub fn curvature(&self, rest: &Rest<S::Scalar, N, C>) -> Option<Curvature<S::Scalar, N>> {
        let count = rest.motions.count;
        let mut stiffness = rest.stiffness.clone();
        let share = S::Scalar::from_f64(16.0 * count as f64) * S::Scalar::epsilon();
        let rounding = share * stiffness.size;
        let rows = &mut stiffness.rows;
        for (k, l) in (0..count).flat_map(|k| (0..k).map(move |l| (k, l))) {
            let (above, below) = (rows[l][k], rows[k][l]);
            if (above - below).abs() > rounding {
                return None;
            }
            let mean = S::Scalar::from_f64(0.5) * (above + below);
            (rows[l][k], rows[k][l]) = (mean, mean);
        }
        let mut vectors = Stored::zeros();
        diagonalise(rows, &mut vectors, count);
        Some(Curvature { values: array(|k| rows[k][k]), vectors, rounding })
    }
}

impl<R: Ordered, const N: usize> Curvature<R, N> {
    /// How many directions lead up, are flat, and lead down.
    pub fn signature(&self, count: usize) -> [usize; 3] {
        self.signature_of(&self.values, count)
    }

    /// The same of other eigenvalues.
    pub fn signature_of(&self, values: &[R; N], count: usize) -> [usize; 3] {
        let mut signature = [0; 3];
        for &value in values.iter().take(count) {
            let which = if value > self.rounding {
                0
            } else if value < -self.rounding {
                2
            } else {
                1
            };
            signature[which] += 1;
        }
        signature
    }

    /// A vector along the motions, from its components along eigenvectors.
    pub fn turned(&self, components: &[R; N], count: usize) -> [R; N] {
        let mut sum = [R::zero(); N];
        for (vector, &y) in self.vectors.iter().zip(components).take(count) {
            for (sum, &z) in sum.iter_mut().zip(vector) {
                *sum = R::mul_add(y, z, *sum);
            }
        }
        sum
    }
}

/// −g·y + ½ Σ λ y², by components along eigenvectors.
pub(super) struct Model<R, const N: usize> {
    forces: [R; N],
    values: [R; N],
    least: R,
}

impl<R: Ordered, const N: usize> Model<R, N> {
    pub fn new(curvature: &Curvature<R, N>, forces: &[R; N], count: usize) -> Self {
        let mut along = [R::zero(); N];
        for (along, vector) in along.iter_mut().zip(curvature.vectors.iter()).take(count) {
            *along = dot(vector, forces);
        }
        Self { forces: along, values: curvature.values, least: R::zero() }
    }

    /// Sets curvatures that are rounding errors to zero, and with them forces below a bound.
    /// Along such directions, as along a symmetry, nothing holds the system and nothing drives it.
    pub fn flatten(&mut self, curvature: &Curvature<R, N>, bound: R) {
        for (value, force) in self.values.iter_mut().zip(&mut self.forces) {
            if value.abs() <= curvature.rounding {
                *value = R::zero();
                if force.abs() <= bound {
                    *force = R::zero();
                }
            }
            self.least = smaller(*value, self.least);
        }
    }

    /// The same with other units of forces and of curvatures.
    pub fn stretched(mut self, forces: R, values: R) -> Self {
        self.forces.iter_mut().for_each(|x| *x *= forces);
        self.values.iter_mut().chain([&mut self.least]).for_each(|x| *x *= values);
        self
    }

    /// Whether only forces in stiff directions lead down.
    pub fn is_low(&self) -> bool {
        let held = |(&value, &force): (&R, &R)| value > R::zero() || value == R::zero() && force == R::zero();
        self.values.iter().zip(&self.forces).all(held)
    }

    /// The squared length of Newton's step.
    pub fn newton_square(&self) -> R {
        self.square(R::zero())
    }

    /// A first radius: the length of Newton's step with the magnitudes of all curvatures that exceed rounding
    /// errors.
    pub fn scale(&self, rounding: R) -> R {
        let components = self.values.iter().zip(&self.forces);
        let stiff = components.filter(|(value, _)| value.abs() > rounding);
        stiff.fold(R::zero(), |sum, (&value, &force)| sum + (force / value) * (force / value)).sqrt()
    }

    /// |y|² where y = (H + μ)⁻¹ g.
    fn square(&self, shift: R) -> R {
        let mut sum = R::zero();
        for (&value, &force) in self.values.iter().zip(&self.forces) {
            if force != R::zero() {
                let y = force / (value + shift);
                sum = R::mul_add(y, y, sum);
            }
        }
        sum
    }

    /// The minimum of the model within a radius, the fall to it, and whether the radius limits it.
    pub fn step(&self, radius: R, count: usize) -> ([R; N], R, bool) {
        let most = radius * radius;
        let is_cut = !(self.is_low() && self.square(R::zero()) <= most);
        let mut shift = R::zero();
        if is_cut {
            // |y| falls as μ grows: from its value at the pole, which may be infinite, to less than the
            // radius.
            let force = dot(&self.forces, &self.forces).sqrt();
            let (mut low, mut high) = (-self.least, -self.least + force / radius);
            for _ in 0..HALVINGS {
                let middle = R::from_f64(0.5) * (low + high);
                if self.square(middle) <= most { high = middle } else { low = middle }
            }
            shift = high;
        }
        let mut y = [R::zero(); N];
        for (y, (&value, &force)) in y.iter_mut().zip(self.values.iter().zip(&self.forces)) {
            if force != R::zero() {
                *y = force / (value + shift);
            }
        }
        // The hard case: there is no force along the most negative curvature, so both of its directions lead
        // down.
        let rest = most - dot(&y, &y);
        let is_hard = is_cut && self.least < R::zero() && rest > R::from_f64(0.5) * most;
        if let Some(k) = (0..count).find(|&k| is_hard && self.values[k] == self.least) {
            let sign = if self.forces[k] < R::zero() { -R::one() } else { R::one() };
            y[k] = sign * (rest + y[k] * y[k]).sqrt();
        }
        let half = R::from_f64(0.5);
        let terms = y.iter().zip(self.values.iter().zip(&self.forces));
        let predicted =
            terms.fold(R::zero(), |sum, (&y, (&value, &force))| sum + y * (force - half * value * y));
        (y, predicted, is_cut)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model(values: [f64; 3], forces: [f64; 3]) -> Model<f64, 3> {
        let least = values.into_iter().fold(0.0, f64::min);
        Model { forces, values, least }
    }

    #[test]
    fn steps_are_the_least_of_their_ball() {
        for (values, forces, radius) in [
            ([1.0, 2.0, 4.0], [1.0, 1.0, 1.0], 10.0),
            ([1.0, 2.0, 4.0], [1.0, 1.0, 1.0], 0.1),
            ([-1.0, 2.0, 4.0], [1e-3, 1.0, -1.0], 0.7),
            ([-1.0, 2.0, 4.0], [0.0, 1.0, -1.0], 5.0),
            ([0.0, 2.0, 0.0], [0.3, 1.0, 0.0], 2.0),
        ] {
            let model = model(values, forces);
            let (y, predicted, is_cut) = model.step(radius, 3);
            let size = dot(&y, &y).sqrt();
            assert!(size <= radius * (1.0 + 1e-12));
            assert_eq!(is_cut, size > 0.99 * radius, "{y:?}");
            let value =
                |y: [f64; 3]| -> f64 { (0..3).map(|k| y[k] * (0.5 * values[k] * y[k] - forces[k])).sum() };
            assert!((value(y) + predicted).abs() < 1e-12);
            // No other point of the ball is lower.
            for i in 0..4000 {
                let (a, b) = (f64::from(i) * 2.399_963, 1.0 - f64::from(i) / 2000.0);
                let flat = (1.0 - b * b).max(0.0).sqrt();
                for share in [0.3, 0.7, 1.0] {
                    let r = share * radius;
                    let other = [r * flat * a.cos(), r * flat * a.sin(), r * b];
                    assert!(value(other) >= -predicted * (1.0 + 1e-5) - 1e-12, "{values:?}: {other:?} {y:?}");
                }
            }
        }
    }
}
