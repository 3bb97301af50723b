//! Where a system can rest.
//!
//! Unknown are the coordinates alone: on the constraints, the multipliers of least squares solve Aᵀλ = −f as
//! well as can be, and what is left are the generalized forces g = Zᵀ f along the motions that the
//! constraints allow. After each step the coordinates are brought back onto the constraints. Sizes are
//! measured in the inertia of the coordinates, so that units do not matter.
//!
//! Where g has a potential, [`descent`] goes down in it, and Newton's method gives the last digits; where
//! not, Newton's method does it all ([`newton`]). [`stability`] says what was found.

mod branch;
mod confirmed;
mod curvature;
mod descent;
mod hills;
mod narrow;
mod newton;
mod resolution;
mod resting;
mod stability;
mod statics;

use core::fmt;

use num_traits::Zero;

use super::Tangent;
use crate::number::real::{Ordered, Real, larger};
use crate::system::error::magnitude;
use crate::system::error::{Cause, Magnitude};
use crate::system::name::{Name, Names, Part};
use crate::system::state::State;
use descent::Descent;
use newton::Search;
pub use stability::Stability;
use statics::{Rest, Statics};

/// The share of their first value below which forces count as faded.
const FADED: f64 = 1e-3;

/// The largest number of descents. Each begins at the saddle where the one before has ended, and ends lower.
const DESCENTS: usize = 16;

/// An equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium<R, const N: usize, const C: usize> {
    /// At rest, at the time of the guess.
    pub state: State<R, N>,
    /// Multipliers λ in the order of `CONSTRAINTS`: `Aᵀλ` balances all other forces. Where constraints are
    /// redundant, those of least Σ λ².
    pub multipliers: [R; C],
    /// Whether the equilibrium determines each multiplier.
    pub are_unique: bool,
    /// Whether there is no other equilibrium nearby: the stiffness is regular on the motions that the
    /// constraints allow.
    pub is_isolated: bool,
    /// The fate of small deviations.
    pub stability: Stability,
    /// The method that found it.
    pub found_by: FoundBy,
}

/// The methods that find equilibria.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FoundBy {
    /// None: the guess, moved onto the constraints, is an equilibrium up to rounding errors.
    Guess,
    /// Descent in potential energy, to a minimum.
    Descent,
    /// Newton's method, to an equilibrium of any kind near the guess.
    Newton,
}

/// Why there is no equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EquilibriumError {
    /// The constraints cannot be met near the guess, a mass is negative, or something is not finite.
    Constraints(Cause),
    /// This constraint moves: it does not let the system rest.
    MovingConstraint {
        /// Index of the constraint, as in `CONSTRAINTS` of the system.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// The gradient of this constraint turns with time, which drives what it holds. Forces may be balanced,
    /// but the potential energy does not tell where the system comes to rest.
    TurningConstraint {
        /// Index of the constraint.
        constraint: usize,
        /// Its name.
        name: Name,
    },
    /// The forces cannot be balanced near the guess.
    Unbalanced {
        /// Index of the coordinate along which the largest force is left.
        coordinate: usize,
        /// Its name.
        name: Name,
        /// The generalized force there, in its own unit.
        force: Magnitude,
    },
    /// This coordinate is so far from zero that forces have any value between it and the next number.
    Unresolved {
        /// Index of the coordinate.
        coordinate: usize,
        /// Its name.
        name: Name,
    },
    /// The potential energy falls without end, or forces fade with the distance and nothing rests on the way.
    RanAway {
        /// Index of the coordinate that went furthest.
        coordinate: usize,
        /// Its name.
        name: Name,
    },
}

impl EquilibriumError {
    /// The same with the names of a system.
    #[cold]
    pub(super) fn named(mut self, names: &Names) -> Self {
        match &mut self {
            Self::Constraints(cause) => *cause = cause.named(names),
            Self::MovingConstraint { constraint, name } | Self::TurningConstraint { constraint, name } => {
                *name = names.constraint(*constraint);
            }
            Self::Unbalanced { coordinate, name, .. }
            | Self::Unresolved { coordinate, name }
            | Self::RanAway { coordinate, name } => {
                *name = names.coordinate(*coordinate);
            }
        }
        self
    }
}

impl fmt::Display for EquilibriumError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constraints(cause) => write!(out, "no equilibrium: {cause}"),
            Self::MovingConstraint { constraint, name } => write!(
                out,
                "no equilibrium: constraint {constraint} moves; use coordinates that move along, in which the state is at \
                 rest",
                constraint = Part(*constraint, *name)
            ),
            Self::TurningConstraint { constraint, name } => write!(
                out,
                "no equilibrium can be told: constraint {constraint} turns with time and drives what it \
                 holds; use coordinates that move along, or ask `stationary_point` for a balance of forces \
                 and `variational().monodromy` for its stability",
                constraint = Part(*constraint, *name)
            ),
            Self::Unbalanced { coordinate, name, force } => write!(
                out,
                "no equilibrium near the guess: a force of {force} along coordinate {coordinate} is left; start nearer \
                 to one",
                coordinate = Part(*coordinate, *name)
            ),
            Self::Unresolved { coordinate, name } => write!(
                out,
                "no equilibrium can be told here: coordinate {coordinate} is so far from zero that forces have any value between it \
                 and the next number; start nearer to zero",
                coordinate = Part(*coordinate, *name)
            ),
            Self::RanAway { coordinate, name } => write!(
                out,
                "no equilibrium found: the search ran away along coordinate {coordinate}, where the energy falls or the forces fade \
                 but nothing rests; start nearer to an equilibrium (`equilibrium` goes downhill, `stationary_point` to one of any \
                 stability)",
                coordinate = Part(*coordinate, *name)
            ),
        }
    }
}

impl core::error::Error for EquilibriumError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Constraints(cause) => Some(cause),
            Self::MovingConstraint { .. }
            | Self::TurningConstraint { .. }
            | Self::Unbalanced { .. }
            | Self::Unresolved { .. }
            | Self::RanAway { .. } => None,
        }
    }
}

/// The lowest position downhill of a guess, or an equilibrium near it if forces have no potential.
pub(super) fn equilibrium<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    guess: State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<Equilibrium<S::Scalar, N, C>, EquilibriumError>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    let (statics, rest) = begun(system, guess, u)?;
    let mut search = Search::new(&rest);
    let mut rest = statics.turned_back(rest, &mut search);
    if statics.is_stationary(&rest, &search) {
        let rest = statics.polished(rest, &mut search);
        return statics.settled(rest, &search, FoundBy::Guess);
    }
    if Statics::<S, N, K, C>::HOLONOMIC {
        let start = rest.q;
        for _ in 0..DESCENTS {
            match statics.descended(rest, &mut search) {
                Descent::At(low) => rest = statics.balance(low, &mut search),
                Descent::Endless(low) => return Err(statics.ran_away(&low, &search)),
                Descent::Circulatory => {
                    rest = statics.rest(start);
                    search = Search::new(&rest);
                    rest = statics.balance(rest, &mut search);
                    return statics.settled(rest, &search, FoundBy::Newton);
                }
            }
            let Some(curvature) = statics.curvature(&rest) else { break };
            if let Some(lower) = statics.beyond(&rest, &search, &curvature) {
                rest = lower;
            } else if curvature.signature(rest.motions.count)[2] == 0 {
                break;
            }
        }
        return statics.settled(rest, &search, FoundBy::Descent);
    }
    rest = statics.balance(rest, &mut search);
    statics.settled(rest, &search, FoundBy::Newton)
}

/// An equilibrium near a guess, of any stability.
pub(super) fn stationary_point<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    guess: State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<Equilibrium<S::Scalar, N, C>, EquilibriumError>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    let (statics, rest) = begun(system, guess, u)?;
    let mut search = Search::new(&rest);
    let rest = statics.turned_back(rest, &mut search);
    let rest = statics.balance(rest, &mut search);
    statics.found(rest, &search, FoundBy::Newton)
}

/// The guess, moved onto the constraints.
#[allow(clippy::type_complexity)]
fn begun<'a, S, const N: usize, const K: usize, const C: usize>(
    system: &'a S,
    guess: State<S::Scalar, N>,
    u: &'a [S::Scalar; K],
) -> Result<(Statics<'a, S, N, K, C>, Rest<S::Scalar, N, C>), EquilibriumError>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    let not_finite = EquilibriumError::Constraints(Cause::NotFinite);
    if !guess.q.iter().all(|q| q.is_finite()) {
        return Err(not_finite);
    }
    let statics = Statics::new(system, &guess, u);
    statics.masses(guess.q).map_err(EquilibriumError::Constraints)?;
    let rest = statics.rest(statics.feasible(guess.q)?);
    has_gradients(&rest)?;
    if rest.norm.is_finite() { Ok((statics, rest)) } else { Err(not_finite) }
}

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// Whether the remaining forces at a start are rounding errors of those that a change by the size of the
    /// coordinates makes.
    fn is_stationary(&self, rest: &Rest<S::Scalar, N, C>, search: &Search<S::Scalar, N>) -> bool {
        let share = S::Scalar::from_f64(16.0 * N as f64) * S::Scalar::epsilon() * rest.stiffness.size;
        let most = rest.forces.iter().fold(S::Scalar::zero(), |most, x| larger(x.abs(), most));
        rest.length * most <= share * self.reach(rest, search) || self.starts_balanced(rest)
    }

    /// A stationary position to its last digits, unless the further steps lead elsewhere.
    fn polished(
        &self,
        rest: Rest<S::Scalar, N, C>,
        search: &mut Search<S::Scalar, N>,
    ) -> Rest<S::Scalar, N, C> {
        let q = rest.q;
        let better = self.balance(rest, search);
        let way = self.length(&self.travelled(&better, search));
        if way <= S::Scalar::epsilon().sqrt() * self.reach(&better, search) { better } else { self.rest(q) }
    }

    /// The equilibrium where the system comes to rest.
    fn settled(
        &self,
        rest: Rest<S::Scalar, N, C>,
        search: &Search<S::Scalar, N>,
        found_by: FoundBy,
    ) -> Result<Equilibrium<S::Scalar, N, C>, EquilibriumError> {
        let turning = self.turning(&rest);
        let found = self.found(rest, search, found_by)?;
        match turning {
            Some(constraint) => Err(EquilibriumError::TurningConstraint { constraint, name: Name::NONE }),
            None => Ok(found),
        }
    }

    /// The equilibrium, if the search has ended at one.
    fn found(
        &self,
        rest: Rest<S::Scalar, N, C>,
        search: &Search<S::Scalar, N>,
        found_by: FoundBy,
    ) -> Result<Equilibrium<S::Scalar, N, C>, EquilibriumError> {
        let verdict = self.judged(&rest, search);
        let faded = S::Scalar::from_f64(FADED);
        let fades = rest.norm <= faded * search.met && search.goes_on();
        // Far out all forces are small or vanish, so a balance there proves nothing.
        if fades && if verdict.is_balanced { verdict.stiffness <= faded } else { !verdict.ends } {
            return Err(self.ran_away(&rest, search));
        }
        if !verdict.is_balanced {
            return Err(unbalanced(&rest));
        }
        has_gradients(&rest)?;
        self.resolved(&rest, search)?;
        self.resting(&rest, search)?;
        let stability = self.stability(&rest, search);
        Ok(Equilibrium {
            state: State::at_rest(rest.q).at_time(self.t),
            multipliers: rest.multipliers,
            are_unique: rest.rank == C,
            is_isolated: verdict.is_isolated && !matches!(stability, Stability::Neutral { .. }),
            stability,
            found_by,
        })
    }

    /// The error of a search whose energy falls without end. If the force is constant, the error names it,
    /// which says more than the coordinate.
    fn ran_away(&self, rest: &Rest<S::Scalar, N, C>, search: &Search<S::Scalar, N>) -> EquilibriumError {
        let two = S::Scalar::from_f64(2.0);
        if rest.norm <= two * search.first && search.first <= two * rest.norm {
            return unbalanced(rest);
        }
        let travelled = self.travelled(rest, search);
        let mut coordinate = 0;
        for i in 1..N {
            let far = |i: usize| self.sizes[i].sqrt() * travelled[i].abs();
            coordinate = if far(i) > far(coordinate) { i } else { coordinate };
        }
        EquilibriumError::RanAway { coordinate, name: Name::NONE }
    }
}

/// Refuses a position at which a constraint restricts nothing.
fn has_gradients<R, const N: usize, const C: usize>(rest: &Rest<R, N, C>) -> Result<(), EquilibriumError> {
    let vanishing =
        rest.vanishing.map(|constraint| Cause::VanishingGradient { constraint, name: Name::NONE });
    vanishing.map_or(Ok(()), |cause| Err(EquilibriumError::Constraints(cause)))
}

fn unbalanced<R: Ordered, const N: usize, const C: usize>(rest: &Rest<R, N, C>) -> EquilibriumError {
    let (mut coordinate, mut force) = (0, R::zero());
    for (i, left) in rest.left.iter().enumerate() {
        if left.abs() > force {
            (coordinate, force) = (i, left.abs());
        }
    }
    EquilibriumError::Unbalanced { coordinate, name: Name::NONE, force: magnitude(force) }
}
