//! Derivatives through switches.
//!
//! If the start and parameters vary, a guard g is zero at another time: by −δg/ġ later, with ġ its rate along
//! the motion. That delay has no value, only derivatives. Varied states go on by the delay in the equations
//! that end, are switched where the guard is zero for each, and come back to the common time in the equations
//! that begin. For a switch x ↦ R(x, t) between ẋ = f⁻ and ẋ = f⁺ this is the saltation matrix ∂R + (f⁺ − ∂R
//! f⁻ − ∂R/∂t) ∇gᵀ / (∇g · f⁻ + ∂g/∂t) (Aizerman and Gantmakher 1958; Filippov, *Differential Equations with
//! Discontinuous Righthand Sides*; Leine and Nijmeijer, *Dynamics and Bifurcations of Non-Smooth Mechanical
//! Systems*, chapter 7), which is never written down.
//!
//! There are no derivatives where ġ is zero, where two guards are zero at once, where a contact that touches
//! by chance has a part in an impact, and where a motion begins at a contact that bears nothing. A motion is
//! known to its tolerance only. Where the tolerance leaves no digit of ġ at the zero, or does not tell which
//! of two zeros comes first, there are no derivatives, either.

use super::choice::Choice;
use super::guards::{Guard, Guards};
use super::known::Known;
use super::place::How;
use super::run::Run;
use super::scene::{Scene, Status, above, entry, most, rounding};
use super::{Regime, Row, Switching};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::method::Adaptive;
use crate::system::name::Name;
use crate::system::state::State;

/// A guard at a state.
struct Crossing<R> {
    /// Its value, with derivatives at a fixed time.
    value: R,
    /// Its rate along the motion.
    rate: R,
    /// The effect of the tolerance of the motion on it.
    noise: R,
}

impl<R: Real> Crossing<R> {
    /// The delay of its zero, a time without value.
    fn later(&self) -> R {
        (self.value.part(0) - self.value) / self.rate
    }

    /// The time for which the motion does not tell whether it is zero.
    fn unknown(&self) -> R {
        if self.noise.is_positive() { self.noise / self.rate.abs() } else { R::zero() }
    }
}

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// The delay of a guard, as a time without value, at the state where it has fired with these
    /// accelerations. `switched` gives the state after the switch. Fails with `Grazes` where the rate of the
    /// guard is not known, and with `SwitchesCoincide` where another guard fires at the same time, as those
    /// of rows that have shared a load do, unless nothing jumps: then the delay is zero.
    #[cold]
    pub(super) fn varied(
        &mut self,
        guard: Guard,
        how: How,
        state: &State<S::Scalar, N>,
        a: &[S::Scalar; N],
        switched: impl FnOnce(&mut Self, &mut State<S::Scalar, N>) -> Result<Regime<S::Scalar, C, W>, Cause>,
    ) -> Result<S::Scalar, Cause> {
        self.check_direction(guard)?;
        let crossing = self.crossing(guard, state, a);
        let is_shared = how == How::Shared;
        let doubt = if is_shared {
            Some(Cause::SwitchesCoincide { name: self.name(guard), other: self.other_name(guard) })
        } else if how == How::Falls && self.is_known(guard, &crossing, state) {
            self.coincidence(guard, &crossing, state, a)
        } else {
            let name = self.name(guard);
            Some(match guard {
                // A contact that comes back from its own impact without speed bounces infinitely often.
                Guard::Row(row) if entry(&self.memory.begun_by, row).part(0).abs().is_positive() => {
                    Cause::ImpactsAccumulate { constraint: row, name }
                }
                Guard::Row(switch) | Guard::Kink(switch) => Cause::Grazes { switch, name },
            })
        };
        let Some(doubt) = doubt else { return Ok(crossing.later()) };
        // If nothing jumps, the time of the switch does not matter, unless a row holds from then on, which
        // takes its variation, or a contact that closes would have struck.
        let (mut after, notes) = (*state, self.memory.notes());
        let regime = switched(self, &mut after)?;
        self.memory.take_back(notes);
        let before = self.memory.regime.active;
        let is_gap = self.guards().is_gap(guard);
        let holds = || before.iter().zip(&regime.active).any(|(before, after)| !before && *after);
        if matches!(doubt, Cause::Grazes { .. }) && (is_gap || holds()) {
            return Err(doubt);
        }
        let in_regime = self.system.in_regime(&regime);
        let State { t, q, v } = &after;
        let b = in_regime.accelerations_at(&in_regime.constants(), *t, q, v, &self.control.0);
        let part = most(self.limits.relative, rounding());
        let stays = |x: S::Scalar, y: S::Scalar, size: S::Scalar| {
            (x - y).part(0).abs() <= part * (x.part(0).abs() + y.part(0).abs() + size.part(0))
        };
        // At the limit of a load that is shared, each row may be beyond its own by the roundings of all
        // forces, and nothing accelerates by more.
        let mut sizes = [num_traits::Zero::zero(); N];
        if is_shared {
            let known = Known::settled(regime.active);
            let kinks = regime.kinks;
            let scene = Scene::new(self.system, &after, &self.control.0, kinks, &self.memory.scales, &known);
            if let Some((_, found)) = scene.balance(&regime, v) {
                sizes = found.accelerations.each(|size| S::Scalar::from_f64(C as f64) * size);
            }
        }
        // A velocity of zero has the roundings of what forces could have given it on the way.
        let passed = (state.t - self.memory.start.t).abs();
        let gains = sizes.each(|size| passed * size);
        let keep = |x: &[S::Scalar; N], y: &[S::Scalar; N], sizes: &[S::Scalar; N]| {
            x.iter().zip(y).zip(sizes).all(|((&x, &y), &size)| stays(x, y, size))
        };
        let keeps = keep(&state.v, v, &gains) && keep(a, &b, &sizes);
        if keeps { Ok(num_traits::Zero::zero()) } else { Err(doubt) }
    }

    /// Fails with `Grazes` for the guard of a load: a load has no direction where it is zero, so its slopes
    /// are made of rounding errors.
    fn check_direction(&self, guard: Guard) -> Result<(), Cause> {
        match guard {
            Guard::Row(row) if S::ROWS.get(row) == Some(&Row::Load) => {
                let limits =
                    |kind: &Row| matches!(kind, Row::Friction { normal, .. } if *normal == Some(row));
                let friction = S::ROWS.iter().position(limits).unwrap_or(row);
                Err(Cause::Grazes { switch: friction, name: S::NAMES.constraint(friction) })
            }
            _ => Ok(()),
        }
    }

    /// Completes accelerations where a slip in two directions ends: it has lost its direction, and friction
    /// with it, so the accelerations are those with which the motion arrives.
    pub(super) fn complete(&self, guard: Guard, a: &mut [S::Scalar; N], t: S::Scalar) {
        let turns = |row: usize| {
            matches!(S::ROWS[row], Row::Friction { pair: Some(_), .. }) && !self.memory.regime.active[row]
        };
        let Some(terms) =
            M::terms(&self.memory.inner).filter(|_| matches!(guard, Guard::Row(row) if turns(row)))
        else {
            return;
        };
        let unit = terms.unit.part(0);
        let passed = (t - self.memory.start.t).part(0) / unit;
        *a = array(|i| {
            let orders = terms.v.iter().enumerate().rev();
            orders.fold(num_traits::Zero::zero(), |sum: S::Scalar, (order, row)| {
                sum * passed + S::Scalar::from_f64((order + 1) as f64) * row[i].part(0) / unit
            })
        });
    }

    fn name(&self, guard: Guard) -> Name {
        match guard {
            Guard::Row(row) => S::NAMES.constraint(row),
            Guard::Kink(kink) => S::KINKS[kink],
        }
    }

    /// The name of another row that holds.
    fn other_name(&self, guard: Guard) -> Name {
        let active = self.memory.regime.active.iter().enumerate().filter(|(_, active)| **active);
        let mut rows = active.map(|(row, _)| row).filter(|&row| Guard::Row(row) != guard);
        rows.next_back().map_or(Name::NONE, |row| S::NAMES.constraint(row))
    }

    /// The guards of the piece that ends.
    fn guards(&self) -> Guards<'_, S, N, K, C, W> {
        let memory = &*self.memory;
        Guards::new(self.system, &memory.in_regime, &memory.regime, &self.control.0, &memory.start, false)
    }

    fn crossing(&self, guard: Guard, state: &State<S::Scalar, N>, a: &[S::Scalar; N]) -> Crossing<S::Scalar> {
        let guards = self.guards();
        let start = &self.memory.start;
        // Errors of a state are relative to the sizes of its numbers on the way.
        let size = |now: S::Scalar, before: S::Scalar| most(now.part(0).abs(), before.part(0).abs());
        let sizes = State {
            t: size(state.t, start.t),
            q: array(|i| size(state.q[i], start.q[i])),
            v: array(|i| size(state.v[i], start.v[i])),
        };
        let rounded = guards.value(guard, state, &sizes).error / S::Scalar::epsilon();
        Crossing {
            value: guards.varying(guard, state),
            rate: rate(&guards, guard, state, a),
            noise: most(self.limits.relative, rounding()) * rounded,
        }
    }

    /// The state and the accelerations at a time `by` \[s] before the end of the piece, or at its start if it
    /// is shorter.
    fn earlier(
        &mut self,
        state: &State<S::Scalar, N>,
        by: S::Scalar,
    ) -> (State<S::Scalar, N>, [S::Scalar; N]) {
        let memory = &mut *self.memory;
        let (inner, in_regime, constants) = (&mut memory.inner, &memory.in_regime, &memory.constants);
        let all = state.t - memory.start.t;
        let t = if by < all.abs() { state.t - all.signum() * by } else { memory.start.t };
        let earlier = if t == memory.start.t {
            memory.start
        } else {
            M::sample(inner, in_regime, constants, self.control, self.limits, t, &mut 0)
                .unwrap_or(memory.start)
        };
        let State { t, q, v } = &earlier;
        let a = in_regime.accelerations_at(constants, *t, q, v, &self.control.0);
        (earlier, a)
    }

    /// Whether the rate of a guard is known to any digit where its zero is.
    fn is_known(
        &mut self,
        guard: Guard,
        crossing: &Crossing<S::Scalar>,
        state: &State<S::Scalar, N>,
    ) -> bool {
        let (earlier, a) = self.earlier(state, crossing.unknown());
        let before = rate(&self.guards(), guard, &earlier, &a);
        above(crossing.rate.abs(), (crossing.rate - before).abs())
    }

    /// `SwitchesCoincide`, if another guard falls through zero at the same time, as far as times are known,
    /// and its zero moves otherwise when the start varies.
    fn coincidence(
        &self,
        guard: Guard,
        crossing: &Crossing<S::Scalar>,
        state: &State<S::Scalar, N>,
        a: &[S::Scalar; N],
    ) -> Option<Cause> {
        let passed = state.t - self.memory.start.t;
        let part = most(self.limits.relative, rounding());
        let alike = |x: S::Scalar, y: S::Scalar| (x - y).abs() <= part * (x.abs() + y.abs());
        let varies_alike =
            |x: S::Scalar, y: S::Scalar| (1..S::Scalar::PARTS).all(|i| alike(x.part(i), y.part(i)));
        let coincides = |other: &Guard| {
            let there = self.crossing(*other, state, a);
            let falls = above(-(there.rate * passed), there.noise);
            let apart = there.value.part(0).abs() / there.rate.abs();
            falls
                && !above(apart, there.unknown() + crossing.unknown())
                && !varies_alike(there.later(), crossing.later())
        };
        let other = self.guards().all().find(|other| *other != guard && coincides(other))?;
        Some(Cause::SwitchesCoincide { name: self.name(guard), other: self.name(other) })
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// Why an impact with these impulses has no derivatives: a contact beside the one that has fired has a
    /// part in it, and its gap varies. In varied motions that contact is open at the time of the impact, and
    /// is struck later, if at all. The gap of a contact that holds at `present` does not vary. Nor has an
    /// impact derivatives whose restitution is zero and varies: infinitely many impacts follow in varied
    /// motions.
    #[cold]
    pub(super) fn struck(
        &self,
        fired: Option<usize>,
        present: &[bool; C],
        impulses: &[S::Scalar; C],
        tolerance: S::Scalar,
    ) -> Result<(), Cause> {
        let begins_to_bounce = |row: &usize| {
            let e = self.laws.restitution[*row];
            self.status[*row] == Status::Meets
                && e.part(0) == num_traits::Zero::zero()
                && (1..S::Scalar::PARTS).any(|part| e.part(part) != num_traits::Zero::zero())
        };
        if let Some(row) = (0..C).find(begins_to_bounce) {
            return Err(Cause::ImpactsAccumulate { constraint: row, name: S::NAMES.constraint(row) });
        }
        let is_struck = |row: &usize| {
            S::ROWS[*row] == Row::Unilateral
                && fired != Some(*row)
                && !present[*row]
                && impulses[*row].part(0).abs().is_positive()
                && self.varies(*row, tolerance)[0]
        };
        let Some(other) = (0..C).find(is_struck).map(|row| S::NAMES.constraint(row)) else { return Ok(()) };
        Err(match fired {
            Some(fired) => Cause::SwitchesCoincide { name: S::NAMES.constraint(fired), other },
            None => Cause::SwitchesCoincide { name: other, other: Name::NONE },
        })
    }

    /// Why a change of regime without an impact has no derivatives: a contact `bears` from now on whose guard
    /// has not fired. Its gap is nothing but roundings, at the top of one of the infinitely many bounces that
    /// it would have.
    #[cold]
    pub(super) fn closed_by_chance(
        &self,
        fired: Option<usize>,
        bears: impl Fn(usize) -> bool,
    ) -> Result<(), Cause> {
        match (0..C).find(|&row| fired != Some(row) && bears(row)) {
            Some(row) => Err(Cause::ImpactsAccumulate { constraint: row, name: S::NAMES.constraint(row) }),
            None => Ok(()),
        }
    }

    /// Why a motion that begins with this choice has no derivatives: a contact that bears nothing touches,
    /// and its gap or its rate varies. Varied motions open it or press on it.
    #[cold]
    pub(super) fn touched_by_chance(
        &self,
        choice: &Choice<S::Scalar, N, C, W>,
        tolerance: S::Scalar,
    ) -> Result<(), Cause> {
        let bears_nothing = |row: usize| {
            let least = rounding::<S::Scalar>() * self.borne(row, &choice.sizes.forces);
            S::ROWS[row] == Row::Unilateral
                && choice.regime.active[row]
                && !above(choice.multipliers[row].part(0), least.part(0))
        };
        match (0..C).find(|&row| bears_nothing(row) && self.varies(row, tolerance).contains(&true)) {
            Some(switch) => Err(Cause::Grazes { switch, name: S::NAMES.constraint(switch) }),
            None => Ok(()),
        }
    }

    /// Whether a gap and its rate vary, by more than this tolerance.
    fn varies(&self, row: usize, tolerance: S::Scalar) -> [bool; 2] {
        let part = most(tolerance, rounding());
        let rows = &self.laws.rows;
        let varies = |value: S::Scalar, numbers: &[S::Scalar; N]| {
            (1..S::Scalar::PARTS).any(|slope| {
                let terms = self.gradients[row].iter().zip(numbers);
                let size = terms.fold(num_traits::Zero::zero(), |size: S::Scalar, (&entry, number)| {
                    size + (entry.part(0) * number.part(slope)).abs()
                });
                above(value.part(slope).abs(), part * size)
            })
        };
        [varies(rows.positions[row], &self.state.q), varies(rows.rates[row], &self.state.v)]
    }
}

/// The rate of a guard along the motion: its derivative in the direction of velocities and accelerations. The
/// contribution of parameters that have derivatives in that direction is subtracted.
fn rate<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    guards: &Guards<'_, S, N, K, C, W>,
    guard: Guard,
    state: &State<S::Scalar, N>,
    a: &[S::Scalar; N],
) -> S::Scalar
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    let one: S::Scalar = num_traits::One::one();
    let along = |pace: S::Scalar| {
        let pace = pace * S::Scalar::infinitesimal(0);
        let moved = |x: S::Scalar, rate: S::Scalar| x.part(0) + pace * rate.part(0);
        let state = State {
            t: moved(state.t, one),
            q: array(|i| moved(state.q[i], state.v[i])),
            v: array(|i| moved(state.v[i], a[i])),
        };
        guards.varying(guard, &state).part(1)
    };
    let still = along(num_traits::Zero::zero());
    let first = along(one) - still;
    // The direction is so long that the subtracted part is not larger.
    let least = S::Scalar::epsilon() * still.abs();
    let pace = still.abs() / most(first.abs(), least);
    if above(pace, one) { (along(pace) - still) / pace } else { first }
}
