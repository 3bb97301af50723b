//! Many motions of the `lagrangian` crate: maps, basins, Monte Carlo. The facade has this package as
//! `lagrangian::ensemble`, with its feature `ensemble`.
//!
//! A motion is a function of its index, so that its result does not depend on threads, jobs, ranks or on what
//! ran before. The same study runs in memory, in a folder that survives a kill, in the jobs of an array, and
//! by `lagrange-mpi` on a cluster, and has the same bytes.
//!
//! ```
//! use lagrangian::prelude::*;
//! use lagrange_ensemble::{Ensemble, Grid};
//!
//! #[derive(Clone, Copy)]
//! struct Pendulum {
//!     length: f64,
//! }
//!
//! #[lagrangian(coordinates = [phi])]
//! impl Pendulum {
//!     #[point(mass = 1.0)]
//!     fn bob(&self, q: &Coordinates) -> Vector2<f64> {
//!         self.length * Vector2::new(q.phi.sin(), -q.phi.cos())
//!     }
//!
//!     #[potential]
//!     fn gravity(&self, q: &Coordinates) -> f64 {
//!         9.81 * self.bob(q).y
//!     }
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let temporary = tempfile::tempdir()?;
//! # let folder = temporary.path();
//! // 40 lengths by 30 amplitudes.
//! let grid = Grid::new([(0.1, 2.0, 40), (0.0, 3.0, 30)])?;
//! let study = Ensemble::new(grid.count(), |index| {
//!     let [length, amplitude] = grid.middle(index);
//!     (Pendulum { length }, State::at_rest([amplitude]))
//! })
//! .with_tolerance(1e-9)
//! .study("quarters", |motion| {
//!     // The time to the lowest point; an error is the row of its motion, others go on.
//!     let lowest = motion.advance_to_event(|state: &State<f64, 1>| state.q[0], 100.0)?;
//!     Ok(lowest.map(|event| event.state.t))
//! })
//! .with_columns(["time"])
//! .with_key(format!("{grid:?}")) // what the function of the index captures
//! .with_progress()
//! .in_folder(folder);
//! // Killed and run again, it goes on. In an array job: `study.part(k, n)?.run()?`, and whoever is last
//! // has the table.
//! if let Some(table) = study.run()? {
//!     table.shaped(&grid.shape())?.write(folder.join("quarters.npy"))?; // numpy.load("quarters.npy")
//! }
//! # assert!(folder.join("quarters.npy").exists());
//! # Ok(())
//! # }
//! ```
//!
//! | type | what it is |
//! | --- | --- |
//! | [`Ensemble`] | motions by their index; makes studies of ends, samples, event times, or your own reduction |
//! | [`InLanes`] | the same motions in the lanes of SIMD vectors: ends and samples |
//! | [`Chance`] | random numbers that follow from a seed and the index |
//! | [`Study`] | a table whose rows are a function of their index: `run()` in memory, `in_folder(…)` |
//! | [`StoredStudy`] | the same in a folder: goes on after a kill, `part(k, n)` |
//! | [`Table`] | the rows; `write` as `.npy`, CSV, Parquet |
//! | [`Record`] | what a motion leaves: numbers, states, arrays, tuples, types of yours |
//!
//! Motions run one by one in each thread, systems with constraints and contacts like all others. Smooth
//! systems run several at once in the lanes of a vector by [`Ensemble::in_lanes`], most of those with
//! constraints, too: a lane that has arrived takes the next motion.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]

mod block;
mod chance;
mod ensemble;
mod error;
mod failure;
mod fingerprint;
mod grid;
mod lanes;
mod output;
mod part;
mod progress;
mod record;
mod row;
mod store;
mod stored;
mod study;
mod table;
mod whole;
mod work;

pub use chance::Chance;
pub use ensemble::{Ensemble, Motion, Start, States};
pub use error::Error;
pub use failure::Failure;
pub use grid::Grid;
pub use lanes::InLanes;
pub use progress::Progress;
pub use record::{Cells, Column, Kind, Record};
pub use row::Row;
pub use stored::{OpenStudy, StoredStudy};
pub use study::Study;
pub use table::Table;
pub use work::Dispatch;
