//! A part of a study as a file: an `.npy` array of its rows, which NumPy reads as it is. Behind the array
//! stand the study, the failures, the length and a checksum, which tell whether the file is whole.

use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::block::{Block, Layout};
use crate::error::Error;
use crate::failure::Failure;
use crate::fingerprint::Fingerprint;
use crate::output::npy;
use crate::whole;

/// The last bytes of a part.
const END: &[u8; 8] = b"lagrange";
/// Length of the text, checksum, end.
const TAIL: usize = 8 + 4 + END.len();

/// The text behind the array.
#[derive(Serialize, Deserialize)]
struct Behind {
    study: Fingerprint,
    part: u64,
    failures: Vec<(u64, Failure)>,
}

/// Writes a part, and does not flush it to the disk. After a power failure its last bytes tell whether it is
/// whole.
pub(crate) fn write(path: &Path, study: &Fingerprint, layout: &Layout, block: Block) -> Result<File, Error> {
    let count = (block.rows.len() / layout.row().max(1)) as u64;
    let Block { number, rows, failures, .. } = block;
    whole::write_unflushed(path, |out| {
        let header = npy::header(layout, &[count])?;
        let text = serde_json::to_vec(&Behind { study: study.clone(), part: number, failures })?;
        let length = (text.len() as u64).to_le_bytes();
        let mut sum = crc32fast::Hasher::new();
        for bytes in [&header, &rows, &text, &length.to_vec()] {
            sum.update(bytes);
            out.write_all(bytes)?;
        }
        out.write_all(&sum.finalize().to_le_bytes())?;
        out.write_all(END)
    })
}

/// Reads a part with `count` rows from the motion `first` on; `None` if there is none.
pub(crate) fn read(
    path: &Path,
    study: &Fingerprint,
    layout: &Layout,
    number: u64,
    (first, count): (u64, u64),
) -> Result<Option<Block>, Error> {
    let mut bytes = match fs::read(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        bytes => bytes.map_err(Error::io("read", path))?,
    };
    let damaged = |why| Error::Damaged { path: path.to_owned(), why };
    let cut = "its end is missing";
    let (content, tail) = bytes.split_last_chunk::<TAIL>().ok_or_else(|| damaged(cut))?;
    let (length, rest) = tail.split_first_chunk::<8>().ok_or_else(|| damaged(cut))?;
    let (sum, end) = rest.split_first_chunk::<4>().ok_or_else(|| damaged(cut))?;
    if end != END {
        return Err(damaged(cut));
    }
    let mut found = crc32fast::Hasher::new();
    found.update(content);
    found.update(length);
    if found.finalize() != u32::from_le_bytes(*sum) {
        return Err(damaged("its checksum is wrong"));
    }
    // The checksum is right, so the file is what somebody wrote.
    let strange = "it is no part of a study";
    let text = usize::try_from(u64::from_le_bytes(*length)).ok();
    let start = text.and_then(|text| content.len().checked_sub(text)).ok_or_else(|| damaged(strange))?;
    let (array, text) = content.split_at(start);
    let value: serde_json::Value = serde_json::from_slice(text).map_err(|_| damaged(strange))?;
    // The study comes first: parts of another version may have other fields.
    let fingerprint = value.get("study").map(ToString::to_string).unwrap_or_default();
    study.confirm(path, fingerprint.as_bytes())?;
    let behind: Behind = serde_json::from_value(value).map_err(|_| damaged(strange))?;
    let header = npy::header(layout, &[count]).map_err(Error::io("describe", path))?;
    let expected = header.len() as u64 + count * layout.row() as u64;
    if behind.part != number || array.len() as u64 != expected || !array.starts_with(&header) {
        return Err(damaged("it is another part"));
    }
    bytes.truncate(start);
    bytes.drain(..header.len());
    Ok(Some(Block { number, first, rows: bytes, failures: behind.failures }))
}
