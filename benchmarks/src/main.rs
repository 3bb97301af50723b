//! Measurements: `cargo run --release -p benchmarks -- rhs | precision | report`.
//!
//! A figure counts only as a ratio within one run: all subjects of a system are timed in turn,
//! on the same states, and absolute times drift between machines.

mod native;
mod precision;
mod problem;
mod record;
mod report;
mod rhs;
mod systems;

use clap::{Args, Parser, Subcommand};
use std::error::Error;
use std::path::PathBuf;

/// Measurements of the `lagrangian` crate.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    #[command(subcommand)]
    benchmark: Benchmark,
}

/// What every measurement can be told.
#[derive(Args)]
struct Common {
    /// Measures one system only.
    #[arg(long)]
    system: Option<String>,
    /// Writes the records as JSON.
    #[arg(long)]
    json: Option<PathBuf>,
}

#[derive(Subcommand)]
enum Benchmark {
    /// One evaluation of the accelerations: generated code against code written by hand.
    Rhs {
        #[command(flatten)]
        common: Common,
    },
    /// Time of a whole integration against its error: the library and integrators from crates.
    Precision {
        #[command(flatten)]
        common: Common,
        /// Draws one plot for each system into this directory.
        #[arg(long)]
        svg: Option<PathBuf>,
        /// Builds for any processor instead of the present one.
        #[arg(long)]
        portable: bool,
    },
    /// As `precision`, with the peers in Python, into RESULTS.md and the plots beside it.
    Report {
        #[command(flatten)]
        common: Common,
        /// Builds for any processor instead of the present one.
        #[arg(long)]
        portable: bool,
    },
}

fn main() -> Result<(), Box<dyn Error>> {
    match Arguments::parse().benchmark {
        Benchmark::Rhs { common: Common { system, json } } => rhs::run(system.as_deref(), json.as_deref()),
        Benchmark::Precision { common: Common { system, json }, svg, portable } => {
            native::enter(portable)?;
            native::pin();
            precision::run(system.as_deref(), json.as_deref(), svg.as_deref())
        }
        Benchmark::Report { common: Common { system, json }, portable } => {
            native::enter(portable)?;
            native::pin();
            report::run(system.as_deref(), json.as_deref())
        }
    }
}
