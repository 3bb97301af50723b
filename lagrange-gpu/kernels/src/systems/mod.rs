//! The systems: a description each.

mod cart_pole;
mod double_pendulum;
mod four_bar;
mod kepler;
mod links;

pub use cart_pole::CartPole;
pub use double_pendulum::DoublePendulum;
pub use four_bar::FourBar;
pub use kepler::Kepler;
pub use links::Links;
