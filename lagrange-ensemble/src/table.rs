//! [`Table`]: the results of all motions of a study, in memory or in its parts.

use std::collections::VecDeque;
use std::marker::PhantomData;
use std::path::Path;

use crate::block::{Block, Layout};
use crate::error::Error;
use crate::failure::Failure;
use crate::output;
use crate::record::{Cells, Column, Record};
use crate::store::Store;

/// The rows of all motions, in the order of their indices. A table of a folder reads one part at a time, so
/// that its size does not matter.
#[derive(Debug)]
pub struct Table<T> {
    rows: Rows,
    shape: Vec<u64>,
    kind: PhantomData<fn() -> T>,
}

/// Rows of any study.
#[derive(Debug)]
pub(crate) struct Rows {
    count: u64,
    layout: Layout,
    source: Source,
}

#[derive(Debug)]
enum Source {
    Memory(VecDeque<Block>),
    Folder(Store),
}

impl Rows {
    pub(crate) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Visits all parts in order.
    pub(crate) fn each<E: From<Error>>(
        &self,
        mut visit: impl FnMut(&Block) -> Result<(), E>,
    ) -> Result<(), E> {
        match &self.source {
            Source::Memory(blocks) => blocks.iter().try_for_each(visit),
            Source::Folder(store) => (0..store.parts.number()).try_for_each(|part| {
                let block = store.read(part)?.ok_or_else(|| store.missing(part))?;
                visit(&block)
            }),
        }
    }

    /// Whether some motion has no result.
    pub(crate) fn has_failures(&self) -> Result<bool, Error> {
        let mut found = false;
        self.each::<Error>(|block| {
            found |= !block.failures.is_empty();
            Ok(())
        })?;
        Ok(found)
    }
}

impl<T: Record> Table<T> {
    pub(crate) fn in_memory(count: u64, layout: Layout, mut blocks: Vec<Block>) -> Self {
        blocks.sort_by_key(|block| block.number);
        Self::new(count, layout, Source::Memory(blocks.into()))
    }

    pub(crate) fn in_folder(store: Store) -> Self {
        Self::new(store.parts.count, store.layout.clone(), Source::Folder(store))
    }

    fn new(count: u64, layout: Layout, source: Source) -> Self {
        Self { rows: Rows { count, layout, source }, shape: vec![count], kind: PhantomData }
    }

    /// The number of motions.
    pub fn count(&self) -> u64 {
        self.rows.count
    }

    /// The columns.
    pub fn columns(&self) -> &[Column] {
        &self.rows.layout.columns
    }

    /// Gives the array in `.npy` files a shape: rows and columns of a grid, slowest index first.
    ///
    /// # Errors
    /// [`Error::InvalidShape`] if its product is not the number of motions.
    pub fn shaped(mut self, shape: &[u64]) -> Result<Self, Error> {
        let product = shape.iter().try_fold(1_u64, |product, side| product.checked_mul(*side));
        if product != Some(self.count()) {
            return Err(Error::InvalidShape { shape: shape.to_vec(), count: self.count() });
        }
        self.shape = shape.to_vec();
        Ok(self)
    }

    /// Visits all results in the order of their indices.
    ///
    /// # Errors
    /// [`Error::Io`] and [`Error::Damaged`] if a part cannot be read; [`Error::AnotherStudy`] and
    /// [`Error::AnotherVersion`] if another one has taken its place.
    pub fn each(&self, mut visit: impl FnMut(u64, Result<T, &Failure>)) -> Result<(), Error> {
        self.rows.each(|block| {
            let mut failures = block.failures.iter().peekable();
            for (index, row) in (block.first..).zip(block.rows.chunks_exact(self.rows.layout.row())) {
                match failures.next_if(|(failed, _)| *failed == index) {
                    Some((_, failure)) => visit(index, Err(failure)),
                    None => visit(index, Ok(T::load(&mut Cells(row)))),
                }
            }
            Ok(())
        })
    }

    /// All results, in memory.
    ///
    /// # Errors
    /// As [`Table::each`].
    pub fn to_vec(&self) -> Result<Vec<Result<T, Failure>>, Error> {
        let mut all = Vec::new();
        self.each(|_, result| all.push(result.map_err(Clone::clone)))?;
        Ok(all)
    }

    /// Writes the table to a file, whole, in the format that its name ends in.
    ///
    /// | end | what it holds | read by |
    /// | --- | --- | --- |
    /// | `.npy` | a plain array if all columns are doubles, NaN where there is no result; else a structured array with a field `error`. Causes stand beside it in `….failures.csv`, if there are any | `numpy.load("x.npy")` |
    /// | `.csv` | `index`, the columns, `error_time`, `error` | `pandas.read_csv("x.csv")`, `polars.read_csv("x.csv")` |
    /// | `.parquet` | the same (feature `parquet`) | `pandas.read_parquet("x.parquet")`, `polars.read_parquet("x.parquet")` |
    ///
    /// # Errors
    /// [`Error::UnknownFormat`]; [`Error::Io`], and then the file that could not be written is as it was
    /// before; as [`Table::each`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        output::write(&self.rows, &self.shape, path.as_ref())
    }
}
