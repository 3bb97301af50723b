//! Linear equations of small deviations from a motion.
//!
//! M δa + (C + G) δv + K δq = Aᵀ δλ + (∂f/∂u) δu, with C the symmetric and G the skew part of −∂r/∂v and K = −∂r/∂q at the
//! accelerations and multipliers of the state (Meirovitch, *Methods of Analytical Dynamics*, § 9.3). K has the stiffness of
//! the reactions, −∂(Aᵀλ)/∂q, in it, so that it counts on the tangent space of the constraints. There
//! δq = Z ξ and δv = Y η − A⁺ (∂w/∂q) δq, with Z and Y the velocities that holonomic and that all constraints allow, and
//! x = (ξ, η).

use nalgebra::{SMatrix, SVector};

use super::Tangent;
use super::response::{Factored, columns, factored};
use crate::error::MotionError;
use crate::linear::{Ldlt, TangentSpace};
use crate::real::{Ordered, Real};
use crate::state::State;

/// Small deviations from a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearModel<R, const N: usize, const K: usize> {
    /// M.
    pub mass: SMatrix<R, N, N>,
    /// C, symmetric: dissipation.
    pub damping: SMatrix<R, N, N>,
    /// G, skew: forces without power.
    pub gyroscopic: SMatrix<R, N, N>,
    /// K, with circulatory forces as its skew part.
    pub stiffness: SMatrix<R, N, N>,
    /// ∂f/∂u.
    pub by_inputs: SMatrix<R, N, K>,
    /// The changes of coordinates that the holonomic constraints allow.
    pub displacements: Basis<R, N>,
    /// The changes of velocities that all constraints allow.
    pub velocities: Basis<R, N>,
    /// ∂ξ̇/∂ξ, ∂ξ̇/∂η, ∂η̇/∂ξ, ∂η̇/∂η: the leading rows and columns count.
    blocks: [[SMatrix<R, N, N>; 2]; 2],
    /// ∂η̇/∂u.
    input: SMatrix<R, N, K>,
    /// ξ̇ and η̇ at the state itself.
    drift: [SVector<R, N>; 2],
}

/// Vectors that span a space of motions: of unit kinetic energy ½ zᵀ M z = ½ and orthogonal in M where M is positive on that
/// space; without constraints the coordinates themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basis<R, const N: usize> {
    vectors: SMatrix<R, N, N>,
    count: usize,
    /// What gives the components of a vector: rows.
    dual: SMatrix<R, N, N>,
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
        self.dual * vector
    }

    /// The coordinates themselves.
    fn identity() -> Self {
        let vectors = SMatrix::from_fn(|i, j| if i == j { R::one() } else { R::zero() });
        Self { vectors, count: N, dual: vectors }
    }

    /// Of a null space: orthonormal in `mass` where that is possible, else in its diagonal.
    fn new(space: &TangentSpace<R, N>, mass: &SMatrix<R, N, N>) -> Self {
        let TangentSpace { vectors: rows, count, metric } = *space;
        let vectors: SMatrix<R, N, N> =
            SMatrix::from_fn(|i, k| if k < count { rows[k][i] } else { R::zero() });
        let inertia = vectors.transpose() * mass * vectors;
        // Beyond the basis the matrix is completed by ones.
        let completed = |k: usize, l: usize| {
            if k == l && k >= count { R::one() } else { inertia[(k, l)] }
        };
        let lower: [[R; N]; N] = core::array::from_fn(|k| core::array::from_fn(|l| completed(k, l)));
        if Ldlt::factor(lower).is_err() {
            let weights = SVector::from(metric);
            let dual = SMatrix::from_fn(|k, i| vectors[(i, k)] * weights[i]);
            return Self { vectors, count, dual };
        }
        let mut columns: [SVector<R, N>; N] = core::array::from_fn(|k| vectors.column(k).into_owned());
        for k in 0..count {
            // Twice is enough, as in the Gram–Schmidt of the multipliers.
            for _ in 0..2 {
                let mut vector = columns[k];
                for before in columns.iter().take(k) {
                    vector -= before * product(&vector, mass, before);
                }
                columns[k] = vector * product(&vector, mass, &vector).sqrt().recip();
            }
        }
        let vectors = SMatrix::from_fn(|i, k| columns[k][i]);
        Self { vectors, count, dual: vectors.transpose() * mass }
    }
}

/// xᵀ M y.
fn product<R: Real, const N: usize>(x: &SVector<R, N>, mass: &SMatrix<R, N, N>, y: &SVector<R, N>) -> R {
    let image = mass * y;
    x.iter().zip(&image).fold(R::zero(), |sum, (&a, &b)| sum + a * b)
}

impl<R: Real, const N: usize, const K: usize> LinearModel<R, N, K> {
    /// The number of components of x = (ξ, η).
    #[inline]
    #[must_use]
    pub fn order(&self) -> usize {
        self.displacements.len() + self.velocities.len()
    }

    /// A of ẋ = A x + B u + drift, where x are the components of δq in [`LinearModel::displacements`], then those of δv in
    /// [`LinearModel::velocities`]; without constraints x = (δq, δv). `None` if `D` is not [`LinearModel::order`].
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

    /// M, C, G or K on the velocities that the constraints allow: Zᵀ X Z, of which the leading rows and columns count.
    #[must_use]
    pub fn on_tangent_space(&self, matrix: &SMatrix<R, N, N>) -> SMatrix<R, N, N> {
        self.velocities.vectors.transpose() * matrix * self.displacements.vectors
    }

    /// The same with other numbers.
    #[cfg(feature = "std")]
    pub(super) fn map<T: Real>(&self, number: impl Fn(R) -> T + Copy) -> LinearModel<T, N, K> {
        let basis = |basis: &Basis<R, N>| Basis {
            vectors: basis.vectors.map(number),
            count: basis.count,
            dual: basis.dual.map(number),
        };
        LinearModel {
            mass: self.mass.map(number),
            damping: self.damping.map(number),
            gyroscopic: self.gyroscopic.map(number),
            stiffness: self.stiffness.map(number),
            by_inputs: self.by_inputs.map(number),
            displacements: basis(&self.displacements),
            velocities: basis(&self.velocities),
            blocks: self.blocks.map(|row| row.map(|block| block.map(number))),
            input: self.input.map(number),
            drift: self.drift.map(|part| part.map(number)),
        }
    }

    /// The part of x that a component belongs to, and its place there.
    fn split(&self, i: usize) -> (usize, usize) {
        let count = self.displacements.len();
        if i < count { (0, i) } else { (1, i - count) }
    }
}

pub(super) fn linearize<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<LinearModel<S::Scalar, N, K>, MotionError<S::Scalar>>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    let constants = system.constants();
    let Factored { balance, variation, saddle } = factored(system, &constants, state, u)?;
    let matrix = |rows: &[[S::Scalar; N]; N]| SMatrix::<S::Scalar, N, N>::from_fn(|i, j| rows[i][j]);
    let half = S::Scalar::from_f64(0.5);
    let (mass, by_v) = (matrix(&variation.mass), matrix(&variation.by_v));
    let zero = S::Scalar::from_f64(0.0);
    let (a_by_q, _) = columns(&saddle, &variation.by_q, &variation.conditions_by_q);
    let (a_by_v, _) = columns(&saddle, &variation.by_v, &variation.conditions_by_v);
    let (a_by_u, _) = columns(&saddle, &variation.by_u, &[[zero; K]; C]);
    // The change of velocity that a change of place needs.
    let (entrained, _) = columns(&saddle, &[[zero; N]; N], &variation.rates_by_q);

    let (displacements, velocities) = if C == 0 {
        (Basis::identity(), Basis::identity())
    } else {
        let mut holonomic = variation.gradients;
        for (row, is_holonomic) in holonomic.iter_mut().zip(S::HOLONOMIC) {
            if !is_holonomic {
                *row = [zero; N];
            }
        }
        (
            Basis::new(&TangentSpace::new(&variation.mass, &holonomic), &mass),
            Basis::new(&TangentSpace::new(&variation.mass, &variation.gradients), &mass),
        )
    };
    let (z, y) = (&displacements.vectors, &velocities.vectors);
    let carried = entrained * z;
    let blocks = [
        [displacements.dual * carried, displacements.dual * y],
        [velocities.dual * (a_by_q * z + a_by_v * carried), velocities.dual * (a_by_v * y)],
    ];
    Ok(LinearModel {
        mass,
        damping: SMatrix::from_fn(|i, j| -half * (by_v[(i, j)] + by_v[(j, i)])),
        gyroscopic: SMatrix::from_fn(|i, j| -half * (by_v[(i, j)] - by_v[(j, i)])),
        stiffness: matrix(&variation.by_q).map(|x| -x),
        by_inputs: SMatrix::from_fn(|i, j| variation.by_u[i][j]),
        blocks,
        input: velocities.dual * a_by_u,
        drift: [
            displacements.components(&state.velocities()),
            velocities.components(&balance.accelerations.into()),
        ],
        displacements,
        velocities,
    })
}
