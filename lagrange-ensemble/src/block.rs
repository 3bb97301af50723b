//! [`Layout`] of the rows of a study in bytes, and [`Block`]: consecutive rows.

use crate::failure::Failure;
use crate::record::{Column, Kind};

/// The columns of a study and how a row stands in a file: values in order, little endian, without gaps.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Layout {
    pub(crate) columns: Vec<Column>,
}

impl Layout {
    /// Whether all columns are doubles: a plain array of NumPy, where what is missing is no number. Other
    /// rows end in a byte that tells whether they have no result.
    pub(crate) fn is_plain(&self) -> bool {
        self.columns.iter().all(|column| column.kind == Kind::F64)
    }

    /// Bytes of a row.
    pub(crate) fn row(&self) -> usize {
        let values: usize = self.columns.iter().map(|column| column.kind.size()).sum();
        values + usize::from(!self.is_plain())
    }

    /// Appends the row of a motion: of one without a result, what [`Kind`] says.
    pub(crate) fn close(&self, row: &mut Vec<u8>, start: usize, failed: bool) {
        if failed {
            row.truncate(start);
            for column in &self.columns {
                match column.kind {
                    Kind::F64 => row.extend_from_slice(&f64::NAN.to_le_bytes()),
                    Kind::F32 => row.extend_from_slice(&f32::NAN.to_le_bytes()),
                    kind => row.extend(std::iter::repeat_n(0, kind.size())),
                }
            }
        }
        if !self.is_plain() {
            row.push(u8::from(failed));
        }
    }
}

/// Consecutive rows of a study: a part of it, in memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Block {
    /// Number of the part.
    pub(crate) number: u64,
    /// Index of the first motion.
    pub(crate) first: u64,
    /// The rows.
    pub(crate) rows: Vec<u8>,
    /// Why rows have no result, by the index of the motion, in order.
    pub(crate) failures: Vec<(u64, Failure)>,
}
