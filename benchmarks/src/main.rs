//! Measurements: `cargo run --release -p benchmarks -- rhs | fixed | precision | report | nonsmooth |
//! stability | robots | many`.
//!
//! A figure counts only as a ratio within one run: all subjects of a system are timed in turn,
//! on the same states, and absolute times drift between machines.

mod fixed;
mod many;
mod native;
mod nonsmooth;
mod precision;
mod problem;
mod record;
mod report;
mod rhs;
mod robots;
mod stability;
mod systems;

use std::error::Error;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use precision::Effort;

/// Measurements of the `lagrangian` crate.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    #[command(subcommand)]
    benchmark: Benchmark,
}

/// Arguments that every measurement takes.
#[derive(Args)]
struct Common {
    /// Measures one system only.
    #[arg(long)]
    system: Option<String>,
    /// Writes the records as JSON.
    #[arg(long)]
    json: Option<PathBuf>,
}

/// How whole runs are measured.
#[derive(Args)]
struct Runs {
    /// Builds for any processor instead of the present one.
    #[arg(long)]
    portable: bool,
    /// Repeats less: for a first impression, not for figures to keep.
    #[arg(long)]
    quick: bool,
}

impl Runs {
    /// Goes on in the right build, with the integrators of other crates or without, on one core.
    fn prepare(&self, peers: bool) -> Result<Effort, Box<dyn Error>> {
        native::enter(self.portable, peers)?;
        native::pin();
        Ok(if self.quick { Effort::QUICK } else { Effort::FULL })
    }
}

#[derive(Subcommand)]
enum Benchmark {
    /// One evaluation of the accelerations: generated code against code written by hand.
    Rhs {
        #[command(flatten)]
        common: Common,
    },
    /// Fixed steps, as a control loop takes them: the error at the end and the time of a step.
    Fixed {
        #[command(flatten)]
        common: Common,
        #[command(flatten)]
        runs: Runs,
    },
    /// Time of a whole integration against its error: the library and integrators from crates.
    Precision {
        #[command(flatten)]
        common: Common,
        /// Draws one plot for each system into this directory.
        #[arg(long)]
        svg: Option<PathBuf>,
        #[command(flatten)]
        runs: Runs,
    },
    /// As `precision`, with the peers in Python, into RESULTS.md and the plots beside it.
    Report {
        #[command(flatten)]
        common: Common,
        #[command(flatten)]
        runs: Runs,
    },
    /// Contacts, dry friction and kinks beside Siconos, MuJoCo and modes by hand, into NONSMOOTH.md.
    Nonsmooth {
        #[command(flatten)]
        common: Common,
        #[command(flatten)]
        runs: Runs,
    },
    /// Robots from URDF files: accelerations and their derivatives beside those of Pinocchio.
    Robots {
        #[command(flatten)]
        common: Common,
        /// Builds the derivatives of large robots too, which takes minutes.
        #[arg(long)]
        full: bool,
        /// Repeats less: for a first impression, not for figures to keep.
        #[arg(long)]
        quick: bool,
    },
    /// Studies of many motions beside heyoka, threads, and the overhead of the library, into MANY.md.
    Many {
        #[command(flatten)]
        common: Common,
        #[command(flatten)]
        runs: Runs,
    },
    /// All integrators on tasks that are hard for integrators, into STABILITY.md and its picture.
    Stability {
        #[command(flatten)]
        common: Common,
        /// Starts each linkage hundreds of times instead of dozens: ten times as long.
        #[arg(long)]
        full: bool,
    },
}

fn main() -> Result<(), Box<dyn Error>> {
    match Arguments::parse().benchmark {
        Benchmark::Rhs { common: Common { system, json } } => rhs::run(system.as_deref(), json.as_deref()),
        Benchmark::Fixed { common: Common { system, json }, runs } => {
            fixed::run(system.as_deref(), json.as_deref(), runs.prepare(true)?)
        }
        Benchmark::Precision { common: Common { system, json }, svg, runs } => {
            precision::run(system.as_deref(), json.as_deref(), svg.as_deref(), runs.prepare(true)?)
        }
        Benchmark::Report { common: Common { system, json }, runs } => {
            report::run(system.as_deref(), json.as_deref(), runs.prepare(true)?)
        }
        Benchmark::Nonsmooth { common: Common { system, json }, runs } => {
            nonsmooth::run(system.as_deref(), json.as_deref(), runs.prepare(false)?)
        }
        Benchmark::Robots { common: Common { system, json }, full, quick } => {
            robots::run(system.as_deref(), json.as_deref(), robots::Extent { full, quick })
        }
        Benchmark::Many { common: Common { system, json }, runs } => {
            // Threads are measured: no core is pinned.
            native::enter(runs.portable, false)?;
            let extent = if runs.quick { many::Extent::QUICK } else { many::Extent::FULL };
            many::run(system.as_deref(), json.as_deref(), extent)
        }
        Benchmark::Stability { common: Common { system, json }, full } => {
            native::pin();
            stability::run(system.as_deref(), json.as_deref(), full)
        }
    }
}
