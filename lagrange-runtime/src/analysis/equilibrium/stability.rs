//! What becomes of small deviations from an equilibrium.
//!
//! With a potential, the signs of its curvature decide where nothing turns: a strict minimum of V − T₀ is
//! stable (Lagrange and Dirichlet), whatever gyroscopic forces and damping act, and each direction that leads
//! down makes one motion that grows, with damping or without. Gyroscopic forces may hold a system at the top
//! of its potential, as long as nothing damps it (W. Thomson, P. Tait; N. Chetaev, *The Stability of Motion*,
//! 1961; P. Hagedorn, *Technische Schwingungslehre*): there, and where there is no potential, the eigenvalues
//! of the linear equations decide.

use core::fmt;

use super::newton::Search;
use super::statics::{Rest, Statics};
use crate::analysis::Tangent;
use crate::linear::diagonalise;
use crate::linear::stored::Stored;
use crate::number::real::{Ordered, Real, larger, smaller};

/// The fate of small deviations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stability {
    /// They stay small: the potential energy (of a moving system V − T₀) has a strict minimum on the
    /// constraints, or all deviations decay.
    Stable,
    /// To first order nothing drives the system away, and along some directions nothing drives it back: it
    /// has a symmetry, or the potential is flatter than a parabola there, as x³ and x⁴ are.
    Neutral {
        /// The number of independent directions.
        directions: usize,
    },
    /// Gyroscopic forces hold the system although its potential energy falls along some directions: to first
    /// order deviations stay small, but the least damping lets them grow.
    Gyroscopic {
        /// The number of independent directions.
        directions: usize,
    },
    /// Some motions grow. Without gyroscopic forces these are the directions in which the potential energy
    /// falls, one for a saddle between two valleys.
    Unstable {
        /// The number of independent directions.
        directions: usize,
    },
    /// The linear equations do not decide, or a constraint turns with time, so that their coefficients
    /// change: `variational().monodromy` decides then. Without feature `std`, also wherever their eigenvalues
    /// would be needed.
    Undecided,
}

impl fmt::Display for Stability {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stable => out.write_str("stable"),
            Self::Neutral { directions: 1 } => out.write_str("neutral along one direction"),
            Self::Neutral { directions } => write!(out, "neutral along {directions} directions"),
            Self::Gyroscopic { directions: 1 } => {
                out.write_str("held by gyroscopic forces against one direction that leads down")
            }
            Self::Gyroscopic { directions } => {
                write!(out, "held by gyroscopic forces against {directions} directions that lead down")
            }
            Self::Unstable { directions: 1 } => out.write_str("unstable: one motion grows"),
            Self::Unstable { directions } => write!(out, "unstable: {directions} motions grow"),
            Self::Undecided => out.write_str("not decided by the linear equations"),
        }
    }
}

/// The inertia, and the forces that depend on velocities, along the motions that the constraints allow.
struct Moving {
    /// Whether the inertia is positive.
    is_positive: bool,
    /// Whether these forces never do work on the system.
    is_damped: bool,
    /// Whether some of these forces are gyroscopic.
    is_gyroscopic: bool,
}

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// The fate of small deviations from an equilibrium.
    pub fn stability(&self, rest: &Rest<S::Scalar, N, C>, search: &Search<S::Scalar, N>) -> Stability {
        let count = rest.motions.count;
        if count == 0 && Self::HOLONOMIC {
            return Stability::Stable;
        }
        if self.turning(rest).is_some() {
            return Stability::Undecided;
        }
        let curvature = if Self::HOLONOMIC { self.curvature(rest) } else { None };
        let Some(curvature) = curvature else { return self.by_eigenvalues(rest, None) };
        let [_, flat, down] = self.confirmed(rest, search, &curvature);
        let moving = self.moving(rest);
        if !(moving.is_positive && moving.is_damped) {
            return self.by_eigenvalues(rest, None);
        }
        match (flat, down) {
            (0, 0) => Stability::Stable,
            (_, 0) => Stability::Neutral { directions: flat },
            _ if moving.is_gyroscopic => self.by_eigenvalues(rest, Some(down)),
            _ => Stability::Unstable { directions: down },
        }
    }

    fn moving(&self, rest: &Rest<S::Scalar, N, C>) -> Moving {
        let number = S::Scalar::from_f64;
        let count = rest.motions.count;
        let variation = self.variation(&rest.q, &rest.multipliers);
        let share = number(16.0 * count as f64) * S::Scalar::epsilon();
        let [lightest, heaviest] = extremes(&rest.motions.table(&variation.mass), count);
        let drag = rest.motions.table(&variation.by_v);
        let [least, most] = extremes(&drag, count);
        let pairs = (0..count).flat_map(|k| (0..k).map(move |l| (k, l)));
        let turn = pairs.fold(number(0.0), |most, (k, l)| larger((drag[k][l] - drag[l][k]).abs(), most));
        let size = larger(larger(most.abs(), least.abs()), turn);
        Moving {
            is_positive: lightest > share * heaviest,
            is_damped: most <= share * size,
            is_gyroscopic: turn > share * size,
        }
    }

    /// Stability by the eigenvalues of the linear equations. `down` is the number of directions in which a
    /// potential falls.
    #[cfg(feature = "std")]
    fn by_eigenvalues(&self, rest: &Rest<S::Scalar, N, C>, down: Option<usize>) -> Stability {
        use crate::analysis::{blur, linear_model, modes};
        use crate::system::state::State;
        let state = State::at_rest(rest.q).at_time(self.t);
        let Ok(model) = linear_model::linearize(self.system, &state, self.u, false) else {
            return Stability::Undecided;
        };
        let blur = blur::blur(self.system, &state, self.u, &model);
        let found = modes::growth(&model.map(modes::double), &blur, modes::double(S::Scalar::epsilon()));
        let Some(modes::Growth { growing, still }) = found else { return Stability::Undecided };
        match (growing, still, down) {
            (1.., _, _) => Stability::Unstable { directions: growing },
            (0, 0, None) => Stability::Stable,
            (0, _, Some(directions)) => Stability::Gyroscopic { directions },
            (0, _, None) => Stability::Undecided,
        }
    }

    #[cfg(not(feature = "std"))]
    fn by_eigenvalues(&self, _: &Rest<S::Scalar, N, C>, _: Option<usize>) -> Stability {
        Stability::Undecided
    }
}

/// The least and the largest eigenvalue of the symmetric part of a table.
fn extremes<R: Ordered, const N: usize>(table: &[[R; N]; N], count: usize) -> [R; 2] {
    let (mut even, mut vectors) = (Stored::<[[R; N]; N]>::zeros(), Stored::zeros());
    for (k, l) in (0..count).flat_map(|k| (0..count).map(move |l| (k, l))) {
        even[k][l] = R::from_f64(0.5) * (table[k][l] + table[l][k]);
    }
    diagonalise(&mut even, &mut vectors, count);
    let first = even[0][0];
    (1..count).fold([first, first], |[least, most], k| [smaller(even[k][k], least), larger(even[k][k], most)])
}
