//! Computing the parts of a study by threads.
//!
//! A thread takes the next few motions of the part that is open, and opens the next part when all of one are
//! taken. So no thread waits for another, as many parts as threads are open at most, and the last thread that
//! works on a part hands it on. Which thread does what is left to chance; a motion is a function of its
//! index, so the parts do not show it.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::sync_channel;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;

use rayon::ThreadPool;

use crate::block::Block;
use crate::error::Error;
use crate::progress::Progress;

/// A source of part numbers: a loop over all parts, or the first rank of a cluster.
pub trait Dispatch: Sync {
    /// The number of a part that nobody else computes, or `None` when there is nothing left to begin.
    fn next(&self) -> Option<u64>;

    /// A part is finished and, in a folder, written.
    fn done(&self, part: u64);
}

/// Given parts, in order.
pub(crate) struct InOrder<I>(Mutex<I>);

impl<I: Iterator<Item = u64>> InOrder<I> {
    pub(crate) fn new(parts: I) -> Self {
        Self(Mutex::new(parts))
    }
}

impl<I: Iterator<Item = u64> + Send> Dispatch for InOrder<I> {
    fn next(&self) -> Option<u64> {
        locked(&self.0).next()
    }

    fn done(&self, _: u64) {}
}

/// How the motions of a study are cut into parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Parts {
    pub(crate) count: u64,
    pub(crate) size: u64,
}

impl Parts {
    pub(crate) fn number(self) -> u64 {
        self.count.div_ceil(self.size)
    }

    /// The first motion of a part, and how many it has.
    pub(crate) fn part(self, number: u64) -> (u64, u64) {
        let first = number * self.size;
        (first, self.size.min(self.count.saturating_sub(first)))
    }
}

/// Appends the rows of so many consecutive indices. The cell is told which one a function of the user works
/// on.
pub(crate) type Motions<'a> = &'a (dyn Fn(u64, u64, &Cell<u64>, &mut Block) + Sync);

/// A part that threads work on.
struct Open {
    number: u64,
    first: u64,
    count: u64,
    taken: u64,
    /// The finished pieces, in the order in which they were finished.
    pieces: Vec<Block>,
}

/// A few consecutive motions of a part.
struct Piece {
    part: Arc<Mutex<Open>>,
    first: u64,
    count: u64,
}

struct Work<'a> {
    parts: Parts,
    /// Motions that a thread takes at a time.
    grain: u64,
    dispatch: &'a dyn Dispatch,
    motions: Motions<'a>,
    progress: &'a Progress,
    current: Mutex<Option<Arc<Mutex<Open>>>>,
    stopped: AtomicBool,
    panic: Mutex<Option<Error>>,
}

/// Computes parts and hands them to `sink`, in the order in which they are finished. A thread takes `at_once`
/// motions at least, if a part has so many.
pub(crate) fn compute(
    (pool, at_once): (&ThreadPool, u64),
    parts: Parts,
    dispatch: &dyn Dispatch,
    motions: Motions<'_>,
    progress: &Progress,
    mut sink: impl FnMut(Block) -> Result<(), Error> + Send,
) -> Result<(), Error> {
    let threads = pool.current_num_threads();
    let grain = (parts.size / (4 * threads as u64)).clamp(1, 256).max(at_once.min(parts.size));
    let work = Work {
        parts,
        grain,
        dispatch,
        motions,
        progress,
        current: Mutex::new(None),
        stopped: AtomicBool::new(false),
        panic: Mutex::new(None),
    };
    // A thread of its own waits for the disk, so that the others need not.
    let (send, receive) = sync_channel::<Block>(threads);
    let written = thread::scope(|scope| {
        let work = &work;
        let writer = scope.spawn(move || {
            let mut verdict = Ok(());
            for block in receive {
                let number = block.number;
                if verdict.is_ok() {
                    verdict = sink(block).inspect(|()| work.dispatch.done(number));
                    work.stopped.fetch_or(verdict.is_err(), Ordering::Relaxed);
                }
            }
            verdict
        });
        pool.scope(|scope| {
            for _ in 0..threads {
                let send = send.clone();
                scope.spawn(move |_| {
                    while let Some(piece) = work.take() {
                        if let Some(block) = work.finish(piece) {
                            // The writer ends after the last sender.
                            let _ = send.send(block);
                        }
                    }
                });
            }
        });
        drop(send);
        writer.join()
    });
    if let Some(error) = locked(&work.panic).take() {
        return Err(error);
    }
    written.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}

impl Work<'_> {
    /// The next motions, of the open part or of a new one.
    fn take(&self) -> Option<Piece> {
        let mut current = locked(&self.current);
        loop {
            if self.stopped.load(Ordering::Relaxed) {
                return None;
            }
            if let Some(part) = &*current {
                let mut open = locked(part);
                if open.taken < open.count {
                    let (first, count) = (open.first + open.taken, self.grain.min(open.count - open.taken));
                    open.taken += count;
                    drop(open);
                    return Some(Piece { part: Arc::clone(part), first, count });
                }
            }
            let number = self.dispatch.next()?;
            let (first, count) = self.parts.part(number);
            *current =
                Some(Arc::new(Mutex::new(Open { number, first, count, taken: 0, pieces: Vec::new() })));
        }
    }

    /// Computes the motions of a piece. Returns the part if they were its last.
    fn finish(&self, piece: Piece) -> Option<Block> {
        let mut done = Block::default();
        if let Err(error) = guarded(|at| (self.motions)(piece.first, piece.count, at, &mut done)) {
            self.stopped.store(true, Ordering::Relaxed);
            locked(&self.panic).get_or_insert(error);
            return None;
        }
        self.progress.add(piece.count);
        let mut open = locked(&piece.part);
        open.pieces.push(done);
        let pieces = open.count.div_ceil(self.grain);
        if (open.pieces.len() as u64) < pieces {
            return None;
        }
        let mut pieces = std::mem::take(&mut open.pieces);
        pieces.sort_by_key(|piece| piece.first);
        let rows = pieces.iter().map(|piece| &piece.rows[..]).collect::<Vec<_>>().concat();
        let failures = pieces.into_iter().flat_map(|piece| piece.failures).collect();
        Some(Block { number: open.number, first: open.first, rows, failures })
    }
}

/// The result of functions of the user; the panic of one becomes an error. The cell holds the index.
pub(crate) fn guarded<T>(function: impl FnOnce(&Cell<u64>) -> T) -> Result<T, Error> {
    let at = Cell::new(0);
    catch_unwind(AssertUnwindSafe(|| function(&at)))
        .map_err(|panic| Error::Panicked { index: at.get(), message: words(panic.as_ref()) })
}

/// No value behind these locks is left half changed by a panic.
pub(crate) fn locked<T: ?Sized>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The words of a panic.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(ToString::to_string);
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "a value".to_owned())
}
