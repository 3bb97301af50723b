//! The present contacts of a motion, and its changes of regime one by one.

use super::{Hybrid, Row, Switching};
use crate::motion::simulation::Simulation;
use crate::number::elements::array;
use crate::number::real::Ordered;
use crate::system::control::Held;
use crate::system::error::MotionError;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The present activity of a constraint, contact or friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// A constraint that always holds.
    Holds,
    /// A contact that has a gap, is about to lift off, or merely touches beside others that hold the motion.
    Open,
    /// A contact that is closed.
    Closed,
    /// Friction that holds.
    Sticks,
    /// Friction that slips.
    Slips,
    /// Friction of a contact that is open, or friction whose limit is zero and stays zero.
    Idle,
}

/// Names of the rows of a system, one value each.
pub trait NamedRows<const C: usize> {
    /// A struct with a field for each constraint, contact and friction.
    type Rows<T>: From<[T; C]>;
}

/// A change of the regime: an impact, a contact that closes or opens, friction that sticks or slips, a kink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch<R, const N: usize> {
    /// The state before it: in an impact, that with the velocities at which bodies meet.
    pub before: State<R, N>,
    /// The state after it, at the same time. Where a slip in two directions comes to rest, it is a little
    /// later than `before`, which is then the last state of the slip that a step has reached.
    pub state: State<R, N>,
}

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize>
    Simulation<'_, S, Held<S::Scalar, K>, Hybrid<M, C, W>, N, K>
where
    S: Switching<N, K, C, W> + NamedRows<C>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// The activity of each contact, friction and constraint, by name: `motion.contacts().floor`.
    ///
    /// It belongs to the present state: where the regime changes there, to the state after the change. It is
    /// known from the first step on.
    pub fn contacts(&self) -> S::Rows<Contact> {
        let (regime, _) = self.memory.at(self.t());
        let is_active = |row: usize| regime.active.get(row).copied().unwrap_or(false);
        let zero = num_traits::Zero::zero();
        let slips = |row: usize| regime.slip.get(row).is_some_and(|&slip| slip != zero);
        array(|row| match S::ROWS[row] {
            Row::Bilateral | Row::Load => Contact::Holds,
            Row::Unilateral if is_active(row) => Contact::Closed,
            Row::Unilateral => Contact::Open,
            Row::Friction { .. } if is_active(row) => Contact::Sticks,
            Row::Friction { pair, .. } if slips(row) || pair.is_some_and(slips) => Contact::Slips,
            Row::Friction { .. } => Contact::Idle,
        })
        .into()
    }

    /// The impulses of the last change of the regime up to the present state, by name:
    /// `motion.impulses().floor`. They have the
    /// directions of the reactions, and are in N s where a reaction is in N. All are zero where it was no
    /// impact. Where infinitely many impacts are taken together, they contain the impulses of the plastic
    /// impact that stands for those that would follow.
    pub fn impulses(&self) -> S::Rows<S::Scalar> {
        self.memory.at(self.t()).1.into()
    }

    /// Moves to the next change of the regime up to time `until` \[s], which is included, and forward in time
    /// alone. Without such a change it moves to `until` and returns `None`. Rounding decides whether a change
    /// at `until` itself is found. If it is not, the next call returns it.
    ///
    /// # Errors
    /// As [`Simulation::advance_to`].
    pub fn advance_to_switch(
        &mut self,
        until: S::Scalar,
    ) -> Result<Option<Switch<S::Scalar, N>>, MotionError<S::Scalar>> {
        self.check(until)?;
        self.begin()?;
        let mut attempts = self.limits.attempts;
        loop {
            if let Some((before, state)) = self.memory.switch()
                && (state.t > self.t() || self.is_here(&before, &state))
                && state.t <= until
            {
                // A piece on the way from a start ends later than the change, and the state before it is the
                // present one.
                let before = if self.memory.is_way { self.state } else { before };
                self.advance_to(state.t)?;
                (self.state, self.memory.told) = (state, Some(state.t));
                return Ok(Some(Switch { before, state }));
            }
            if self.memory.after().t >= until || self.t() >= until {
                self.advance_to(until)?;
                return Ok(None);
            }
            let Self { system, constants, control, limits, memory, .. } = self;
            memory.tells = true;
            let stepped = <Hybrid<M, C, W> as Adaptive<S, Held<S::Scalar, K>, N, K>>::step(
                memory,
                *system,
                constants,
                control,
                limits,
                until,
                &mut attempts,
            );
            self.memory.tells = false;
            stepped?;
        }
    }

    /// Whether a change of the regime lies at the present time and has not been seen: it has not been told,
    /// nor is the present state the one after it.
    fn is_here(&self, before: &State<S::Scalar, N>, after: &State<S::Scalar, N>) -> bool {
        let is_told = self.memory.told == Some(after.t);
        after.t == self.t() && !is_told && (self.state != *after || before == after)
    }
}
