//! [`Store`]: the folder of a study, with its manifest and its parts.

use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::block::{Block, Layout};
use crate::error::Error;
use crate::fingerprint::Fingerprint;
use crate::part;
use crate::whole;
use crate::work::Parts;

/// The extension of the file of a manifest.
pub(crate) const MANIFEST: &str = "json";

/// `NAME.json`, the manifest, and `NAME.parts/`, the parts by number.
#[derive(Clone, Debug)]
pub(crate) struct Store {
    folder: PathBuf,
    fingerprint: Fingerprint,
    pub(crate) layout: Layout,
    pub(crate) parts: Parts,
}

impl Store {
    /// Opens the folder for a study; makes it, and its manifest, if they are not there.
    pub(crate) fn open(
        parent: &Path,
        fingerprint: Fingerprint,
        layout: Layout,
        parts: Parts,
    ) -> Result<Self, Error> {
        let name = &fingerprint.name;
        let folder = parent.join(format!("{name}.parts"));
        let manifest = parent.join(format!("{name}.{MANIFEST}"));
        fs::create_dir_all(&folder).map_err(Error::io("make", &folder))?;
        if !manifest.try_exists().map_err(Error::io("read", &manifest))? {
            let text = fingerprint.text().map_err(Error::io("describe", &manifest))?;
            whole::write(&manifest, |out| out.write_all(&text))?;
            whole::flush(parent)?;
        }
        // The manifest is read in any case: another study may have come first.
        let text = fs::read(&manifest).map_err(Error::io("read", &manifest))?;
        fingerprint.confirm(&manifest, &text)?;
        Ok(Self { folder, fingerprint, layout, parts })
    }

    pub(crate) fn path(&self, part: u64) -> PathBuf {
        self.folder.join(format!("{part:010}.npy"))
    }

    pub(crate) fn read(&self, part: u64) -> Result<Option<Block>, Error> {
        part::read(&self.path(part), &self.fingerprint, &self.layout, part, self.parts.part(part))
    }

    /// Writes a part; none where another process was faster.
    fn write(&self, block: Block) -> Result<Option<(PathBuf, File)>, Error> {
        let path = self.path(block.number);
        match part::write(&path, &self.fingerprint, &self.layout, block) {
            // Another process found the study complete and swept up, so this part was there.
            Err(Error::Io { source, .. }) if source.kind() == ErrorKind::NotFound && path.exists() => {
                Ok(None)
            }
            verdict => verdict.map(|file| Some((path, file))),
        }
    }

    /// Why a table has no such part.
    pub(crate) fn missing(&self, part: u64) -> Error {
        Error::Damaged { path: self.path(part), why: "it is not there any more" }
    }

    /// Whether all parts are there; then files that a killed run has left are swept up.
    pub(crate) fn is_complete(&self) -> Result<bool, Error> {
        let mut names = HashSet::new();
        for entry in fs::read_dir(&self.folder).map_err(Error::io("read", &self.folder))? {
            let entry = entry.map_err(Error::io("read", &self.folder))?;
            names.insert(entry.file_name().to_string_lossy().into_owned());
        }
        if !(0..self.parts.number()).all(|part| names.contains(&format!("{part:010}.npy"))) {
            return Ok(false);
        }
        for name in names.iter().filter(|name| whole::is_unfinished(name)) {
            // Another run that completes the study may have removed it first.
            let _ = fs::remove_file(self.folder.join(name));
        }
        Ok(true)
    }
}

/// Flushing a part to the disk may take a hundredth of the time of a run. It takes milliseconds, however
/// small the part is, so parts that are quickly made follow each other unflushed. After a failure of power
/// their ends tell what is missing, and that is computed again.
const FLUSHING: u32 = 100;

/// Writes the parts of a run.
#[derive(Debug)]
pub(crate) struct Writer<'a> {
    store: &'a Store,
    /// When the last flush ended, and how long it took.
    flushed: (Instant, Duration),
    /// The last part, if it is not flushed.
    last: Option<(PathBuf, File)>,
}

impl<'a> Writer<'a> {
    pub(crate) fn new(store: &'a Store) -> Self {
        Self { store, flushed: (Instant::now(), Duration::ZERO), last: None }
    }

    /// Writes a part.
    pub(crate) fn write(&mut self, block: Block) -> Result<(), Error> {
        self.last = self.store.write(block)?;
        let (ended, taken) = self.flushed;
        if ended.elapsed() >= taken.saturating_mul(FLUSHING) { self.flush() } else { Ok(()) }
    }

    /// Flushes the last part. An operating system that writes late reports a full disk here.
    fn flush(&mut self) -> Result<(), Error> {
        let begin = Instant::now();
        if let Some((path, file)) = self.last.take() {
            file.sync_all().map_err(Error::io("write", &path))?;
        }
        self.flushed = (Instant::now(), begin.elapsed());
        Ok(())
    }

    /// After the last part: flushes it, and the names of all.
    pub(crate) fn end(mut self) -> Result<(), Error> {
        self.flush()?;
        whole::flush(&self.store.folder)
    }
}
