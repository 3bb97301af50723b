//! Tables as files: `.npy`, CSV, Parquet. All of them are written part by part and whole.

use std::fs;
use std::path::Path;

use crate::error::Error;
use crate::table::Rows;
use crate::whole;

mod csv;
pub(crate) mod npy;
#[cfg(feature = "parquet")]
mod parquet;

/// Writes a table in the format that the end of the name tells.
pub(crate) fn write(rows: &Rows, shape: &[u64], path: &Path) -> Result<(), Error> {
    match path.extension().and_then(|end| end.to_str()) {
        Some("npy") => {
            whole_or_cause(path, |out| npy::write(rows, shape, out))?;
            let failures = path.with_extension("failures.csv");
            if rows.has_failures()? {
                return whole_or_cause(&failures, |out| csv::write_failures(rows, out));
            }
            // A file of an earlier study would be taken for one of this study.
            match fs::remove_file(&failures) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    Err(Error::io("remove", &failures)(error))
                }
                _ => Ok(()),
            }
        }
        Some("csv") => whole_or_cause(path, |out| csv::write(rows, out)),
        #[cfg(feature = "parquet")]
        Some("parquet") => whole_or_cause(path, |out| parquet::write(rows, out)),
        _ => Err(Error::UnknownFormat { path: path.to_owned() }),
    }
}

type Out = std::io::BufWriter<fs::File>;

/// Why writing ended: an error of the file itself, or of the parts that it is made of.
pub(crate) enum Stopped {
    Writing(std::io::Error),
    Reading(Error),
}

impl From<std::io::Error> for Stopped {
    fn from(error: std::io::Error) -> Self {
        Self::Writing(error)
    }
}

impl From<Error> for Stopped {
    fn from(error: Error) -> Self {
        Self::Reading(error)
    }
}

/// Writes a file whole; an error of the parts stays what it is.
fn whole_or_cause(path: &Path, content: impl FnOnce(&mut Out) -> Result<(), Stopped>) -> Result<(), Error> {
    let mut cause = None;
    let written = whole::write(path, |out| {
        content(out).map_err(|stopped| match stopped {
            Stopped::Writing(error) => error,
            Stopped::Reading(error) => {
                cause = Some(error);
                std::io::Error::other("the parts could not be read")
            }
        })
    });
    match cause {
        Some(cause) => Err(cause),
        None => written,
    }
}
