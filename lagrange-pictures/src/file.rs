//! Writing a picture.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::PictureError;

/// Writes a file, with its folders, and tells where it is.
pub(crate) fn write(path: &Path, svg: &str) -> Result<PathBuf, PictureError> {
    let failed = |source| PictureError::Io { path: path.to_owned(), source };
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(failed)?;
    }
    fs::write(path, svg).map_err(failed)?;
    path.canonicalize().map_err(failed)
}
