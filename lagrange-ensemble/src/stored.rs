//! [`StoredStudy`]: a study in a folder, which goes on after a kill and is shared by several jobs.

use std::cell::Cell;
use std::path::PathBuf;
use std::sync::Mutex;

use rayon::prelude::*;

use crate::block::Block;
use crate::chance::scattered;
use crate::error::Error;
use crate::progress::Progress;
use crate::record::Record;
use crate::row::Row;
use crate::store::{Store, Writer};
use crate::study::Study;
use crate::table::Table;
use crate::work::{self, Dispatch, InOrder};

/// A study whose parts are files of a folder: `NAME.json`, the manifest, and `NAME.parts/`.
///
/// A part is there whole or not at all, so a run may be killed at any moment. The next run of the same study
/// reads the parts that are there, computes one motion of each again, and goes on. Where the power failed,
/// parts of the last seconds may be damaged: they carry a checksum, and are computed again. Parts may be
/// deleted when the table has been written.
#[derive(Clone, Debug)]
pub struct StoredStudy<F, T> {
    study: Study<F, T>,
    folder: PathBuf,
    /// This job computes the parts `k`, `k + n`, `k + 2 n`, ….
    job: (u64, u64),
}

impl<F, T> StoredStudy<F, T>
where
    F: Row<T>,
    T: Record,
{
    pub(crate) fn new(study: Study<F, T>, folder: PathBuf) -> Self {
        Self { study, folder, job: (0, 1) }
    }

    /// Only the `k`-th of `n` shares of the study, counted from 1: for array jobs that see the same folder.
    /// Whoever finishes last has the table, which has the same bytes as that of a single run.
    ///
    /// # Errors
    /// [`Error::InvalidPart`] unless 1 ≤ `k` ≤ `n`.
    pub fn part(mut self, k: u64, n: u64) -> Result<Self, Error> {
        if k == 0 || k > n {
            return Err(Error::InvalidPart { part: k, of: n });
        }
        self.job = (k - 1, n);
        Ok(self)
    }

    /// Computes what is missing. The table if the study is complete, else `None`: other jobs are at work.
    ///
    /// # Errors
    /// [`Error::Io`] for a full disk or missing permission, [`Error::Panicked`] with the index: finished
    /// parts stay. [`Error::AnotherStudy`], [`Error::AnotherVersion`], [`Error::NotTheSame`] if the folder
    /// holds something else; [`Error::Damaged`] if its manifest cannot be read. [`Error::InvalidName`],
    /// [`Error::InvalidColumns`], [`Error::NotInLanes`], [`Error::Threads`].
    pub fn run(&self) -> Result<Option<Table<T>>, Error> {
        let open = self.open()?;
        let missing = open.missing.clone();
        let count: u64 = open.share().map(|part| open.store.parts.part(part).1).sum();
        let left: u64 = missing.iter().map(|part| open.store.parts.part(*part).1).sum();
        let progress = Progress::new(self.study.name(), count, count - left, self.study.shown);
        let verdict = open.compute(&InOrder::new(missing.into_iter()), &progress);
        progress.end();
        verdict?;
        open.table()
    }

    /// Opens the folder, and looks through the parts that are there: for clusters, which share the work in
    /// another way than [`StoredStudy::run`].
    ///
    /// # Errors
    /// As [`StoredStudy::run`].
    pub fn open(&self) -> Result<OpenStudy<'_, F, T>, Error> {
        let store = self.study.store(&self.folder)?;
        let mut open = OpenStudy { study: &self.study, store, job: self.job, missing: Vec::new() };
        open.missing = open.look()?;
        Ok(open)
    }

    /// The same without a look at the parts, for a process beside one that has looked.
    pub fn open_without_look(&self) -> Result<OpenStudy<'_, F, T>, Error> {
        let store = self.study.store(&self.folder)?;
        Ok(OpenStudy { study: &self.study, store, job: self.job, missing: Vec::new() })
    }

    /// The number of motions.
    pub fn count(&self) -> u64 {
        self.study.count()
    }

    /// Progress without a bar, for ranks other than the first.
    pub fn silent(&self) -> Progress {
        Progress::new(self.study.name(), self.study.count(), 0, false)
    }

    /// A bar for this study, of which `done` motions need not be computed.
    pub fn progress(&self, done: u64) -> Progress {
        Progress::new(self.study.name(), self.study.count(), done, self.study.shown)
    }
}

/// A study whose folder is open.
#[derive(Debug)]
pub struct OpenStudy<'a, F, T> {
    study: &'a Study<F, T>,
    store: Store,
    job: (u64, u64),
    missing: Vec<u64>,
}

impl<F, T> OpenStudy<'_, F, T>
where
    F: Row<T>,
    T: Record,
{
    /// The numbers of parts that were missing, or damaged, when the folder was opened.
    pub fn missing(&self) -> &[u64] {
        &self.missing
    }

    /// The number of motions of a part.
    pub fn motions(&self, part: u64) -> u64 {
        self.store.parts.part(part).1
    }

    /// Computes the parts that `dispatch` names and writes them.
    ///
    /// # Errors
    /// As [`StoredStudy::run`].
    pub fn compute(&self, dispatch: &dyn Dispatch, progress: &Progress) -> Result<(), Error> {
        let Self { study, store, .. } = self;
        let motions = |first, count, at: &Cell<u64>, block: &mut Block| {
            study.append(&store.layout, first, count, at, block)
        };
        let mut writer = Writer::new(store);
        work::compute(
            (&study.pool()?, study.at_once()),
            store.parts,
            dispatch,
            &motions,
            progress,
            |block| writer.write(block),
        )?;
        writer.end()
    }

    /// The table, if all parts are there.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn table(&self) -> Result<Option<Table<T>>, Error> {
        Ok(self.store.is_complete()?.then(|| Table::in_folder(self.store.clone())))
    }

    /// The parts of this job.
    fn share(&self) -> impl Iterator<Item = u64> + use<F, T> {
        let (first, step) = self.job;
        let mut next = Some(first);
        let number = self.store.parts.number();
        std::iter::from_fn(move || {
            let part = next.filter(|part| *part < number)?;
            next = part.checked_add(step);
            Some(part)
        })
    }

    /// The parts of this job that are not there. Those that are must be of this study, and a motion of each,
    /// computed again, must have the same result. A damaged part is missing.
    fn look(&self) -> Result<Vec<u64>, Error> {
        let shares: Vec<u64> = self.share().collect();
        let missing = Mutex::new(Vec::new());
        self.study.pool()?.install(|| {
            shares.par_iter().try_for_each(|part| match self.is_there(*part)? {
                true => Ok(()),
                false => {
                    work::locked(&missing).push(*part);
                    Ok(())
                }
            })
        })?;
        let mut missing = missing.into_inner().unwrap_or_default();
        missing.sort_unstable();
        Ok(missing)
    }

    fn is_there(&self, part: u64) -> Result<bool, Error> {
        let Self { study, store, .. } = self;
        let block = match store.read(part) {
            Err(Error::Damaged { .. }) | Ok(None) => return Ok(false),
            block => block?,
        };
        let Some(block) = block else { return Ok(false) };
        let (first, count) = store.parts.part(part);
        // An arbitrary motion, another one in each part.
        let index = first + scattered(part) % count.max(1);
        let mut again = Block::default();
        work::guarded(|at| study.append(&store.layout, index, 1, at, &mut again))?;
        let start = (index - first) as usize * store.layout.row();
        let found = block.failures.binary_search_by_key(&index, |(failed, _)| *failed);
        let found = found.ok().and_then(|place| block.failures.get(place));
        if block.rows.get(start..start + again.rows.len()) != Some(&again.rows)
            || found != again.failures.first()
        {
            return Err(Error::NotTheSame { path: store.path(part), index });
        }
        Ok(true)
    }
}
