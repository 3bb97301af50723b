//! Cases with reference digits: every listed quantity that the present interface gives.
//!
//! | module | case | | module | case |
//! | --- | --- | --- | --- | --- |
//! | [`spring`] | S02 | | [`kepler`] | C01 |
//! | [`pinned_bar`] | S03 | | [`henon_heiles`] | C02 |
//! | [`rotating_frame`] | S06 | | [`euler_top`] | C03 |
//! | [`double_pendulum`] | S08 | | [`heavy_top`] | C04 |
//! | [`paraboloid`] | S11 | | [`stiff_spring`] | C06 |
//! | [`helicoid`] | S12a | | [`stiff_chain`] | C07 |
//! | [`hemisphere`] | S13 | | [`tautochrone`] | C08 |
//! | [`hoop`] | S14 | | [`foucault`] | C09 |
//! | [`pleiades`] | P03 | | [`atwood`] | C12 |
//! | [`figure_eight`] | P04 | | [`acrobot`] | C13 |
//! | [`reduced`] | S01, A01, S09, S17 | | [`cart_pole`] | C14 |
//!
//! Parameters and starts stand in the tests, references in `tests/data`.

mod acrobot;
mod atwood;
mod cart_pole;
mod double_pendulum;
mod euler_top;
mod figure_eight;
mod foucault;
mod heavy_top;
mod helicoid;
mod hemisphere;
mod henon_heiles;
mod hoop;
mod kepler;
mod paraboloid;
mod pinned_bar;
mod pleiades;
mod reduced;
mod rotating_frame;
mod spring;
mod stiff_chain;
mod stiff_spring;
mod tautochrone;

/// Standard acceleration of fall of all cases that state no other \[m/s²].
pub(crate) const G: f64 = 9.81;

/// Relative tolerance of closed-form scalars: forces, eigenvalues, energies.
pub(crate) const CLOSED_FORM: f64 = 1e-12;

/// Relative tolerance of states of difficulty 1 and 2.
pub(crate) const EASY: f64 = 1e-9;

/// Relative tolerance of states of difficulty 3.
pub(crate) const MEDIUM: f64 = 1e-8;

/// Relative tolerance of states of difficulty 4 and 5.
pub(crate) const HARD: f64 = 1e-6;
