//! Taylor series of the motion: coefficients, fixed and adaptive steps, units, failures, long runs.
//!
//! The oracle of a series is never another series: accelerations for the first coefficient, Dormand–Prince at
//! the finest tolerance for motions, closed forms and conserved quantities where there are any.

mod at_rest;
mod control;
mod failures;
mod functions;
mod gaps;
mod hidden;
mod line;
mod mechanics;
mod narrow;
mod oracle;
mod roots;
mod rounding;
mod steps;
mod units;
