//! Positions on the constraints: their forces, their stiffness, and the displacement from one to another.
//!
//! What needs large tables on the stack for a moment is a function that is not inlined, so that only one of
//! them is there at a time.

use num_traits::{One, Zero};

use super::EquilibriumError;
use crate::analysis::inertia::refuse_negative;
use crate::analysis::{Place, Tangent, Variation};
use crate::constraints::{Level, Metric};
use crate::linear::stored::Stored;
use crate::linear::{Saddle, SaddlePoint, TangentSpace};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger};
use crate::system::error::Cause;
use crate::system::name::Name;
use crate::system::state::State;

/// The most corrections back onto the constraints.
const CORRECTIONS: usize = 30;

/// The problem at the time of the guess.
pub(super) struct Statics<'a, S: Tangent<N, K, C>, const N: usize, const K: usize, const C: usize> {
    pub system: &'a S,
    pub constants: S::Constants,
    pub t: S::Scalar,
    pub u: &'a [S::Scalar; K],
    /// The unit of inertia: the largest one of a coordinate at the guess. Masses of atoms have no squares in
    /// single precision.
    pub heaviest: S::Scalar,
    /// Squares of the sizes of the coordinates: their inertia at the guess in this unit, constant through a
    /// search.
    pub sizes: [S::Scalar; N],
    /// The same as a matrix.
    pub metric: Stored<[[S::Scalar; N]; N]>,
}

/// A position on the constraints.
pub(super) struct Rest<R, const N: usize, const C: usize> {
    pub q: [R; N],
    /// The multipliers of least squares, which make f + Aᵀλ as small as possible.
    pub multipliers: [R; C],
    /// The number of independent constraints.
    pub rank: usize,
    /// A constraint without a gradient.
    pub vanishing: Option<usize>,
    /// Motions that all constraints allow, orthonormal in the metric.
    pub motions: Directions<R, N>,
    /// Motions that the holonomic constraints allow, if these are not the same.
    places: Option<Directions<R, N>>,
    pub gradients: Stored<[[R; N]; C]>,
    /// The unit of `forces`: the largest of them. In this unit and that of `stiffness` squares neither
    /// overflow nor underflow, whatever the size of the system and however forces fade or grow.
    pub push: R,
    /// The unit of `stiffness`: its size.
    pub unit: R,
    /// Their ratio: the unit of a displacement, which is forces by stiffness.
    pub length: R,
    /// f + Aᵀλ along `motions`; zero from their number on.
    pub forces: [R; N],
    /// The size of the forces.
    pub norm: R,
    /// The derivative of the forces along the displacements that the constraints allow, with the sign
    /// changed.
    pub stiffness: Stiffness<R, N>,
    /// f + Aᵀλ, in its own units.
    pub left: [R; N],
}

/// Vectors of unit size in the metric, one a row. Rows from `count` on are zero.
pub(super) struct Directions<R, const N: usize> {
    pub vectors: Stored<[[R; N]; N]>,
    pub count: usize,
}

impl<R: Real, const N: usize> Directions<R, N> {
    #[inline(never)]
    fn new<const C: usize>(metric: &[[R; N]; N], gradients: &[[R; N]; C]) -> Self {
        let TangentSpace { vectors, count, metric } = TangentSpace::new(metric, gradients);
        let mut vectors = Stored::new(vectors);
        if C == 0 {
            // Without constraints the vectors are the coordinates, which get unit size in the metric.
            for (k, vector) in vectors.iter_mut().enumerate() {
                vector[k] = metric[k].sqrt().recip();
            }
        }
        Self { vectors, count }
    }

    /// Σ y z.
    pub fn combined(&self, components: &[R; N]) -> [R; N] {
        let mut sum = [R::zero(); N];
        for (vector, &y) in self.vectors.iter().zip(components).take(self.count) {
            for (sum, &z) in sum.iter_mut().zip(vector) {
                *sum = R::mul_add(y, z, *sum);
            }
        }
        sum
    }

    /// Zᵀ X Z.
    pub fn table(&self, rows: &[[R; N]; N]) -> Stored<[[R; N]; N]> {
        let mut table = Stored::<[[R; N]; N]>::zeros();
        for (l, z) in self.vectors.iter().enumerate().take(self.count) {
            let image = rows.each_ref().each(|row| dot(row, z));
            for (k, y) in self.vectors.iter().enumerate().take(self.count) {
                table[k][l] = dot(y, &image);
            }
        }
        table
    }
}

/// A table, and the largest sum of magnitudes in it, by which its rounding errors are measured.
#[derive(Clone)]
pub(super) struct Stiffness<R, const N: usize> {
    pub rows: Stored<[[R; N]; N]>,
    pub size: R,
}

impl<'a, S, const N: usize, const K: usize, const C: usize> Statics<'a, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// Whether all constraints are holonomic: they then allow the same displacements as velocities.
    pub const HOLONOMIC: bool = {
        let (mut c, mut all) = (0, true);
        while c < C {
            all &= S::HOLONOMIC[c];
            c += 1;
        }
        all
    };

    /// The problem with the inertia at a guess as the metric.
    pub fn new(system: &'a S, guess: &State<S::Scalar, N>, u: &'a [S::Scalar; K]) -> Self {
        let (metric, zero, one) = (Stored::zeros(), S::Scalar::zero(), S::Scalar::one());
        let constants = system.constants();
        let mut this = Self { system, constants, t: guess.t, u, heaviest: one, sizes: [zero; N], metric };
        let first = this.variation(&guess.q, &[zero; C]);
        let masses: [S::Scalar; N] = array(|i| first.mass[i][i].abs());
        let most = masses.into_iter().fold(zero, larger);
        if most.is_positive() && most.recip().is_positive() && most.recip().is_finite() {
            this.heaviest = most;
        }
        this.put(&masses.each(|mass| mass / this.heaviest));
        // A coordinate without inertia gets the size that the constraints suggest.
        this.sizes = TangentSpace::new(&this.metric, &first.gradients).metric;
        let sizes = this.sizes;
        this.put(&sizes);
        this
    }

    /// Refuses negative masses, with which an equilibrium does not minimise the potential energy.
    pub fn masses(&self, q: [S::Scalar; N]) -> Result<(), Cause> {
        let mass = || self.variation(&q, &[S::Scalar::zero(); C]).mass;
        refuse_negative(self.system, &self.constants, &State::at_rest(q).at_time(self.t), mass)
    }

    fn put(&mut self, sizes: &[S::Scalar; N]) {
        for (i, &size) in sizes.iter().enumerate() {
            self.metric[i][i] = size;
        }
    }

    /// The length of a displacement in the metric.
    pub fn length(&self, x: &[S::Scalar; N]) -> S::Scalar {
        length::<_, N>(&array(|i| self.sizes[i].sqrt() * x[i]))
    }

    /// The size of forces in the metric.
    pub fn force(&self, forces: &[S::Scalar; N]) -> S::Scalar {
        length::<_, N>(&array(|i| {
            if self.sizes[i].is_positive() { forces[i] / self.sizes[i].sqrt() } else { S::Scalar::zero() }
        }))
    }

    pub fn place<'b>(
        &'b self,
        q: &'b [S::Scalar; N],
        zeros: &'b [S::Scalar; N],
        multipliers: &'b [S::Scalar; C],
    ) -> Place<'b, S::Scalar, N, K, C> {
        Place { t: self.t, q, v: zeros, a: zeros, multipliers, u: self.u }
    }

    /// The derivatives at rest.
    #[inline(never)]
    pub fn variation(
        &self,
        q: &[S::Scalar; N],
        multipliers: &[S::Scalar; C],
    ) -> Variation<S::Scalar, N, K, C> {
        let zeros = [S::Scalar::zero(); N];
        self.system.variation_at(&self.constants, &self.place(q, &zeros, multipliers))
    }

    /// f + Aᵀλ.
    pub fn imbalance(&self, q: &[S::Scalar; N], multipliers: &[S::Scalar; C]) -> [S::Scalar; N] {
        let zeros = [S::Scalar::zero(); N];
        self.system.imbalance_at(&self.constants, &self.place(q, &zeros, multipliers)).forces
    }

    /// The gradients of the holonomic constraints alone.
    pub fn holonomic(mut gradients: Stored<[[S::Scalar; N]; C]>) -> Stored<[[S::Scalar; N]; C]> {
        for (row, is_holonomic) in gradients.iter_mut().zip(S::HOLONOMIC) {
            if !is_holonomic {
                *row = [S::Scalar::zero(); N];
            }
        }
        gradients
    }

    /// The nearest coordinates on the constraints.
    pub fn feasible(&self, q: [S::Scalar; N]) -> Result<[S::Scalar; N], EquilibriumError> {
        let none = [S::Scalar::zero(); N];
        if !S::HOLONOMIC.contains(&true) {
            return Ok(q);
        }
        let (start, mut q) = (q, q);
        let mut residuals = self.system.deviations_at(self.t, &q, &none);
        for _ in 0..CORRECTIONS {
            if residuals.level_is_roundings(Level::Positions) {
                return Ok(q);
            }
            let (saddle, gradients) = self.tangent(&q);
            let metric = Metric::of(&*saddle);
            let slopes = metric.slopes(&*gradients);
            let by_state = metric.changes(&*gradients, metric.sizes(&q));
            let before = residuals.distance(Level::Positions, &slopes);
            let (change, _) = saddle.solve(&none, &residuals.positions.each(|f| -f));
            let moved: [S::Scalar; N] = array(|i| q[i] + change[i]);
            if !moved.iter().all(|q| q.is_finite()) {
                break;
            }
            let there = self.system.deviations_at(self.t, &moved, &none);
            let better = there.distance(Level::Positions, &slopes) < before;
            if !better && residuals.is_within(Level::Positions, S::Scalar::epsilon().sqrt(), &by_state) {
                // No position is better in this arithmetic.
                return Ok(q);
            }
            (q, residuals) = (moved, there);
        }
        let (saddle, gradients) = self.tangent(&q);
        let without_value = || {
            let has_value = |row: &[S::Scalar; N]| row.iter().all(|x| x.is_finite());
            let rows = gradients.iter();
            residuals.positions.iter().zip(rows).position(|(f, row)| f.is_finite() && !has_value(row))
        };
        if let Some(constraint) = saddle.vanishing().or_else(without_value) {
            let cause = Cause::VanishingGradient { constraint, name: Name::NONE };
            let found = if q == start { cause } else { residuals.unmet(Level::Positions, cause) };
            return Err(EquilibriumError::Constraints(found));
        }
        let cause = residuals.cause(Level::Positions, &Metric::of(&*saddle).slopes(&*gradients));
        Err(EquilibriumError::Constraints(match cause {
            Cause::PositionViolated { constraint, name, .. } if saddle.rank() < C => {
                Cause::Contradictory { constraint, name }
            }
            Cause::PositionViolated { constraint, name, by } => {
                Cause::NoConsistentState { constraint, name, by }
            }
            other => other,
        }))
    }

    /// The gradients of the holonomic constraints, and the factors of them with the metric.
    #[inline(never)]
    #[allow(clippy::type_complexity)]
    fn tangent(&self, q: &[S::Scalar; N]) -> (Stored<Saddle<S::Scalar, N, C>>, Stored<[[S::Scalar; N]; C]>) {
        let gradients = Self::holonomic(self.variation(q, &[S::Scalar::zero(); C]).gradients);
        (Stored::new(Saddle::factor(&self.metric, &gradients)), gradients)
    }

    /// Forces and stiffness at coordinates on the constraints.
    pub fn rest(&self, q: [S::Scalar; N]) -> Rest<S::Scalar, N, C> {
        let none = [S::Scalar::zero(); C];
        let gradients = self.variation(&q, &none).gradients;
        let (rank, vanishing, multipliers) = self.balancing(&q, &gradients);
        let left = self.imbalance(&q, &multipliers);
        let by_q = self.variation(&q, &multipliers).by_q;
        let motions = Directions::new(&self.metric, &gradients);
        let places =
            (!Self::HOLONOMIC).then(|| Directions::new(&self.metric, &Self::holonomic(gradients.clone())));
        let mut forces = [S::Scalar::zero(); N];
        for (force, vector) in forces.iter_mut().zip(motions.vectors.iter()).take(motions.count) {
            let along = dot(vector, &left);
            // A force without an inverse has no digits.
            *force = if along.recip().is_finite() { along } else { S::Scalar::zero() };
        }
        let mut stiffness = stiffness(&by_q, &motions, places.as_ref().unwrap_or(&motions));
        let one = S::Scalar::one();
        let is_unit = |x: &S::Scalar| x.is_positive() && x.recip().is_finite() && x.recip().is_positive();
        let most = forces.iter().fold(S::Scalar::zero(), |most, x| larger(x.abs(), most));
        let [push, unit] = [[most, stiffness.size], [stiffness.size, most]]
            .each(|[own, other]| [own, other].into_iter().find(is_unit).unwrap_or(one));
        stiffness.size /= unit;
        stiffness.rows.iter_mut().flatten().for_each(|x| *x /= unit);
        forces.iter_mut().for_each(|x| *x /= push);
        let norm = push * dot(&forces, &forces).sqrt();
        Rest {
            q,
            multipliers,
            rank,
            vanishing,
            motions,
            places,
            gradients,
            push,
            unit,
            length: push / unit,
            forces,
            norm,
            stiffness,
            left,
        }
    }

    /// f + Aᵀλ with the multipliers of least squares.
    #[inline(never)]
    pub fn left(&self, q: &[S::Scalar; N]) -> [S::Scalar; N] {
        let gradients = self.variation(q, &[S::Scalar::zero(); C]).gradients;
        let (_, _, multipliers) = self.balancing(q, &gradients);
        self.imbalance(q, &multipliers)
    }

    /// The number of independent constraints, one without a gradient if there is one, and the multipliers
    /// that balance the forces as well as possible.
    #[inline(never)]
    fn balancing(
        &self,
        q: &[S::Scalar; N],
        gradients: &[[S::Scalar; N]; C],
    ) -> (usize, Option<usize>, [S::Scalar; C]) {
        let none = [S::Scalar::zero(); C];
        if C == 0 {
            return (0, None, none);
        }
        let saddle = Stored::new(Saddle::factor(&self.metric, gradients));
        (saddle.rank(), saddle.vanishing(), saddle.solve(&self.imbalance(q, &none), &none).1)
    }

    /// The displacements that the constraints allow.
    pub fn allowed<'b>(&self, rest: &'b Rest<S::Scalar, N, C>) -> &'b Directions<S::Scalar, N> {
        rest.places.as_ref().unwrap_or(&rest.motions)
    }
}

pub(super) fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    a.iter().zip(b).fold(R::zero(), |sum, (&a, &b)| R::mul_add(a, b, sum))
}

/// The root of the sum of squares. The squares are those of shares of the largest number, which neither
/// overflow nor underflow.
pub(super) fn length<R: Ordered, const N: usize>(x: &[R; N]) -> R {
    let most = x.iter().fold(R::zero(), |most, x| larger(x.abs(), most));
    if !(most.is_positive() && most.is_finite()) {
        return x.iter().fold(R::zero(), |sum, x| sum + x.abs());
    }
    most * x.iter().fold(R::zero(), |sum, &x| sum + (x / most) * (x / most)).sqrt()
}

/// Σ |a b|.
pub(super) fn size_of<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    a.iter().zip(b).fold(R::zero(), |sum, (&a, &b)| sum + (a * b).abs())
}

/// Zᵀ X Z′ of X = −∂r/∂q, with Z the motions and Z′ the displacements that the constraints allow.
fn stiffness<R: Ordered, const N: usize>(
    by_q: &[[R; N]; N],
    motions: &Directions<R, N>,
    allowed: &Directions<R, N>,
) -> Stiffness<R, N> {
    let mut rows = Stored::<[[R; N]; N]>::zeros();
    let mut size = R::zero();
    for (l, direction) in allowed.vectors.iter().enumerate().take(allowed.count) {
        let change = by_q.each_ref().each(|slopes| -dot(slopes, direction));
        let magnitudes = by_q.each_ref().each(|slopes| size_of(slopes, direction));
        for (k, z) in motions.vectors.iter().enumerate().take(motions.count) {
            rows[k][l] = dot(z, &change);
            size = larger(size_of(z, &magnitudes), size);
        }
    }
    Stiffness { rows, size }
}
