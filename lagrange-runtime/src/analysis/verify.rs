//! The certificate of a model: identities that must hold, checked at sampled states against the user's own
//! functions.
//!
//! No stored numbers are compared. Derivatives are central differences of what the model computes, and of the
//! user's positions and energies; their steps follow the scales of the motion, and how uncertain a difference
//! is follows from steps of several lengths, so that nothing is asked of it that it cannot give.

mod checks;
mod differences;
mod placed;
mod scales;

use core::fmt;

use num_traits::One;

use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::System;
use crate::system::error::magnitude;
use crate::system::state::State;
pub use differences::derivative;
pub use placed::{Given, Placed, given, kinetic};

/// An identity that a model must satisfy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Identity {
    /// M is symmetric positive definite; where constraints hold massless coordinates, semidefinite.
    PositiveInertia,
    /// Ṁ − 2C is skew.
    SkewCoriolis,
    /// The accelerations satisfy d/dt ∂L/∂v − ∂L/∂q = Q − ∂D/∂v + Aᵀλ.
    LagrangesEquation {
        /// Index of the coordinate.
        coordinate: usize,
    },
    /// The Jacobi integral, or the energy, changes at the rate of its balance of power.
    PowerBalance,
    /// A conserved quantity does not change along the motion.
    Conservation {
        /// Index in `CONSERVED` of the system.
        index: usize,
    },
    /// The gradient of a constraint is its derivative.
    ConstraintGradient {
        /// Index in `CONSTRAINTS` of the system.
        constraint: usize,
    },
    /// T is that of the user's own positions, poses and functions.
    KineticEnergy,
    /// V is that of the user's own functions.
    PotentialEnergy,
    /// v·∂L/∂v less the Jacobi integral is L of the user's own functions.
    Lagrangian,
    /// There are states at which the model can be evaluated.
    Domain,
}

impl fmt::Display for Identity {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PositiveInertia => out.write_str("the mass matrix is positive definite"),
            Self::SkewCoriolis => out.write_str("Ṁ − 2C is skew"),
            Self::LagrangesEquation { coordinate } => {
                write!(out, "the accelerations satisfy Lagrange's equation of coordinate {coordinate}")
            }
            Self::PowerBalance => out.write_str("the energy changes at the rate of the power balance"),
            Self::Conservation { index } => write!(out, "conserved quantity {index} does not change"),
            Self::ConstraintGradient { constraint } => {
                write!(out, "the gradient of constraint {constraint} is its derivative")
            }
            Self::KineticEnergy => out.write_str("T is that of the described positions"),
            Self::PotentialEnergy => out.write_str("V is the described one"),
            Self::Lagrangian => out.write_str("L is the described one"),
            Self::Domain => out.write_str("the model can be evaluated at one of the states"),
        }
    }
}

/// A passed verification.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// States at which every identity was checked; others were outside the domain of the model.
    pub states: usize,
    /// Comparisons made.
    pub comparisons: usize,
    /// The largest deviation, as a share of what was allowed.
    pub worst: f64,
}

impl fmt::Display for Certificate {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { states, comparisons, worst } = self;
        write!(
            out,
            "verified: {comparisons} comparisons at {states} states, the largest deviation {worst:.1e} of what was allowed"
        )
    }
}

/// A failed verification.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// The identity that does not hold.
    pub identity: Identity,
    /// By how much, in the unit of the identity.
    pub by: f64,
    /// The deviation that rounding and the uncertainty of differences can explain.
    pub allowed: f64,
}

impl fmt::Display for Violation {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "violated: {}; off by {:e}, allowed {:e}", self.identity, self.by, self.allowed)
    }
}

impl core::error::Error for Violation {}

/// Energies by the user's own functions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Described<R> {
    /// T of positions, poses and functions.
    pub kinetic: R,
    /// V.
    pub potential: R,
    /// Lagrangians given as a whole.
    pub lagrangian: R,
    /// Uncertainty of T.
    pub uncertainty: R,
}

/// Accelerations and loads of a system at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven<R, const N: usize> {
    /// a.
    pub accelerations: [R; N],
    /// Q − ∂D/∂v + Aᵀλ.
    pub loads: [R; N],
}

/// A system with a certificate: one whose attribute asks for `analysis`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no certificate",
    label = "this needs `analysis`",
    note = "say so in the attribute: `#[lagrangian(coordinates = […], analysis)]`"
)]
pub trait Verifiable<const N: usize, const K: usize = 0>: System<N, K> {
    /// The number of conserved quantities.
    const CONSERVED: usize;
    /// The number of constraints.
    const CONSTRAINTS: usize;
    /// Whether M must be positive.
    const DEFINITE: bool;

    /// The nearest state on the constraints, if there is one.
    fn nearest_at(&self, state: &State<Self::Scalar, N>) -> Option<State<Self::Scalar, N>>;
    /// M.
    fn mass_at(&self, state: &State<Self::Scalar, N>) -> [[Self::Scalar; N]; N];
    /// C, where M does not depend on velocities.
    fn coriolis_at(&self, state: &State<Self::Scalar, N>) -> Option<[[Self::Scalar; N]; N]>;
    /// ∂L/∂v.
    fn momenta_at(&self, state: &State<Self::Scalar, N>) -> [Self::Scalar; N];
    /// v·∂L/∂v − L.
    fn integral_at(&self, state: &State<Self::Scalar, N>) -> Self::Scalar;
    /// Its rate along the motion.
    fn integral_rate_at(&self, state: &State<Self::Scalar, N>, u: &[Self::Scalar; K])
    -> Option<Self::Scalar>;
    /// Accelerations, and Q − ∂D/∂v + Aᵀλ.
    fn driven_at(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Option<Driven<Self::Scalar, N>>;
    /// A conserved quantity.
    fn conserved_at(&self, state: &State<Self::Scalar, N>, index: usize) -> Self::Scalar;
    /// f or g of a constraint.
    fn constraint_at(&self, state: &State<Self::Scalar, N>, constraint: usize) -> Self::Scalar;
    /// Its gradient by coordinates or velocities.
    fn gradient_at(&self, state: &State<Self::Scalar, N>, constraint: usize) -> [Self::Scalar; N];
    /// Whether the gradient is one by coordinates.
    fn is_holonomic(constraint: usize) -> bool;
    /// T and V, where L is not given as a whole.
    fn energies_at(&self, state: &State<Self::Scalar, N>) -> Option<[Self::Scalar; 2]>;
    /// The same by the user's functions, with the scale of time of differences.
    fn described_at(&self, state: &State<Self::Scalar, N>, time: Self::Scalar) -> Described<Self::Scalar>;
}

/// The number of states that are drawn if the caller gives none.
const STATES: usize = 12;

/// Checks all identities at states with coordinates and velocities between −1 and 1. Such states say little
/// about a model whose scales are far from one: pass states of your own to [`verify_at`].
///
/// # Errors
/// The first identity that does not hold.
pub fn verify<S: Verifiable<N, K>, const N: usize, const K: usize>(
    system: &S,
) -> Result<Certificate, Violation> {
    let mut count = 0_u32;
    let mut next = || {
        // Multiples of the golden ratio are evenly spread.
        count += 1;
        let share = f64::from(count) * 0.618_033_988_749_894_9;
        S::Scalar::from_f64(2.0 * (share - f64::from(share as u32)) - 1.0)
    };
    let states: [State<S::Scalar, N>; STATES] = array(|_| {
        let (q, v) = (array(|_| next()), array(|_| next()));
        State { t: next(), q, v }
    });
    verify_at(system, &states)
}

/// Checks all identities at the given states, moved onto the constraints if there are any.
///
/// # Errors
/// The first identity that does not hold; [`Identity::Domain`] where the model cannot be evaluated at any of
/// the states.
pub fn verify_at<S: Verifiable<N, K>, const N: usize, const K: usize>(
    system: &S,
    states: &[State<S::Scalar, N>],
) -> Result<Certificate, Violation> {
    let mut passed = Certificate { states: 0, comparisons: 0, worst: 0.0 };
    for state in states {
        // Any numbers do for inputs.
        let u = array(|k| S::Scalar::from_f64(0.7 - 0.31 * k as f64) * (S::Scalar::one() + state.t.abs()));
        if let Some(seen) = checks::at_state(system, state, &u)? {
            passed.states += 1;
            passed.comparisons += seen.comparisons;
            passed.worst = if seen.worst > passed.worst { seen.worst } else { passed.worst };
        }
    }
    if passed.states == 0 {
        return Err(Violation { identity: Identity::Domain, by: states.len() as f64, allowed: 0.0 });
    }
    Ok(passed)
}

/// A number of the user's scalar as a double, of seven digits.
fn double<R: Real>(value: R) -> f64 {
    f64::from(magnitude(value.abs().largest()).0)
}

#[cfg(test)]
mod tests;
