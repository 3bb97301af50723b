//! The systems of the gallery.

pub mod cart_pole;
pub mod chain;
pub mod double_pendulum;
pub mod four_bar;
pub mod rocking_block;
pub mod stick_slip;
pub mod three_body;
pub mod top;
