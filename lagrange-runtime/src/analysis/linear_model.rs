//! Linear equations of small deviations from a motion.
//!
//! M δa + (C + G) δv + K δq = Aᵀ δλ + (∂f/∂u) δu, with C the symmetric and G the skew part of −∂r/∂v and K =
//! −∂r/∂q at the accelerations and multipliers of the state (Meirovitch, *Methods of Analytical Dynamics*, §
//! 9.3). K has the stiffness of the reactions, −∂(Aᵀλ)/∂q, in it, so that it counts on the tangent space of
//! the constraints. There δq = Z ξ and δv = Y η − A⁺ (∂w/∂q) δq, with Z and Y the velocities that holonomic
//! and that all constraints allow, and x = (ξ, η).

use nalgebra::{SMatrix, SVector};

use super::response::{Factored, factored};
use super::{Tangent, Variation, turning};
use crate::constraints::{Level, Metric, check_near};
use crate::linear::stored::Stored;
use crate::linear::{Ldlt, Saddle, SaddlePoint, TangentSpace};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::system::attitude::{drift, triple};
use crate::system::error::{Cause, MotionError};
use crate::system::state::State;

/// Small deviations from a state.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearModel<R, const N: usize, const K: usize> {
    /// M.
    pub mass: Stored<SMatrix<R, N, N>>,
    /// C, symmetric: dissipation.
    pub damping: Stored<SMatrix<R, N, N>>,
    /// G, skew: forces without power.
    pub gyroscopic: Stored<SMatrix<R, N, N>>,
    /// K, with circulatory forces as its skew part.
    pub stiffness: Stored<SMatrix<R, N, N>>,
    /// ∂f/∂u.
    pub by_inputs: Stored<SMatrix<R, N, K>>,
    /// The changes of coordinates that the holonomic constraints allow.
    pub displacements: Basis<R, N>,
    /// The changes of velocities that all constraints allow.
    pub velocities: Basis<R, N>,
    /// ∂ξ̇/∂ξ, ∂ξ̇/∂η, ∂η̇/∂ξ, ∂η̇/∂η: the leading rows and columns count.
    blocks: [[Stored<SMatrix<R, N, N>>; 2]; 2],
    /// ∂η̇/∂u.
    input: Stored<SMatrix<R, N, K>>,
    /// ξ̇ and η̇ at the state itself.
    drift: [SVector<R, N>; 2],
}

/// Vectors z that span a space of motions: with zᵀ M z = 1 and orthogonal in M where M is positive on that
/// space; without constraints the coordinates themselves.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis<R, const N: usize> {
    vectors: Stored<SMatrix<R, N, N>>,
    count: usize,
    /// The rows that give the components of a vector.
    dual: Stored<SMatrix<R, N, N>>,
}

impl<R: Real, const N: usize> Basis<R, N> {
    /// The dimension of the space.
    #[inline]
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether nothing can move.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The vectors, in all coordinates.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = SVector<R, N>> + '_ {
        (0..self.count).map(|k| self.vectors.column(k).into_owned())
    }

    /// The vectors as columns; those from [`Basis::len`] on are zero.
    #[inline]
    #[must_use]
    pub fn vectors(&self) -> &SMatrix<R, N, N> {
        &self.vectors
    }

    /// The components in this basis of a vector in all coordinates; those from [`Basis::len`] on are zero.
    #[inline]
    #[must_use]
    pub fn components(&self, vector: &SVector<R, N>) -> SVector<R, N> {
        *self.dual * vector
    }

    /// The coordinates themselves.
    fn identity() -> Self {
        let vectors: Stored<SMatrix<R, N, N>> = filled(|i, j| if i == j { R::one() } else { R::zero() });
        Self { dual: vectors.clone(), vectors, count: N }
    }

    /// The basis of a null space: orthonormal in `mass` if possible, else in its diagonal.
    #[inline(never)]
    fn new<const C: usize>(mass: &[[R; N]; N], gradients: &[[R; N]; C]) -> Self {
        let space = Stored::new(TangentSpace::new(mass, gradients));
        let count = space.count;
        if !is_positive(mass, &space) {
            let dual = filled(|k, i| space.vectors[k][i] * space.metric[i]);
            return Self { vectors: filled(|i, k| space.vectors[k][i]), count, dual };
        }
        let mut rows = Stored::new(space.vectors);
        for k in 0..count {
            // Two passes suffice, as in the Gram–Schmidt orthogonalisation of the multipliers.
            for _ in 0..2 {
                let (done, rest) = rows.split_at_mut(k);
                let Some(vector) = rest.first_mut() else { continue };
                for before in done.iter() {
                    let along = product(vector, mass, before);
                    for (x, &y) in vector.iter_mut().zip(before) {
                        *x -= along * y;
                    }
                }
                let size = product(vector, mass, vector).sqrt().recip();
                vector.iter_mut().for_each(|x| *x *= size);
            }
        }
        let dual = filled(|k, j| dot(&rows[k], &array(|i| mass[i][j])));
        Self { vectors: filled(|i, k| rows[k][i]), count, dual }
    }
}

/// Whether a mass matrix is positive on a space.
#[inline(never)]
fn is_positive<R: Real, const N: usize>(mass: &[[R; N]; N], space: &TangentSpace<R, N>) -> bool {
    // Behind the basis the matrix is filled up with ones.
    let mut lower = Stored::<[[R; N]; N]>::zeros();
    for (l, y) in space.vectors.iter().enumerate() {
        let image = mass.each_ref().each(|row| dot(row, y));
        for (k, z) in space.vectors.iter().enumerate() {
            lower[k][l] = dot(z, &image);
        }
        if l >= space.count {
            lower[l][l] = R::one();
        }
    }
    Ldlt::factor(*lower).is_ok()
}

/// A matrix of these entries.
#[inline(never)]
fn filled<R: Real, const A: usize, const B: usize>(
    entry: impl Fn(usize, usize) -> R,
) -> Stored<SMatrix<R, A, B>> {
    Stored::new(SMatrix::from_fn(entry))
}

/// X Y, without a matrix on the stack.
fn times<R: Real, const N: usize, const D: usize>(
    x: &SMatrix<R, N, N>,
    y: &SMatrix<R, N, D>,
) -> Stored<SMatrix<R, N, D>> {
    filled(|i, j| (0..N).fold(R::zero(), |sum, k| sum + x[(i, k)] * y[(k, j)]))
}

/// The derivatives of accelerations by some variables, given by the columns of ∂r/∂x and ∂(A a − γ)/∂x.
fn columns<R: Real, const N: usize, const C: usize, const D: usize>(
    saddle: &Saddle<R, N, C>,
    forces: impl Fn(usize, usize) -> R,
    conditions: impl Fn(usize, usize) -> R,
) -> Stored<SMatrix<R, N, D>> {
    let mut rows = filled(|_, _| R::zero());
    for j in 0..D {
        let force = array(|i| forces(i, j));
        let (column, _) = saddle.solve(&force, &array(|c| -conditions(c, j)));
        for (i, x) in column.into_iter().enumerate() {
            rows[(i, j)] = x;
        }
    }
    rows
}

fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    a.iter().zip(b).fold(R::zero(), |sum, (&a, &b)| sum + a * b)
}

/// xᵀ M y.
fn product<R: Real, const N: usize>(x: &[R; N], mass: &[[R; N]; N], y: &[R; N]) -> R {
    x.iter().zip(mass).fold(R::zero(), |sum, (&x, row)| sum + x * dot(row, y))
}

impl<R: Real, const N: usize, const K: usize> LinearModel<R, N, K> {
    /// The number of components of x = (ξ, η).
    #[inline]
    #[must_use]
    pub fn order(&self) -> usize {
        self.displacements.len() + self.velocities.len()
    }

    /// A of ẋ = A x + B u + drift, where x are the components of δq in [`LinearModel::displacements`], then
    /// those of δv in [`LinearModel::velocities`]; without constraints x = (δq, δv). `None` if `D` is not
    /// [`LinearModel::order`].
    #[must_use]
    pub fn state_matrix<const D: usize>(&self) -> Option<SMatrix<R, D, D>> {
        (D == self.order()).then(|| SMatrix::from_fn(|i, j| self.entry(i, j)))
    }

    /// An entry of A; zero beyond its size.
    #[must_use]
    pub fn entry(&self, i: usize, j: usize) -> R {
        let ((row, i), (column, j)) = (self.split(i), self.split(j));
        let block = self.blocks.get(row).and_then(|blocks| blocks.get(column));
        block.and_then(|block| block.get((i, j))).copied().unwrap_or(R::zero())
    }

    /// B. `None` if `D` is not [`LinearModel::order`].
    #[must_use]
    pub fn input_matrix<const D: usize>(&self) -> Option<SMatrix<R, D, K>> {
        let entry = |i: usize, j: usize| match self.split(i) {
            (1, i) => self.input.get((i, j)).copied().unwrap_or(R::zero()),
            _ => R::zero(),
        };
        (D == self.order()).then(|| SMatrix::from_fn(entry))
    }

    /// ẋ at the state itself; zero at an equilibrium. `None` if `D` is not [`LinearModel::order`].
    #[must_use]
    pub fn drift<const D: usize>(&self) -> Option<SVector<R, D>> {
        let entry = |i: usize| {
            let (part, i) = self.split(i);
            self.drift.get(part).and_then(|part| part.get(i)).copied().unwrap_or(R::zero())
        };
        (D == self.order()).then(|| SVector::from_fn(|i, _| entry(i)))
    }

    /// Yᵀ X Y of M, C or G, with Y the basis of [`LinearModel::velocities`]: between the velocities that the
    /// constraints allow, on which these matrices act. The leading rows and columns count, as many as there
    /// are such velocities.
    ///
    /// About an equilibrium Yᵀ M Y η̇ + Yᵀ (C + G) Y η + Yᵀ K Z ξ = Yᵀ (∂f/∂u) δu and ξ̇ = Z⁺ Y η are the
    /// equations of motion, with [`LinearModel::on_displacements`] of K. About a motion they lack what
    /// follows from the change of the constraints; [`LinearModel::state_matrix`] has all of it.
    #[must_use]
    pub fn on_velocities(&self, matrix: &SMatrix<R, N, N>) -> SMatrix<R, N, N> {
        self.velocities.vectors.transpose() * matrix * *self.velocities.vectors
    }

    /// Yᵀ X Z of K, with Y the basis of [`LinearModel::velocities`] and Z that of
    /// [`LinearModel::displacements`]: the forces along the velocities that the constraints allow, for the
    /// displacements that they allow. There are more displacements than velocities where a constraint is
    /// nonholonomic. The leading rows, one a velocity, and columns, one a displacement, count.
    #[must_use]
    pub fn on_displacements(&self, matrix: &SMatrix<R, N, N>) -> SMatrix<R, N, N> {
        self.velocities.vectors.transpose() * matrix * *self.displacements.vectors
    }

    /// The same model in other numbers.
    #[cfg(feature = "std")]
    pub(super) fn map<T: Real>(&self, number: impl Fn(R) -> T + Copy) -> LinearModel<T, N, K> {
        let basis = |basis: &Basis<R, N>| Basis {
            vectors: filled(|i, k| number(basis.vectors[(i, k)])),
            count: basis.count,
            dual: filled(|k, i| number(basis.dual[(k, i)])),
        };
        LinearModel {
            mass: filled(|i, j| number(self.mass[(i, j)])),
            damping: filled(|i, j| number(self.damping[(i, j)])),
            gyroscopic: filled(|i, j| number(self.gyroscopic[(i, j)])),
            stiffness: filled(|i, j| number(self.stiffness[(i, j)])),
            by_inputs: filled(|i, j| number(self.by_inputs[(i, j)])),
            displacements: basis(&self.displacements),
            velocities: basis(&self.velocities),
            blocks: self
                .blocks
                .each_ref()
                .map(|row| row.each_ref().map(|block| filled(|i, j| number(block[(i, j)])))),
            input: filled(|i, j| number(self.input[(i, j)])),
            drift: self.drift.each(|part| part.map(number)),
        }
    }

    /// The part of x that a component belongs to, and its index in that part.
    fn split(&self, i: usize) -> (usize, usize) {
        let count = self.displacements.len();
        if i < count { (0, i) } else { (1, i - count) }
    }
}

/// The blocks of T⁻¹ T′ of all orientations ([`drift`]).
fn drift_of<R: Real, const N: usize>(
    orientations: &[usize],
    state: &State<R, N>,
    accelerations: &[R; N],
) -> [Stored<SMatrix<R, N, N>>; 2] {
    let mut blocks = [filled(|_, _| R::zero()), filled(|_, _| R::zero())];
    for &first in orientations {
        let [rho, rates, seconds] =
            [&state.q, &state.v, accelerations].each(|numbers| triple(numbers, first));
        for (block, rows) in blocks.iter_mut().zip(drift(rho, rates, seconds)) {
            for (i, row) in rows.into_iter().enumerate() {
                for (j, entry) in row.into_iter().enumerate() {
                    block[(first + i, first + j)] = entry;
                }
            }
        }
    }
    blocks
}

/// Refuses a state that violates constraints, by the rule for the start of a motion.
#[cold]
fn refuse_off<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    found: &Factored<S::Scalar, N, K, C>,
) -> Result<(), Cause>
where
    S: Tangent<N, K, C>,
{
    let residuals = system.deviations_at(state.t, &state.q, &state.v);
    let metric = Metric::of(&*found.saddle);
    let slopes = metric.slopes(&*found.variation.gradients);
    for level in [Level::Positions, Level::Velocities] {
        check_near(&*found.saddle, (&metric, &slopes), state, &residuals, level)
            .map_err(|cause| cause.named(&S::NAMES))?;
    }
    Ok(())
}

/// With `turning` axes the rates of deviations are those seen in axes that turn with the bodies, in which
/// equations about a steady spin do not change. The components themselves stay those of the moment.
pub(super) fn linearize<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
    turning: bool,
) -> Result<LinearModel<S::Scalar, N, K>, MotionError<S::Scalar>>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    let constants = system.constants();
    let found = factored(system, &constants, state, u)?;
    if C > 0 {
        refuse_off(system, state, &found).map_err(|cause| MotionError { cause, t: state.t })?;
    }
    if S::TURNS.contains(&true) {
        turning::refuse(system, &constants, state, u, &found)?;
    }
    let Factored { balance, variation, saddle } = found;
    let half = S::Scalar::from_f64(0.5);
    let zero = S::Scalar::from_f64(0.0);
    let Variation { mass, by_q, by_v, by_u, gradients, rates_by_q, conditions_by_q, conditions_by_v, .. } =
        variation;
    let a_by_q = columns(&saddle, |i, j| by_q[i][j], |c, j| conditions_by_q[c][j]);
    let a_by_v = columns(&saddle, |i, j| by_v[i][j], |c, j| conditions_by_v[c][j]);
    let a_by_u: Stored<SMatrix<S::Scalar, N, K>> = columns(&saddle, |i, j| by_u[i][j], |_, _| zero);
    // −A⁺ (∂w/∂q): the change of velocity that keeps w at zero when the position changes.
    let entrained = columns(&saddle, |_, _| zero, |c, j| rates_by_q[c][j]);

    let (displacements, velocities) = if C == 0 {
        (Basis::identity(), Basis::identity())
    } else {
        let mut holonomic = gradients.clone();
        for (row, is_holonomic) in holonomic.iter_mut().zip(S::HOLONOMIC) {
            if !is_holonomic {
                *row = [zero; N];
            }
        }
        (Basis::new(&mass, &holonomic), Basis::new(&mass, &gradients))
    };
    let (z, y) = (&displacements.vectors, &velocities.vectors);
    let carried = times(&entrained, z);
    let (by_place, by_carried) = (times(&a_by_q, z), times(&a_by_v, &carried));
    let both = filled(|i, j| by_place[(i, j)] + by_carried[(i, j)]);
    let mut blocks = [
        [times(&displacements.dual, &carried), times(&displacements.dual, y)],
        [times(&velocities.dual, &both), times(&velocities.dual, &times(&a_by_v, y))],
    ];
    if turning && S::ORIENTATIONS.iter().any(|&first| triple(&state.v, first) != [zero; 3]) {
        let [turned, rest] = drift_of(S::ORIENTATIONS, state, &balance.accelerations);
        let (place, speed) = (times(&rest, z), times(&turned, &carried));
        let speed = filled(|i, j| place[(i, j)] + speed[(i, j)]);
        *blocks[0][0] += *times(&displacements.dual, &times(&turned, z));
        *blocks[1][0] += *times(&velocities.dual, &speed);
        *blocks[1][1] += *times(&velocities.dual, &times(&turned, y));
    }
    Ok(LinearModel {
        damping: filled(|i, j| -half * (by_v[i][j] + by_v[j][i])),
        gyroscopic: filled(|i, j| -half * (by_v[i][j] - by_v[j][i])),
        stiffness: filled(|i, j| -by_q[i][j]),
        by_inputs: filled(|i, j| by_u[i][j]),
        mass: filled(|i, j| mass[i][j]),
        blocks,
        input: times(&velocities.dual, &a_by_u),
        drift: [
            displacements.components(&state.velocities()),
            velocities.components(&balance.accelerations.into()),
        ],
        displacements,
        velocities,
    })
}
