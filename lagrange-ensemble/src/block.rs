//! [`Layout`] of the rows of a study in bytes, and [`Block`]: consecutive rows.

use crate::failure::Failure;
use crate::record::{Column, Kind};

/// The columns of a study, and the form of a row in a file: values in order, little endian, without gaps.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Layout {
    pub(crate) columns: Vec<Column>,
}

impl Layout {
    /// Whether all columns are doubles. Then a file is a plain array of NumPy, in which a missing value is
    /// NaN. Other rows end in a byte that tells whether they have no result.
    pub(crate) fn is_plain(&self) -> bool {
        self.columns.iter().all(|column| column.kind == Kind::F64)
    }

    /// Bytes of a row.
    pub(crate) fn row(&self) -> usize {
        self.values() + usize::from(!self.is_plain())
    }

    /// Bytes of the values of a row.
    fn values(&self) -> usize {
        self.columns.iter().map(|column| column.kind.size()).sum()
    }

    /// Why a record of so many bytes does not fit into its columns, if it does not.
    pub(crate) fn misfit(&self, bytes: usize) -> Option<Failure> {
        let values = self.values();
        let words = || format!("`Record::store` wrote {bytes} bytes, but `Record::columns` take {values}");
        (bytes != values).then(|| Failure::new(words()))
    }

    /// Ends the row of a motion. A row without a result gets the values that [`Kind`] names.
    pub(crate) fn close(&self, row: &mut Vec<u8>, failed: bool) {
        if failed {
            row.clear();
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
