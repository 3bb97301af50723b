//! [`Study`]: a table whose rows are a function of their index, computed by threads.

use std::cell::Cell;
use std::marker::PhantomData;
use std::path::PathBuf;
use std::sync::Mutex;

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::block::{Block, Layout};
use crate::error::Error;
use crate::failure::Failure;
use crate::fingerprint::Fingerprint;
use crate::progress::Progress;
use crate::record::Record;
use crate::row::Row;
use crate::store::Store;
use crate::stored::StoredStudy;
use crate::table::Table;
use crate::work::{self, InOrder, Parts};

/// Bytes of the stack of a thread. The tables of large systems stand on it, several times in builds without
/// optimisation; pages that are not used cost nothing.
const STACK: usize = 64 << 20;

/// The least number of motions of a part in lanes, unless it is told: each of four threads fills eight lanes
/// several times. It does not depend on the length of vectors, so that the files do not.
const IN_LANES: u64 = 512;

/// Motions of a part unless it is told: so many that a study has about a hundred parts, and no more than a
/// part should have in memory.
fn part_size(count: u64) -> u64 {
    count.div_ceil(128).clamp(64, 65_536)
}

/// A table whose rows are a function of their index. Made by [`Ensemble`](crate::Ensemble), or for anything
/// else that is computed from an index by [`Study::new`].
#[derive(Clone, Debug)]
pub struct Study<F, T> {
    name: String,
    count: u64,
    size: u64,
    row: F,
    names: Option<Vec<String>>,
    settings: String,
    key: String,
    threads: usize,
    pub(crate) shown: bool,
    kind: PhantomData<fn() -> T>,
}

impl<F, T> Study<F, T>
where
    F: Fn(u64) -> Result<T, Failure> + Sync,
    T: Record,
{
    /// A study of `count` rows. `row` must be a function of the index and of nothing else: no clock, no
    /// random numbers but those that the index seeds. The name is that of its files.
    pub fn new(name: impl Into<String>, count: u64, row: F) -> Self {
        Self::of_rows(name, count, row)
    }
}

impl<F: Row<T>, T: Record> Study<F, T> {
    pub(crate) fn of_rows(name: impl Into<String>, count: u64, row: F) -> Self {
        Self {
            name: name.into(),
            count,
            size: part_size(count).max(if row.at_once() > 1 { IN_LANES } else { 1 }),
            row,
            names: None,
            settings: String::new(),
            key: String::new(),
            threads: 0,
            shown: false,
            kind: PhantomData,
        }
    }

    /// Names the columns.
    #[must_use]
    pub fn with_columns<'a>(mut self, names: impl IntoIterator<Item = &'a str>) -> Self {
        self.names = Some(names.into_iter().map(str::to_owned).collect());
        self
    }

    /// What the function of the index captures: parameters, ranges, the seed. A folder refuses parts of
    /// another key. (It also computes a motion of each part again, which finds most changes that the key does
    /// not show.)
    #[must_use]
    pub fn with_key(mut self, key: impl Into<String>) -> Self {
        self.key = key.into();
        self
    }

    /// The number of motions of a part. A killed run loses at most so many in each thread, and each thread
    /// keeps about so many in memory. Choose it so that a part takes between a second and some minutes.
    /// Default: a 128th of the study, at least 64, in lanes 512, and at most 65 536. Zero counts as one.
    #[must_use]
    pub fn with_part_size(mut self, motions: u64) -> Self {
        self.size = motions.max(1);
        self
    }

    /// Threads. Default: one a core, or what `RAYON_NUM_THREADS` says.
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.threads = threads;
        self
    }

    /// Shows a bar with the rate and the time that is left, if the error output is a terminal.
    #[must_use]
    pub fn with_progress(mut self) -> Self {
        self.shown = true;
        self
    }

    pub(crate) fn with_settings(mut self, settings: String) -> Self {
        self.settings = settings;
        self
    }

    /// Adds to the settings.
    pub(crate) fn also(mut self, setting: String) -> Self {
        self.settings = format!("{}, {setting}", self.settings);
        self
    }

    /// Keeps the results in a folder, part by part: a run that is killed goes on where it was, and several
    /// jobs share the work.
    pub fn in_folder(self, folder: impl Into<PathBuf>) -> StoredStudy<F, T> {
        StoredStudy::new(self, folder.into())
    }

    /// Computes all rows, in memory.
    ///
    /// # Errors
    /// [`Error::Panicked`] with the index, if a function panics; [`Error::InvalidColumns`],
    /// [`Error::NotInLanes`], [`Error::Threads`].
    pub fn run(&self) -> Result<Table<T>, Error> {
        let layout = self.layout()?;
        let (parts, pool) = (self.parts(), self.pool()?);
        let progress = Progress::new(&self.name, self.count, 0, self.shown);
        let blocks = Mutex::new(Vec::new());
        let all = InOrder::new(0..parts.number());
        let verdict = work::compute(
            (&pool, self.at_once()),
            parts,
            &all,
            &|first, count, at, block| self.append(&layout, first, count, at, block),
            &progress,
            |block| {
                work::locked(&blocks).push(block);
                Ok(())
            },
        );
        progress.end();
        verdict?;
        Ok(Table::in_memory(self.count, layout, blocks.into_inner().unwrap_or_default()))
    }

    /// The result of one index.
    ///
    /// # Errors
    /// Why there is none.
    pub fn row(&self, index: u64) -> Result<T, Failure> {
        self.row.row(index)
    }

    /// Appends the rows of consecutive indices to a block that has none. `at` is the one that a function of
    /// the user works on.
    pub(crate) fn append(&self, layout: &Layout, first: u64, count: u64, at: &Cell<u64>, block: &mut Block) {
        let size = layout.row();
        block.first = first;
        block.rows.resize(count as usize * size, 0);
        let mut row = Vec::with_capacity(size);
        self.row.rows(first, count, at, &mut |index, result| {
            row.clear();
            let failure = match result {
                Ok(record) => {
                    record.store(&mut row);
                    layout.misfit(row.len())
                }
                Err(failure) => Some(failure),
            };
            layout.close(&mut row, failure.is_some());
            let start = (index - first) as usize * size;
            if let Some(place) = block.rows.get_mut(start..start + size) {
                place.copy_from_slice(&row);
            }
            block.failures.extend(failure.map(|failure| (index, failure)));
        });
        block.failures.sort_by_key(|(index, _)| *index);
    }

    /// How many indices a thread should take at least.
    pub(crate) fn at_once(&self) -> u64 {
        self.row.at_once()
    }

    /// The columns with their names.
    pub(crate) fn layout(&self) -> Result<Layout, Error> {
        if let Some(why) = self.row.refusal() {
            return Err(Error::NotInLanes { why });
        }
        let mut columns = T::columns();
        let number = columns.len();
        let names = self.names.clone();
        let names = names.unwrap_or_else(|| columns.iter().map(|column| column.name.clone()).collect());
        let taken = |name: &String| ["", "index", "error", "error_time"].contains(&name.as_str());
        let twice = names.iter().enumerate().any(|(k, name)| names.iter().take(k).any(|other| other == name));
        if number == 0 || names.len() != number || twice || names.iter().any(taken) {
            return Err(Error::InvalidColumns { names, columns: number });
        }
        for (column, name) in columns.iter_mut().zip(names) {
            column.name = name;
        }
        Ok(Layout { columns })
    }

    pub(crate) fn parts(&self) -> Parts {
        Parts { count: self.count, size: self.size }
    }

    pub(crate) fn pool(&self) -> Result<ThreadPool, Error> {
        ThreadPoolBuilder::new().num_threads(self.threads).stack_size(STACK).build().map_err(Error::Threads)
    }

    /// The folder of this study.
    pub(crate) fn store(&self, folder: &std::path::Path) -> Result<Store, Error> {
        let name = &self.name;
        let allowed = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        if name.is_empty() || name.len() > 100 || name.starts_with('.') || !name.chars().all(allowed) {
            return Err(Error::InvalidName { name: name.clone() });
        }
        let layout = self.layout()?;
        let Self { count, size, settings, key, .. } = self;
        let fingerprint = Fingerprint::new(name, *count, *size, &layout.columns, settings, key);
        Store::open(folder, fingerprint, layout, self.parts())
    }

    /// The name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The number of motions.
    pub fn count(&self) -> u64 {
        self.count
    }
}
