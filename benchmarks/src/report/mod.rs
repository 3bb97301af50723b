//! The report: ours and all peers in one run on one core.

use std::error::Error;
use std::path::Path;

use crate::precision::{self, plot, server::Server};
use crate::record;

/// Measures, keeps the records if asked to, and writes the tables and the plots.
pub fn run(system: Option<&str>, json: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let server = Server::start()?;
    let records = precision::measure(system, Some(&server))?;
    if let Some(path) = json {
        record::write(&records, path)?;
    }
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    plot::draw_all(&records, &here.join("plots"))
}
