//! What is known of a state where constraints nearly depend on each other.
//!
//! Rounding leaves f at some multiple of ε, so beside a configuration in which A loses rank, as at the dead centre of a
//! linkage, coordinates are uncertain by ε over the singular value, and with them the directions of the gradients. A
//! residual that is no larger than that says nothing, but divided by the singular value it would become a large change of
//! the state, and remove true motion with it. Such residuals are weighed against their noise: the change is the
//! likeliest one if changes of the size τ are to be expected,
//!
//! ```text
//! Δ = M⁻¹ Aᵀ (A M⁻¹ Aᵀ + D)⁻¹ y = Y (1 + D T)⁻¹ y,   D = (noise / τ)²
//! ```
//!
//! with the blocks Y and T of [`SaddlePoint`]. Where singular values exceed noise / τ nothing changes.

use super::extent::Extent;
use super::projection::{ROUNDINGS, is_within};
use super::{Residuals, Surface, moved};
use crate::linear::SaddlePoint;
use crate::real::Real;
use crate::state::State;
use crate::system::Blur;

/// So many times the noise is still noise.
const MARGIN: f64 = 4.0;

/// The first τ is √ε of the state, the others are larger by this factor.
const GROWTH: f64 = 64.0;

/// How often τ may grow: to the size of the state in `f64`.
const GROWTHS: usize = 5;

/// So far, relative to the coordinates, is beside a state.
const BESIDE: f64 = 1e-3;

/// So far is ahead of a state.
const AHEAD: f64 = 1e-6;

/// What rounding makes of the residuals of one level.
#[derive(Clone, Copy)]
pub(super) struct Noise<R, const C: usize> {
    each: [R; C],
    /// How large the constraints are in such a state.
    sizes: [R; C],
}

impl<R: Real, const C: usize> Noise<R, C> {
    /// Of positions: roundings. Of rates: roundings, and what the noise of the positions makes of the gradients.
    pub(super) fn of<S, const N: usize, const K: usize>(
        system: &S,
        state: &State<R, N>,
        saddle: &S::Saddle,
        gradients: &[[R; N]; C],
        residuals: &Residuals<R, C>,
        of_positions: bool,
    ) -> Self
    where
        S: Surface<N, K, C, Scalar = R>,
    {
        let none = [R::zero(); N];
        let ulps = R::from_f64(ROUNDINGS) * R::epsilon();
        let (_, sizes) = residuals.level(of_positions);
        let by_state =
            Extent::of(saddle, if of_positions { &state.q } else { &state.v }).sizes(saddle, gradients);
        let sizes: [R; C] = core::array::from_fn(|c| sizes[c] + by_state[c]);
        let mut each = sizes.map(|size| ulps * size);
        if of_positions {
            return Self { each, sizes };
        }
        for c in 0..C {
            let mut residual = [R::zero(); C];
            residual[c] = ulps * residuals.position_sizes[c];
            let (change, _) = saddle.solve(&none, &residual);
            let there = moved(state, &change, &none, R::one());
            let rates = system.residuals_at(there.t, &there.q, &there.v).rates;
            for d in 0..C {
                each[d] += (rates[d] - residuals.rates[d]).abs();
            }
        }
        Self { each, sizes }
    }

    /// Whether residuals are no more than noise. Of a row that depends on the others coordinates are known to √ε only,
    /// because f is of second order in what it restricts.
    pub(super) fn explains<const N: usize>(
        &self,
        residuals: &Residuals<R, C>,
        of_positions: bool,
        saddle: &impl SaddlePoint<R, N, C>,
    ) -> bool {
        let (values, _) = residuals.level(of_positions);
        (0..C).all(|c| {
            let mut noise = R::from_f64(MARGIN) * self.each[c];
            if saddle.is_dropped(c) && !of_positions {
                noise += R::epsilon().sqrt() * self.sizes[c];
            }
            is_within(values[c], noise)
        })
    }

    /// (1 + D T)⁻¹ y with the least τ that leaves noise; `extent` is the size of the state in the kinetic metric.
    pub(super) fn damped<const N: usize>(
        &self,
        saddle: &impl SaddlePoint<R, N, C>,
        residual: &[R; C],
        extent: Extent<R>,
    ) -> [R; C] {
        let none = [R::zero(); N];
        // What a unit of each residual moves, in units of the kinetic energy. T from the multipliers would not be that of the
        // rows that count where others are dropped.
        let units = saddle.units();
        let moves: [[R; N]; C] = core::array::from_fn(|c| {
            let mut unit = [R::zero(); C];
            unit[c] = R::one();
            let (mut change, _) = saddle.solve(&none, &unit);
            for (x, &unit) in change.iter_mut().zip(&units) {
                *x = if unit == R::zero() { R::zero() } else { *x / unit };
            }
            change
        });
        let product = |c: usize, d: usize| (0..N).fold(R::zero(), |sum, i| sum + moves[c][i] * moves[d][i]);
        let stiffness: [[R; C]; C] = core::array::from_fn(|c| core::array::from_fn(|d| product(c, d)));
        let mut tau = R::epsilon().sqrt() * extent.size();
        for _ in 0..GROWTHS {
            let Some(damped) = self.damped_by(&stiffness, residual, tau) else { break };
            let margin = R::from_f64(MARGIN);
            if (0..C).all(|c| is_within(residual[c] - damped[c], margin * self.each[c])) {
                return damped;
            }
            tau *= R::from_f64(GROWTH);
        }
        *residual
    }

    /// With E = √D: E (1 + E T E)⁻¹ E⁻¹ y, by the elimination of a symmetric matrix whose pivots are at least one.
    fn damped_by(&self, stiffness: &[[R; C]; C], residual: &[R; C], tau: R) -> Option<[R; C]> {
        if !tau.is_positive() || !self.each.iter().all(|noise| noise.is_positive()) {
            return None;
        }
        let weights = self.each.map(|noise| noise / tau);
        let mut matrix = [[R::zero(); C]; C];
        for c in 0..C {
            for d in 0..C {
                matrix[c][d] = weights[c] * stiffness[c][d] * weights[d];
            }
            matrix[c][c] += R::one();
        }
        let mut x: [R; C] = core::array::from_fn(|c| residual[c] / weights[c]);
        for k in 0..C {
            // Less than one is rounding, where T is large in directions that depend on each other.
            let pivot = matrix[k][k].max(R::one());
            matrix[k][k] = pivot;
            for i in k + 1..C {
                let l = matrix[i][k] / pivot;
                let row = matrix[k];
                for (to, &above) in matrix[i].iter_mut().zip(&row) {
                    *to = R::mul_add(-l, above, *to);
                }
                x[i] = R::mul_add(-l, x[k], x[i]);
            }
        }
        for k in (0..C).rev() {
            for j in k + 1..C {
                x[k] = R::mul_add(-matrix[k][j], x[j], x[k]);
            }
            x[k] /= matrix[k][k];
        }
        let damped = core::array::from_fn(|c| weights[c] * x[c]);
        damped.iter().all(|x| x.is_finite()).then_some(damped)
    }
}

/// How uncertain a state on its constraints is through what rounding leaves of these; infinitely where constraints
/// depend on each other that are independent beside it.
#[cold]
pub fn blur<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    t: S::Scalar,
    q: &[S::Scalar; N],
    v: &[S::Scalar; N],
) -> Blur<S::Scalar, N>
where
    S: Surface<N, K, C>,
{
    let number = S::Scalar::from_f64;
    let state = State { t, q: *q, v: *v };
    let (mut blur, rank, time) = local(system, &state);
    let none = [num_traits::Zero::zero(); N];
    for share in [number(BESIDE), -number(BESIDE)] {
        let there = moved(&state, v, &none, share * time);
        if there.is_finite() && system.saddle_at(t, &there.q, v).0.rank() > rank {
            blur.relative = number(f64::INFINITY);
        }
    }
    let ahead = moved(&state, v, &none, number(AHEAD) * time);
    if ahead.is_finite() {
        blur.growth = local(system, &ahead).0.relative - blur.relative;
    }
    blur
}

/// The uncertainty of a state without a look beside it, the rank, and the time in which coordinates change by their size.
fn local<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
) -> (Blur<S::Scalar, N>, usize, S::Scalar)
where
    S: Surface<N, K, C>,
{
    let zero: S::Scalar = num_traits::Zero::zero();
    let none = [zero; N];
    let State { t, q, v } = state;
    let (saddle, gradients) = system.saddle_at(*t, q, v);
    let residuals = system.residuals_at(*t, q, v);
    let size = Extent::of(&saddle, v).size();
    let mut blur = Blur { q: none, v: none, relative: zero, growth: zero };
    for of_positions in [true, false] {
        let noise = Noise::of(system, state, &saddle, &gradients, &residuals, of_positions);
        let blurred = if of_positions { &mut blur.q } else { &mut blur.v };
        for c in 0..C {
            let mut residual = [zero; C];
            residual[c] = noise.each[c];
            let (change, _) = saddle.solve(&none, &residual);
            for i in 0..N {
                blurred[i] += change[i].abs();
            }
        }
    }
    blur.relative = Extent::of(&saddle, &blur.v).size() / size;
    (blur, saddle.rank(), Extent::of(&saddle, q).size() / size)
}
