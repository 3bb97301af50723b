//! [`Rows`]: the results of a study on a processor, and the same study without one.

use lagrange_ensemble::{Failure, Record, Row, Study};

use crate::kernel::{DONE, FAILED, Kernel};
use crate::words::Words;

/// The rows of all motions, in the order of their indices.
#[derive(Clone, Debug)]
pub struct Rows<S, R, E> {
    kernel: Kernel<S, R, E>,
    setting: S,
    count: u64,
    /// Motions of a launch.
    pub(crate) batch: u64,
    /// The cells of each launch.
    parts: Vec<Vec<u64>>,
}

impl<S: Words, R: Words, E> Rows<S, R, E> {
    pub(crate) fn new(kernel: Kernel<S, R, E>, setting: S, count: u64, batch: u64) -> Self {
        Self { kernel, setting, count, batch, parts: Vec::new() }
    }

    /// The cells of the next launch.
    pub(crate) fn add(&mut self, part: Vec<u64>) {
        self.parts.push(part);
    }

    /// The kernel that left them.
    pub(crate) fn kernel(&self) -> &Kernel<S, R, E> {
        &self.kernel
    }

    /// The number of motions.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The column of a motion in the cells of its launch, from its mark on.
    fn cells(&self, index: u64) -> impl Iterator<Item = u64> + '_ {
        let part = usize::try_from(index / self.batch).ok().and_then(|part| self.parts.get(part));
        let place = (index % self.batch) as usize;
        let motions = part.map_or(1, |part| part.len() / (1 + R::WORDS)).max(1);
        part.into_iter().flat_map(move |part| part.iter().skip(place).step_by(motions).copied())
    }

    /// The row of a motion, if it has one.
    fn found(&self, index: u64) -> Option<R> {
        let mut cells = self.cells(index);
        (cells.next() == Some(DONE)).then(|| R::take(&mut || cells.next().unwrap_or_default()))
    }

    /// Whether the motion has the same bits here.
    pub(crate) fn is_that_of_the_function(&self, index: u64) -> bool {
        let here = self.kernel.cells(index, &self.setting);
        if here.first() == Some(&FAILED) {
            return self.cells(index).next() == Some(FAILED);
        }
        self.cells(index).eq(here)
    }

    /// How many of these motions have the same bits here.
    pub fn equal_here(&self, indices: impl IntoIterator<Item = u64>) -> u64 {
        indices.into_iter().filter(|index| self.is_that_of_the_function(*index)).count() as u64
    }
}

impl<S: Words, R: Words, E: Into<Failure>> Rows<S, R, E> {
    /// The row of a motion.
    ///
    /// # Errors
    /// Why the motion has no row. A processor only marks such a motion. It is computed again here, up to its
    /// end, to find the cause.
    pub fn row(&self, index: u64) -> Result<R, Failure> {
        if let Some(row) = self.found(index) {
            return Ok(row);
        }
        if index >= self.count {
            return Err(Failure::new(format!("there are {} motions", self.count)));
        }
        match self.kernel.row(index, &self.setting) {
            Err(error) => Err(error.into()),
            Ok(_) => Err(Failure::new(
                "the motion ends in an error in the arithmetic of the processor, not in that of this machine",
            )),
        }
    }

    /// All rows, as [`Rows::row`] has them.
    pub fn to_vec(&self) -> Vec<Result<R, Failure>> {
        (0..self.count).map(|index| self.row(index)).collect()
    }

    /// The rows as a study. It has them as a table in memory, in files or in parts of a folder.
    pub fn study(&self) -> Study<impl Row<R> + '_, R>
    where
        S: Sync,
        R: Record,
        E: Sync,
    {
        Study::new(self.kernel.name(), self.count, |index| self.row(index))
    }
}

impl<S: Words + Sync, R: Words + Record, E: Into<Failure>> Kernel<S, R, E> {
    /// The same motions without a processor: a study on the cores of this machine. In a folder it goes on
    /// after a kill.
    pub fn study<'a>(self, count: u64, setting: &'a S) -> Study<impl Row<R> + 'a, R>
    where
        R: 'a,
        E: 'a,
    {
        Study::new(self.name(), count, move |index| self.row(index, setting).map_err(Into::into))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thirds(index: u64, &third: &u64) -> Result<(i64, f64), Failure> {
        let row = (index.cast_signed(), 0.1 * index as f64);
        if index % 3 == third { Err(Failure::at(row.1, "a third")) } else { Ok(row) }
    }

    /// The results as a processor would leave them, made here, `batch` motions at a time.
    fn left(count: u64, batch: u64, spoilt: Option<u64>) -> Rows<u64, (i64, f64), Failure> {
        let mut rows = Rows::new(crate::kernel!(thirds), 2, count, batch);
        for first in (0..count).step_by(batch as usize) {
            let length = batch.min(count - first) as usize;
            let mut cells = vec![0; 3 * length];
            for place in 0..length {
                crate::kernel::compute(thirds, first + place as u64, &2, |column, word| {
                    let flipped = u64::from(spoilt == Some(first + place as u64));
                    cells[column * length + place] = word ^ flipped;
                });
            }
            rows.add(cells);
        }
        rows
    }

    #[test]
    fn rows_are_those_of_the_function() {
        for batch in [1, 4, 10, 11] {
            let rows = left(10, batch, None);
            for (index, row) in (0..).zip(rows.to_vec()) {
                assert_eq!(row, thirds(index, &2), "motion {index} of launches of {batch}");
            }
            assert_eq!(rows.equal_here(0..10), 10);
            assert!(rows.row(10).is_err());
        }
    }

    #[test]
    fn another_row_is_noticed() {
        for spoilt in 0..10 {
            let rows = left(10, 4, Some(spoilt));
            assert_eq!(rows.equal_here(0..10), 9, "motion {spoilt}");
        }
    }

    #[test]
    fn a_study_has_the_rows() -> Result<(), Box<dyn std::error::Error>> {
        let here = crate::kernel!(thirds).study(10, &2).run()?.to_vec()?;
        let rows = left(10, 4, None);
        assert_eq!(rows.study().run()?.to_vec()?, here);
        assert_eq!(here.iter().filter(|row| row.is_err()).count(), 3);
        Ok(())
    }
}
