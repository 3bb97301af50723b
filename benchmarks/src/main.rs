//! Measurements: `cargo run --release -p benchmarks -- rhs [--json FILE]`.
//!
//! A figure counts only as a ratio within one run: all subjects of a system are timed in turn,
//! on the same states, and absolute times drift between machines.

mod rhs;
mod systems;

use clap::{Parser, Subcommand};
use std::error::Error;
use std::path::PathBuf;

/// Measurements of the `lagrangian` crate.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    #[command(subcommand)]
    benchmark: Benchmark,
}

#[derive(Subcommand)]
enum Benchmark {
    /// One evaluation of the accelerations: generated code against code written by hand.
    Rhs {
        /// Measures one system only.
        #[arg(long)]
        system: Option<String>,
        /// Writes the records as JSON.
        #[arg(long)]
        json: Option<PathBuf>,
    },
}

fn main() -> Result<(), Box<dyn Error>> {
    match Arguments::parse().benchmark {
        Benchmark::Rhs { system, json } => rhs::run(system.as_deref(), json.as_deref()),
    }
}
