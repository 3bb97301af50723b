//! The memory of a motion whose equations switch.

use core::fmt;

use super::ended::Ended;
use super::guards::Guard;
use super::scales::Scales;
use super::way::{Way, is_beyond_rounding};
use super::{Regime, Row};
use crate::integrator::jets::JetsMemory;
use crate::number::elements::array;
use crate::number::real::{Ordered, Real};
use crate::system::error::Cause;
use crate::system::method::Steps;
use crate::system::state::State;

/// The memory of [`Hybrid`](super::Hybrid) between steps. `I` is the system of a regime, `X` its constants,
/// and `J` the memory of the method that runs in it.
#[derive(Clone, Copy)]
pub struct HybridMemory<I, X, J, R, const N: usize, const C: usize, const W: usize> {
    /// The regime of the last piece and of the knowledge in `inner`.
    pub(super) regime: Regime<R, C, W>,
    pub(super) in_regime: I,
    pub(super) constants: X,
    pub(super) inner: J,
    /// The last piece.
    pub(super) start: State<R, N>,
    pub(super) end: State<R, N>,
    /// The regime and the state that follow the piece; `None` where it ended without an event. The state may
    /// be a little later than the end of the piece.
    pub(super) next: Option<(Regime<R, C, W>, State<R, N>)>,
    /// Whether the piece ended where its guards are known no further: then the regime stays.
    pub(super) is_cut: bool,
    /// The impulses of the change of regime that follows the piece, zero where it is no impact.
    pub(super) impulses: [R; C],
    /// The impulses of the last changes of regime before the piece, all at one time, and that time.
    pub(super) begun_by: [R; C],
    pub(super) begun_at: R,
    /// The time of the last change. A slip in two directions that comes to rest does so after the piece, and
    /// one that begins is followed from a little later on.
    pub(super) switched: R,
    /// The time of the last change of regime that has been told; `None` before the first.
    pub(super) told: Option<R>,
    /// Whether a step ends at a change of regime even where no time has passed.
    pub(super) tells: bool,
    /// The way from the piece to the state in `next`.
    pub(super) way: Way<R, N>,
    /// Whether the piece is such a way, which no method has taken.
    pub(super) is_way: bool,
    /// The contacts that bear since the last change of regime because the motion has landed and they touch.
    pub(super) landed: [bool; C],
    /// Whether the motion has to find its regime first.
    pub(super) is_fresh: bool,
    /// Why it cannot go on; `None` if it can.
    pub(super) stuck: Option<Cause>,
    /// The guard that ended the piece before, which is zero where the next one starts.
    pub(super) fired: Option<Guard>,
    /// The frictions in one direction whose slips begin there, from zero, and the contacts that open there.
    pub(super) begins: [bool; C],
    pub(super) scales: Scales<R, C>,
    /// Changes of the side of each kink since time has last passed, beyond rounding.
    pub(super) flips: [usize; W],
    /// Changes of the regime since then.
    pub(super) changes: usize,
    /// Contacts that have opened since then, or since an impact, and frictions that have let go.
    pub(super) opened: [bool; C],
    /// Regimes that have ended since then, or since an impact, in which no time has passed.
    pub(super) ended: Ended<C>,
    /// The costs of the regimes before.
    pub(super) counts: Steps,
}

/// The way to a regime, the contacts that bear since it, its time, and its impulses.
type Notes<R, const N: usize, const C: usize> = (Way<R, N>, [bool; C], R, [R; C]);

impl<I, X, J, R: Real, const N: usize, const C: usize, const W: usize> HybridMemory<I, X, J, R, N, C, W> {
    /// Whether `t` lies in the piece, ends included.
    pub(super) fn covers(&self, t: R) -> bool {
        let (back, ahead) = (t - self.start.t, self.end.t - t);
        let is_ahead = |x: R| x.is_positive() || x == R::zero();
        is_ahead(back) && is_ahead(ahead) || is_ahead(-back) && is_ahead(-ahead)
    }

    /// The state after the piece.
    pub(super) fn after(&self) -> State<R, N> {
        self.next.map_or(self.end, |(_, state)| state)
    }

    /// The state at a time on the way to the next regime.
    pub(super) fn on_way(&self, t: R) -> State<R, N> {
        self.way.at(t, &self.after())
    }

    /// Makes the way from the end of a piece to the state that follows it a piece of its own. Returns false,
    /// and changes no state, if both have the same time.
    pub(super) fn go_on_way(&mut self) -> bool {
        let from = self.end.t;
        self.is_way = self.after().t != from;
        if self.is_way {
            (self.start, self.end) = (self.on_way(from), self.after());
        }
        self.is_way
    }

    /// The state before the change of regime that ends the piece, and the state at the time of the change,
    /// after it; `None` if no change ends the piece.
    pub(super) fn switch(&self) -> Option<(State<R, N>, State<R, N>)> {
        self.next.filter(|_| !self.is_cut).map(|_| (self.end, self.switched()))
    }

    /// The state at the time of the last change of regime, after it.
    fn switched(&self) -> State<R, N> {
        if self.after().t == self.switched { self.after() } else { self.on_way(self.switched) }
    }

    /// The state at time `t` if the regime changes there or the next piece begins there: the one after the
    /// change. `None` at other times.
    pub(super) fn beside(&self, t: R) -> Option<State<R, N>> {
        let after = self.after();
        if t == after.t {
            return Some(after);
        }
        (t == self.switched && self.next.is_some()).then(|| self.switched())
    }

    /// What the search for a regime notes beside it, to be taken back where the regime is not entered.
    pub(super) fn notes(&self) -> Notes<R, N, C> {
        (self.way, self.landed, self.switched, self.impulses)
    }

    pub(super) fn take_back(&mut self, notes: Notes<R, N, C>) {
        (self.way, self.landed, self.switched, self.impulses) = notes;
    }

    /// Forgets the changes of regime before time has passed.
    pub(super) fn forget_changes(&mut self) {
        (self.flips, self.changes, self.opened) = ([0; W], 0, [false; C]);
        self.ended = Ended::none();
    }

    /// Whether more time has passed between two times than rounding hides. If so, the changes of regime
    /// before it are forgotten.
    pub(super) fn passes(&mut self, from: R, to: R) -> bool
    where
        R: Ordered,
    {
        let has_passed = is_beyond_rounding(from, to);
        if has_passed {
            self.forget_changes();
        }
        has_passed
    }

    /// Notes the end of the regime of the piece where a row has `fired`, if it has begun at this time. At a
    /// kink another regime begins.
    pub(super) fn note_end(&mut self, rows: &[Row; C], fired: Option<usize>) {
        if fired.is_none() {
            self.ended = Ended::none();
        } else if self.changes > 1 {
            self.ended.note(rows, &self.regime);
        }
    }

    /// Notes the contacts that have opened from one regime to the next where a row has `fired`, and the
    /// frictions whose slips begin, unless that was an impact.
    pub(super) fn note_ends(
        &mut self,
        rows: &[Row; C],
        [before, after]: [&Regime<R, C, W>; 2],
        fired: Option<usize>,
    ) {
        let is_impact = self.impulses != [R::zero(); C];
        if is_impact {
            self.ended = Ended::none();
        }
        for (row, (begins, kind)) in self.begins.iter_mut().zip(rows).enumerate() {
            let holds = |regime: &Regime<R, C, W>| regime.active.get(row) == Some(&true);
            let may_begin = match kind {
                Row::Friction { pair, .. } => pair.is_none() && (holds(before) || fired == Some(row)),
                Row::Unilateral => holds(before),
                Row::Bilateral | Row::Load => false,
            };
            *begins = !is_impact && may_begin && !holds(after);
        }
        for (row, (opened, kind)) in self.opened.iter_mut().zip(rows).enumerate() {
            let bears = |regime: &Regime<R, C, W>| regime.active.get(row) == Some(&true);
            *opened |= *kind == Row::Unilateral && bears(before) && !bears(after);
            *opened &= !is_impact;
        }
    }

    /// Which contacts are closed and which frictions stick or slip after the piece.
    pub fn regime(&self) -> &Regime<R, C, W> {
        self.next.as_ref().map_or(&self.regime, |(regime, _)| regime)
    }

    /// Which of them do so at time `t` in or after the piece, and the impulses of the last changes of regime
    /// up to then.
    pub(super) fn at(&self, t: R) -> (&Regime<R, C, W>, [R; C])
    where
        R: Ordered,
    {
        match &self.next {
            Some((regime, _)) if self.is_way || self.beside(t).is_some() => (regime, self.ended_by()),
            _ => (&self.regime, self.begun_by),
        }
    }

    /// The impulses of the change of regime after the piece, with those of the changes before it at the same
    /// time: an impact may leave a contact closed that then opens.
    pub(super) fn ended_by(&self) -> [R; C]
    where
        R: Ordered,
    {
        if !self.is_change() {
            self.begun_by
        } else if is_beyond_rounding(self.begun_at, self.switched) {
            self.impulses
        } else {
            array(|row| self.begun_by[row] + self.impulses[row])
        }
    }

    /// Whether the regime changes after the piece. It is found anew where a motion goes on with other inputs.
    fn is_change(&self) -> bool {
        !self.is_cut && (!self.is_fresh || self.impulses != [R::zero(); C])
    }

    /// Takes the change of regime after the piece for the one before the next.
    pub(super) fn take_impulses(&mut self)
    where
        R: Ordered,
    {
        let begun_at = if self.is_change() { self.switched } else { self.begun_at };
        (self.begun_by, self.begun_at) = (self.ended_by(), begun_at);
        self.impulses = [R::zero(); C];
    }
}

impl<I, X, C, T, R, const N: usize, const M: usize, const W: usize, const P: usize>
    HybridMemory<I, X, JetsMemory<C, T, R, N, P>, R, N, M, W>
where
    C: Copy,
    T: Copy + Default,
    R: Ordered,
{
    /// Counts time from another instant on.
    pub(super) fn count_from(&mut self, instant: R) {
        self.start.t -= instant;
        self.end.t -= instant;
        self.switched -= instant;
        self.begun_at -= instant;
        if let Some((_, state)) = &mut self.next {
            state.t -= instant;
        }
        self.inner.count_from(instant);
    }
}

impl<I, X, J, R, const N: usize, const C: usize, const W: usize> fmt::Debug
    for HybridMemory<I, X, J, R, N, C, W>
where
    I: fmt::Debug,
    J: fmt::Debug,
    R: fmt::Debug,
{
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("HybridMemory")
            .field("regime", &self.regime)
            .field("in_regime", &self.in_regime)
            .field("inner", &self.inner)
            .field("start", &self.start)
            .field("end", &self.end)
            .field("next", &self.next)
            .finish_non_exhaustive()
    }
}
