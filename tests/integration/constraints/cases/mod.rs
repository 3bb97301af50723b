//! Cases with reference digits in their constrained formulations, states and reactions.
//!
//! | module | case | | module | case |
//! | --- | --- | --- | --- | --- |
//! | [`pendulum`] | S01, A01, S20 | | [`parabola`] | S15 smooth |
//! | [`incline`] | S04 | | [`moving_incline`] | S17 |
//! | [`wall_and_floor`] | S05 | | [`rod`] | S18 |
//! | [`wheel`] | S07 | | [`inadmissible`] | S19 |
//! | [`double_pendulum`] | S08 | | [`andrews`] | P01 |
//! | [`helix`] | S09 | | [`car_axis`] | P02 |
//! | [`paraboloid`] | S11 | | [`spherical_pendulum`] | C05 |
//! | [`helicoid`] | S12b, S12c | | [`disc`] | C10 |
//! | [`hemisphere`] | S13 | | [`skate`] | C11 |
//! | [`hoop`] | S14 | | | |
//!
//! Every system is also checked against the identities of [`crate::support::constrained`].

mod andrews;
mod car_axis;
mod disc;
mod double_pendulum;
mod helicoid;
mod helix;
mod hemisphere;
mod hoop;
mod inadmissible;
mod incline;
mod moving_incline;
mod parabola;
mod paraboloid;
mod pendulum;
mod rod;
mod skate;
mod spherical_pendulum;
mod wall_and_floor;
mod wheel;
