//! Where a system can rest.
//!
//! Unknown are the coordinates alone: on the constraints, the multipliers of least squares solve Aᵀλ = −f as well as can be,
//! and what is left are the generalized forces g = Zᵀ f along the motions that the constraints allow. With these
//! multipliers the derivative of g along the constraints is exactly Zᵀ (∂r/∂q) Z, so that Levenberg–Marquardt steps converge
//! quadratically, also to equilibria that are not isolated (N. Yamashita, M. Fukushima, Computing Suppl. 15 (2001) 239).
//! After each step the coordinates are brought back onto the constraints. Sizes are measured in the inertia of the
//! coordinates, so that units do not matter.

use core::fmt;

use super::{Place, Tangent, Variation};
use crate::constraints::{Extent, INNER, magnitude};
use crate::error::{Cause, Magnitude};
use crate::linear::{Saddle, SaddlePoint, SingularValues, TangentSpace};
use crate::real::{Ordered, Real, larger, smaller};
use crate::state::State;

/// Steps before the search is given up.
const STEPS: usize = 200;

/// Damping, relative to the largest singular value squared: at the start, and what is too much.
const DAMPING: (f64, f64) = (1e-3, 1e12);

/// Forces have faded whose squares fell to this share of what they were.
const FADED: f64 = 1e-6;

/// Corrections back onto the constraints.
const CORRECTIONS: usize = 30;

/// An equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium<R, const N: usize, const C: usize> {
    /// At rest, at the time of the guess.
    pub state: State<R, N>,
    /// Multipliers λ in the order of `CONSTRAINTS`: `Aᵀλ` balances all other forces. Where constraints are redundant, those
    /// of least Σ λ².
    pub multipliers: [R; C],
    /// Whether the equilibrium determines each multiplier.
    pub are_unique: bool,
    /// Whether there is no other equilibrium nearby: the stiffness is regular on the motions that the constraints allow.
    pub is_isolated: bool,
}

/// Why there is no equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EquilibriumError {
    /// The constraints cannot be met near the guess, or something is not finite.
    Constraints(Cause),
    /// This constraint moves: it does not let the system rest.
    MovingConstraint {
        /// Index of the constraint, as in `CONSTRAINTS` of the system.
        constraint: usize,
    },
    /// The forces cannot be balanced near the guess.
    Unbalanced {
        /// Index of the coordinate along which the largest force is left.
        coordinate: usize,
        /// The generalized force there, in its own unit.
        force: Magnitude,
    },
    /// The forces fade with the distance, and the search followed them away from the guess.
    RanAway {
        /// Index of the coordinate that went furthest.
        coordinate: usize,
    },
}

impl fmt::Display for EquilibriumError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constraints(cause) => write!(out, "no equilibrium: {cause}"),
            Self::MovingConstraint { constraint } => write!(
                out,
                "no equilibrium: constraint {constraint} moves; use coordinates that move along, in which the state is at \
                 rest"
            ),
            Self::Unbalanced { coordinate, force } => write!(
                out,
                "no equilibrium near the guess: a force of {force} along coordinate {coordinate} is left; start nearer \
                 to one"
            ),
            Self::RanAway { coordinate } => write!(
                out,
                "no equilibrium found: the search ran away along coordinate {coordinate}, where the forces fade but nothing \
                 rests; start nearer to an equilibrium"
            ),
        }
    }
}

impl core::error::Error for EquilibriumError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Constraints(cause) => Some(cause),
            Self::MovingConstraint { .. } | Self::Unbalanced { .. } | Self::RanAway { .. } => None,
        }
    }
}

/// A place on the constraints.
struct Rest<R, const N: usize, const K: usize, const C: usize> {
    q: [R; N],
    multipliers: [R; C],
    rank: usize,
    variation: Variation<R, N, K, C>,
    space: TangentSpace<R, N>,
    /// g, filled up with zeros.
    forces: [R; N],
    /// |g|².
    square: R,
    /// f + Aᵀλ.
    left: [R; N],
}

/// The problem at the time of the guess.
struct Statics<'a, S: Tangent<N, K, C>, const N: usize, const K: usize, const C: usize> {
    system: &'a S,
    constants: S::Constants,
    t: S::Scalar,
    u: &'a [S::Scalar; K],
    /// Inertia of the coordinates, the same all through a search.
    metric: [[S::Scalar; N]; N],
}

pub(super) fn equilibrium<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    guess: State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<Equilibrium<S::Scalar, N, C>, EquilibriumError>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    let number = S::Scalar::from_f64;
    let zero = number(0.0);
    let mut statics =
        Statics { system, constants: system.constants(), t: guess.t, u, metric: [[zero; N]; N] };
    let not_finite = EquilibriumError::Constraints(Cause::NotFinite);
    if !guess.q.iter().all(|q| q.is_finite()) {
        return Err(not_finite);
    }
    let first = statics.variation(&guess.q, &[zero; C]);
    statics.metric = diagonal(core::array::from_fn(|i| first.mass[i][i].abs()));
    let metric = TangentSpace::new(&statics.metric, &first.gradients).metric;
    statics.metric = diagonal(metric);

    let mut rest = statics.rest(statics.feasible(guess.q)?);
    if !rest.square.is_finite() {
        return Err(not_finite);
    }
    let (start, mut met) = (rest.q, rest.square);
    let mut damping = number(DAMPING.0);
    let mut values = statics.stiffness(&rest);
    let mut stiffest = values.largest_square();
    'search: for _ in 0..STEPS {
        let largest = values.largest_square();
        if rest.square == zero || largest == zero {
            break;
        }
        loop {
            let change = statics.displacement(&rest, &values, damping * largest);
            let moved = core::array::from_fn(|i| rest.q[i] + change[i]);
            let next = statics.feasible(moved).ok().map(|q| statics.rest(q));
            if let Some(next) = next.filter(|next| next.square < rest.square) {
                // Quadratic convergence needs a damping that vanishes with the forces.
                damping = smaller(damping * number(0.1), next.square / met);
                met = larger(met, next.square);
                values = statics.stiffness(&next);
                stiffest = larger(stiffest, values.largest_square());
                rest = next;
                break;
            }
            damping = larger(damping * number(8.0), number(1e-6));
            if damping > number(DAMPING.1) {
                break 'search;
            }
        }
    }
    let (step, largest) = (statics.displacement(&rest, &values, zero), values.largest_square());
    let remainder = values.remainder(&rest.forces);
    let size = |x: &[S::Scalar; N]| (0..N).fold(zero, |sum, i| sum + metric[i] * x[i] * x[i]);
    let travelled: [S::Scalar; N] = core::array::from_fn(|i| rest.q[i] - start[i]);
    let (epsilon, reach) = (S::Scalar::epsilon(), size(&rest.q) + size(&travelled));
    // What a step leaves of the forces, because nothing stiff is in their way, must be rounding of those in balance.
    let is_rounding = remainder <= epsilon * epsilon.sqrt() * largest * reach;
    // Forces that fade on the way to infinity are small there, too, but the way does not end.
    let ends = size(&step) <= number(1e-6) * reach;
    let balanced = is_rounding && ends && (rest.square <= epsilon * met || size(&step) <= epsilon * reach);
    if !balanced && !ends && rest.square <= number(FADED) * met {
        let mut coordinate = 0;
        for i in 1..N {
            let far = |i: usize| metric[i] * travelled[i] * travelled[i];
            coordinate = if far(i) > far(coordinate) { i } else { coordinate };
        }
        return Err(EquilibriumError::RanAway { coordinate });
    }
    if !balanced {
        let (mut coordinate, mut force) = (0, zero);
        for (i, left) in rest.left.iter().enumerate() {
            if left.abs() > force {
                (coordinate, force) = (i, left.abs());
            }
        }
        return Err(EquilibriumError::Unbalanced { coordinate, force: magnitude(force) });
    }
    statics.resting(&rest)?;
    // Where the stiffness vanishes, Newton's step does not.
    let regular = values.rank(epsilon * stiffest) == rest.space.count.max(statics.free(&rest));
    let is_isolated = regular && size(&step) <= epsilon * reach;
    let state = State::at_rest(rest.q).at_time(guess.t);
    Ok(Equilibrium { state, multipliers: rest.multipliers, are_unique: rest.rank == C, is_isolated })
}

/// A diagonal matrix.
fn diagonal<R: Real, const N: usize>(entries: [R; N]) -> [[R; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| if i == j { entries[i] } else { R::zero() }))
}

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    fn place<'b>(
        &'b self,
        q: &'b [S::Scalar; N],
        zeros: &'b [S::Scalar; N],
        multipliers: &'b [S::Scalar; C],
    ) -> Place<'b, S::Scalar, N, K, C> {
        Place { t: self.t, q, v: zeros, a: zeros, multipliers, u: self.u }
    }

    fn variation(&self, q: &[S::Scalar; N], multipliers: &[S::Scalar; C]) -> Variation<S::Scalar, N, K, C> {
        let zeros = [S::Scalar::from_f64(0.0); N];
        self.system.variation_at(&self.constants, &self.place(q, &zeros, multipliers))
    }

    /// The gradients of the holonomic constraints alone.
    fn holonomic(gradients: &[[S::Scalar; N]; C]) -> [[S::Scalar; N]; C] {
        let mut rows = *gradients;
        for (row, is_holonomic) in rows.iter_mut().zip(S::HOLONOMIC) {
            if !is_holonomic {
                *row = [S::Scalar::from_f64(0.0); N];
            }
        }
        rows
    }

    /// The nearest coordinates on the constraints.
    fn feasible(&self, q: [S::Scalar; N]) -> Result<[S::Scalar; N], EquilibriumError> {
        let none = [S::Scalar::from_f64(0.0); N];
        if !S::HOLONOMIC.contains(&true) {
            return Ok(q);
        }
        let mut q = q;
        let mut residuals = self.system.deviations_at(self.t, &q, &none);
        for _ in 0..CORRECTIONS {
            if residuals.level_is_roundings(true) {
                return Ok(q);
            }
            let (saddle, gradients) = self.tangent(&q);
            let by_state = Extent::of(&saddle, &q).sizes(&saddle, &gradients);
            let before = residuals.relative(true, &by_state);
            let (change, _) = saddle.solve(&none, &residuals.positions.map(|f| -f));
            let moved: [S::Scalar; N] = core::array::from_fn(|i| q[i] + change[i]);
            if !moved.iter().all(|q| q.is_finite()) {
                break;
            }
            let there = self.system.deviations_at(self.t, &moved, &none);
            let better = there.relative(true, &by_state) < before;
            if !better && residuals.are_roundings_beside(true, S::Scalar::from_f64(INNER), &by_state) {
                // No better place in this arithmetic.
                return Ok(q);
            }
            (q, residuals) = (moved, there);
        }
        let (saddle, gradients) = self.tangent(&q);
        Err(EquilibriumError::Constraints(residuals.cause(true, &Extent::unit().sizes(&saddle, &gradients))))
    }

    /// The gradients of the holonomic constraints, and the factors of them with the metric.
    fn tangent(&self, q: &[S::Scalar; N]) -> (Saddle<S::Scalar, N, C>, [[S::Scalar; N]; C]) {
        let gradients = Self::holonomic(&self.variation(q, &[S::Scalar::from_f64(0.0); C]).gradients);
        (Saddle::factor(&self.metric, &gradients), gradients)
    }

    /// Forces and stiffness at coordinates on the constraints.
    fn rest(&self, q: [S::Scalar; N]) -> Rest<S::Scalar, N, K, C> {
        let zero = S::Scalar::from_f64(0.0);
        let (zeros, none) = ([zero; N], [zero; C]);
        let f = self.system.imbalance_at(&self.constants, &self.place(&q, &zeros, &none)).forces;
        let gradients = self.variation(&q, &none).gradients;
        let saddle = Saddle::factor(&self.metric, &gradients);
        let (_, multipliers) = saddle.solve(&f, &none);
        let variation = self.variation(&q, &multipliers);
        let space = TangentSpace::new(&self.metric, &gradients);
        let mut left = f;
        for (gradient, &multiplier) in gradients.iter().zip(&multipliers) {
            for (left, &entry) in left.iter_mut().zip(gradient) {
                *left += entry * multiplier;
            }
        }
        let forces: [S::Scalar; N] = core::array::from_fn(|k| {
            let force = space.vectors[k].iter().zip(&left).fold(zero, |sum, (&z, &f)| sum + z * f);
            self.scaled(&space, k, force)
        });
        let square = forces.iter().fold(zero, |sum, &g| sum + g * g);
        Rest { q, multipliers, rank: saddle.rank(), variation, space, forces, square, left }
    }

    /// A component along a vector of the basis in the metric: unit vectors of an unconstrained system have none.
    fn scaled(&self, space: &TangentSpace<S::Scalar, N>, k: usize, component: S::Scalar) -> S::Scalar {
        if C == 0 { component / space.metric[k].sqrt() } else { component }
    }

    /// The directions that the coordinates may take.
    fn allowed(&self, rest: &Rest<S::Scalar, N, K, C>) -> TangentSpace<S::Scalar, N> {
        if S::HOLONOMIC.contains(&false) {
            TangentSpace::new(&self.metric, &Self::holonomic(&rest.variation.gradients))
        } else {
            rest.space
        }
    }

    /// The number of these directions.
    fn free(&self, rest: &Rest<S::Scalar, N, K, C>) -> usize {
        self.allowed(rest).count
    }

    /// −∂g/∂ξ.
    fn stiffness(&self, rest: &Rest<S::Scalar, N, K, C>) -> SingularValues<S::Scalar, N> {
        let zero = S::Scalar::from_f64(0.0);
        let allowed = self.allowed(rest);
        let mut rows = [[zero; N]; N];
        for (l, direction) in allowed.vectors.iter().enumerate() {
            let change: [S::Scalar; N] = core::array::from_fn(|i| {
                rest.variation.by_q[i].iter().zip(direction).fold(zero, |sum, (&slope, &z)| sum - slope * z)
            });
            for (k, z) in rest.space.vectors.iter().enumerate() {
                let entry = z.iter().zip(&change).fold(zero, |sum, (&z, &change)| sum + z * change);
                rows[k][l] = self.scaled(&allowed, l, self.scaled(&rest.space, k, entry));
            }
        }
        SingularValues::new(&rows)
    }

    /// The change of coordinates by a step.
    fn displacement(
        &self,
        rest: &Rest<S::Scalar, N, K, C>,
        values: &SingularValues<S::Scalar, N>,
        damping: S::Scalar,
    ) -> [S::Scalar; N] {
        let allowed = self.allowed(rest);
        let components = values.solve(&rest.forces, damping);
        let mut change = [S::Scalar::from_f64(0.0); N];
        for (k, (direction, &component)) in allowed.vectors.iter().zip(&components).enumerate() {
            let component = self.scaled(&allowed, k, component);
            for (change, &z) in change.iter_mut().zip(direction) {
                *change += z * component;
            }
        }
        change
    }

    /// Refuses constraints that do not let the system rest.
    fn resting(&self, rest: &Rest<S::Scalar, N, K, C>) -> Result<(), EquilibriumError> {
        let state = State::at_rest(rest.q).at_time(self.t);
        let residuals = self.system.deviations_at(state.t, &state.q, &state.v);
        let saddle = Saddle::factor(&self.metric, &rest.variation.gradients);
        let by_state = Extent::of(&saddle, &state.v).sizes(&saddle, &rest.variation.gradients);
        if residuals.are_roundings_beside(false, S::Scalar::from_f64(INNER), &by_state) {
            return Ok(());
        }
        match residuals.cause(false, &Extent::unit().sizes(&saddle, &rest.variation.gradients)) {
            Cause::VelocityViolated { constraint, .. } => {
                Err(EquilibriumError::MovingConstraint { constraint })
            }
            cause => Err(EquilibriumError::Constraints(cause)),
        }
    }
}
