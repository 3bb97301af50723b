//! The knowledge of a state beside its numbers.

use super::ended::Ended;

/// What is known of a state beside its numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known<const C: usize> {
    /// Gaps that count as zero whatever their rounding errors are.
    pub(super) closed: [bool; C],
    /// Whether no other gap is zero. What rounding errors of time change in a gap depends on its rate, and an
    /// impact changes that: a gap that closes faster after it strikes later.
    pub(super) only: bool,
    /// Whether no motion leads here.
    pub(super) alone: bool,
    /// The row whose guard has led here: its gap or its slip velocity is zero.
    pub(super) fired: Option<usize>,
    /// Rows whose rate or slip counts as zero whatever its rounding errors are: the rate of a gap only if the
    /// gap is zero.
    pub(super) rested: [bool; C],
    /// Contacts that have opened at this time, and frictions that have let go. They close and stick again
    /// only where no other regime is possible: without this, two regimes that rounding errors alone tell
    /// apart could follow each other without end.
    pub(super) opened: [bool; C],
    /// Regimes that have ended at this time.
    pub(super) ended: Ended<C>,
    /// Whether impacts are over: the closing velocities that are left are rounding errors.
    pub(super) settled: bool,
}

impl<const C: usize> Known<C> {
    /// These gaps are zero.
    pub(super) fn new(closed: [bool; C]) -> Self {
        Self {
            closed,
            only: false,
            alone: false,
            fired: None,
            rested: [false; C],
            opened: [false; C],
            ended: Ended::none(),
            settled: false,
        }
    }

    /// These gaps are zero, and impacts are over.
    pub(super) fn settled(closed: [bool; C]) -> Self {
        Self { settled: true, ..Self::new(closed) }
    }

    /// Nothing is known but the state: velocities that close a gap of zero are rounding errors.
    pub(super) fn alone() -> Self {
        Self { alone: true, ..Self::settled([false; C]) }
    }

    /// These gaps are zero and no others, and impacts are over.
    pub(super) fn struck(closed: [bool; C]) -> Self {
        Self { only: true, ..Self::settled(closed) }
    }
}
