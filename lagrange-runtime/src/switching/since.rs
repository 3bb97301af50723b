//! Time counted from the beginning of a step.
//!
//! After a while, in `f32` soon, time is known no better than to a part of a short step. Events within a step
//! do not suffer from that: here only the equations see the full time.

use super::{Along, Coefficients, Functions, Laws, Regime, Row, Switching, Wanted};
use crate::constraints::Equations;
use crate::integrator::Dop853;
use crate::linear::{Switched, SwitchedRows};
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::System;
use crate::system::error::Cause;
use crate::system::footing::Footing;
use crate::system::hidden::Hidden;
use crate::system::name::{Name, Names};
use crate::system::smooth::{Series, Smooth};
use crate::system::state::State;

/// A system whose time is counted from an instant on.
#[derive(Debug)]
pub(super) struct Since<'a, S, R> {
    pub(super) system: &'a S,
    pub(super) instant: R,
}

/// The system of one of its regimes.
#[derive(Clone, Copy, Debug)]
pub struct InRegimeSince<I, R> {
    in_regime: I,
    pub(super) instant: R,
}

impl<I, R: Real> InRegimeSince<I, R> {
    /// Runs a function on a state at its full time.
    fn moved<T, const N: usize>(
        &self,
        state: &mut State<R, N>,
        moves: impl FnOnce(&mut State<R, N>) -> T,
    ) -> T {
        let t = state.t;
        state.t += self.instant;
        let result = moves(state);
        state.t = t;
        result
    }
}

impl<I: System<N, K> + Copy, const N: usize, const K: usize> System<N, K> for InRegimeSince<I, I::Scalar> {
    type Scalar = I::Scalar;
    type Method = Dop853;
    type Constants = I::Constants;
    const NAMES: Names = I::NAMES;
    const ORIENTATIONS: &'static [usize] = I::ORIENTATIONS;
    const CONSTRAINED: bool = I::CONSTRAINED;
    const COUPLED: bool = I::COUPLED;
    const CONSERVES_ENERGY: bool = I::CONSERVES_ENERGY;
    const STEEP: bool = I::STEEP;
    const ROOTED: bool = I::ROOTED;

    #[inline]
    fn constants(&self) -> Self::Constants {
        self.in_regime.constants()
    }

    #[inline]
    fn accelerations_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> [Self::Scalar; N] {
        self.in_regime.accelerations_at(constants, self.instant + t, q, v, u)
    }

    fn check_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Result<(), Cause> {
        self.in_regime.check_at(constants, self.instant + t, q, v)
    }

    fn begin_at(&self, constants: &Self::Constants, start: &mut State<Self::Scalar, N>) -> Result<(), Cause> {
        self.moved(start, |start| self.in_regime.begin_at(constants, start))
    }

    fn project_at(
        &self,
        constants: &Self::Constants,
        state: &mut State<Self::Scalar, N>,
        from: Option<&State<Self::Scalar, N>>,
    ) -> Result<(), Cause> {
        let from = from.map(|from| from.at_time(self.instant + from.t));
        self.moved(state, |state| self.in_regime.project_at(constants, state, from.as_ref()))
    }

    fn land_at(
        &self,
        constants: &Self::Constants,
        state: &mut State<Self::Scalar, N>,
        inputs: Option<&[Self::Scalar; K]>,
    ) -> Result<Footing<Self::Scalar, N>, Cause> {
        self.moved(state, |state| self.in_regime.land_at(constants, state, inputs))
    }

    fn hidden_along<const PLACES: usize>(
        &self,
        states: &[State<Self::Scalar, N>; PLACES],
        inputs: &[[Self::Scalar; K]; PLACES],
        visit: impl FnMut(Hidden, [Self::Scalar; PLACES]),
    ) {
        let at_times = states.each(|state| state.at_time(self.instant + state.t));
        self.in_regime.hidden_along(&at_times, inputs, visit);
    }

    fn tangential_at(
        &self,
        state: &State<Self::Scalar, N>,
        change: &State<Self::Scalar, N>,
    ) -> State<Self::Scalar, N> {
        self.in_regime.tangential_at(&state.at_time(self.instant + state.t), change)
    }

    fn energy_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Self::Scalar {
        self.in_regime.energy_at(constants, self.instant + t, q, v)
    }
}

// Compiler messages about a system without a series are to name the user's, not this one.
#[diagnostic::do_not_recommend]
impl<I: Smooth<N, K> + Copy, const N: usize, const K: usize> Smooth<N, K> for InRegimeSince<I, I::Scalar> {
    const SHARES_PIVOTS: bool = I::SHARES_PIVOTS;
    type JetConstants = I::JetConstants;
    type Tables<const P: usize> = I::Tables<P>;

    fn jet_constants(&self) -> Self::JetConstants {
        self.in_regime.jet_constants()
    }

    #[inline]
    fn jet_at<const P: usize>(
        &self,
        constants: &Self::JetConstants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
        h: Self::Scalar,
        orders: usize,
        tables: &mut Self::Tables<P>,
        series: &mut Series<Self::Scalar, N, P>,
    ) -> bool {
        self.in_regime.jet_at(constants, self.instant + t, q, v, u, h, orders, tables, series)
    }

    fn followed<const P: usize>(tables: &Self::Tables<P>) -> [&[Self::Scalar]; 2] {
        I::followed(tables)
    }
}

impl<S: System<N, K>, const N: usize, const K: usize> System<N, K> for Since<'_, S, S::Scalar> {
    type Scalar = S::Scalar;
    type Method = Dop853;
    type Constants = S::Constants;
    const NAMES: Names = S::NAMES;
    const ORIENTATIONS: &'static [usize] = S::ORIENTATIONS;
    const SWITCHED: bool = S::SWITCHED;

    fn constants(&self) -> Self::Constants {
        self.system.constants()
    }

    fn accelerations_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> [Self::Scalar; N] {
        self.system.accelerations_at(constants, self.instant + t, q, v, u)
    }

    fn energy_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Self::Scalar {
        self.system.energy_at(constants, self.instant + t, q, v)
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Switching<N, K, C, W>
    for Since<'_, S, S::Scalar>
where
    S: Switching<N, K, C, W>,
{
    type InRegime = InRegimeSince<S::InRegime, S::Scalar>;
    const ROWS: [Row; C] = S::ROWS;
    const POISSON: [bool; C] = S::POISSON;
    const AUTONOMOUS: bool = S::AUTONOMOUS;

    const VARYING: bool = S::VARYING;
    const NARROW: bool = S::NARROW;
    const FOLLOWED: usize = S::FOLLOWED;
    const ALONG: Functions<Along, C, W> = S::ALONG;
    const BACKWARD: [Along; C] = S::BACKWARD;
    const KINKS: [Name; W] = S::KINKS;

    fn in_regime(&self, regime: &Regime<S::Scalar, C, W>) -> Self::InRegime {
        InRegimeSince { in_regime: self.system.in_regime(regime), instant: self.instant }
    }

    fn laws_at(
        &self,
        t: S::Scalar,
        q: &[S::Scalar; N],
        v: &[S::Scalar; N],
        u: &[S::Scalar; K],
    ) -> Laws<S::Scalar, C, W> {
        self.system.laws_at(self.instant + t, q, v, u)
    }

    fn functions_in<T: Real>(
        in_regime: &Self::InRegime,
        number: impl Fn(S::Scalar) -> T,
        t: T,
        q: &[T; N],
        v: &[T; N],
        u: &[T; K],
        wanted: &Wanted<C, W>,
    ) -> Functions<T, C, W> {
        let t = number(in_regime.instant) + t;
        S::functions_in(&in_regime.in_regime, number, t, q, v, u, wanted)
    }

    fn coefficients_in(
        in_regime: &Self::InRegime,
        t: S::Scalar,
        q: &[S::Scalar; N],
        v: &[S::Scalar; N],
        u: &[S::Scalar; K],
        laws: &Laws<S::Scalar, C, W>,
    ) -> [Coefficients<S::Scalar, C>; 2] {
        S::coefficients_in(&in_regime.in_regime, in_regime.instant + t, q, v, u, laws)
    }

    fn backward_in<T: Real>(
        in_regime: &Self::InRegime,
        number: impl Fn(S::Scalar) -> T,
        t: T,
        q: &[T; N],
        v: &[T; N],
        u: &[T; K],
    ) -> Option<[T; C]> {
        let t = number(in_regime.instant) + t;
        S::backward_in(&in_regime.in_regime, number, t, q, v, u)
    }

    fn hidden_in<const PLACES: usize>(
        in_regime: &Self::InRegime,
        states: &[State<S::Scalar, N>; PLACES],
        inputs: &[[S::Scalar; K]; PLACES],
        visit: impl FnMut(Hidden, [S::Scalar; PLACES]),
    ) {
        let at_times = states.each(|state| state.at_time(in_regime.instant + state.t));
        S::hidden_in(&in_regime.in_regime, &at_times, inputs, visit);
    }

    fn jumps_at(
        &self,
        t: S::Scalar,
        q: &[S::Scalar; N],
        v: &[S::Scalar; N],
        u: &[S::Scalar; K],
    ) -> [[S::Scalar; W]; 2] {
        self.system.jumps_at(self.instant + t, q, v, u)
    }

    fn corners_at(
        &self,
        t: S::Scalar,
        q: &[S::Scalar; N],
        v: &[S::Scalar; N],
        u: &[S::Scalar; K],
        visit: impl FnMut(usize, S::Scalar, S::Scalar),
    ) {
        self.system.corners_at(self.instant + t, q, v, u, visit);
    }

    fn breaks_at(
        &self,
        t: S::Scalar,
        q: &[S::Scalar; N],
        v: &[S::Scalar; N],
        u: &[S::Scalar; K],
        visit: impl FnMut(usize, usize, S::Scalar),
    ) {
        self.system.breaks_at(self.instant + t, q, v, u, visit);
    }

    fn equations_in(
        in_regime: &Self::InRegime,
        t: S::Scalar,
        q: &[S::Scalar; N],
        v: &[S::Scalar; N],
        u: &[S::Scalar; K],
    ) -> Option<Equations<Switched<S::Scalar, N, C>, S::Scalar, N, C>> {
        S::equations_in(&in_regime.in_regime, in_regime.instant + t, q, v, u)
    }

    fn rows_in(
        in_regime: &Self::InRegime,
        t: S::Scalar,
        q: &[S::Scalar; N],
        v: &[S::Scalar; N],
        u: &[S::Scalar; K],
    ) -> Option<SwitchedRows<S::Scalar, N, C>> {
        S::rows_in(&in_regime.in_regime, in_regime.instant + t, q, v, u)
    }
}
