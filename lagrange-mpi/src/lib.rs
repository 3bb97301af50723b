//! The studies of `lagrange-ensemble` on a cluster: `mpirun -n 64 target/release/my_study`.
//!
//! A program runs the same study as it would on a laptop, in a folder that all machines see, by
//! [`run`] instead of [`StoredStudy::run`]:
//!
//! ```no_run
//! # use lagrange_ensemble::Study;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let study = Study::new("squares", 1_000_000, |index| Ok((index * index) as f64)).with_progress();
//! if let Some(table) = lagrange_mpi::run(&study.in_folder("results"))? {
//!     table.write("results/squares.npy")?; // on the first rank alone
//! }
//! # Ok(())
//! # }
//! ```
//!
//! * The first rank looks through the folder, writes the manifest and shows the progress of all. Every rank,
//!   the first one too, takes the next part when it has finished one, and writes its parts itself. Only
//!   numbers of parts travel between ranks.
//! * A rank has as many threads as the study says, by default one for each core that it may use. Where there
//!   is a rank for each core, `with_threads(1)` gives it one.
//! * The table has the same bytes for any number of ranks, and as `StoredStudy::run` leaves it.
//! * A rank that dies loses the parts it works on. Open MPI then ends the other ranks, too, which lose
//!   theirs; with `mpirun --enable-recovery` they need not. What is finished stays in any case, and the same
//!   command goes on from there.
#![forbid(unsafe_code)]

use std::collections::VecDeque;
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use lagrange_ensemble::{Dispatch, Error as StudyError, Record, Row, StoredStudy, Table};
use mpi::Threading;
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Destination, Root, Source};

/// How long a rank rests between looks for messages: far less than a part takes, and the core is free for
/// motions.
const REST: Duration = Duration::from_micros(200);

/// Messages to the first rank: a wish for a part, and the number of a finished part.
const WISH: i32 = 1;
const DONE: i32 = 2;
/// A message from the first rank: the number of a part.
const PART: i32 = 3;
/// A message of a rank that computes nothing any more.
const END: i32 = 4;

/// Stands for the number of a part where none is left.
const NONE: u64 = u64::MAX;

/// Why a study on a cluster stopped. Parts that are finished stay.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// MPI could not be started, or was started before.
    NoMpi,
    /// The study stopped on this rank.
    Study(StudyError),
    /// The study stopped on other ranks, which say why.
    OtherRanks,
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoMpi => out.write_str("MPI cannot be started here, or was started before: call `run_on`"),
            Self::Study(_) => out.write_str("the study stopped on this rank"),
            Self::OtherRanks => out.write_str("the study stopped on another rank, which says why"),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Study(error) => Some(error),
            Self::NoMpi | Self::OtherRanks => None,
        }
    }
}

impl From<StudyError> for Error {
    fn from(error: StudyError) -> Self {
        Self::Study(error)
    }
}

/// Starts MPI, computes what is missing on all ranks, and ends MPI. The table, on the first rank.
///
/// # Errors
/// [`Error::NoMpi`]; as [`StoredStudy::run`] on the rank that fails, and [`Error::OtherRanks`] on others.
pub fn run<F, T>(study: &StoredStudy<F, T>) -> Result<Option<Table<T>>, Error>
where
    F: Row<T>,
    T: Record,
{
    // One thread of a rank talks to the others.
    let (universe, threading) = mpi::initialize_with_threading(Threading::Funneled).ok_or(Error::NoMpi)?;
    if threading < Threading::Funneled {
        return Err(Error::NoMpi);
    }
    run_on(&universe.world(), study)
}

/// The same in a program that has started MPI itself, with [`Threading::Funneled`] at least. All ranks call
/// it, from the thread that started MPI.
///
/// # Errors
/// As [`run`].
pub fn run_on<F, T>(world: &SimpleCommunicator, study: &StoredStudy<F, T>) -> Result<Option<Table<T>>, Error>
where
    F: Row<T>,
    T: Record,
{
    let first = world.rank() == 0;
    // The first rank alone writes the manifest and looks through the parts. The others wait for its word.
    let opened = if first { Some(study.open()) } else { None };
    let mut opens = opened.as_ref().is_none_or(Result::is_ok);
    world.process_at_rank(0).broadcast_into(&mut opens);
    let open = match opened {
        Some(open) => open?,
        None if opens => study.open_without_look()?,
        None => return Err(Error::OtherRanks),
    };
    let mut missing = VecDeque::from(open.missing().to_vec());
    let left: u64 = missing.iter().map(|part| open.motions(*part)).sum();
    let progress = study.progress(study.count().saturating_sub(left));
    let desk = Desk::default();
    let others = usize::try_from(world.size()).unwrap_or(1).saturating_sub(1);
    let verdict = thread::scope(|scope| {
        let worker = scope.spawn(|| {
            let verdict = open.compute(&desk, &study.silent());
            desk.over.store(true, Ordering::Release);
            verdict
        });
        let finished = |parts: Vec<u64>| parts.iter().for_each(|part| progress.add(open.motions(*part)));
        if first {
            serve(world, &desk, &mut missing, others, finished);
        } else {
            fetch(world, &desk);
        }
        worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    });
    progress.end();
    let fails = verdict.is_err();
    let mut failed = vec![false; others + 1];
    world.all_gather_into(&fails, &mut failed[..]);
    verdict?;
    if failed.contains(&true) {
        return Err(Error::OtherRanks);
    }
    if first { Ok(open.table()?) } else { Ok(None) }
}

/// The desk of a rank, where the threads that compute meet the thread that talks to other ranks.
#[derive(Default)]
struct Desk {
    state: Mutex<State>,
    changed: Condvar,
    /// Nothing is computed on this rank any more.
    over: AtomicBool,
}

#[derive(Default)]
struct State {
    /// Parts that nobody has begun.
    parts: VecDeque<u64>,
    /// Threads that wait for one.
    waiting: usize,
    /// There are none left anywhere.
    exhausted: bool,
    done: Vec<u64>,
}

impl Desk {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Puts a part on the desk, or the news that there is none.
    fn put(&self, part: Option<u64>) {
        let mut state = self.state();
        match part {
            Some(part) => state.parts.push_back(part),
            None => state.exhausted = true,
        }
        self.changed.notify_all();
    }

    /// Whether this rank should ask for a part. One is kept ready, so that nobody waits for an answer.
    fn wishes(&self) -> bool {
        let state = self.state();
        !state.exhausted && state.parts.len() <= state.waiting
    }

    fn finished(&self) -> Vec<u64> {
        std::mem::take(&mut self.state().done)
    }
}

impl Dispatch for Desk {
    fn next(&self) -> Option<u64> {
        let mut state = self.state();
        loop {
            if let Some(part) = state.parts.pop_front() {
                return Some(part);
            }
            if state.exhausted {
                return None;
            }
            state.waiting += 1;
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
            state.waiting -= 1;
        }
    }

    fn done(&self, part: u64) {
        self.state().done.push(part);
    }
}

/// The first rank: hands out parts to itself and to others until nobody computes any more.
fn serve(
    world: &SimpleCommunicator,
    desk: &Desk,
    missing: &mut VecDeque<u64>,
    mut others: usize,
    finished: impl Fn(Vec<u64>),
) {
    loop {
        // This is read before the parts, so that what is done before the end is counted.
        let over = desk.over.load(Ordering::Acquire);
        finished(desk.finished());
        while desk.wishes() {
            desk.put(missing.pop_front());
        }
        let mut quiet = true;
        while let Some(status) = world.any_process().immediate_probe() {
            quiet = false;
            let rank = world.process_at_rank(status.source_rank());
            let (number, status) = rank.receive_with_tag::<u64>(status.tag());
            match status.tag() {
                WISH => rank.send_with_tag(&missing.pop_front().unwrap_or(NONE), PART),
                DONE => finished(vec![number]),
                _ => others = others.saturating_sub(1),
            }
        }
        if over && others == 0 {
            return;
        }
        if quiet {
            thread::sleep(REST);
        }
    }
}

/// The other ranks: fetch parts from the first one.
fn fetch(world: &SimpleCommunicator, desk: &Desk) {
    let first = world.process_at_rank(0);
    let mut asked = false;
    loop {
        let over = desk.over.load(Ordering::Acquire);
        for part in desk.finished() {
            first.send_with_tag(&part, DONE);
        }
        if !over && !asked && desk.wishes() {
            first.send_with_tag(&0_u64, WISH);
            asked = true;
        }
        if asked && first.immediate_probe_with_tag(PART).is_some() {
            let (part, _) = first.receive_with_tag::<u64>(PART);
            asked = false;
            desk.put(Some(part).filter(|part| *part != NONE));
            continue;
        }
        // An answer on its way must arrive: the next study must not get it.
        if over && !asked {
            first.send_with_tag(&0_u64, END);
            return;
        }
        thread::sleep(REST);
    }
}
