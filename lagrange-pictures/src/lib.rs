//! Pictures of motions of the `lagrangian` crate: phase portraits, energies, reactions, and drawings that
//! move. The facade has this package as `lagrangian::pictures`, with its feature `pictures`.
//!
//! [`Record::of`] runs a motion and keeps its states. A record makes a [`Chart`] of what is plotted over time
//! and a [`Film`] of what moves. Both are SVG: [`Chart::save`], [`Film::save`]. A film plays by itself
//! wherever an image is shown, without a script.
//!
//! ```
//! use lagrangian::prelude::*;
//! use lagrange_pictures::Record;
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
//! let pendulum = Pendulum { length: 1.0 };
//! let record = Record::of(&mut pendulum.simulate(State::at_rest([2.0])), 10.0, 500)?;
//! record.phase_portrait("phi")?.save(folder.join("portrait.svg"))?;
//! record.energies(Pendulum::kinetic_energy, Pendulum::potential_energy).save(folder.join("energies.svg"))?;
//! record.film().rods(|p, q| [Vector2::zeros(), p.bob(q)]).save(folder.join("film.svg"))?;
//! # Ok(())
//! # }
//! ```
#![forbid(unsafe_code)]

mod axis;
mod chart;
mod colours;
mod error;
mod figure;
mod file;
mod film;
mod paper;
mod place;
mod record;

pub use chart::Chart;
pub use error::PictureError;
pub use figure::Figure;
pub use film::Film;
pub use place::{Place, Pose, Spot};
pub use record::Record;
