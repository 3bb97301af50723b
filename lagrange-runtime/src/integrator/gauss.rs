//! Gauss–Legendre collocation of orders 4, 6 and 8 for stiff systems, and for long runs without constraints.
//!
//! A step finds accelerations at 2, 3 or 4 stages such that the equations of motion hold at the states which
//! follow from them by quadrature. The methods are A-stable: stable oscillations far faster than 1/h do not
//! blow up. They are neither damped nor resolved. Without constraints a step back undoes a step forward. The
//! quadrature is of q and v, so a method is symplectic only where momenta are linear in coordinates and
//! velocities, as with a constant mass matrix and no other terms in v. Under constraints it is neither
//! reversible nor symplectic, since the end of each step is moved onto the constraints.
//! E. Hairer, C. Lubich, G. Wanner, "Geometric Numerical Integration", 2nd ed., II.1.3 and VIII.6.
//!
//! The equations are solved to rounding error and the sums are compensated, so that the energy error is a
//! random walk instead of a drift (E. Hairer, R. I. McLachlan, A. Razakarivony, BIT 48 (2008) 231).

mod frozen;
mod full;
mod stages;

use super::FixedStep;
use super::tableau::gauss::{Collocation, GAUSS4, GAUSS6, GAUSS8};
use crate::number::elements::Each;
use crate::number::real::{Ordered, Real};
use crate::system::diagnose;
use crate::system::error::Cause;
use crate::system::linearized::Linearized;
use crate::system::state::State;
use num_traits::Zero;
use stages::{Stages, Start};

/// Gauss collocation with `STAGES` stages, of order 2 `STAGES`: [`Gauss4`], [`Gauss6`] and [`Gauss8`].
///
/// For systems with generated derivatives ([`Linearized`]). A step costs one evaluation of the derivatives,
/// one complex factorisation of size N with two stages or two with three and four, and `STAGES` evaluations
/// of the accelerations in each of two to eight corrections. It costs more where a step is long compared with
/// the motion. A step whose equations cannot be solved is [`Cause::NotConverged`]; the motion may go on with
/// a shorter one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gauss<const STAGES: usize>;

/// Gauss collocation of order 4, two stages.
pub type Gauss4 = Gauss<2>;

/// Gauss collocation of order 6, three stages.
pub type Gauss6 = Gauss<3>;

/// Gauss collocation of order 8, four stages.
pub type Gauss8 = Gauss<4>;

/// The numbers of stages that have a table.
#[diagnostic::on_unimplemented(
    message = "there is no `{Self}`",
    note = "Gauss methods have 2, 3 or 4 stages: `Gauss4`, `Gauss6`, `Gauss8`"
)]
trait Tabulated<const STAGES: usize> {
    const TABLE: Collocation<STAGES>;
}

impl Tabulated<2> for Gauss<2> {
    const TABLE: Collocation<2> = GAUSS4;
}

impl Tabulated<3> for Gauss<3> {
    const TABLE: Collocation<3> = GAUSS6;
}

impl Tabulated<4> for Gauss<4> {
    const TABLE: Collocation<4> = GAUSS8;
}

/// The last step, as far as the next one needs it.
#[derive(Clone, Copy, Debug)]
pub struct LastStep<R, const N: usize, const K: usize, const STAGES: usize> {
    h: R,
    u: [R; K],
    /// Accelerations at the stages.
    a: [[R; N]; STAGES],
    end: Start<R, N>,
}

impl<R: Ordered, const N: usize, const K: usize, const STAGES: usize> LastStep<R, N, K, STAGES> {
    /// The accelerations at the stages of a step of `h`, extrapolated by the polynomial of the last step.
    fn extrapolated(&self, c: &[f64; STAGES], h: R, u: &[R; K]) -> Option<[[R; N]; STAGES]> {
        let ratio = h / self.h;
        // Further out the polynomial is no guess.
        if self.u != *u || !(ratio > R::zero() && ratio < R::from_f64(2.5)) {
            return None;
        }
        let at = |x: R| {
            let mut sum = [R::zero(); N];
            for (j, a) in self.a.iter().enumerate() {
                let mut weight = R::one();
                for (k, &node) in c.iter().enumerate() {
                    if k != j {
                        weight *= (x - R::from_f64(node)) / R::from_f64(c[j] - node);
                    }
                }
                for (sum, &a) in sum.iter_mut().zip(a) {
                    *sum += weight * a;
                }
            }
            sum
        };
        Some(c.each(|node| at(R::one() + R::from_f64(node) * ratio)))
    }
}

impl<S, const N: usize, const K: usize, const STAGES: usize> FixedStep<S, N, K> for Gauss<STAGES>
where
    S: Linearized<N, K>,
    S::Scalar: Ordered,
    Self: Tabulated<STAGES>,
{
    type Memory = Option<LastStep<S::Scalar, N, K, STAGES>>;

    #[inline]
    fn begin(_: &S) -> Self::Memory {
        None
    }

    #[inline]
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause> {
        if h == S::Scalar::zero() {
            return Ok(*from);
        }
        let table = const { &Self::TABLE };
        let last = memory.filter(|last| last.end.state.q == from.q && last.end.state.v == from.v);
        let nothing = [S::Scalar::zero(); N];
        let (lost_q, lost_v) = last.map_or((nothing, nothing), |last| (last.end.lost_q, last.end.lost_v));
        let start = Start { state: *from, lost_q, lost_v };
        let stages = Stages::new(system, constants, table, &start, h, u);
        let guess = last.and_then(|last| last.extrapolated(&table.c, h, u));
        let a = match guess.and_then(|guess| stages.solve(guess)) {
            Some(a) => a,
            None => {
                let start = system.accelerations_at(constants, from.t, &from.q, &from.v, u);
                // Accelerations need not depend on what is infinite, as a velocity.
                if !start.iter().chain(&from.q).chain(&from.v).all(|x| x.is_finite()) {
                    return Err(diagnose(system, constants, from.t, &from.q, &from.v));
                }
                let rest = [start; STAGES];
                let fully = || guess.into_iter().chain([rest]).find_map(|guess| stages.solve_fully(guess));
                stages.solve(rest).or_else(fully).ok_or(Cause::NotConverged)?
            }
        };
        let end = stages.end(&a);
        *memory = Some(LastStep { h, u: *u, a, end });
        Ok(end.state)
    }
}

#[cfg(test)]
mod tests;
