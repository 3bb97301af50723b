//! Many motions of the `lagrangian` crate.
#![forbid(unsafe_code)]

mod block;
mod ensemble;
mod error;
mod failure;
mod fingerprint;
mod grid;
mod output;
mod part;
mod progress;
mod record;
mod store;
mod stored;
mod study;
mod table;
mod whole;
mod work;

pub use ensemble::{Ensemble, Motion, Row, Start};
pub use error::Error;
pub use failure::Failure;
pub use grid::Grid;
pub use progress::Progress;
pub use record::{Cells, Column, Kind, Record};
pub use stored::{OpenStudy, StoredStudy};
pub use study::Study;
pub use table::Table;
pub use work::Dispatch;
