//! The analysis of a model with `analysis` in its attribute: parts of the energy, integrals, Christoffel
//! symbols, canonical equations, lumped parameters.

mod certificate;
mod claims;
mod conserved;
mod covariant;
mod energy;
mod hamilton;
mod proofs;
mod regressor;
mod scales;

/// Tolerance of closed forms.
const CLOSED_FORM: f64 = 1e-12;

/// Tolerance of derivatives by differences.
const DIFFERENCES: f64 = 1e-11;
