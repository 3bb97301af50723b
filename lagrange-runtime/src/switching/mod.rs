//! Systems whose equations switch: kinks in a description, unilateral contacts, dry friction.
//!
//! In one *regime* the equations are smooth. A regime says which rows are constraints at present (a closed
//! contact, a sticking friction), in which direction a friction slips, and on which side of each kink the
//! motion is. Rows that are not active stay in the saddle-point system and have no effect. So one piece of
//! generated code serves all regimes: code for each of them would grow exponentially with the rows.
//!
//! Brogliato, *Nonsmooth Mechanics*, 3rd ed.; Glocker, *Set-Valued Force Laws*; Acary and Brogliato,
//! *Numerical Methods for Nonsmooth Dynamical Systems*.

mod alone;
mod along;
mod begin;
mod blind;
mod certain;
mod choice;
mod contacts;
mod corners;
mod course;
mod drifting;
mod ended;
mod event;
mod functions;
mod growing;
mod guards;
mod hybrid;
mod impact;
mod impulses;
mod in_turn;
mod judging;
mod kinks;
mod known;
mod launch;
mod letting_go;
mod limits;
mod loose;
mod margin;
mod memory;
mod narrow;
mod nearest;
mod overloads;
mod pace;
mod passed;
mod pivoting;
mod place;
mod reactions;
mod relief;
mod rest;
mod run;
mod saltation;
mod scales;
mod scene;
mod shares;
mod sided;
mod since;
mod standstill;
mod steps;
mod sweeps;
mod trials;
mod turning;
mod valid;
mod way;

use crate::constraints::{Equations, Residuals};
use crate::linear::{SaddlePoint, Switched, SwitchedRows};
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::System;
use crate::system::hidden::Hidden;
use crate::system::name::Name;
use crate::system::state::State;
#[doc(hidden)]
pub use alone::{accelerations, multipliers};
pub use contacts::{Contact, NamedRows, Switch};
pub use hybrid::Hybrid;
pub use memory::HybridMemory;
#[doc(hidden)]
pub use passed::passed;
pub use steps::StepsMemory;

/// The meaning of a row of the constraint matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// A constraint that always holds.
    Bilateral,
    /// A gap f(q, t) ≥ 0 with a reaction λ ≥ 0.
    Unilateral,
    /// A slip velocity. While the friction sticks, it is zero and its multiplier is the friction force.
    Friction {
        /// The row of the reaction or load that limits the friction. `None` if its limit is given.
        normal: Option<usize>,
        /// The row of the other component of a slip in two directions. [`Regime::slip`] has one entry for
        /// both, in the first of the two rows.
        pair: Option<usize>,
    },
    /// No constraint. Its multiplier is the size of a force that several reactions make together and that
    /// limits friction, or a sum that such a force is made of. It follows from the multipliers of the others.
    Load,
}

/// A regime: one piece of the equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regime<R, const C: usize, const W: usize> {
    /// Which rows are constraints.
    pub active: [bool; C],
    /// The sign of the slip velocity of a friction that slips, zero of one that does not. A slip in two
    /// directions has one in the first of its rows if it slips, and always zero in the other.
    pub slip: [R; C],
    /// The sign of a reaction that limits friction: one for a contact, either sign for a bilateral
    /// constraint.
    pub side: [R; C],
    /// The side of zero on which each switching function is: one or minus one.
    pub kinks: [R; W],
}

/// The numbers that decide about regimes, at a state: those of all rows, active or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laws<R, const C: usize, const W: usize> {
    /// Gaps, rates and slip velocities, with the sizes of their summands.
    pub rows: Residuals<R, C>,
    /// Coefficients of restitution of unilateral rows.
    pub restitution: [R; C],
    /// Coefficients of friction while slipping. Where a limit is given, it stands here itself: a force \[N],
    /// or for an angular slip a torque \[N m]. Nothing stands here where
    /// [`coefficients_in`](Switching::coefficients_in) has coefficients of its own.
    pub kinetic: [R; C],
    /// The same while sticking: no less than the kinetic ones.
    pub fixed: [R; C],
    /// Switching functions of kinks.
    pub kinks: [R; W],
    /// Σ |summands| of these.
    pub kink_sizes: [R; W],
}

/// Coefficients of friction in one direction of each slip; see [`Laws`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients<R, const C: usize> {
    /// Coefficients of friction that slips.
    pub kinetic: [R; C],
    /// Coefficients of friction that sticks, against slipping in this direction.
    pub fixed: [R; C],
}

/// The functions that the guards of a regime are made of, beside reactions; a guard ends the regime where it
/// falls through zero. They are smooth in the regime, as kinks are replaced by their sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Functions<T, const C: usize, const W: usize> {
    /// Gaps of contacts, slip velocities of frictions.
    pub rows: [T; C],
    /// Coefficients of the friction that sticks, or its limit, where slips would go forward.
    pub fixed: [T; C],
    /// Switching functions of kinks.
    pub kinks: [T; W],
}

/// How a function of a regime is known along a series of the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// It does not change.
    Constant,
    /// It is the function of this index that the series follows.
    Series(usize),
    /// It has no series.
    Unknown,
}

/// The functions of a regime that are wanted. The others may have any value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted<const C: usize, const W: usize> {
    /// Gaps and slip velocities.
    pub rows: [bool; C],
    /// Coefficients of the friction that sticks.
    pub fixed: [bool; C],
    /// Switching functions.
    pub kinks: [bool; W],
}

/// A system whose equations switch, with `C` rows of constraints and `W` kinks.
pub trait Switching<const N: usize, const K: usize, const C: usize, const W: usize>: System<N, K> {
    /// The equations in one regime.
    type InRegime: System<N, K, Scalar = Self::Scalar> + Copy + core::fmt::Debug;

    /// The meanings of the rows, in the order of `NAMES.constraints`.
    const ROWS: [Row; C];

    /// Contacts whose restitution is Poisson's.
    const POISSON: [bool; C] = [false; C];

    /// Whether none of the equations and laws contains time: then rest lasts.
    const AUTONOMOUS: bool = false;

    /// Whether any coefficient of friction changes with the state or with time.
    const VARYING: bool = false;

    /// The number of functions of regimes that a series follows.
    const FOLLOWED: usize = 0;

    /// How the functions of a regime are known along its series.
    const ALONG: Functions<Along, C, W> =
        Functions { rows: [Along::Unknown; C], fixed: [Along::Unknown; C], kinks: [Along::Unknown; W] };

    /// The same for [`backward_in`](Self::backward_in).
    const BACKWARD: [Along; C] = Self::ALONG.fixed;

    /// The user's function that contains each kink.
    const KINKS: [Name; W] = [Name::NONE; W];

    /// The equations in a regime.
    fn in_regime(&self, regime: &Regime<Self::Scalar, C, W>) -> Self::InRegime;

    /// The numbers that decide about regimes, at a state.
    fn laws_at(
        &self,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> Laws<Self::Scalar, C, W>;

    /// The functions that the guards of a regime are made of, over any numbers: those of the system, or
    /// values with bounds of their rounding errors. `number` makes one of a parameter.
    fn functions_in<T: Real>(
        in_regime: &Self::InRegime,
        number: impl Fn(Self::Scalar) -> T,
        t: T,
        q: &[T; N],
        v: &[T; N],
        u: &[T; K],
        wanted: &Wanted<C, W>,
    ) -> Functions<T, C, W>;

    /// Coefficients of friction in a regime, at a state with these laws, where each slip goes forward, and
    /// backward. A state on a kink, as at the moment at which a coefficient jumps, does not tell them.
    fn coefficients_in(
        _in_regime: &Self::InRegime,
        _t: Self::Scalar,
        _q: &[Self::Scalar; N],
        _v: &[Self::Scalar; N],
        _u: &[Self::Scalar; K],
        laws: &Laws<Self::Scalar, C, W>,
    ) -> [Coefficients<Self::Scalar, C>; 2] {
        [Coefficients { kinetic: laws.kinetic, fixed: laws.fixed }; 2]
    }

    /// [`Functions::fixed`] where slips would go backward; `None` where that is the same.
    fn backward_in<T: Real>(
        _in_regime: &Self::InRegime,
        _number: impl Fn(Self::Scalar) -> T,
        _t: T,
        _q: &[T; N],
        _v: &[T; N],
        _u: &[T; K],
    ) -> Option<[T; C]> {
        None
    }

    /// Whether a function in the guards can hide from their series.
    const NARROW: bool = false;

    /// Visits such functions as [`System::hidden_along`] does those in the equations.
    fn hidden_in<const PLACES: usize>(
        _in_regime: &Self::InRegime,
        _states: &[State<Self::Scalar, N>; PLACES],
        _inputs: &[[Self::Scalar; K]; PLACES],
        _visit: impl FnMut(Hidden, [Self::Scalar; PLACES]),
    ) {
    }

    /// The gain of the energy where each switching function passes zero upwards, and Σ |summands| of the
    /// energy.
    fn jumps_at(
        &self,
        _t: Self::Scalar,
        _q: &[Self::Scalar; N],
        _v: &[Self::Scalar; N],
        _u: &[Self::Scalar; K],
    ) -> [[Self::Scalar; W]; 2] {
        [[num_traits::Zero::zero(); W]; 2]
    }

    /// Visits momenta and rates of constraints that have two values where a switching function is zero: the
    /// number of the function, the gain of the momentum or rate where the function passes zero upwards, and
    /// Σ |summands| of the momentum or rate.
    fn corners_at(
        &self,
        _t: Self::Scalar,
        _q: &[Self::Scalar; N],
        _v: &[Self::Scalar; N],
        _u: &[Self::Scalar; K],
        _visit: impl FnMut(usize, Self::Scalar, Self::Scalar),
    ) {
    }

    /// Visits gaps and constraints that have two values where a switching function is zero: the number of the
    /// function, the row, and the gain of the gap or constraint where the function passes zero upwards.
    fn breaks_at(
        &self,
        _t: Self::Scalar,
        _q: &[Self::Scalar; N],
        _v: &[Self::Scalar; N],
        _u: &[Self::Scalar; K],
        _visit: impl FnMut(usize, usize, Self::Scalar),
    ) {
    }

    /// The equations of a regime at a state, factored; `None` for a system without contacts and friction.
    fn equations_in(
        _in_regime: &Self::InRegime,
        _t: Self::Scalar,
        _q: &[Self::Scalar; N],
        _v: &[Self::Scalar; N],
        _u: &[Self::Scalar; K],
    ) -> Option<Equations<Switched<Self::Scalar, N, C>, Self::Scalar, N, C>> {
        None
    }

    /// The part of [`equations_in`](Self::equations_in) that needs no factors; `None` likewise.
    fn rows_in(
        in_regime: &Self::InRegime,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> Option<SwitchedRows<Self::Scalar, N, C>> {
        let Equations { saddle, gradients, forces, gamma } = Self::equations_in(in_regime, t, q, v, u)?;
        Some(SwitchedRows { gradients, gamma, forces, units: saddle.units() })
    }
}

impl<R: Real, const C: usize, const W: usize> Regime<R, C, W> {
    /// One for a row that holds, else zero.
    #[inline]
    pub fn activity(&self, row: usize) -> R {
        if self.active.get(row).copied().unwrap_or(false) { R::one() } else { R::zero() }
    }

    /// All contacts open, no friction that sticks or slips; every switching function positive.
    pub fn open(rows: &[Row; C]) -> Self {
        Self {
            active: rows.each(|row| row == Row::Bilateral),
            slip: [R::zero(); C],
            side: [R::one(); C],
            kinks: [R::one(); W],
        }
    }
}

#[cfg(test)]
mod tests;
