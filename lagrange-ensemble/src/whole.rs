//! Files that are there whole or not at all: written under a temporary name, then renamed.

use std::fs::{self, File};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// Temporary files begin and end so.
const BEFORE: &str = ".unfinished-";
const AFTER: &str = ".tmp";

/// Writes a file whole and to the disk, or leaves none and no trace of it.
pub(crate) fn write(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), Error> {
    renamed(path, content, File::sync_all).map(|_| ())
}

/// Writes a file that is whole for every process that looks. The operating system may hold its content back
/// from the disk, so that a failure of power can leave less of it. Returns the file, to be flushed.
pub(crate) fn write_unflushed(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<File, Error> {
    renamed(path, content, |_| Ok(()))
}

fn renamed(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ready: impl FnOnce(&File) -> io::Result<()>,
) -> Result<File, Error> {
    let temporary = temporary(path);
    let write = || {
        let mut out = BufWriter::with_capacity(1 << 18, File::create_new(&temporary)?);
        content(&mut out)?;
        let file = out.into_inner()?;
        ready(&file)?;
        fs::rename(&temporary, path)?;
        Ok(file)
    };
    write().map_err(|source| {
        // It is of no use, and the disk may be full. The first error is what matters.
        let _ = fs::remove_file(&temporary);
        Error::Io { doing: "write", path: path.to_owned(), source }
    })
}

/// A name in the same folder that no other process takes, on this machine or another that shares the folder.
fn temporary(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let (process, chance) = (std::process::id(), RandomState::new().hash_one(0));
    path.with_file_name(format!("{BEFORE}{name}-{process}-{chance:016x}{AFTER}"))
}

/// Whether a name is that of a file that was not finished.
pub(crate) fn is_unfinished(name: &str) -> bool {
    name.starts_with(BEFORE) && name.ends_with(AFTER)
}

/// Flushes renamed files of a folder to the disk, where the system knows how.
pub(crate) fn flush(folder: &Path) -> Result<(), Error> {
    if cfg!(unix) {
        let flushed = File::open(folder).and_then(|folder| folder.sync_all());
        flushed.map_err(Error::io("flush", folder))?;
    }
    Ok(())
}
