//! The report: ours and all peers in one run on one core, as tables and plots.

pub mod machine;
mod tables;

use std::error::Error;
use std::path::Path;

use crate::precision::{self, Effort, plot, server::Server};
use crate::record;

/// Measures and, for all systems, writes RESULTS.md and the plots; for one system prints its tables.
pub fn run(system: Option<&str>, json: Option<&Path>, effort: Effort) -> Result<(), Box<dyn Error>> {
    let server = Server::start()?;
    let records = precision::measure(system, Some(&server), effort)?;
    if let Some(path) = json {
        record::write(&records, path)?;
    }
    let tables = tables::all(&records);
    if system.is_some() {
        println!("\n{tables}");
        return Ok(());
    }
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = format!("{}\n{tables}\n{}", machine::describe(&server)?, plots(&records));
    std::fs::write(here.join("RESULTS.md"), text)?;
    plot::draw_all(&records, &here.join("plots"))
}

/// The section with the plots.
fn plots(records: &[record::Record]) -> String {
    let mut text =
        String::from("## Plots\n\nTime of a run against the error at its end; lower left is better.\n");
    for system in record::systems(records) {
        text += &format!("\n![{system}](plots/{system}.svg)\n");
    }
    text
}
