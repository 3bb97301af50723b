//! [`Fingerprint`]: what tells a study from others. It stands in the manifest and in every part.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::record::Column;

/// The version of the layout of manifests and parts.
const FORMAT: u32 = 1;

/// The common facts of the parts of one table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Fingerprint {
    format: u32,
    version: String,
    pub(crate) name: String,
    count: u64,
    part_size: u64,
    columns: Vec<Column>,
    settings: String,
    key: String,
}

/// The fields that every format has.
#[derive(Deserialize)]
struct Version {
    format: u32,
    version: String,
}

impl Fingerprint {
    pub(crate) fn new(
        name: &str,
        count: u64,
        part_size: u64,
        columns: &[Column],
        settings: &str,
        key: &str,
    ) -> Self {
        Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            name: name.to_owned(),
            count,
            part_size,
            columns: columns.to_vec(),
            settings: settings.to_owned(),
            key: key.to_owned(),
        }
    }

    /// The text of a manifest.
    pub(crate) fn text(&self) -> std::io::Result<Vec<u8>> {
        let mut text = serde_json::to_vec_pretty(self)?;
        text.push(b'\n');
        Ok(text)
    }

    /// Whether a text is that of this study.
    pub(crate) fn confirm(&self, path: &Path, text: &[u8]) -> Result<(), Error> {
        let damaged = |_| Error::Damaged { path: path.to_owned(), why: "it is no manifest" };
        let version: Version = serde_json::from_slice(text).map_err(damaged)?;
        if (version.format, &version.version) != (self.format, &self.version) {
            let named = |version: &str, format: u32| format!("{version} (format {format})");
            return Err(Error::AnotherVersion {
                path: path.to_owned(),
                found: named(&version.version, version.format),
                expected: named(&self.version, self.format),
            });
        }
        self.same(path, &serde_json::from_slice(text).map_err(damaged)?)
    }

    /// Whether a fingerprint of this version is that of this study.
    pub(crate) fn same(&self, path: &Path, found: &Self) -> Result<(), Error> {
        let names = |columns: &[Column]| {
            let column = |column: &Column| format!("{}: {:?}", column.name, column.kind);
            columns.iter().map(column).collect::<Vec<_>>().join(", ")
        };
        let differences = [
            ("name", found.name.clone(), self.name.clone()),
            ("number of motions", found.count.to_string(), self.count.to_string()),
            ("number of motions in a part", found.part_size.to_string(), self.part_size.to_string()),
            ("list of columns", names(&found.columns), names(&self.columns)),
            ("settings", found.settings.clone(), self.settings.clone()),
            ("key", found.key.clone(), self.key.clone()),
            ("version", found.version.clone(), self.version.clone()),
        ];
        for (what, found, expected) in differences {
            if found != expected {
                return Err(Error::AnotherStudy { path: path.to_owned(), what, found, expected });
            }
        }
        Ok(())
    }
}
