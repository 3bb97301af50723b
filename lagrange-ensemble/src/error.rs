//! [`Error`]: why a study stopped.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use crate::store::MANIFEST;

/// Why a study stopped. Parts that are finished stay, and the same study goes on from them.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// The function of the index, or the reduction of a motion, panicked.
    Panicked {
        /// Index of the motion.
        index: u64,
        /// The message of the panic.
        message: String,
    },
    /// A file or folder could not be read or written: a full disk, missing permission.
    Io {
        /// The action that failed.
        doing: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The folder holds parts of another study of this name.
    AnotherStudy {
        /// The file that says so.
        path: PathBuf,
        /// In what it differs.
        what: &'static str,
        /// The value in the folder's study.
        found: String,
        /// The value in this study.
        expected: String,
    },
    /// The file was written by another version.
    AnotherVersion {
        /// The file.
        path: PathBuf,
        /// The version that wrote it.
        found: String,
        /// The version that reads it.
        expected: String,
    },
    /// A file is cut off, or its bytes are not those that were written.
    Damaged {
        /// The file.
        path: PathBuf,
        /// The damage.
        why: &'static str,
    },
    /// A motion that was computed again has another result than its part: the function of the index has
    /// changed, depends on more than the index, or computes on another machine with other functions.
    NotTheSame {
        /// The part.
        path: PathBuf,
        /// Index of the motion.
        index: u64,
    },
    /// Parts are numbered 1 to n.
    InvalidPart {
        /// The number of the part that was asked for.
        part: u64,
        /// The number of parts.
        of: u64,
    },
    /// A name of a study is that of its files: letters, digits, `-`, `_` and `.` inside.
    InvalidName {
        /// The name.
        name: String,
    },
    /// The names of columns are as many as columns, different, not empty, and none is `index`, `error` or
    /// `error_time`, which the table has itself.
    InvalidColumns {
        /// The names.
        names: Vec<String>,
        /// How many columns there are.
        columns: usize,
    },
    /// The motions of this system cannot be kept apart in the lanes of a vector.
    NotInLanes {
        /// The property of the system that prevents it.
        why: &'static str,
    },
    /// The product of a shape is not the number of motions.
    InvalidShape {
        /// The shape.
        shape: Vec<u64>,
        /// The number of motions.
        count: u64,
    },
    /// A dimension of a grid has a border that is not finite, or too few or too many cells.
    InvalidGrid {
        /// The index of the dimension.
        dimension: usize,
        /// What is wrong with it.
        why: &'static str,
    },
    /// A table ends in `.npy`, `.csv` or, with the feature `parquet`, in `.parquet`.
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The threads could not be started.
    Threads(rayon::ThreadPoolBuildError),
}

impl Error {
    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io { doing, path: path.to_owned(), source }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Panicked { index, message } => write!(
                out,
                "the function of the study panicked at motion {index}: {message}; return an error there, and the motion \
                 is a row with its cause"
            ),
            Self::Io { doing, path, source } => write!(out, "cannot {doing} {}: {source}", path.display()),
            Self::AnotherStudy { path, what, found, expected } => write!(
                out,
                "{} belongs to another study: its {what} is {found}, not {expected}; take another folder or name, or \
                 delete its files",
                path.display()
            ),
            Self::AnotherVersion { path, found, expected } => write!(
                out,
                "{} was written by version {found}, this is {expected}: finish the study with the version that began it, \
                 or take another folder",
                path.display()
            ),
            Self::Damaged { path, why } => {
                let is_manifest = path.extension().is_some_and(|extension| extension == MANIFEST);
                let advice = if is_manifest {
                    "delete it and run the study again, which goes on from its parts"
                } else {
                    "run the study again, and it computes this part again"
                };
                write!(out, "{} is damaged: {why}; {advice}", path.display())
            }
            Self::NotTheSame { path, index } => write!(
                out,
                "motion {index}, computed again, has another result than {} says: the function of the index has changed \
                 (give what it captures in `with_key`), depends on more than the index, or the mathematics of this \
                 machine differ (the feature `libm` has the same bits everywhere); take another folder, or delete the \
                 parts",
                path.display()
            ),
            Self::InvalidPart { part, of } => {
                write!(out, "there is no part {part} of {of}: parts are numbered from 1 to their number")
            }
            Self::InvalidName { name } => write!(
                out,
                "{name:?} is no name for a study: take letters, digits, `-`, `_` and, inside, `.`, at most 100 of them"
            ),
            Self::InvalidColumns { columns: 0, .. } => {
                out.write_str("a record without columns has nothing to keep: give it at least one")
            }
            Self::InvalidColumns { names, columns } => write!(
                out,
                "{names:?} cannot name {columns} columns: give as many names, different ones, none empty, none of them \
                 `index`, `error` or `error_time`"
            ),
            Self::NotInLanes { why } => write!(
                out,
                "the motions of this system cannot run in lanes: it {why}; leave `in_lanes` out, and they run one by one"
            ),
            Self::InvalidShape { shape, count } => {
                write!(out, "{count} motions do not fill the shape {shape:?}")
            }
            Self::InvalidGrid { dimension, why } => {
                write!(out, "dimension {dimension} of the grid cannot be divided into cells: {why}")
            }
            Self::UnknownFormat { path } => write!(
                out,
                "no format is known for {}: end the name in `.npy`, `.csv` or, with the feature `parquet`, `.parquet`",
                path.display()
            ),
            Self::Threads(source) => write!(out, "cannot start threads: {source}"),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            Self::Threads(source) => Some(source),
            _ => None,
        }
    }
}
